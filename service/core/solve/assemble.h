/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* From a problem to the fast scale's scene: which modes take part, and the residual flexibility of
 * those that do not. */
#ifndef PERCUSS_SOLVE_ASSEMBLE_H
#define PERCUSS_SOLVE_ASSEMBLE_H

#include "solve/assembly.h"
#include "solve/mode_choice.h"

/* Modes of a given initial state always take part. Arrays come from the problem's arena. False: out
 * of memory. */
bool assemble(struct assembly *assembly, const struct problem *problem,
              const struct mode_choice *choice);

/* Whether two assemblies of a request have the same modes, and so the same scene. */
bool assembly_same_modes(const struct assembly *a, const struct assembly *b);

/* The same scene with one oscillator for the omitted modes of each body at each contact in the
 * place of their own residual flexibility: the next better model, for an error estimate. Valid as
 * long as the assembly. False: out of memory. */
bool assemble_remainder(const struct assembly *assembly, const struct problem *problem,
                        struct scene *scene);

#endif
