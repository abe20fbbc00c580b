/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "twin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Impacts asked for at once: a busy server is asked again for these only. */
enum { PORTION = 64, MOST_TRIES = 2000 };
static const struct timespec PAUSE = {.tv_nsec = 5000000};
static const double SIGNIFICANT = 0.01; /* share of the impulse */

static enum percuss_result make_request(const struct twin_question *question,
                                        const struct measured_impact *impact,
                                        const struct twin_changes *changes,
                                        struct percuss_request *request)
{
    struct percuss_pair pair = question->pair;
    bool b_is_beam = !strcmp(pair.b->shape, "beam");
    if (!isnan(impact->at))
        *(b_is_beam ? &pair.at_b : &pair.at_a) = impact->at;
    pair.speed = impact->speed * changes->faster;
    enum percuss_result result = percuss_contact_pair(&pair, request);
    request->options = question->options;
    for (size_t i = 0; result == PERCUSS_RESULT_OK && i < changes->count; i++) {
        struct percuss_body_motion *body = &request->bodies[changes->overrides[i].body];
        body->overrides[body->override_count++] = changes->overrides[i].override;
    }
    return result;
}

/* A reply in the terms of a measurement. */
static struct twin twin_of(const struct percuss_reply *reply, double speed)
{
    struct twin twin = {
        .status = reply->status, .impact = measured_impact_unknown(), .error_total = NAN};
    twin.impact.speed = speed;
    twin.a_is_rigid = reply->model.body_count > 0 && reply->model.bodies[0].rigid;
    twin.b_is_rigid = reply->model.body_count > 1 && reply->model.bodies[1].rigid;
    if (reply->contact_count == 0)
        return twin;
    /* the impact as a whole */
    const struct percuss_contact_result *contact = &reply->contacts[0];
    twin.inverse_mass = contact->inverse_effective_mass;
    twin.impact.restitution = contact->restitution;
    /* a server of 0.1.0 knows no errors of models: 0 */
    if (reply->error.restitution_total > 0.0)
        twin.error_total = reply->error.restitution_total;
    twin.impact.impulse = contact->impulse;
    twin.impact.sub_impacts = contact->sub_impact_count;
    /* its first sub-impact, and when the next one begins that an instrument would see */
    const struct percuss_sub_impact *list = contact->sub_impacts;
    if (contact->sub_impacts_listed == 0)
        return twin;
    twin.impact.first_impulse = list[0].impulse;
    twin.impact.first_duration = list[0].end - list[0].start;
    for (uint32_t i = 1; i < contact->sub_impacts_listed && isnan(twin.impact.second_start); i++)
        if (list[i].impulse >= SIGNIFICANT * contact->impulse)
            twin.impact.second_start = list[i].start - list[0].start;
    return twin;
}

/* Solves a batch; a busy server is asked again, and one that stays so has answered. */
static enum percuss_result solve(const struct twin_question *question,
                                 const struct percuss_request *requests, size_t count,
                                 struct percuss_reply *replies)
{
    for (int tries = 1;; tries++) {
        enum percuss_result result =
            percuss_solve_batch(question->client, requests, count, question->timeout, replies);
        if (result != PERCUSS_RESULT_OK || replies[0].status != PERCUSS_BUSY || tries == MOST_TRIES)
            return result;
        for (size_t i = 0; i < count; i++)
            percuss_reply_free(&replies[i]);
        nanosleep(&PAUSE, NULL);
    }
}

enum percuss_result twin_ask(const struct twin_question *question, const struct measured_set *set,
                             const struct twin_changes *changes,
                             const struct twin_listener *listener, struct twin *list)
{
    struct percuss_request *requests = calloc(PORTION, sizeof *requests);
    struct percuss_reply replies[PORTION] = {0};
    enum percuss_result result = requests ? PERCUSS_RESULT_OK : PERCUSS_RESULT_NO_MEMORY;
    for (size_t first = 0; result == PERCUSS_RESULT_OK && first < set->count; first += PORTION) {
        /* as many as one batch holds */
        size_t count = set->count - first < PORTION ? set->count - first : PORTION;
        for (size_t i = 0; result == PERCUSS_RESULT_OK && i < count; i++)
            result = make_request(question, &set->impacts[first + i], changes, &requests[i]);
        if (result == PERCUSS_RESULT_OK)
            result = solve(question, requests, count, replies);
        /* in order; received replies are freed after a failure, too */
        for (size_t i = 0; i < count; i++) {
            if (result == PERCUSS_RESULT_OK &&
                !listener->take(listener->context, &requests[i], &replies[i], first + i))
                result = PERCUSS_RESULT_PENDING;
            if (result == PERCUSS_RESULT_OK)
                list[first + i] = twin_of(&replies[i], set->impacts[first + i].speed);
            percuss_reply_free(&replies[i]);
        }
    }
    free(requests);
    return result;
}

/* A wall has no mass that is known. */
static bool is_free(const struct percuss_body *body)
{
    return isfinite(body->mass) && body->supports[0] == PERCUSS_SUPPORT_FREE &&
           body->supports[1] == PERCUSS_SUPPORT_FREE;
}

size_t twin_complete(const struct twin_question *question, struct measured_set *set,
                     const struct twin *list)
{
    for (size_t i = 0; i < set->count; i++) {
        struct measured_impact *impact = &set->impacts[i];
        const bool of_b = impact->momentum_of_b == 1.0;
        const struct percuss_body *body = of_b ? question->pair.b : question->pair.a;
        const bool tells = of_b ? list[i].b_is_rigid && is_free(body) : list[i].a_is_rigid;
        if (!isnan(impact->momentum) && !tells)
            return i;
        measured_complete(impact, body->mass, list[i].inverse_mass);
    }
    return set->count;
}
