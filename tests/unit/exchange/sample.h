/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Requests and results that the tests of exchange and endpoint share. */
#ifndef PERCUSS_TESTS_EXCHANGE_SAMPLE_H
#define PERCUSS_TESTS_EXCHANGE_SAMPLE_H

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "exchange/answer.h"
#include "solve/solve.h"

/* A good request on the wire with room for the largest one. */
struct sample {
    percuss_v1_BodyMotion bodies[PERCUSS_MAX_BODIES];
    percuss_v1_Contact contacts[PERCUSS_MAX_CONTACTS];
    double delassus[PERCUSS_MAX_CONTACTS * PERCUSS_MAX_CONTACTS];
    percuss_v1_Request wire;
};

/* Two bodies, two contacts, a delassus matrix. */
static inline void sample_fill(struct sample *sample)
{
    memset(sample, 0, sizeof *sample);
    for (int i = 0; i < 2; i++) {
        percuss_v1_BodyMotion *body = &sample->bodies[i];
        snprintf(body->id, sizeof body->id, "body-%d", i);
        body->orientation[0] = 1.0;
        body->position[2] = 0.25 * i;
        body->velocity[2] = -0.5 * i;
        percuss_v1_Contact *contact = &sample->contacts[i];
        contact->a = (uint32_t)i;
        contact->b = (uint32_t)(1 - i);
        contact->normal[2] = 1.0;
        contact->gap = 1e-6 * i;
    }
    const double delassus[] = {2.0, 0.5, 0.5, 3.0};
    memcpy(sample->delassus, delassus, sizeof delassus);
    sample->wire.sequence = 7;
    sample->wire.bodies._buffer = sample->bodies;
    sample->wire.bodies._length = 2;
    sample->wire.contacts._buffer = sample->contacts;
    sample->wire.contacts._length = 2;
    sample->wire.delassus._buffer = sample->delassus;
    sample->wire.delassus._length = 4;
}

static const uint8_t sample_client[16] = {0xc1, 0xea, 7}, sample_server[16] = {0x5e, 9};

static inline struct envelope sample_envelope(uint64_t sequence)
{
    return (struct envelope){sample_client, sample_server, sequence, "revision", "1.2.3"};
}

static inline void sample_friction(struct solve_contact_result *contact)
{
    contact->friction = 0.3;
    contact->tangent[2] = 1.0;
    contact->impulse_tangential[0] = -4.0;
    contact->impulse_tangential[1] = 5.0;
    contact->impulse_tangential_error = 6.0;
    contact->slip_before[0] = 7.0;
    contact->slip_after[1] = NAN;
    contact->tangential_restitution = 8.0;
    contact->restitution_kinematic = 9.0;
    contact->restitution_energetic = 10.0;
    contact->friction_state = PERCUSS_FRICTION_STATE_SLID;
}

/* A result of that many bodies and contacts, each with `listed` sub-impacts; every number differs.
 * Freed by free(). */
static inline struct solve_result *sample_result(size_t count, size_t listed)
{
    static struct sub_impact list[PERCUSS_MAX_SUB_IMPACTS];
    struct solve_result *result = calloc(1, sizeof *result);
    assert_non_null(result);
    result->contact_count = result->body_count = count;
    for (size_t i = 0; i < PERCUSS_MAX_SUB_IMPACTS; i++)
        list[i] = (struct sub_impact){.start = (double)i,
                                      .impulse = 0.5 * (double)i,
                                      .impulse_tangential = {0.0, 11.0},
                                      .slip_before = {12.0, 0.0},
                                      .slip_after = {NAN, NAN},
                                      .friction_state = PERCUSS_FRICTION_STATE_STUCK};
    for (size_t i = 0; i < count; i++) {
        struct solve_contact_result *contact = &result->contacts[i];
        contact->impulse = 1.0 + (double)i;
        contact->restitution = 0.5;
        contact->sub_impact_count = listed + 1000;
        contact->sub_impacts_listed = listed;
        contact->sub_impacts = list;
        sample_friction(contact);
        struct solve_body_result *body = &result->bodies[i];
        memset(body->id, 'b', PERCUSS_ID_SIZE - 1);
        body->velocity[0] = (double)i;
        body->vibration = 0.125 * (double)i;
        body->modes = 12;
        body->theory = "euler-bernoulli";
    }
    result->velocities_known = true;
    result->complete = true;
    result->end_reason = PERCUSS_END_HANDED_BACK;
    result->warning_count = 2;
    snprintf(result->warnings[0], sizeof result->warnings[0], "mind the gap");
    snprintf(result->warnings[1], sizeof result->warnings[1], "mind the step");
    snprintf(result->reason, sizeof result->reason, "because");
    result->energy.available = 4.0;
    result->energy.friction = 0.25;
    return result;
}

static const char sample_tokens[PERCUSS_MAX_BODIES][PERCUSS_ID_SIZE] = {
    "0123456789abcdef0123456789abcdef", ""};

#endif
