/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Derivatives of undamped modes at a contact, and free motion by a table (flight_kernel.h), for
 * vectors of WIDTH lanes: flight_kernel.c includes this once for each width. Each lane has its own
 * sums, added in the order of simd.h, so that every width gives the same bits. */

#define PARTS          (LANES / WIDTH)
#define PART(array, k) (*(const VECTOR *)((array) + (k)))
/* sums[2 n] += sum_k phi_k q_k (-(scale omega_k)^2)^n, and sums[2 n + 1] the same of v times the
 * scale, for n from range[0] on, range[1] of them. */
PASS_UNIT __attribute__((always_inline)) static inline void
PASS(add_powers)(const struct flight_modes *modes, double scale, const int range[2], double *sums)
{
    VECTOR total[2 * AT_ONCE][PARTS] = {{{0}}};
#pragma GCC unroll 2
    for (size_t p = 0; p < PARTS; p++)
        for (size_t k = p * WIDTH; k < modes->length; k += LANES) {
            VECTOR angle = PART(modes->omega, k) * scale;
            VECTOR spring = -(angle * angle);
            VECTOR q = PART(modes->phi, k) * PART(modes->q, k);
            VECTOR v = PART(modes->phi, k) * PART(modes->v, k);
            if (range[0]) {
                VECTOR power = (spring * spring) * (spring * spring) * spring;
                q *= power;
                v *= power;
            }
#pragma GCC unroll 5
            for (int n = 0; n < range[1]; n++) {
                total[2 * n][p] += q;
                total[2 * n + 1][p] += v;
                if (n + 1 < range[1]) {
                    q *= spring;
                    v *= spring;
                }
            }
        }
    const half scales = {1.0, scale};
#pragma GCC unroll 5
    for (int n = 0; n < range[1]; n++) {
        double *sum = sums + 2 * (range[0] + n);
        half q = FOLD(total[2 * n]);
        half v = FOLD(total[2 * n + 1]);
        half both = scales * FOLD_BOTH(q, v);
        sum[0] += both[0];
        sum[1] += both[1];
    }
}

PASS_UNIT static void PASS(derivatives)(const struct flight_modes *modes, double sums[SCAN_TERMS])
{
    static const int HALF[2] = {0, SCAN_TERMS / 2};
    PASS(add_powers)(modes, 1.0, HALF, sums);
}

PASS_UNIT static void PASS(terms)(const struct flight_modes *modes, double length,
                                  double sums[ROOT_TERMS])
{
    static const int PARTS_OF[2][2] = {{0, AT_ONCE}, {AT_ONCE, AT_ONCE}};
    PASS(add_powers)(modes, length, PARTS_OF[0], sums);
    PASS(add_powers)(modes, length, PARTS_OF[1], sums);
}

/* Motion by struct turn. */
PASS_UNIT static void PASS(step)(const double *table, const struct flight_modes *modes, double *q,
                                 double *v)
{
    for (size_t k = 0; k < modes->length; k += LANES, table += LANES * TURN_TERMS) {
#pragma GCC unroll 2
        for (size_t at = 0; at < LANES; at += WIDTH) {
            VECTOR before = PART(modes->q, k + at);
            VECTOR rate = PART(modes->v, k + at);
            VECTOR after = PART(table, at) * before + PART(table, at + LANES) * rate;
            VECTOR then = PART(table, at + 2 * LANES) * before + PART(table, at + 3 * LANES) * rate;
            *(VECTOR *)(q + k + at) = after;
            *(VECTOR *)(v + k + at) = then;
        }
    }
}

#undef PARTS
#undef PART
