/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A wire reply with every array filled, for the tests of conversion. */
#ifndef PERCUSS_TESTS_WIRE_REPLY_H
#define PERCUSS_TESTS_WIRE_REPLY_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "percuss_wire.h"

/* Sets a sequence to a static array. */
#define FILL(sequence, array)                                                                      \
    do {                                                                                           \
        (sequence)._buffer = (array);                                                              \
        (sequence)._length = (sequence)._maximum = sizeof(array) / sizeof(array)[0];               \
    } while (0)

/* One contact with two sub-impacts, one without any. Valid until the next call. */
static inline percuss_v1_Reply wire_reply(void)
{
    static percuss_v1_SubImpact subs[2] = {
        {.start = 1, .compression_end = 2, .end = 3, .impulse = 4, .compression_impulse = 5},
        {.peak_force = 6,
         .max_indentation = 7,
         .gap_rate_before = 8,
         .gap_rate_after = 9,
         .impulse_tangential = {46, 47},
         .slip_before = {48, 49},
         .slip_after = {NAN, 50},
         .friction_state = percuss_v1_FRICTION_STATE_REVERSED},
    };
    static percuss_v1_ContactResult contacts[2] = {
        {.impulse = 10, .impulse_vector = {11, 12, 13}, .impulse_compression = 14},
        {.inverse_effective_mass = 15, .end_time = 16},
    };
    static percuss_v1_BodyVelocity velocities[1] = {
        {.id = "sphere", .velocity = {17, 18, 19}, .angular_velocity = {20, 21, 22}}};
    static percuss_v1_BodyState states[2] = {{.id = "sphere", .state = "t1"},
                                             {.id = "beam", .state = "t2"}};
    static percuss_v1_BodyEnergy vibration[1] = {{.id = "beam", .energy = 23}};
    static percuss_v1_BodyModel models[1] = {
        {.id = "beam", .modes = 24, .rigid = false, .theory = "timoshenko", .shear_factor = 0.89}};
    static char *warnings[2] = {"one", "another"};
    percuss_v1_Reply wire = {.sequence = 25,
                             .catalogue_revision = "r",
                             .version = "v",
                             .status = percuss_v1_STATUS_TRUNCATED,
                             .message = "m",
                             .complete = true,
                             .end_reason = percuss_v1_END_REASON_HORIZON,
                             .window = NAN,
                             .delassus_source = percuss_v1_DELASSUS_SOURCE_CLIENT,
                             .time_shift = 26,
                             .timing = {27, 28}};
    subs[1].negligible = true;
    contacts[0].restitution = 0.5;
    contacts[0].impulse_error = 43;
    contacts[0].friction = 0.3;
    contacts[0].tangent[1] = 1;
    contacts[0].impulse_tangential[0] = 51;
    contacts[0].impulse_tangential[1] = 52;
    contacts[0].impulse_tangential_error = 53;
    contacts[0].slip_before[0] = 54;
    contacts[0].slip_before[1] = NAN;
    contacts[0].slip_after[1] = 55;
    contacts[0].tangential_restitution = 56;
    contacts[0].restitution_kinematic = 57;
    contacts[0].restitution_energetic = NAN;
    contacts[0].friction_state = percuss_v1_FRICTION_STATE_PARTLY;
    velocities[0].velocity_error = 44;
    velocities[0].angular_velocity_error = 45;
    contacts[0].sub_impact_count = 300; /* more than are listed */
    contacts[1].restitution = NAN;
    FILL(contacts[0].sub_impacts, subs);
    FILL(wire.contacts, contacts);
    FILL(wire.velocity_after, velocities);
    FILL(wire.states_after, states);
    wire.energy = (percuss_v1_Energy){.available = 29,
                                      .rigid_after = 30,
                                      .damping = 31,
                                      .plastic = 32,
                                      .stored = 33,
                                      .closure = 34,
                                      .friction = 58};
    FILL(wire.energy.vibration, vibration);
    wire.error = (percuss_v1_ErrorEstimate){35, 36, 37, 38, NAN, true, 40, 41, true, 42, {NAN, 43}};
    FILL(wire.model.bodies, models);
    wire.model.contact_model = percuss_v1_CONTACT_MODEL_HERTZ;
    wire.model.compliance = percuss_v1_COMPLIANCE_HALF_SPACE;
    wire.model.method = percuss_v1_METHOD_CVODE;
    strcpy(wire.model.reason, "because");
    wire.model.omitted_error = 39;
    FILL(wire.warnings, warnings);
    for (uint8_t i = 0; i < 16; i++) {
        wire.client[i] = i;
        wire.server[i] = (uint8_t)(0xf0 + i);
    }
    return wire;
}

#endif
