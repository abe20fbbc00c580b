/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <percuss/reply.h>
#include <percuss/slow_equations.h>
#include <stdlib.h>

#include "numeric/lcp.h"
#include "slow.h"

/* A force's mean over its peak in each half of Hertz's contact of rigid bodies. */
static const double HERTZ = 0.5436;

/* Impulse times the distance of its centre from the peak, of the half of a force on one side of it.
 * The distance over the half's length follows from the mean over the peak: the parabola through 0,
 * a quarter of a sine and a constant force, on which Hertz's is to 4e-4. A contact that yields is
 * between Hertz's and the sine. Humps by vibration have a lower mean than Hertz's, but no centre
 * nearer to the peak. `peak` 0: not known. */
static double half_moment(double impulse, double peak, double length)
{
    double most = peak * length; /* of the impulse */
    double mean = most > 0.0 ? fmin(fmax(HERTZ, impulse / most), 1.0) : HERTZ;
    return impulse * length * mean * (0.5 + 0.195 * (1.0 - mean));
}

double percuss_slow_force_centre(const struct percuss_sub_impact *sub)
{
    if (SLOW_NULL(sub))
        return NAN;
    double before =
        half_moment(sub->compression_impulse, sub->peak_force, sub->compression_end - sub->start);
    double after = half_moment(sub->impulse - sub->compression_impulse, sub->peak_force,
                               sub->end - sub->compression_end);
    double shift = sub->impulse > 0.0 ? (after - before) / sub->impulse : 0.0;
    return fmin(fmax(sub->compression_end + shift, sub->start), sub->end);
}

bool percuss_slow_compression(size_t n, const double *W, const double *gap_rate, double *impulse)
{
    if (n > 0 && SLOW_NULL(W, gap_rate, impulse))
        return false;
    if (n != 1)
        return lcp_solve(n, W, gap_rate, impulse) == LCP_SOLVED;
    impulse[0] = gap_rate[0] < 0.0 ? -gap_rate[0] / W[0] : 0.0;
    return W[0] > 0.0 && isfinite(impulse[0]);
}

void percuss_slow_gap_rate_after(size_t n, const double *W, const double *gap_rate,
                                 const double *impulse, double *after)
{
    if (n > 0 && SLOW_NULL(W, gap_rate, impulse, after))
        return;
    for (size_t i = 0; i < n; i++) {
        after[i] = gap_rate[i];
        for (size_t j = 0; j < n; j++)
            after[i] += W[i * n + j] * impulse[j];
    }
}

/* Expansion impulses of rates `middle`, and the rates after. */
static bool expand(size_t n, const double *W, const double *middle, double *expansion,
                   double *after)
{
    percuss_slow_gap_rate_after(n, W, middle, expansion, after);
    if (n == 1) /* one contact cannot approach again by itself */
        return true;
    double *excess = calloc(n, sizeof *excess);
    bool good = excess && lcp_solve(n, W, after, excess) == LCP_SOLVED;
    for (size_t i = 0; good && i < n; i++)
        expansion[i] += excess[i];
    percuss_slow_gap_rate_after(n, W, middle, expansion, after);
    free(excess);
    return good;
}

bool percuss_slow_poisson(size_t n, const double *W, const double *gap_rate,
                          const double *restitution, struct percuss_slow_outcome *outcome)
{
    if (n > 0 && (SLOW_NULL(W, gap_rate, restitution, outcome) || SLOW_NULL(outcome->impulse)))
        return false;
    double *scratch = calloc(4 * n, sizeof *scratch);
    if (!scratch)
        return false;
    double *compression = scratch, *middle = scratch + n;
    double *expansion = scratch + 2 * n, *after = scratch + 3 * n;
    /* compression stops all approach */
    bool good = percuss_slow_compression(n, W, gap_rate, compression);
    percuss_slow_gap_rate_after(n, W, gap_rate, compression, middle);
    for (size_t i = 0; i < n; i++) { /* complementary: a pressing contact has stopped */
        middle[i] = compression[i] > 0.0 ? 0.0 : fmax(0.0, middle[i]);
        expansion[i] = restitution[i] * compression[i];
    }
    /* expansion gives back at least e of it, and lets nothing approach */
    good = good && expand(n, W, middle, expansion, after);
    for (size_t i = 0; good && i < n; i++) {
        outcome->impulse[i] = compression[i] + expansion[i];
        if (outcome->compression)
            outcome->compression[i] = compression[i];
        if (outcome->gap_rate_after)
            outcome->gap_rate_after[i] = after[i];
    }
    free(scratch);
    return good;
}

bool percuss_slow_restitution(size_t n, const double *W, const double *gap_rate,
                              const double *impulse, double *restitution)
{
    if (n > 0 && SLOW_NULL(W, gap_rate, impulse, restitution))
        return false;
    double *compression = calloc(n, sizeof *compression);
    bool good = compression && percuss_slow_compression(n, W, gap_rate, compression);
    for (size_t i = 0; good && i < n; i++)
        restitution[i] = compression[i] > 0.0 ? impulse[i] / compression[i] - 1.0 : NAN;
    free(compression);
    return good;
}
