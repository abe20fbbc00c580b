/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Measured impacts of one pair of bodies and their simulated twins. SI units; NAN: not known. */
#ifndef PERCUSS_MEASURED_IMPACT_H
#define PERCUSS_MEASURED_IMPACT_H

#include "history_impacts.h"

struct measured_impact {
    double speed; /* of approach */
    double restitution;
    double impulse;       /* of all sub-impacts */
    double sub_impacts;   /* a count */
    double first_impulse; /* of the first sub-impact */
    double first_duration;
    double second_start; /* of the second sub-impact of at least 1 % of the impulse, after the
                            start of the first */
    double at;           /* place along a beam, 0..1 */
    double momentum;     /* impulse over the mass of body A: from its velocity, m/s */
    double first_momentum;
    double v_out;         /* speed of separation of the rigid motions: e = v_out / speed */
    double drop, rebound; /* heights of A's fall from rest, and of its rise */
    double bounce;        /* instant of a touch, among others of one file */
    double momentum_of_b; /* 1: the momenta are impulses over the mass of body B */
    double doubt;         /* half of the 95 % interval of 1 + e, as a share of it */
};

/* Nothing known. */
struct measured_impact measured_impact_unknown(void);

/* A row that tells no impact. */
struct measured_left {
    size_t line;
    const char *reason;
};

struct measured_set {
    size_t count, room;
    struct measured_impact *impacts;
    size_t left_count;
    struct measured_left *left;
};

void measured_set_free(struct measured_set *set);

/* Reads a file of columns (table.h): any of speed, restitution, impulse, sub_impacts,
 * first_impulse, first_duration, second_start, at, v_out, drop, rebound, bounce, and history, the
 * name of a file of time histories (relative to this one); or such a file by itself. Numbers of
 * `bounce` are the instants at which A touches B, of one fall: of each between two others the times
 * of flight tell the speeds. Empty fields and nan are unknown. Rows without a speed (or a
 * history, which has it) or without any of restitution, v_out, impulse and history are left out,
 * with a note. False with all faults: file, line, value and allowed values. */
bool measured_read(const char *file, const struct column_map *map, struct measured_set *set,
                   struct measured_remarks *remarks);

/* Reads the column of speeds alone, of such a file. Rows without one are left out, with a note.
 * False with all faults. The caller frees *speeds, of *count. */
bool measured_read_speeds(const char *file, const struct column_map *map, double **speeds,
                          size_t *count, struct measured_remarks *remarks);

/* Appends an impact. False: out of memory. */
bool measured_append(struct measured_set *set, const struct measured_impact *impact);

/* The impact that begins with sub-impact *next of a history, as far as that tells it; *next becomes
 * that of the one after it. */
struct measured_impact measured_impact_from(const struct history_impacts *history, size_t *next);

/* Half of the 95 % interval of the restitution of an impact that is complete, by what its
 * instruments scatter and by what is stated of them; NAN: not known. */
double measured_half_width(const struct measured_impact *impact);

/* Fills the numbers that follow once the mass of A and the inverse effective mass w (1/kg) are
 * known: impulses from momenta, e = impulse w / speed - 1 (Eq. (6)) and the other way round, and
 * the first impulse where it is the only one. `mass`: of the body that the momenta are of. */
void measured_complete(struct measured_impact *impact, double mass, double w);

#endif
