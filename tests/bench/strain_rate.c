/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Yield stresses by the rate of strain: e of complete finite elements where each point has its own
 * rate, between those of the one rate of contact/strain_rate.h over and times 2 for all points,
 * on the same meshes; the rate that has the same e, and e without a rate. Fails where it is not
 * between them.
 * usage: strain_rate [--quick] */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "contact/strain_rate.h"
#include "fe/impact_complete.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static const double SPAN = 2.0; /* as solve/rate.c has it */

static const struct material steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};

/* what a steel sphere hits */
#define ROD      COMPLETE_CYLINDER, 0.01, 1.0
#define CYLINDER COMPLETE_CYLINDER, 0.02, 0.02
#define MILD                                                                                       \
    {"mild steel", 210e9, 0.30, 7800.0, 250e6, 0.0},                                               \
    {                                                                                              \
        40.4, 5.0, 0.0                                                                             \
    }
#define STEEL                                                                                      \
    {"steel 4340", 200e9, 0.30, 7800.0, 792e6, 0.0},                                               \
    {                                                                                              \
        1.0, 0.0, 0.014                                                                            \
    }
#define IRON                                                                                       \
    {"steel 1006", 200e9, 0.30, 7800.0, 350e6, 0.0},                                               \
    {                                                                                              \
        1.0, 0.0, 0.022                                                                            \
    }
#define ARMCO                                                                                      \
    {"Armco iron", 200e9, 0.30, 7800.0, 175e6, 0.0},                                               \
    {                                                                                              \
        1.0, 0.0, 0.060                                                                            \
    }
#define ALLOY(y)                                                                                   \
    {"aluminium", 70e9, 0.33, 2700.0, y, 0.0},                                                     \
    {                                                                                              \
        6500.0, 4.0, 0.0                                                                           \
    }
static const struct {
    const char *name;
    double sphere, speed; /* m, m/s */
    struct complete_body target;
    bool quick;
} cases[] = {
    {"cylinder", 0.005, 0.1, {CYLINDER, MILD}, false},
    {"cylinder", 0.005, 0.5, {CYLINDER, MILD}, true},
    {"cylinder", 0.005, 2.0, {CYLINDER, MILD}, false},
    {"rod", 0.015, 0.3, {ROD, MILD}, true},
    {"cylinder", 0.005, 3.0, {CYLINDER, ALLOY(300e6)}, false},
    {"rod", 0.015, 0.3, {ROD, ALLOY(205e6)}, false},
    {"cylinder", 0.005, 2.0, {CYLINDER, STEEL}, false},
    {"sphere", 0.010, 1.0, {COMPLETE_SPHERE, 0.010, 0.0, IRON}, false},
    {"sphere", 0.005, 1.0, {COMPLETE_SPHERE, 0.005, 0.0, ARMCO}, false},
};

/* Mean of some places of the nodes; the worst closure of the energy. NAN: no solution. */
static double restitution(const struct complete_problem *problem, unsigned phases, double *missing)
{
    double sum = 0.0;
    for (unsigned i = 0; i < phases; i++) {
        struct complete_problem one = *problem;
        struct complete_result result;
        struct fault fault = {""};
        one.phase = (double)i / phases;
        if (impact_complete_solve(&one, &result, &fault) != PERCUSS_OK) {
            fprintf(stderr, "strain_rate: %s\n", fault.text);
            return NAN;
        }
        sum += result.restitution / phases;
        *missing = fmax(*missing, fabs(result.energy.closure) / result.energy.available);
    }
    return sum;
}

static double mass_of(const struct complete_body *body)
{
    double area = M_PI * body->radius * body->radius;
    return body->material.density * area *
           (body->shape == COMPLETE_SPHERE ? 4.0 / 3.0 * body->radius : body->length);
}

/* By the rigid masses. */
static struct strain_rate one_rate(const struct complete_problem *problem)
{
    static const struct yield_rate none;
    const struct complete_body *a = &problem->a, *b = &problem->b;
    double curvature = 0.5 / a->radius + (b->shape == COMPLETE_SPHERE ? 0.5 / b->radius : 0.0);
    struct hertz_contact hertz = hertz_contact_make(
        hertz_effective_modulus(&a->material, &b->material), curvature, curvature);
    double energy = 0.5 * problem->speed * problem->speed / (1.0 / mass_of(a) + 1.0 / mass_of(b));
    struct strain_rate found[2];
    strain_rate_of(&hertz, (const struct material *const[]){&a->material, &b->material},
                   (const struct yield_rate *const[]){&none, &b->rate},
                   &(struct strain_rate_blow){.speed = problem->speed, .work = energy}, found);
    return found[1];
}

/* e where all points have the yield stress of a rate; 0: of a slow test. */
static double at_rate(const struct complete_problem *problem, double rate, unsigned phases,
                      double *missing)
{
    struct complete_problem one = *problem;
    one.b.material.yield *= yield_rate_factor(&problem->b.rate, rate);
    one.b.rate = (struct yield_rate){0};
    return restitution(&one, phases, missing);
}

static bool run(size_t i, unsigned cells, unsigned phases)
{
    struct complete_problem problem = {
        .a = {.shape = COMPLETE_SPHERE, .radius = cases[i].sphere, .material = steel},
        .b = cases[i].target,
        .speed = cases[i].speed,
        .cells = cells,
        .horizon = 2e-3};
    struct strain_rate found = one_rate(&problem);
    double missing = 0.0;
    double own = restitution(&problem, phases, &missing);
    double still = at_rate(&problem, 0.0, phases, &missing);
    double slow = at_rate(&problem, found.rate / SPAN, phases, &missing);
    double middle = at_rate(&problem, found.rate, phases, &missing);
    double fast = at_rate(&problem, found.rate * SPAN, phases, &missing);
    double alike = found.rate * pow(SPAN, 2.0 * (own - slow) / (fast - slow) - 1.0);
    printf("%-9s %-10s %5g %8.1f %7.4f %8.4f %8.4f %8.4f %8.4f %8.1f %6.2f %9.1e\n", cases[i].name,
           problem.b.material.name, problem.speed, found.rate, found.factor, still, middle, own,
           own - middle, alike, alike / found.rate, missing);
    fflush(stdout);
    return slow < own && own < fast && still < slow && missing < 1e-3;
}

int main(int argc, char **argv)
{
    bool quick = argc == 2 && strcmp(argv[1], "--quick") == 0;
    if (argc > 1 && !quick) {
        fprintf(stderr, "usage: strain_rate [--quick]\n");
        return 2;
    }
    bool ok = true;
    printf("%-9s %-10s %5s %8s %7s %8s %8s %8s %8s %8s %6s %9s\n", "target", "of", "m/s", "rate",
           "factor", "e still", "e one", "e own", "less", "alike", "over", "closure");
    for (size_t i = 0; i < COUNT(cases); i++)
        if (!quick || cases[i].quick)
            ok = run(i, quick ? 4 : 12, 3) && ok;
    return ok ? 0 : 1;
}
