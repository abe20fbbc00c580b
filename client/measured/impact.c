/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "divide.h"
#include "table.h"
#include "text.h"

/* Where the columns that are numbers go. */
static const size_t OFFSETS[IMPACT_HISTORY] = {
    [IMPACT_SPEED] = offsetof(struct measured_impact, speed),
    [IMPACT_RESTITUTION] = offsetof(struct measured_impact, restitution),
    [IMPACT_IMPULSE] = offsetof(struct measured_impact, impulse),
    [IMPACT_SUB_IMPACTS] = offsetof(struct measured_impact, sub_impacts),
    [IMPACT_FIRST_IMPULSE] = offsetof(struct measured_impact, first_impulse),
    [IMPACT_FIRST_DURATION] = offsetof(struct measured_impact, first_duration),
    [IMPACT_SECOND_START] = offsetof(struct measured_impact, second_start),
    [IMPACT_AT] = offsetof(struct measured_impact, at),
    [IMPACT_V_OUT] = offsetof(struct measured_impact, v_out),
};

/* The numbers that a row may lack. */
enum { LACKS_SPEED, LACKS_OUTCOME, LACKS };
static const char *const REASONS[LACKS] = {"no speed", "no restitution, v_out, impulse or history"};

struct measured_impact measured_impact_unknown(void)
{
    return (struct measured_impact){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
}

struct measured_impact measured_impact_from(const struct history_impacts *history, size_t *next)
{
    struct measured_impact impact = measured_impact_unknown();
    const struct history_sub_impact *list = &history->list[*next];
    size_t count = 1;
    while (*next + count < history->count && !list[count].begins)
        count++;
    *next += count;
    impact.speed = -list[0].approach;
    impact.sub_impacts = (double)count;
    impact.momentum = 0.0;
    for (size_t k = 0; k < count; k++)
        impact.momentum += list[k].jump;
    impact.first_momentum = list[0].jump;
    impact.first_duration = list[0].end - list[0].start;
    for (size_t k = 1; k < count && isnan(impact.second_start); k++)
        if (list[k].jump >= 0.01 * impact.momentum)
            impact.second_start = list[k].start - list[0].start;
    return impact;
}

void measured_set_free(struct measured_set *set)
{
    free(set->impacts);
    free(set->left);
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

/* The file beside the table's. */
static bool path_beside(const char *table, const char *name, char *path, size_t size)
{
    const char *slash = strrchr(table, '/');
    int folder = slash && *name != '/' ? (int)(slash - table) + 1 : 0;
    return (size_t)snprintf(path, size, "%.*s%s", folder, table, name) < size;
}

/* The sub-impacts of the history that a row names. */
static bool find_history(const char *file, const char *name, const struct column_map *map,
                         struct history_impacts *found, struct measured_remarks *remarks)
{
    char path[1024];
    struct history history;
    struct measured_fault reason;
    /* beside the file that names it */
    if (!path_beside(file, name, path, sizeof path))
        return remarks_wrong(remarks, "%s: history '%s': the path is too long", text_name(file),
                             name);
    if (!text_is_file(path, &reason))
        return remarks_wrong(remarks, "%s", reason.text);
    if (!history_read(path, map, &history, remarks))
        return false;
    bool good = history_find(&history, found, &reason);
    history_free(&history);
    return good || remarks_wrong(remarks, "%s: %.400s", path, reason.text);
}

/* Fills the unknown numbers of a row by its history. */
static void fill_unknown(const struct measured_impact *told, struct measured_impact *impact)
{
    double *to = (double *)impact;
    const double *from = (const double *)told;
    for (size_t i = 0; i < sizeof *told / sizeof(double); i++)
        if (isnan(to[i]))
            to[i] = from[i];
}

/* Refuses numbers of one impact in a row of several bounces: only the place is of all. */
static bool check_several(const char *file, size_t line, const struct measured_impact *impact,
                          struct measured_remarks *remarks)
{
    struct measured_impact place = measured_impact_unknown();
    const double *told = (const double *)impact, *none = (const double *)&place;
    place.at = impact->at;
    for (size_t i = 0; i < sizeof *impact / sizeof(double); i++)
        if (isnan(told[i]) != isnan(none[i]))
            return remarks_wrong(remarks,
                                 "%s:%zu: history: holds several impacts: the row may say no more "
                                 "of them than 'at'",
                                 text_name(file), line);
    return true;
}

/* The restitution of Newton where the row does not state it. */
static bool take_v_out(struct table *table, size_t row, struct measured_impact *impact,
                       struct measured_remarks *remarks)
{
    const double most = IMPACT_KINDS[IMPACT_RESTITUTION].high;
    double e = impact->v_out / impact->speed;
    if (!isnan(impact->restitution) || isnan(e))
        return true;
    if (e > most)
        return remarks_wrong(remarks,
                             "%s:%zu: v_out: %g: must be at most %g times the speed (%g m/s)",
                             text_name(table->layout.source->file), table->numbers[row],
                             impact->v_out, most, impact->speed);
    impact->restitution = e;
    table_look(table, row, IMPACT_RESTITUTION, e);
    return true;
}

/* Reads all of the row, so that all that is wrong with it is said: an impact, and the sub-impacts
 * of its history. */
static bool read_row(struct table *table, size_t row, struct measured_impact *impact,
                     struct history_impacts *found, struct measured_remarks *remarks)
{
    const struct table_source *source = table->layout.source;
    const char *history = table_cell(table, row, IMPACT_HISTORY);
    bool good = true;
    *impact = measured_impact_unknown();
    found->count = 0;
    for (size_t k = 0; k < IMPACT_HISTORY; k++)
        good =
            table_number(table, row, k, (double *)((char *)impact + OFFSETS[k]), remarks) && good;
    good = good && take_v_out(table, row, impact, remarks);
    /* the numbers that its history adds */
    if (*history && !cell_is_missing(history))
        good = find_history(source->file, history, source->map, found, remarks) && good;
    for (size_t k = 1; good && k < found->count; k++)
        if (found->list[k].begins)
            return check_several(source->file, table->numbers[row], impact, remarks);
    return good;
}

/* The necessary number that the impact lacks; LACKS: none. */
static int find_lack(const struct measured_impact *impact)
{
    if (isnan(impact->speed))
        return LACKS_SPEED;
    bool outcome =
        !isnan(impact->restitution) || !isnan(impact->impulse) || !isnan(impact->momentum);
    return outcome ? LACKS : LACKS_OUTCOME;
}

/* False with the fault where no row could describe an impact. */
static bool check_columns(const struct table *table, struct measured_remarks *remarks)
{
    char list[256];
    const char *file = text_name(table->layout.source->file);
    bool history = table_has(table, IMPACT_HISTORY);
    layout_list(&table->layout, true, list, sizeof list);
    if (!history && !table_has(table, IMPACT_SPEED))
        return remarks_wrong(remarks,
                             "%s: column 'speed' or 'history': missing; there are %s; --column "
                             "speed=HEADING says which it is",
                             file, list);
    if (!history && !table_has(table, IMPACT_RESTITUTION) && !table_has(table, IMPACT_IMPULSE) &&
        !table_has(table, IMPACT_V_OUT))
        return remarks_wrong(
            remarks,
            "%s: column 'restitution', 'v_out', 'impulse' or 'history': missing; there are "
            "%s; --column restitution=HEADING says which it is",
            file, list);
    return true;
}

/* Counts and names the rows that are left out. */
static void note_left(const struct table *table, const struct measured_set *set,
                      struct measured_remarks *remarks)
{
    struct left_out left[LACKS] = {{0}};
    char text[400] = "";
    for (size_t i = 0; i < set->left_count; i++)
        for (int lack = 0; lack < LACKS; lack++)
            if (set->left[i].reason == REASONS[lack])
                left_out_add(&left[lack], set->left[i].line);
    for (int lack = 0; lack < LACKS; lack++)
        left_out_tell(&left[lack], REASONS[lack], text, sizeof text);
    if (set->left_count > 0)
        remarks_note(remarks, "%s: %zu of %zu rows left out: %s",
                     text_name(table->layout.source->file), set->left_count, table->rows, text);
}

static bool take_rows(struct table *table, struct measured_set *set,
                      struct measured_remarks *remarks)
{
    const char *file = text_name(table->layout.source->file);
    size_t errors = remarks->errors;
    set->left = calloc(table->rows + 1, sizeof *set->left);
    if (!set->left)
        return remarks_wrong(remarks, "%s: out of memory", file);
    /* an impact a row, or several of its history */
    for (size_t row = 0; row < table->rows; row++) {
        struct measured_impact stated;
        struct history_impacts found;
        size_t next = 0;
        if (!read_row(table, row, &stated, &found, remarks))
            continue;
        do {
            struct measured_impact impact = stated;
            if (found.count > 0) {
                struct measured_impact told = measured_impact_from(&found, &next);
                fill_unknown(&told, &impact);
            }
            int lack = find_lack(&impact);
            if (lack < LACKS)
                set->left[set->left_count++] =
                    (struct measured_left){table->numbers[row], REASONS[lack]};
            else if (!measured_append(set, &impact))
                return remarks_wrong(remarks, "%s: out of memory", file);
        } while (next < found.count);
    }
    note_left(table, set, remarks);
    table_note_unusual(table, remarks);
    if (remarks->errors == errors && set->count == 0)
        return remarks_wrong(remarks, "%s: no impacts: at least one line is needed", file);
    return true;
}

bool measured_read(const char *file, const struct column_map *map, struct measured_set *set,
                   struct measured_remarks *remarks)
{
    const struct table_source source = {file, IMPACT_KINDS, IMPACT_COLUMNS, map};
    struct table table;
    size_t errors = remarks->errors;
    *set = (struct measured_set){0};
    if (!table_read(&source, &table, remarks))
        return false;
    if (check_columns(&table, remarks))
        take_rows(&table, set, remarks);
    table_free(&table);
    if (remarks->errors == errors)
        return true;
    measured_set_free(set);
    return false;
}

/* Speeds of the rows that have one; room for a row each. */
static size_t take_speeds(struct table *table, double *speeds, struct measured_remarks *remarks)
{
    const char *file = text_name(table->layout.source->file);
    struct left_out left = {0};
    char text[400] = "";
    size_t count = 0;
    for (size_t row = 0; row < table->rows; row++) {
        size_t errors = remarks->errors;
        table_number(table, row, IMPACT_SPEED, &speeds[count], remarks);
        if (!isnan(speeds[count]))
            count++;
        else if (remarks->errors == errors)
            left_out_add(&left, table->numbers[row]);
    }
    left_out_tell(&left, REASONS[LACKS_SPEED], text, sizeof text);
    if (left.count > 0)
        remarks_note(remarks, "%s: %zu of %zu rows left out: %s", file, left.count, table->rows,
                     text);
    table_note_unusual(table, remarks);
    if (count == 0)
        remarks_wrong(remarks, "%s: no speeds: at least one line is needed", file);
    return count;
}

bool measured_read_speeds(const char *file, const struct column_map *map, double **speeds,
                          size_t *count, struct measured_remarks *remarks)
{
    const struct table_source source = {file, IMPACT_KINDS, IMPACT_SPEED + 1, map};
    struct table table;
    size_t errors = remarks->errors;
    *speeds = NULL;
    if (!table_read(&source, &table, remarks))
        return false;
    *speeds = calloc(table.rows + 1, sizeof **speeds);
    if (*speeds)
        *count = take_speeds(&table, *speeds, remarks);
    else
        remarks_wrong(remarks, "%s: out of memory", text_name(file));
    table_free(&table);
    if (remarks->errors == errors)
        return true;
    free(*speeds);
    *speeds = NULL;
    return false;
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
