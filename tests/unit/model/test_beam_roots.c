/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/beam.c: no root is missed, none is doubled. */
#include "check.h"
#include "model/beam.h"

/* The independent judge: the dynamic stiffness matrix of Wittrick and Williams 1971. */

/* Deflection, slope, moment, shear of one of four plain solutions at s; decaying exponentials from
 * either end below the cut-off. */
static void solution_at(const struct beam_ratios *ratios, double b, int number, double s,
                        double value[4])
{
    double p = b * b * (ratios->inertia + ratios->shear);
    double c = b * b * (1.0 - b * b * ratios->inertia * ratios->shear);
    double z[2] = {-0.5 * p + sqrt(0.25 * p * p + c), -0.5 * p - sqrt(0.25 * p * p + c)};
    double square = z[number / 2], k = sqrt(fabs(square));
    double factor = (square + b * b * ratios->shear) / k; /* lambda^2 + b^2 q^2 over |lambda| */

    if (square > 0.0) {
        double sign = number % 2 ? -1.0 : 1.0;
        double e = exp(sign * k * s - 0.5 * k);
        value[0] = e;
        value[1] = sign * factor * e;
        value[2] = factor * k * e;
        value[3] = -sign * b * b / k * e;
        return;
    }
    double cosine = number % 2 ? sin(k * s) : cos(k * s);
    double sine = number % 2 ? -cos(k * s) : sin(k * s); /* minus the derivative over k */
    value[0] = cosine;
    value[1] = factor * sine;
    value[2] = factor * k * cosine;
    value[3] = -b * b / k * sine;
}

/* x = y a^-1, 4 x 4, by elimination on the columns; destroys both. */
static void divide_right(double a[4][4], double y[4][4])
{
    for (int step = 0; step < 4; step++) {
        int pivot = step;
        for (int j = step + 1; j < 4; j++) {
            if (fabs(a[step][j]) > fabs(a[step][pivot]))
                pivot = j;
        }
        for (int i = 0; i < 4; i++) {
            double kept_a = a[i][step], kept_y = y[i][step];
            a[i][step] = a[i][pivot];
            a[i][pivot] = kept_a;
            y[i][step] = y[i][pivot];
            y[i][pivot] = kept_y;
        }
        double scale = a[step][step];
        for (int i = 0; i < 4; i++) {
            a[i][step] /= scale;
            y[i][step] /= scale;
        }
        for (int j = 0; j < 4; j++) {
            double factor = a[step][j];
            for (int i = 0; i < 4 && j != step; i++) {
                a[i][j] -= factor * a[i][step];
                y[i][j] -= factor * y[i][step];
            }
        }
    }
}

/* End forces (conjugate to w0, psi0, w1, psi1) by end displacements. */
static void dynamic_stiffness(const struct beam_ratios *ratios, double b, double stiffness[4][4])
{
    double displacements[4][4];

    for (int j = 0; j < 4; j++) {
        for (int end = 0; end < 2; end++) {
            double value[4];
            double sign = end == 0 ? -1.0 : 1.0;
            solution_at(ratios, b, j, end - 0.5, value);
            displacements[2 * end][j] = value[0];
            displacements[2 * end + 1][j] = value[1];
            stiffness[2 * end][j] = sign * value[3];
            stiffness[2 * end + 1][j] = sign * value[2];
        }
    }
    divide_right(displacements, stiffness);
}

/* Negative eigenvalues of the part of a symmetric matrix that belongs to the chosen freedoms, by
 * the signs of the pivots (Sylvester). */
static int negative_count(double full[4][4], const int *chosen, int n)
{
    double a[4][4] = {{0}};
    int count = 0;

    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            a[i][j] = 0.5 * (full[chosen[i]][chosen[j]] + full[chosen[j]][chosen[i]]);
    }
    for (int step = 0; step < n; step++) {
        count += a[step][step] < 0.0;
        for (int i = step + 1; i < n; i++) {
            double factor = a[i][step] / a[step][step];
            for (int j = step; j < n; j++)
                a[i][j] -= factor * a[step][j];
        }
    }
    return count;
}

/* Pinned-pinned: b is above the k-th root of a branch when the left side is positive at it. */
static int pinned_count(const struct beam_ratios *ratios, double b)
{
    double square = b * b;
    double p = square * (ratios->inertia + ratios->shear);
    double c = square * (1.0 - square * ratios->inertia * ratios->shear);
    int count = (int)floor(sqrt(0.5 * p + sqrt(0.25 * p * p + c)) / M_PI);

    if (c < 0.0)
        count += 1 + (int)floor(sqrt(0.5 * p - sqrt(0.25 * p * p + c)) / M_PI);
    return count;
}

/* Eigenvalues below b, those of rigid motions included. */
static int wittrick_williams(const struct beam_ratios *ratios, const enum support supports[2],
                             double b)
{
    static const int rotations[2] = {1, 3};
    double stiffness[4][4];
    int freedoms[4], n = 0;

    dynamic_stiffness(ratios, b, stiffness);
    for (int end = 0; end < 2; end++) {
        if (supports[end] == SUPPORT_FREE)
            freedoms[n++] = 2 * end;
        if (supports[end] != SUPPORT_CLAMPED)
            freedoms[n++] = 2 * end + 1;
    }
    return pinned_count(ratios, b) + negative_count(stiffness, freedoms, n) -
           negative_count(stiffness, rotations, 2);
}

static int rigid_motions(const enum support supports[2])
{
    if (supports[0] == SUPPORT_FREE)
        return 2;
    return supports[0] == SUPPORT_PINNED && supports[1] == SUPPORT_FREE;
}

static const enum support all_supports[6][2] = {
    {SUPPORT_FREE, SUPPORT_FREE},      {SUPPORT_PINNED, SUPPORT_FREE},
    {SUPPORT_PINNED, SUPPORT_PINNED},  {SUPPORT_CLAMPED, SUPPORT_FREE},
    {SUPPORT_CLAMPED, SUPPORT_PINNED}, {SUPPORT_CLAMPED, SUPPORT_CLAMPED},
};

/* Between each two roots the count is that of the roots found so far; not in the middle, where a
 * cantilever's roots often have those of the clamped beam, the poles of the judge's stiffness.
 * Returns the smallest relative distance of two roots. Pairs closer than 1e-7 are not told apart by
 * the judge, which is not made for that; the count behind them still is. */
static double check_counts(const struct beam_ratios *ratios, const enum support supports[2],
                           int count)
{
    struct beam_root_walk walk;
    double closest = 1.0;

    beam_root_walk_start(&walk, ratios, supports);
    double root = beam_root_walk_next(&walk).b;
    assert_int_equal(wittrick_williams(ratios, supports, 0.999 * root), rigid_motions(supports));
    for (int found = 1; found < count; found++) {
        double next = beam_root_walk_next(&walk).b;
        double gap = next / root - 1.0;
        assert_true(gap >= 0.0);
        closest = fmin(closest, gap);
        if (gap > 1e-7)
            assert_int_equal(wittrick_williams(ratios, supports, root + 0.41 * (next - root)),
                             found + rigid_motions(supports));
        root = next;
    }
    return closest;
}

static void test_every_root_is_found(void **state)
{
    (void)state;
    double closest = 1.0;

    for (int i = 0; i < 6; i++) {
        for (double r = 0.001; r < 1.1; r *= 1.37) {
            /* q^2/r^2 = E/(kappa G): 3 for a metal, other values as a matter of principle */
            static const double quotients[] = {0.0, 0.3, 1.0, 2.2, 3.0, 3.1, 12.0};
            for (int j = 0; j < 7; j++) {
                struct beam_ratios ratios = {r * r, quotients[j] * r * r};
                closest = fmin(closest, check_counts(&ratios, all_supports[i], 300));
            }
        }
    }
    assert_true(closest < 1e-5); /* close pairs were among them */
}

static void test_no_inertia_or_no_shear(void **state)
{
    (void)state;
    static const struct beam_ratios theories[] = {{0.0, 0.0}, {0.01, 0.0}, {0.0, 0.03}};

    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 3; j++)
            check_counts(&theories[j], all_supports[i], 500);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_root_is_found),
        cmocka_unit_test(test_no_inertia_or_no_shear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
