/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_CATALOGUE_CONTENT_H
#define PERCUSS_CATALOGUE_CONTENT_H

#include "catalogue/reader.h"
#include "model/body.h"

/* Reads a whole document into an empty set: materials, bodies (completed), contact; the revision is
 * left to the caller. After a failure the set holds nothing. */
enum percuss_status content_read(struct reader *reader, struct body_set *set);

/* Reads its materials alone, and takes the one of that name. */
enum percuss_status content_read_material(struct reader *reader, const char *name,
                                          struct material *material);

#endif
