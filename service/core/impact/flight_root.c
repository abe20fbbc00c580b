/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/flight_root.h"

#include <math.h>

#include "base/extremes.h"
#include "impact/flight_kernel.h"

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
        /* opens, or turns before it closes; otherwise at the later root */
        if (excess >= 0.0 && (rate >= 0.0 || (acceleration > 0.0 && discriminant < 0.0)))
            *first = 0.0;
        else if (acceleration > 0.0)
            *first = (sqrt(larger(0.0, discriminant)) - rate) / acceleration;
        else if (rate > 0.0)
            *first = -excess / rate;
        return;
    }
    /* pressing: only while x rises, and if its maximum is >= 0 */
    double discriminant = rate * rate - 2.0 * acceleration * excess;
    if (rate <= 0.0 || discriminant < 0.0)
        return;
    *first = excess >= 0.0 ? 0.0 : -2.0 * excess / (rate + sqrt(discriminant));
    *last = -rate / acceleration;
}

double flight_root_rate(double excess, double rate, double unknown, double left)
{
    bool none = rate < 0.0 && -rate <= unknown && excess + rate * left > 0.0;
    return none ? 0.0 : rate;
}

/* omega t of the fastest mode up to which the series is exact to rounding: 1/20! = 4e-19. */
static const double SERIES_ANGLE = 1.0;

double flight_root_longest(const struct scene *scene)
{
    double highest = scene_highest_frequency(scene);
    return highest > 0.0 ? SERIES_ANGLE / highest : INFINITY;
}

/* d(s length) = sum_n term[n] s^n on a free motion. */
static void make_series(const struct motion *motion, const struct scene *scene, size_t contact,
                        double length, double term[ROOT_TERMS])
{
    /* derivatives of gap and modes */
    double sums[ROOT_TERMS] = {motion->gap[contact], motion->gap_rate[contact] * length,
                               scene->gap_acceleration[contact] * length * length};
    for (size_t g = 0; g < scene->groups; g++) {
        const struct flight_modes modes =
            flight_modes_of(&scene->group[g], contact, motion->q[g], motion->v[g]);
        if (modes.phi)
            flight_kernel_terms(&modes, length, sums);
    }
    /* over n! */
    double factorial = -1.0;
    for (int n = 0; n < ROOT_TERMS; n++) {
        term[n] = sums[n] / factorial;
        factorial *= n + 1;
    }
}

/* The same polynomial on a part [low, high] of [0, 1], by Bernstein's coefficients: it lies between
 * the least and the largest of them, begins and ends with the first and the last, and has as many
 * roots inside as they change their sign, or an even number fewer (G. Farin, Curves and Surfaces
 * for CAGD, 5th ed. 2002, chapter 6). */
struct piece {
    double low, high;
    double b[ROOT_TERMS];
};

/* b_j = sum_(i <= j) binomial(j, i)/binomial(n, i) term_i, by repeated sums of neighbours. */
static struct piece make_piece(const double term[ROOT_TERMS])
{
    struct piece piece = {.low = 0.0, .high = 1.0};
    double binomial = 1.0;
    for (int n = 0; n < ROOT_TERMS; n++) {
        piece.b[n] = term[n] / binomial;
        binomial *= (double)(ROOT_TERMS - 1 - n) / (n + 1);
    }
#pragma GCC unroll 20
    for (int round = 1; round < ROOT_TERMS; round++)
#pragma GCC unroll 20
        for (int j = ROOT_TERMS - 1; j >= round; j--)
            piece.b[j] += piece.b[j - 1];
    return piece;
}

/* De Casteljau's rule: the piece becomes its left half, the right one is returned. */
static struct piece halve(struct piece *piece)
{
    struct piece right = {0.5 * (piece->low + piece->high), piece->high, {0.0}};
    double *b = piece->b;
    piece->high = right.low;
    right.b[ROOT_TERMS - 1] = b[ROOT_TERMS - 1];
    for (int round = 1; round < ROOT_TERMS; round++) {
        for (int j = ROOT_TERMS - 1; j >= round; j--)
            b[j] = 0.5 * (b[j] + b[j - 1]);
        right.b[ROOT_TERMS - 1 - round] = b[ROOT_TERMS - 1];
    }
    return right;
}

static int sign_changes(const struct piece *piece)
{
    int changes = 0;
    double last = 0.0;
    for (int j = 0; j < ROOT_TERMS; j++) {
        changes += piece->b[j] * last < 0.0;
        if (piece->b[j] != 0.0)
            last = piece->b[j] > 0.0 ? 1.0 : -1.0;
    }
    return changes;
}

/* Pieces of 2^-MOST_HALVINGS are rounding: two roots so close are a graze. */
enum { MOST_HALVINGS = 50 };

/* Whether the polynomial rises from the beginning of a piece on: its first derivative that is not
 * zero is positive, and so is the first difference of its coefficients. */
static bool begins_to_rise(const struct piece *piece)
{
    int j = 1;
    while (j < ROOT_TERMS - 1 && piece->b[j] == piece->b[0])
        j++;
    return piece->b[j] > piece->b[0];
}

/* The first piece in which the polynomial rises through zero just once, or [low, low] where it
 * begins at or above zero and rises. False: nowhere. */
static bool find_rise(struct piece *piece, int halvings)
{
    int changes = sign_changes(piece);
    const double *b = piece->b;
    if (b[0] >= 0.0 && begins_to_rise(piece)) {
        piece->high = piece->low;
        return true;
    }
    if (changes <= 1)
        return changes == 1 && b[ROOT_TERMS - 1] > 0.0;
    if (halvings == 0)
        return false;
    /* the left half, then the right one */
    struct piece right = halve(piece);
    if (find_rise(piece, halvings - 1))
        return true;
    *piece = right;
    return find_rise(piece, halvings - 1);
}

/* Newton's method with bisection needs fewer. */
enum { MAX_ROUNDS = 100 };
/* Relative, of an instant: half a bit, as Newton's method has. */
static const double ROUNDING = 1e-16;

/* Where the control polygon of a piece, the coefficients at equal distances, rises through zero. */
static double polygon_root(const struct piece *piece)
{
    int j = 1;
    while (j < ROOT_TERMS - 1 && !(piece->b[j] > 0.0))
        j++;
    double share = piece->b[j - 1] / (piece->b[j - 1] - piece->b[j]);
    return piece->low + (piece->high - piece->low) * (j - 1 + share) / (ROOT_TERMS - 1);
}

/* The series and its rate by Horner's rule. */
static double value_at(const double term[ROOT_TERMS], double s, double *rate)
{
    double value = term[ROOT_TERMS - 1];
    double slope = 0.0;
#pragma GCC unroll 20
    for (int n = ROOT_TERMS - 2; n >= 0; n--) {
        slope = slope * s + value;
        value = value * s + term[n];
    }
    *rate = slope;
    return value;
}

/* The root of the series in a piece where it rises through zero once: Newton's method from the
 * polygon's root, bisection where that leaves the bounds. */
static double rising_root(const double term[ROOT_TERMS], const struct piece *piece)
{
    double low = piece->low;
    double high = piece->high;
    double s = polygon_root(piece);
    double before = 0.0;
    for (int i = 0; i < MAX_ROUNDS; i++) {
        /* the sign tightens the bounds */
        double rate;
        double d = value_at(term, s, &rate);
        if (d > 0.0)
            high = s;
        else
            low = s;
        /* Newton's method while it stays between them: it converges quadratically, so that the next
         * step is this one times (this/before)^2 */
        double next = rate > 0.0 ? s - d / rate : low;
        double step = fabs(next - s);
        bool inside = next > low && next < high;
        if (step <= ROUNDING * s || high - low <= ROUNDING * high ||
            (inside && step * step * step <= ROUNDING * s * before * before))
            return next;
        before = inside ? step : 0.0;
        s = inside ? next : 0.5 * (low + high);
    }
    return s;
}

bool flight_root_touch(const struct motion *motion, const struct scene *scene, size_t contact,
                       double length, double *time)
{
    double term[ROOT_TERMS];
    make_series(motion, scene, contact, length, term);
    struct piece piece = make_piece(term);
    if (!find_rise(&piece, MOST_HALVINGS))
        return false;
    *time = length * (piece.high > piece.low ? rising_root(term, &piece) : piece.low);
    return true;
}
