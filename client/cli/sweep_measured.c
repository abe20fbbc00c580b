/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "sweep_measured.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "measured_file.h"

void sweep_measured_add(struct sweep_measurements *measurements, const char *text,
                        struct argp_state *state)
{
    if (measurements->count == SWEEP_MEASURED_MOST)
        argp_error(state, "--measured: '%s': at most %d files", text, SWEEP_MEASURED_MOST);
    struct sweep_measured *measured = &measurements->list[measurements->count++];
    const char *equals = strchr(text, '=');
    *measured = (struct sweep_measured){.file = text};
    /* a file's name may have one too */
    if (equals && access(text, F_OK) != 0) {
        measured->b = strndup(text, (size_t)(equals - text));
        measured->file = equals + 1;
        if (!measured->b)
            exit(complain_memory());
    }
}

static void check(const struct sweep_measured *measured, const struct scene *scene,
                  struct argp_state *state)
{
    size_t b = 0;
    while (measured->b && b < scene->b_count && strcmp(scene->all_b[b], measured->b) != 0)
        b++;
    if (measured->b && b == scene->b_count)
        argp_error(state,
                   "--measured: '%s=%s': a body that --b names is needed before the =", measured->b,
                   measured->file);
}

void sweep_measured_read(struct sweep_measurements *measurements, const struct scene *scene,
                         bool is_drawn, struct argp_state *state)
{
    for (size_t i = 0; i < measurements->count; i++)
        check(&measurements->list[i], scene, state);
    if (measurements->count > 0 && !is_drawn)
        argp_error(state, "--measured is laid over a picture: --plot FILE is needed");
    if (measurements->columns.count > 0 && measurements->count == 0)
        argp_error(state, "--column is of a file that is measured: --measured FILE is needed");
    for (size_t i = 0; i < measurements->count; i++) {
        struct measured_remarks remarks = {0};
        struct sweep_measured *measured = &measurements->list[i];
        bool good = measured_read(measured->file, &measurements->columns, &measured->set, &remarks);
        measured_file_complain("--measured: ", &remarks);
        if (!good)
            argp_error(state, "--measured: '%s' is not read", measured->file);
    }
}

void sweep_measured_free(struct sweep_measurements *measurements)
{
    for (size_t i = 0; i < measurements->count; i++) {
        free(measurements->list[i].b);
        measured_set_free(&measurements->list[i].set);
    }
    measurements->count = 0;
}
