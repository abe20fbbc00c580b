/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Passes over undamped modes that sum what they do at the nodes (kernel.h), for vectors of WIDTH
 * lanes: kernel.c, whose macros these are, includes this once for each width. Lanes have sums of
 * their own and are added in the order of fold.h, so that every width gives the same bits. */

#define PARTS (LANES / WIDTH)

/* Part p of the lanes, at the middle of the step. */
#define SWING(at, p, pq, pv)                                                                       \
    do {                                                                                           \
        c0[p] += TERM(at, MIDDLE_COSINE) * (pq);                                                   \
        c1[p] += TERM(at, MIDDLE_COSINE + 1) * (pq);                                               \
        s0[p] += TERM(at, MIDDLE_SINE) * (pv);                                                     \
        s1[p] += TERM(at, MIDDLE_SINE + 1) * (pv);                                                 \
        end[p] += TERM(at, TURN_HALF) * (pq) + TERM(at, TURN_HALF + 1) * (pv);                     \
    } while (0)

/* What the lanes' sums come to. */
#define ADD_UP(sums)                                                                               \
    do {                                                                                           \
        half last = FOLD(end);                                                                     \
        add_up(FOLD_BOTH(FOLD(c0), FOLD(c1)), FOLD_BOTH(FOLD(s0), FOLD(s1)), last[0] + last[1],    \
               sums);                                                                              \
    } while (0)

SUMS_UNIT static void SUMS(swing)(const double *middle, size_t length, const double *phi,
                                  const double *const state[2], double sums[STEP_POINTS])
{
    VECTOR c0[PARTS] = {{0}}, c1[PARTS] = {{0}}, s0[PARTS] = {{0}}, s1[PARTS] = {{0}};
    VECTOR end[PARTS] = {{0}};
    for (size_t k = 0; k < length; k += LANES, middle += LANES * MIDDLE_TERMS) {
#pragma GCC unroll 2
        for (size_t p = 0; p < PARTS; p++) {
            const size_t at = p * WIDTH;
            VECTOR pq = AT(phi, k + at) * AT(state[0], k + at);
            VECTOR pv = AT(phi, k + at) * AT(state[1], k + at);
            SWING(middle + at, p, pq, pv);
        }
    }
    ADD_UP(sums);
}

SUMS_UNIT static void SUMS(carry)(const struct kernel_carry *carry, size_t length,
                                  const double *phi, double *const state[2],
                                  double sums[STEP_POINTS])
{
    const struct pairs pairs = pair_up(carry->force);
    const double *from = carry->from;
    const double *next = carry->next;
    double *const q_to = state[0];
    double *const v_to = state[1];
    VECTOR c0[PARTS] = {{0}}, c1[PARTS] = {{0}}, s0[PARTS] = {{0}}, s1[PARTS] = {{0}};
    VECTOR end[PARTS] = {{0}};
    for (size_t k = 0; k < length; k += LANES) {
#pragma GCC unroll 2
        for (size_t p = 0; p < PARTS; p++) {
            const size_t at = p * WIDTH;
            VECTOR q = AT(q_to, k + at);
            VECTOR v = AT(v_to, k + at);
            KICK(from + at, pairs, AT(phi, k + at), q, v);
            TURN(from + at, carry->turn, q, v);
            *(VECTOR *)(q_to + k + at) = q;
            *(VECTOR *)(v_to + k + at) = v;
            q *= AT(phi, k + at);
            v *= AT(phi, k + at);
            SWING(next + at, p, q, v);
        }
        from += LANES * MIDDLE_TERMS;
        next += LANES * MIDDLE_TERMS;
    }
    ADD_UP(sums);
}

#undef PARTS
#undef SWING
#undef ADD_UP
