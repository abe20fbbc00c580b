/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* All tables of the family. The mesh's error is of first order in the size of its elements and
 * depends on depth and hardening, hardly on Poisson's ratio and share: it is taken out on two
 * meshes at one place for each hardening, and by the same part elsewhere. */
#ifndef PERCUSS_TABLES_FAMILY_MAKE_H
#define PERCUSS_TABLES_FAMILY_MAKE_H

#include "tables/family_point.h"

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

/* How often the source is asked, and how often of that for the fine mesh. */
size_t family_passages(void);
size_t family_fine_passages(void);

#endif
