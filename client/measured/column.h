/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Columns that are known by name, and their headings in a file. */
#ifndef PERCUSS_MEASURED_COLUMN_H
#define PERCUSS_MEASURED_COLUMN_H

#include "base/units.h"
#include "remarks.h"

struct column_kind {
    const char *name;
    bool is_text, is_count;
    enum quantity quantity;
    double low, high;
    const char *allowed;  /* in words */
    double usual;         /* a larger number is possible but improbable; 0: none is */
    const char *question; /* the likely cause then */
};

/* Those of a file of impacts, and of one of time histories. */
enum {
    IMPACT_SPEED,
    IMPACT_RESTITUTION,
    IMPACT_IMPULSE,
    IMPACT_SUB_IMPACTS,
    IMPACT_FIRST_IMPULSE,
    IMPACT_FIRST_DURATION,
    IMPACT_SECOND_START,
    IMPACT_AT,
    IMPACT_V_OUT,
    IMPACT_DROP,
    IMPACT_REBOUND,
    IMPACT_BOUNCE,
    IMPACT_HISTORY,
    IMPACT_COLUMNS
};
enum {
    HISTORY_TIME,
    HISTORY_VELOCITY_A,
    HISTORY_VELOCITY_B,
    HISTORY_DISPLACEMENT_A,
    HISTORY_DISPLACEMENT_B,
    HISTORY_ACCELERATION_A,
    HISTORY_ACCELERATION_B,
    HISTORY_COLUMNS
};
enum { COLUMN_KINDS = IMPACT_COLUMNS };
extern const struct column_kind IMPACT_KINDS[IMPACT_COLUMNS], HISTORY_KINDS[HISTORY_COLUMNS];

enum { HEADING_SIZE = 128, UNIT_SIZE = 48 };

/* A column as the user describes it. */
struct column_choice {
    const struct column_kind *kind;
    char heading[HEADING_SIZE]; /* or the column's number from 1 on */
    char unit[UNIT_SIZE];       /* empty: as the file says */
};

/* What is said of a file besides: the headings of its columns, and of what its instruments count.
 * 0: not said. */
struct column_map {
    size_t count;
    struct column_choice choices[IMPACT_COLUMNS + HISTORY_COLUMNS];
    double scale;                       /* m of a pixel */
    double rate;                        /* readings, or frames, a second */
    double gravity;                     /* m/s^2 */
    double uncertainty[IMPACT_COLUMNS]; /* half of the 95 % interval of each number of a column */
};

/* Units that `scale` and `rate` make lengths and times of. */
extern const char COLUMN_PIXEL[], COLUMN_FRAME[]; /* "px", "frame" */

/* The gravity that was stated, or else the standard one. */
double column_gravity(const struct column_map *map);

/* Takes "NAME=VALUE", half of a 95 % interval of a column of numbers. False with the reason. */
bool column_map_doubt(struct column_map *map, const char *text, struct measured_fault *fault);

/* Takes "NAME=HEADING[:UNIT]"; a heading with a colon needs one behind it as well. False with the
 * reason. */
bool column_map_add(struct column_map *map, const char *text, struct measured_fault *fault);

/* The choice for that kind; NULL: none, as where there is no map. */
const struct column_choice *column_map_find(const struct column_map *map,
                                            const struct column_kind *kind);

/* The kind of that name; NULL: none. */
const struct column_kind *column_find(const char *name);

/* A unit as the unit table has it: without brackets, "Ns" as "N s", a middle dot as a sign of
 * multiplication, "-" and "1" as nothing. */
void column_unit(const char *text, char unit[UNIT_SIZE]);

/* Whether a column of that kind may be in this unit, written as column_unit does; nothing: in SI
 * units. */
enum units_problem column_accepts(const struct column_kind *kind, const char *unit);

/* Which units these are, in words. */
struct column_allowed {
    char text[96];
};
struct column_allowed column_allowed_unit(const struct column_kind *kind);

/* Reads a number, without a mark but the decimal point, that is in this unit; pixels and frames
 * are counted. A share may bear a % of its own. */
enum units_problem column_number(const struct column_kind *kind, const char *number,
                                 const char *unit, double *value);

/* A heading's name and unit: "v [mm/s]", "v (mm/s)", "v / (mm/s)", "v in mm/s". */
void column_heading(const char *heading, char name[HEADING_SIZE], char unit[UNIT_SIZE]);

#endif
