/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "questions.h"

#include <math.h>
#include <string.h>

static const double SPHERE_RADIUS = 0.015; /* m, of the catalogue's steel sphere */

static const char *const names[QUESTION_COUNT] = {
    [QUESTION_PING] = "ping", [QUESTION_CHEAP] = "cheap",       [QUESTION_SLOW] = "slow",
    [QUESTION_LONG] = "long", [QUESTION_ENSEMBLE] = "ensemble",
};

enum question_kind question_find(const char *name)
{
    enum question_kind kind = 0;
    while (kind < QUESTION_COUNT && strcmp(names[kind], name) != 0)
        kind++;
    return kind;
}

const char *question_name(enum question_kind kind)
{
    return names[kind];
}

/* What the steel sphere strikes, from above or, `along` 0, end on. */
struct target {
    const char *body;
    int along;       /* axis of the blow */
    double distance; /* of the surface from the centre of mass, m */
    double speed;    /* m/s */
};

static const struct target targets[QUESTION_COUNT] = {
    [QUESTION_CHEAP] = {"steel-sphere", 0, 0.015, 0.3},
    [QUESTION_SLOW] = {"al-beam", 2, 0.010, 3.0},
    [QUESTION_LONG] = {"steel-sphere", 0, 0.015, 0.3},
    [QUESTION_ENSEMBLE] = {"al-rod", 0, 0.5, 0.3},
};

static void strike(const struct target *target, double speed, struct percuss_request *request)
{
    percuss_request_init(request);
    struct percuss_body_motion *sphere = percuss_request_add_body(request, "steel-sphere");
    percuss_request_add_body(request, target->body);
    struct percuss_contact *contact = percuss_request_add_contact(request, 0, 1);
    contact->point[target->along] = target->distance;
    contact->normal[target->along] = 1.0;
    sphere->position[target->along] = target->distance + SPHERE_RADIUS;
    sphere->velocity[target->along] = -speed;
}

/* Yields at 0.1 MPa: a long contact on a body that rings. */
static void soften(struct percuss_request *request)
{
    struct percuss_body_motion *soft = &request->bodies[1];
    soft->overrides[soft->override_count++] =
        (struct percuss_override){PERCUSS_PARAMETER_YIELD, 1e5};
    request->options.contact_model = PERCUSS_CONTACT_CLOSED_FORM;
    request->options.tolerance = 1e-6;
}

void question_fill(enum question_kind kind, unsigned long variation,
                   struct percuss_request *request)
{
    const struct target *target = &targets[kind];
    strike(target, target->speed * (1.0 + 1e-7 * (double)variation), request);
    if (kind == QUESTION_CHEAP)
        request->options.tolerance = 1e-4;
    if (kind == QUESTION_SLOW)
        soften(request);
    if (kind == QUESTION_LONG)
        request->options.method = PERCUSS_METHOD_CVODE;
}

static enum percuss_result ask_ensemble(struct percuss_client *client, unsigned long variation,
                                        unsigned long samples, double patience,
                                        enum percuss_status *status)
{
    static _Thread_local struct percuss_ensemble_request request;
    struct percuss_ensemble_reply reply;
    percuss_ensemble_request_init(&request);
    question_fill(QUESTION_ENSEMBLE, 0, &request.scene);
    request.samples = samples;
    request.seed = variation;
    struct percuss_input *speed = &request.inputs[request.input_count++];
    *speed = (struct percuss_input){.distribution = PERCUSS_DISTRIBUTION_UNIFORM,
                                    .first = 0.1,
                                    .second = 1.0,
                                    .lower = NAN,
                                    .upper = NAN};
    strcpy(speed->name, "speed");
    enum percuss_result result =
        percuss_solve_ensemble(client, &request, patience, NULL, NULL, &reply);
    if (result == PERCUSS_RESULT_OK)
        *status = reply.status;
    percuss_ensemble_reply_free(&reply);
    return result;
}

enum percuss_result question_ask(struct percuss_client *client, enum question_kind kind,
                                 unsigned long variation, unsigned long samples, double patience,
                                 enum percuss_status *status)
{
    static _Thread_local struct percuss_request request;
    struct percuss_reply reply;
    double seconds;
    *status = PERCUSS_OK;
    if (kind == QUESTION_PING)
        return percuss_ping(client, patience, &seconds);
    if (kind == QUESTION_ENSEMBLE)
        return ask_ensemble(client, variation, samples, patience, status);
    question_fill(kind, variation, &request);
    enum percuss_result result = percuss_solve(client, &request, patience, &reply);
    if (result == PERCUSS_RESULT_OK)
        *status = reply.status;
    percuss_reply_free(&reply);
    return result;
}
