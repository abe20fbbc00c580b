/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What straight bars along x have in common: rods, beams, compact cylinders. */
#ifndef PERCUSS_MODEL_BAR_H
#define PERCUSS_MODEL_BAR_H

#include "model/body.h"
#include "model/body_kind.h"
#include "model/modal_basis.h"
#include "model/site.h"

/* The families of a bar's modes: longitudinal along x, transverse along y and along z, twist about
 * x. A rod has the first only. */
enum bar_family { BAR_LONGITUDINAL, BAR_BENDING_Y, BAR_BENDING_Z, BAR_TWIST };

/* Mass and inertia of a solid round cylinder; caps are not counted. */
void bar_complete_round(struct body *body);

/* The two ends, rounded or flat (INFINITY), and the side of a round bar; their number. */
int bar_round_faces(const struct body *body, double tip_radius, const double p[3],
                    struct face *faces);

/* Caps that cover the ends, or none: a smaller one would leave the face's rim beside it. PERCUSS_OK
 * or PERCUSS_BAD_REQUEST. */
enum percuss_status bar_check_tips(const struct body *body, struct fault *fault);

/* By how much a bar of a full section and the same volume is shorter at an end with a cap, m. */
double bar_cap_loss(const struct body *body);

/* Where along x a cap, or a flat end, stands on the bar of a full section. */
double bar_cap_section(const struct body *body, const struct site *site);

/* Why a site on a held end has no model; NULL: it is none. */
const char *bar_why_not(const struct body *body, const struct site *site);

/* Where along x a site is: on an end, or within the length. */
double bar_place(const struct body *body, const struct site *site);

/* The force along x: of a hit on an end. One on the side drives no longitudinal waves here: within
 * the angle allowed between stated and true normal that part is not the contact's. */
void bar_load_along(const struct body *body, const struct site *site, const double direction[3],
                    struct family_load *load);

/* Whether the load acts: what is below 1e-9 of a newton, its moment taken at the smallest radius,
 * is rounding of the pose. */
void bar_load_settle(const struct body *body, struct family_load *load);

/* Ends, damping and a fixed number of modes. */
void bar_describe_ends(const struct body *body, struct body_description *description);

#endif
