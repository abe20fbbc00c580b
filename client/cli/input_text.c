/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "input_text.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "percuss/similar.h"
#include "quantity.h"

enum { MOST_NUMBERS = 4, LINE_SIZE = 65536 };

__attribute__((format(printf, 2, 3))) static bool refuse(struct input_fault *fault,
                                                         const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(fault->text, sizeof fault->text, format, arguments);
    va_end(arguments);
    return false;
}

/* The text behind "NAME:" if it begins so, else NULL. */
static const char *after(const char *text, const char *name)
{
    size_t length = strlen(name);
    return !strncmp(text, name, length) && text[length] == ':' ? text + length + 1 : NULL;
}

static bool read_list(const char *text, struct percuss_input *input, struct input_fault *fault)
{
    char file[4096];
    const char *colon = strchr(text, ':');
    size_t length = colon ? (size_t)(colon - text) : strlen(text);
    snprintf(file, sizeof file, "%.*s", (int)length, text);
    input->distribution = PERCUSS_DISTRIBUTION_LIST;
    input->values = input_text_column(file, colon ? colon + 1 : NULL, &input->value_count, fault);
    return input->values != NULL;
}

/* A number by itself does not vary. */
static bool read_constant(const char *text, struct percuss_input *input, struct input_fault *fault)
{
    struct quantity_fault wrong;
    const char *number = text + strspn(text, " \t");
    if (units_number_end(number) == number || strchr(text, ':'))
        return refuse(fault,
                      "'%s' is no distribution: a number, uniform:, normal:, log-normal: or list: "
                      "is needed, for example uniform:0.1:0.4",
                      text);
    input->distribution = PERCUSS_DISTRIBUTION_CONSTANT;
    return quantity_read(text, strlen(text), quantity_of(input->name), &input->first, &wrong) ||
           refuse(fault, "'%s': %s", text, wrong.text);
}

bool input_text_distribution(const char *text, struct percuss_input *input,
                             struct input_fault *fault)
{
    static const struct {
        const char *name;
        enum percuss_distribution distribution;
        int least, most; /* numbers */
        const char *form;
    } kinds[] = {
        {"uniform", PERCUSS_DISTRIBUTION_UNIFORM, 2, 2, "uniform:LOWEST:HIGHEST"},
        {"normal", PERCUSS_DISTRIBUTION_NORMAL, 2, 4,
         "normal:MEAN:DEVIATION or normal:MEAN:DEVIATION:LOWEST:HIGHEST"},
        {"log-normal", PERCUSS_DISTRIBUTION_LOG_NORMAL, 2, 4,
         "log-normal:MEAN:DEVIATION or log-normal:MEAN:DEVIATION:LOWEST:HIGHEST"},
    };
    double numbers[MOST_NUMBERS];
    struct quantity_fault wrong = {""};
    enum quantity quantity = quantity_of(input->name);
    input->lower = input->upper = NAN;
    /* values from a file */
    const char *rest = after(text, "list");
    if (rest)
        return read_list(rest, input, fault);
    /* a kind and its numbers, or none that is known */
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        rest = after(text, kinds[i].name);
        if (!rest)
            continue;
        int count = quantity_read_list(rest, quantity, numbers, MOST_NUMBERS, &wrong);
        if (count < 0)
            return refuse(fault, "'%s' is not %s: %s", text, kinds[i].form, wrong.text);
        if (count != kinds[i].least && count != kinds[i].most)
            return refuse(fault, "'%s' is not %s", text, kinds[i].form);
        input->distribution = kinds[i].distribution;
        input->first = numbers[0];
        input->second = numbers[1];
        input->lower = count == MOST_NUMBERS ? numbers[2] : NAN;
        input->upper = count == MOST_NUMBERS ? numbers[3] : NAN;
        return true;
    }
    return read_constant(text, input, fault);
}

const char *input_text_owner(const char *text)
{
    const char *owner = text + strcspn(text, "@:=");
    return *owner == '@' || *owner == ':' ? owner : NULL;
}

/* Whether there is such an input, "at" being the command line's word for a site along a beam. One
 * that is like none of them is the server's to refuse, or to know. */
static bool check_name(const char *text, const char *name, bool readable, struct input_fault *fault)
{
    static const char *const known[] = {
        "speed",       "direction",      "model-force", "model-compliance",
        "model-yield", "model-friction", "friction",    "site",
        "at",          "young",          "poisson",     "density",
        "radius",      "yield",          "damping",     "scale"};
    struct similar similar = similar_to(name);
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (!strcmp(known[i], name))
            return true;
        similar_offer(&similar, known[i]);
    }
    if (readable && !similar.nearest)
        return true;
    return refuse(fault,
                  "'%s': '%s' is none of speed, direction, model-force, model-compliance, "
                  "model-yield, model-friction, friction, and of a body site (or at), young, "
                  "poisson, density, radius, yield, "
                  "damping, scale%s%s%s",
                  text, name, similar.nearest ? ": did you mean '" : "",
                  similar.nearest ? similar.nearest : "", similar.nearest ? "'?" : "");
}

bool input_text_read(const char *text, struct percuss_input *input, struct input_fault *fault)
{
    const char *equals = strchr(text, '='), *at = input_text_owner(text);
    *input = (struct percuss_input){.distribution = PERCUSS_DISTRIBUTION_CONSTANT};
    if (!equals)
        return refuse(fault,
                      "'%s' is not NAME@BODY=DISTRIBUTION, for example "
                      "young@al-beam=normal:70e9:1e9",
                      text);
    /* NAME, and @BODY if there is one */
    size_t name = (size_t)((at ? at : equals) - text);
    size_t body = at ? (size_t)(equals - at - 1) : 0;
    if (name >= sizeof input->name || body >= sizeof input->body)
        return refuse(fault, "'%s': names have up to %zu letters", text, sizeof input->name - 1);
    memcpy(input->name, text, name);
    if (at)
        memcpy(input->body, at + 1, body);
    /* a name that is wrong comes before its numbers, because it decides about their unit */
    bool readable = input_text_distribution(equals + 1, input, fault);
    if (!check_name(text, input->name, readable, fault)) {
        free((void *)input->values);
        input->values = NULL;
        return false;
    }
    if (!strcmp(input->name, "at"))
        strcpy(input->name, "site");
    return readable;
}

/* The field of that number (from 0) in a line, cut out in place; NULL: there is none. */
static char *field_of(char *line, size_t number)
{
    char *field = line;
    while (number-- > 0) {
        field = strchr(field, ',');
        if (!field)
            return NULL;
        field++;
    }
    field[strcspn(field, ",\r\n")] = '\0';
    field += strspn(field, " \t\"");
    field[strcspn(field, "\"")] = '\0';
    return field;
}

static bool as_number(const char *field, double *number)
{
    char *end;
    *number = strtod(field, &end);
    return end != field && end[strspn(end, " \t")] == '\0';
}

/* Number of the named column in the first line; SIZE_MAX: none. */
static size_t find_column(const char *line, const char *name)
{
    char copy[LINE_SIZE];
    for (size_t i = 0;; i++) {
        snprintf(copy, sizeof copy, "%s", line);
        const char *field = field_of(copy, i);
        if (!field)
            return SIZE_MAX;
        if (!strcmp(field, name))
            return i;
    }
}

static bool append(double **values, size_t *count, size_t *room, double value)
{
    if (*count == *room) {
        *room = *room ? 2 * *room : 256;
        double *grown = realloc(*values, *room * sizeof *grown);
        if (!grown)
            return false;
        *values = grown;
    }
    (*values)[(*count)++] = value;
    return true;
}

/* A file that is being read. */
struct table {
    FILE *stream;
    const char *file, *column;
    size_t place; /* of the column, from 0; SIZE_MAX: not known yet */
    bool named;   /* the first line is to name it */
    unsigned line;
};

/* The column's place as far as its name tells without the file. */
static void place_column(struct table *table)
{
    char *end = NULL;
    unsigned long number = table->column ? strtoul(table->column, &end, 10) : 1;
    table->named = table->column && (*end || number == 0);
    table->place = table->named ? SIZE_MAX : number - 1;
}

/* The values of all lines. */
static bool read_lines(struct table *table, double **values, size_t *count,
                       struct input_fault *fault)
{
    char line[LINE_SIZE];
    size_t room = 0;
    bool first = true;
    while (fgets(line, sizeof line, table->stream)) {
        double value;
        table->line++;
        if (line[0] == '#' || !line[strspn(line, " \t\r\n")])
            continue;
        /* a first line may name the columns */
        if (first && table->named)
            table->place = find_column(line, table->column);
        if (table->place == SIZE_MAX)
            return refuse(fault, "%s: no column '%s' in line %u", table->file, table->column,
                          table->line);
        const char *field = field_of(line, table->place);
        /* and is skipped if it is no number */
        bool number = field && as_number(field, &value);
        if (!number && !first)
            return refuse(fault, "%s: line %u: '%s' is not a number", table->file, table->line,
                          field ? field : "");
        if (number && !append(values, count, &room, value))
            return refuse(fault, "%s: out of memory", table->file);
        first = false;
    }
    return *count > 0 || refuse(fault, "%s: no numbers in it", table->file);
}

double *input_text_column(const char *file, const char *column, size_t *count,
                          struct input_fault *fault)
{
    struct table table = {.stream = fopen(file, "r"), .file = file, .column = column};
    double *values = NULL;
    *count = 0;
    if (!table.stream) {
        refuse(fault, "%s: %s", file, strerror(errno));
        return NULL;
    }
    place_column(&table);
    bool read = read_lines(&table, &values, count, fault);
    fclose(table.stream);
    if (read)
        return values;
    free(values);
    return NULL;
}

double input_text_middle(const struct percuss_input *input)
{
    if (input->distribution == PERCUSS_DISTRIBUTION_UNIFORM)
        return 0.5 * (input->first + input->second);
    return input->distribution == PERCUSS_DISTRIBUTION_LIST ? input->values[0] : input->first;
}
