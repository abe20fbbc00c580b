/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Meshes and start of a complete finite-element impact. */
#ifndef PERCUSS_FE_COMPLETE_SETUP_H
#define PERCUSS_FE_COMPLETE_SETUP_H

#include "fe/dynamics.h"
#include "fe/impact_complete.h"
#include "fe/node_contact.h"

struct complete_run {
    const struct complete_problem *problem;
    struct mesh mesh[DYNAMICS_BODIES];
    struct dynamics dynamics;
    struct node_contact contact;
    double patch;                       /* contact radius meshed for, m */
    double mass[DYNAMICS_BODIES];       /* of the true bodies, kg */
    double compliance[DYNAMICS_BODIES]; /* static, of the patch, m/N */
    double duration;                    /* of the contact, expected, s */
    uint32_t
        *reference[DYNAMICS_BODIES]; /* nodes whose mean motion the indentation is taken from */
    size_t references[DYNAMICS_BODIES];
    double *v_before; /* as dynamics.v */
};

/* OK, or BAD_REQUEST with the field, its value and what is allowed. */
enum percuss_status complete_check(const struct complete_problem *problem, struct fault *fault);

/* Contact radius to be expected at most, m: from the energy, elastic or fully plastic. */
double complete_patch(const struct complete_problem *problem);

/* Meshes both bodies around a patch and launches A. complete_end frees the meshes in any case; all
 * other memory is the arena's. */
enum percuss_status complete_begin(const struct complete_problem *problem, double patch,
                                   struct arena *arena, struct complete_run *run,
                                   struct fault *fault);
void complete_end(struct complete_run *run);

/* Approach of the two references, m. */
double complete_indentation(const struct complete_run *run);

#endif
