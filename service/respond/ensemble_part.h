/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Who solves items of an ensemble for somebody else, in whatever process: item i is a function of
 * the request and of i alone. One thread. */
#ifndef PERCUSS_RESPOND_ENSEMBLE_PART_H
#define PERCUSS_RESPOND_ENSEMBLE_PART_H

#include "base/hash.h"
#include "respond/ensemble_means.h"

struct ensemble_part;

/* Chooses the model, as everybody does who shares the ensemble. Of the means snapshot, tables,
 * limit and most_samples count; means and question are borrowed until it is freed. Status and fault
 * as of the ensemble; *part is NULL then. */
enum percuss_status ensemble_part_create(const struct ensemble_means *means,
                                         const struct ensemble_question *question,
                                         struct ensemble_part **part, struct fault *fault);
void ensemble_part_free(struct ensemble_part *part); /* NULL is allowed */

/* What all who share it agree in. */
struct digest ensemble_part_digest(const struct ensemble_part *part);

/* Number of samples, of extras to that many samples: what ranges may be of. */
uint64_t ensemble_part_items(const struct ensemble_part *part, bool extras, uint64_t done);

/* Solves the range into `items`: room for as many struct ensemble_sample or struct ensemble_extra.
 */
void ensemble_part_solve(struct ensemble_part *part, const struct ensemble_range *range,
                         void *items);

#endif
