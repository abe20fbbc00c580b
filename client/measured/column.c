/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "column.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "divide.h"
#include "fall.h"

#define PLAIN 0.0, NULL /* nothing is improbable */
const struct column_kind IMPACT_KINDS[IMPACT_COLUMNS] = {
    [IMPACT_SPEED] = {"speed", false, false, QUANTITY_SPEED, 1e-9, 1e6, "m/s > 0", 100.0,
                      "is a unit missing, such as mm/s?"},
    /* 0..1 but for the scatter of readings, and for bodies that vibrate before */
    [IMPACT_RESTITUTION] = {"restitution", false, false, QUANTITY_NUMBER, -1.0, 2.0,
                            "a number -1..2", 1.0,
                            "only a body that vibrated before the impact gives so much back"},
    [IMPACT_IMPULSE] = {"impulse", false, false, QUANTITY_IMPULSE, 0.0, 1e12, "N s >= 0", PLAIN},
    [IMPACT_SUB_IMPACTS] = {"sub_impacts", false, true, QUANTITY_NUMBER, 0.0, 1e6, "a count >= 0",
                            PLAIN},
    [IMPACT_FIRST_IMPULSE] = {"first_impulse", false, false, QUANTITY_IMPULSE, 0.0, 1e12,
                              "N s >= 0", PLAIN},
    [IMPACT_FIRST_DURATION] = {"first_duration", false, false, QUANTITY_TIME, 0.0, 1e6, "s >= 0",
                               PLAIN},
    [IMPACT_SECOND_START] = {"second_start", false, false, QUANTITY_TIME, 0.0, 1e6, "s >= 0",
                             PLAIN},
    [IMPACT_AT] = {"at", false, false, QUANTITY_NUMBER, 0.0, 1.0, "a fraction 0..1", PLAIN},
    [IMPACT_V_OUT] = {"v_out", false, false, QUANTITY_SPEED, 0.0, 1e6,
                      "m/s >= 0, at which the bodies separate", PLAIN},
    /* rigs of a laboratory stand below its ceiling */
    [IMPACT_DROP] = {"drop", false, false, QUANTITY_LENGTH, 1e-9, 1e6, "m > 0, of the fall", 20.0,
                     "is a unit missing, such as mm?"},
    [IMPACT_REBOUND] = {"rebound", false, false, QUANTITY_LENGTH, 0.0, 1e6,
                        "m >= 0, to which A rises", PLAIN},
    [IMPACT_BOUNCE] = {"bounce", false, false, QUANTITY_TIME, -HUGE_VAL, HUGE_VAL, "any", PLAIN},
    [IMPACT_HISTORY] = {"history", true, false, QUANTITY_NUMBER, 0.0, 0.0, "a file", PLAIN},
};

#define ANY -HUGE_VAL, HUGE_VAL, "any", PLAIN
const struct column_kind HISTORY_KINDS[HISTORY_COLUMNS] = {
    [HISTORY_TIME] = {"time", false, false, QUANTITY_TIME, ANY},
    [HISTORY_VELOCITY_A] = {"velocity_a", false, false, QUANTITY_SPEED, ANY},
    [HISTORY_VELOCITY_B] = {"velocity_b", false, false, QUANTITY_SPEED, ANY},
    [HISTORY_DISPLACEMENT_A] = {"displacement_a", false, false, QUANTITY_LENGTH, ANY},
    [HISTORY_DISPLACEMENT_B] = {"displacement_b", false, false, QUANTITY_LENGTH, ANY},
    [HISTORY_ACCELERATION_A] = {"acceleration_a", false, false, QUANTITY_ACCELERATION, ANY},
    [HISTORY_ACCELERATION_B] = {"acceleration_b", false, false, QUANTITY_ACCELERATION, ANY},
};

const char COLUMN_PIXEL[] = "px", COLUMN_FRAME[] = "frame";

double column_gravity(const struct column_map *map)
{
    return map && map->gravity > 0.0 ? map->gravity : FALL_STANDARD_GRAVITY;
}

const struct column_kind *column_find(const char *name)
{
    for (int i = 0; i < IMPACT_COLUMNS; i++)
        if (!strcmp(name, IMPACT_KINDS[i].name))
            return &IMPACT_KINDS[i];
    for (int i = 0; i < HISTORY_COLUMNS; i++)
        if (!strcmp(name, HISTORY_KINDS[i].name))
            return &HISTORY_KINDS[i];
    return NULL;
}

const struct column_choice *column_map_find(const struct column_map *map,
                                            const struct column_kind *kind)
{
    for (size_t i = 0; map && i < map->count; i++)
        if (map->choices[i].kind == kind)
            return &map->choices[i];
    return NULL;
}

struct column_allowed column_allowed_unit(const struct column_kind *kind)
{
    struct column_allowed allowed;
    if (kind->quantity == QUANTITY_NUMBER)
        snprintf(allowed.text, sizeof allowed.text, "%s: %s has no unit",
                 kind->is_count ? "nothing" : "nothing or %", kind->name);
    else
        snprintf(allowed.text, sizeof allowed.text, "a unit of %s, as in %s",
                 units_name(kind->quantity), units_example(kind->quantity));
    return allowed;
}

/* NAME, to which there must be a kind that has no choice yet. */
static const struct column_kind *find_free(const struct column_map *map, const char *text,
                                           size_t length, struct measured_fault *fault)
{
    char name[HEADING_SIZE];
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    const struct column_kind *kind = length < sizeof name ? column_find(name) : NULL;
    if (!kind) {
        measured_fail(
            fault,
            "'%s': '%s' is none of speed, restitution, impulse, sub_impacts, "
            "first_impulse, first_duration, second_start, at, v_out, drop, rebound, bounce, "
            "history, "
            "and in histories time, and velocity, displacement or acceleration of a or b: "
            "velocity_a, ...",
            text, name);
    } else if (column_map_find(map, kind)) {
        measured_fail(fault, "'%s': %s is given twice", text, name);
        kind = NULL;
    }
    return kind;
}

/* Whether the heading is the name of a column of another quantity. */
static bool is_of_another(const struct column_kind *kind, const char *heading,
                          struct measured_fault *fault)
{
    for (int i = 0; i < IMPACT_COLUMNS + HISTORY_COLUMNS; i++) {
        const struct column_kind *named =
            i < IMPACT_COLUMNS ? &IMPACT_KINDS[i] : &HISTORY_KINDS[i - IMPACT_COLUMNS];
        if (!cell_same_name(named->name, heading) || named->is_text ||
            named->quantity == kind->quantity)
            continue;
        measured_fail(fault, "'%s=%s': %s is in %s, %s %s%s: %s is a column of its own", kind->name,
                      heading, named->name,
                      *units_si(named->quantity) ? units_si(named->quantity) : "no unit",
                      kind->name, *units_si(kind->quantity) ? "in " : "has no unit",
                      units_si(kind->quantity), named->name);
        return true;
    }
    return false;
}

bool column_map_doubt(struct column_map *map, const char *text, struct measured_fault *fault)
{
    const char *equals = strchr(text, '=');
    char name[HEADING_SIZE];
    snprintf(name, sizeof name, "%.*s", equals ? (int)(equals - text) : 0, text);
    int kind = 0;
    while (kind < IMPACT_HISTORY && strcmp(IMPACT_KINDS[kind].name, name) != 0)
        kind++;
    if (!equals || kind == IMPACT_HISTORY)
        return measured_fail(fault, "'%s': NAME=VALUE is needed, of a column of impacts: drop=1mm",
                             text);
    double value;
    const struct column_kind *column = &IMPACT_KINDS[kind];
    if (column->is_count || units_read(equals + 1, column->quantity, &value) != UNITS_GOOD ||
        !(value > 0.0))
        return measured_fail(fault, "'%s': a number > 0 is needed%s%s", text,
                             *units_si(column->quantity) ? ", in SI units or with its own, as "
                                                         : "",
                             *units_si(column->quantity) ? units_example(column->quantity) : "");
    map->uncertainty[kind] = value;
    return true;
}

bool column_map_add(struct column_map *map, const char *text, struct measured_fault *fault)
{
    struct column_choice choice = {NULL, "", ""};
    const char *equals = strchr(text, '=');
    if (!equals || !equals[1])
        return measured_fail(fault, "'%s': NAME=HEADING[:UNIT] is needed", text);
    choice.kind = find_free(map, text, (size_t)(equals - text), fault);
    if (!choice.kind)
        return false;
    /* HEADING, and a unit behind the last colon */
    const char *heading = equals + 1, *colon = strrchr(heading, ':');
    size_t length = colon ? (size_t)(colon - heading) : strlen(heading);
    if (length == 0 || length >= sizeof choice.heading)
        return measured_fail(fault, "'%s': a heading of 1 to %d bytes is needed", text,
                             HEADING_SIZE - 1);
    memcpy(choice.heading, heading, length);
    if (colon)
        column_unit(colon + 1, choice.unit);
    if (is_of_another(choice.kind, choice.heading, fault))
        return false;
    if (column_accepts(choice.kind, choice.unit) != UNITS_GOOD)
        return measured_fail(fault, "'%s': '%s': must be %s", text, choice.unit,
                             column_allowed_unit(choice.kind).text);
    map->choices[map->count++] = choice;
    return true;
}

/* How programs of rigs write it, and how the unit table does. */
static const char *const SPELLINGS[][2] = {
    {"Ns", "N s"},   {"mNs", "mN s"},  {"kNs", "kN s"},     {"sec", "s"}, {"msec", "ms"},
    {"usec", "us"},  {"1", ""},        {"-", ""},           {"--", ""},   {"\xE2\x80\x93", ""},
    {"pixel", "px"}, {"pixels", "px"}, {"frames", "frame"},
};

void column_unit(const char *text, char unit[UNIT_SIZE])
{
    size_t length = strlen(text), size = 0;
    /* without blanks and brackets around it */
    while (length > 0 && strchr(" [(", *text)) {
        text++;
        length--;
    }
    while (length > 0 && strchr(" ])", text[length - 1]))
        length--;
    /* a middle dot, of which there are two, is a sign */
    for (size_t i = 0; i < length && size + 1 < UNIT_SIZE; i++) {
        size_t dot = !strncmp(text + i, "\xC2\xB7", 2)       ? 2
                     : !strncmp(text + i, "\xE2\x8B\x85", 3) ? 3
                                                             : 0;
        unit[size++] = text[i];
        if (dot > 0) {
            unit[size - 1] = '*';
            i += dot - 1;
        }
    }
    unit[size] = '\0';
    /* in the table's words */
    for (size_t i = 0; i < sizeof SPELLINGS / sizeof SPELLINGS[0]; i++)
        if (!strcmp(unit, SPELLINGS[i][0])) {
            snprintf(unit, UNIT_SIZE, "%s", SPELLINGS[i][1]);
            return;
        }
}

enum units_problem column_number(const struct column_kind *kind, const char *number,
                                 const char *unit, double *value)
{
    char text[CELL_SIZE + UNIT_SIZE + 2];
    bool is_share = kind->quantity == QUANTITY_NUMBER && !kind->is_count;
    size_t length = strnlen(number, CELL_SIZE);
    bool counted = (kind->quantity == QUANTITY_LENGTH && !strcmp(unit, COLUMN_PIXEL)) ||
                   (kind->quantity == QUANTITY_TIME && !strcmp(unit, COLUMN_FRAME));
    if (counted)
        return units_read(number, QUANTITY_NUMBER, value);
    bool marked = is_share && length > 0 && number[length - 1] == '%' && (!*unit || *unit == '%');
    length -= marked;
    /* read as a length: a per cent is 0.01 as a centimetre is 0.01 m */
    bool share = is_share && (marked || !strcmp(unit, "%"));
    snprintf(text, sizeof text, "%.*s %s", (int)length, number, share ? "cm" : unit);
    return units_read(text, share ? QUANTITY_LENGTH : kind->quantity, value);
}

enum units_problem column_accepts(const struct column_kind *kind, const char *unit)
{
    double one;
    if (kind->is_text)
        return *unit ? UNITS_OF_ANOTHER : UNITS_GOOD;
    return column_number(kind, "1", unit, &one);
}

/* The name before the unit, without the separators between them. */
static void take_name(const char *heading, size_t length, char name[HEADING_SIZE])
{
    while (length > 0 && strchr(" /", heading[length - 1]))
        length--;
    if (length > 3 && !strncmp(heading + length - 3, " in", 3))
        length -= 3;
    snprintf(name, HEADING_SIZE, "%.*s", (int)length, heading);
}

void column_heading(const char *heading, char name[HEADING_SIZE], char unit[UNIT_SIZE])
{
    size_t length = strlen(heading);
    const char *in = strstr(heading, " in "), *slash = strchr(heading, '/');
    const char *bracket = strpbrk(heading, "[(");
    /* in brackets up to the end */
    const char *from = NULL;
    if (bracket && bracket > heading && strchr("])", heading[length - 1]))
        from = bracket;
    else if (in)
        from = in + 4;
    else if (slash)
        from = slash + 1;
    /* or there is none: nor where these are several headings that another sign separates */
    column_unit(from ? from : "", unit);
    if (strpbrk(unit, "[]();,\t")) {
        from = NULL;
        *unit = '\0';
    }
    take_name(heading, from ? (size_t)(from - heading) : length, name);
}
