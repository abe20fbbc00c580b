/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "respond/settings.h"

#include <errno.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "catalogue/reader.h"
#include "ensemble/spec.h"

enum kind {
    KIND_WHOLE,
    KIND_NUMBER,
    KIND_SWITCH,
    KIND_PATH,
    KIND_PARTITION,
    KIND_LEVEL,
    KIND_FORMAT
};

/* One key; a dot separates a section from its keys. */
struct setting {
    const char *path;
    enum kind kind;
    size_t offset;
    double low, high;
};

#define AT(member) offsetof(struct settings, member)

static const struct setting table[] = {
    {"catalogue", KIND_PATH, AT(catalogue), 0, 0},
    {"domain", KIND_WHOLE, AT(domain), 0, SETTINGS_MAX_DOMAIN},
    {"partition", KIND_PARTITION, AT(partition), 0, 0},
    {"workers", KIND_WHOLE, AT(workers), 1, 256},
    {"queue_capacity", KIND_WHOLE, AT(queue_capacity), 1, 65536},
    {"inline_solves", KIND_SWITCH, AT(inline_solves), 0, 0},
    {"limits.seconds", KIND_NUMBER, AT(limit_seconds), 0.001, 1e9},
    {"limits.samples", KIND_WHOLE, AT(limit_samples), 1, ENSEMBLE_MAX_SAMPLES},
    {"limits.clients", KIND_WHOLE, AT(limit_clients), 1, 65536},
    {"tokens.count", KIND_WHOLE, AT(token_count), 1, 10000000},
    {"tokens.megabytes", KIND_WHOLE, AT(token_megabytes), 1, 1048576},
    {"tokens.minutes", KIND_NUMBER, AT(token_minutes), 0.001, 100000},
    {"replies.per_client", KIND_WHOLE, AT(replies_per_client), 1, 65536},
    {"replies.megabytes", KIND_WHOLE, AT(reply_megabytes), 1, 1048576},
    {"store", KIND_PATH, AT(store), 0, 0},
    {"backup", KIND_PATH, AT(backup), 0, 0},
    {"stored_replies", KIND_WHOLE, AT(stored_replies), 1, 10000000},
    {"standby", KIND_PATH, AT(standby), 0, 0},
    {"session_minutes", KIND_NUMBER, AT(session_minutes), 0.001, 100000},
    {"drain_seconds", KIND_NUMBER, AT(drain_seconds), 0, 86400},
    {"tables", KIND_PATH, AT(tables), 0, 0},
    {"bodies", KIND_PATH, AT(bodies), 0, 0},
    {"bodies_days", KIND_NUMBER, AT(bodies_days), 0.001, 100000},
    {"security", KIND_PATH, AT(security), 0, 0},
    {"metrics", KIND_PATH, AT(metrics), 0, 0},
    {"log_level", KIND_LEVEL, AT(log_level), 0, 0},
    {"log_format", KIND_FORMAT, AT(log_format), 0, 0},
};
enum { SETTING_COUNT = sizeof table / sizeof *table };

struct settings settings_default(void)
{
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    return (struct settings){
        .workers = processors < 1     ? 1
                   : processors > 256 ? 256
                                      : (unsigned)processors,
        .bodies_days = 30.0,
        .queue_capacity = 1024,
        .inline_solves = true,
        .limit_seconds = 3600.0,
        .limit_samples = ENSEMBLE_MAX_SAMPLES,
        .limit_clients = 1024,
        .token_count = 65536,
        .token_megabytes = 256,
        .token_minutes = 10.0,
        .replies_per_client = 1024,
        .reply_megabytes = 256,
        .stored_replies = 16384,
        .session_minutes = 10.0,
        .drain_seconds = 30.0,
        .log_level = LEVEL_INFO,
    };
}

static enum percuss_status read_number(struct reader *reader, const yaml_node_t *value,
                                       const struct setting *setting, void *field)
{
    double number;
    char allowed[96];
    bool whole = setting->kind == KIND_WHOLE;
    snprintf(allowed, sizeof allowed, "a %snumber, %.10g to %.10g", whole ? "whole " : "",
             setting->low, setting->high);
    if (!reader_number(value, &number) || number < setting->low || number > setting->high ||
        (whole && number != floor(number)))
        return reader_refuse_value(reader, value, allowed);
    if (whole)
        *(unsigned *)field = (unsigned)number;
    else
        *(double *)field = number;
    return PERCUSS_OK;
}

static enum percuss_status read_switch(struct reader *reader, const yaml_node_t *value, bool *field)
{
    *field = reader_is(value, "true");
    if (*field || reader_is(value, "false"))
        return PERCUSS_OK;
    return reader_refuse_value(reader, value, "true or false");
}

static enum percuss_status read_level(struct reader *reader, const yaml_node_t *value,
                                      enum log_level *field)
{
    for (enum log_level level = 0; level < LEVEL_COUNT; level++) {
        if (reader_is(value, log_level_name(level))) {
            *field = level;
            return PERCUSS_OK;
        }
    }
    return reader_refuse_value(reader, value, "error, warning, info or debug");
}

static enum percuss_status read_format(struct reader *reader, const yaml_node_t *value,
                                       enum log_format *field)
{
    for (enum log_format format = 0; format < LOG_FORMAT_COUNT; format++) {
        if (reader_is(value, log_format_name(format))) {
            *field = format;
            return PERCUSS_OK;
        }
    }
    return reader_refuse_value(reader, value, "text, journal or json");
}

/* A path, from the folder of the settings file if it is relative. */
static enum percuss_status read_path(struct reader *reader, const yaml_node_t *value, char *field)
{
    if (value->type != YAML_SCALAR_NODE || value->data.scalar.length == 0)
        return reader_refuse_value(reader, value, "the path of a file");
    const char *path = (const char *)value->data.scalar.value;
    const char *slash = strrchr(reader->name, '/');
    int folder = slash && *path != '/' ? (int)(slash + 1 - reader->name) : 0;
    int length = snprintf(field, SETTINGS_PATH_SIZE, "%.*s%s", folder, reader->name, path);
    if (length >= SETTINGS_PATH_SIZE)
        return reader_refuse_value(reader, value, "a path of at most 4095 bytes");
    return PERCUSS_OK;
}

static enum percuss_status read_partition(struct reader *reader, const yaml_node_t *value,
                                          char *field)
{
    const char *name =
        value->type == YAML_SCALAR_NODE ? (const char *)value->data.scalar.value : "";
    if (!wire_partition_is_good(name))
        return reader_refuse_value(reader, value, WIRE_PARTITION_RULE);
    snprintf(field, WIRE_PARTITION_SIZE, "%s", name);
    return PERCUSS_OK;
}

static enum percuss_status read_value(struct reader *reader, const yaml_node_t *value,
                                      const struct setting *setting, struct settings *settings)
{
    void *field = (char *)settings + setting->offset;
    switch (setting->kind) {
    case KIND_SWITCH:
        return read_switch(reader, value, field);
    case KIND_PATH:
        return read_path(reader, value, field);
    case KIND_PARTITION:
        return read_partition(reader, value, field);
    case KIND_LEVEL:
        return read_level(reader, value, field);
    case KIND_FORMAT:
        return read_format(reader, value, field);
    default:
        return read_number(reader, value, setting, field);
    }
}

static const struct setting *find(const char *path)
{
    for (size_t i = 0; i < SETTING_COUNT; i++) {
        if (strcmp(table[i].path, path) == 0)
            return &table[i];
    }
    return NULL;
}

static bool is_section(const char *path)
{
    size_t length = strlen(path);
    for (size_t i = 0; i < SETTING_COUNT; i++) {
        if (strncmp(table[i].path, path, length) == 0 && table[i].path[length] == '.')
            return true;
    }
    return false;
}

static enum percuss_status refuse_key(const struct reader *reader, const yaml_node_t *key)
{
    char list[400] = "";
    size_t used = 0;
    for (size_t i = 0; i < SETTING_COUNT && used < sizeof list; i++)
        used +=
            (size_t)snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", table[i].path);
    return reader_refuse(reader, key, "unknown key: must be one of %s", list);
}

/* A mapping of keys; one level of sections. */
static enum percuss_status read_mapping(struct reader *reader, const yaml_node_t *mapping,
                                        struct settings *settings)
{
    if (mapping->type != YAML_MAPPING_NODE)
        return reader_refuse_value(reader, mapping, "a mapping of keys");
    for (size_t i = 0; i < reader_count(mapping); i++) {
        /* every key once */
        struct entry entry = reader_entry(reader, mapping, i);
        struct excerpt name = reader_excerpt(entry.key);
        size_t mark = reader_enter(reader, name.text);
        if (reader_find(reader, mapping, name.text).key != entry.key &&
            entry.key->type == YAML_SCALAR_NODE)
            return reader_refuse(reader, entry.key, "stands twice: must stand once");
        /* a setting, a section of them, or nothing that is known */
        const struct setting *setting = find(reader->path);
        enum percuss_status status;
        if (setting)
            status = read_value(reader, entry.value, setting, settings);
        else if (is_section(reader->path))
            status = read_mapping(reader, entry.value, settings);
        else
            status = refuse_key(reader, entry.key);
        if (status)
            return status;
        reader_leave(reader, mark);
    }
    return PERCUSS_OK;
}

static enum percuss_status read_document(FILE *file, const char *path, struct settings *settings,
                                         struct fault *fault)
{
    yaml_parser_t parser;
    yaml_document_t document;
    enum percuss_status status = PERCUSS_OK;
    if (!yaml_parser_initialize(&parser))
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    /* YAML, or the line where it is none */
    yaml_parser_set_input_file(&parser, file);
    if (!yaml_parser_load(&parser, &document)) {
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "%s:%zu: must be valid YAML: %s",
                           reader_short_name(path), parser.problem_mark.line + 1,
                           parser.problem ? parser.problem : "out of memory");
        goto no_document;
    }
    struct reader reader = {.document = &document, .name = path, .fault = fault};
    const yaml_node_t *root = yaml_document_get_root_node(&document);
    /* a file of comments leaves the defaults */
    if (root)
        status = read_mapping(&reader, root, settings);
    yaml_document_delete(&document);
no_document:
    yaml_parser_delete(&parser);
    return status;
}

enum percuss_status settings_load(const char *path, struct settings *settings, struct fault *fault)
{
    FILE *file = fopen(path, "rbe");
    if (!file)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: cannot be read: %s",
                         reader_short_name(path), strerror(errno));
    enum percuss_status status = read_document(file, path, settings, fault);
    fclose(file);
    return status;
}
