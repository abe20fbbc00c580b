/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "csv.h"

#include <string.h>

#include "fold.h"

/* Units of columns; counts, shares, names and the like have none. */
static const struct {
    const char *name, *unit;
} columns[] = {
    {"speed", "m/s"},
    {"angle", "deg"},
    {"impulse", "N s"},
    {"impulse_tangential_1", "N s"},
    {"impulse_tangential_2", "N s"},
    {"impulse_tangential_error", "N s"},
    {"slip_before_1", "m/s"},
    {"slip_before_2", "m/s"},
    {"slip_after_1", "m/s"},
    {"slip_after_2", "m/s"},
    {"sub_impulse_tangential_1", "N s"},
    {"sub_impulse_tangential_2", "N s"},
    {"first_impulse", "N s"},
    {"sub_impulse", "N s"},
    {"time", "s"},
    {"start", "s"},
    {"end", "s"},
    {"end_time", "s"},
    {"first_duration", "s"},
    {"second_start", "s"},
    {"force", "N"},
    {"peak_force", "N"},
    {"indentation", "m"},
    {"max_indentation", "m"},
    {"gap", "m"},
    {"gap_rate", "m/s"},
    {"displacement_a", "m"},
    {"displacement_b", "m"},
    {"velocity_a", "m/s"},
    {"velocity_b", "m/s"},
    {"force_tangential_1", "N"},
    {"force_tangential_2", "N"},
    {"slip_1", "m/s"},
    {"slip_2", "m/s"},
    {"direction", "rad"},
    {"mass", "kg"},
    {"half_extent_x", "m"},
    {"half_extent_y", "m"},
    {"half_extent_z", "m"},
    {"radius", "m"},
    {"tip_radius", "m"},
    {"young", "Pa"},
    {"density", "kg/m^3"},
    {"yield", "Pa"},
    {"tangent", "Pa"},
    {"loss_frequency", "Hz"},
    {"rate_reference", "1/s"},
    {"dissipation", "s/m"},
    {"max_force", "N"},
    {"residual_indentation", "m"},
};

/* NULL: it has none. */
static const char *unit_of(const char *name, size_t length)
{
    static const char twin[] = "simulated_";
    if (!strncmp(name, twin, sizeof twin - 1))
        return unit_of(name + sizeof twin - 1, length - (sizeof twin - 1));
    const char *body = memchr(name, '@', length);
    size_t own = body ? (size_t)(body - name) : length;
    for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++)
        if (strlen(columns[i].name) == own && !strncmp(columns[i].name, name, own))
            return columns[i].unit;
    return NULL;
}

void csv_head(FILE *file, const char *names, bool units)
{
    if (file == stdout)
        fold_end();
    for (const char *name = names; *name;) {
        size_t length = strcspn(name, ",");
        const char *unit = units ? unit_of(name, length) : NULL;
        fprintf(file, "%.*s", (int)length, name);
        if (unit)
            fprintf(file, " [%s]", unit);
        name += length;
        if (*name == ',')
            putc(*name++, file);
    }
}

void csv_text(FILE *file, const char *text)
{
    if (!text[strcspn(text, ",\"\r\n")]) {
        fputs(text, file);
        return;
    }
    putc('"', file);
    for (; *text; text++) {
        if (*text == '"')
            putc('"', file);
        putc(*text, file);
    }
    putc('"', file);
}
