/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Time histories of the bodies' motion along the normal, as from laser-Doppler vibrometers, and the
 * impact that they show. */
#ifndef PERCUSS_MEASURED_HISTORY_H
#define PERCUSS_MEASURED_HISTORY_H

#include "column.h"

enum { HISTORY_LEAST_READINGS = 32 };

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

enum { HISTORY_SUB_IMPACTS = 64 };

struct history_sub_impact {
    double start, end; /* s */
    double jump;       /* of A's velocity, m/s */
    double approach;   /* velocity of A until it, of B taken off, m/s: < 0 */
    bool begins;       /* an impact: the first, and those that gravity brings A back to */
    double doubt;      /* of one that begins: half of the 95 % interval of the sum of its jumps over
                          its approach, as a share of that */
};

struct history_impacts {
    size_t count;
    struct history_sub_impact list[HISTORY_SUB_IMPACTS];
    double before;       /* the first one's approach, m/s */
    double acceleration; /* of A between contacts, m/s^2, as the instrument counts; 0: even */
    double direction;    /* +1, or -1 where the instrument counts the approach positive */
    bool of_b;           /* as the history's */
    double noise;        /* standard deviation of one velocity reading, m/s */
};

/* Finds sub-impacts as jumps of A's velocity that stand out of the noise: a rigid body moves evenly
 * between contacts or, where that stands out of the noise too, with one acceleration, fitted to all
 * flights; of displacements the flights are parabolas. Starts and ends are extrapolated with the
 * 5/2 power of time by which a Hertz contact begins to change a velocity. Directions may be either
 * way round. False with the reason: too few readings, no jump, no readings before the first,
 * flights that are no such motion, or fall by another gravity than the stated one. Of an
 * acceleration, and of B alone, no approach is known: 0. */
bool history_find(const struct history *history, struct history_impacts *impacts,
                  struct measured_fault *fault);

/* A history as a simulated one goes: time from the start of the first sub-impact, A approaching
 * with a negative velocity, displacements from that instant on. Arrays of `count`. */
struct history_motion {
    size_t count;
    double *time;
    double *velocity[2], *displacement[2]; /* of A, of B; NULL: not measured */
};

/* By the result of history_find; displacements are the velocities' integrals. False: out of memory.
 */
bool history_align(const struct history *history, const struct history_impacts *impacts,
                   struct history_motion *motion);

void history_motion_free(struct history_motion *motion);

#endif
