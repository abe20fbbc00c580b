/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "heading.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "divide.h"
#include "text.h"

const char *heading_wanted(const struct table_source *source, size_t kind)
{
    const struct column_choice *choice = column_map_find(source->map, &source->kinds[kind]);
    return choice ? choice->heading : source->kinds[kind].name;
}

/* Whether the file calls a column of that kind so: a number is none of its headings. */
static bool is_wanted(const struct table_source *source, size_t kind, const char *name)
{
    return heading_number(source, kind) < 0 && cell_same_name(name, heading_wanted(source, kind));
}

int heading_kind(const struct table_source *source, const char *heading, bool *whole)
{
    char name[HEADING_SIZE], unit[UNIT_SIZE];
    *whole = true;
    for (size_t k = 0; k < source->kind_count; k++)
        if (is_wanted(source, k, heading))
            return (int)k;
    *whole = false;
    column_heading(heading, name, unit);
    for (size_t k = 0; k < source->kind_count; k++)
        if (is_wanted(source, k, name))
            return (int)k;
    return -1;
}

size_t heading_matches(const struct table_source *source, const struct cells *cells)
{
    bool named[COLUMN_KINDS] = {false}, whole;
    size_t matches = 0;
    for (size_t i = 0; i < cells->all; i++) {
        int kind = heading_kind(source, cells->list[i], &whole);
        matches += kind >= 0 && !named[kind];
        if (kind >= 0)
            named[kind] = true;
    }
    return matches;
}

int heading_number(const struct table_source *source, size_t kind)
{
    const struct column_choice *choice = column_map_find(source->map, &source->kinds[kind]);
    char *end = NULL;
    long number = choice ? strtol(choice->heading, &end, 10) : 0;
    return end && !*end && number >= 1 && number <= 100000 ? (int)number - 1 : -1;
}

/* Sets the column's unit. False: it is none, or another one than was said before. */
static bool set_unit(struct layout *layout, size_t kind, const char *unit, size_t line,
                     struct measured_remarks *remarks)
{
    const struct table_source *source = layout->source;
    const char *file = text_name(source->file), *name = source->kinds[kind].name;
    if (!*unit)
        return true;
    if (column_accepts(&source->kinds[kind], unit) != UNITS_GOOD)
        return remarks_wrong(remarks, "%s:%zu: %s: '%s': must be %s %s", file, line, name, unit,
                             column_allowed_unit(&source->kinds[kind]).text,
                             layout_place(layout, kind).text);
    if (*layout->unit[kind] && strcmp(layout->unit[kind], unit) != 0)
        return remarks_wrong(remarks, "%s:%zu: %s: '%s' here and '%s' elsewhere: must be one unit",
                             file, line, name, unit, layout->unit[kind]);
    snprintf(layout->unit[kind], UNIT_SIZE, "%s", unit);
    return true;
}

/* One heading. */
static bool take_title(struct layout *layout, size_t column, struct measured_remarks *remarks)
{
    const struct table_source *source = layout->source;
    char name[HEADING_SIZE], unit[UNIT_SIZE];
    bool whole;
    int kind = heading_kind(source, layout->titles.list[column], &whole);
    if (kind < 0)
        return true;
    if (layout->place[kind] >= 0)
        return remarks_wrong(remarks,
                             "%s:%zu: columns %d and %zu are both '%s': --column %s=NUMBER says "
                             "which",
                             text_name(source->file), layout->line, layout->place[kind] + 1,
                             column + 1, heading_wanted(source, (size_t)kind),
                             source->kinds[kind].name);
    layout->place[kind] = (int)column;
    /* what stands in brackets need not be a unit where the name is given with it */
    column_heading(layout->titles.list[column], name, unit);
    if (source->kinds[kind].is_text ||
        (whole && column_accepts(&source->kinds[kind], unit) == UNITS_UNKNOWN))
        return true;
    return set_unit(layout, (size_t)kind, unit, layout->line, remarks);
}

/* A column that was chosen by its number. */
static bool take_number(struct layout *layout, size_t kind, struct measured_remarks *remarks)
{
    const struct table_source *source = layout->source;
    int number = heading_number(source, kind);
    char name[HEADING_SIZE], unit[UNIT_SIZE], list[256];
    if (number >= 0 && (size_t)number < layout->titles.all) {
        layout->place[kind] = number;
        if (layout->line == 0)
            return true;
        /* what stands above the rows may be nothing but the unit */
        column_unit(layout->titles.list[number], unit);
        if (column_accepts(&source->kinds[kind], unit) != UNITS_GOOD)
            column_heading(layout->titles.list[number], name, unit);
        return column_accepts(&source->kinds[kind], unit) == UNITS_UNKNOWN ||
               source->kinds[kind].is_text || set_unit(layout, kind, unit, layout->line, remarks);
    }
    layout_list(layout, true, list, sizeof list);
    return remarks_wrong(remarks, "%s:%zu: --column %s=%s: no such column: there are %s",
                         text_name(source->file), layout->line, source->kinds[kind].name,
                         heading_wanted(source, kind), list);
}

bool heading_take(struct layout *layout, struct measured_remarks *remarks)
{
    const struct table_source *source = layout->source;
    bool good = true;
    for (size_t k = 0; k < COLUMN_KINDS; k++)
        layout->place[k] = -1;
    /* what was said of them */
    for (size_t k = 0; k < source->kind_count; k++) {
        const struct column_choice *choice = column_map_find(source->map, &source->kinds[k]);
        if (choice)
            snprintf(layout->unit[k], UNIT_SIZE, "%s", choice->unit);
    }
    /* by name, then by number */
    for (size_t i = 0; i < layout->titles.all && layout->line > 0; i++)
        good = take_title(layout, i, remarks) && good;
    for (size_t k = 0; k < source->kind_count; k++)
        if (layout->place[k] < 0 && column_map_find(source->map, &source->kinds[k]))
            good = take_number(layout, k, remarks) && good;
    return good;
}

/* The cell of that kind, NULL: none, or it is no number's. */
static const char *number_cell(const struct layout *layout, const struct cells *cells, size_t kind)
{
    int place = layout->place[kind];
    bool there = kind < layout->source->kind_count && place >= 0 && (size_t)place < cells->all;
    return there && !layout->source->kinds[kind].is_text ? cells->list[place] : NULL;
}

bool heading_units_stand(const struct layout *layout, const struct cells *cells)
{
    bool something = false;
    for (size_t k = 0; k < layout->source->kind_count; k++) {
        const char *cell = number_cell(layout, cells, k);
        bool one = cell && !strcmp(cell, "1");
        if (cell && cell_begins_with_number(cell) && !one)
            return false;
        something |= cell && !one && !cell_is_missing(cell);
    }
    return something;
}

bool heading_take_units(struct layout *layout, const struct cells *cells, size_t line,
                        struct measured_remarks *remarks)
{
    bool good = true;
    for (size_t k = 0; k < layout->source->kind_count; k++) {
        const char *cell = number_cell(layout, cells, k);
        char unit[UNIT_SIZE];
        if (!cell || cell_is_missing(cell))
            continue;
        column_unit(cell, unit);
        good = set_unit(layout, k, unit, line, remarks) && good;
    }
    return good;
}
