/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fitting.h"

#include <math.h>
#include <string.h>

const double FITTING_TOLERANCE = 1e-4;
/* A damping ratio of 0 has no size of its own to be measured by. */
static const double DAMPING_SIZE = 0.01;
static const double MOST_DAMPING = 0.9, LEAST_SHARE = 0.02;
/* An interval wider than this share of the value leaves the parameter open. */
static const double WIDE = 0.5;

/* The body of that id, NULL for one that the catalogue lacks, which the server refuses. */
static const struct percuss_body *find_body(const struct twin_question *question, const char *id)
{
    const struct percuss_body *const bodies[2] = {question->pair.a, question->pair.b};
    for (int i = 0; i < 2; i++)
        if (!strcmp(bodies[i]->id, id) && bodies[i]->mass > 0.0)
            return bodies[i];
    return NULL;
}

enum fitting_lack fitting_start(struct fitting *fitting, size_t *which)
{
    for (size_t i = 0; i < fitting->count; i++) {
        struct calibrate_parameter *parameter = &fitting->parameters[i];
        const struct percuss_body *body = find_body(fitting->question, parameter->body);
        *which = i;
        /* not every kind of body has every parameter */
        if (body && isnan(body->parameters[parameter->parameter]))
            return FITTING_LACKS_PARAMETER;
        if (isnan(parameter->start) && body)
            parameter->start = body->parameters[parameter->parameter];
        /* a factor cannot start from 0; damping has a size of its own */
        bool damping = parameter->parameter == PERCUSS_PARAMETER_DAMPING;
        if (body && (!isfinite(parameter->start) || (!damping && parameter->start == 0.0)))
            return FITTING_LACKS_START;
        parameter->size = damping ? fmax(DAMPING_SIZE, parameter->start) : parameter->start;
    }
    return FITTING_LACKS_NOTHING;
}

/* The parameter's value at the fit's number, which is 1 at the start. */
static double value_at(const struct calibrate_parameter *parameter, double x)
{
    if (parameter->parameter == PERCUSS_PARAMETER_DAMPING)
        /* even about 0, so that the fit may cross it */
        return fmin(MOST_DAMPING, fabs(parameter->start + (x - 1.0) * parameter->size));
    return parameter->start * fmax(x, LEAST_SHARE);
}

enum percuss_result fitting_ask(struct fitting *fitting, const double *x, double faster)
{
    struct twin_override overrides[2 * FIT_PARAMETERS];
    size_t count = 0;
    for (size_t i = 0; i < fitting->count; i++) {
        const struct calibrate_parameter *parameter = &fitting->parameters[i];
        const char *ids[2] = {fitting->question->pair.a->id, fitting->question->pair.b->id};
        for (unsigned body = 0; body < 2; body++)
            if (!strcmp(parameter->body, ids[body]))
                overrides[count++] =
                    (struct twin_override){body, {parameter->parameter, value_at(parameter, x[i])}};
    }
    const struct twin_changes changes = {overrides, count, faster};
    return twin_ask(fitting->question, fitting->set, &changes, &fitting->listener, fitting->list);
}

static bool simulate(void *context, const double *x, double faster, struct measured_impact *twins)
{
    struct fitting *fitting = context;
    fitting->result = fitting_ask(fitting, x, faster);
    for (size_t i = 0; fitting->result == PERCUSS_RESULT_OK && i < fitting->set->count; i++)
        twins[i] = fitting->list[i].impact;
    return fitting->result == PERCUSS_RESULT_OK;
}

bool fitting_solve(struct fitting *fitting, struct calibration *calibration)
{
    const struct calibration_problem problem = {
        .set = fitting->set,
        .parameters = fitting->count,
        .simulate = simulate,
        .context = fitting,
        .noise = fitting->noise,
    };
    /* 1: where each of them starts */
    *calibration = (struct calibration){0};
    for (size_t i = 0; i < fitting->count; i++)
        calibration->fit.x[i] = 1.0;
    if (!calibration_solve(&problem, calibration))
        return false;
    /* from multiples back to the parameters' units */
    for (size_t i = 0; i < fitting->count; i++) {
        struct calibrate_parameter *parameter = &fitting->parameters[i];
        parameter->value = value_at(parameter, calibration->fit.x[i]);
        parameter->half_width = parameter->size * calibration->fit.half_width[i];
    }
    return true;
}

bool fitting_determines(const struct calibrate_parameter *parameter)
{
    return parameter->half_width <= WIDE * fabs(parameter->value);
}
