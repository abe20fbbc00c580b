/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/energy.h"

#include <float.h>
#include <math.h>

#include "base/extremes.h"
#include "numeric/linear.h"

/* Eigenvalues of W below this share of the largest are rounding of 0. */
static const double NO_MOTION = 1e-12;

/* x^T m y */
static double form(size_t n, const double *m, const double *x, const double *y)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            sum += x[i] * m[i * n + j] * y[j];
    return sum;
}

/* 1/w for one contact, else the pseudo-inverse: motions that change no gap carry no energy. */
static double *effective_mass(const struct scene *scene, struct arena *arena)
{
    size_t n = scene->rows;
    double *mass = arena_take(arena, n * n, sizeof *mass);
    if (!mass)
        return NULL;
    if (n == 1) {
        mass[0] = 1.0 / scene->w[0];
        return mass;
    }
    double *scratch = arena_take(arena, n * (n + 1), sizeof *scratch);
    if (!scratch || isnan(linear_pseudo_inverse(n, scene->w, NO_MOTION, mass, scratch)))
        return NULL;
    return mass;
}

/* Motions outside the range of W below this share of the largest are rounding. */
static const double NOT_DRIVEN = 1e-6;

/* Part of rates or accelerations that no force changes: x - W W^+ x. */
static void find_driven(const struct scene *scene, const double *mass, const double *x,
                        double *driven)
{
    size_t n = scene->rows;
    double momentum[SCENE_MOST_ROWS] = {0.0};
    double largest = 0.0;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++)
            momentum[i] += mass[i * n + j] * x[j];
        largest = larger(fabs(x[i]), largest);
    }
    for (size_t i = 0; i < n; i++) {
        driven[i] = x[i];
        for (size_t j = 0; j < n; j++)
            driven[i] -= scene->w[i * n + j] * momentum[j];
        if (fabs(driven[i]) <= NOT_DRIVEN * largest)
            driven[i] = 0.0;
    }
}

/* Work of the rates u and accelerations b outside the range of a singular W, as if infinite masses
 * drove the contacts: -int (u + b t) F dt. */
static double driven_work(const struct scene *scene, const double *mass,
                          const struct impact_outcome *outcome)
{
    double rate[SCENE_MOST_ROWS];
    double acceleration[SCENE_MOST_ROWS];
    double sum = 0.0;
    if (scene->rows == 1)
        return 0.0;
    find_driven(scene, mass, scene->gap_rate, rate);
    find_driven(scene, mass, scene->gap_acceleration, acceleration);
    for (size_t c = 0; c < scene->contacts; c++)
        sum -= rate[c] * outcome->tracks[c].impulse + acceleration[c] * outcome->tracks[c].moment;
    for (size_t i = 0; i < scene->frictions; i++)
        for (size_t t = 0; t < 2; t++)
            sum -= rate[scene_tangent(scene, i) + t] *
                   outcome->tracks[scene->friction[i].contact].tangential[t];
    return sum;
}

static double initial_vibration(const struct scene *scene)
{
    double sum = 0.0;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        for (size_t k = 0; group->q && k < group->count; k++) {
            double spring = group->set->omega[k] * group->q[k];
            sum += 0.5 * (group->v[k] * group->v[k] + spring * spring);
        }
    }
    return sum;
}

static double stored_energy(const struct scene *scene, const struct contact_law *laws,
                            const struct energy_end *last)
{
    double force[SCENE_MOST_ROWS];
    double sum = 0.0;
    for (size_t c = 0; c < scene->contacts; c++) {
        const struct contact_law *law = &laws[c];
        double stiffness;
        force[c] = contact_law_force(law, last->indentation[c], &stiffness);
        if (law->operations->lossy && last->force)
            force[c] = last->force[c];
        sum += law->operations->stored(law, last->indentation[c]);
    }
    for (size_t i = 0; i < 2 * scene->frictions; i++)
        force[scene->contacts + i] = last->tangential[i];
    return sum + 0.5 * form(scene->rows, scene->residual, force, force);
}

/* Work of the acceleration over the rounding of both gaps of a contact, half a bit each. */
static double rounding_of_work(const struct scene *scene, const double *mass,
                               const struct motion *end)
{
    size_t n = scene->rows;
    double sum = 0.0;
    for (size_t a = 0; a < n; a++) {
        double force = 0.0;
        for (size_t b = 0; b < n; b++)
            force += mass[a * n + b] * scene->gap_acceleration[b];
        sum += fabs(force) * DBL_EPSILON * larger(fabs(scene->gap[a]), fabs(end->gap[a]));
    }
    return sum;
}

/* Relative, of the available energy's terms. */
static const double ROUNDING_OF_SUM = 32.0 * DBL_EPSILON;

bool energy_audit(const struct scene *scene, const struct energy_end *last, struct arena *arena,
                  struct impact_outcome *outcome)
{
    size_t n = scene->rows;
    const struct motion *end = &outcome->motion;
    double *mass = effective_mass(scene, arena);
    double *travel = arena_take(arena, n, sizeof *travel);
    if (!mass || !travel)
        return false;
    /* travel of the bodies: the gap's change less the dent's */
    for (size_t r = 0; r < n; r++)
        travel[r] = end->gap[r] - scene->gap[r];
    for (size_t c = 0; c < scene->contacts; c++)
        travel[c] = end->gap[c] - scene->gap[c] -
                    (outcome->laws[c].history.dent - scene->laws[c].history.dent);

    struct impact_energy *energy = &outcome->energy;
    *energy = (struct impact_energy){.damping = last->damping + outcome->relaxed,
                                     .plastic = outcome->plastic,
                                     .friction = outcome->slid};
    /* the acceleration is a force W^+ a, which works over the gaps' travel */
    energy->available = 0.5 * form(n, mass, scene->gap_rate, scene->gap_rate) +
                        initial_vibration(scene) + form(n, mass, scene->gap_acceleration, travel) +
                        driven_work(scene, mass, outcome);
    /* energies of bodies and laws at the end */
    energy->rigid_after = 0.5 * form(n, mass, end->gap_rate, end->gap_rate);
    for (size_t b = 0; b < scene->bodies; b++) {
        outcome->vibration[b] = motion_vibration(end, scene, b);
        energy->vibration += outcome->vibration[b];
    }
    energy->stored = stored_energy(scene, outcome->laws, last) + outcome->sheared;
    energy->closure = energy->available - energy->rigid_after - energy->vibration -
                      energy->damping - energy->plastic - energy->friction - energy->stored;
    /* a gap far larger than its travel rounds it: no error */
    double rounding = rounding_of_work(scene, mass, end);
    if (fabs(energy->closure) <= rounding)
        energy->closure = 0.0;
    /* the acceleration may take all energy except for rounding */
    double initial = 0.5 * form(n, mass, scene->gap_rate, scene->gap_rate);
    rounding += ROUNDING_OF_SUM * (initial + initial_vibration(scene));
    if (energy->available < 0.0 && -energy->available <= rounding) {
        energy->available = 0.0;
        if (fabs(energy->closure) <= 2.0 * rounding)
            energy->closure = 0.0;
    }
    return true;
}
