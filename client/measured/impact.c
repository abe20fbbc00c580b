/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The columns that are numbers, and where they go. */
static const struct {
    const char *name;
    size_t offset;
    double low, high;
    const char *allowed;
} columns[] = {
    {"speed", offsetof(struct measured_impact, speed), 1e-9, 1e6, "m/s > 0"},
    {"restitution", offsetof(struct measured_impact, restitution), -10.0, 10.0,
     "a number of -10 to 10"},
    {"impulse", offsetof(struct measured_impact, impulse), 0.0, 1e12, "N s >= 0"},
    {"sub_impacts", offsetof(struct measured_impact, sub_impacts), 0.0, 1e6, "a count >= 0"},
    {"first_impulse", offsetof(struct measured_impact, first_impulse), 0.0, 1e12, "N s >= 0"},
    {"first_duration", offsetof(struct measured_impact, first_duration), 0.0, 1e6, "s >= 0"},
    {"second_start", offsetof(struct measured_impact, second_start), 0.0, 1e6, "s >= 0"},
    {"at", offsetof(struct measured_impact, at), 0.0, 1.0, "a fraction 0..1"},
};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

struct measured_impact measured_impact_unknown(void)
{
    return (struct measured_impact){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
}

struct measured_impact measured_impact_from(const struct history_impacts *history)
{
    struct measured_impact impact = measured_impact_unknown();
    const struct history_sub_impact *list = history->list;
    impact.speed = -history->before;
    impact.sub_impacts = (double)history->count;
    impact.momentum = 0.0;
    for (size_t k = 0; k < history->count; k++)
        impact.momentum += list[k].jump;
    impact.first_momentum = list[0].jump;
    impact.first_duration = list[0].end - list[0].start;
    for (size_t k = 1; k < history->count && isnan(impact.second_start); k++)
        if (list[k].jump >= 0.01 * impact.momentum)
            impact.second_start = list[k].start - list[0].start;
    return impact;
}

void measured_set_free(struct measured_set *set)
{
    free(set->impacts);
    *set = (struct measured_set){0};
}

bool measured_append(struct measured_set *set, const struct measured_impact *impact)
{
    if (set->count == set->room) {
        size_t room = set->room ? 2 * set->room : 64;
        struct measured_impact *impacts = realloc(set->impacts, room * sizeof *impacts);
        if (!impacts)
            return false;
        set->impacts = impacts;
        set->room = room;
    }
    set->impacts[set->count++] = *impact;
    return true;
}

static bool check_names(const struct table *table, struct measured_fault *fault)
{
    for (size_t k = 0; k < table->columns; k++) {
        size_t i = 0;
        while (i < COLUMNS && strcmp(table->names[k], columns[i].name))
            i++;
        if (i == COLUMNS && strcmp(table->names[k], "history"))
            return measured_fail(fault,
                                 "%s: column '%s': unknown; allowed are speed, restitution, "
                                 "impulse, sub_impacts, first_impulse, first_duration, "
                                 "second_start, at, history",
                                 table->file, table->names[k]);
    }
    return true;
}

/* The file beside the table's. */
static bool path_beside(const char *table, const char *name, char *path, size_t size)
{
    const char *slash = strrchr(table, '/');
    int folder = slash && *name != '/' ? (int)(slash - table) + 1 : 0;
    return (size_t)snprintf(path, size, "%.*s%s", folder, table, name) < size;
}

/* What a history says stands where the row says nothing. */
static bool add_history(const struct table *table, const char *name, struct measured_impact *impact,
                        struct measured_fault *fault)
{
    char path[1024];
    struct history history;
    struct history_impacts found;
    /* beside the file that names it */
    if (!path_beside(table->file, name, path, sizeof path))
        return measured_fail(fault, "%s: history '%s': the path is too long", table->file, name);
    if (!history_read(path, &history, fault))
        return false;
    bool good = history_find(&history, &found, fault);
    history_free(&history);
    if (!good) {
        struct measured_fault reason = *fault;
        return measured_fail(fault, "%s: %.400s", path, reason.text);
    }
    struct measured_impact told = measured_impact_from(&found);
    double *to = (double *)impact;
    const double *from = (const double *)&told;
    for (size_t i = 0; i < sizeof told / sizeof(double); i++)
        if (isnan(to[i]))
            to[i] = from[i];
    return true;
}

static bool read_row(const struct table *table, size_t row, struct measured_impact *impact,
                     struct measured_fault *fault)
{
    *impact = measured_impact_unknown();
    for (size_t i = 0; i < COLUMNS; i++) {
        double *value = (double *)((char *)impact + columns[i].offset);
        if (!table_number(table, row, table_column(table, columns[i].name), value, fault))
            return false;
        if (*value < columns[i].low || *value > columns[i].high)
            return measured_fail(fault, "%s:%zu: %s: %g: must be %s", table->file,
                                 table->lines[row], columns[i].name, *value, columns[i].allowed);
    }
    /* what its history adds */
    int history = table_column(table, "history");
    bool has_history = history >= 0 && *table_cell(table, row, history);
    if (has_history && !add_history(table, table_cell(table, row, history), impact, fault))
        return false;
    /* the least that an impact must tell */
    if (isnan(impact->speed))
        return measured_fail(fault, "%s:%zu: speed: unknown: must be given, here or by a history",
                             table->file, table->lines[row]);
    if (isnan(impact->restitution) && isnan(impact->impulse) && isnan(impact->momentum))
        return measured_fail(fault,
                             "%s:%zu: restitution: unknown: must be given, or an impulse or a "
                             "history",
                             table->file, table->lines[row]);
    return true;
}

bool measured_read(const char *file, struct measured_set *set, struct measured_fault *fault)
{
    struct table table;
    *set = (struct measured_set){0};
    if (!table_read(file, &table, fault))
        return false;
    /* an impact a row */
    bool good = check_names(&table, fault);
    for (size_t row = 0; good && row < table.rows; row++) {
        struct measured_impact impact;
        good = read_row(&table, row, &impact, fault);
        if (good && !measured_append(set, &impact))
            good = measured_fail(fault, "%s: out of memory", file);
    }
    if (good && set->count == 0)
        good = measured_fail(fault, "%s: no impacts: at least one line is needed", file);
    table_free(&table);
    if (!good)
        measured_set_free(set);
    return good;
}

void measured_complete(struct measured_impact *impact, double mass_a, double w)
{
    if (isnan(impact->impulse))
        impact->impulse = isnan(impact->restitution)
                              ? mass_a * impact->momentum
                              : (1.0 + impact->restitution) * impact->speed / w;
    if (isnan(impact->restitution))
        impact->restitution = impact->impulse * w / impact->speed - 1.0;
    if (isnan(impact->first_impulse))
        impact->first_impulse =
            impact->sub_impacts == 1.0 ? impact->impulse : mass_a * impact->first_momentum;
}
