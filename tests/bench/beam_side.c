/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The fit of model/beam_statics.c anew: static solutions on meshes of bars (side_local.h), least
 * squares, and what they leave. Some ten minutes of one core. usage: beam_side [--quick] [--csv]
 * fewer bars and places; every solution */
#include <stdio.h>

#include "numeric/linear.h"
#include "physics/mesh/side_local.h"

enum { TERMS = 22, MOST = 1000 };

/* Powers of breadth/depth and of Poisson's ratio, of the three parts of the fit. */
static const struct {
    int part, breadth, poisson;
} terms[TERMS] = {{0, -1, 0}, {0, -1, 1}, {0, -1, 2}, {0, 0, 0}, {0, 0, 1},  {0, 0, 2},
                  {0, 1, 0},  {0, 1, 1},  {0, 2, 0},  {0, 2, 1}, {1, -1, 0}, {1, -1, 1},
                  {1, 0, 0},  {1, 0, 1},  {1, 1, 0},  {1, 1, 1}, {2, -1, 0}, {2, -1, 1},
                  {2, -1, 2}, {2, 0, 0},  {2, 0, 1},  {2, 0, 2}};
static const char *const parts[] = {"A", "B", "C"};

struct row {
    double ratio, poisson, aside, local;
};

struct rows {
    size_t count;
    struct row row[MOST];
};

static double term(size_t i, const struct row *row)
{
    double square = row->aside * row->aside;
    double part[] = {1.0, square, 2.0 * square / (1.0 - square)};
    return part[terms[i].part] * pow(row->ratio, terms[i].breadth) *
           pow(row->poisson, terms[i].poisson);
}

/* Errors count by the smaller side, less near the edges and more on the axis. */
static double weight(const struct row *row)
{
    return fmin(1.0, row->ratio) * (row->aside > 0.75 ? 1.0 / 3.0 : 1.0) *
           (row->aside == 0.0 ? 3.0 : 1.0);
}

static bool fit(const struct rows *rows, double factors[TERMS])
{
    double matrix[TERMS * TERMS] = {0};
    memset(factors, 0, TERMS * sizeof *factors);
    for (size_t k = 0; k < rows->count; k++) {
        const struct row *row = &rows->row[k];
        double square = weight(row) * weight(row);
        for (size_t i = 0; i < TERMS; i++) {
            factors[i] += square * term(i, row) * row->local;
            for (size_t j = 0; j < TERMS; j++)
                matrix[i * TERMS + j] += square * term(i, row) * term(j, row);
        }
    }
    return linear_solve(TERMS, matrix, factors);
}

/* By the distance from the axis. */
static void tell(const struct rows *rows, const double factors[TERMS])
{
    static const double from[] = {0.0, 0.01, 0.31, 0.51, 0.71, 0.81, 0.86};
    for (size_t i = 0; i < TERMS; i++)
        printf("%s s^%d nu^%d %.3f\n", parts[terms[i].part], terms[i].breadth, terms[i].poisson,
               factors[i]);
    for (size_t band = 0; band + 1 < COUNT(from); band++) {
        double largest = 0.0;
        for (size_t k = 0; k < rows->count; k++) {
            const struct row *row = &rows->row[k];
            double off = -row->local;
            for (size_t i = 0; i < TERMS; i++)
                off += factors[i] * term(i, row);
            if (row->aside >= from[band] && row->aside < from[band + 1])
                largest = fmax(largest, fabs(off));
        }
        printf("aside %.2f to %.2f: off by %.3f at most\n", from[band], from[band + 1], largest);
    }
}

static void solve_bar(double ratio, double poisson, bool quick, bool csv, struct rows *rows)
{
    static const double aside[] = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.85};
    struct side_solution side = {.bar = side_bar(ratio, poisson, fmax(10.0, 8.0 * ratio))};
    /* where Hutchinson's shear factor has its pole Cowper's stands in */
    double cowper = beam_shear_cowper_rectangle(poisson);
    if (ratio > 0.0 && side.bar.shear_factor[1] == cowper && poisson > 0.0)
        return;
    for (size_t i = 0; i < COUNT(aside); i += quick ? 3 : 1)
        side.aside[side.count++] = aside[i];
    side.count = ratio == 0.0 ? 1 : side.count;
    side_solve(&side, ratio == 0.0 ? (const size_t[3]){41, 2, 2}
                                   : (const size_t[3]){ratio < 1.6 ? 36 : 44,
                                                       (size_t)ceil(7.0 * sqrt(ratio)),
                                                       ratio < 1.6 ? 4 : 3});
    for (size_t i = 0; i < side.count; i++) {
        if (csv || ratio == 0.0)
            printf("%g,%g,%g,%.4f\n", ratio, poisson, side.aside[i], side.local[i]);
        if (ratio > 0.0)
            rows->row[rows->count++] = (struct row){ratio, poisson, side.aside[i], side.local[i]};
    }
}

int main(int count, char **words)
{
    static const double ratios[] = {0.0, 0.4, 0.5, 0.7, 0.85, 1.0, 1.2, 1.5, 1.8, 2.0, 2.25, 2.5};
    static const double poissons[] = {0.0, 0.1, 0.2, 0.3, 0.4, 0.48};
    static struct rows rows;
    double factors[TERMS];
    bool quick = false, csv = false;
    for (int i = 1; i < count; i++) {
        quick = quick || strcmp(words[i], "--quick") == 0;
        csv = csv || strcmp(words[i], "--csv") == 0;
    }
    printf("breadth/depth (0: round),poisson,aside,local E depth\n");
    for (size_t i = 0; i < COUNT(ratios); i += quick ? 2 : 1)
        for (size_t k = 0; k < COUNT(poissons); k += quick ? 2 : 1)
            solve_bar(ratios[i], poissons[k], quick, csv, &rows);
    if (!fit(&rows, factors))
        return 1;
    tell(&rows, factors);
    return 0;
}
