/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/indentation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 8, BRANCH_EVERY = 3 };

/* Runs on the wanted mesh and on one 1.5 times coarser, each with long and short steps. */
struct runs {
    struct indentation_run coarse_long, coarse_short, fine_long, fine_short;
};

static bool make_room(struct indentation_table *table, size_t points, size_t branches)
{
    table->indentation = calloc(points, sizeof(double));
    table->force = calloc(points, sizeof(double));
    table->radius = calloc(points, sizeof(double));
    table->largest = calloc(branches, sizeof(double));
    table->largest_force = calloc(branches, sizeof(double));
    table->residual = calloc(branches, sizeof(double));
    table->recovery = calloc(branches * INDENTATION_SAMPLES, sizeof(double));
    return table->indentation && table->force && table->radius && table->largest &&
           table->largest_force && table->residual && table->recovery;
}

void indentation_table_free(struct indentation_table *table)
{
    free(table->indentation);
    free(table->force);
    free(table->radius);
    free(table->largest);
    free(table->largest_force);
    free(table->residual);
    free(table->recovery);
    *table = (struct indentation_table){0};
}

static double ratio_at(const struct indentation_run *run, double indentation)
{
    if (indentation <= run->middle[0])
        return 1.0;
    return indentation_interpolate(run->rings, run->middle, run->ratio, 1, indentation);
}

/* The returns' backward Euler leaves an error proportional to the step: taken out by the difference
 * to steps of twice the length. */
static double extrapolated(const struct indentation_run *with_long,
                           const struct indentation_run *with_short, double indentation)
{
    return 2.0 * ratio_at(with_short, indentation) - ratio_at(with_long, indentation);
}

static void fill(struct indentation_table *table, const struct runs *runs)
{
    const struct indentation_run *run = &runs->fine_short;
    for (size_t i = 0; i < table->points; i++) {
        double d = run->middle[i];
        double ratio = i ? extrapolated(&runs->fine_long, run, d) : 1.0;
        double coarse = extrapolated(&runs->coarse_long, &runs->coarse_short, d);
        double step = fabs(ratio - ratio_at(run, d));
        table->indentation[i] = d;
        table->force[i] = ratio * table->hertz * pow(d, 1.5);
        table->radius[i] = run->radius[i];
        /* steps: what a second extrapolation would bring is well below a third of the first */
        table->force_error = fmax(table->force_error, (fabs(ratio - coarse) + step / 3.0) / ratio);
    }
}

static void fill_branches(struct indentation_table *table, const struct runs *runs)
{
    const struct indentation_run *run = &runs->fine_short;
    const struct indentation_run *coarse = &runs->coarse_short;
    /* branches as the finest run has them, with forces on the loading curve */
    memcpy(table->largest, run->largest, table->branches * sizeof(double));
    memcpy(table->residual, run->residual, table->branches * sizeof(double));
    memcpy(table->recovery, run->recovery, table->branches * INDENTATION_SAMPLES * sizeof(double));
    for (size_t i = 0; i < table->branches; i++) {
        double d = run->largest[i];
        table->largest_force[i] =
            table->hertz * pow(d, 1.5) * (i ? extrapolated(&runs->fine_long, run, d) : 1.0);
        if (d <= coarse->largest[0])
            continue;
        /* how far the coarser mesh is from them */
        double residual =
            indentation_interpolate(coarse->branches, coarse->largest, coarse->residual, 1, d);
        table->residual_error = fmax(table->residual_error, fabs(residual - run->residual[i]) / d);
        for (size_t j = 1; j < INDENTATION_SAMPLES - 1; j++) {
            double recovery = indentation_interpolate(coarse->branches, coarse->largest,
                                                      coarse->recovery + j, INDENTATION_SAMPLES, d);
            double other = run->recovery[i * INDENTATION_SAMPLES + j];
            table->recovery_error = fmax(table->recovery_error, fabs(recovery - other));
        }
    }
}

static enum percuss_status run_all(const struct region_input *input, const struct watch *watch,
                                   struct runs *runs, struct fault *fault)
{
    struct region_input coarser = *input;
    coarser.resolution = (2 * input->resolution + 1) / 3;
    /* shares of the time, measured */
    const struct indentation_plan plans[] = {
        {coarser, STEPS / 2, 0, 0.0, 0.08, watch},
        {coarser, STEPS, 1, 0.08, 0.17, watch},
        {*input, STEPS / 2, 0, 0.25, 0.25, watch},
        {*input, STEPS, BRANCH_EVERY, 0.5, 0.5, watch},
    };
    struct indentation_run *targets[] = {&runs->coarse_long, &runs->coarse_short, &runs->fine_long,
                                         &runs->fine_short};
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; i < 4 && status == PERCUSS_OK; i++)
        status = indentation_run(&plans[i], targets[i], fault);
    return status;
}

enum percuss_status indentation_table_make(const struct region_input *input,
                                           const struct watch *watch,
                                           struct indentation_table *table, struct fault *fault)
{
    *table = (struct indentation_table){.input = *input, .version = INDENTATION_VERSION};
    if (input->resolution < 6)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "resolution: %zu: must be 6 ... 60 for a table", input->resolution);
    /* on two meshes with two lengths of steps each */
    struct runs *runs = calloc(1, sizeof *runs);
    if (!runs)
        return fault_set(fault, PERCUSS_INTERNAL, "indentation table: no memory");
    enum percuss_status status = run_all(input, watch, runs, fault);
    /* the finest, with errors from the others */
    if (status == PERCUSS_OK) {
        table->points = runs->fine_short.rings;
        table->branches = runs->fine_short.branches;
        table->nodes = runs->fine_short.effort.nodes;
        table->newton_steps = runs->fine_short.effort.newton_steps;
        table->hertz = indentation_hertz(input);
        if (make_room(table, table->points, table->branches)) {
            fill(table, runs);
            fill_branches(table, runs);
        } else {
            status = fault_set(fault, PERCUSS_INTERNAL, "indentation table: no memory");
        }
    }
    /* nothing on failure */
    free(runs);
    if (status != PERCUSS_OK)
        indentation_table_free(table);
    return status;
}
