/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/guard.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "catalogue/reader.h"

enum { MAX_DEPTH = 8, MAX_VALUES = 3000000 };

struct guard {
    const char *text;
    const char *name;
    struct fault *fault;
    size_t depth, values, documents;
};

static enum percuss_status refuse(const struct guard *guard, size_t line, const char *message)
{
    return fault_set(guard->fault, PERCUSS_BAD_REQUEST, "%s:%zu: %s",
                     reader_short_name(guard->name), line + 1, message);
}

static size_t lines_before(const struct guard *guard, size_t offset)
{
    size_t line = 0;
    for (size_t i = 0; i < offset; i++)
        line += guard->text[i] == '\n';
    return line;
}

/* libyaml compares each tag directive with all before it, within one step of the parser. */
static enum percuss_status check_directives(const struct guard *guard, size_t size)
{
    static const char directive[] = "%TAG";
    const char *found = memmem(guard->text, size, directive, sizeof directive - 1);
    if (!found)
        return PERCUSS_OK;
    return refuse(guard, lines_before(guard, (size_t)(found - guard->text)),
                  "%TAG must not be used: write plain values");
}

/* A bad byte comes with its offset only. */
static enum percuss_status encoding_fault(const struct guard *guard, const yaml_parser_t *parser,
                                          size_t size)
{
    size_t offset = parser->problem_offset;
    size_t line = lines_before(guard, offset < size ? offset : size);
    char message[160];
    snprintf(message, sizeof message, "must be UTF-8 text without control characters: %s",
             parser->problem);
    return refuse(guard, line, message);
}

static enum percuss_status syntax_fault(const struct guard *guard, const yaml_parser_t *parser,
                                        size_t size)
{
    if (parser->error == YAML_MEMORY_ERROR)
        return fault_set(guard->fault, PERCUSS_INTERNAL, "%s: out of memory",
                         reader_short_name(guard->name));
    if (parser->error == YAML_READER_ERROR)
        return encoding_fault(guard, parser, size);
    char message[320];
    int length = snprintf(message, sizeof message, "must be valid YAML: %s",
                          parser->problem ? parser->problem : "unknown error");
    if (parser->context && length < (int)sizeof message)
        snprintf(message + length, sizeof message - (size_t)length, " (%s, from line %zu)",
                 parser->context, parser->context_mark.line + 1);
    return refuse(guard, parser->problem_mark.line, message);
}

static bool has_anchor(const yaml_event_t *event)
{
    return event->type == YAML_ALIAS_EVENT ||
           (event->type == YAML_SCALAR_EVENT && event->data.scalar.anchor) ||
           (event->type == YAML_SEQUENCE_START_EVENT && event->data.sequence_start.anchor) ||
           (event->type == YAML_MAPPING_START_EVENT && event->data.mapping_start.anchor);
}

static bool has_tag(const yaml_event_t *event)
{
    return (event->type == YAML_SCALAR_EVENT && event->data.scalar.tag) ||
           (event->type == YAML_SEQUENCE_START_EVENT && event->data.sequence_start.tag) ||
           (event->type == YAML_MAPPING_START_EVENT && event->data.mapping_start.tag);
}

static void tally(struct guard *guard, const yaml_event_t *event)
{
    switch (event->type) {
    case YAML_DOCUMENT_START_EVENT:
        guard->documents++;
        break;
    case YAML_SEQUENCE_START_EVENT:
    case YAML_MAPPING_START_EVENT:
        guard->depth++;
        guard->values++;
        break;
    case YAML_SCALAR_EVENT:
        guard->values++;
        break;
    case YAML_SEQUENCE_END_EVENT:
    case YAML_MAPPING_END_EVENT:
        guard->depth--;
        break;
    default:
        break;
    }
}

static enum percuss_status inspect(struct guard *guard, const yaml_event_t *event)
{
    size_t line = event->start_mark.line;
    tally(guard, event);
    if (has_anchor(event))
        return refuse(guard, line,
                      "anchors and aliases (&name, *name) must not be used: write the value out");
    if (has_tag(event))
        return refuse(guard, line, "tags (!name) must not be used: write the plain value");
    if (guard->documents > 1)
        return refuse(guard, line, "a second document: must be a single one");
    if (guard->depth > MAX_DEPTH)
        return refuse(guard, line, "nested too deeply: must be at most 8 levels");
    if (guard->values > MAX_VALUES)
        return refuse(guard, line, "too many values: must be at most 3000000");
    return PERCUSS_OK;
}

static enum percuss_status scan(struct guard *guard, yaml_parser_t *parser, size_t size)
{
    enum percuss_status status = PERCUSS_OK;
    bool more = true;
    while (!status && more) {
        yaml_event_t event;
        if (!yaml_parser_parse(parser, &event))
            return syntax_fault(guard, parser, size);
        status = inspect(guard, &event);
        more = event.type != YAML_STREAM_END_EVENT;
        yaml_event_delete(&event);
    }
    if (!status && guard->documents == 0)
        status = refuse(guard, 0, "an empty file: must hold materials and bodies");
    return status;
}

enum percuss_status guard_check(const char *text, size_t size, const char *name,
                                struct fault *fault)
{
    struct guard guard = {.text = text, .name = name, .fault = fault};
    yaml_parser_t parser;
    enum percuss_status status = check_directives(&guard, size);
    if (status)
        return status;
    if (!yaml_parser_initialize(&parser))
        return fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", reader_short_name(name));
    yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, size);
    status = scan(&guard, &parser, size);
    yaml_parser_delete(&parser);
    return status;
}
