/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The problem, meshes and start of a complete finite-element impact. */
#ifndef PERCUSS_FE_COMPLETE_SETUP_H
#define PERCUSS_FE_COMPLETE_SETUP_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/watch.h"
#include "fe/complete_body.h"
#include "fe/dynamics.h"
#include "fe/node_contact.h"

struct complete_sample {
    double time, force; /* s; N, mean since the sample before */
    double indentation; /* m */
    double radius;      /* outermost closed pair, m */
};

struct complete_problem {
    struct complete_body a, b; /* one of them a sphere */
    double speed;              /* of A towards B, m/s, > 0 */
    unsigned cells;            /* elements across the expected contact radius, 4 ... 96 */
    double phase;   /* 0 <= phase < 1: moves the nodes by this part of an element, less one from a
                     * half on, against the patch's rim: see swing.h */
    double horizon; /* s, > 0: end of the search for further contacts */
    struct pace *pace;  /* may stop it; NULL: nobody */
    double done, share; /* of the whole work, which it is told: before this solution, and its own */
    void (*sample)(void *context, const struct complete_sample *sample); /* NULL: nobody */
    void *context;                                                       /* handed to it */
};

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
