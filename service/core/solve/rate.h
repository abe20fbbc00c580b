/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Yield stresses of contacts at the rate of strain of the impact. */
#ifndef PERCUSS_SOLVE_RATE_H
#define PERCUSS_SOLVE_RATE_H

#include "base/text.h"
#include "impact/scene.h"
#include "solve/problem.h"

/* Raises the yield stresses of both bodies at a contact (their materials there) to those at the
 * rates that count (contact/strain_rate.h) in a blow of the rigid masses at a speed (m/s); where
 * that is not > 0, others strike the contact: at the fastest approach of all. */
struct contact_rate rate_raise(struct problem *problem, size_t contact, double speed);

/* The laws of a scene where all its speeds are `factor` times as large. PERCUSS_OK or
 * PERCUSS_INTERNAL. */
enum percuss_status rate_follow(const struct problem *problem, double factor, struct scene *scene);

/* Writes by how much a contact's yield stresses are raised, where they are. */
void rate_explain(const struct problem *problem, size_t contact, struct text *text);

#endif
