/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/flight_kernel.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "impact/simd.h"

typedef uint64_t bits __attribute__((vector_size(LANES * sizeof(uint64_t))));

VECTOR_CLONES void flight_kernel_bounds(const struct flight_modes *modes, double *reach,
                                        double *bend)
{
    size_t count = modes->length / LANES;
    double sum = 0.0;
    bend[0] = 0.0;
    for (size_t j = 0; j < count; j++) {
        size_t k = j * LANES;
        lanes w = AT(modes->omega, k);
        /* the smallest number changes no frequency but the padding's zeros */
        lanes x = AT(modes->phi, k) * AT(modes->q, k);
        lanes y = AT(modes->phi, k) * AT(modes->v, k) / (w + DBL_MIN);
        lanes a = x * x + y * y;
        for (int i = 0; i < LANES; i++)
            a[i] = sqrt(a[i]);
        /* times omega^SCAN_TERMS */
        lanes w2 = w * w;
        lanes w4 = w2 * w2;
        lanes bent = a * (w4 * w4);
        sum += TOTAL(bent);
        bend[j + 1] = sum;
        reach[j] = TOTAL(a);
    }
    reach[count] = 0.0;
    for (size_t j = count; j > 0; j--)
        reach[j - 1] += reach[j];
}

/* Powers of q and v that are summed at once: the baseline's registers hold no more. */
enum { AT_ONCE = 5 };

/* Sums by the equation of motion, from phi q and phi v times the scale. */
static inline void add_damped(const struct flight_modes *modes, double scale, int terms,
                              double *sums)
{
    lanes total[ROOT_TERMS] = {{0}};
    for (size_t k = 0; k < modes->length; k += LANES) {
        lanes angle = AT(modes->omega, k) * scale;
        lanes brake = -2.0 * AT(modes->damping, k) * angle;
        lanes spring = -(angle * angle);
        lanes now = AT(modes->phi, k) * AT(modes->q, k);
        lanes next = AT(modes->phi, k) * AT(modes->v, k) * scale;
#pragma GCC unroll 20
        for (int n = 0; n < terms; n++) {
            total[n] += now;
            lanes after = brake * next + spring * now;
            now = next;
            next = after;
        }
    }
    for (int n = 0; n < terms; n++)
        sums[n] += TOTAL(total[n]);
}

/* Undamped modes, for either width. */
#define SIMD_PASSES "impact/flight_passes.h"
#include "impact/simd_widths.h"

VECTOR_CLONES static void damped_derivatives(const struct flight_modes *modes,
                                             double sums[SCAN_TERMS])
{
    add_damped(modes, 1.0, SCAN_TERMS, sums);
}

VECTOR_CLONES static void damped_terms(const struct flight_modes *modes, double length,
                                       double sums[ROOT_TERMS])
{
    add_damped(modes, length, ROOT_TERMS, sums);
}

void flight_kernel_derivatives(const struct flight_modes *modes, double sums[SCAN_TERMS])
{
    if (modes->damping)
        damped_derivatives(modes, sums);
    else
        FOLD_EITHER(derivatives)(modes, sums);
}

void flight_kernel_terms(const struct flight_modes *modes, double length, double sums[ROOT_TERMS])
{
    if (modes->damping)
        damped_terms(modes, length, sums);
    else
        FOLD_EITHER(terms)(modes, length, sums);
}

/* pi/2 in three parts, of which the first two have 33 bits: times a whole number below 2^20 they
 * are exact (W. J. Cody, W. Waite, Software Manual for the Elementary Functions, 1980). */
static const double QUARTER[3] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};
const double FLIGHT_TURN_ANGLE = 0x1p20;

/* Adding this rounds to a whole number in the lowest bits. */
static const double ROUNDER = 0x1.8p52;

/* Taylor's terms beyond the second, of sin and cos up to pi/4: the first omitted is 2e-18. */
enum { CIRCLE_TERMS = 7 };
static const double SINE[CIRCLE_TERMS] = {
    -1.0 / 6.0,        1.0 / 120.0,        -1.0 / 5040.0,         1.0 / 362880.0,
    -1.0 / 39916800.0, 1.0 / 6227020800.0, -1.0 / 1307674368000.0};
static const double COSINE[CIRCLE_TERMS] = {
    1.0 / 24.0,        -1.0 / 720.0,         1.0 / 40320.0,         -1.0 / 3628800.0,
    1.0 / 479001600.0, -1.0 / 87178291200.0, 1.0 / 20922789888000.0};

static inline void circle(const lanes *angle, lanes *sine, lanes *cosine)
{
    /* the nearest quarter turn and the rest */
    lanes shifted = *angle * M_2_PI + ROUNDER;
    lanes turns = shifted - ROUNDER;
    lanes r = ((*angle - turns * QUARTER[0]) - turns * QUARTER[1]) - turns * QUARTER[2];
    bits quadrant = (bits)shifted;
    /* its sine and cosine */
    lanes z = r * r;
    lanes s = z * SINE[CIRCLE_TERMS - 1];
    lanes c = z * COSINE[CIRCLE_TERMS - 1];
    for (int n = CIRCLE_TERMS - 2; n > 0; n--) {
        s = (s + SINE[n]) * z;
        c = (c + COSINE[n]) * z;
    }
    s = r + r * ((s + SINE[0]) * z);
    c = 1.0 + ((c + COSINE[0]) * z - 0.5) * z;
    /* turned by quarters: swapped in every second quadrant, signs by halves */
    bits swap = -(quadrant & 1);
    bits new_sine = ((bits)s & ~swap) | ((bits)c & swap);
    bits new_cosine = ((bits)c & ~swap) | ((bits)s & swap);
    *sine = (lanes)(new_sine ^ ((quadrant & 2) << 62));
    *cosine = (lanes)(new_cosine ^ (((quadrant + 1) & 2) << 62));
}

/* ln 2 in two parts, the first of 32 bits. */
static const double LOG_2[2] = {0x1.62e42feep-1, 0x1.a39ef35793c76p-33};
/* Beyond this decay exponent a mode is 0. */
static const double DECAYED = 700.0;
/* Taylor's terms beyond the first of exp up to ln(2)/2: the first omitted is 4e-18. */
enum { DECAY_TERMS = 13 };
static const double DECAY[DECAY_TERMS] = {1.0,
                                          1.0 / 2.0,
                                          1.0 / 6.0,
                                          1.0 / 24.0,
                                          1.0 / 120.0,
                                          1.0 / 720.0,
                                          1.0 / 5040.0,
                                          1.0 / 40320.0,
                                          1.0 / 362880.0,
                                          1.0 / 3628800.0,
                                          1.0 / 39916800.0,
                                          1.0 / 479001600.0,
                                          1.0 / 6227020800.0};

static const lanes UNIT = {1.0, 1.0, 1.0, 1.0};

/* exp(-x) and 1 - exp(-x), x >= 0. */
static inline void decay(const lanes *x, lanes *left, lanes *lost)
{
    bits beyond = (bits)(*x > DECAYED);
    lanes y = -(lanes)((bits)*x & ~beyond);
    /* the nearest power of two and the rest */
    lanes shifted = y * M_LOG2E + ROUNDER;
    lanes power = shifted - ROUNDER;
    lanes r = (y - power * LOG_2[0]) - power * LOG_2[1];
    lanes sum = r * DECAY[DECAY_TERMS - 1];
    for (int n = DECAY_TERMS - 2; n >= 0; n--)
        sum = (sum + DECAY[n]) * r;
    /* times the power 2^k; the sum is exp(r) - 1 */
    lanes one = (lanes)(((bits)UNIT + ((bits)shifted << 52)) & ~beyond);
    *left = one + one * sum;
    *lost = (1.0 - one) - one * sum;
}

/* sqrt(1 - zeta^2) */
static inline void slow_down(const lanes *damping, lanes *slower)
{
    lanes square = (1.0 - *damping) * (1.0 + *damping);
    for (int i = 0; i < LANES; i++)
        square[i] = sqrt(square[i]);
    *slower = square;
}

/* The map of a free motion. */
struct turn {
    lanes qq, qv, vq, vv;
};

/* With s, c of the damped frequency and the ratio r = zeta/sqrt(1 - zeta^2):
 *
 *   q(t) = e^(-zeta omega t) ((c + r s) q + s/(omega sqrt(1 - zeta^2)) v)
 *   v(t) = e^(-zeta omega t) ((c - r s) v - omega/sqrt(1 - zeta^2) s q) */
static inline void make_turn(const struct flight_modes *modes, size_t k, double time,
                             struct turn *turn)
{
    lanes w = AT(modes->omega, k);
    lanes angle = w * time;
    lanes s;
    lanes c;
    lanes lag = {0};
    if (modes->damping) {
        /* lower frequency, decay */
        lanes zeta = AT(modes->damping, k);
        lanes slower;
        lanes left;
        lanes lost;
        lanes braked = angle * zeta;
        slow_down(&zeta, &slower);
        decay(&braked, &left, &lost);
        angle *= slower;
        circle(&angle, &s, &c);
        c *= left;
        s *= left / slower;
        lag = zeta * s;
    } else {
        circle(&angle, &s, &c);
    }
    turn->qq = c + lag;
    turn->vv = c - lag;
    turn->qv = s / (w + DBL_MIN);
    turn->vq = -(s * w);
}

static inline void apply_turn(const struct turn *turn, const struct flight_modes *modes, size_t k,
                              double *q, double *v)
{
    lanes before = AT(modes->q, k);
    lanes rate = AT(modes->v, k);
    *(lanes *)(q + k) = turn->qq * before + turn->qv * rate;
    *(lanes *)(v + k) = turn->vq * before + turn->vv * rate;
}

VECTOR_CLONES void flight_kernel_turn(const struct flight_modes *modes, double time, double *q,
                                      double *v)
{
    for (size_t k = 0; k < modes->length; k += LANES) {
        struct turn turn;
        make_turn(modes, k, time, &turn);
        apply_turn(&turn, modes, k, q, v);
    }
}

VECTOR_CLONES void flight_kernel_table(const struct flight_modes *modes, double time, double *table)
{
    struct turn *turn = (struct turn *)table;
    for (size_t k = 0; k < modes->length; k += LANES)
        make_turn(modes, k, time, turn++);
}

void flight_kernel_step(const double *table, const struct flight_modes *modes, double *q, double *v)
{
    FOLD_EITHER(step)(table, modes, q, v);
}

/* The damper takes 2 zeta omega int v^2 dt; with v = Re(V e^(lambda t)), V = v + i u, u = (zeta v +
 * omega q)/sqrt(1 - zeta^2),
 *
 *   2 v^2 = |V|^2 e^(2 Re(lambda) t) + Re(V^2 e^(2 lambda t))
 *
 * and 1/(2 lambda) = (-zeta - i sqrt(1 - zeta^2))/(2 omega). */
VECTOR_CLONES double flight_kernel_loss(const struct flight_modes *modes, double time)
{
    lanes total = {0};
    for (size_t k = 0; k < modes->length; k += LANES) {
        lanes zeta = AT(modes->damping, k);
        lanes slower;
        slow_down(&zeta, &slower);
        lanes angle = AT(modes->omega, k) * time;
        lanes slowed = angle * slower;
        lanes braked = 2.0 * angle * zeta;
        lanes s;
        lanes c;
        lanes left;
        lanes lost;
        circle(&slowed, &s, &c);
        decay(&braked, &left, &lost);
        /* e^(2 lambda t) - 1, without cancellation in a short time */
        lanes swing = -lost - 2.0 * left * s * s;
        lanes turn = 2.0 * left * s * c;
        /* V^2 times that, times -zeta - i sqrt(1 - zeta^2) */
        lanes x = AT(modes->v, k);
        lanes y = (zeta * x + AT(modes->omega, k) * AT(modes->q, k)) / slower;
        lanes square = x * x - y * y;
        lanes cross = 2.0 * x * y;
        lanes both =
            slower * (square * turn + cross * swing) - zeta * (square * swing - cross * turn);
        total += (x * x + y * y) * lost + zeta * both;
    }
    return 0.5 * TOTAL(total);
}

const double *flight_table(struct oscillators *set, int level)
{
    if (!set->turns[level]) {
        struct flight_modes modes = {.length = set->stride,
                                     .damping = set->most_damping > 0.0 ? set->damping : NULL,
                                     .omega = set->omega};
        const size_t bytes = (set->stride + LANES) * TURN_TERMS * sizeof(double);
        double *table = aligned_alloc(32, bytes);
        if (!table)
            return NULL;
        set->bytes += bytes;
        flight_kernel_table(&modes, step_length(level), table);
        set->turns[level] = table;
    }
    return set->turns[level];
}
