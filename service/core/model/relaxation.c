/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/relaxation.h"

#include <math.h>

double relaxation_storage(const struct relaxation *relaxation, double omega)
{
    double sum = 1.0;
    for (size_t i = 0; i < relaxation->count; i++) {
        double angle = omega * relaxation->time[i];
        sum -= relaxation->share[i] / (1.0 + angle * angle);
    }
    return sum;
}

/* Loss modulus over the instantaneous one. */
static double loss_modulus(const struct relaxation *relaxation, double omega)
{
    double sum = 0.0;
    for (size_t i = 0; i < relaxation->count; i++) {
        double angle = omega * relaxation->time[i];
        sum += relaxation->share[i] * angle / (1.0 + angle * angle);
    }
    return sum;
}

double relaxation_loss_factor(const struct relaxation *relaxation, double omega)
{
    return loss_modulus(relaxation, omega) / relaxation_storage(relaxation, omega);
}

/* The loss modulus of a term over the logarithm of the frequency is 1/cosh: ten samples a decade
 * come within 0.7 % of its top. */
double relaxation_peak_loss(const struct relaxation *relaxation, double omega)
{
    static const double STEP = 1.2589254117941673; /* 10^0.1 */
    double peak = 0.0;
    if (relaxation->count == 0)
        return 0.0;
    double last = 10.0 / relaxation->time[0];
    double at = fmax(omega, 0.1 / relaxation->time[relaxation->count - 1]);
    do
        peak = fmax(peak, relaxation_loss_factor(relaxation, at));
    while ((at *= STEP) < last);
    return peak;
}

/* What is left out changes the loss factor by less than this share of the terms'. */
static const double APART = 1e-6;

struct relaxation relaxation_near(const struct relaxation *relaxation, double omega,
                                  double *stiffness)
{
    struct relaxation near = {0};
    *stiffness = 1.0;
    for (size_t i = 0; i < relaxation->count; i++) {
        double angle = omega * relaxation->time[i];
        if (angle < APART)
            *stiffness -= relaxation->share[i];
        else if (angle < 1.0 / APART)
            relaxation_add(&near, relaxation->share[i], relaxation->time[i]);
    }
    for (size_t i = 0; i < near.count; i++)
        near.share[i] /= *stiffness;
    return near;
}

/* Two times in a decade: the loss factor between them ripples by 2e-4 of it. */
static const double FIRST_DECADE = -1.5, DECADE_STEP = 0.5;

/* The spectrum time^-power of t^-power; the times beyond the last one are the modulus that stays.
 */
static struct relaxation of_power(double power, double omega)
{
    struct relaxation made = {.count = RELAXATION_TERMS};
    double last = FIRST_DECADE + DECADE_STEP * (RELAXATION_TERMS - 0.5);
    double all = pow(10.0, -power * last) / (power * M_LN10 * DECADE_STEP);
    for (size_t i = 0; i < made.count; i++) {
        double angle = pow(10.0, FIRST_DECADE + DECADE_STEP * (double)i);
        made.time[i] = angle / omega;
        made.share[i] = pow(angle, -power);
        all += made.share[i];
    }
    for (size_t i = 0; i < made.count; i++)
        made.share[i] /= all;
    return made;
}

/* Of a spectrum without ends the power is 2/pi atan eta: the cut one's is a little larger, and
 * below 1 for every loss factor below 2. The interval is halved to rounding. */
struct relaxation relaxation_constant(double loss_factor, double omega)
{
    double low = 0.0, high = 1.0;
    for (;;) {
        double power = 0.5 * (low + high);
        struct relaxation made = of_power(power, omega);
        if (!(power > low && power < high))
            return made;
        if (relaxation_loss_factor(&made, omega) < loss_factor)
            low = power;
        else
            high = power;
    }
}

/* Moduli and creep compliances times the operator's variable s: 1 + sign sum share/(1 + s time),
 * with the sign -1 for a modulus, 1 for a compliance. Each is the other's inverse. */

static double value_at(const struct relaxation *series, double sign, double time)
{
    double sum = 1.0;
    for (size_t i = 0; i < series->count; i++)
        sum += sign * series->share[i] * time / (time - series->time[i]);
    return sum;
}

/* The root s = -1/time between two poles, where the value rises from -infinity (or 1, at 0) to
 * infinity for a modulus, and falls so for a compliance. */
static double root_between(const struct relaxation *series, double sign, double low, double high)
{
    for (;;) {
        double middle = 0.5 * (low + high);
        if (!(middle > low && middle < high))
            return middle;
        if (sign * value_at(series, sign, middle) > 0.0)
            low = middle;
        else
            high = middle;
    }
}

/* Poles and zeros alternate: those of a modulus are shorter times than its zeros. */
static struct relaxation invert(const struct relaxation *series, double sign)
{
    struct relaxation made = {.count = series->count};
    double all = 0.0;
    for (size_t i = 0; i < series->count; i++)
        all += series->share[i];
    for (size_t i = 0; i < series->count; i++) {
        double low = sign < 0.0 ? series->time[i] : i > 0 ? series->time[i - 1] : 0.0;
        double high = sign > 0.0              ? series->time[i]
                      : i + 1 < series->count ? series->time[i + 1]
                                              : series->time[i] / (1.0 - all);
        double time = root_between(series, sign, low, high);
        double slope = 0.0;
        for (size_t j = 0; j < series->count; j++) {
            double distance = 1.0 - series->time[j] / time;
            slope += series->share[j] * series->time[j] / (distance * distance);
        }
        made.time[i] = time;
        made.share[i] = time / slope;
    }
    return made;
}

struct relaxation relaxation_creep(const struct relaxation *relaxation)
{
    return invert(relaxation, -1.0);
}

/* Nearer times are the same one: their poles coincide. */
static const double SAME_TIME = 1e-9;

void relaxation_add(struct relaxation *series, double share, double time)
{
    size_t at = series->count;
    while (at > 0 && series->time[at - 1] > time * (1.0 + SAME_TIME))
        at--;
    if (at > 0 && series->time[at - 1] >= time * (1.0 - SAME_TIME)) {
        series->share[at - 1] += share;
        return;
    }
    for (size_t i = series->count++; i > at; i--) {
        series->share[i] = series->share[i - 1];
        series->time[i] = series->time[i - 1];
    }
    series->share[at] = share;
    series->time[at] = time;
}

struct relaxation relaxation_in_series(const struct relaxation *first, double part,
                                       const struct relaxation *second)
{
    const struct relaxation *each[2] = {first, second};
    struct relaxation creep = {0};
    for (int which = 0; which < 2; which++) {
        double share = which ? 1.0 - part : part;
        struct relaxation own = invert(each[which], -1.0);
        for (size_t i = 0; share > 0.0 && i < own.count; i++)
            relaxation_add(&creep, share * own.share[i], own.time[i]);
    }
    return invert(&creep, 1.0);
}
