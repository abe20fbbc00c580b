/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/swing.h"

#include <math.h>

/* Share of the swing's width that remains in the mean of 3 or 6 phases: of 13 scenes with 12 phases
 * each (docs/lab/complete-fe.md) at most 0.09 and 0.025. */
static const double LEFT_BY_3 = 0.10;
static const double LEFT_BY_6 = 0.03;

void swing_judge(struct swing *swing)
{
    double low = INFINITY;
    double high = -INFINITY;
    double sum = 0.0;
    for (unsigned k = 0; k < swing->phases; k++) {
        low = fmin(low, swing->restitution[k]);
        high = fmax(high, swing->restitution[k]);
        sum += swing->restitution[k];
    }
    swing->mean = sum / swing->phases;
    swing->width = high - low;
    swing->jitter = swing->width * (swing->phases == SWING_PHASES ? LEFT_BY_6 : LEFT_BY_3);
}

void swing_weigh(const struct swing *swing, double wanted, double weights[SWING_PHASES])
{
    /* even ones, tilted along the phases' distances from their mean: of all that have the wanted
     * mean these have the least squares */
    unsigned n = swing->phases;
    double squares = 0.0;
    double low = 0.0;
    double high = 0.0;
    for (unsigned k = 0; k < n; k++) {
        double off = swing->restitution[k] - swing->mean;
        squares += off * off;
        low = fmin(low, off);
        high = fmax(high, off);
    }
    /* no farther than where the first weight vanishes */
    double tilt = squares > 0.0 ? (wanted - swing->mean) / squares : 0.0;
    double most = tilt > 0.0 ? -1.0 / (n * low) : 1.0 / (n * high);
    if (fabs(tilt) > most)
        tilt = copysign(most, tilt);
    for (unsigned k = 0; k < n; k++)
        weights[k] = fmax(0.0, 1.0 / n + tilt * (swing->restitution[k] - swing->mean));
}

/* The trigonometric polynomial through n even phases: n odd, or n even with its highest harmonic a
 * cosine (Henrici, Applied and Computational Complex Analysis 3, section 13.6). */
static double interpolate(const struct swing *swing, double phase)
{
    unsigned n = swing->phases;
    double sum = 0.0;
    for (unsigned k = 0; k < n; k++) {
        double x = M_PI * (phase - (double)k / n);
        double weight = n % 2 ? sin(n * x) / sin(x) : sin(n * x) / tan(x);
        sum += swing->restitution[k] * (fabs(sin(x)) < 1e-12 ? 1.0 : weight / n);
    }
    return sum;
}

double swing_phase(const struct swing *swing, double wanted, struct swing_bracket *bracket)
{
    unsigned n = swing->phases;
    for (unsigned k = 0; k < n; k++) {
        double low = swing->restitution[k] - wanted;
        double high = swing->restitution[(k + 1) % n] - wanted;
        if (!(low * high < 0.0))
            continue;
        *bracket = (struct swing_bracket){{(double)k / n, (k + 1.0) / n}, {low, high}};
        double ends[2] = {bracket->phase[0], bracket->phase[1]};
        for (int i = 0; i < 40; i++) {
            double middle = 0.5 * (ends[0] + ends[1]);
            ends[(interpolate(swing, middle) - wanted) * low <= 0.0] = middle;
        }
        return ends[0];
    }
    return NAN;
}

double swing_narrow(struct swing_bracket *bracket, double phase, double off)
{
    int end = off * bracket->off[0] <= 0.0;
    bracket->phase[end] = phase;
    bracket->off[end] = off;
    double share = bracket->off[0] / (bracket->off[0] - bracket->off[1]);
    return bracket->phase[0] + share * (bracket->phase[1] - bracket->phase[0]);
}
