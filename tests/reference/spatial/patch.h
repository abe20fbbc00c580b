/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The contact region of two elastic half-spaces with surfaces that part like A x^2 + B y^2, in
 * three dimensions: static, frictionless, small strains. Indentation is the approach of their
 * points at infinity, as in Hertz's F = k d^(3/2). The compliance between the nodes that may touch
 * is found once; a force then is a dense problem of complementarity. Nothing yields: the paper's
 * beam is elastic. */
#ifndef PERCUSS_SPATIAL_PATCH_H
#define PERCUSS_SPATIAL_PATCH_H

#include "contact/hertz.h"
#include "fe/active_set.h"

struct patch_input {
    struct material materials[2];
    double curvature[2]; /* A <= B, 1/m */
    double force;        /* N, the largest that will be asked for */
    size_t resolution;   /* bricks on the contact's shorter semi-axis then: 2 ... 16 */
};

/* Owns its arrays. */
struct patch {
    struct hertz_contact hertz;
    double axes[2];          /* m, of the ellipse within which nodes may touch */
    size_t count;            /* nodes that may touch, of a quarter */
    double (*points)[2];     /* m */
    double *compliance;      /* m/N, of forces on a quarter's nodes with their images */
    double *coupled, series; /* m/N: the same with the compliance in series */
    double *initial;         /* m, gaps at an indentation of 0 */
    size_t freedoms;         /* of both meshes */
    struct active_set set;   /* of the last answer */
    double *gaps;            /* m, which the set points to */
};

/* OK; BAD_REQUEST naming the field and its allowed range; INTERNAL. */
enum percuss_status patch_create(const struct patch_input *input, struct patch *patch,
                                 struct fault *fault);
void patch_free(struct patch *patch);

/* Force (N) where the bodies would overlap by `approach` (m) and give way by `series` (m/N) times
 * the force besides: 0 for the region alone. NAN: no set of pressing nodes was found. */
double patch_press(struct patch *patch, double approach, double series);

/* Force against indentation, tabulated as contact/law_table.h keeps it: for contacts of a quarter to
 * the whole of the size at `force`; below, as above, goes Hertz's power of the indentation. Point 0
 * is the touch. */
enum { PATCH_SAMPLES = 24 };
struct patch_table {
    double indentation[PATCH_SAMPLES + 1], force[PATCH_SAMPLES + 1], radius[PATCH_SAMPLES + 1];
    double error; /* largest relative distance of a force to Hertz's elliptic law */
};

/* False: a force was not found. */
bool patch_tabulate(struct patch *patch, double force, struct patch_table *table);

#endif
