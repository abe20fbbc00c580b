/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_MODEL_NAMED_SITE_H
#define PERCUSS_MODEL_NAMED_SITE_H

#include <stdbool.h>

#include "percuss/vocabulary.h"

/* Most places of a body that have names. */
enum { BODY_MOST_SITES = PERCUSS_MAX_SITES };

/* A place on a mesh's surface that has a name. */
struct body_site {
    char name[PERCUSS_ID_SIZE];
    double point[3];     /* in the mesh's frame and unit; on the surface once placed */
    double normal[3];    /* outward, unit */
    double curvature[9]; /* symmetric tensor, 1/m at the mesh's own size */
    bool has_normal;     /* declared: else the surface's own is set by body_complete */
    bool has_curvature;
    bool placed;      /* what follows is set: by the first body_complete */
    unsigned face;    /* of the mesh */
    double moved;     /* how far off the surface it was declared, if farther than is usual for a
                       * point, m at the mesh's own size; else 0 */
    char remark[128]; /* how far what is declared differs from the surface's own, or empty */
};

#endif
