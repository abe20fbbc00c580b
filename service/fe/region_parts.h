/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What region_make.c and region_solve.c (equilibria) share. */
#ifndef PERCUSS_FE_REGION_PARTS_H
#define PERCUSS_FE_REGION_PARTS_H

#include <stdbool.h>

#include "fe/mesh.h"
#include "fe/region.h"
#include "fe/solid.h"

/* Of the contact radius at the largest load, the least that elements are made for. */
static const double REGION_FINEST = 1e-3;

/* What a step starts from. */
struct contact_state {
    double indentation, force;
    double *forces; /* by contact node */
    bool *active;
};

struct region {
    struct mesh mesh;
    struct quad *quads;
    struct solid *solids[2];
    size_t candidates; /* contact nodes that may ever touch */
    size_t count;      /* of them, those looked at now */
    double *gaps;      /* of the virgin surfaces, m */
    struct contact_state committed, start, present;
    double stiffness;
    double peak;        /* N */
    double top;         /* m, contact radius at the largest load */
    double first_yield; /* m, contact radius at which a body first flows */
    double *offsets, *compliance, *more, *initial, *scratch;
    struct region_effort effort;
    struct pace *pace; /* NULL: nobody */
    double done;       /* what it is told */
};

#endif
