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
#include "model/ritz_store.h"

/* One key; a dot separates a section from its keys. */
struct setting {
    const char *path;
    enum settings_kind kind;
    size_t offset;
    double low, high;
    const char *otherwise; /* where the key is absent; NULL: the value of settings_default */
    const char *meaning;
};

#define AT(member) offsetof(struct settings, member)

static const struct setting table[] = {
    {"catalogue", SETTINGS_PATH, AT(catalogue), 0, 0, "none: --catalogue must say it",
     "bodies and materials, percuss-catalogue(5); read again at SIGHUP"},
    {"domain", SETTINGS_WHOLE, AT(domain), 0, SETTINGS_MAX_DOMAIN, NULL,
     "DDS domain; the command line and PERCUSS_DOMAIN go before it"},
    {"partition", SETTINGS_PARTITION, AT(partition), 0, 0,
     "none: it answers those who ask in no partition",
     "DDS partition in which it answers, so that daemons with different catalogues share a domain"},
    {"workers", SETTINGS_WHOLE, AT(workers), 1, 256, "one for every processor",
     "threads that solve; there are as many again, and one more, of low priority for what takes "
     "long"},
    {"queue_capacity", SETTINGS_WHOLE, AT(queue_capacity), 1, 65536, NULL,
     "requests that may wait in each of the queues, a batch counting as one; what comes on top is "
     "answered BUSY"},
    {"inline_solves", SETTINGS_SWITCH, AT(inline_solves), 0, 0, NULL,
     "whether the reading thread solves a cheap request itself when nothing else waits"},
    {"limits.seconds", SETTINGS_NUMBER, AT(limit_seconds), 0.001, 1e9, NULL,
     "seconds of solving that one request may take; then its answer is TIMEOUT, of an ensemble "
     "what "
     "there is by then"},
    {"limits.samples", SETTINGS_WHOLE, AT(limit_samples), 1, ENSEMBLE_MAX_SAMPLES, NULL,
     "samples of one ensemble"},
    {"limits.clients", SETTINGS_WHOLE, AT(limit_clients), 1, 65536, NULL,
     "clients that may be there at once; those of one process take at most half of the places"},
    {"limits.megabytes", SETTINGS_WHOLE, AT(limit_megabytes), 16, 4194304,
     "none: vibrations have 256, bodies 32 for each thread",
     "megabytes of all that is kept from one request to the next: a quarter each for states, "
     "replies, vibrations of blocks and cylinders, and bodies that the solving threads have "
     "prepared"},
    {"tokens.count", SETTINGS_WHOLE, AT(token_count), 1, 10000000, NULL,
     "state tokens that are kept, those used last"},
    {"tokens.megabytes", SETTINGS_WHOLE, AT(token_megabytes), 1, 1048576, NULL,
     "megabytes that they may take"},
    {"tokens.minutes", SETTINGS_NUMBER, AT(token_minutes), 0.001, 100000, NULL,
     "minutes for which one is kept without use"},
    {"replies.per_client", SETTINGS_WHOLE, AT(replies_per_client), 1, 65536, NULL,
     "last replies of each client that are kept, so that a repeated request gets the same one"},
    {"replies.megabytes", SETTINGS_WHOLE, AT(reply_megabytes), 1, 1048576, NULL,
     "megabytes that all of them may take"},
    {"store", SETTINGS_PATH, AT(store), 0, 0, "none: what names a specimen is refused",
     "SQLite file of the specimens' dents and replies, made if need be"},
    {"backup", SETTINGS_PATH, AT(backup), 0, 0, "none",
     "copy of the store, written at SIGUSR1 while it is in use"},
    {"stored_replies", SETTINGS_WHOLE, AT(stored_replies), 1, 10000000, NULL,
     "replies to requests of specimens that the store keeps"},
    {"standby", SETTINGS_PATH, AT(standby), 0, 0, "none: this daemon answers at once",
     "file whose lock says which of several daemons with these settings answers, and under which "
     "id"},
    {"session_minutes", SETTINGS_NUMBER, AT(session_minutes), 0.001, 100000, NULL,
     "minutes for which a client that has gone is remembered, with its replies"},
    {"drain_seconds", SETTINGS_NUMBER, AT(drain_seconds), 0, 86400, NULL,
     "seconds for what is queued after SIGTERM"},
    {"tables", SETTINGS_FOLDERS, AT(tables), 0, 0, "none: metals yield by the closed form",
     "folders of contact tables and of their family for all metals; beside them stand the shipped "
     "tables and those of one's own, percuss-tables(8)"},
    {"tables_alone", SETTINGS_SWITCH, AT(tables_alone), 0, 0, NULL,
     "whether the folders of `tables` are all: neither the shipped tables nor those of one's own "
     "are beside them"},
    {"bodies", SETTINGS_PATH, AT(bodies), 0, 0, "none: the catalogue names reduced bodies only",
     "folder of bodies that percussd has reduced from the catalogue's meshes"},
    {"bodies_days", SETTINGS_NUMBER, AT(bodies_days), 0.001, 100000, NULL,
     "days after which a body there that no catalogue has named is deleted"},
    {"security", SETTINGS_PATH, AT(security), 0, 0, "none: without DDS Security",
     "folder of this daemon's identity, made by percuss-keys.sh"},
    {"metrics", SETTINGS_PATH, AT(metrics), 0, 0, "none",
     "file of counters in OpenMetrics text, written once a second"},
    {"log_level", SETTINGS_LEVEL, AT(log_level), 0, 0, NULL,
     "what is logged: this and what is worse"},
    {"log_format", SETTINGS_FORMAT, AT(log_format), 0, 0, NULL,
     "of a line: for people, for systemd's journal, or a JSON object"},
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
        .box_megabytes = RITZ_STORE_BYTES >> 20,
        .stored_replies = 16384,
        .session_minutes = 10.0,
        .drain_seconds = 30.0,
        .log_level = LEVEL_INFO,
    };
}

/* The allowed values, in words that follow "must be". */
struct allowed {
    char text[96];
};

static void allow(struct allowed *allowed, size_t i, size_t count, const char *word)
{
    size_t used = strlen(allowed->text);
    snprintf(allowed->text + used, sizeof allowed->text - used, "%s%s",
             i == 0          ? ""
             : i + 1 < count ? ", "
                             : " or ",
             word);
}

static struct allowed allowed_of(const struct setting *setting)
{
    struct allowed allowed = {""};
    switch (setting->kind) {
    case SETTINGS_SWITCH:
        return (struct allowed){"true or false"};
    case SETTINGS_PATH:
        return (struct allowed){"the path of a file"};
    case SETTINGS_FOLDERS:
        return (struct allowed){"the path of a folder, or a list of 1 to 8 of them"};
    case SETTINGS_PARTITION:
        return (struct allowed){WIRE_PARTITION_RULE};
    case SETTINGS_LEVEL:
        for (enum log_level level = 0; level < LEVEL_COUNT; level++)
            allow(&allowed, level, LEVEL_COUNT, log_level_name(level));
        return allowed;
    case SETTINGS_FORMAT:
        for (enum log_format format = 0; format < LOG_FORMAT_COUNT; format++)
            allow(&allowed, format, LOG_FORMAT_COUNT, log_format_name(format));
        return allowed;
    default:
        snprintf(allowed.text, sizeof allowed.text, "a %snumber, %.10g to %.10g",
                 setting->kind == SETTINGS_WHOLE ? "whole " : "", setting->low, setting->high);
        return allowed;
    }
}

static bool read_number(const yaml_node_t *value, const struct setting *setting, void *field)
{
    double number;
    bool whole = setting->kind == SETTINGS_WHOLE;
    if (!reader_number(value, &number) || number < setting->low || number > setting->high ||
        (whole && number != floor(number)))
        return false;
    if (whole)
        *(unsigned *)field = (unsigned)number;
    else
        *(double *)field = number;
    return true;
}

static bool read_switch(const yaml_node_t *value, bool *field)
{
    *field = reader_is(value, "true");
    return *field || reader_is(value, "false");
}

static bool read_level(const yaml_node_t *value, enum log_level *field)
{
    for (*field = 0; *field < LEVEL_COUNT; (*field)++)
        if (reader_is(value, log_level_name(*field)))
            return true;
    return false;
}

static bool read_format(const yaml_node_t *value, enum log_format *field)
{
    for (*field = 0; *field < LOG_FORMAT_COUNT; (*field)++)
        if (reader_is(value, log_format_name(*field)))
            return true;
    return false;
}

/* A path, from the folder of the settings file if it is relative. */
static enum percuss_status read_path(struct reader *reader, const yaml_node_t *value,
                                     const struct setting *setting, char *field)
{
    if (value->type != YAML_SCALAR_NODE || value->data.scalar.length == 0)
        return reader_refuse_value(reader, value, allowed_of(setting).text);
    const char *path = (const char *)value->data.scalar.value;
    const char *slash = strrchr(reader->name, '/');
    int folder = slash && *path != '/' ? (int)(slash + 1 - reader->name) : 0;
    int length = snprintf(field, SETTINGS_PATH_SIZE, "%.*s%s", folder, reader->name, path);
    if (length >= SETTINGS_PATH_SIZE)
        return reader_refuse_value(reader, value, "a path of at most 4095 bytes");
    return PERCUSS_OK;
}

/* A path, or a list of them. */
static enum percuss_status read_folders(struct reader *reader, const yaml_node_t *value,
                                        const struct setting *setting,
                                        char (*field)[SETTINGS_PATH_SIZE])
{
    size_t count = reader_count(value);
    if (value->type != YAML_SEQUENCE_NODE)
        return read_path(reader, value, setting, field[0]);
    if (count < 1 || count > SETTINGS_FOLDERS_MOST)
        return reader_refuse_value(reader, value, allowed_of(setting).text);
    for (size_t i = 0; i < count; i++) {
        enum percuss_status status =
            read_path(reader, reader_element(reader, value, i), setting, field[i]);
        if (status)
            return status;
    }
    return PERCUSS_OK;
}

static bool read_partition(const yaml_node_t *value, char *field)
{
    const char *name =
        value->type == YAML_SCALAR_NODE ? (const char *)value->data.scalar.value : "";
    if (!wire_partition_is_good(name))
        return false;
    snprintf(field, WIRE_PARTITION_SIZE, "%s", name);
    return true;
}

static enum percuss_status read_value(struct reader *reader, const yaml_node_t *value,
                                      const struct setting *setting, struct settings *settings)
{
    void *field = (char *)settings + setting->offset;
    bool good = false;
    switch (setting->kind) {
    case SETTINGS_SWITCH:
        good = read_switch(value, field);
        break;
    case SETTINGS_PATH:
        return read_path(reader, value, setting, field);
    case SETTINGS_FOLDERS:
        return read_folders(reader, value, setting, field);
    case SETTINGS_PARTITION:
        good = read_partition(value, field);
        break;
    case SETTINGS_LEVEL:
        good = read_level(value, field);
        break;
    case SETTINGS_FORMAT:
        good = read_format(value, field);
        break;
    case SETTINGS_WHOLE:
    case SETTINGS_NUMBER:
        good = read_number(value, setting, field);
        break;
    }
    return good ? PERCUSS_OK : reader_refuse_value(reader, value, allowed_of(setting).text);
}

static const struct setting *settings_find(const char *path)
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
    char list[512] = "";
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
        const struct setting *setting = settings_find(reader->path);
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
    /* the document, or the line of its error */
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

/* A default as it is written. */
static void write_default(const struct setting *setting, struct settings_row *row)
{
    const struct settings settings = settings_default();
    const void *field = (const char *)&settings + setting->offset;
    size_t size = sizeof row->otherwise;
    if (setting->otherwise)
        snprintf(row->otherwise, size, "%s", setting->otherwise);
    else if (setting->kind == SETTINGS_WHOLE)
        snprintf(row->otherwise, size, "%u", *(const unsigned *)field);
    else if (setting->kind == SETTINGS_NUMBER)
        snprintf(row->otherwise, size, "%.10g", *(const double *)field);
    else if (setting->kind == SETTINGS_SWITCH)
        snprintf(row->otherwise, size, "%s", *(const bool *)field ? "true" : "false");
    else if (setting->kind == SETTINGS_LEVEL)
        snprintf(row->otherwise, size, "%s", log_level_name(*(const enum log_level *)field));
    else if (setting->kind == SETTINGS_FORMAT)
        snprintf(row->otherwise, size, "%s", log_format_name(*(const enum log_format *)field));
}

bool settings_describe(size_t number, struct settings_row *row)
{
    if (number >= SETTING_COUNT)
        return false;
    *row = (struct settings_row){.path = table[number].path,
                                 .meaning = table[number].meaning,
                                 .kind = table[number].kind,
                                 .low = table[number].low,
                                 .high = table[number].high};
    snprintf(row->allowed, sizeof row->allowed, "%s", allowed_of(&table[number]).text);
    write_default(&table[number], row);
    return true;
}

const char *log_level_name(enum log_level level)
{
    static const char *const names[LEVEL_COUNT] = {"error", "warning", "info", "debug"};
    return names[level];
}

const char *log_format_name(enum log_format format)
{
    static const char *const names[LOG_FORMAT_COUNT] = {"text", "journal", "json"};
    return names[format];
}
