/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "survey.h"

#include <stdio.h>
#include <string.h>

#include "divide.h"
#include "heading.h"
#include "text.h"

/* Headings further down are none. */
static const size_t MOST_PREAMBLE = 1000;

/* The next line that is no comment, from `i` on; lines->count: none. */
static size_t next_row(const struct text_lines *lines, size_t i)
{
    while (i < lines->count && line_is_comment(&lines->list[i]))
        i++;
    return i;
}

/* Whether the cell below a heading is a number, a unit, or nothing; a file's name may be anything.
 */
static bool cell_fits(const struct column_kind *kind, const char *cell)
{
    char unit[UNIT_SIZE];
    column_unit(cell, unit);
    return kind->is_text || cell_is_missing(cell) || cell_begins_with_number(cell) ||
           column_accepts(kind, unit) == UNITS_GOOD;
}

/* Whether nothing divides the cell: a comma may stand in a number. */
static bool is_single(const char *cell)
{
    return !strpbrk(cell, "\t;") && (!strchr(cell, ',') || cell_begins_with_number(cell));
}

/* Whether the first row below line `i` has as many cells, and those of the columns that it names
 * fit: all that is known of a single word is whether the row is divided. */
static bool row_fits(const struct table_source *source, const struct text_lines *lines, size_t i,
                     const struct cells *titles, char separator)
{
    struct cells row;
    size_t below = next_row(lines, i + 1);
    if (below == lines->count)
        return separator != ' ';
    if (!cells_divide(&lines->list[below], separator, &row))
        return false;
    bool fits = row.all == titles->all, whole, single = titles->all == 1;
    for (size_t k = 0; fits && k < titles->all; k++) {
        int kind = heading_kind(source, titles->list[k], &whole);
        fits = single ? is_single(row.list[k])
                      : kind < 0 || cell_fits(&source->kinds[kind], row.list[k]);
    }
    cells_free(&row);
    return fits;
}

/* How much speaks for line `i` as that of the headings; 0: it cannot be. The columns that it names
 * count, and among equals whether the row below fits: a line about the rig may have one of the
 * words, too. */
static size_t weigh(const struct table_source *source, const struct text_lines *lines, size_t i,
                    char separator)
{
    struct cells titles;
    if (!cells_divide(&lines->list[i], separator, &titles))
        return 0;
    bool doubtful = separator == ' ' || titles.all == 1 || line_is_comment(&lines->list[i]);
    size_t named = heading_matches(source, &titles);
    bool fits = named > 0 && row_fits(source, lines, i, &titles, separator);
    cells_free(&titles);
    return doubtful && !fits ? 0 : 2 * named + fits;
}

/* The line with the greatest weight, the first of equals. */
static bool find_headings(struct layout *layout, const struct text_lines *lines)
{
    size_t most = 0, best = 0;
    for (size_t i = 0; i < lines->count && i < MOST_PREAMBLE; i++)
        for (const char *separator = DIVIDE_SEPARATORS; *separator; separator++) {
            size_t weight = weigh(layout->source, lines, i, *separator);
            if (weight <= most)
                continue;
            most = weight;
            best = i;
            layout->separator = *separator;
        }
    if (most == 0 || !cells_divide(&lines->list[best], layout->separator, &layout->titles))
        return false;
    layout->line = lines->list[best].number;
    layout->first = best + 1;
    return true;
}

/* Whether all columns that were chosen by number are there and begin with numbers. */
static bool has_numbers(const struct table_source *source, const struct cells *cells)
{
    bool any = false;
    for (size_t k = 0; k < source->kind_count; k++) {
        int number = heading_number(source, k);
        if (number < 0)
            continue;
        any = true;
        if ((size_t)number >= cells->all ||
            (!source->kinds[k].is_text && !cell_begins_with_number(cells->list[number])))
            return false;
    }
    return any;
}

/* What stands above the first row may be units and headings: taken for the line of headings where
 * it has as many cells. */
static bool take_above(struct layout *layout, const struct text_lines *lines, size_t row)
{
    size_t columns = layout->titles.all, top = row;
    for (size_t i = row; i-- > 0 && i + 2 >= row && !line_is_comment(&lines->list[i]);) {
        struct cells cells;
        if (!cells_divide(&lines->list[i], layout->separator, &cells))
            return false;
        bool same = cells.all == columns;
        cells_free(&cells);
        if (!same)
            break;
        top = i;
    }
    layout->first = row;
    layout->line = 0;
    if (top == row)
        return true;
    cells_free(&layout->titles);
    layout->first = top + 1;
    layout->line = lines->list[top].number;
    return cells_divide(&lines->list[top], layout->separator, &layout->titles);
}

/* Without headings: the first line with numbers where they were said to be. */
static bool find_rows(struct layout *layout, const struct text_lines *lines)
{
    for (size_t i = 0; i < lines->count && i < MOST_PREAMBLE; i++)
        for (const char *separator = DIVIDE_SEPARATORS; *separator; separator++) {
            if (line_is_comment(&lines->list[i]) ||
                !cells_divide(&lines->list[i], *separator, &layout->titles))
                continue;
            layout->separator = *separator;
            if (has_numbers(layout->source, &layout->titles))
                return take_above(layout, lines, i);
            cells_free(&layout->titles);
        }
    return false;
}

/* The columns that the file may have, by what it is said to call them. */
static void list_known(const struct table_source *source, char *text, size_t size)
{
    size_t length = 0;
    for (size_t k = 0; k < source->kind_count && length < size; k++) {
        const char *name = source->kinds[k].name, *heading = heading_wanted(source, k);
        bool renamed = strcmp(name, heading) != 0;
        length += (size_t)snprintf(text + length, size - length, "%s%s%s%.*s%s", k ? ", " : "",
                                   name, renamed ? " (as '" : "", renamed ? 40 : 0, heading,
                                   renamed ? "')" : "");
    }
}

/* What the first line would be as headings: for the message. */
static bool explain(struct layout *layout, const struct text_lines *lines,
                    struct measured_remarks *remarks)
{
    char known[256] = "", found[160], cure[80] = "HEADING says which is which";
    size_t first = next_row(lines, 0);
    const char *file = text_name(layout->source->file), *separator = DIVIDE_SEPARATORS;
    if (first == lines->count)
        return remarks_wrong(remarks, "%s: empty: a line of column names is needed", file);
    /* by the first separator that is in it */
    while (*separator != ' ' && !strchr(lines->list[first].text, *separator))
        separator++;
    if (!cells_divide(&lines->list[first], *separator, &layout->titles))
        return remarks_wrong(remarks, "%s: out of memory", file);
    layout_list(layout, true, found, sizeof found);
    /* rows without headings are told by their places */
    size_t numbers = 0;
    while (numbers < layout->titles.all && (cell_is_missing(layout->titles.list[numbers]) ||
                                            cell_begins_with_number(layout->titles.list[numbers])))
        numbers++;
    const struct column_kind *kinds = layout->source->kinds;
    bool bare = numbers == layout->titles.all;
    if (bare)
        snprintf(cure, sizeof cure, "NUMBER says which is which: --column %s=1 --column %s=2",
                 kinds[0].name, kinds[1].name);
    layout_free(layout);
    list_known(layout->source, known, sizeof known);
    return remarks_wrong(remarks,
                         "%s:%zu: column '%s': missing, and all that may be there (%s): there are "
                         "%s%s; --column NAME=%s",
                         file, lines->list[first].number, kinds[0].name, known, found,
                         bare ? ", which are no headings" : "", cure);
}

/* The line of units, if there is one. */
static bool take_units(struct layout *layout, const struct text_lines *lines,
                       struct measured_remarks *remarks)
{
    struct cells cells;
    size_t row = next_row(lines, layout->first);
    bool good = true;
    if (layout->line == 0 || row == lines->count)
        return true;
    if (!cells_divide(&lines->list[row], layout->separator, &cells))
        return remarks_wrong(remarks, "%s: out of memory", text_name(layout->source->file));
    if (heading_units_stand(layout, &cells)) {
        good = heading_take_units(layout, &cells, lines->list[row].number, remarks);
        layout->first = row + 1;
    }
    cells_free(&cells);
    return good;
}

bool survey_layout(const struct table_source *source, const struct text_lines *lines,
                   struct layout *layout, struct measured_remarks *remarks)
{
    *layout = (struct layout){.source = source};
    if (!find_headings(layout, lines) && !find_rows(layout, lines))
        return explain(layout, lines, remarks);
    bool good = heading_take(layout, remarks);
    good = take_units(layout, lines, remarks) && good;
    if (!good)
        layout_free(layout);
    return good;
}
