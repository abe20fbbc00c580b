/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "table.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Larger files are a mistake. */
static const long MOST_BYTES = 1L << 30;

bool measured_fail(struct measured_fault *fault, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(fault->text, sizeof fault->text, format, arguments);
    va_end(arguments);
    /* what the file holds goes to a terminal */
    for (char *c = fault->text; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 0x7f)
            *c = '?';
    return false;
}

static char *load(const char *file, struct measured_fault *fault)
{
    FILE *in = fopen(file, "rb");
    char *text = NULL;
    long size = -1;
    /* as much as it says that it holds */
    if (in && fseek(in, 0, SEEK_END) == 0)
        size = ftell(in);
    if (size >= 0 && size <= MOST_BYTES && fseek(in, 0, SEEK_SET) == 0)
        text = malloc((size_t)size + 1);
    if (text && fread(text, 1, (size_t)size, in) == (size_t)size) {
        text[size] = '\0';
    } else {
        measured_fail(fault, "%s: %s", file, errno ? strerror(errno) : "cannot be read");
        free(text);
        text = NULL;
    }
    if (in)
        fclose(in);
    return text;
}

/* Cuts white space off both ends. */
static char *trim(char *text)
{
    while (isspace((unsigned char)*text))
        text++;
    char *end = text + strlen(text);
    while (end > text && isspace((unsigned char)end[-1]))
        *--end = '\0';
    return text;
}

/* Splits a line in place; returns the number of cells, which may exceed `room`. */
static size_t split(char *line, char **cells, size_t room)
{
    size_t count = 0;
    for (char *next = line; next; count++) {
        char *cell = next;
        next = strchr(cell, ',');
        if (next)
            *next++ = '\0';
        if (count < room)
            cells[count] = trim(cell);
    }
    return count;
}

/* The next line with something in it; *number counts all lines. NULL: no more. */
static char *next_line(char **rest, size_t *number)
{
    while (*rest) {
        char *line = *rest, *end = strchr(line, '\n');
        *rest = end ? end + 1 : NULL;
        if (end)
            *end = '\0';
        ++*number;
        line = trim(line);
        if (*line && *line != '#')
            return line;
    }
    return NULL;
}

static size_t count_char(const char *text, char wanted)
{
    size_t count = 0;
    for (; *text; text++)
        count += *text == wanted;
    return count;
}

static bool take_rows(struct table *table, char *rest, size_t number, struct measured_fault *fault)
{
    for (char *line; (line = next_line(&rest, &number)); table->rows++) {
        char **cells = table->cells + table->rows * table->columns;
        size_t count = split(line, cells, table->columns);
        table->lines[table->rows] = number;
        if (count != table->columns)
            return measured_fail(fault, "%s:%zu: %zu values: must be %zu, one a column",
                                 table->file, number, count, table->columns);
    }
    return true;
}

bool table_read(const char *file, struct table *table, struct measured_fault *fault)
{
    errno = 0;
    *table = (struct table){.file = file, .text = load(file, fault)};
    if (!table->text)
        return false;
    /* names stand in the first line with something in it */
    size_t number = 0, lines = count_char(table->text, '\n') + 1;
    char *rest = table->text, *head = next_line(&rest, &number);
    if (!head) {
        table_free(table);
        return measured_fail(fault, "%s: empty: a line of column names is needed", file);
    }
    /* room for as many rows as there are lines */
    table->columns = count_char(head, ',') + 1;
    table->names = calloc(table->columns, sizeof *table->names);
    table->cells = calloc(lines * table->columns, sizeof *table->cells);
    table->lines = calloc(lines, sizeof *table->lines);
    bool good = table->names && table->cells && table->lines;
    if (!good)
        measured_fail(fault, "%s: out of memory", file);
    if (good) {
        split(head, table->names, table->columns);
        good = take_rows(table, rest, number, fault);
    }
    if (!good)
        table_free(table);
    return good;
}

void table_free(struct table *table)
{
    free(table->text);
    free(table->names);
    free(table->cells);
    free(table->lines);
    *table = (struct table){0};
}

int table_column(const struct table *table, const char *name)
{
    for (size_t i = 0; i < table->columns; i++)
        if (!strcmp(table->names[i], name))
            return (int)i;
    return -1;
}

const char *table_cell(const struct table *table, size_t row, int column)
{
    return table->cells[row * table->columns + (size_t)column];
}

bool table_number(const struct table *table, size_t row, int column, double *number,
                  struct measured_fault *fault)
{
    *number = NAN;
    if (column < 0)
        return true;
    const char *text = table_cell(table, row, column);
    char *end;
    if (!*text || !strcmp(text, "nan"))
        return true;
    *number = strtod(text, &end);
    if (*end || !isfinite(*number))
        return measured_fail(fault, "%s:%zu: %s: '%s': must be a finite number, empty or nan",
                             table->file, table->lines[row], table->names[column], text);
    return true;
}
