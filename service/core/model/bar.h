/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Common parts of straight bars along x: rods, beams, compact cylinders. */
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

/* Checks that a cap covers its whole end, so that no rim of the end face remains. PERCUSS_OK or
 * PERCUSS_BAD_REQUEST. */
enum percuss_status bar_check_tips(const struct body *body, struct fault *fault);

/* A bar with full sections and the same volume is shorter by this length at an end with a cap, m.
 */
double bar_cap_loss(const struct body *body);

/* x of the section on which the cap, or the flat end, of a site stands. */
double bar_cap_section(const struct body *body, const struct site *site);

/* Reason why no model covers a site on a held end; NULL: the site is not on one. */
const char *bar_why_not(const struct body *body, const struct site *site);

/* x of a site on the uniform bar (body->span): that of an end, or within its length. */
double bar_place(const struct body *body, const struct site *site);

/* Sets the force along x of a hit on an end, or of a tangential force anywhere. A hit on the side
 * drives no longitudinal waves: its part along x comes from the angle that is allowed between the
 * stated and the true normal. */
void bar_load_along(const struct body *body, const struct site *site, const double direction[3],
                    bool tangential, struct family_load *load);

/* Sets whether the load acts: a force below 1e-9 N, or a moment below 1e-9 N times the smallest
 * radius, is rounding of the pose. */
void bar_load_settle(const struct body *body, struct family_load *load);

/* Describes ends, damping and a fixed number of modes. */
void bar_describe_ends(const struct body *body, struct body_description *description);

#endif
