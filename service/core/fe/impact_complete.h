/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One central impact by complete finite elements: both bodies meshed, axisymmetric, elastic or
 * elastic-plastic, frictionless contact, explicit dynamics. The bodies start at rest, free of
 * stress and touching in one point; A flies towards B. */
#ifndef PERCUSS_FE_IMPACT_COMPLETE_H
#define PERCUSS_FE_IMPACT_COMPLETE_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/watch.h"
#include "fe/complete_body.h"
#include "fe/dynamics.h"

/* The problem, meshes and start of a complete finite-element impact. */

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
    struct pace *pace;  /* may stop it; NULL: none */
    double done, share; /* of the whole work, which it is told: before this solution, and its own */
    void (*sample)(void *context, const struct complete_sample *sample); /* NULL: none */
    void *context;                                                       /* handed to it */
};

enum { COMPLETE_SUB_IMPACTS = 64 };

/* An interval of contact; openings shorter than sound needs across the patch do not divide it. */
struct complete_sub_impact {
    double start, end, impulse, peak_force; /* s, s, N s, N */
    double max_indentation;                 /* m, as below */
    double compression_end;                 /* s, of the largest indentation */
    double compression_impulse;             /* N s, until then */
};

struct complete_energy {
    double available;       /* of the relative motion before, J */
    double rebound;         /* of the relative motion after */
    double vibration;       /* kinetic beyond the mean motions, and strain */
    double vibration_of[2]; /* the same of a and b */
    double plastic;         /* work of plastic flow */
    double contact;         /* work of the impulses on nodes as they close */
    double closure;         /* missing: available less all of the above */
};

struct complete_result {
    double impulse;         /* N s, over all sub-impacts */
    double restitution;     /* impulse / compression impulse - 1 */
    double contact_time;    /* s, sum of the sub-impacts */
    double peak_force;      /* N */
    double max_indentation; /* m, approach of the references: a sphere's or compact cylinder's
                             * centre of mass, a rod's section one radius below the face */
    double contact_radius;  /* m, largest */
    double momentum_error;  /* (change of momentum + impulse) / impulse, the worse of both bodies */
    double mass[2];         /* kg */
    struct complete_energy energy;
    struct complete_sub_impact sub_impact[COMPLETE_SUB_IMPACTS];
    size_t sub_impacts;          /* those beyond the list extend its last entry */
    enum percuss_end_reason end; /* SEPARATED: vibration can no longer cause a contact; HORIZON:
                                  * open at the horizon; IN_CONTACT: closed at the horizon */
    double end_time;             /* s */
    size_t elements, plastic_elements, steps;
    unsigned levels;
    double step; /* s, smallest */
};

/* Solves on one mesh. OK; BAD_REQUEST naming the field and its allowed range; TIMEOUT when `pace`
 * stopped it; INTERNAL without memory or where the energy does not balance to 1e-2. Same input,
 * same bits. */
enum percuss_status impact_complete_solve(const struct complete_problem *problem,
                                          struct complete_result *result, struct fault *fault);

#endif
