/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/json_lists.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* So many digits are a whole number that a double holds, and so are these powers of ten: their
 * product or quotient is the double nearest to the number. */
enum { MOST_DIGITS = 15, MOST_POWER = 22 };
static const double TEN[MOST_POWER + 1] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                           1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                           1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static const char *skip_space(const char *at)
{
    while (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r')
        at++;
    return at;
}

/* Digits, of which there must be one, behind those of a number; `digits`: without zeros before it.
 * Their end, or NULL. */
static const char *read_digits(const char *at, uint64_t *whole, int *digits)
{
    const char *first = at;
    for (; is_digit(*at) && *digits < MOST_DIGITS; at++) {
        *whole = 10 * *whole + (uint64_t)(*at - '0');
        *digits += *whole > 0;
    }
    return at == first || is_digit(*at) ? NULL : at;
}

/* The power of ten that a number ends with, if it does. */
static const char *read_power(const char *at, int *power)
{
    uint64_t stated = 0;
    int digits = MOST_DIGITS - 2;
    if (*at != 'e' && *at != 'E')
        return at;
    bool minus = *++at == '-';
    at = read_digits(at + (*at == '-' || *at == '+'), &stated, &digits);
    *power += minus ? -(int)stated : (int)stated;
    return at;
}

/* Its end; NULL: it is none, or not one of those above. A zero with a sign is left to jansson. */
static const char *read_number(const char *at, double *value)
{
    uint64_t whole = 0;
    int digits = 0, power = 0;
    bool minus = *at == '-';
    at += minus;
    if (at[0] == '0' && is_digit(at[1]))
        return NULL;
    at = read_digits(at, &whole, &digits);
    if (at && *at == '.') {
        const char *point = at;
        at = read_digits(at + 1, &whole, &digits);
        power = at ? (int)(point + 1 - at) : 0;
    }
    at = at ? read_power(at, &power) : NULL;
    if (!at || power < -MOST_POWER || power > MOST_POWER || (minus && whole == 0))
        return NULL;
    double size = power < 0 ? (double)whole / TEN[-power] : (double)whole * TEN[power];
    *value = minus ? -size : size;
    return at;
}

/* From its bracket on; its end, or NULL: it is not plain, or out of memory. */
static const char *read_list(const char *at, struct json_list *list)
{
    size_t room = 0;
    list->size = 0;
    list->values = NULL;
    do {
        if (list->size == room) {
            room = room ? 2 * room : 64;
            double *more = realloc(list->values, room * sizeof *more);
            if (!more)
                break;
            list->values = more;
        }
        at = read_number(skip_space(at + 1), &list->values[list->size++]);
        at = at ? skip_space(at) : NULL;
        if (at && *at == ']')
            return at + 1;
    } while (at && *at == ',');
    free(list->values);
    return NULL;
}

/* The end of a text in quotation marks. */
static const char *skip_string(const char *at, const char *end)
{
    for (at++; at < end && *at != '"'; at++)
        at += *at == '\\' && at + 1 < end;
    return at < end ? at + 1 : end;
}

/* Whether the text so far ends with the name of a member that the lists can have. */
static bool find_name(const char *name, const char *to, struct json_list *list)
{
    if (!name || to[-1] != ':')
        return false;
    list->name = name + 1;
    list->length = (size_t)(to - 2 - list->name);
    return !memchr(list->name, '\\', list->length) && to[-2] == '"';
}

/* An empty list stays in the place of each, with its lines. The size that is left. */
static size_t take_out(char *text, size_t size, struct json_lists *lists)
{
    const char *from = text, *end = text + size, *name = NULL;
    char *to = text;
    size_t depth = 0;
    while (from < end) {
        const char *next = from + 1;
        struct json_list *list = &lists->each[lists->count];
        if (*from == '"') {
            name = to;
            next = skip_string(from, end);
        } else if (*from == '[' && depth == 1 && lists->count < JSON_LISTS_MOST &&
                   find_name(name, to, list)) {
            const char *after = read_list(from, list);
            lists->count += after != NULL;
            *to++ = *from;
            for (; after && next < after - 1; next++)
                if (*next == '\n')
                    *to++ = '\n';
            from = next;
            depth++;
            continue;
        }
        depth += *from == '{' || *from == '[';
        depth -= depth > 0 && (*from == '}' || *from == ']');
        memmove(to, from, (size_t)(next - from));
        to += next - from;
        from = next;
    }
    return (size_t)(to - text);
}

enum percuss_status json_lists_parse(char *text, size_t size, struct json_lists *lists,
                                     json_t **root, struct fault *fault)
{
    lists->count = 0;
    return json_numbers_parse(text, take_out(text, size, lists), root, fault);
}

void json_lists_free(struct json_lists *lists)
{
    for (size_t i = 0; i < lists->count; i++)
        free(lists->each[i].values);
    lists->count = 0;
}

enum percuss_status json_lists_take(struct json_lists *lists, const json_t *root, const char *name,
                                    size_t *count, double **values, struct fault *fault)
{
    for (size_t i = 0; i < lists->count; i++) {
        struct json_list *list = &lists->each[i];
        if (list->length != strlen(name) || memcmp(list->name, name, list->length) != 0)
            continue;
        enum percuss_status status = json_numbers_check_count(list->size, name, count, fault);
        if (!status) {
            *values = list->values;
            list->values = NULL;
        }
        return status;
    }
    return json_numbers_take_array(json_object_get(root, name), name, count, values, fault);
}
