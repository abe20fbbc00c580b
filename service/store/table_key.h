/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Identification of a computed contact table by its inputs. */
#ifndef PERCUSS_STORE_TABLE_KEY_H
#define PERCUSS_STORE_TABLE_KEY_H

#include <stdbool.h>

#include "fe/indentation.h"

enum { TABLE_KEY_SIZE = 33 };

/* Radius of every table made for its materials alone: laws scale, see contact_law_table_at. */
#define TABLE_RADIUS 0.01

enum { TABLE_RESOLUTION = 12 };

/* 32 hexadecimal digits, a hash of all inputs of the computation: both materials' elastic and
 * plastic constants (in either order; neither names nor densities), radius, largest indentation,
 * resolution and INDENTATION_VERSION. */
void table_key(const struct region_input *input, char key[TABLE_KEY_SIZE]);

/* A hash of all numbers of a table, in the same form. */
void table_content_key(const struct indentation_table *table, char key[TABLE_KEY_SIZE]);

/* The same for any lists of numbers. */
void table_numbers_key(size_t lists, const size_t *counts, const double *const *values,
                       char key[TABLE_KEY_SIZE]);

/* Same constants to the last bit, except name and density, which a static region does not need. */
bool table_same_material(const struct material *a, const struct material *b);

/* The input for two materials that covers impacts at up to `speed` (m/s) of a solid sphere of the
 * denser one, of any size, on an immovable flat of the other: no free pair of compact bodies of
 * these materials indents deeper. A quarter is added; the region's own limit of 0.02 radius may cut
 * it. */
struct region_input table_input(const struct material *a, const struct material *b, double speed);

#endif
