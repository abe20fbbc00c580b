/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/impact_scale.h"

#include <math.h>

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
