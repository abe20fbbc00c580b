/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Time histories of the bodies' motion along the normal, as from laser-Doppler vibrometers. */
#ifndef PERCUSS_MEASURED_HISTORY_H
#define PERCUSS_MEASURED_HISTORY_H

#include "column.h"

/* Readings that a history needs, and contacts that are looked for in it. */
enum { HISTORY_LEAST_READINGS = 32, HISTORY_SUB_IMPACTS = 64 };

/* Arrays of `count`. */
struct history {
    size_t count;
    double *time;           /* ascending, s */
    double *velocity_a;     /* of the rigid body A, m/s */
    double *velocity_b;     /* of body B; NULL: not measured (at rest before) */
    double *displacement_a; /* m, of which velocity_a is the differences; NULL: not measured */
    bool from_displacement; /* velocities are differences of measured displacements */
    double *acceleration_a; /* m/s^2, of which velocity_a is the integral, up to a constant and to
                               what gravity adds; NULL: not measured */
    bool of_b;              /* B alone was measured: it stands in A's place */
    double gravity;         /* that was stated, m/s^2; 0: not stated */
};

/* Reads a file of columns (table.h): time, for which the map's rate may stand, and velocity_a,
 * displacement_a or acceleration_a, optionally velocity_b or displacement_b; or these of B alone.
 * Up to a tenth of the rows may lack a reading; they are left out, with a note. False with all that
 * is wrong. */
bool history_read(const char *file, const struct column_map *map, struct history *history,
                  struct measured_remarks *remarks);

void history_free(struct history *history);

#endif
