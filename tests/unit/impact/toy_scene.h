/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Small scenes of the fast scale made by hand: contacts, W, oscillators with any participation. */
#ifndef PERCUSS_TEST_TOY_SCENE_H
#define PERCUSS_TEST_TOY_SCENE_H

#include <string.h>

#include "check.h"
#include "impact/impact.h"

enum { TOY_CONTACTS = 12, TOY_GROUPS = 4 };

struct toy {
    struct scene scene;
    struct scene_group groups[TOY_GROUPS];
    double w[TOY_CONTACTS * TOY_CONTACTS];
    double residual[TOY_CONTACTS * TOY_CONTACTS];
    double gap[TOY_CONTACTS], gap_rate[TOY_CONTACTS], gap_acceleration[TOY_CONTACTS];
    struct contact_law laws[TOY_CONTACTS];
    struct arena arena;
};

/* W = identity, at rest, touching, Hertz contacts of unit stiffness; no oscillators yet. The toy
 * must stay where it is. */
static inline void toy_init(struct toy *toy, size_t contacts)
{
    memset(toy, 0, sizeof *toy);
    assert_true(contacts <= TOY_CONTACTS);
    for (size_t c = 0; c < contacts; c++) {
        toy->w[c * contacts + c] = 1.0;
        toy->laws[c] = contact_law_hertz(1.0);
    }
    toy->scene = (struct scene){
        .contacts = contacts,
        .rows = contacts,
        .bodies = 2,
        .w = toy->w,
        .residual = toy->residual,
        .gap = toy->gap,
        .gap_rate = toy->gap_rate,
        .gap_acceleration = toy->gap_acceleration,
        .laws = toy->laws,
        .group = toy->groups,
    };
}

/* An array of `count` numbers padded with zeros to the stride, in the toy's arena. */
static inline double *toy_array(struct toy *toy, size_t count, const double *values)
{
    size_t stride = (count + LANES - 1) / LANES * LANES;
    double *array = arena_take(&toy->arena, stride, sizeof *array);
    assert_non_null(array);
    if (values)
        memcpy(array, values, count * sizeof *array);
    return array;
}

/* Oscillators of one body; participation holds `count` numbers per row, row by row. */
static inline struct scene_group *toy_add(struct toy *toy, size_t body, size_t count,
                                          const double *omega, double damping,
                                          const double *participation)
{
    assert_true(toy->scene.groups < TOY_GROUPS);
    struct scene_group *group = &toy->groups[toy->scene.groups++];
    group->set = oscillators_create(count, omega, damping);
    assert_non_null(group->set);
    group->count = count;
    group->stride = group->set->stride;
    group->body = body;
    group->participation = arena_take(&toy->arena, toy->scene.rows, sizeof(double *));
    assert_non_null(group->participation);
    for (size_t c = 0; c < toy->scene.rows; c++)
        group->participation[c] = toy_array(toy, count, participation + c * count);
    return group;
}

static inline void toy_ring(struct toy *toy, struct scene_group *group, const double *q,
                            const double *v)
{
    group->q = toy_array(toy, group->count, q);
    group->v = toy_array(toy, group->count, v);
}

static inline void toy_free(struct toy *toy)
{
    for (size_t g = 0; g < toy->scene.groups; g++)
        oscillators_free(toy->groups[g].set);
    arena_release(&toy->arena);
}

/* Runs a method; the outcome lives in the toy's arena. */
static inline struct impact_outcome toy_solve(struct toy *toy, __typeof__(impact_modal) *method,
                                              double accuracy, double horizon)
{
    struct impact_outcome outcome;
    struct impact_settings settings = {.accuracy = accuracy, .horizon = horizon, .max_work = 1e12};
    assert_true(impact_create(&outcome, &toy->scene, &toy->arena));
    assert_int_equal(method(&toy->scene, &settings, &toy->arena, &outcome), PERCUSS_OK);
    return outcome;
}

static inline struct impact_outcome toy_run(struct toy *toy, double accuracy, double horizon)
{
    return toy_solve(toy, impact_modal, accuracy, horizon);
}

static inline struct impact_outcome toy_cvode(struct toy *toy, double accuracy, double horizon)
{
    return toy_solve(toy, impact_cvode, accuracy, horizon);
}

#endif
