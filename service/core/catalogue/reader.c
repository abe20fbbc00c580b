/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/reader.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *reader_short_name(const char *name)
{
    size_t length = strlen(name);
    return length > READER_NAME_BYTES ? name + length - READER_NAME_BYTES : name;
}

size_t reader_enter(struct reader *reader, const char *key)
{
    size_t mark = strlen(reader->path);
    const char *dot = mark > 0 && key[0] != '[' ? "." : "";
    snprintf(reader->path + mark, sizeof reader->path - mark, "%s%s", dot, key);
    return mark;
}

void reader_leave(struct reader *reader, size_t mark)
{
    reader->path[mark] = '\0';
}

enum percuss_status reader_refuse(const struct reader *reader, const yaml_node_t *at,
                                  const char *format, ...)
{
    char message[sizeof reader->fault->text];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    return fault_set(reader->fault, PERCUSS_BAD_REQUEST, "%s:%zu: %s%s%s",
                     reader_short_name(reader->name), at->start_mark.line + 1, reader->path,
                     reader->path[0] ? ": " : "", message);
}

enum percuss_status reader_refuse_value(const struct reader *reader, const yaml_node_t *value,
                                        const char *allowed)
{
    return reader_refuse(reader, value, "%s: must be %s", reader_excerpt(value).text, allowed);
}

static struct excerpt scalar_excerpt(const char *text, size_t length)
{
    struct excerpt excerpt = {{0}};
    const size_t room = sizeof excerpt.text - 1, dots = 3;
    bool cut = length > room;
    size_t shown = cut ? room - dots : length;
    /* never end inside a UTF-8 character */
    while (cut && shown > 0 && ((unsigned char)text[shown] & 0xC0) == 0x80)
        shown--;
    for (size_t i = 0; i < shown; i++) {
        unsigned char c = (unsigned char)text[i];
        excerpt.text[i] = c < 0x20 || c == 0x7F ? '?' : (char)c;
    }
    if (cut)
        memcpy(excerpt.text + shown, "...", dots);
    return excerpt;
}

struct excerpt reader_excerpt(const yaml_node_t *value)
{
    if (value->type == YAML_SEQUENCE_NODE)
        return (struct excerpt){"a list"};
    if (value->type == YAML_MAPPING_NODE)
        return (struct excerpt){"a mapping"};
    if (value->data.scalar.length == 0)
        return (struct excerpt){"nothing"};
    return scalar_excerpt((const char *)value->data.scalar.value, value->data.scalar.length);
}

size_t reader_count(const yaml_node_t *node)
{
    if (node->type == YAML_MAPPING_NODE)
        return (size_t)(node->data.mapping.pairs.top - node->data.mapping.pairs.start);
    if (node->type == YAML_SEQUENCE_NODE)
        return (size_t)(node->data.sequence.items.top - node->data.sequence.items.start);
    return 0;
}

struct entry reader_entry(const struct reader *reader, const yaml_node_t *mapping, size_t i)
{
    yaml_node_pair_t pair = mapping->data.mapping.pairs.start[i];
    return (struct entry){yaml_document_get_node(reader->document, pair.key),
                          yaml_document_get_node(reader->document, pair.value)};
}

const yaml_node_t *reader_element(const struct reader *reader, const yaml_node_t *list, size_t i)
{
    return yaml_document_get_node(reader->document, list->data.sequence.items.start[i]);
}

struct entry reader_find(const struct reader *reader, const yaml_node_t *mapping, const char *key)
{
    for (size_t i = 0; i < reader_count(mapping); i++) {
        struct entry entry = reader_entry(reader, mapping, i);
        if (reader_is(entry.key, key))
            return entry;
    }
    return (struct entry){0};
}

bool reader_is(const yaml_node_t *node, const char *word)
{
    return node->type == YAML_SCALAR_NODE && node->data.scalar.length == strlen(word) &&
           memcmp(node->data.scalar.value, word, strlen(word)) == 0;
}

/* A quoted number is a string to YAML. */
static bool is_plain(const yaml_node_t *node)
{
    return node->type == YAML_SCALAR_NODE && node->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
}

static size_t digits(const char *text)
{
    return strspn(text, "0123456789");
}

bool reader_quantity(const yaml_node_t *node, enum quantity quantity, double *number)
{
    if (!is_plain(node))
        return false;
    const char *text = (const char *)node->data.scalar.value;
    return strlen(text) == node->data.scalar.length &&
           units_read(text, quantity, number) == UNITS_GOOD;
}

bool reader_number(const yaml_node_t *node, double *number)
{
    return reader_quantity(node, QUANTITY_NUMBER, number);
}

enum percuss_status reader_refuse_quantity(const struct reader *reader, const yaml_node_t *value,
                                           enum quantity quantity, const char *allowed)
{
    double number;
    const char *text = is_plain(value) ? (const char *)value->data.scalar.value : "";
    enum units_problem problem = units_read(text, quantity, &number);
    /* a unit on a mere number is refused with the allowed values */
    if (quantity == QUANTITY_NUMBER || (problem != UNITS_UNKNOWN && problem != UNITS_OF_ANOTHER))
        return reader_refuse_value(reader, value, allowed);
    const char *unit = units_number_end(text);
    unit += strspn(unit, " ");
    return reader_refuse(reader, value, "%s: must be a %s, such as %s; %s is no %s",
                         reader_excerpt(value).text, units_name(quantity), units_example(quantity),
                         scalar_excerpt(unit, strlen(unit)).text,
                         problem == UNITS_UNKNOWN ? "unit that is known" : units_name(quantity));
}

bool reader_whole(const yaml_node_t *node, unsigned most, unsigned *number)
{
    if (!is_plain(node))
        return false;
    const char *text = (const char *)node->data.scalar.value;
    size_t length = node->data.scalar.length;
    /* 010 would be eight in YAML 1.1 */
    if (length == 0 || length > 9 || digits(text) != length || text[0] == '0')
        return false;
    unsigned long value = strtoul(text, NULL, 10);
    *number = (unsigned)value;
    return value <= most;
}
