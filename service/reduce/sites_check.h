/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Takes back what faces say of the flexibility where it cannot be trusted. */
#ifndef PERCUSS_REDUCE_SITES_CHECK_H
#define PERCUSS_REDUCE_SITES_CHECK_H

#include "model/mesh_body.h"
#include "reduce/site_field.h"

/* Makes all flexibilities of a face NAN where what it says of a place on it is farther from what
 * was solved for there than answers allow for near an edge, where somewhere near an edge it would
 * leave a contact with less than no compliance, and on walls that are too thin
 * (flexibility_place_thin). The faces are filled (sites_spread.h). Returns how many faces know
 * nothing. */
size_t sites_check(const struct site_field *field, const struct surface_rule *rule,
                   struct mesh_body *body);

#endif
