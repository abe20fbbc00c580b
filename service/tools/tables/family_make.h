/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* All tables of the family. The mesh's error is of first order in the size of its elements and
 * depends on depth and hardening, hardly on Poisson's ratio and share: it is taken out on two
 * meshes at one place for each hardening, and by the same part elsewhere. */
#ifndef PERCUSS_TABLES_FAMILY_MAKE_H
#define PERCUSS_TABLES_FAMILY_MAKE_H

#include "contact/family.h"
#include "fe/indentation.h"

/* One table of the family of contact/family.h, from passages over the contact region. */

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

/* One table of struct contact_family_samples. */
struct family_point {
    double force[FAMILY_DEPTHS], area[FAMILY_DEPTHS];
    double back[FAMILY_SPRINGS];
    double share[FAMILY_BRANCHES][FAMILY_SAMPLES];
};

/* Input of the computation for a place. */
struct region_input family_input(const struct contact_family_place *place, size_t resolution);

/* From a passage in long steps and one, with unloadings, in steps half as long: the steps' error is
 * taken out, that of the mesh is not. False: fewer rings or branches than it takes. */
bool family_point_fill(const struct indentation_run *in_long,
                       const struct indentation_run *in_short, const struct region_input *input,
                       struct family_point *point);

enum { FAMILY_COARSE = 6, FAMILY_FINE = 12 };

/* Where computed points come from. */
struct family_source {
    enum percuss_status (*point)(void *context, const struct contact_family_place *place,
                                 size_t resolution, struct family_point *point,
                                 struct fault *fault);
    void *context;
};

struct family_numbers;

/* For family_numbers_free; NULL with the source's fault or INTERNAL. */
struct family_numbers *family_numbers_make(const struct family_source *source, struct fault *fault);
void family_numbers_free(struct family_numbers *numbers);

/* Valid as long as the numbers. */
struct contact_family_samples family_numbers_samples(const struct family_numbers *numbers);

/* Calls of the source, and of these the calls for the fine mesh. */
size_t family_passages(void);
size_t family_fine_passages(void);

#endif
