/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "history.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "table.h"
#include "text.h"

/* Replaces displacements by their differences: central ones, one-sided at the ends. */
static bool differentiate(const double *time, double *values, size_t count)
{
    double *slope = calloc(count, sizeof *slope);
    if (!slope)
        return false;
    for (size_t i = 0; i < count; i++) {
        size_t before = i > 0 ? i - 1 : 0, after = i + 1 < count ? i + 1 : i;
        slope[i] = (values[after] - values[before]) / (time[after] - time[before]);
    }
    memcpy(values, slope, count * sizeof *values);
    free(slope);
    return true;
}

/* The columns that are read: time, and of each body its velocity or else its displacement;
 * HISTORY_COLUMNS: the other one was not measured. */
struct choice {
    size_t column[3];
    bool of_b; /* the first body is B */
    double *values[3];
};

static size_t choose(const struct table *table, const size_t columns[3])
{
    for (int i = 0; i < 3; i++)
        if (table_has(table, columns[i]))
            return columns[i];
    return HISTORY_COLUMNS;
}

/* The body that is followed, and the other one, of which an acceleration tells no velocity. */
static bool choose_bodies(const struct table *table, struct choice *choice)
{
    static const size_t a[] = {HISTORY_VELOCITY_A, HISTORY_DISPLACEMENT_A, HISTORY_ACCELERATION_A};
    static const size_t b[] = {HISTORY_VELOCITY_B, HISTORY_DISPLACEMENT_B, HISTORY_ACCELERATION_B};
    choice->column[1] = choose(table, a);
    choice->column[2] = choose(table, b);
    choice->of_b = choice->column[1] == HISTORY_COLUMNS;
    if (choice->of_b)
        choice->column[1] = choice->column[2];
    if (choice->of_b || choice->column[2] == HISTORY_ACCELERATION_B)
        choice->column[2] = HISTORY_COLUMNS;
    return choice->column[1] < HISTORY_COLUMNS;
}

static double rate_of(const struct table *table)
{
    const struct column_map *map = table->layout.source->map;
    return map ? map->rate : 0.0;
}

/* False with the columns that are missing. */
static bool choose_columns(const struct table *table, struct choice *choice,
                           struct measured_remarks *remarks)
{
    const char *file = text_name(table->layout.source->file);
    char list[256];
    bool time = table_has(table, HISTORY_TIME) || rate_of(table) > 0.0;
    choice->column[0] = HISTORY_TIME;
    bool motion = choose_bodies(table, choice);
    layout_list(&table->layout, true, list, sizeof list);
    if (!time)
        remarks_wrong(remarks,
                      "%s: column 'time': missing; there are %s; --rate F says how many readings "
                      "there are a second",
                      file, list);
    if (!motion)
        remarks_wrong(
            remarks,
            "%s: column 'velocity_a', 'displacement_a' or 'acceleration_a' (or one of b): "
            "missing; there are %s",
            file, list);
    return time && motion;
}

/* Whether all readings of the row are there; they are taken as number `count`. */
static bool take_reading(struct table *table, size_t row, const struct choice *choice, size_t count,
                         struct measured_remarks *remarks)
{
    bool whole = true;
    for (int i = 0; i < 3; i++) {
        if (!choice->values[i])
            continue;
        double *value = &choice->values[i][count];
        /* readings are counted where nothing says their times */
        if (i == 0 && !table_has(table, HISTORY_TIME)) {
            *value = (double)row / rate_of(table);
            if (row > 0 && table->numbers[row] != table->numbers[row - 1] + 1)
                remarks_wrong(remarks, "%s:%zu: a line before has no reading: must be nan there",
                              text_name(table->layout.source->file), table->numbers[row]);
            continue;
        }
        whole = table_number(table, row, choice->column[i], value, remarks) && whole;
        whole = whole && !isnan(*value);
    }
    return whole;
}

static void check_order(const struct table *table, size_t row, const struct choice *choice,
                        size_t count, struct measured_remarks *remarks)
{
    const double *time = choice->values[0];
    if (count > 0 && !(time[count] > time[count - 1]))
        remarks_wrong(remarks, "%s:%zu: time: %.10g: must be later than the line before",
                      text_name(table->layout.source->file), table->numbers[row], time[count]);
}

/* Returns the number of readings; names faults. */
static size_t take_readings(struct table *table, const struct choice *choice,
                            struct measured_remarks *remarks)
{
    const char *file = text_name(table->layout.source->file);
    struct left_out left = {0};
    char text[400] = "";
    size_t count = 0;
    for (size_t row = 0; row < table->rows; row++) {
        size_t errors = remarks->errors;
        if (take_reading(table, row, choice, count, remarks))
            check_order(table, row, choice, count++, remarks);
        else if (remarks->errors == errors)
            left_out_add(&left, table->numbers[row]);
    }
    /* a gap hides an event in it */
    left_out_tell(&left, "readings that are not there", text, sizeof text);
    if (10 * left.count > table->rows)
        remarks_wrong(remarks, "%s: %zu of %zu rows: %s: must be at most a tenth", file, left.count,
                      table->rows, text);
    else if (left.count > 0)
        remarks_note(remarks, "%s: %zu of %zu rows left out: %s", file, left.count, table->rows,
                     text);
    if (count < HISTORY_LEAST_READINGS)
        remarks_wrong(remarks, "%s: %zu readings: must be at least %d", file, count,
                      HISTORY_LEAST_READINGS);
    return count;
}

/* Room for the columns; false: out of memory. */
static bool make_room(const struct table *table, struct choice *choice)
{
    bool good = true;
    for (int i = 0; i < 3; i++)
        if (choice->column[i] < HISTORY_COLUMNS) {
            choice->values[i] = calloc(table->rows + 1, sizeof(double));
            good = good && choice->values[i];
        }
    return good;
}

/* Replaces accelerations by their integral from the first on, by trapezoids. */
static void accumulate(const double *time, double *values, size_t count)
{
    double velocity = 0.0, before = values[0];
    values[0] = 0.0;
    for (size_t i = 1; i < count; i++) {
        velocity += 0.5 * (before + values[i]) * (time[i] - time[i - 1]);
        before = values[i];
        values[i] = velocity;
    }
}

/* Velocities of displacements and accelerations; false: out of memory. */
static bool derive(const struct choice *choice, struct history *history)
{
    bool good = true;
    if (choice->column[1] == HISTORY_ACCELERATION_A ||
        choice->column[1] == HISTORY_ACCELERATION_B) {
        history->acceleration_a = calloc(history->count, sizeof(double));
        if (!history->acceleration_a)
            return false;
        memcpy(history->acceleration_a, choice->values[1], history->count * sizeof(double));
        accumulate(history->time, choice->values[1], history->count);
    }
    for (int i = 1; i < 3; i++) {
        size_t column = choice->column[i];
        if (column != HISTORY_DISPLACEMENT_A && column != HISTORY_DISPLACEMENT_B)
            continue;
        history->from_displacement = true;
        /* A's flights are fitted to the readings themselves */
        if (i == 1) {
            history->displacement_a = calloc(history->count, sizeof(double));
            good = history->displacement_a;
            if (good)
                memcpy(history->displacement_a, choice->values[i], history->count * sizeof(double));
        }
        good = good && differentiate(history->time, choice->values[i], history->count);
    }
    return good;
}

static void read_table(struct table *table, struct history *history,
                       struct measured_remarks *remarks)
{
    struct choice choice = {{0}, false, {NULL, NULL, NULL}};
    const struct column_map *map = table->layout.source->map;
    const char *file = text_name(table->layout.source->file);
    size_t errors = remarks->errors;
    if (!choose_columns(table, &choice, remarks))
        return;
    bool memory = make_room(table, &choice);
    *history = (struct history){
        .time = choice.values[0],
        .velocity_a = choice.values[1],
        .velocity_b = choice.values[2],
        .of_b = choice.of_b,
        .gravity = map && choice.column[1] < HISTORY_ACCELERATION_A ? map->gravity : 0.0};
    if (memory)
        history->count = take_readings(table, &choice, remarks);
    if (memory && remarks->errors == errors)
        memory = derive(&choice, history);
    if (!memory)
        remarks_wrong(remarks, "%s: out of memory", file);
}

bool history_read(const char *file, const struct column_map *map, struct history *history,
                  struct measured_remarks *remarks)
{
    const struct table_source source = {file, HISTORY_KINDS, HISTORY_COLUMNS, map};
    struct table table;
    size_t errors = remarks->errors;
    *history = (struct history){0};
    if (!table_read(&source, &table, remarks))
        return false;
    read_table(&table, history, remarks);
    table_free(&table);
    if (remarks->errors == errors)
        return true;
    history_free(history);
    return false;
}

void history_free(struct history *history)
{
    free(history->time);
    free(history->velocity_a);
    free(history->velocity_b);
    free(history->displacement_a);
    free(history->acceleration_a);
    *history = (struct history){0};
}
