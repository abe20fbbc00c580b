/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* With C = 1.295 exp(0.736 nu), d_c = (pi C S_y / (2 E-star))^2 R and F_c = k d_c^(3/2), w = d/d_c:
 *
 *   w <= 1.9   F = k d^(3/2)  (Hertz)
 *   w > 1.9    F = F_c {exp(-w^(5/12)/4) w^(3/2) + (4H/(C S_y)) (1 - exp(-w^(5/9)/25)) w}
 *              H/S_y = 2.84 (1 - exp(-0.82 (a/R)^-0.7)),  a = sqrt(R d (w/1.9)^B),
 *              B = 0.14 exp(23 S_y/E-star)
 *   unloading  F = F_m ((d - d_res)/(d_m - d_res))^(3/2),
 *              d_res = 1.02 d_m (1 - ((w_m + 5.9)/6.9)^-0.54), 0 up to w_m = 1
 *
 * The published loading pieces differ by -0.16 % at w = 1.9, and in slope: Hertz passes into the
 * second piece from w = 1.9 to 3.8 by a quintic step (two continuous derivatives). The published
 * d_res begins with a slope at w = 1, where the plastic zone is a point and the loading curve
 * Hertz's as far as 1.9: a cubic step from 1 to 1.9 lets it begin with its square, as in the fit of
 * Etsion, Kligerman and Kadin (Int. J. Solids Struct. 42 (2005) 3716; 1.9 % of d_m at w = 1.4,
 * here 1.2 %, the published 3 %). It exceeds d_m beyond w = 1e4. From w = 2670, where it leaves 2 %
 * of d_m to spring back, far beyond the fit's range, that share falls with the root of the depth:
 * the dent is fully plastic there, under a constant hardness H, and springs back like an elastic
 * body from under that pressure, by 3 F/(4 E-star a) with F ~ H a^2 and a ~ sqrt(R d) (K. L.
 * Johnson, Contact Mechanics, 1985, section 6.4: e ~ v^(-1/4)). */
#include "contact/law_closed_form.h"

#include <math.h>

#include "base/extremes.h"
#include "contact/plastic.h"

enum { STIFFNESS, YIELD_DEPTH, RADIUS, GROWTH, HARDNESS }; /* k, d_c, R, B, 4 * 2.84 / C */

static const double PLASTIC_FROM = 1.9;
static const double PLASTIC_FULL = 3.8;
static const double SPRING_FIT = 2670.0;

/* Four-point Gauss-Legendre rule on (-1, 1). */
static const double gauss_node[] = {0.33998104358485626480, 0.86113631159405257522};
static const double gauss_weight[] = {0.65214515486254614263, 0.34785484513745385737};

double closed_form_pressure(const struct material *material)
{
    return 1.295 * exp(0.736 * material->poisson) * material->yield;
}

int closed_form_softer(const struct material *a, const struct material *b)
{
    double yield_a = closed_form_pressure(a);
    double yield_b = closed_form_pressure(b);
    if (isinf(yield_a) && isinf(yield_b))
        return -1;
    return yield_b < yield_a ? 1 : 0;
}

double closed_form_yield_ratio(const struct material *a, const struct material *b)
{
    return closed_form_pressure(b) / closed_form_pressure(a);
}

double closed_form_radius(const struct hertz_contact *hertz)
{
    double root = 0.75 * hertz->stiffness / hertz->effective_modulus;
    return root * root;
}

double closed_form_yield(const struct hertz_contact *hertz, const struct material *a,
                         const struct material *b)
{
    double root = 0.5 * M_PI * smaller(closed_form_pressure(a), closed_form_pressure(b)) /
                  hertz->effective_modulus;
    double ratio = hertz_pressure_ratio(hertz);
    return root * root * closed_form_radius(hertz) / (ratio * ratio);
}

double closed_form_restitution(double times, double strain)
{
    const double first = 60.0, last = 1000.0;
    double speed = sqrt(times);
    double within = smaller(speed, last);
    if (!(speed > 1.0))
        return 1.0;
    if (speed <= first)
        return 1.0 - 0.1 * log(speed) * pow((speed - 1.0) / (first - 1.0), 0.156);
    double fit =
        1.0 - 0.1 * log(first) - 0.11 * log(within / first) * pow(within - first, 2.36 * strain);
    return larger(fit, 0.0) * sqrt(sqrt(within / speed));
}

static double closed_form_elastic(const struct contact_law *law, double d, double *slope)
{
    double root = sqrt(d);
    *slope = 1.5 * law->parameters[STIFFNESS] * root;
    return law->parameters[STIFFNESS] * d * root;
}

/* The second piece over F_c, and its derivative by log w. */
static double plastic_piece(const struct contact_law *law, double w, double *by_log)
{
    const double *p = law->parameters;
    double log_w = log(w);
    /* remaining part of Hertz's force: exp(-w^(5/12)/4) w^(3/2) */
    double fading = exp(5.0 / 12.0 * log_w);
    double first = exp(-0.25 * fading) * w * sqrt(w);
    /* share that the plastic force has reached: 1 - exp(-w^(5/9)/25) */
    double rise = exp(5.0 / 9.0 * log_w) / 25.0;
    double left = exp(-rise);
    /* hardness, which falls as the contact widens: 4H/(C S_y) = (4 2.84/C) (1 - exp(-size)),
     * size = 0.82 (a/R)^-0.7, log(a/R) = (log w + log(d_c/R) + B log(w/1.9))/2 */
    double half = 0.5 * (1.0 + p[GROWTH]);
    double log_a =
        half * log_w + 0.5 * (log(p[YIELD_DEPTH] / p[RADIUS]) - p[GROWTH] * log(PLASTIC_FROM));
    double size = 0.82 * exp(-0.7 * log_a);
    double soft = exp(-size);
    double hardness = p[HARDNESS] * (1.0 - soft);
    double second = hardness * (1.0 - left) * w;
    /* by the product rule, d/dlog w of w^n being n w^n */
    *by_log = first * (1.5 - 5.0 / 48.0 * fading) + second -
              0.7 * half * p[HARDNESS] * size * soft * (1.0 - left) * w +
              hardness * left * rise * (5.0 / 9.0) * w;
    return first + second;
}

static double closed_form_loading_force(const struct contact_law *law, double d, double *slope)
{
    double depth = law->parameters[YIELD_DEPTH];
    double w = d / depth;
    double elastic = closed_form_elastic(law, d, slope);
    if (!(w > PLASTIC_FROM))
        return elastic;
    /* the second piece, in units of F_c = k d_c^(3/2) */
    double unit = law->parameters[STIFFNESS] * depth * sqrt(depth);
    double by_log;
    double plastic = unit * plastic_piece(law, w, &by_log);
    double plastic_slope = unit * by_log / d;
    /* between the two by the quintic step s(t) = 6 t^5 - 15 t^4 + 10 t^3, s' = 30 t^2 (1 - t)^2 */
    double t = (w - PLASTIC_FROM) / (PLASTIC_FULL - PLASTIC_FROM);
    if (t >= 1.0) {
        *slope = plastic_slope;
        return plastic;
    }
    double step = t * t * t * (10.0 + t * (6.0 * t - 15.0));
    double step_slope =
        30.0 * t * t * (1.0 - t) * (1.0 - t) / (depth * (PLASTIC_FULL - PLASTIC_FROM));
    *slope += step * (plastic_slope - *slope) + step_slope * (plastic - elastic);
    return elastic + step * (plastic - elastic);
}

/* Work between two depths, by panels in log d, on which the integrand d F is analytic. */
static double work_between(const struct contact_law *law, double from, double to, double panel)
{
    double range = log(to / from);
    int panels = (int)ceil(range / panel);
    double sum = 0.0;
    for (int p = 0; p < panels; p++) {
        double half = 0.5 * range / panels;
        double centre = (2 * p + 1) * half;
        for (int i = 0; i < 4; i++) {
            double slope;
            double d = from * exp(centre + (i % 2 ? half : -half) * gauss_node[i / 2]);
            sum += half * gauss_weight[i / 2] * d * closed_form_loading_force(law, d, &slope);
        }
    }
    return sum;
}

static double closed_form_loading_work(const struct contact_law *law, double d)
{
    /* panels at which the rule leaves 1e-10 of the work; the step between the pieces bends more */
    const double step_panel = 0.1;
    const double panel = 0.35;
    double start = PLASTIC_FROM * law->parameters[YIELD_DEPTH];
    double full = PLASTIC_FULL * law->parameters[YIELD_DEPTH];
    double elastic = smaller(d, start);
    double sum = 0.4 * law->parameters[STIFFNESS] * elastic * elastic * sqrt(elastic);
    if (d > start)
        sum += work_between(law, start, smaller(d, full), step_panel);
    if (d > full)
        sum += work_between(law, full, d, panel);
    return sum;
}

static double closed_form_next_joint(const struct contact_law *law, double d)
{
    double w = d / law->parameters[YIELD_DEPTH];
    double joint = w < PLASTIC_FROM ? PLASTIC_FROM : w < PLASTIC_FULL ? PLASTIC_FULL : INFINITY;
    return joint * law->parameters[YIELD_DEPTH];
}

static double closed_form_yield_depth(const struct contact_law *law)
{
    return law->parameters[YIELD_DEPTH];
}

static double closed_form_residual_depth(const struct contact_law *law, double d)
{
    double w = d / law->parameters[YIELD_DEPTH];
    if (!(w > 1.0))
        return 0.0;
    /* elastic recovery */
    double back = 1.02 * pow((smaller(w, SPRING_FIT) + 5.9) / 6.9, -0.54) - 0.02;
    if (w > SPRING_FIT)
        back *= sqrt(SPRING_FIT / w);
    double t = smaller(1.0, (w - 1.0) / (PLASTIC_FROM - 1.0));
    return d * (1.0 - back) * t * t * (3.0 - 2.0 * t);
}

static double closed_form_contact_radius(const struct contact_law *law, double d)
{
    double w = d / law->parameters[YIELD_DEPTH];
    double growth = w > PLASTIC_FROM ? pow(w / PLASTIC_FROM, law->parameters[GROWTH]) : 1.0;
    return sqrt(law->parameters[RADIUS] * d * growth);
}

static double branch(const struct contact_law *law, double x, double *slope)
{
    (void)law;
    double root = sqrt(x);
    *slope = 1.5 * root;
    return x * root;
}

static double closed_form_branch_work(const struct contact_law *law, double x)
{
    (void)law;
    return 0.4 * x * x * sqrt(x);
}

/* The depth of yield goes like the square of the stress. */
static void closed_form_rescale(struct contact_law *law, double force, double yield)
{
    law->parameters[STIFFNESS] *= force;
    law->parameters[YIELD_DEPTH] *= yield * yield;
}

static const struct plastic_curve closed_form_curve = {
    .force = closed_form_loading_force,
    .work = closed_form_loading_work,
    .joint = closed_form_next_joint,
    .yield = closed_form_yield_depth,
    .residual = closed_form_residual_depth,
    .radius = closed_form_contact_radius,
    .branch = branch,
    .branch_work = closed_form_branch_work,
};

const struct contact_law_operations contact_law_CLOSED_FORM = {
    .model = PERCUSS_CONTACT_CLOSED_FORM,
    .effort = CONTACT_EFFORT_LEAST,
    .make = contact_law_closed_form,
    .title = "the closed form of Jackson and Green",
    .force = plastic_force,
    .stored = plastic_stored,
    .indentation = plastic_indentation,
    .curve = &closed_form_curve,
    .rescale = closed_form_rescale,
};

struct contact_law contact_law_closed_form(const struct hertz_contact *hertz,
                                           const struct material *a, const struct material *b)
{
    int side = closed_form_softer(a, b);
    const struct material *softer = side == 1 ? b : a;
    if (side < 0)
        return contact_law_hertz(hertz->stiffness);
    return (struct contact_law){
        .operations = &contact_law_CLOSED_FORM,
        .parameters = {[STIFFNESS] = hertz->stiffness,
                       [YIELD_DEPTH] = closed_form_yield(hertz, a, b),
                       [RADIUS] = closed_form_radius(hertz),
                       [GROWTH] = 0.14 * exp(23.0 * softer->yield / hertz->effective_modulus),
                       [HARDNESS] = 4.0 * 2.84 * softer->yield / closed_form_pressure(softer)},
    };
}
