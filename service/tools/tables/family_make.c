/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "tables/family_make.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "contact/law_closed_form.h"
#include "store/table_curves.h"

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

/* Recovered share of the indentation. Up to the first computed branch dents begin with the square
 * of the way beyond yield, as in table_curves.c. */
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
    /* recovered share of each depth before unloading */
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

/* Depths beyond the computed ones, four to a decade of them and two of the unloadings. */
enum { MORE_DEPTHS = 16, MORE_SPRINGS = 8 };
enum { HARDENINGS = 6, POISSONS = 3, SHARES = 4, TABLES = HARDENINGS * POISSONS * SHARES };
enum { ALL_DEPTHS = FAMILY_DEPTHS + MORE_DEPTHS, ALL_SPRINGS = FAMILY_SPRINGS + MORE_SPRINGS };

/* Hardening 1 is Hertz's law. */
static const double hardenings[HARDENINGS] = {0.0, 0.01, 0.03, 0.1, 0.3, 1.0};
static const double poissons[POISSONS] = {0.1, 0.3, 0.45};
static const double shares[SHARES] = {0.1, 0.4, 0.7, 1.0};
static const double BASE_POISSON = 0.3, BASE_SHARE = 0.7;

struct family_numbers {
    double depth[ALL_DEPTHS], largest[ALL_SPRINGS];
    double force[TABLES][ALL_DEPTHS], area[TABLES][ALL_DEPTHS];
    double back[TABLES][ALL_SPRINGS];
    double share[TABLES][FAMILY_BRANCHES][FAMILY_SAMPLES];
    double error;
};

/* The place that stands for all of a hardening: on both meshes, and extrapolated to elements of
 * size 0. */
struct base {
    struct family_point coarse, fine, limit;
};

size_t family_passages(void)
{
    return (HARDENINGS - 1) * (POISSONS * SHARES + 1);
}

size_t family_fine_passages(void)
{
    return HARDENINGS - 1;
}

static bool is_base(const struct contact_family_place *place)
{
    return place->poisson == BASE_POISSON && place->share == BASE_SHARE;
}

/* First order in the size of the elements: twice the fine mesh less the coarse one, at half the
 * size. Dents only begin at depths where the coarse mesh has no branch yet: there, the fine one. */
static void extrapolate(size_t count, const double *depth, const double *coarse, const double *fine,
                        double *limit)
{
    const double begins = 2.0, full = 5.0;
    const double order = (double)FAMILY_COARSE / (FAMILY_FINE - FAMILY_COARSE);
    for (size_t i = 0; i < count; i++) {
        double part = depth ? log(depth[i] / begins) / log(full / begins) : 1.0;
        limit[i] = fine[i] + fmin(fmax(part, 0.0), 1.0) * order * (fine[i] - coarse[i]);
    }
}

static enum percuss_status make_base(const struct family_source *source, double hardening,
                                     struct base *base, double *error, struct fault *fault)
{
    struct contact_family_place place = {hardening, BASE_POISSON, BASE_SHARE};
    double largest[FAMILY_SPRINGS];
    for (size_t i = 0; i < FAMILY_SPRINGS; i++)
        largest[i] = family_largest(i);
    /* one place on two meshes */
    enum percuss_status status =
        source->point(source->context, &place, FAMILY_COARSE, &base->coarse, fault);
    if (!status)
        status = source->point(source->context, &place, FAMILY_FINE, &base->fine, fault);
    if (status)
        return status;
    /* extrapolated; the difference is the finer mesh's error */
    base->limit = base->coarse;
    extrapolate(FAMILY_DEPTHS, NULL, base->coarse.force, base->fine.force, base->limit.force);
    extrapolate(FAMILY_DEPTHS, NULL, base->coarse.area, base->fine.area, base->limit.area);
    extrapolate(FAMILY_SPRINGS, largest, base->coarse.back, base->fine.back, base->limit.back);
    for (size_t i = 0; i < FAMILY_DEPTHS; i++)
        *error = fmax(*error, fabs(base->limit.force[i] / base->fine.force[i] - 1.0));
    return PERCUSS_OK;
}

/* A curve of a place less the mesh's error, which is that of the base. Nothing exceeds Hertz's. */
static void correct(size_t count, const double *computed, const double *coarse, const double *limit,
                    double most, double *values)
{
    for (size_t i = 0; i < count; i++)
        values[i] = fmin(computed[i] * limit[i] / coarse[i], most);
}

/* Continues from the last two of `count` values by their power of the depth, or by a power that
 * decays with the root of the depth as in a fully plastic contact: force over area and area over
 * depth tend to constants as d^(-1/2) (measured: the exponent halves with every factor of 4).
 * `floor`: the power that stays. */
static void go_on(size_t count, size_t all, const double *depth, double floor, bool fades,
                  double *values)
{
    double last = depth[count - 1];
    double power =
        log(values[count - 1] / values[count - 2]) / log(last / depth[count - 2]) - floor;
    for (size_t i = count; i < all; i++) {
        double way = depth[i] / last;
        double more = fades ? 2.0 * power * (1.0 - 1.0 / sqrt(way)) : power * log(way);
        values[i] = values[count - 1] * exp(floor * log(way) + more);
    }
}

/* Integral of a branch by Simpson's rule. */
static double mean_share(const double share[FAMILY_SAMPLES])
{
    double sum = share[0] + share[FAMILY_SAMPLES - 1];
    for (size_t j = 1; j + 1 < FAMILY_SAMPLES; j++)
        sum += (j % 2 ? 4.0 : 2.0) * share[j];
    return sum / (3.0 * (FAMILY_SAMPLES - 1));
}

/* Where dents begin, the loss is below the computation's error: a contact gives back at most the
 * work of loading, less the smallest computed loss (3 % times the square of the depth's logarithm,
 * half of that of a metal without hardening). */
static void lose(struct family_numbers *numbers, size_t t)
{
    const double least = 0.005;
    double depth = 1.0, force = 1.0, work = 0.4;
    for (size_t i = 0, k = 0; k < FAMILY_BRANCHES && i < FAMILY_DEPTHS; i++) {
        /* the work, of a force c d^p since the last depth: its integral is d F / (p + 1) */
        double d = numbers->depth[i];
        double next = numbers->force[t][i] * d * sqrt(d);
        double power = log(next / force) / log(d / depth);
        work += (d * next - depth * force) / (power + 1.0);
        depth = d;
        force = next;
        /* unloadings begin at some of the depths */
        if (numbers->largest[k] > d * (1.0 + 1e-9))
            continue;
        /* recovered work is at most the work of loading, less the least loss */
        double most = work / (next * d * mean_share(numbers->share[t][k]));
        double way = log(d);
        numbers->back[t][k] =
            fmin(numbers->back[t][k], most * (1.0 - least * fmin(way * way, 1.0)));
        k++;
    }
}

static void finish(struct family_numbers *numbers, size_t t, bool fades)
{
    go_on(FAMILY_DEPTHS, ALL_DEPTHS, numbers->depth, -0.5, fades, numbers->force[t]);
    go_on(FAMILY_DEPTHS, ALL_DEPTHS, numbers->depth, 0.0, fades, numbers->area[t]);
    go_on(FAMILY_SPRINGS, ALL_SPRINGS, numbers->largest, -0.5, fades, numbers->back[t]);
}

static void fill_table(struct family_numbers *numbers, size_t t, const struct base *base,
                       const struct family_point *point, bool fades)
{
    correct(FAMILY_DEPTHS, point->force, base->coarse.force, base->limit.force, 1.0,
            numbers->force[t]);
    correct(FAMILY_DEPTHS, point->area, base->coarse.area, base->limit.area, INFINITY,
            numbers->area[t]);
    correct(FAMILY_SPRINGS, point->back, base->coarse.back, base->limit.back, 1.0,
            numbers->back[t]);
    for (size_t b = 0; b < FAMILY_BRANCHES; b++)
        for (size_t j = 0; j < FAMILY_SAMPLES; j++)
            numbers->share[t][b][j] =
                point->share[b][j] + (base->fine.share[b][j] - base->coarse.share[b][j]);
    lose(numbers, t);
    finish(numbers, t, fades);
}

static void fill_hertz(struct family_numbers *numbers, size_t t)
{
    for (size_t i = 0; i < ALL_DEPTHS; i++)
        numbers->force[t][i] = numbers->area[t][i] = 1.0;
    for (size_t i = 0; i < ALL_SPRINGS; i++)
        numbers->back[t][i] = 1.0;
    for (size_t b = 0; b < FAMILY_BRANCHES; b++)
        for (size_t j = 0; j < FAMILY_SAMPLES; j++) {
            double x = (double)j / (FAMILY_SAMPLES - 1);
            numbers->share[t][b][j] = x * sqrt(x);
        }
}

static enum percuss_status make_hardening(const struct family_source *source, size_t h,
                                          struct family_numbers *numbers, struct fault *fault)
{
    struct base base;
    size_t t = h * POISSONS * SHARES;
    bool elastic = hardenings[h] == 1.0;
    enum percuss_status status =
        elastic ? PERCUSS_OK : make_base(source, hardenings[h], &base, &numbers->error, fault);
    for (size_t p = 0; p < POISSONS && !status; p++)
        for (size_t s = 0; s < SHARES && !status; s++, t++) {
            struct contact_family_place place = {hardenings[h], poissons[p], shares[s]};
            struct family_point point = base.coarse;
            /* Hertz's law needs no computation */
            if (elastic) {
                fill_hertz(numbers, t);
                continue;
            }
            /* on the coarse mesh, with the error of the base */
            if (!is_base(&place))
                status = source->point(source->context, &place, FAMILY_COARSE, &point, fault);
            if (!status)
                fill_table(numbers, t, &base, &point, hardenings[h] == 0.0);
        }
    return status;
}

struct family_numbers *family_numbers_make(const struct family_source *source, struct fault *fault)
{
    struct family_numbers *numbers = calloc(1, sizeof *numbers);
    if (!numbers) {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        return NULL;
    }
    /* the computed depths, and those that the curves are continued to */
    for (size_t i = 0; i < ALL_DEPTHS; i++)
        numbers->depth[i] =
            i < FAMILY_DEPTHS ? family_depth(i)
                              : FAMILY_DEEPEST * pow(10.0, 0.25 * (double)(i + 1 - FAMILY_DEPTHS));
    for (size_t i = 0; i < ALL_SPRINGS; i++)
        numbers->largest[i] =
            i < FAMILY_SPRINGS ? family_largest(i)
                               : FAMILY_DEEPEST * pow(10.0, 0.5 * (double)(i + 1 - FAMILY_SPRINGS));
    /* a table for each hardening, Poisson's ratio and share */
    enum percuss_status status = PERCUSS_OK;
    for (size_t h = 0; h < HARDENINGS && !status; h++)
        status = make_hardening(source, h, numbers, fault);
    if (!status)
        return numbers;
    free(numbers);
    return NULL;
}

void family_numbers_free(struct family_numbers *numbers)
{
    free(numbers);
}

struct contact_family_samples family_numbers_samples(const struct family_numbers *numbers)
{
    return (struct contact_family_samples){
        .count = {HARDENINGS, POISSONS, SHARES},
        .axis = {hardenings, poissons, shares},
        .depths = ALL_DEPTHS,
        .depth = numbers->depth,
        .force = numbers->force[0],
        .area = numbers->area[0],
        .springs = ALL_SPRINGS,
        .largest = numbers->largest,
        .back = numbers->back[0],
        .branches = FAMILY_BRANCHES,
        .samples = FAMILY_SAMPLES,
        .share = numbers->share[0][0],
        .computed = FAMILY_DEEPEST,
        .error = numbers->error,
    };
}
