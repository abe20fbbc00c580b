/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Exact propagation of damped oscillators over a step on which the force is a cubic polynomial. The
 * coefficients depend on the frequency, the damping and the step only, so they are computed once
 * per step of a ladder h = 2^-level seconds and kept. */
#ifndef PERCUSS_IMPACT_STEP_TABLE_H
#define PERCUSS_IMPACT_STEP_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/watch.h"
#include "impact/collocation.h"

enum { LANES = 4 };

enum { RESPONSE_TERMS = STEP_POINTS * NODES };

enum { STEP_LEVELS = 72, LOSS_TERMS = (NODES + 2) * (NODES + 3) / 2 };

/* Undamped modes are carried through a contact from the middle of one step to the middle of the
 * next: the nodes lie in pairs at -x and +x around it, so that a pair takes two products of a mode
 * instead of four. c, s/omega and -s omega with c, s = cos, sin of omega t turn a state on by t. */
enum middle_term {
    MIDDLE_COSINE = 0, /* cos omega x of the outer and the inner nodes */
    MIDDLE_SINE = 2,   /* sin omega x / omega of them */
    MIDDLE_KICK_Q = 4, /* on q at the middle by the difference of the forces of a pair */
    MIDDLE_KICK_V = 6, /* on v there by their sum */
    TURN_HALF = 8,     /* turns: half a step, */
    TURN_WHOLE = 11,   /* to the middle of a step as long, */
    TURN_SHORTER = 14, /* half as long, */
    TURN_LONGER = 17,  /* and twice as long */
    MIDDLE_TERMS = 20
};

/* Arrays over the modes, padded to a multiple of LANES with zeros. q'' + 2 zeta omega q' + omega^2
 * q = f. */
struct step_table {
    double *node_q[NODES], *node_v[NODES];     /* q at node i = node_q q + node_v v + ... */
    double *end_qq, *end_qv, *end_vq, *end_vv; /* without force */
    double *force_q[NODES], *force_v[NODES];   /* on q, v at the end by the force at node j */
    double *response; /* [mode][RESPONSE_TERMS]: on q at node i, then at the end, by the force at
                         node j; at [i NODES + j] */
    double *loss[LOSS_TERMS]; /* 2 zeta omega int v^2 dt as a quadratic form of
                                 (q, v, f_1..f_4), lower triangle; damped only */
    double *middle;           /* undamped only: LANES modes together, LANES numbers of each term */
};

/* A set of oscillators with its tables. */
struct oscillators {
    size_t count, stride;                   /* stride: count rounded up to lanes */
    double most_damping;                    /* the largest ratio; 0: undamped */
    double *omega;                          /* ascending, rad/s; 0 beyond count */
    double *damping;                        /* ratio of each; 0 beyond count */
    struct step_table *tables[STEP_LEVELS]; /* made on first use, */
    size_t filled[STEP_LEVELS];             /* number of first oscillators in it */
    double *turns[STEP_LEVELS];             /* made on first use, see flight_kernel.h */
    struct oscillators *undamped;           /* the same frequencies; NULL: not made yet */
    struct oscillators *whole;              /* the set of which this is a part; NULL: none */
    size_t *which;                          /* [count] of a part: index in the whole */
    size_t bytes;                           /* of all this but `undamped` */
};

/* Copies the frequencies; with one damping ratio for all, or one of each. NULL: out of memory. */
struct oscillators *oscillators_create(size_t count, const double *omega, double damping);
struct oscillators *oscillators_create_each(size_t count, const double *omega,
                                            const double *damping);
void oscillators_free(struct oscillators *set);

/* Bytes that a set holds with its tables; NULL: 0. */
size_t oscillators_bytes(const struct oscillators *set);

/* Those of `whole` with the indices which[0 .. count - 1], ascending. Their tables have the same
 * bits, gathered from the whole's, which must outlive them. NULL: out of memory. */
struct oscillators *oscillators_part(struct oscillators *whole, const size_t *which, size_t count);

/* The same set without damping: `set` itself where it has none, else owned by it. NULL: out of
 * memory. */
struct oscillators *oscillators_undamped(struct oscillators *set);

/* The ladder uses the bits of a double: this is in the inner loop. */
union step_bits {
    double value;
    uint64_t bits;
};
enum { STEP_EXPONENT_BIT = 52, STEP_EXPONENT_OF_ONE = 1023 };

/* The step of a level, s: 2^-level. */
static inline double step_length(int level)
{
    union step_bits power = {.bits = (uint64_t)(STEP_EXPONENT_OF_ONE - level) << STEP_EXPONENT_BIT};
    return power.value;
}

/* The coarsest level with a step not longer than h >= 0; clamped to the ladder. */
static inline int step_level(double h)
{
    union step_bits length = {.value = h};
    int level = STEP_EXPONENT_OF_ONE - (int)(length.bits >> STEP_EXPONENT_BIT);
    return level < 0 ? 0 : level >= STEP_LEVELS ? STEP_LEVELS - 1 : level;
}

/* The table of a level, computed on first use. NULL: out of memory. */
const struct step_table *oscillators_table(struct oscillators *set, int level);

/* Makes sure that a level's table has the first `count`. Asks the pace before it fills them, which
 * takes milliseconds. INTERNAL: out of memory; TIMEOUT: the pace stopped it. */
enum percuss_status oscillators_prepare(struct oscillators *set, size_t count, int level,
                                        struct pace *pace);

#endif
