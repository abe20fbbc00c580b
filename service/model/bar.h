/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What straight bars along x have in common: rods, beams, compact cylinders. */
#ifndef PERCUSS_MODEL_BAR_H
#define PERCUSS_MODEL_BAR_H

#include "model/body.h"
#include "model/describe.h"
#include "model/face.h"
#include "model/site.h"

/* Mass and inertia of a solid round cylinder; caps are not counted. */
void bar_complete_round(struct body *body);

/* The two ends, rounded or flat (INFINITY), and the side of a round bar; their number. */
int bar_round_faces(const struct body *body, double tip_radius, const double p[3],
                    struct face *faces);

/* Why a site on a held end has no model; NULL: it is none. */
const char *bar_why_not(const struct body *body, const struct site *site);

/* Ends, damping and a fixed number of modes. */
void bar_describe_ends(const struct body *body, struct body_description *description);

#endif
