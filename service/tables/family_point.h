/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One table of the family of contact/family.h, from passages over the contact region. */
#ifndef PERCUSS_TABLES_FAMILY_POINT_H
#define PERCUSS_TABLES_FAMILY_POINT_H

#include "contact/family.h"
#include "fe/indentation.h"

/* Depths in units of that of first yield: ten to a decade up to FAMILY_DEEPEST; unloadings at every
 * second of them, and all where dents begin; branches up to the depth 1000, beyond which they keep
 * their shape. */
enum {
    FAMILY_DEPTHS = 40,
    FAMILY_SPRINGS = 22,
    FAMILY_BRANCHES = 17,
    FAMILY_SAMPLES = 21,
    FAMILY_DEEPEST = 10000,
};

/* Steps of a crossing in the passage in long steps, half as long in the other; crossings between
 * two unloadings. */
enum { FAMILY_LONG = 4, FAMILY_BRANCH_EVERY = 4 };

double family_depth(size_t i);   /* of loading point i < FAMILY_DEPTHS */
double family_largest(size_t i); /* of unloading i < FAMILY_SPRINGS */

/* What struct contact_family_samples holds of one table. */
struct family_point {
    double force[FAMILY_DEPTHS], area[FAMILY_DEPTHS];
    double back[FAMILY_SPRINGS];
    double share[FAMILY_BRANCHES][FAMILY_SAMPLES];
};

/* What to compute for a place. */
struct region_input family_input(const struct contact_family_place *place, size_t resolution);

/* From a passage in long steps and one, with unloadings, in steps half as long: the steps' error is
 * taken out, that of the mesh is not. False: fewer rings or branches than it takes. */
bool family_point_fill(const struct indentation_run *in_long,
                       const struct indentation_run *in_short, const struct region_input *input,
                       struct family_point *point);

#endif
