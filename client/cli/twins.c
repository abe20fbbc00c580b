/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "twins.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Impacts asked for at once: a busy server is asked again for these only. */
enum { PORTION = 64, MOST_TRIES = 2000 };
static const double SIGNIFICANT = 0.01; /* share of the impulse */

int twins_open(struct twins *twins, const struct common *common, const struct scene *scene)
{
    *twins = (struct twins){.common = common, .scene = scene, .warnings.unit = "twins"};
    int code = open_client(common, NULL, &twins->client);
    if (code == EXIT_ANSWERED)
        code = scene_find_bodies(scene, common, twins->client, &twins->bodies);
    if (code != EXIT_ANSWERED)
        twins_close(twins);
    return code;
}

void twins_close(struct twins *twins)
{
    percuss_body_list_free(&twins->bodies.list);
    if (twins->client)
        percuss_client_free(twins->client);
    tally_clear(&twins->warnings);
    *twins = (struct twins){0};
}

static int make_request(const struct twins *twins, const struct measured_impact *impact,
                        const struct twin_override *overrides, size_t override_count,
                        struct percuss_request *request)
{
    struct scene_bodies bodies = twins->bodies;
    bool b_is_beam = !strcmp(bodies.pair.b->shape, "beam");
    if (!isnan(impact->at))
        *(b_is_beam ? &bodies.pair.at_b : &bodies.pair.at_a) = impact->at;
    int code = scene_request(twins->scene, &bodies, impact->speed, request);
    for (size_t i = 0; code == EXIT_ANSWERED && i < override_count; i++) {
        struct percuss_body_motion *body = &request->bodies[overrides[i].body];
        body->overrides[body->override_count++] = overrides[i].override;
    }
    return code;
}

/* What a reply says in the terms of a measurement. */
static struct twin twin_of(const struct percuss_reply *reply, double speed)
{
    struct twin twin = {.status = reply->status, .impact = measured_impact_unknown()};
    twin.impact.speed = speed;
    twin.a_is_rigid = reply->model.body_count > 0 && reply->model.bodies[0].rigid;
    if (reply->contact_count == 0)
        return twin;
    /* the impact as a whole */
    const struct percuss_contact_result *contact = &reply->contacts[0];
    twin.inverse_mass = contact->inverse_effective_mass;
    twin.impact.restitution = contact->restitution;
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

static int judge(const struct twins *twins, const struct percuss_request *request,
                 const struct percuss_reply *reply)
{
    int code = status_exit_code(reply->status);
    if (code == EXIT_ANSWERED || code == EXIT_ANSWERED_WITH_WARNING)
        return EXIT_ANSWERED;
    complain("%s: %s", percuss_status_name(reply->status), reply->message);
    if (reply->status == PERCUSS_UNKNOWN_BODY)
        scene_explain_unknown(request, &twins->bodies.list);
    return code;
}

static int take_warnings(struct twins *twins, const struct percuss_reply *reply, size_t index)
{
    char place[32];
    snprintf(place, sizeof place, "impact %zu", index + 1);
    if (tally_take(&twins->warnings, reply, place))
        return EXIT_ANSWERED;
    return complain_memory();
}

/* Solves a batch; a busy server is asked again. */
static int solve(struct twins *twins, const struct percuss_request *requests, size_t count,
                 struct percuss_reply *replies)
{
    for (int i = 0; i < MOST_TRIES; i++) {
        enum percuss_result result = percuss_solve_batch(twins->client, requests, count,
                                                         common_timeout(twins->common), replies);
        if (result != PERCUSS_RESULT_OK)
            return complain_result(result);
        if (replies[0].status != PERCUSS_BUSY)
            return EXIT_ANSWERED;
        for (size_t k = 0; k < count; k++)
            percuss_reply_free(&replies[k]);
        usleep(5000);
    }
    complain("the server stays busy");
    return EXIT_REJECTED;
}

int twins_ask(struct twins *twins, const struct measured_set *set,
              const struct twin_override *overrides, size_t override_count, double faster,
              struct twin *twin_list)
{
    struct percuss_request *requests = calloc(PORTION, sizeof *requests);
    struct percuss_reply replies[PORTION] = {0};
    int code = requests ? EXIT_ANSWERED : complain_memory();
    tally_clear(&twins->warnings);
    for (size_t first = 0; code == EXIT_ANSWERED && first < set->count; first += PORTION) {
        /* as many as one batch holds */
        size_t count = set->count - first < PORTION ? set->count - first : PORTION;
        for (size_t i = 0; code == EXIT_ANSWERED && i < count; i++) {
            struct measured_impact impact = set->impacts[first + i];
            impact.speed *= faster;
            code = make_request(twins, &impact, overrides, override_count, &requests[i]);
        }
        if (code == EXIT_ANSWERED)
            code = solve(twins, requests, count, replies);
        /* in order; what has come is freed after a failure, too */
        for (size_t i = 0; i < count; i++) {
            if (code == EXIT_ANSWERED)
                code = judge(twins, &requests[i], &replies[i]);
            if (code == EXIT_ANSWERED)
                code = take_warnings(twins, &replies[i], first + i);
            if (code == EXIT_ANSWERED)
                twin_list[first + i] = twin_of(&replies[i], set->impacts[first + i].speed);
            percuss_reply_free(&replies[i]);
        }
    }
    free(requests);
    return code;
}

int twins_complete(const struct twins *twins, struct measured_set *set,
                   const struct twin *twin_list)
{
    double mass = twins->bodies.pair.a->mass;
    for (size_t i = 0; i < set->count; i++) {
        struct measured_impact *impact = &set->impacts[i];
        if (!isnan(impact->momentum) && !twin_list[i].a_is_rigid) {
            complain("impact %zu: a history of %s does not tell the impulse, because it vibrates; "
                     "name the compact body with --a",
                     i + 1, twins->scene->a);
            return EXIT_USAGE;
        }
        measured_complete(impact, mass, twin_list[i].inverse_mass);
    }
    return EXIT_ANSWERED;
}
