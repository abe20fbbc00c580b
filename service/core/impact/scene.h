/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The fast scale's problem in its essential terms: n contacts, their rigid coupling W, and the
 * oscillators that the contacts can excite.
 *
 *   gap rate   g'' = W F + acceleration                       (rigid part)
 *   modes      q'' + 2 zeta omega q' + omega^2 q = sum_c participation_c F_c
 *   approach   d = -g - sum participation q                   (> 0: overlap but for indentation)
 *   law        F_i = law_i(d_i - sum_j residual_ij F_j)
 *
 * A row is a direction in which the bodies of a contact push each other: the normals of all
 * contacts first, then two tangents of each contact with friction. All equations but the law are
 * the same for both: of a tangent g is the displacement of body a's surface against b's, F the
 * force on a along it, and d < 0 its displacement. The tangential law is contact/friction.h, or of
 * plain friction impact/coulomb.h.
 */
#ifndef PERCUSS_IMPACT_SCENE_H
#define PERCUSS_IMPACT_SCENE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "contact/law.h"
#include "impact/step_table.h"

/* Oscillators of one body. Arrays are padded with zeros to `stride` and 32-byte aligned. */
struct scene_group {
    struct oscillators *set;      /* borrowed; at least `count` oscillators */
    size_t count, stride;         /* the first `count` take part */
    size_t body;                  /* index, for the energy's split */
    const double **participation; /* [row]: stride numbers, or NULL where all are zero */
    const double *q, *v;          /* stride numbers at the stated instant; NULL: at rest */
};

/* Friction of a contact. */
struct scene_friction {
    size_t contact;
    double coefficient; /* > 0 */
    double ratio[3];    /* tangential over normal stiffness, a tensor xx, xy, yy of its tangents */
};

struct scene {
    size_t contacts, groups, bodies;
    size_t rows;                           /* contacts + 2 frictions; those of friction[i] are
                                              scene_tangent(scene, i) and the next */
    size_t frictions;                      /* contacts with friction, */
    bool plain;                            /* all without the contact's own compliance */
    const double *w;                       /* rows^2, 1/kg */
    const double *residual;                /* rows^2, residual flexibility, m/N */
    const double *gap;                     /* [row], rigid, m */
    const double *gap_rate;                /* [row], rigid, m/s */
    const double *gap_acceleration;        /* [row], rigid, m/s^2 */
    const struct contact_law *laws;        /* [contact] */
    const struct scene_friction *friction; /* [frictions], ascending contacts */
    struct scene_group *group;             /* [groups] */
};

enum { SCENE_MOST_ROWS = 3 * PERCUSS_MAX_CONTACTS };

static inline void scene_set_frictions(struct scene *scene, size_t frictions)
{
    scene->frictions = frictions;
    scene->rows = scene->contacts + 2 * frictions;
}

static inline size_t scene_tangent(const struct scene *scene, size_t friction)
{
    return scene->contacts + 2 * friction;
}

/* The number of a contact's friction; scene->frictions: it has none. */
static inline size_t scene_friction_of(const struct scene *scene, size_t contact)
{
    size_t i = 0;
    while (i < scene->frictions && scene->friction[i].contact != contact)
        i++;
    return i;
}

/* Whether the law of any contact is lossy (contact/law.h). */
bool scene_is_lossy(const struct scene *scene);

/* The same scene without its tangents, as if it had no friction. Its matrices come from the arena,
 * all else from the scene. False: out of memory. */
bool scene_normals(const struct scene *scene, struct arena *arena, struct scene *normals);

/* Makes sure that the groups' tables of a level hold the oscillators that take part. OK, INTERNAL
 * without memory, or TIMEOUT where the pace stopped it. */
enum percuss_status scene_prepare(const struct scene *scene, int level, struct pace *pace);

/* The highest frequency that takes part, rad/s; 0 without oscillators. */
double scene_highest_frequency(const struct scene *scene);

/* The longest period that takes part, s; 0 without oscillators. */
double scene_longest_period(const struct scene *scene);

#endif
