/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "divide.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

#include "base/units.h"

const char DIVIDE_SEPARATORS[] = "\t;, ";

/* Blanks, and tabs where they separate nothing. */
static bool is_blank(char c, char separator)
{
    return c == ' ' || (c == '\t' && separator != '\t');
}

static bool ends_cell(char c, char separator)
{
    return !c || c == separator || (separator == ' ' && c == '\t');
}

/* The quote that closes the one that begins here and the cell; NULL: none does, and the one that
 * begins is text. */
static char *closing_quote(char *at, char separator)
{
    for (at++; *at && (*at != '"' || at[1] == '"'); at++)
        at += *at == '"';
    if (!*at)
        return NULL;
    const char *behind = at + 1;
    while (is_blank(*behind, separator) && !ends_cell(*behind, separator))
        behind++;
    return ends_cell(*behind, separator) ? at : NULL;
}

/* Two quotes become one, from here to `end`. */
static void undouble(char *at, const char *end)
{
    char *to = at;
    while (at < end) {
        at += *at == '"';
        *to++ = *at++;
    }
    *to = '\0';
}

/* One cell; returns its end, a separator or the line's end, which the caller overwrites. */
static char *take_cell(char *at, char separator, char **cell)
{
    while (is_blank(*at, separator))
        at++;
    char *close = *at == '"' ? closing_quote(at, separator) : NULL;
    char *end = close ? close + 1 : at;
    *cell = close ? at + 1 : at;
    while (!ends_cell(*end, separator))
        end++;
    if (close)
        undouble(at + 1, close);
    return end;
}

static void trim_end(char *cell)
{
    char *end = cell + strlen(cell);
    while (end > cell && isspace((unsigned char)end[-1]))
        *--end = '\0';
}

size_t divide_line(char *line, char separator, char **cells, size_t room, size_t *all)
{
    size_t count = 0, filled = 0;
    for (char *next = line; next; count++) {
        char *cell, *end = take_cell(next, separator, &cell);
        next = *end ? end + 1 : NULL;
        *end = '\0'; /* behind the text of a quoted one */
        trim_end(cell);
        /* blanks at the end are no separator */
        if (separator == ' ' && !*cell && !next && count > 0)
            break;
        if (count < room)
            cells[count] = cell;
        if (*cell)
            filled = count + 1;
    }
    *all = count;
    return filled;
}

bool cell_is_missing(const char *cell)
{
    static const char *const none[] = {"",        "-",      "--",      "\xE2\x80\x93", "?",
                                       ".",       "nan",    "na",      "n/a",          "n.a.",
                                       "null",    "none",   "#n/a",    "#nv",          "#n/v",
                                       "#value!", "#wert!", "#div/0!", "#num!",        "#zahl!"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++)
        if (!strcasecmp(cell, none[i]))
            return true;
    return false;
}

char cell_mark(const char *cell)
{
    size_t at = strcspn(cell, ".,");
    /* within the number, not in a unit behind it */
    return strspn(cell, "+-0123456789.,") > at ? cell[at] : '\0';
}

bool cell_with_point(const char *cell, char number[CELL_SIZE])
{
    size_t length = strlen(cell);
    if (length >= CELL_SIZE)
        return false;
    memcpy(number, cell, length + 1);
    char *comma = strchr(number, ',');
    if (comma && strchr(number, '.'))
        return false;
    if (comma)
        *comma = '.';
    return true;
}

bool cell_begins_with_number(const char *cell)
{
    char number[CELL_SIZE];
    return cell_with_point(cell, number) && units_number_end(number) > number;
}

/* The next letter or digit that counts, in lower case; 0 at the end. */
static int next_letter(const char **at)
{
    while (**at && strchr(" ._-", **at))
        ++*at;
    return **at ? tolower((unsigned char)*(*at)++) : 0;
}

bool cell_same_name(const char *one, const char *other)
{
    int letter;
    do {
        letter = next_letter(&one);
        if (letter != next_letter(&other))
            return false;
    } while (letter);
    return true;
}
