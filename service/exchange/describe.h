/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bodies of the catalogue as they are announced. */
#ifndef PERCUSS_EXCHANGE_DESCRIBE_H
#define PERCUSS_EXCHANGE_DESCRIBE_H

#include "model/body.h"
#include "percuss_wire.h"

/* Fills everything but the server; the sample points into `sites`. */
void describe_body(const struct body *body, percuss_v1_Body *wire,
                   percuss_v1_BodySite sites[BODY_MOST_SITES]);

#endif
