/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "tables/family_point.h"

#include <math.h>

#include "contact/law_closed_form.h"
#include "store/branch_shares.h"

/* Unloadings as close as the depths. */
enum { ONSET = 4 };

double family_depth(size_t i)
{
    return pow(10.0, 0.1 * (double)(i + 1));
}

double family_largest(size_t i)
{
    return i < ONSET ? family_depth(i) : family_depth(2 * i - ONSET + 1);
}

/* 1/E-star = 1 Pa and R = 1 m: the region asks for indentations of at most 0.02 R, which the yield
 * is chosen for; nothing depends on it. A rigid partner is one a million times as stiff. */
struct region_input family_input(const struct contact_family_place *place, size_t resolution)
{
    const double largest = 0.02;
    const double rigid = 1e-6;
    double own = (1.0 - place->poisson * place->poisson) / place->share;
    double partner = (1.0 - 0.3 * 0.3) / fmax(1.0 - place->share, rigid);
    struct material soft = {"soft", own, place->poisson, 1.0, 1.0, place->hardening * own};
    struct material elastic = {"elastic", partner, 0.3, 1.0, INFINITY, 0.0};
    struct hertz_contact hertz =
        hertz_contact_make(hertz_effective_modulus(&soft, &elastic), 0.5, 0.5);
    soft.yield = sqrt(largest / FAMILY_DEEPEST / closed_form_yield(&hertz, &soft, &elastic));
    return (struct region_input){.materials = {soft, elastic},
                                 .radius = 1.0,
                                 .indentation = largest,
                                 .resolution = resolution};
}

/* Mean force over Hertz's at an indentation. */
static double ratio_at(const struct indentation_run *run, double d)
{
    return d > run->middle[0] ? indentation_interpolate(run->rings, run->middle, run->ratio, 1, d)
                              : 1.0;
}

/* The squared contact radius over R d, by the indentation's logarithm. */
static double area_at(const struct indentation_run *run, double d)
{
    double root = indentation_interpolate(run->rings, run->middle, run->radius, 1, d);
    return root * root / d;
}

/* What springs back. Up to the first computed branch dents begin with the square of the way beyond
 * yield, as in table_curves.c. */
static double back_at(const struct indentation_run *run, const double *back, double unit, double d)
{
    double first = run->largest[1];
    if (d >= first)
        return indentation_interpolate(run->branches - 1, run->largest + 1, back + 1, 1, d);
    double way = log(d / unit) / log(first / unit);
    return 1.0 - (1.0 - back[1]) * way * way;
}

/* The branch from an indentation: between two computed ones by its logarithm. */
static void fill_share(const struct indentation_run *run, double unit, double d, double *share)
{
    double recovery[INDENTATION_SAMPLES], scratch[BRANCH_SHARES_SCRATCH];
    size_t b = 1;
    while (b + 2 < run->branches && run->largest[b + 1] <= d)
        b++;
    double way = log(d / run->largest[b]) / log(run->largest[b + 1] / run->largest[b]);
    way = fmin(fmax(way, 0.0), 1.0);
    const double *from = run->recovery + b * INDENTATION_SAMPLES;
    for (size_t j = 0; j < INDENTATION_SAMPLES; j++)
        recovery[j] = (1.0 - way) * from[j] + way * from[INDENTATION_SAMPLES + j];
    double onset = fmin(1.0, log(d / unit) / log(run->largest[1] / unit));
    branch_shares_fill(recovery, onset * onset, FAMILY_SAMPLES, share, scratch);
}

bool family_point_fill(const struct indentation_run *in_long,
                       const struct indentation_run *in_short, const struct region_input *input,
                       struct family_point *point)
{
    /* depths are in units of that of first yield */
    const struct material *m = input->materials;
    struct hertz_contact hertz = hertz_contact_make(hertz_effective_modulus(&m[0], &m[1]),
                                                    0.5 / input->radius, 0.5 / input->radius);
    double unit = closed_form_yield(&hertz, &m[0], &m[1]);
    double back[INDENTATION_RINGS_MAX];
    if (in_long->rings < 4 || in_short->rings < 4 || in_short->branches < 5)
        return false;
    /* what comes back of each depth that was unloaded from */
    for (size_t b = 0; b < in_short->branches; b++)
        back[b] = 1.0 - in_short->residual[b] / in_short->largest[b];
    /* first order in the steps: twice the short ones less the long ones */
    for (size_t i = 0; i < FAMILY_DEPTHS; i++) {
        double d = unit * family_depth(i);
        point->force[i] = 2.0 * ratio_at(in_short, d) - ratio_at(in_long, d);
        point->area[i] = area_at(in_short, d);
    }
    /* unloadings of the short steps alone */
    for (size_t i = 0; i < FAMILY_SPRINGS; i++) {
        double d = unit * family_largest(i);
        point->back[i] = back_at(in_short, back, unit, d);
        if (i < FAMILY_BRANCHES)
            fill_share(in_short, unit, d, point->share[i]);
    }
    return true;
}
