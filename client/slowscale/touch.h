/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Contacts as they were before the present, within a step that ended behind their touch. */
#ifndef PERCUSS_SLOW_TOUCH_H
#define PERCUSS_SLOW_TOUCH_H

#include "group.h"

/* A contact's gap, m, and gap rate, m/s. */
struct approach {
    double gap, rate;
};

/* The approach `back` s before now, with the acceleration of now. Bodies that lie together are
 * balanced and do not accelerate. */
struct approach touch_before(const struct percuss_slow *slow,
                             const struct percuss_slow_contact *contact, double gap_rate,
                             double now, double back);

/* When a contact that is due now touched, s: the root of its gap backward in time, with a constant
 * acceleration. Not before the last call (at the first one nothing bounds it: its state is taken as
 * the end of a step), nor within the window of the pair's last answer. `now`
 * where the bodies cannot be moved, the acceleration is not known, or the approach then was none.
 */
double touch_time(const struct percuss_slow *slow, const struct percuss_slow_contact *contact,
                  double gap_rate, double now);

/* Sets the group, as it is now without the impulses taken back, to its start: gaps, gap rates, and
 * the bodies as far as these need it: apart along the normals, with other velocities along them.
 * Along the surface and in angle they stay where they are now. */
enum percuss_result touch_go_back(const struct percuss_slow *slow, struct group *group, double now);

/* Lays the point of overlapping surfaces, which is halfway between them, on that of the only body
 * that moves, if one is fixed: so that the arm of friction is that of the touch. */
void touch_lay_point(const struct percuss_slow *slow, struct percuss_slow_contact *contact);

#endif
