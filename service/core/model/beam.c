/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The bending modes of a Timoshenko beam: its waves, its eigenvalues in ascending order, and the
 * mode of each. beam_statics.c has the static compliance. */
#include "model/beam.h"

#include <float.h>
#include <math.h>

/* Waves: the four solutions w(s) e^(i omega t) of a uniform beam, s = x/length in [-1/2, 1/2], and
 * their end values.
 *
 * With b^2 = rhoA L^4 omega^2/EI, r^2 = rhoI/(rhoA L^2), q^2 = EI/(kGA L^2), slope Psi = L psi,
 * moment M = Psi', shear V = (w' - Psi)/q^2, the equations are V' = -b^2 w and
 * Psi'' + V + b^2 r^2 Psi = 0 (Timoshenko 1921). e^(lambda s) solves them for
 *   lambda^4 + b^2 (r^2 + q^2) lambda^2 - b^2 (1 - b^2 r^2 q^2) = 0,
 * with Psi = (lambda^2 + b^2 q^2)/lambda w and V = -b^2/lambda w: lambda = +-alpha, +-i beta. Above
 * the cut-off b r q = 1 alpha is imaginary. r = q = 0 is Euler-Bernoulli's beam. */

/* C(s) and P(s) are cosh(alpha s) and sinh(alpha s)/alpha over cosh(alpha/2); above the cut-off
 * cos(a s) and sin(a s)/a with a = |alpha|. They are regular where alpha vanishes and never
 * overflow. */
struct beam_wave {
    double b;
    double alpha, beta;   /* moduli */
    double alpha_squared; /* signed: negative above the cut-off */
    double hyper, trig;   /* alpha^2 + b^2 q^2 and beta^2 - b^2 q^2: Psi/w times lambda; > 0 */
    double cosh_end;      /* C(1/2) */
    double sinh_end;      /* P(1/2) */
    double cos_end;       /* cos(beta/2) */
    double sin_end;       /* sin(beta/2) */
    double sech_squared;  /* 1/cosh(alpha/2)^2; 1 above the cut-off */
};

/* Deflection, Psi, M, V/b^2 */
enum beam_quantity { BEAM_DEFLECTION, BEAM_SLOPE, BEAM_MOMENT, BEAM_SHEAR };

/* b r q beyond which the first wave is trigonometric is where alpha^2 changes sign; alpha itself
 * stays above this, so that quotients by it are finite and have their limits. */
static const double SMALLEST_ALPHA = 1e-150;

/* alpha^2 and beta^2 without cancellation: with p = b^2(r^2 + q^2) and c = b^2(1 - b^2 r^2 q^2),
 * beta^2 = p/2 + sqrt(p^2/4 + c) and alpha^2 beta^2 = c. With d = b^2(q^2 - r^2)/2 the root is
 * sqrt(d^2 + b^2), alpha^2 + b^2 q^2 = d + root, and its product with beta^2 - b^2 q^2 is b^2. */
static void set_wave_numbers(struct beam_wave *wave, const struct beam_ratios *ratios, double b)
{
    double squared = b * b;
    double half = 0.5 * squared * (ratios->shear - ratios->inertia);
    double root = sqrt(half * half + squared);
    double beta_squared = 0.5 * squared * (ratios->shear + ratios->inertia) + root;

    wave->b = b;
    wave->beta = sqrt(beta_squared);
    wave->alpha_squared =
        squared * (1.0 - squared * ratios->inertia * ratios->shear) / beta_squared;
    wave->alpha = fmax(sqrt(fabs(wave->alpha_squared)), SMALLEST_ALPHA);
    if (half >= 0.0) {
        wave->hyper = half + root;
        wave->trig = squared / wave->hyper;
    } else {
        wave->trig = root - half;
        wave->hyper = squared / wave->trig;
    }
}

static struct beam_wave beam_wave_at(const struct beam_ratios *ratios, double b)
{
    struct beam_wave wave;

    set_wave_numbers(&wave, ratios, b);
    if (wave.alpha_squared >= 0.0) {
        double decay = expm1(-wave.alpha); /* tanh(alpha/2) = -decay/(2 + decay) */
        double tanh_half = -decay / (2.0 + decay);
        wave.cosh_end = 1.0;
        wave.sinh_end = tanh_half / wave.alpha;
        wave.sech_squared = 4.0 * (1.0 + decay) / ((2.0 + decay) * (2.0 + decay));
    } else {
        wave.cosh_end = cos(0.5 * wave.alpha);
        wave.sinh_end = sin(0.5 * wave.alpha) / wave.alpha;
        wave.sech_squared = 1.0;
    }
    wave.cos_end = cos(0.5 * wave.beta);
    wave.sin_end = sin(0.5 * wave.beta);
    return wave;
}

static void even_values(const struct beam_wave *wave, enum beam_quantity quantity, double values[2])
{
    switch (quantity) {
    case BEAM_DEFLECTION:
        values[0] = wave->cosh_end;
        values[1] = wave->cos_end;
        break;
    case BEAM_SLOPE:
        values[0] = wave->hyper * wave->sinh_end;
        values[1] = -wave->trig / wave->beta * wave->sin_end;
        break;
    case BEAM_MOMENT:
        values[0] = wave->hyper * wave->cosh_end;
        values[1] = -wave->trig * wave->cos_end;
        break;
    case BEAM_SHEAR:
        values[0] = -wave->sinh_end;
        values[1] = -wave->sin_end / wave->beta;
        break;
    }
}

static void odd_values(const struct beam_wave *wave, enum beam_quantity quantity, double values[2])
{
    double sinh_end = wave->alpha_squared * wave->sinh_end / wave->beta;

    /* hyperbolic and trigonometric part of each, at the end */
    switch (quantity) {
    case BEAM_DEFLECTION:
        values[0] = sinh_end;
        values[1] = wave->sin_end;
        break;
    case BEAM_SLOPE:
        values[0] = wave->hyper / wave->beta * wave->cosh_end;
        values[1] = wave->trig / wave->beta * wave->cos_end;
        break;
    case BEAM_MOMENT:
        values[0] = wave->hyper * sinh_end;
        values[1] = -wave->trig * wave->sin_end;
        break;
    case BEAM_SHEAR:
        values[0] = -wave->cosh_end / wave->beta;
        values[1] = wave->cos_end / wave->beta;
        break;
    }
}

/* A quantity of the two solutions of the even or the odd class at s = 1/2. */
static void beam_wave_end_values(const struct beam_wave *wave, enum beam_quantity quantity,
                                 enum beam_parity parity, double values[2])
{
    if (parity == BEAM_EVEN)
        even_values(wave, quantity, values);
    else
        odd_values(wave, quantity, values);
}

static const enum beam_quantity held_quantities[][2] = {
    [SUPPORT_FREE] = {BEAM_MOMENT, BEAM_SHEAR},
    [SUPPORT_PINNED] = {BEAM_DEFLECTION, BEAM_MOMENT},
    [SUPPORT_CLAMPED] = {BEAM_DEFLECTION, BEAM_SLOPE},
};

/* Size of the values of a quantity that carry the rounding of a phase, a sine or a cosine of many
 * turns. Divided by it all conditions are equally uncertain, and elimination takes the one with the
 * largest remaining values; the hyperbolic values are good to the last bits. */
static double uncertainty_of(const struct beam_wave *wave, enum beam_quantity quantity)
{
    double hyper = wave->alpha_squared < 0.0 ? wave->hyper : 0.0;
    double shortest = fmin(0.5, 1.0 / wave->alpha); /* bound of P above the cut-off */

    switch (quantity) {
    case BEAM_SLOPE:
        return fmax(hyper * shortest, wave->trig / wave->beta);
    case BEAM_MOMENT:
        return fmax(hyper, wave->trig);
    case BEAM_SHEAR:
        return fmax(hyper > 0.0 ? shortest : 0.0, 1.0 / wave->beta);
    default:
        return 1.0;
    }
}

/* The zero conditions of a support on the two solutions of the even or odd class, scaled so that
 * their rounding errors are alike. */
static void beam_wave_conditions(const struct beam_wave *wave, enum support support,
                                 enum beam_parity parity, double rows[2][2])
{
    for (int i = 0; i < 2; i++) {
        enum beam_quantity quantity = held_quantities[support][i];
        double scale = 1.0 / uncertainty_of(wave, quantity);

        beam_wave_end_values(wave, quantity, parity, rows[i]);
        rows[i][0] *= scale;
        rows[i][1] *= scale;
    }
}

/* The conditions of both ends on all four solutions (even, even, odd, odd). */
static void beam_wave_coupled_conditions(const struct beam_wave *wave,
                                         const enum support supports[2], double rows[4][4])
{
    for (int end = 0; end < 2; end++) {
        double even[2][2], odd[2][2];
        /* at the left end each quantity of the one class has the opposite sign of the other's */
        double mirror = end == 0 ? -1.0 : 1.0;

        beam_wave_conditions(wave, supports[end], BEAM_EVEN, even);
        beam_wave_conditions(wave, supports[end], BEAM_ODD, odd);
        for (int i = 0; i < 2; i++) {
            rows[2 * end + i][0] = even[i][0];
            rows[2 * end + i][1] = even[i][1];
            rows[2 * end + i][2] = mirror * odd[i][0];
            rows[2 * end + i][3] = mirror * odd[i][1];
        }
    }
}

/* Eigenvalues. No root is missed and none is sought by steps. The pinned-pinned roots are closed
 * forms. Changing one degree of freedom at an end (letting the deflection go, or holding the slope)
 * moves the number of roots below any b by at most one (Rayleigh; Wittrick and Williams 1971, Q. J.
 * Mech. Appl. Math. 24, 263), so that between neighbouring roots of the one beam lies exactly one
 * of the other: pinned-pinned -> free at both ends (one change in the even class, one in the odd),
 * clamped at both ends (the same), clamped-pinned, pinned-free -> clamped-free. Every elastic root
 * of the right side thus has its own bracket, however close the roots are, also where two families
 * interleave above the cut-off. */

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
static double root_polish(const struct beam_interlaced_walk *walk, double low, double f_low,
                          double high, double f_high)
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
    return root_polish(walk, low, f_low, high, f_high);
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

/* Modes. */

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
static void pivot_eliminate(size_t n, double matrix[4][4], size_t step, const size_t pivot[2])
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
        pivot_eliminate(n, matrix, step, pivot);
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

/* Integrals over s of products of the solutions; an even one times an odd one has the integral 0.
 */
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

/* The first quantity that the right support does not hold; the mode's sign makes it positive there.
 */
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

double beam_frequency_of(const struct beam_plane *plane, const struct beam_unit_mode *unit)
{
    double time = plane->length * plane->length * sqrt(plane->line_mass / plane->bending_stiffness);
    return unit->b / time;
}

struct beam_mode beam_mode_of(const struct beam_plane *plane, const struct beam_unit_mode *unit)
{
    double mass = plane->line_mass * plane->length * unit->norm;
    double scale = copysign(1.0 / sqrt(mass), unit->end);
    double slope = scale / plane->length;
    const double *amplitudes = unit->amplitudes;

    return (struct beam_mode){
        .omega = beam_frequency_of(plane, unit),
        .alpha = unit->alpha,
        .beta = unit->beta,
        .even = {scale * amplitudes[0], scale * amplitudes[1]},
        .odd = {scale * amplitudes[2] * unit->alpha_squared / (unit->alpha * unit->beta),
                scale * amplitudes[3]},
        .even_slope = {slope * amplitudes[0] * unit->hyper / unit->alpha,
                       -slope * amplitudes[1] * unit->trig / unit->beta},
        .odd_slope = {slope * amplitudes[2] * unit->hyper / unit->beta,
                      slope * amplitudes[3] * unit->trig / unit->beta},
        .above_cutoff = unit->alpha_squared < 0.0,
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
    struct beam_unit_mode unit;

    beam_modes_start(plane, &walk);
    for (size_t k = 0; k < count; k++) {
        beam_modes_next(plane, &walk, 1, &unit);
        modes[k] = beam_mode_of(plane, &unit);
    }
}

bool beam_planes_alike(const struct beam_plane *a, const struct beam_plane *b)
{
    struct beam_ratios first = ratios_of(a), second = ratios_of(b);

    return first.inertia == second.inertia && first.shear == second.shear &&
           a->supports[0] == b->supports[0] && a->supports[1] == b->supports[1];
}

void beam_modes_next(const struct beam_plane *plane, struct beam_root_walk *walk, size_t count,
                     struct beam_unit_mode *modes)
{
    struct beam_ratios ratios = ratios_of(plane);
    bool mirrored = is_mirrored(plane);
    enum support supports[2] = {plane->supports[mirrored], plane->supports[!mirrored]};

    for (size_t k = 0; k < count; k++) {
        struct beam_root root = beam_root_walk_next(walk);
        if (!modes)
            continue;
        struct beam_wave wave = beam_wave_at(&ratios, root.b);
        double amplitudes[4];

        find_amplitudes(&wave, &root, supports, amplitudes);
        if (mirrored) {
            amplitudes[2] = -amplitudes[2];
            amplitudes[3] = -amplitudes[3];
        }
        modes[k] = (struct beam_unit_mode){
            .b = wave.b,
            .alpha = wave.alpha,
            .beta = wave.beta,
            .alpha_squared = wave.alpha_squared,
            .hyper = wave.hyper,
            .trig = wave.trig,
            .amplitudes = {amplitudes[0], amplitudes[1], amplitudes[2], amplitudes[3]},
            .norm = squared_norm(&wave, ratios.inertia, amplitudes),
            .end = right_end_value(&wave, plane->supports[1], amplitudes),
        };
    }
}

/* cosh(x) or sinh(|x|) (sign +1 or -1) over cosh(alpha/2), through decaying exponentials only. */
static void solution_hyperbolic(double alpha, double s, double *c, double *sn)
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
        solution_hyperbolic(mode->alpha, s, &at.c, &at.sn);
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

    /* mean of psi' over the window, or over its part on the beam */
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
