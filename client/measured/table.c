/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A file of columns of numbers: its lines, its layout and its rows. */

#include "table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "divide.h"
#include "text.h"

/* Lines of a text, and one divided into cells while the line itself stays as it is. */

static const char BLANKS[] = " \t";

static size_t count_of(const char *text, const char *wanted)
{
    size_t count = 0;
    for (; *text; text++)
        count += strchr(wanted, *text) != NULL;
    return count;
}

/* Cuts the text into its lines. False: out of memory. Release with free(lines->list). */
static bool lines_find(char *text, struct text_lines *lines)
{
    *lines = (struct text_lines){0, calloc(count_of(text, "\n") + 1, sizeof *lines->list)};
    size_t number = 0;
    for (char *next = text; next && lines->list;) {
        char *line = next, *end = strchr(line, '\n');
        next = end ? end + 1 : NULL;
        if (end)
            *end = '\0';
        number++;
        /* separators alone are nothing either: rows that a spreadsheet left empty */
        if (line[strspn(line, " \t;,\f\v")])
            lines->list[lines->count++] = (struct text_line){line, number};
    }
    return lines->list != NULL;
}

/* Whether it begins with #, and not with a reading that a spreadsheet has not, as "#N/A". */
static bool line_is_comment(const struct text_line *line)
{
    const char *text = line->text + strspn(line->text, BLANKS);
    char cell[16];
    snprintf(cell, sizeof cell, "%.*s", (int)strcspn(text, "\t;,"), text);
    return *text == '#' && !cell_is_missing(cell);
}

static void cells_free(struct cells *cells)
{
    free(cells->text);
    free(cells->list);
    *cells = (struct cells){0};
}

/* Without the mark of a comment. False: out of memory. Release with cells_free. */
static bool cells_divide(const struct text_line *line, char separator, struct cells *cells)
{
    const char *text = line->text;
    const char separators[] = {separator, separator == ' ' ? '\t' : '\0', '\0'};
    if (line_is_comment(line)) {
        text += strspn(text, BLANKS) + 1;
        text += strspn(text, separator == '\t' ? " " : BLANKS);
    }
    size_t room = count_of(text, separators) + 1;
    *cells = (struct cells){.text = strdup(text), .list = calloc(room, sizeof *cells->list)};
    if (!cells->text || !cells->list) {
        cells_free(cells);
        return false;
    }
    cells->filled = divide_line(cells->text, separator, cells->list, room, &cells->all);
    return true;
}

/* The layout of a file of columns: its separator, the line of its headings, each column's kind and
 * unit. */

/* The column's name and place for messages: "speed", "(column 2, 'v [mm/s]')". */
struct layout_place {
    char text[HEADING_SIZE + 40];
};

static void layout_free(struct layout *layout)
{
    cells_free(&layout->titles);
}

static struct layout_place layout_place(const struct layout *layout, size_t kind)
{
    struct layout_place place = {""};
    int column = layout->place[kind];
    const char *title = column >= 0 ? layout->titles.list[column] : "";
    if (column >= 0 && layout->line > 0 && strcmp(title, layout->source->kinds[kind].name) != 0)
        snprintf(place.text, sizeof place.text, "(column %d, '%.*s')", column + 1, HEADING_SIZE,
                 title);
    else if (column >= 0)
        snprintf(place.text, sizeof place.text, "(column %d)", column + 1);
    return place;
}

static bool is_read(const struct layout *layout, size_t column)
{
    for (size_t k = 0; k < layout->source->kind_count; k++)
        if (layout->place[k] == (int)column)
            return true;
    return false;
}

size_t layout_list(const struct layout *layout, bool all, char *text, size_t size)
{
    enum { LISTED = 8, LONGEST = 24 };
    size_t count = 0, length = 0;
    *text = '\0';
    for (size_t i = 0; i < layout->titles.all; i++) {
        if (!*layout->titles.list[i] || (!all && is_read(layout, i)))
            continue;
        if (count++ < LISTED && length < size)
            length += (size_t)snprintf(text + length, size - length, "%s'%.*s'",
                                       count > 1 ? ", " : "", LONGEST, layout->titles.list[i]);
    }
    if (count > LISTED && length < size)
        snprintf(text + length, size - length, " and %zu more", count - LISTED);
    return count;
}

/* The cells of a line of headings, and of units. */

/* The file's name for a column of that kind. */
static const char *heading_wanted(const struct table_source *source, size_t kind)
{
    const struct column_choice *choice = column_map_find(source->map, &source->kinds[kind]);
    return choice ? choice->heading : source->kinds[kind].name;
}

/* The column of each kind that its number was given for, counted from 0; -1: not chosen so. */
static int heading_number(const struct table_source *source, size_t kind)
{
    const struct column_choice *choice = column_map_find(source->map, &source->kinds[kind]);
    char *end = NULL;
    long number = choice ? strtol(choice->heading, &end, 10) : 0;
    return end && !*end && number >= 1 && number <= 100000 ? (int)number - 1 : -1;
}

/* Whether the file calls a column of that kind so: a number is none of its headings. */
static bool is_wanted(const struct table_source *source, size_t kind, const char *name)
{
    return heading_number(source, kind) < 0 && cell_same_name(name, heading_wanted(source, kind));
}

/* The kind that a heading names, or -1. *whole: by all of its text, not by the part before a unit.
 */
static int heading_kind(const struct table_source *source, const char *heading, bool *whole)
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

/* How many columns the cells name. */
static size_t heading_matches(const struct table_source *source, const struct cells *cells)
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

/* By which a number in that unit, as column_number reads it, is in SI units; 0: that of pixels or
 * frames, which nobody said. A history's lengths without a unit are pixels where there is a scale
 * for them; heights are measured by other means. */
static double factor_of(const struct table_source *source, size_t kind, const char *unit)
{
    const struct column_map *map = source->map;
    const double scale = map ? map->scale : 0.0, rate = map ? map->rate : 0.0;
    const bool is_length = source->kinds[kind].quantity == QUANTITY_LENGTH;
    const bool pictured = source->kinds == HISTORY_KINDS && scale > 0.0;
    if (is_length && (!strcmp(unit, COLUMN_PIXEL) || (!*unit && pictured)))
        return scale;
    return strcmp(unit, COLUMN_FRAME) != 0 ? 1.0 : rate > 0.0 ? 1.0 / rate : 0.0;
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
    /* text in brackets need not be a unit where the name is given with it */
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
        /* the text above the rows may be the unit alone */
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

/* Fills layout->place and layout->unit by layout->titles. False: two columns for one, none for one
 * that was asked for, or a unit that is none. */
static bool heading_take(struct layout *layout, struct measured_remarks *remarks)
{
    const struct table_source *source = layout->source;
    bool good = true;
    for (size_t k = 0; k < COLUMN_KINDS; k++)
        layout->place[k] = -1;
    /* the user's units */
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

/* Whether a line below the headings, divided, is one of units: it has no number in any column. */
static bool heading_units_stand(const struct layout *layout, const struct cells *cells)
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

/* Takes them. False: one is no unit, or contradicts the heading. */
static bool heading_take_units(struct layout *layout, const struct cells *cells, size_t line,
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

/* The search for the layout of a file of columns. */

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

/* The line above the first row may have units and headings: it is the line of headings if it has as
 * many cells. */
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

/* The columns that the file may have, with the names that the user gave. */
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

/* Explains the first line as headings, for the message. */
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

/* Whether it is said how long pixels and frames are. */
static bool check_factors(const struct layout *layout, struct measured_remarks *remarks)
{
    bool good = true;
    for (size_t k = 0; k < layout->source->kind_count; k++) {
        const char *unit = layout->unit[k];
        if (layout->place[k] < 0 || factor_of(layout->source, k, unit) > 0.0)
            continue;
        good = remarks_wrong(remarks, "%s:%zu: %s: '%s': %s is needed %s",
                             text_name(layout->source->file), layout->line,
                             layout->source->kinds[k].name, unit,
                             !strcmp(unit, COLUMN_PIXEL) ? "--scale LENGTH, that of a pixel,"
                                                         : "--rate F, frames a second,",
                             layout_place(layout, k).text);
    }
    return good;
}

/* The headings stand in the line that names most columns; a comment, a line that blanks divide and
 * a single word count only where the rows below fit them. Without such a line columns are chosen by
 * their numbers. A line of units may follow. False with all that is wrong. Release with
 * layout_free. */
static bool survey_layout(const struct table_source *source, const struct text_lines *lines,
                          struct layout *layout, struct measured_remarks *remarks)
{
    *layout = (struct layout){.source = source};
    if (!find_headings(layout, lines) && !find_rows(layout, lines))
        return explain(layout, lines, remarks);
    bool good = heading_take(layout, remarks);
    good = take_units(layout, lines, remarks) && good;
    good = good && check_factors(layout, remarks);
    if (!good)
        layout_free(layout);
    return good;
}

static const char *file_of(const struct table *table)
{
    return text_name(table->layout.source->file);
}

/* How many columns a row must have for all that is read of it. */
static size_t least_columns(const struct layout *layout)
{
    size_t least = 1;
    for (size_t k = 0; k < layout->source->kind_count; k++)
        if (layout->place[k] >= (int)least)
            least = (size_t)layout->place[k] + 1;
    return least;
}

/* Divides a line, in place, and keeps the cells of the columns that are read. */
static bool take_row(struct table *table, const struct text_line *line, char **list,
                     struct measured_remarks *remarks)
{
    const struct layout *layout = &table->layout;
    size_t columns = layout->titles.all, kinds = layout->source->kind_count, all;
    size_t filled = divide_line(line->text, layout->separator, list, columns, &all);
    if (filled > columns || all < least_columns(layout))
        return remarks_wrong(remarks, "%s:%zu: %zu values: must be %zu, one a column%s",
                             file_of(table), line->number, all, columns,
                             layout->separator == ',' && filled > columns
                                 ? " (decimal commas need another separator, or quotes)"
                                 : "");
    char **cells = table->cells + table->rows * kinds;
    for (size_t k = 0; k < kinds; k++)
        cells[k] = layout->place[k] >= 0 ? list[layout->place[k]] : strchr(line->text, '\0');
    table->numbers[table->rows++] = line->number;
    return true;
}

static bool take_rows(struct table *table, struct measured_remarks *remarks)
{
    const struct layout *layout = &table->layout;
    const struct text_lines *lines = &table->lines;
    size_t room = lines->count - layout->first + 1;
    char **list = calloc(layout->titles.all, sizeof *list);
    table->cells = calloc(room * layout->source->kind_count, sizeof *table->cells);
    table->numbers = calloc(room, sizeof *table->numbers);
    bool good = list && table->cells && table->numbers;
    if (!good)
        remarks_wrong(remarks, "%s: out of memory", file_of(table));
    for (size_t i = layout->first; good && i < lines->count; i++)
        if (!line_is_comment(&lines->list[i]))
            take_row(table, &lines->list[i], list, remarks);
    free(list);
    return good;
}

/* How the file was understood, where that is not plain. */
static void note_layout(const struct table *table, struct measured_remarks *remarks)
{
    const struct layout *layout = &table->layout;
    char unread[256];
    bool above = false;
    for (size_t i = 0; i < layout->first && table->lines.list[i].number < layout->line; i++)
        above |= !line_is_comment(&table->lines.list[i]);
    if (above)
        remarks_note(remarks, "%s: what stands above the headings in line %zu is not read",
                     file_of(table), layout->line);
    if (layout->line > 0 && layout_list(layout, false, unread, sizeof unread) > 0)
        remarks_note(remarks, "%s: columns that are not read: %s", file_of(table), unread);
}

bool table_read(const struct table_source *source, struct table *table,
                struct measured_remarks *remarks)
{
    struct measured_fault fault;
    *table = (struct table){.text = text_read(source->file, &fault)};
    if (!table->text)
        return remarks_wrong(remarks, "%s", fault.text);
    if (!lines_find(table->text, &table->lines)) {
        table_free(table);
        return remarks_wrong(remarks, "%s: out of memory", text_name(source->file));
    }
    bool good = survey_layout(source, &table->lines, &table->layout, remarks);
    if (good) {
        note_layout(table, remarks);
        good = take_rows(table, remarks);
    }
    if (!good)
        table_free(table);
    return good;
}

void table_free(struct table *table)
{
    layout_free(&table->layout);
    free(table->text);
    free(table->lines.list);
    free(table->cells);
    free(table->numbers);
    *table = (struct table){0};
}

bool table_has(const struct table *table, size_t kind)
{
    return table->layout.place[kind] >= 0;
}

const char *table_cell(const struct table *table, size_t row, size_t kind)
{
    return table->cells[row * table->layout.source->kind_count + kind];
}

/* One file has one decimal mark: a comma in one number and a point in the next may be thousands. */
static bool check_mark(struct table *table, size_t row, size_t kind,
                       struct measured_remarks *remarks)
{
    const char *cell = table_cell(table, row, kind);
    char mark = cell_mark(cell);
    if (mark && !table->mark) {
        table->mark = mark;
        table->mark_line = table->numbers[row];
    }
    if (!mark || mark == table->mark)
        return true;
    return remarks_wrong(
        remarks, "%s:%zu: %s: '%s': must have one decimal mark, '%c' as in line %zu %s",
        file_of(table), table->numbers[row], table->layout.source->kinds[kind].name, cell,
        table->mark, table->mark_line, layout_place(&table->layout, kind).text);
}

void table_look(struct table *table, size_t row, size_t kind, double number)
{
    const struct column_kind *column = &table->layout.source->kinds[kind];
    struct unusual *unusual = &table->unusual[kind];
    if (column->usual > 0.0 && number > column->usual && unusual->count++ == 0) {
        unusual->line = table->numbers[row];
        unusual->value = number;
    }
}

/* Whether it bears no unit of its own. */
static bool is_bare(const char *number)
{
    return !*units_number_end(number);
}

bool table_number(struct table *table, size_t row, size_t kind, double *number,
                  struct measured_remarks *remarks)
{
    const struct column_kind *column = &table->layout.source->kinds[kind];
    const char *cell = table_cell(table, row, kind);
    char text[CELL_SIZE];
    *number = NAN;
    if (!table_has(table, kind) || cell_is_missing(cell))
        return true;
    /* a number, in whichever unit */
    if (!cell_with_point(cell, text) ||
        column_number(column, text, table->layout.unit[kind], number) != UNITS_GOOD) {
        *number = NAN;
        return remarks_wrong(remarks, "%s:%zu: %s: '%s': must be a finite number, empty or nan %s",
                             file_of(table), table->numbers[row], column->name, cell,
                             layout_place(&table->layout, kind).text);
    }
    if (!check_mark(table, row, kind, remarks))
        return false;
    const double factor = factor_of(table->layout.source, kind, table->layout.unit[kind]);
    *number *= is_bare(text) ? factor : 1.0;
    /* that can be */
    if (*number < column->low || *number > column->high ||
        (column->is_count && *number != floor(*number)))
        return remarks_wrong(remarks, "%s:%zu: %s: %.10g: must be %s %s", file_of(table),
                             table->numbers[row], column->name, *number, column->allowed,
                             layout_place(&table->layout, kind).text);
    table_look(table, row, kind, *number);
    return true;
}

void table_note_unusual(const struct table *table, struct measured_remarks *remarks)
{
    for (size_t k = 0; k < table->layout.source->kind_count; k++) {
        const struct column_kind *kind = &table->layout.source->kinds[k];
        const struct unusual *unusual = &table->unusual[k];
        const struct layout_place place = layout_place(&table->layout, k);
        char more[48] = "";
        if (unusual->count > 1)
            snprintf(more, sizeof more, ", as in %zu more rows", unusual->count - 1);
        if (unusual->count > 0)
            remarks_note(remarks, "%s:%zu: %s: %.10g: above %g%s: %s%s%s", file_of(table),
                         unusual->line, kind->name, unusual->value, kind->usual, more,
                         kind->question, *place.text ? " " : "", place.text);
    }
}

void left_out_add(struct left_out *left, size_t line)
{
    if (left->count < LEFT_OUT_NAMED)
        left->lines[left->count] = line;
    left->count++;
}

void left_out_tell(const struct left_out *left, const char *reason, char *text, size_t size)
{
    size_t length = strlen(text);
    if (left->count == 0)
        return;
    length += (size_t)snprintf(text + length, size - length, "%s%s in line%s", length ? "; " : "",
                               reason, left->count > 1 ? "s" : "");
    for (size_t i = 0; i < left->count && i < LEFT_OUT_NAMED && length < size; i++)
        length += (size_t)snprintf(text + length, size - length, "%s%zu",
                                   i == 0                 ? " "
                                   : i + 1 == left->count ? " and "
                                                          : ", ",
                                   left->lines[i]);
    if (left->count > LEFT_OUT_NAMED && length < size)
        snprintf(text + length, size - length, " and %zu more", left->count - LEFT_OUT_NAMED);
}
