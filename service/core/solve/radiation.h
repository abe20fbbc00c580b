/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Waves that leave through half-spaces (model/half_space.h), as oscillators of a scene.
 *
 * C F - lag F' alone is no model: it answers before it is asked. With damping 1/sqrt(2) an
 * oscillator of compliance c = lag omega/sqrt(2) follows a force by c F - lag F' + (c/omega^2) F'',
 * and takes lag w^2/(1 + (w/omega)^4) of a force of the frequency w: the loss and its phase up to
 * second order. Its compliance is that of the half-space far from the contact, which Hertz's law
 * has already: -c goes in series with the law. */
#ifndef PERCUSS_SOLVE_RADIATION_H
#define PERCUSS_SOLVE_RADIATION_H

#include "solve/assembly.h"

/* Adds the oscillators of all half-spaces to an assembly with its modes, and -c to its residual
 * flexibility; contacts on one half-space closer than its waves are long share them. Where the
 * loss matters less than a twentieth of the tolerance it is counted as omitted viscosity instead,
 * and all of it where problem->compliance.still. Sets assembly->radiated_error. False: out of
 * memory. */
bool radiation_add(const struct problem *problem, struct assembly *assembly, double *residual);

/* Whether such oscillators are among the scene's groups. */
bool radiation_is_in(const struct problem *problem, const struct scene *scene);

/* Whether contacts share one of them, and so must be solved together. */
bool radiation_is_shared(const struct problem *problem, const struct scene *scene);

/* Whether a contact is on a half-space: the scene then depends on the speeds. */
bool radiation_is_possible(const struct problem *problem);

#endif
