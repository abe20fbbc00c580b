/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bodies that differ from the catalogue's in some parameters. */
#include <math.h>
#include <string.h>

#include "model/body.h"

/* Where the body holds it; NULL: a body of this shape has no such parameter. */
static double *find_parameter(struct body *body, unsigned parameter)
{
    /* of the material: every body has them */
    switch (parameter) {
    case PERCUSS_PARAMETER_YOUNG:
        return &body->material.young;
    case PERCUSS_PARAMETER_POISSON:
        return &body->material.poisson;
    case PERCUSS_PARAMETER_DENSITY:
        return &body->material.density;
    case PERCUSS_PARAMETER_YIELD:
        return &body->material.yield;
    case PERCUSS_PARAMETER_TANGENT:
        return &body->material.tangent;
    /* of the body: only some kinds */
    case PERCUSS_PARAMETER_DAMPING:
        return body_can_vibrate(body) ? &body->damping : NULL;
    case PERCUSS_PARAMETER_RADIUS:
        return body->radius > 0.0 ? &body->radius : NULL;
    case PERCUSS_PARAMETER_SCALE:
        return body->mesh ? &body->scale : NULL;
    default:
        return NULL;
    }
}

double body_parameter(const struct body *body, enum percuss_parameter parameter)
{
    struct body copy = *body;
    const double *value = find_parameter(&copy, parameter);
    return value ? *value : NAN;
}

enum percuss_status body_vary(const struct body *body, const struct body_variation *variations,
                              size_t count, struct body *varied, struct fault *fault)
{
    bool given[PERCUSS_PARAMETER_COUNT] = {false};
    *varied = *body;
    for (size_t i = 0; i < count; i++) {
        const struct body_variation *variation = &variations[i];
        const char *name = parameter_name(variation->parameter);
        double *parameter = find_parameter(varied, variation->parameter);
        if (!parameter)
            return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %g: a %s has no such parameter", name,
                             variation->value, body->kind->name);
        if (given[variation->parameter])
            return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %g: must be given once only", name,
                             variation->value);
        given[variation->parameter] = true;
        *parameter = variation->value;
    }
    varied->varied = count > 0;
    return body_complete(varied, fault);
}

bool body_same_modes(const struct body *a, const struct body *b)
{
    return strcmp(a->id, b->id) == 0 && a->material.young == b->material.young &&
           a->material.poisson == b->material.poisson &&
           a->material.density == b->material.density && a->radius == b->radius &&
           a->damping == b->damping && a->scale == b->scale && a->supports[0] == b->supports[0] &&
           a->supports[1] == b->supports[1];
}
