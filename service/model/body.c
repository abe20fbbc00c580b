/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/body.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/beam.h"
#include "model/body_check.h"
#include "model/limits.h"
#include "model/torsion.h"

static const double pi = 3.14159265358979323846;

static void complete_sphere(struct body *body)
{
    double r = body->radius;
    body->mass = 4.0 / 3.0 * pi * r * r * r * body->material.density;
    for (int i = 0; i < 3; i++)
        body->inertia[i] = 0.4 * body->mass * r * r;
}

/* Rods and compact cylinders: a solid cylinder along x. A rod's caps are not counted. */
static void complete_cylinder(struct body *body)
{
    double r = body->radius, length = body->length;
    double area = pi * r * r;
    body->mass = body->material.density * area * length;
    body->inertia[0] = 0.5 * body->mass * r * r;
    body->inertia[1] = body->inertia[2] = body->mass * (3.0 * r * r + length * length) / 12.0;
    if (body->shape == SHAPE_ROD)
        body->area = area;
}

static void complete_block(struct body *body)
{
    const double *size = body->size;
    double x2 = size[0] * size[0], y2 = size[1] * size[1], z2 = size[2] * size[2];
    body->mass = body->material.density * size[0] * size[1] * size[2];
    body->inertia[0] = body->mass * (y2 + z2) / 12.0;
    body->inertia[1] = body->mass * (z2 + x2) / 12.0;
    body->inertia[2] = body->mass * (x2 + y2) / 12.0;
}

static void complete_half_space(struct body *body)
{
    body->mass = INFINITY;
    for (int i = 0; i < 3; i++)
        body->inertia[i] = INFINITY;
}

/* Sections: circle I = pi r^4/4; rectangle, deflection along y: height width^3/12. Rotation about y
 * goes with deflection along z. */
static void complete_beam(struct body *body)
{
    double length = body->length;
    double *second = body->second_moment;
    if (body->radius > 0.0) {
        double r2 = body->radius * body->radius;
        body->area = pi * r2;
        second[0] = second[1] = 0.25 * pi * r2 * r2;
    } else {
        double w = body->width, h = body->height;
        body->area = w * h;
        second[0] = h * w * w * w / 12.0;
        second[1] = w * h * h * h / 12.0;
    }
    body->mass = body->material.density * body->area * length;
    body->torsion_constant = torsion_constant(body);
    body->warping_constant = torsion_warping_constant(body);

    /* Euler-Bernoulli's sections carry no rotatory inertia in bending */
    bool rotatory = body->theory == THEORY_TIMOSHENKO;
    double slender = length * length / 12.0;
    body->inertia[0] = body->mass * (second[0] + second[1]) / body->area;
    body->inertia[1] = body->mass * (slender + (rotatory ? second[1] / body->area : 0.0));
    body->inertia[2] = body->mass * (slender + (rotatory ? second[0] / body->area : 0.0));
}

static void shear_factors(struct body *body)
{
    double poisson = body->material.poisson, w = body->width, h = body->height;
    bool round = body->radius > 0.0;
    double *factor = body->shear_factor;
    if (body->shear_rule == SHEAR_NUMBER) {
        factor[0] = factor[1] = body->shear_number;
    } else if (body->shear_rule == SHEAR_COWPER) {
        factor[0] = factor[1] =
            round ? beam_shear_cowper_circle(poisson) : beam_shear_cowper_rectangle(poisson);
    } else if (round) {
        factor[0] = factor[1] = beam_shear_hutchinson_circle(poisson);
    } else {
        factor[0] = beam_shear_hutchinson_rectangle(poisson, w, h);
        factor[1] = beam_shear_hutchinson_rectangle(poisson, h, w);
    }
}

static enum percuss_status complete_shear(struct body *body, struct fault *fault)
{
    static const char *const names[] = {"cowper", "hutchinson"};
    if (body->theory == THEORY_EULER_BERNOULLI)
        return PERCUSS_OK;
    shear_factors(body);
    const double *factor = body->shear_factor;
    if (limit_holds(&limit_shear_factor, factor[0]) && limit_holds(&limit_shear_factor, factor[1]))
        return PERCUSS_OK;
    if (body->shear_rule == SHEAR_NUMBER)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "shear_factor: %.9g: must be %s",
                         body->shear_number, limit_shear_factor.text);
    /* Hutchinson's quotient has a pole in the auxetic range, near poisson -0.79 for a circle */
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "shear_factor: %s: must be a number here: with poisson %.9g the rule gives "
                     "%.9g and %.9g, beyond 1e-3 to 2",
                     names[body->shear_rule], body->material.poisson, factor[0], factor[1]);
}

enum percuss_status body_complete(struct body *body, struct fault *fault)
{
    enum percuss_status status = body_check(body, fault);
    if (status)
        return status;
    body->area = 0.0;
    for (int plane = 0; plane < 2; plane++) {
        body->second_moment[plane] = 0.0;
        body->shear_factor[plane] = NAN;
    }
    switch (body->shape) {
    case SHAPE_SPHERE:
        complete_sphere(body);
        break;
    case SHAPE_ROD:
    case SHAPE_CYLINDER:
        complete_cylinder(body);
        break;
    case SHAPE_BEAM:
        complete_beam(body);
        return complete_shear(body, fault);
    case SHAPE_BLOCK:
        complete_block(body);
        break;
    case SHAPE_HALF_SPACE:
        complete_half_space(body);
        break;
    }
    return PERCUSS_OK;
}

bool body_is_flexible(const struct body *body)
{
    return body->shape == SHAPE_ROD || body->shape == SHAPE_BEAM;
}

double body_smallest_radius(const struct body *body)
{
    const double *size = body->size;
    double half_length = 0.5 * body->length;
    switch (body->shape) {
    case SHAPE_SPHERE:
        return body->radius;
    case SHAPE_ROD:
        return fmin(fmin(body->radius, body->tip_radius), half_length);
    case SHAPE_BEAM:
        return fmin(body->radius > 0.0 ? body->radius : 0.5 * fmin(body->width, body->height),
                    half_length);
    case SHAPE_CYLINDER:
        return fmin(body->radius, half_length);
    case SHAPE_BLOCK:
        return 0.5 * fmin(size[0], fmin(size[1], size[2]));
    case SHAPE_HALF_SPACE:
        break;
    }
    return INFINITY;
}

const char *shape_name(enum shape shape)
{
    static const char *const names[] = {"sphere", "rod", "beam", "cylinder", "block", "half-space"};
    return (size_t)shape < sizeof names / sizeof *names ? names[shape] : "?";
}

const struct body *body_set_find(const struct body_set *set, const char *id)
{
    for (size_t i = 0; i < set->count; i++)
        if (strcmp(set->bodies[i].id, id) == 0)
            return &set->bodies[i];
    return NULL;
}

void body_set_free(struct body_set *set)
{
    if (set)
        free(set->bodies);
    free(set);
}
