/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Finds instants on a flight. */
#ifndef PERCUSS_IMPACT_FLIGHT_ROOT_H
#define PERCUSS_IMPACT_FLIGHT_ROOT_H

#include "impact/motion.h"

/* Where excess + rate t + acceleration t^2/2 >= 0 while it opens, t >= 0: from *first until *last.
 * Without a pressing acceleration *last is INFINITY and a closing rate never counts; *first
 * INFINITY: never. */
void flight_root_exceeds(double excess, double rate, double acceleration, double *first,
                         double *last);

/* The closing rate of a gap for flight_root_exceeds: 0 where it is within its uncertainty `unknown`
 * and leaves an excess open for all of the time `left`. */
double flight_root_rate(double excess, double rate, double unknown, double left);

/* The longest interval for flight_root_touch, s; INFINITY without modes. */
double flight_root_longest(const struct scene *scene);

/* First touch (approach rising through zero) of a contact within `length` of free motion from
 * `motion`: a root to rounding, by subdivision that misses none but a graze within rounding. False:
 * none. */
bool flight_root_touch(const struct motion *motion, const struct scene *scene, size_t contact,
                       double length, double *time);

#endif
