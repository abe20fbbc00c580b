/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The waves of a straight uniform bar as families of modes: longitudinal, bending, twist. */
#include "model/bar_waves.h"

#include <math.h>

#include "model/bar.h"
#include "model/beam.h"

/* Ends that hold the axis and the twist: any support does. */
static int bar_held_ends(const struct body *body)
{
    return (body->supports[0] != SUPPORT_FREE) + (body->supports[1] != SUPPORT_FREE);
}

/* Wave number of mode k = 0, 1, ..., rad/m. */
static double longitudinal_wave_number(const struct body *body, size_t k)
{
    double half_waves = bar_held_ends(body) == 1 ? (double)k + 0.5 : (double)k + 1.0;
    return half_waves * M_PI / body->span;
}

/* Lateral inertia: kinetic energy grows by this share, (nu r_p k)^2 with the polar radius of
 * gyration (Love; Graff, Wave Motion in Elastic Solids, section 2.5.3). */
static double lateral_share(const struct body *body, double wave_number)
{
    if (!body->lateral_inertia)
        return 0.0;
    double x = body->material.poisson * wave_number * body->radius * M_SQRT1_2;
    return x * x;
}

static void find_longitudinal(const struct body *body, struct modal_family *modes)
{
    double speed = sqrt(body->material.young / body->material.density);
    for (size_t k = 0; k < modes->count; k++) {
        double wave_number = longitudinal_wave_number(body, k);
        modes->omega[k] = wave_number * speed / sqrt(1.0 + lateral_share(body, wave_number));
    }
}

/* Whether a force acts on an end, of the two ends which. */
static bool is_on_end(const struct body *body, double x)
{
    return fabs(x) >= 0.5 * body->span;
}

/* Distance from the held end, or from the left one if none or both are, in lengths. */
static double along_from(const struct body *body, double x)
{
    bool from_right = bar_held_ends(body) == 1 && body->supports[0] == SUPPORT_FREE;
    return 0.5 + (from_right ? -x : x) / body->span;
}

/* cos or sin of mode k, largest at a free end; sign by the number of half waves between: free-free
 * cos(k pi s) with k from 1, s from the left end; one end held: +1 at the free end; both held: sin.
 */
static double longitudinal_shape(const struct body *body, size_t k, double x)
{
    int held = bar_held_ends(body);
    double wave = longitudinal_wave_number(body, k) * body->span;
    if (is_on_end(body, x) && held == 0)
        return x > 0.0 && k % 2 == 0 ? -1.0 : 1.0;
    double s = along_from(body, x);
    return held == 0 ? cos(wave * s) : held == 1 ? cos(wave * (1.0 - s)) : sin(wave * s);
}

/* u_k = sqrt(2/M) times the shape. */
static void longitudinal_participations(const struct body *body, const struct modal_family *modes,
                                        const size_t *which, size_t count,
                                        const struct family_load *load, double *row)
{
    (void)modes;
    for (size_t i = 0; i < count; i++) {
        size_t k = which[i];
        double share = lateral_share(body, longitudinal_wave_number(body, k));
        double amplitude = sqrt(2.0 / (body->mass * (1.0 + share)));
        row[i] = longitudinal_shape(body, k, load->bar.x) * amplitude * load->bar.force;
    }
}

/* Displacement at s_i due to a force at s_j, in L/(EA). Free-free with inertia relief: 1/3 at the
 * same end, -1/6 across (u along x), (s^3 + (1 - s)^3)/3 where it acts. */
static double along_share(int held, double s_i, double s_j)
{
    double low = fmin(s_i, s_j), high = fmax(s_i, s_j);
    if (held > 0)
        return held == 1 ? low : low * (1.0 - high);
    return 1.0 / 3.0 - high + 0.5 * (low * low + high * high);
}

static double longitudinal_compliance(const struct body *body, size_t family,
                                      const struct family_load *i, const struct family_load *j)
{
    (void)family;
    double full = body->span / (body->material.young * body->area);
    bool on_ends = is_on_end(body, i->bar.x) && is_on_end(body, j->bar.x);
    double share;
    if (on_ends && bar_held_ends(body) == 0)
        share = (i->bar.x > 0.0) == (j->bar.x > 0.0) ? 1.0 / 3.0 : -1.0 / 6.0;
    else
        share = along_share(bar_held_ends(body), along_from(body, i->bar.x),
                            along_from(body, j->bar.x));
    return share * full * i->bar.force * j->bar.force;
}

static bool longitudinal_crowds(const struct body *body)
{
    return body->lateral_inertia;
}

const struct mode_family longitudinal_family = {
    .find = find_longitudinal,
    .participations = longitudinal_participations,
    .compliance = longitudinal_compliance,
    .crowds = longitudinal_crowds,
};

/* Bending by beam.h. */

static int plane_number(size_t family)
{
    return family == BAR_BENDING_Z;
}

/* The search for modes, and how many it has passed. */
struct bending_walk {
    struct beam_root_walk roots;
    size_t passed;
};

static void find_bending(const struct body *body, struct modal_family *modes)
{
    struct beam_plane plane = beam_plane_of(body, plane_number(modes->family));
    struct beam_unit_mode *shapes = modes->shapes;
    struct bending_walk *walk = modes->walk;
    size_t known = modes->known;
    /* of known modes some may have been left out since */
    if (modes->count > known && (known == 0 || walk->passed != known)) {
        beam_modes_start(&plane, &walk->roots);
        beam_modes_next(&plane, &walk->roots, known, NULL);
    }
    if (modes->count > known) {
        beam_modes_next(&plane, &walk->roots, modes->count - known, shapes + known);
        walk->passed = modes->count;
    }
    bool alike = plane.supports[0] == plane.supports[1];
    for (size_t k = 0; k < modes->count; k++) {
        const double *amplitudes = shapes[k].amplitudes;
        modes->omega[k] = beam_frequency_of(&plane, &shapes[k]);
        modes->odd[k] = alike && amplitudes[0] == 0.0 && amplitudes[1] == 0.0;
    }
}

static bool bending_alike(const struct body *a, const struct body *b, size_t family)
{
    struct beam_plane first = beam_plane_of(a, plane_number(family));
    struct beam_plane second = beam_plane_of(b, plane_number(family));
    return beam_planes_alike(&first, &second);
}

static void bending_participations(const struct body *body, const struct modal_family *modes,
                                   const size_t *which, size_t count,
                                   const struct family_load *load, double *row)
{
    struct beam_plane plane = beam_plane_of(body, plane_number(modes->family));
    const struct beam_unit_mode *shapes = modes->shapes;
    for (size_t i = 0; i < count; i++) {
        struct beam_mode mode = beam_mode_of(&plane, &shapes[which[i]]);
        row[i] = beam_mode_on(&plane, &mode, &load->bar);
    }
}

static double bending_compliance(const struct body *body, size_t family,
                                 const struct family_load *i, const struct family_load *j)
{
    struct beam_plane plane = beam_plane_of(body, plane_number(family));
    return beam_compliance(&plane, &i->bar, &j->bar);
}

const struct mode_family beam_bending_family = {
    .bends = true,
    .shape_size = sizeof(struct beam_unit_mode),
    .walk_size = sizeof(struct bending_walk),
    .find = find_bending,
    .alike = bending_alike,
    .participations = bending_participations,
    .compliance = bending_compliance,
};

/* Twist. */

/* J = a b^3/3 (1 - 192 b/(pi^5 a) sum tanh(n pi a/(2b))/n^5), n odd, a >= b. The sum of 1/n^5 is
 * 31/32 zeta(5), and 1 - tanh z = 2/(exp(2z) + 1) falls geometrically. */
double torsion_constant(const struct body *body)
{
    static const double zeta5 = 1.03692775514336992633;
    if (body->radius > 0.0)
        return 0.5 * M_PI * pow(body->radius, 4.0);
    double a = fmax(body->width, body->height), b = fmin(body->width, body->height);
    double sum = 31.0 / 32.0 * zeta5;
    for (int n = 1; n < 40; n += 2)
        sum -= 2.0 / ((exp(n * M_PI * a / b) + 1.0) * pow(n, 5.0));
    return a * b * b * b / 3.0 * (1.0 - 192.0 * b / (pow(M_PI, 5.0) * a) * sum);
}

/* The warping function is y z - sum C_n sin(k z) sinh(k y)/cosh(k a/2) with k = n pi/b, n odd,
 * |C_n| = 8 b^2/(pi n)^3; the terms' squares and products with y z are integrated one by one. */
double torsion_warping_constant(const struct body *body)
{
    if (body->radius > 0.0)
        return 0.0;
    double a = fmax(body->width, body->height), b = fmin(body->width, body->height);
    double sum = 0.0;
    for (int n = 199; n > 0; n -= 2) {
        double k = n * M_PI / b, c = 8.0 * b * b / pow(M_PI * n, 3.0);
        double t = tanh(0.5 * k * a);
        double with_yz = c * 4.0 / (k * k) * (0.5 * a / k - t / (k * k));
        double square = c * c * 0.5 * b * (t / k - 0.5 * a * (1.0 - t * t));
        sum += square - 2.0 * with_yz;
    }
    return pow(a * b, 3.0) / 144.0 + sum;
}

/* The free bar from which all cases follow. Between two held ends the shapes are sines; a bar held
 * at one end has the odd shapes of a free bar of twice the length. */
struct twisted_bar {
    double length;
    double stiffness, inertia;                 /* G J, rho I_p */
    double warping_stiffness, warping_inertia; /* E Gamma, rho Gamma */
    int held;
};

static struct twisted_bar bar_of(const struct body *body)
{
    double gamma = body->warping_constant;
    int held = bar_held_ends(body);
    double polar = body->second_moment[0] + body->second_moment[1];
    return (struct twisted_bar){
        .length = held == 1 ? 2.0 * body->span : body->span,
        .stiffness = material_shear_modulus(&body->material) * body->torsion_constant,
        .inertia = body->material.density * polar,
        .warping_stiffness = body->material.young * gamma,
        .warping_inertia = body->material.density * gamma,
        .held = held,
    };
}

/* Half waves of mode k. Those of a bar held at one end count in the double length: odd ones. */
static double half_waves(const struct twisted_bar *bar, size_t k)
{
    return bar->held == 1 ? 2.0 * (double)k + 1.0 : (double)k + 1.0;
}

static bool is_odd_class(const struct twisted_bar *bar, size_t k)
{
    return bar->held == 1 || k % 2 == 0;
}

/* omega^2 of waves with the wave number beta. */
static double frequency_squared(const struct twisted_bar *bar, double beta)
{
    double b2 = beta * beta;
    return b2 * (bar->stiffness + bar->warping_stiffness * b2) /
           (bar->inertia + bar->warping_inertia * b2);
}

/* Decay of the other solution, from alpha^2 beta^2 = rho I_p omega^2/(E Gamma). */
static double twist_decay(const struct twisted_bar *bar, double beta, double omega_squared)
{
    return sqrt(bar->inertia * omega_squared / bar->warping_stiffness) / beta;
}

/* A free end (theta'' = 0, E Gamma theta''' = (G J - rho Gamma omega^2) theta') reflects waves with
 * a phase: beta L = n pi - 2 atan((beta/alpha)^3 tanh(alpha L/2)), for odd shapes coth. The right
 * side less the left falls with beta, from above 0 at 0 to below at n pi. */
static double phase_defect(const struct twisted_bar *bar, double waves, bool odd, double beta)
{
    double alpha = twist_decay(bar, beta, frequency_squared(bar, beta));
    double t = tanh(0.5 * alpha * bar->length);
    double ratio = beta / alpha;
    double turn = atan(ratio * ratio * ratio * (odd ? 1.0 / t : t));
    return waves * M_PI - 2.0 * turn - beta * bar->length;
}

/* Halving: 1e-16 of n pi in at most 60 steps. */
static double wave_number(const struct twisted_bar *bar, size_t k)
{
    double waves = half_waves(bar, k);
    double high = waves * M_PI / bar->length;
    double low = 0.0;
    if (bar->held == 2 || bar->warping_stiffness == 0.0)
        return high;
    low = fmax(0.0, (waves - 1.0) * M_PI / bar->length); /* the phase is below pi */
    for (;;) {
        double middle = 0.5 * (low + high);
        if (!(middle > low && middle < high))
            return middle;
        if (phase_defect(bar, waves, is_odd_class(bar, k), middle) > 0.0)
            low = middle;
        else
            high = middle;
    }
}

double torsion_frequency(const struct body *body, size_t k)
{
    struct twisted_bar bar = bar_of(body);
    return sqrt(frequency_squared(&bar, wave_number(&bar, k)));
}

/* beta of a frequency: the positive root of E Gamma b^4 + T b^2 = rho I_p omega^2, with
 * T = G J - rho Gamma omega^2, without cancellation. */
static double twist_wave_number(const struct twisted_bar *bar, double omega)
{
    double squared = omega * omega;
    double tension = bar->stiffness - bar->warping_inertia * squared;
    double product = bar->inertia * squared;
    double root = sqrt(tension * tension + 4.0 * bar->warping_stiffness * product);
    return tension >= 0.0 ? sqrt(2.0 * product / (tension + root))
                          : sqrt(0.5 * (root - tension) / bar->warping_stiffness);
}

/* Integrals over the bar of products of cos(beta x), sin(beta x), and the hyperbolic functions of
 * alpha x over cosh(alpha L/2). */
struct products {
    double cos_cos, sin_sin, cosh_cosh, sinh_sinh, cos_cosh, sin_sinh;
};

static struct products products_of(double half, double beta, double alpha)
{
    double t = tanh(alpha * half), c = cos(beta * half), s = sin(beta * half);
    double share = half * (1.0 - t * t), sum = 2.0 / (alpha * alpha + beta * beta);
    return (struct products){
        .cos_cos = half + s * c / beta,
        .sin_sin = half - s * c / beta,
        .cosh_cosh = t / alpha + share,
        .sinh_sinh = t / alpha - share,
        .cos_cosh = sum * (alpha * t * c + beta * s),
        .sin_sinh = sum * (alpha * s - beta * t * c),
    };
}

/* cos(beta x) + r cosh(alpha x)/cosh(alpha L/2), or the sines; theta'' = 0 at the ends gives r. */
static double free_shape(const struct twisted_bar *bar, bool odd, double omega, double x)
{
    double beta = twist_wave_number(bar, omega), half = 0.5 * bar->length;
    double alpha = twist_decay(bar, beta, omega * omega);
    struct products p = products_of(half, beta, alpha);
    double t = tanh(alpha * half), q = beta * beta / (alpha * alpha);
    double r = odd ? q * sin(beta * half) / t : q * cos(beta * half);
    double ab = 2.0 * r * alpha * beta, b2 = beta * beta, r2 = r * r, a2 = alpha * alpha;
    double even_part = p.cos_cos + 2.0 * r * p.cos_cosh + r2 * p.cosh_cosh;
    double odd_part = p.sin_sin + 2.0 * r * p.sin_sinh + r2 * p.sinh_sinh;
    double even_slope = b2 * p.sin_sin - ab * p.sin_sinh + r2 * a2 * p.sinh_sinh;
    double odd_slope = b2 * p.cos_cos + ab * p.cos_cosh + r2 * a2 * p.cosh_cosh;
    double mass = bar->inertia * (odd ? odd_part : even_part) +
                  bar->warping_inertia * (odd ? odd_slope : even_slope);
    /* cosh and sinh over cosh at the end, without overflow */
    double up = exp(alpha * (x - half)), down = exp(-alpha * (x + half));
    double scale = 1.0 / (1.0 + exp(-2.0 * alpha * half));
    double w =
        odd ? sin(beta * x) + r * scale * (up - down) : cos(beta * x) + r * scale * (up + down);
    return w / sqrt(mass);
}

double torsion_shape(const struct body *body, size_t k, double omega, double x)
{
    struct twisted_bar bar = bar_of(body);
    bool odd = is_odd_class(&bar, k);
    if (bar.held == 1) /* from the held end; the double bar has half the amplitude squared */
        x = body->supports[0] == SUPPORT_FREE ? 0.5 * body->span - x : x + 0.5 * body->span;
    if (bar.held == 2 || bar.warping_stiffness == 0.0) {
        double beta = half_waves(&bar, k) * M_PI / bar.length;
        double mass = 0.5 * bar.length * (bar.inertia + bar.warping_inertia * beta * beta);
        if (bar.held == 2)
            return sin(beta * (x + 0.5 * bar.length)) / sqrt(mass);
        return (bar.held == 1 ? M_SQRT2 : 1.0) * (odd ? sin(beta * x) : cos(beta * x)) / sqrt(mass);
    }
    return (bar.held == 1 ? M_SQRT2 : 1.0) * free_shape(&bar, odd, omega, x);
}

bool torsion_is_odd(const struct body *body, size_t k)
{
    struct twisted_bar bar = bar_of(body);
    return bar.held == 1 ? false : bar.held == 0 ? k % 2 == 0 : k % 2 == 1;
}

/* sinh(a) sinh(b)/sinh(c) with c >= a + b, all >= 0, without overflow. */
static double sinh_quotient(double a, double b, double c)
{
    return c > 0.0 ? 0.5 * exp(a + b - c) * expm1(-2.0 * a) * expm1(-2.0 * b) / -expm1(-2.0 * c)
                   : 0.0;
}

/* Solution of phi - lambda^2 phi'' = lambda delta(x - x_j) that vanishes at the ends. */
static double screened(double half, double lambda, double i, double j)
{
    double low = fmin(i, j), high = fmax(i, j);
    return sinh_quotient((half + low) / lambda, (half - high) / lambda, 2.0 * half / lambda);
}

/* 1 - cosh(x/lambda)/cosh(half/lambda) */
static double plateau(double half, double lambda, double x)
{
    double up = exp((x - half) / lambda), down = exp(-(x + half) / lambda);
    return 1.0 - (up + down) / (1.0 + exp(-2.0 * half / lambda));
}

/* Free bar: Saint-Venant's 1/3 - max + (i^2 + j^2)/2 less the share of warping. With
 * G J theta'' - E Gamma theta'''' = 1/L - delta and lambda^2 = E Gamma/(G J) the difference phi
 * solves phi - lambda^2 phi'' = (lambda^2/G J)(delta - 1/L) and is 0 at free ends (theta'' = 0
 * there); its mean is taken off. In L/(G J). */
static double free_share(const struct twisted_bar *bar, double i, double j)
{
    double length = bar->length, half = 0.5 * length;
    double from_i = i / length + 0.5, from_j = j / length + 0.5;
    double share = 1.0 / 3.0 - fmax(from_i, from_j) + 0.5 * (from_i * from_i + from_j * from_j);
    double lambda = sqrt(bar->warping_stiffness / bar->stiffness);
    if (lambda == 0.0)
        return share;
    double ratio = lambda / length;
    double mean = 1.0 - 2.0 * ratio * tanh(half / lambda);
    double plateaus = plateau(half, lambda, i) + plateau(half, lambda, j) - mean;
    return share - ratio * (screened(half, lambda, i, j) - ratio * plateaus);
}

double torsion_compliance(const struct body *body, double x_i, double x_j)
{
    struct twisted_bar bar = bar_of(body);
    double half = 0.5 * body->span, share;
    double lambda = sqrt(bar.warping_stiffness / bar.stiffness);
    if (bar.held == 2) {
        double low = fmin(x_i, x_j) + half, high = half - fmax(x_i, x_j);
        share = low * high / (bar.length * bar.length);
        if (lambda > 0.0)
            share -= lambda / bar.length * screened(half, lambda, x_i, x_j);
    } else if (bar.held == 1) {
        bool left_free = body->supports[0] == SUPPORT_FREE;
        double i = left_free ? half - x_i : x_i + half, j = left_free ? half - x_j : x_j + half;
        share = free_share(&bar, i, j) - free_share(&bar, i, -j);
    } else {
        share = free_share(&bar, x_i, x_j);
    }
    return share * bar.length / bar.stiffness;
}

static void find_twist(const struct body *body, struct modal_family *modes)
{
    for (size_t k = 0; k < modes->count; k++) {
        modes->omega[k] = torsion_frequency(body, k);
        modes->odd[k] = torsion_is_odd(body, k);
    }
}

static void twist_participations(const struct body *body, const struct modal_family *modes,
                                 const size_t *which, size_t count, const struct family_load *load,
                                 double *row)
{
    for (size_t i = 0; i < count; i++)
        row[i] =
            load->bar.moment * torsion_shape(body, which[i], modes->omega[which[i]], load->bar.x);
}

static double twist_compliance(const struct body *body, size_t family, const struct family_load *i,
                               const struct family_load *j)
{
    (void)family;
    return i->bar.moment * j->bar.moment * torsion_compliance(body, i->bar.x, j->bar.x);
}

const struct mode_family beam_twist_family = {
    .find = find_twist,
    .participations = twist_participations,
    .compliance = twist_compliance,
};
