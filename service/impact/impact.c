/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/impact.h"

#include <math.h>
#include <string.h>

/* Most touches that are gone back to, one after the other. */
enum { MOST_TOUCHES = 64 };

bool impact_create(struct impact_outcome *outcome, const struct scene *scene, struct arena *arena)
{
    memset(outcome, 0, sizeof *outcome);
    outcome->tracks = arena_take(arena, scene->contacts, sizeof *outcome->tracks);
    outcome->vibration = arena_take(arena, scene->bodies, sizeof *outcome->vibration);
    outcome->laws = arena_take(arena, scene->contacts, sizeof *outcome->laws);
    if (!outcome->tracks || !outcome->vibration || !outcome->laws ||
        !motion_create(&outcome->motion, scene, arena))
        return false;
    for (size_t c = 0; c < scene->contacts; c++)
        if (!track_create(&outcome->tracks[c], arena))
            return false;
    return true;
}

void impact_begin(struct impact_outcome *outcome, const struct scene *scene)
{
    memcpy(outcome->laws, scene->laws, scene->contacts * sizeof *outcome->laws);
    outcome->plastic = 0.0;
    outcome->too_stiff = false;
    for (size_t c = 0; c < scene->contacts; c++)
        track_clear(&outcome->tracks[c]);
}

/* The earliest of the last touches of the contacts that overlap by more than `allowed`; 0: none
 * does. `at` is left out and becomes its contact. */
static enum impact_start find_touch(const struct scene *scene, struct rewind *rewind,
                                    const struct motion *motion, double allowed, size_t *at,
                                    double *earliest)
{
    size_t left_out = *at;
    *earliest = 0.0;
    for (size_t c = 0; c < scene->contacts; c++) {
        double d;
        double rate;
        motion_approach(motion, scene, c, &d, &rate);
        if (d <= allowed || c == left_out)
            continue;
        double back = rewind_find(rewind, scene, motion, c);
        if (!isfinite(back))
            return isnan(back) ? START_LIMIT : START_NONE;
        if (back < *earliest) {
            *earliest = back;
            *at = c;
        }
    }
    return START_FOUND;
}

static double deepest_overlap(const struct scene *scene, const struct motion *motion)
{
    double deepest = 0.0;
    for (size_t c = 0; c < scene->contacts; c++) {
        double d;
        double rate;
        motion_approach(motion, scene, c, &d, &rate);
        deepest = fmax(deepest, d);
    }
    return deepest;
}

enum impact_start impact_find_start(const struct scene *scene, struct rewind *rewind,
                                    struct motion *motion, double *time_shift)
{
    /* where one contact touched another one may overlap, from a touch further back; what rounding
     * leaves of a touch that both share does not count, nor does its energy, with d^(5/2) */
    double allowed = 1e-6 * deepest_overlap(scene, motion);
    size_t at = scene->contacts;
    *time_shift = 0.0;
    for (int round = 0; round < MOST_TOUCHES; round++) {
        double earliest;
        enum impact_start found =
            find_touch(scene, rewind, motion, round ? allowed : 0.0, &at, &earliest);
        if (found != START_FOUND || earliest == 0.0)
            return found;
        motion_rewind(motion, scene, -earliest);
        *time_shift += earliest;
    }
    return START_NONE;
}

/* What a step costs, in modes: the modes themselves, and the equations of the contacts. */
static bool feels(const struct scene *scene, size_t a, size_t b)
{
    size_t at = a * scene->contacts + b;
    if (scene->w[at] != 0.0 || scene->residual[at] != 0.0)
        return true;
    for (size_t g = 0; g < scene->groups; g++)
        if (scene->group[g].participation[a] && scene->group[g].participation[b])
            return true;
    return false;
}

/* The elimination for the contact forces skips what is zero: in a row of spheres each contact feels
 * two others, on a beam all of them. Measured with rows of up to 24 spheres. */
double impact_step_cost(const struct scene *scene)
{
    double n = (double)scene->contacts;
    double cost = 2.0 * n * n + 6.0 * n;
    for (size_t a = 0; a < scene->contacts; a++) {
        double felt = 0.0;
        for (size_t b = 0; b < scene->contacts; b++)
            felt += feels(scene, a, b);
        cost += 8.0 * felt * felt;
    }
    for (size_t g = 0; g < scene->groups; g++)
        cost += (double)scene->group[g].count;
    return cost;
}

unsigned long impact_max_steps(const struct scene *scene, const struct impact_settings *settings)
{
    return (unsigned long)(fmax(0.0, settings->max_work) / impact_step_cost(scene));
}

double impact_work(const struct scene *scene, const struct impact_outcome *outcome)
{
    return (double)outcome->effort * impact_step_cost(scene);
}

/* Inverse mass that a contact feels within `duration`: rigid, and every mode that is slower than
 * it. On a long rod that is the wave impedance times the duration, far less than the rod's mass. */
static double felt_inverse_mass(const struct scene *scene, size_t contact, double duration)
{
    double sum = scene->w[contact * scene->contacts + contact];
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const double *phi = group->participation[contact];
        for (size_t k = 0; phi && k < group->count && group->set->omega[k] * duration < 1.0; k++)
            sum += phi[k] * phi[k];
    }
    return sum;
}

/* A law's energy is an integral where it yields; as a scale, that of a force like d^(3/2) will do.
 */
static double stored_about(const struct contact_law *law, double d, double force)
{
    return law->operations->curve ? 0.4 * force * d : law->operations->stored(law, d);
}

/* Indentation at which a law stores an energy: Newton's method for log(stored) against
 * log(indentation), which one step solves for a power law, from any start. */
static double indentation_of_energy(const struct contact_law *law, double energy)
{
    double d = 1e-6;
    for (int i = 0; i < 20; i++) {
        double stiffness;
        double force = contact_law_force(law, d, &stiffness);
        double stored = stored_about(law, d, force);
        double power = force * d / stored;
        double change = log(stored / energy) / power;
        d *= exp(-change);
        if (fabs(change) < 1e-3)
            break;
    }
    return d;
}

struct impact_scale impact_scale_of(const struct scene *scene, size_t contact, double rate)
{
    const struct contact_law *law = &scene->laws[contact];
    double speed = fmax(fabs(rate), 1e-150);
    struct impact_scale scale = {.duration = INFINITY};
    /* the felt mass depends on the duration and the other way round: three rounds settle it */
    for (int round = 0; round < 3; round++) {
        double energy = 0.5 * speed * speed / felt_inverse_mass(scene, contact, scale.duration);
        scale.indentation = indentation_of_energy(law, energy);
        scale.duration = scale.indentation / speed;
    }
    double stiffness;
    scale.force = contact_law_force(law, scale.indentation, &stiffness);
    return scale;
}
