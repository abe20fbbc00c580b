/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/impact_scale.h"

#include <math.h>

#include "base/extremes.h"

/* A power law needs one round, one with joints some more; a thousandth is enough for a scale. The
 * first indentation is arbitrary. */
enum { MAX_ROUNDS = 20 };
static const double SCALE_ACCURACY = 1e-3;
static const double FIRST_INDENTATION = 1e-6; /* m */

/* Work of a force k d^(3/2) over its product with d. */
static const double HERTZ_WORK = 0.4;

/* Least speed of a contact's scales, so that its square is no 0; m/s. */
static const double LEAST_SPEED = 1e-150;

/* The felt mass and the duration depend on each other: so many rounds suffice. */
enum { MASS_ROUNDS = 3 };

/* Inverse mass that a contact feels within `duration`: rigid, and every mode that is slower than
 * it. On a long rod that is the wave impedance times the duration, far less than the rod's mass. */
static double felt_inverse_mass(const struct scene *scene, size_t contact, double duration)
{
    double sum = scene->w[contact * (scene->rows + 1)];
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const double *phi = group->participation[contact];
        for (size_t k = 0; phi && k < group->count && group->set->omega[k] * duration < 1.0; k++)
            sum += phi[k] * phi[k];
    }
    return sum;
}

/* Energy stored by a law; where it yields, or remembers and stores less than its force does, that
 * of a force like d^(3/2) instead of the integral. */
static double stored_about(const struct contact_law *law, double d, double force)
{
    const struct contact_law_operations *of = law->operations;
    return of->curve || of->remembers ? HERTZ_WORK * force * d : of->stored(law, d);
}

/* Indentation at which a law stores an energy: Newton's method for log(stored) against
 * log(indentation), which one step solves for a power law, as elastic ones are, from any start. */
static double indentation_of_energy(const struct contact_law *law, double energy)
{
    double d = FIRST_INDENTATION;
    for (int i = 0; i < MAX_ROUNDS; i++) {
        double stiffness;
        double force = contact_law_force(law, d, &stiffness);
        double stored = stored_about(law, d, force);
        double power = force * d / stored;
        double change = log(stored / energy) / power;
        d *= exp(-change);
        if (fabs(change) < SCALE_ACCURACY || !law->operations->curve)
            break;
    }
    return d;
}

struct impact_scale impact_scale_of(const struct scene *scene, size_t contact, double rate)
{
    const struct contact_law *law = &scene->laws[contact];
    double speed = larger(fabs(rate), LEAST_SPEED);
    struct impact_scale scale = {.duration = INFINITY};
    double felt = NAN;
    for (int round = 0; round < MASS_ROUNDS; round++) {
        /* the same mass has the same scales */
        double before = felt;
        felt = felt_inverse_mass(scene, contact, scale.duration);
        if (felt == before)
            break;
        double energy = 0.5 * speed * speed / felt;
        scale.indentation = indentation_of_energy(law, energy);
        scale.duration = scale.indentation / speed;
    }
    double stiffness;
    scale.force = contact_law_force(law, scale.indentation, &stiffness);
    return scale;
}

/* Whether rows a and b are coupled. */
static bool feels(const struct scene *scene, size_t a, size_t b)
{
    size_t at = a * scene->rows + b;
    if (scene->w[at] != 0.0 || scene->residual[at] != 0.0)
        return true;
    for (size_t g = 0; g < scene->groups; g++)
        if (scene->group[g].participation[a] && scene->group[g].participation[b])
            return true;
    return false;
}

/* In modes: those of the scene, and the contacts' equations solved at once with zeros skipped: in a
 * row of spheres each feels two others, on a beam all. One by one they cost far less. */
double step_cost(const struct scene *scene)
{
    size_t rows = scene->rows;
    double n = (double)rows;
    double cost = 2.0 * n * n + 6.0 * n;
    for (size_t a = 0; a < rows; a++) {
        double felt = 0.0;
        for (size_t b = 0; b < rows; b++)
            felt += feels(scene, a, b);
        cost += 8.0 * felt * felt;
    }
    for (size_t g = 0; g < scene->groups; g++)
        cost += (double)scene->group[g].count;
    return cost;
}
