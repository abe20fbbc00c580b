/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/beam_roots.h"

#include <float.h>
#include <math.h>

/* Roots with sin(k pi) waves: b^4 r^2 q^2 - b^2 (1 + k^2 pi^2 (r^2 + q^2)) + k^4 pi^4 = 0, the
 * smaller of the bending family, the larger of the shear family; its k = 0 is the cut-off. The
 * discriminant is written as a sum of squares. */
static double pinned_root(const struct beam_ratios *ratios, enum beam_family family, unsigned k)
{
    double square = (double)k * (double)k * M_PI * M_PI;
    double sum = 1.0 + square * (ratios->inertia + ratios->shear);
    double difference = square * (ratios->inertia - ratios->shear);
    double root =
        sqrt(1.0 + 2.0 * square * (ratios->inertia + ratios->shear) + difference * difference);
    double product = ratios->inertia * ratios->shear;

    if (family == BEAM_BENDING_FAMILY)
        return square * sqrt(2.0 / (sum + root));
    return product > 0.0 ? sqrt(0.5 * (sum + root) / product) : INFINITY;
}

static struct beam_pinned_walk pinned_start(const struct beam_ratios *ratios,
                                            enum beam_parity parity)
{
    struct beam_pinned_walk walk = {.ratios = *ratios, .parity = parity};

    walk.step = parity == BEAM_COUPLED ? 1 : 2;
    walk.wave_number[BEAM_BENDING_FAMILY] = parity == BEAM_ODD ? 2 : 1;
    walk.wave_number[BEAM_SHEAR_FAMILY] = parity == BEAM_EVEN ? 1 : 0;
    for (int i = 0; i < 2; i++)
        walk.next[i] = pinned_root(ratios, (enum beam_family)i, walk.wave_number[i]);
    return walk;
}

static struct beam_root pinned_next(struct beam_pinned_walk *walk)
{
    enum beam_family family = walk->next[BEAM_BENDING_FAMILY] <= walk->next[BEAM_SHEAR_FAMILY]
                                  ? BEAM_BENDING_FAMILY
                                  : BEAM_SHEAR_FAMILY;
    struct beam_root root = {walk->next[family], walk->parity, family};

    walk->wave_number[family] += walk->step;
    walk->next[family] = pinned_root(&walk->ratios, family, walk->wave_number[family]);
    return root;
}

static double minor_of(double rows[2][4], int i, int j)
{
    return rows[0][i] * rows[1][j] - rows[0][j] * rows[1][i];
}

/* Determinant of the end conditions; it changes sign at each root of the class and nowhere else (at
 * the cut-off it jumps by a positive factor). */
static double determinant(const struct beam_interlaced_walk *walk, double b)
{
    struct beam_wave wave = beam_wave_at(&walk->ratios, b);

    if (walk->parity != BEAM_COUPLED) {
        double rows[2][2];
        beam_wave_conditions(&wave, walk->supports[1], walk->parity, rows);
        return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
    }
    /* Laplace's expansion by the two rows of each end */
    double rows[4][4];
    beam_wave_coupled_conditions(&wave, walk->supports, rows);
    return minor_of(rows, 0, 1) * minor_of(rows + 2, 2, 3) -
           minor_of(rows, 0, 2) * minor_of(rows + 2, 1, 3) +
           minor_of(rows, 0, 3) * minor_of(rows + 2, 1, 2) +
           minor_of(rows, 1, 2) * minor_of(rows + 2, 0, 3) -
           minor_of(rows, 1, 3) * minor_of(rows + 2, 0, 2) +
           minor_of(rows, 2, 3) * minor_of(rows + 2, 0, 1);
}

/* The next step as a fraction of the way from the newest point a to the opposite bracket end b; c
 * is the point before. Inverse quadratic interpolation where it can be trusted, else halving
 * (Chandrupatla 1997, Adv. Eng. Softw. 28, 145). */
static double chandrupatla_step(const double x[3], const double f[3])
{
    double xi = (x[0] - x[1]) / (x[2] - x[1]);
    double phi = (f[0] - f[1]) / (f[2] - f[1]);

    if (!(phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi))
        return 0.5;
    return f[0] / (f[1] - f[0]) * f[2] / (f[1] - f[2]) +
           (x[2] - x[0]) / (x[1] - x[0]) * f[0] / (f[2] - f[0]) * f[1] / (f[2] - f[1]);
}

/* Root of the determinant between low and high, where it has the values f_low and f_high of
 * opposite signs, to the last bits. */
static double polish(const struct beam_interlaced_walk *walk, double low, double f_low, double high,
                     double f_high)
{
    /* x[0] the latest, x[1] across the root, x[2] the one before */
    double x[3] = {high, low, low};
    double f[3] = {f_high, f_low, f_low};
    double fraction = 0.5;

    for (int i = 0; i < 200; i++) {
        /* one step, which leaves the root between x[0] and x[1] */
        double next = x[0] + fraction * (x[1] - x[0]);
        double f_next = determinant(walk, next);
        bool same_side = signbit(f_next) == signbit(f[0]);
        x[2] = same_side ? x[0] : x[1];
        f[2] = same_side ? f[0] : f[1];
        if (!same_side) {
            x[1] = x[0];
            f[1] = f[0];
        }
        x[0] = next;
        f[0] = f_next;

        /* done at the last bits; else on, where Chandrupatla says */
        double best = fabs(f[0]) < fabs(f[1]) ? x[0] : x[1];
        double least = DBL_EPSILON * best / fabs(x[1] - x[0]);
        if (f_next == 0.0 || least > 0.5)
            return f_next == 0.0 ? next : best;
        fraction = fmin(fmax(chandrupatla_step(x, f), least), 1.0 - least);
    }
    return x[0];
}

/* The determinant's signs at the ends of a bracket are known from the number of roots below. Where
 * the computed one differs the end itself is the root but for rounding: two roots of the given
 * sequence are then so close that they clamp the one between them. */
static double interlaced_next(struct beam_interlaced_walk *walk, double high)
{
    double low = walk->low, f_low = walk->value, sign = walk->sign;
    double f_high = determinant(walk, high);

    walk->low = high;
    walk->value = f_high;
    walk->sign = -sign;
    if (f_low * sign <= 0.0)
        return low;
    if (f_high * sign >= 0.0)
        return high;
    return polish(walk, low, f_low, high, f_high);
}

/* `below` must be less than the first elastic root; it settles the sign of the determinant. */
static struct beam_interlaced_walk interlaced_start(const struct beam_ratios *ratios,
                                                    const enum support supports[2],
                                                    enum beam_parity parity, double low,
                                                    double below)
{
    struct beam_interlaced_walk walk = {
        .ratios = *ratios, .supports = {supports[0], supports[1]}, .parity = parity, .low = low};

    walk.value = determinant(&walk, low);
    walk.sign = signbit(determinant(&walk, below)) ? -1.0 : 1.0;
    return walk;
}

static struct beam_root class_next(struct beam_root_walk *walk, int kind)
{
    struct beam_root root = pinned_next(&walk->closed[kind]);

    if (walk->pinned)
        return root;
    root.family = BEAM_BOTH_FAMILIES;
    root.b = interlaced_next(&walk->interlaced[kind], root.b);
    if (walk->cantilever) /* root of the pinned-free beam: the upper neighbour */
        root.b = interlaced_next(&walk->interlaced[1], root.b);
    return root;
}

static void start_class(struct beam_root_walk *walk, const struct beam_ratios *ratios, int kind,
                        enum beam_parity parity)
{
    enum support supports[2] = {walk->cantilever ? SUPPORT_PINNED : walk->supports[0],
                                walk->supports[1]};

    walk->closed[kind] = pinned_start(ratios, parity);
    if (walk->pinned)
        return;
    /* the first root, of a rigid motion or lost to a clamp, is below the first pinned-pinned one */
    double first = pinned_next(&walk->closed[kind]).b;
    walk->interlaced[kind] = interlaced_start(ratios, supports, parity, first, 0.5 * first);
    if (walk->cantilever) /* its first root is some 0.4 of the first pinned-pinned one */
        walk->interlaced[1] =
            interlaced_start(ratios, walk->supports, parity, 1e-3 * first, 1e-3 * first);
}

void beam_root_walk_start(struct beam_root_walk *walk, const struct beam_ratios *ratios,
                          const enum support supports[2])
{
    *walk = (struct beam_root_walk){.supports = {supports[0], supports[1]}};
    walk->symmetric = supports[0] == supports[1];
    walk->pinned = walk->symmetric && supports[0] == SUPPORT_PINNED;
    walk->cantilever = supports[0] == SUPPORT_CLAMPED && supports[1] == SUPPORT_FREE;
    if (!walk->symmetric) {
        start_class(walk, ratios, 0, BEAM_COUPLED);
        return;
    }
    for (int kind = 0; kind < 2; kind++) {
        start_class(walk, ratios, kind, kind == 0 ? BEAM_EVEN : BEAM_ODD);
        walk->next[kind] = class_next(walk, kind);
    }
}

struct beam_root beam_root_walk_next(struct beam_root_walk *walk)
{
    if (!walk->symmetric)
        return class_next(walk, 0);

    int kind = walk->next[0].b <= walk->next[1].b ? 0 : 1;
    struct beam_root root = walk->next[kind];
    walk->next[kind] = class_next(walk, kind);
    return root;
}
