/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The fast scale's problem in its essential terms: n contacts, their rigid coupling W, and the
 * oscillators that the contacts can excite.
 *
 *   gap rate   g'' = W F + acceleration                       (rigid part)
 *   modes      q'' + 2 zeta omega q' + omega^2 q = sum_c participation_c F_c
 *   approach   d = -g - sum participation q                   (> 0: overlap but for indentation)
 *   law        F_i = law_i(d_i - sum_j residual_ij F_j)
 */
#ifndef PERCUSS_IMPACT_SCENE_H
#define PERCUSS_IMPACT_SCENE_H

#include <stddef.h>

#include "contact/law.h"
#include "impact/step_table.h"

/* Oscillators of one body. Arrays are padded with zeros to `stride` and 32-byte aligned. */
struct scene_group {
    struct oscillators *set;      /* borrowed; at least `count` oscillators */
    size_t count, stride;         /* the first `count` take part */
    size_t body;                  /* index, for the energy's split */
    const double **participation; /* [contact]: stride numbers, or NULL where all are zero */
    const double *q, *v;          /* stride numbers at the stated instant; NULL: at rest */
};

struct scene {
    size_t contacts, groups, bodies;
    const double *w;                /* contacts^2, 1/kg */
    const double *residual;         /* contacts^2, residual flexibility, m/N */
    const double *gap;              /* rigid, m */
    const double *gap_rate;         /* rigid, m/s */
    const double *gap_acceleration; /* rigid, m/s^2 */
    const struct contact_law *laws; /* [contact] */
    struct scene_group *group;      /* [groups] */
};

/* Makes sure that the groups' tables of a level hold the oscillators that take part. OK, INTERNAL
 * without memory, or TIMEOUT where the pace stopped it. */
enum percuss_status scene_prepare(const struct scene *scene, int level, struct pace *pace);

/* The highest frequency that takes part, rad/s; 0 without oscillators. */
double scene_highest_frequency(const struct scene *scene);

/* The longest period that takes part, s; 0 without oscillators. */
double scene_longest_period(const struct scene *scene);

#endif
