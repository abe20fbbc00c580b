/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bodies of the catalogue that are given as meshes: the orders of their reductions, and the files'
 * names. */
#ifndef PERCUSS_CATALOGUE_MESH_ORDER_H
#define PERCUSS_CATALOGUE_MESH_ORDER_H

#include <stdbool.h>

#include "catalogue/reader.h"
#include "model/body.h"

/* Whether the path is that of a mesh: any but a body file of percuss-reduce (.h5). */
bool mesh_order_is_mesh(const char *path);

/* Refuses keys that may only stand beside a mesh. */
enum percuss_status mesh_order_refuse(struct reader *reader, struct entry entry);

/* Gives the set an order for a mesh. *path, which came from malloc, becomes that of the reduced
 * body, or NULL where that is not there yet; after a failure it stays. */
enum percuss_status mesh_order_read(struct reader *reader, struct entry entry, struct body_set *set,
                                    const struct body *body, char **path);

/* Gives the set an order for a body without its file, with the fault's text. PERCUSS_OK, or
 * PERCUSS_INTERNAL. */
enum percuss_status mesh_order_missing(const struct reader *reader, struct body_set *set,
                                       const struct body *body);

#endif
