/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/recipe.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

char *recipe_write(const struct options *options)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return NULL;
    fprintf(stream, "unit=%.17g\n", options->unit);
    if (options->size > 0.0)
        fprintf(stream, "size=%.17g\n", options->size);
    if (options->instance)
        fprintf(stream, "instance=%s\n", options->instance);
    if (options->raise)
        fprintf(stream, "raise=true\n");
    for (size_t i = 0; i < options->fixed_count; i++)
        fprintf(stream, "fixed=%s\n", options->fixed[i]);
    bool bad = ferror(stream) != 0;
    if (fclose(stream) != 0 || bad) {
        free(text);
        return NULL;
    }
    return text;
}

/* A number > 0 to the end of the text. */
static bool read_number(const char *text, double *number)
{
    char *end;
    *number = strtod(text, &end);
    return end != text && !*end && *number > 0.0 && *number < 1e12;
}

/* False: there is no such option, or it has another value. */
static bool take_line(const char *name, const char *value, struct options *options)
{
    if (strcmp(name, "unit") == 0)
        return read_number(value, &options->unit);
    if (strcmp(name, "size") == 0)
        return read_number(value, &options->size);
    if (strcmp(name, "instance") == 0)
        options->instance = value;
    else if (strcmp(name, "raise") == 0)
        options->raise = true;
    else if (strcmp(name, "fixed") == 0 && options->fixed_count < OPTIONS_MOST)
        options->fixed[options->fixed_count++] = value;
    else
        return false;
    return true;
}

enum percuss_status recipe_read(char *text, struct options *options, struct fault *fault)
{
    char *line;
    while ((line = strsep(&text, "\n"))) {
        char *equals = strchr(line, '=');
        if (!*line)
            continue;
        if (equals)
            *equals = '\0';
        if (!equals || !take_line(line, equals + 1, options))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "mesh_options: %.60s: must be unit, size, instance, raise or fixed, "
                             "with their values: made by a later percuss-reduce?",
                             line);
    }
    return PERCUSS_OK;
}
