/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Passes over undamped modes and sums (kernel.h) for a VECTOR of WIDTH lanes: kernel.c includes
 * this once for each width. Lanes have sums of their own and are added in the order of simd.h, so
 * that every width gives the same bits. */

#define PARTS            (LANES / WIDTH)
#define PART(array, k)   (*(const VECTOR *)((array) + (k)))
#define PUT(array, k, x) (*(VECTOR *)((array) + (k)) = (x))
/* A term of modes that lie together, see step_table.h. */
#define TERM(at, t) PART(at, (t)*LANES)

#define KICK(at, force, p, q, v)                                                                   \
    do {                                                                                           \
        (q) += (p) * (TERM(at, MIDDLE_KICK_Q) * (force).odd[0] +                                   \
                      TERM(at, MIDDLE_KICK_Q + 1) * (force).odd[1]);                               \
        (v) += (p) * (TERM(at, MIDDLE_KICK_V) * (force).even[0] +                                  \
                      TERM(at, MIDDLE_KICK_V + 1) * (force).even[1]);                              \
    } while (0)

#define TURN(at, turn, q, v)                                                                       \
    do {                                                                                           \
        VECTOR turned = TERM(at, turn) * (q) + TERM(at, (turn) + 1) * (v);                         \
        (v) = TERM(at, (turn) + 2) * (q) + TERM(at, turn) * (v);                                   \
        (q) = turned;                                                                              \
    } while (0)

/* Adds part p of the lanes to the sums of the nodes' pairs, from the middle of the step. */
#define SWING(at, p, pq, pv)                                                                       \
    do {                                                                                           \
        c0[p] += TERM(at, MIDDLE_COSINE) * (pq);                                                   \
        c1[p] += TERM(at, MIDDLE_COSINE + 1) * (pq);                                               \
        s0[p] += TERM(at, MIDDLE_SINE) * (pv);                                                     \
        s1[p] += TERM(at, MIDDLE_SINE + 1) * (pv);                                                 \
    } while (0)

#define SWING_END(at, p, pq, pv)                                                                   \
    (end[p] += TERM(at, TURN_HALF) * (pq) + TERM(at, TURN_HALF + 1) * (pv))

/* Adds up the sums of the lanes. */
#define ADD_UP(sums)                                                                               \
    do {                                                                                           \
        half last = FOLD(end);                                                                     \
        add_up(FOLD_BOTH(FOLD(c0), FOLD(c1)), FOLD_BOTH(FOLD(s0), FOLD(s1)), last[0] + last[1],    \
               sums);                                                                              \
    } while (0)

PASS_UNIT __attribute__((always_inline)) static inline void
PASS(turn_by)(const double *middle, enum middle_term turn, double way, size_t length,
              const double *const state[2], double *const to[2])
{
    for (size_t k = 0; k < length; k += LANES, middle += LANES * MIDDLE_TERMS) {
#pragma GCC unroll 2
        for (size_t at = 0; at < LANES; at += WIDTH) {
            VECTOR q = PART(state[0], k + at);
            VECTOR v = way * PART(state[1], k + at);
            TURN(middle + at, turn, q, v);
            PUT(to[0], k + at, q);
            PUT(to[1], k + at, way * v);
        }
    }
}

PASS_UNIT static void PASS(turn)(const double *middle, enum middle_term turn, double way,
                                 size_t length, const double *const state[2], double *const to[2])
{
    if (way > 0.0)
        PASS(turn_by)(middle, turn, 1.0, length, state, to);
    else
        PASS(turn_by)(middle, turn, -1.0, length, state, to);
}

PASS_UNIT static void PASS(kick)(const double *middle, size_t length, const double *phi,
                                 const double force[NODES], double *const state[2])
{
    struct pairs pairs = pair_up(force);
    for (size_t k = 0; k < length; k += LANES, middle += LANES * MIDDLE_TERMS) {
#pragma GCC unroll 2
        for (size_t at = 0; at < LANES; at += WIDTH) {
            VECTOR q = PART(state[0], k + at);
            VECTOR v = PART(state[1], k + at);
            KICK(middle + at, pairs, PART(phi, k + at), q, v);
            PUT(state[0], k + at, q);
            PUT(state[1], k + at, v);
        }
    }
}

PASS_UNIT static void PASS(swing)(const double *middle, size_t length, const double *phi,
                                  const double *const state[2], double sums[STEP_POINTS])
{
    VECTOR c0[PARTS] = {{0}}, c1[PARTS] = {{0}}, s0[PARTS] = {{0}}, s1[PARTS] = {{0}};
    VECTOR end[PARTS] = {{0}};
    for (size_t k = 0; k < length; k += LANES, middle += LANES * MIDDLE_TERMS) {
#pragma GCC unroll 2
        for (size_t p = 0; p < PARTS; p++) {
            const size_t at = p * WIDTH;
            VECTOR pq = PART(phi, k + at) * PART(state[0], k + at);
            VECTOR pv = PART(phi, k + at) * PART(state[1], k + at);
            SWING(middle + at, p, pq, pv);
            SWING_END(middle + at, p, pq, pv);
        }
    }
    ADD_UP(sums);
}

PASS_UNIT __attribute__((always_inline)) static inline void
PASS(carry_on)(const struct kernel_carry *carry, const bool ends, size_t length, const double *phi,
               double *const state[2], double sums[STEP_POINTS])
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
            VECTOR q = PART(q_to, k + at);
            VECTOR v = PART(v_to, k + at);
            KICK(from + at, pairs, PART(phi, k + at), q, v);
            TURN(from + at, carry->turn, q, v);
            PUT(q_to, k + at, q);
            PUT(v_to, k + at, v);
            q *= PART(phi, k + at);
            v *= PART(phi, k + at);
            SWING(next + at, p, q, v);
            if (ends)
                SWING_END(next + at, p, q, v);
        }
        from += LANES * MIDDLE_TERMS;
        next += LANES * MIDDLE_TERMS;
    }
    ADD_UP(sums);
}

PASS_UNIT static void PASS(carry)(const struct kernel_carry *carry, size_t length,
                                  const double *phi, double *const state[2],
                                  double sums[STEP_POINTS])
{
    if (carry->nodes_only)
        PASS(carry_on)(carry, false, length, phi, state, sums);
    else
        PASS(carry_on)(carry, true, length, phi, state, sums);
}

PASS_UNIT static void PASS(dot2)(size_t length, const double *a, const double *x, const double *y,
                                 double *ax, double *ay)
{
    VECTOR sx[PARTS] = {{0}}, sy[PARTS] = {{0}};
    for (size_t k = 0; k < length; k += LANES) {
#pragma GCC unroll 2
        for (size_t p = 0; p < PARTS; p++) {
            const size_t at = k + p * WIDTH;
            sx[p] += PART(a, at) * PART(x, at);
            sy[p] += PART(a, at) * PART(y, at);
        }
    }
    half both = FOLD_BOTH(FOLD(sx), FOLD(sy));
    *ax = both[0];
    *ay = both[1];
}

#undef PARTS
#undef PART
#undef PUT
#undef TERM
#undef KICK
#undef TURN
#undef SWING
#undef SWING_END
#undef ADD_UP
