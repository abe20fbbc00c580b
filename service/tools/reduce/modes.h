/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The motions of a mesh as a whole that its supports allow, and its lowest modes, their number
 * confirmed by Sylvester's law of inertia. */
#ifndef PERCUSS_REDUCE_MODES_H
#define PERCUSS_REDUCE_MODES_H

#include <stdint.h>

#include "base/watch.h"
#include "mesh/bulk.h"
#include "mesh/matrices.h"
#include "numeric/dense.h"
#include "reduce/factor.h"
#include "reduce/rates.h"

enum { RIGID_MOST = 6 };

/* A square of a frequency (1/s^2) near that of the first elastic mode of a free body, from its
 * size, slenderness and stiffest material: good to a factor of a few. */
double rigid_modes_scale(const struct solid_mesh *mesh, const struct bulk *bulk);

/* M-orthonormal vectors that K does not resist, at most six, [count][3 node_count]; `scale` as
 * above sets the limit of no resistance. The vectors are the caller's to free. PERCUSS_INTERNAL
 * without memory. */
enum percuss_status rigid_modes_make(const struct solid_mesh *mesh, const struct matrices *matrices,
                                     double scale, size_t *count, double **vectors,
                                     struct fault *fault);

/* Owns its arrays. */
struct modes {
    size_t n;       /* degrees of freedom, see mesh/matrices.h */
    size_t count;   /* elastic modes */
    double *omega;  /* [count], rad/s, ascending */
    double *shapes; /* [count][n], M-orthonormal, orthogonal to rigid motions */
    double shift;   /* 1/s^2, of the factor: far below the first mode, for statics too */
    double doubt;   /* largest |x^T M y - (1 if x is y)| of all rigid motions and modes */
    /* by inertia so many modes, of which these are the first, lie below this frequency */
    size_t confirmed;
    double confirmed_below; /* rad/s */
    bool counted_ahead;     /* by a copy of the process, while the modes were sought */
};

/* The wanted modes and their matrices. All is borrowed. */
struct modes_task {
    const struct matrices *matrices;
    struct dense rigid;        /* M-orthonormal, see rigid_modes_make */
    double scale;              /* 1/s^2, about the square of the first frequency */
    double below;              /* rad/s: all modes below; INFINITY: no limit ... */
    size_t most;               /* ... but at most so many */
    size_t known;              /* modes below, once modes_count has counted; SIZE_MAX: it has not */
    bool two_factors;          /* there is memory for two at a time, so that none is made twice */
    size_t processes;          /* see forked.h: a second one counts while the first seeks modes */
    const struct watch *watch; /* told the part done; NULL: no watch */
};

/* Memory and time of the search, known from the order of unknowns alone. */
struct modes_cost {
    double memory;   /* bytes at the peak */
    double together; /* bytes with two factors, see modes_task */
    double seconds;  /* at these rates: to a factor of two or so */
};
struct modes_cost modes_cost(const struct factor_cost *cost, const struct rates *rates,
                             const struct matrices *matrices, size_t count);

/* Elastic modes below a frequency (rad/s), by inertia: takes a factor, in the order of `like`
 * (factor_analyse; NULL: in one of its own). Errors as below. */
enum percuss_status modes_count(const struct modes_task *task, double omega,
                                const struct factor *like, size_t *count, struct fault *fault);

/* Frequencies within 1e-3 stay together where `most` would cut between them: then there are a few
 * modes more, or fewer. `*factor`, analysed as positive or NULL, becomes that of K + shift M, for
 * later use: the caller's to free. PERCUSS_TIMEOUT: the watch stopped it; PERCUSS_BAD_REQUEST: the
 * mesh has fewer modes, or its matrices are not those of a body; PERCUSS_INTERNAL without memory,
 * or when the number of modes is not confirmed however often they are sought. */
enum percuss_status modes_find(const struct modes_task *task, struct modes *modes,
                               struct factor **factor, struct fault *fault);

void modes_free(struct modes *modes);

#endif
