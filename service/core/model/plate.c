/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/plate.h"

#include <math.h>
#include <stdbool.h>

/* Modes along a side; a larger plate than REACH sqrt(bending wave's constant * duration) is as an
 * infinite one: waves do not come back in time. Then the modes end beyond FASTEST. */
enum { MODES = 32 };
static const double REACH = 8.0;
static const double FASTEST = 8.0; /* frequency times 2 duration */
/* Shear factor of a plate, and of a bar well enough. */
static const double SHEAR = 5.0 / 6.0;

/* Modes of a free bar along one side, and the coefficients of Warburton's frequencies of plates
 * (Proc. I. Mech. E. 168 (1954) 371; Leissa, NASA SP-160, chapter 4). */
struct side {
    double length;
    double shape[MODES];                 /* at the impact; mean square 1 */
    double g[MODES], h[MODES], j[MODES]; /* in pi/length and its square */
};

/* cosh(z)/cosh(end) or the same of sinh, |z| <= end. */
static double plate_hyperbolic(double z, double end, bool odd)
{
    double x = fabs(z), sign = odd ? -1.0 : 1.0;
    double ratio = exp(x - end) * (1.0 + sign * exp(-2.0 * x)) / (1.0 + sign * exp(-2.0 * end));
    return odd && z < 0.0 ? -ratio : ratio;
}

static double free_bar_shape(int mode, double place)
{
    if (mode == 0)
        return 1.0;
    if (mode == 1)
        return sqrt(12.0) * place;
    double k = (mode - 0.5) * M_PI, z = k * place, end = 0.5 * k;
    return mode % 2 ? sin(z) / sin(end) + plate_hyperbolic(z, end, true)
                    : cos(z) / cos(end) + plate_hyperbolic(z, end, false);
}

static void make_side(double length, double at, double reach, struct side *side)
{
    /* parts that waves do not reach count as infinite */
    double inside = fmax(0.5 * length - fabs(at), 0.0);
    side->length = fmin(length, reach);
    double place = 0.5 - fmin(inside / side->length, 0.5);
    for (int i = 0; i < MODES; i++) {
        double n = i - 0.5, square = n * n;
        side->shape[i] = free_bar_shape(i, place);
        side->g[i] = i < 2 ? 0.0 : i == 2 ? 1.506 : n;
        side->h[i] = i < 2 ? 0.0 : i == 2 ? 1.248 : square * (1.0 - 2.0 / (n * M_PI));
        side->j[i] = i == 0   ? 0.0
                     : i == 1 ? 12.0 / (M_PI * M_PI)
                     : i == 2 ? 5.017
                              : square * (1.0 + 6.0 / (n * M_PI));
    }
}

/* Square of a half sine's spectrum over its impulse, s being the frequency times twice its
 * duration; above its first zero the envelope. */
static double spectrum(double s)
{
    static const double FLAT = 0.32; /* at s = 1.5 */
    double away = 1.0 - s * s;
    if (s >= 1.5)
        return fmin(FLAT, 1.0 / (away * away));
    if (fabs(away) < 1e-6)
        return M_PI * M_PI / 16.0;
    double amplitude = cos(0.5 * M_PI * s) / away;
    return amplitude * amplitude;
}

/* Effects of the modes that bend the sides, times the mass: energy over the square of the impulse,
 * and the compliance of the faster modes. */
struct bending {
    double taken;
    double give; /* s^2 */
};

/* Sum over modes from number `first` across the second side: 0: all, 2: those that a bar lacks.
 * Sheared sections, Timoshenko's, make short waves slower: 1/omega^2 = 1/(bending k^2)^2 + 1/(shear
 * k)^2. */
static struct bending bending_sum(const struct side sides[2], int first, double poisson,
                                  const double waves[2], double duration)
{
    const struct side *x = &sides[0], *y = &sides[1];
    double a = M_PI / x->length, b = M_PI / y->length;
    struct bending sum = {0};
    for (int i = 0; i < MODES; i++)
        for (int j = first; j < MODES; j++) {
            double across = poisson * x->h[i] * y->h[j] + (1.0 - poisson) * x->j[i] * y->j[j];
            double fourth =
                pow(a * x->g[i], 4.0) + pow(b * y->g[j], 4.0) + 2.0 * a * a * b * b * across;
            if (!(fourth > 0.0)) /* rigid motions */
                continue;
            double slow = 1.0 / (waves[0] * waves[0] * fourth);
            double omega = 1.0 / sqrt(slow + 1.0 / (waves[1] * waves[1] * sqrt(fourth)));
            double s = omega * duration / M_PI;
            if (s > FASTEST && j > first + 1)
                break;
            double shape = x->shape[i] * y->shape[j];
            sum.taken += s > FASTEST ? 0.0 : shape * shape * spectrum(s);
            sum.give += s > 1.0 ? shape * shape / (omega * omega) : 0.0;
        }
    return sum;
}

/* A force on an end off the axis bends the bar along its height: its moment turns the end. */
static double eccentric_sum(const struct plate *plate, int side, double shear, double duration)
{
    double length = plate->height, thickness = plate->sides[side], lever = plate->at[side];
    double bending = thickness * sqrt(plate->material->young / (12.0 * plate->material->density));
    double sum = 0.0;
    for (int i = 2; i < MODES && length > thickness && lever != 0.0; i++) {
        double k = (i - 0.5) * M_PI / length;
        double slow = 1.0 / (bending * bending * k * k * k * k);
        double s = duration / M_PI / sqrt(slow + 1.0 / (shear * shear * k * k));
        double turn = 2.0 * k * lever / (1.0 + k * k * thickness * thickness / 12.0);
        sum += turn * turn * spectrum(s);
        if (s > FASTEST)
            break;
    }
    return sum;
}

/* The part of a plate that the waves of an impact reach: its sides and its mass. */
struct reach {
    struct side sides[2];
    double waves[2]; /* omega = bending k^2 of long waves, shear k of short ones */
    double mass;     /* kg */
};

static void reach_of(const struct plate *plate, double duration, struct reach *reach)
{
    const struct material *material = plate->material;
    double poisson = material->poisson;
    double speed = sqrt(material->young / material->density);
    double bending = plate->height * speed / sqrt(12.0 * (1.0 - poisson * poisson));
    reach->waves[0] = bending;
    reach->waves[1] = speed * sqrt(SHEAR / (2.0 * (1.0 + poisson)));
    reach->mass = plate->mass;
    for (int i = 0; i < 2; i++) {
        make_side(plate->sides[i], plate->at[i], REACH * sqrt(bending * duration),
                  &reach->sides[i]);
        reach->mass *= reach->sides[i].length / plate->sides[i];
    }
}

double plate_share(const struct plate *plate, double reduced, double duration)
{
    struct reach reach;
    reach_of(plate, duration, &reach);
    /* each mode takes half the square of its part in the impulse 2 mu v */
    double poisson = plate->material->poisson;
    double sum = bending_sum(reach.sides, 0, poisson, reach.waves, duration).taken / reach.mass;
    for (int i = 0; i < 2; i++)
        sum += eccentric_sum(plate, i, reach.waves[1], duration) / plate->mass;
    return 4.0 * reduced * sum;
}

struct plate_across plate_across_of(const struct plate *plate, double reduced, double duration)
{
    struct reach reach;
    reach_of(plate, duration, &reach);
    struct bending sum =
        bending_sum(reach.sides, 2, plate->material->poisson, reach.waves, duration);
    return (struct plate_across){.share = 4.0 * reduced * sum.taken / reach.mass,
                                 .compliance = sum.give / reach.mass};
}
