/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "divide.h"
#include "survey.h"
#include "text.h"

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
