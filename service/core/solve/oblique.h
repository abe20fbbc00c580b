/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Contacts with friction: which they are, their tangents, and the tangential loads on the bodies.
 */
#ifndef PERCUSS_SOLVE_OBLIQUE_H
#define PERCUSS_SOLVE_OBLIQUE_H

#include "solve/problem.h"

/* Coefficients by the request or the catalogue, tangents and loads of the placed contacts.
 * PERCUSS_OK, BAD_REQUEST (a delassus without tangents) or INTERNAL without memory. */
enum percuss_status oblique_find(struct problem *problem, const struct body_set *catalogue,
                                 struct fault *fault);

/* Turns the tangential loads on a body into the planes of its axes. */
void oblique_turn(struct problem *problem, size_t body);

/* Refuses what friction is not computed for: finite elements, and the plain law by CVODE. */
enum percuss_status oblique_check(const struct problem *problem, struct fault *fault);

/* A contact's friction, or NULL. */
const struct contact_friction *oblique_of(const struct problem *problem, size_t contact);

#endif
