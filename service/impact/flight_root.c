/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/flight_root.h"

#include <math.h>

#include "impact/kernel.h"

/* With x(t) = excess + rate t + acceleration t^2/2 and D = rate^2 - 2 acceleration excess, x has
 * the roots (-rate +- sqrt D)/acceleration, or -2 excess/(rate +- sqrt D), which does not cancel.
 */
void flight_root_exceeds(double excess, double rate, double acceleration, double *first,
                         double *last)
{
    *first = INFINITY;
    *last = INFINITY;
    if (acceleration >= 0.0) {
        double discriminant = rate * rate - 2.0 * acceleration * excess;
        /* opens, or turns before it falls below; otherwise at the later root */
        if (excess >= 0.0 && (rate >= 0.0 || (acceleration > 0.0 && discriminant < 0.0)))
            *first = 0.0;
        else if (acceleration > 0.0)
            *first = (sqrt(fmax(0.0, discriminant)) - rate) / acceleration;
        else if (rate > 0.0)
            *first = -excess / rate;
        return;
    }
    /* pressing: only on the way up, and only if the top of the way exceeds it */
    double discriminant = rate * rate - 2.0 * acceleration * excess;
    if (rate <= 0.0 || discriminant < 0.0)
        return;
    *first = excess >= 0.0 ? 0.0 : -2.0 * excess / (rate + sqrt(discriminant));
    *last = -rate / acceleration;
}

/* The approach at one contact along a free motion. */
struct path {
    const struct motion *motion;
    const struct scene *scene;
    size_t contact;
    double length;            /* s; > 0: a power series in t/length, good on [0, length] */
    double term[DERIVATIVES]; /* of that series, m */
};

/* omega t of the fastest mode up to which the series is exact to rounding: 0.5^16/16! = 7e-19. */
static const double SERIES_ANGLE = 0.5;

static bool is_slow(const struct scene *scene, double length)
{
    for (size_t g = 0; g < scene->groups; g++)
        if (scene->group[g].count &&
            scene->group[g].set->omega[scene->group[g].count - 1] * length > SERIES_ANGLE)
            return false;
    return true;
}

/* The path on [0, length] of the motion: d(t) = -sum_n (g^(n) + sum_k phi_k q_k^(n)) t^n/n!, where
 * the term n holds the powers of `length`. Beyond SERIES_ANGLE mode by mode, see follow. */
static struct path make_path(const struct motion *motion, const struct scene *scene, size_t contact,
                             double length)
{
    struct path path = {.motion = motion, .scene = scene, .contact = contact};
    if (!(length > 0.0) || !is_slow(scene, length))
        return path;
    /* derivatives of the gap and of the modes */
    double sums[DERIVATIVES] = {motion->gap[contact], motion->gap_rate[contact],
                                scene->gap_acceleration[contact]};
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        if (group->participation[contact])
            kernel_derivatives(group->stride, group->set->omega, group->set->damping,
                               group->participation[contact], motion->q[g], motion->v[g], sums);
    }
    /* as terms of the series */
    double scale = -1.0;
    path.length = length;
    for (int n = 0; n < DERIVATIVES; n++) {
        path.term[n] = scale * sums[n];
        scale *= length / (n + 1);
    }
    return path;
}

/* The approach and its rate at an instant of the path, by Horner's rule. */
static void follow(const struct path *path, double time, double *approach, double *rate)
{
    if (!(path->length > 0.0)) {
        motion_approach_at(path->motion, path->scene, path->contact, time, approach, rate);
        return;
    }
    double s = time / path->length;
    double value = 0.0;
    double slope = 0.0;
    for (int n = DERIVATIVES - 1; n >= 0; n--) {
        slope = slope * s + value;
        value = value * s + path->term[n];
    }
    *approach = value;
    *rate = slope / path->length;
}

/* Newton's method, kept safe by halving, needs less; halving alone 54 for all bits of a double. */
enum { MAX_ROUNDS = 100, MAX_CUBIC_ROUNDS = 40, MAX_HALVINGS = 60 };
/* A place on an interval that is a mere starting value. */
static const double CUBIC_ROUNDING = 1e-12;
/* Of an instant: half a bit, to which Newton's method comes, and what peaks are good for. */
static const double ROUNDING = 1e-16;
static const double PEAK_ROUNDING = 1e-15;

/* Where the cubic with the values and rates of both ends crosses zero, as a share of the interval:
 * Hermite's c3 s^3 + c2 s^2 + rate0 s + d0. */
static double cubic_root(double d0, double rate0, double d1, double rate1)
{
    double low = 0.0;
    double high = 1.0;
    /* starts on the straight line */
    double s = d0 / (d0 - d1);
    for (int i = 0; i < MAX_CUBIC_ROUNDS; i++) {
        /* the cubic there tightens the bounds */
        double c3 = rate0 + rate1 - 2.0 * (d1 - d0);
        double c2 = 3.0 * (d1 - d0) - 2.0 * rate0 - rate1;
        double value = ((c3 * s + c2) * s + rate0) * s + d0;
        double slope = (3.0 * c3 * s + 2.0 * c2) * s + rate0;
        if (value > 0.0)
            high = s;
        else
            low = s;
        /* Newton's method while it stays between them */
        double next = s - value / slope;
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        if (fabs(next - s) < CUBIC_ROUNDING)
            return next;
        s = next;
    }
    return s;
}

/* Root of the approach in [low, high] with approach(low) <= 0 < approach(high). Starts where the
 * cubic through both ends has it; bisection kept safe, Newton where it stays inside. */
static double rising_root(const struct path *path, double low, double high)
{
    double d;
    double rate;
    double d1;
    double rate1;
    /* starts at the root of the cubic */
    follow(path, low, &d, &rate);
    follow(path, high, &d1, &rate1);
    double h = high - low;
    double t = low + h * cubic_root(d, h * rate, d1, h * rate1);
    for (int i = 0; i < MAX_ROUNDS; i++) {
        /* the approach there tightens the bounds */
        follow(path, t, &d, &rate);
        if (d > 0.0)
            high = t;
        else
            low = t;
        /* Newton's method while it stays between them */
        double next = rate > 0.0 ? t - d / rate : low;
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        if (fabs(next - t) <= ROUNDING * fabs(t) || high - low <= ROUNDING * fabs(high))
            return next;
        t = next;
    }
    return t;
}

/* Instant of the peak in [low, high]: the rate falls through zero. */
static double peak(const struct path *path, double low, double high)
{
    for (int i = 0; i < MAX_HALVINGS && high - low > PEAK_ROUNDING * fabs(high); i++) {
        double t = 0.5 * (low + high);
        double d;
        double rate;
        follow(path, t, &d, &rate);
        if (d > 0.0)
            return t;
        if (rate > 0.0)
            low = t;
        else
            high = t;
    }
    return 0.5 * (low + high);
}

bool flight_root_touch(const struct motion *motion, const struct scene *scene, size_t contact,
                       double from, double to, double *time)
{
    struct path path = make_path(motion, scene, contact, from == 0.0 ? to : 0.0);
    double d0;
    double rate0;
    double d1;
    double rate1;
    /* touching already, or overlapping at the end, or a peak between */
    follow(&path, from, &d0, &rate0);
    if (d0 >= 0.0 && rate0 > 0.0) {
        *time = from;
        return true;
    }
    follow(&path, to, &d1, &rate1);
    if (d1 > 0.0) {
        *time = rising_root(&path, from, to);
        return true;
    }
    if (!(rate0 > 0.0 && rate1 < 0.0))
        return false;
    double top = peak(&path, from, to);
    follow(&path, top, &d1, &rate1);
    if (!(d1 > 0.0))
        return false;
    *time = rising_root(&path, from, top);
    return true;
}
