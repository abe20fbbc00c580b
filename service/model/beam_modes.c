/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/beam.h"

#include <math.h>

#include "model/beam_roots.h"

static struct beam_ratios ratios_of(const struct beam_plane *plane)
{
    double square = plane->length * plane->length;

    return (struct beam_ratios){
        .inertia = plane->line_inertia / (plane->line_mass * square),
        .shear = plane->bending_stiffness / (plane->shear_stiffness * square),
    };
}

struct beam_plane beam_plane_of(const struct body *body, int plane)
{
    const struct material *material = &body->material;
    bool timoshenko = body->theory == THEORY_TIMOSHENKO;
    double shear = timoshenko
                       ? body->shear_factor[plane] * material_shear_modulus(material) * body->area
                       : INFINITY;
    return (struct beam_plane){
        .length = body->span,
        .bending_stiffness = material->young * body->second_moment[plane],
        .shear_stiffness = shear,
        .line_mass = material->density * body->area,
        .line_inertia = timoshenko ? material->density * body->second_moment[plane] : 0.0,
        .supports = {body->supports[0], body->supports[1]},
    };
}

/* The largest of the elements that elimination has not yet reached. */
static void find_pivot(size_t n, double matrix[4][4], size_t step, size_t pivot[2])
{
    double largest = -1.0;

    for (size_t i = step; i < n; i++) {
        for (size_t j = step; j < n; j++) {
            if (fabs(matrix[i][j]) > largest) {
                largest = fabs(matrix[i][j]);
                pivot[0] = i;
                pivot[1] = j;
            }
        }
    }
}

static void exchange(double *a, double *b)
{
    double kept = *a;

    *a = *b;
    *b = kept;
}

/* Brings the pivot to the diagonal and clears the column below it. */
static void eliminate(size_t n, double matrix[4][4], size_t step, const size_t pivot[2])
{
    for (size_t j = 0; j < n; j++)
        exchange(&matrix[step][j], &matrix[pivot[0]][j]);
    for (size_t i = 0; i < n; i++)
        exchange(&matrix[i][step], &matrix[i][pivot[1]]);
    for (size_t i = step + 1; i < n; i++) {
        double factor = matrix[i][step] / matrix[step][step];
        for (size_t j = step; j < n; j++)
            matrix[i][j] -= factor * matrix[step][j];
    }
}

/* Null vector of an n x n matrix of rank n - 1, by Gaussian elimination with complete pivoting: the
 * last pivot, zero but for rounding, is taken as zero. Destroys the matrix. */
static void null_vector(size_t n, double matrix[4][4], double vector[4])
{
    size_t place[4] = {0, 1, 2, 3}; /* of each column in the vector */

    for (size_t step = 0; step + 1 < n; step++) {
        size_t pivot[2] = {step, step};
        find_pivot(n, matrix, step, pivot);
        eliminate(n, matrix, step, pivot);
        size_t moved = place[step];
        place[step] = place[pivot[1]];
        place[pivot[1]] = moved;
    }
    vector[place[n - 1]] = 1.0;
    for (size_t i = n - 1; i-- > 0;) {
        double sum = 0.0;
        for (size_t j = i + 1; j < n; j++)
            sum += matrix[i][j] * vector[place[j]];
        vector[place[i]] = -sum / matrix[i][i];
    }
}

/* Amplitudes of C, cos(beta s), alpha^2 P/beta, sin(beta s) in the deflection, up to a factor. */
static void find_amplitudes(const struct beam_wave *wave, const struct beam_root *root,
                            const enum support supports[2], double amplitudes[4])
{
    double rows[4][4], conditions[2][2];
    size_t offset = root->parity == BEAM_ODD ? 2 : 0;

    for (size_t i = 0; i < 4; i++)
        amplitudes[i] = 0.0;
    if (root->family != BEAM_BOTH_FAMILIES) {
        /* the pinned-pinned beam: one pure wave, also where the families share a frequency */
        amplitudes[offset + (root->family == BEAM_BENDING_FAMILY ? 1 : 0)] = 1.0;
    } else if (root->parity == BEAM_COUPLED) {
        beam_wave_coupled_conditions(wave, supports, rows);
        null_vector(4, rows, amplitudes);
    } else {
        beam_wave_conditions(wave, supports[1], root->parity, conditions);
        for (size_t i = 0; i < 2; i++) {
            rows[i][0] = conditions[i][0];
            rows[i][1] = conditions[i][1];
        }
        null_vector(2, rows, amplitudes + offset);
    }
}

/* (sinh(x)/x - 1)/x^2, or (1 - sin(a)/a)/a^2 where x^2 = -a^2; for |x^2| < 1. */
static double sinh_excess(double x_squared)
{
    double sum = 0.0;

    for (int k = 9; k >= 0; k--)
        sum = (1.0 + x_squared * sum) / ((2.0 * k + 2.0) * (2.0 * k + 3.0));
    return sum;
}

/* Integrals over s of products of the solutions; those of even with odd ones vanish. */
struct products {
    double cc, pp;       /* C^2, P^2 */
    double cos2, sin2;   /* cos(beta s)^2, sin(beta s)^2 */
    double c_cos, p_sin; /* C cos(beta s), P sin(beta s) */
};

/* Elementary, from cosh^2 = (1 + cosh 2x)/2, cosh^2 - sinh^2 = 1 and
 * (cosh ax cos bx)' = a sinh cos - b cosh sin, (sinh ax sin bx)' = a cosh sin + b sinh cos. */
static struct products integrate_products(const struct beam_wave *wave)
{
    /* products of one kind, then of both */
    double product = wave->cosh_end * wave->sinh_end;
    double mean = wave->sin_end * wave->cos_end / wave->beta;
    double sum = wave->alpha_squared + wave->beta * wave->beta;
    struct products is = {
        .cc = product + 0.5 * wave->sech_squared,
        .cos2 = 0.5 + mean,
        .sin2 = 0.5 - mean,
        .c_cos = 2.0 *
                 (wave->alpha_squared * wave->sinh_end * wave->cos_end +
                  wave->beta * wave->cosh_end * wave->sin_end) /
                 sum,
        .p_sin = 2.0 *
                 (wave->cosh_end * wave->sin_end - wave->beta * wave->sinh_end * wave->cos_end) /
                 sum,
    };

    /* near the cut-off, where the quotient would lose its digits */
    if (fabs(wave->alpha_squared) < 1.0)
        is.pp = 0.5 * wave->sech_squared * sinh_excess(wave->alpha_squared);
    else
        is.pp = (product - 0.5 * wave->sech_squared) / wave->alpha_squared;
    return is;
}

/* Integral of w^2 + r^2 Psi^2 over s. */
static double squared_norm(const struct beam_wave *wave, double inertia, const double amplitudes[4])
{
    struct products is = integrate_products(wave);
    double even[2] = {amplitudes[0], amplitudes[1]};
    double odd[2] = {amplitudes[2] * wave->alpha_squared / wave->beta, amplitudes[3]};
    double even_slope[2] = {amplitudes[0] * wave->hyper, -amplitudes[1] * wave->trig / wave->beta};
    double odd_slope[2] = {amplitudes[2] * wave->hyper / wave->beta,
                           amplitudes[3] * wave->trig / wave->beta};
    double even_forms = even[0] * even[0] + inertia * odd_slope[0] * odd_slope[0];

    return even_forms * is.cc +
           (even[1] * even[1] + inertia * odd_slope[1] * odd_slope[1]) * is.cos2 +
           2.0 * (even[0] * even[1] + inertia * odd_slope[0] * odd_slope[1]) * is.c_cos +
           (odd[0] * odd[0] + inertia * even_slope[0] * even_slope[0]) * is.pp +
           (odd[1] * odd[1] + inertia * even_slope[1] * even_slope[1]) * is.sin2 +
           2.0 * (odd[0] * odd[1] + inertia * even_slope[0] * even_slope[1]) * is.p_sin;
}

/* The first quantity that the right support leaves free; its sign there is made positive. */
static double right_end_value(const struct beam_wave *wave, enum support support,
                              const double amplitudes[4])
{
    static const enum beam_quantity shown[] = {
        [SUPPORT_FREE] = BEAM_DEFLECTION,
        [SUPPORT_PINNED] = BEAM_SLOPE,
        [SUPPORT_CLAMPED] = BEAM_MOMENT,
    };
    double even[2], odd[2];

    beam_wave_end_values(wave, shown[support], BEAM_EVEN, even);
    beam_wave_end_values(wave, shown[support], BEAM_ODD, odd);
    return even[0] * amplitudes[0] + even[1] * amplitudes[1] + odd[0] * amplitudes[2] +
           odd[1] * amplitudes[3];
}

static struct beam_mode mode_of(const struct beam_plane *plane, const struct beam_wave *wave,
                                const double amplitudes[4], double scale)
{
    double slope = scale / plane->length;
    double unit = plane->length * plane->length * sqrt(plane->line_mass / plane->bending_stiffness);

    return (struct beam_mode){
        .omega = wave->b / unit,
        .alpha = wave->alpha,
        .beta = wave->beta,
        .even = {scale * amplitudes[0], scale * amplitudes[1]},
        .odd = {scale * amplitudes[2] * wave->alpha_squared / (wave->alpha * wave->beta),
                scale * amplitudes[3]},
        .even_slope = {slope * amplitudes[0] * wave->hyper / wave->alpha,
                       -slope * amplitudes[1] * wave->trig / wave->beta},
        .odd_slope = {slope * amplitudes[2] * wave->hyper / wave->beta,
                      slope * amplitudes[3] * wave->trig / wave->beta},
        .above_cutoff = wave->alpha_squared < 0.0,
    };
}

/* The roots are walked with the tighter support on the left. */
static bool is_mirrored(const struct beam_plane *plane)
{
    return plane->supports[0] < plane->supports[1];
}

void beam_modes_start(const struct beam_plane *plane, struct beam_root_walk *walk)
{
    struct beam_ratios ratios = ratios_of(plane);
    bool mirrored = is_mirrored(plane);
    enum support supports[2] = {plane->supports[mirrored], plane->supports[!mirrored]};

    beam_root_walk_start(walk, &ratios, supports);
}

void beam_modes(const struct beam_plane *plane, size_t count, struct beam_mode *modes)
{
    struct beam_root_walk walk;

    beam_modes_start(plane, &walk);
    beam_modes_next(plane, &walk, count, modes);
}

void beam_modes_next(const struct beam_plane *plane, struct beam_root_walk *walk, size_t count,
                     struct beam_mode *modes)
{
    struct beam_ratios ratios = ratios_of(plane);
    bool mirrored = is_mirrored(plane);
    enum support supports[2] = {plane->supports[mirrored], plane->supports[!mirrored]};

    for (size_t k = 0; k < count; k++) {
        struct beam_root root = beam_root_walk_next(walk);
        struct beam_wave wave = beam_wave_at(&ratios, root.b);
        double amplitudes[4];

        find_amplitudes(&wave, &root, supports, amplitudes);
        if (mirrored) {
            amplitudes[2] = -amplitudes[2];
            amplitudes[3] = -amplitudes[3];
        }
        double mass =
            plane->line_mass * plane->length * squared_norm(&wave, ratios.inertia, amplitudes);
        double end = right_end_value(&wave, plane->supports[1], amplitudes);
        modes[k] = mode_of(plane, &wave, amplitudes, copysign(1.0 / sqrt(mass), end));
    }
}

/* cosh(x) or sinh(|x|) (sign +1 or -1) over cosh(alpha/2), through decaying exponentials only. */
static void hyperbolic(double alpha, double s, double *c, double *sn)
{
    double distance = alpha * (0.5 - fabs(s));
    double fall = expm1(-2.0 * alpha * fabs(s));
    double scale = exp(-distance) / (1.0 + exp(-alpha));

    *c = scale * (2.0 + fall);
    *sn = copysign(-scale * fall, s);
}

/* The four solutions at s: C or cos(alpha s), S or sin(alpha s), cos(beta s), sin(beta s). */
struct solutions {
    double c, sn, cosine, sine;
};

static struct solutions solutions_at(const struct beam_mode *mode, double s)
{
    struct solutions at = {.cosine = cos(mode->beta * s), .sine = sin(mode->beta * s)};

    if (mode->above_cutoff) {
        at.c = cos(mode->alpha * s);
        at.sn = sin(mode->alpha * s);
    } else {
        hyperbolic(mode->alpha, s, &at.c, &at.sn);
    }
    return at;
}

static double deflection(const struct beam_mode *mode, const struct solutions *at)
{
    return mode->even[0] * at->c + mode->even[1] * at->cosine + mode->odd[0] * at->sn +
           mode->odd[1] * at->sine;
}

static double rotation(const struct beam_mode *mode, const struct solutions *at)
{
    return mode->even_slope[0] * at->sn + mode->even_slope[1] * at->sine +
           mode->odd_slope[0] * at->c + mode->odd_slope[1] * at->cosine;
}

void beam_mode_at(const struct beam_plane *plane, const struct beam_mode *mode, double x, double *w,
                  double *psi)
{
    struct solutions at = solutions_at(mode, x / plane->length);

    *w = deflection(mode, &at);
    *psi = rotation(mode, &at);
}

/* Difference of the rotations `half` (in lengths) beyond and before the place, by the solutions'
 * addition theorems. */
static double rotation_across(const struct beam_mode *mode, const struct solutions *at, double half)
{
    double wave = 2.0 * sin(mode->beta * half);
    double sign = mode->above_cutoff ? -1.0 : 1.0;
    double other = 2.0 * (mode->above_cutoff ? sin(mode->alpha * half) : sinh(mode->alpha * half));

    return other * (mode->even_slope[0] * at->c + sign * mode->odd_slope[0] * at->sn) +
           wave * (mode->even_slope[1] * at->cosine - mode->odd_slope[1] * at->sine);
}

double beam_mode_on(const struct beam_plane *plane, const struct beam_mode *mode,
                    const struct beam_load *load)
{
    double s = load->x / plane->length;
    struct solutions at = solutions_at(mode, s);
    double work = load->force * deflection(mode, &at);
    if (load->moment != 0.0)
        work += load->moment * rotation(mode, &at);
    if (load->curvature == 0.0)
        return work;

    /* mean of psi' about the place, or about what of that is on the beam */
    double half = 0.5 * load->window / plane->length;
    double from = fmax(s - half, -0.5), to = fmin(s + half, 0.5);
    double across;
    if (from == s - half && to == s + half) {
        across = rotation_across(mode, &at, half);
    } else {
        struct solutions first = solutions_at(mode, from), last = solutions_at(mode, to);
        across = rotation(mode, &last) - rotation(mode, &first);
    }
    return work + load->curvature * across / ((to - from) * plane->length);
}
