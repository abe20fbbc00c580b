/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/indentation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One passage over the contact region. */

struct passage {
    const struct indentation_plan *plan;
    struct indentation_run *run;
    struct region *region;
    struct pace pace; /* progress and cancellation, within the region's solutions too */
    double hertz;
    double edge;   /* m, indentation at the last edge */
    double factor; /* between the last two edges */
    struct fault *fault;
};

/* k of F = k d^1.5, N/m^1.5. */
static double indentation_hertz(const struct region_input *input)
{
    double compliance = 0.0;
    for (int i = 0; i < 2; i++) {
        const struct material *m = &input->materials[i];
        compliance += (1.0 - m->poisson * m->poisson) / m->young;
    }
    return 4.0 / 3.0 * sqrt(input->radius) / compliance;
}

double indentation_fraction(size_t sample)
{
    double part = (double)sample / (double)(INDENTATION_SAMPLES - 1);
    return part * part * part;
}

double indentation_interpolate(size_t n, const double *x, const double *y, size_t stride, double at)
{
    size_t first = 0;
    while (first + 4 < n && x[first + 2] < at)
        first++;
    size_t last = first + 4 < n ? first + 4 : n;
    double sum = 0.0;
    for (size_t i = first; i < last; i++) {
        double weight = 1.0;
        for (size_t j = first; j < last; j++)
            if (j != i)
                weight *= log(at / x[j]) / log(x[i] / x[j]);
        sum += weight * y[i * stride];
    }
    return sum;
}

static bool flows(const struct region *region)
{
    struct region_ledger ledger;
    region_ledger(region, &ledger);
    return ledger.flow[0] > 0.0 || ledger.flow[1] > 0.0;
}

/* From the state with the contact edge at one node to that at the next, in steps; the mean over the
 * logarithm of the indentation becomes a ring of the run. */
static enum percuss_status cross(struct passage *passage, size_t node)
{
    struct indentation_run *run = passage->run;
    struct region_answer answer;
    double from = passage->edge;
    double before = from > 0.0 ? run->ratio[run->rings] : 0.0;
    double place = log(from);
    double sum = 0.0;
    for (size_t i = 1; i <= passage->plan->steps; i++) {
        enum percuss_status status;
        if (i < passage->plan->steps && !(from > 0.0))
            continue;
        /* short of the edge: the way back from beyond would be an unloading */
        double part = 0.97 * (double)i / (double)passage->plan->steps;
        if (i < passage->plan->steps)
            status = region_press(passage->region, from * pow(passage->factor, part), &answer,
                                  passage->fault);
        else
            status = region_edge(passage->region, node, &answer, passage->fault);
        if (status != PERCUSS_OK)
            return status;
        region_commit(passage->region);
        double ratio = answer.force / (passage->hertz * pow(answer.indentation, 1.5));
        if (from > 0.0)
            sum += 0.5 * (before + ratio) * (log(answer.indentation) - place);
        before = ratio;
        place = log(answer.indentation);
    }
    passage->edge = answer.indentation;
    if (from > 0.0) {
        passage->factor = passage->edge / from;
        run->middle[run->rings] = sqrt(from * passage->edge);
        run->ratio[run->rings] = sum / log(passage->factor);
        run->radius[run->rings] = region_edge_radius(passage->region, node - 1);
        run->rings++;
    }
    /* kept for the next crossing */
    run->ratio[run->rings] = before;
    return PERCUSS_OK;
}

/* Unloads from the committed state, which stays. Unloading is elastic, the dent conforming to its
 * indenter, so that each sample may be reached in one step. */
static enum percuss_status add_branch(struct passage *passage, double force)
{
    struct indentation_run *run = passage->run;
    double *recovery = run->recovery + run->branches * INDENTATION_SAMPLES;
    double residual;
    enum percuss_status status = region_touch(passage->region, &residual, passage->fault);
    recovery[0] = 0.0;
    recovery[INDENTATION_SAMPLES - 1] = 1.0;
    for (size_t j = INDENTATION_SAMPLES - 2; j > 0 && status == PERCUSS_OK; j--) {
        struct region_answer answer;
        status =
            region_load(passage->region, force * indentation_fraction(j), &answer, passage->fault);
        recovery[j] = (answer.indentation - residual) / (passage->edge - residual);
    }
    run->largest[run->branches] = passage->edge;
    run->residual[run->branches] = residual;
    run->branches++;
    return status;
}

/* the branch from ring 0: Hertz, back to nothing */
static void add_elastic_branch(struct indentation_run *run)
{
    run->largest[0] = run->middle[0];
    run->residual[0] = 0.0;
    for (size_t j = 0; j < INDENTATION_SAMPLES; j++)
        run->recovery[j] = pow(indentation_fraction(j), 2.0 / 3.0);
    run->branches = 1;
}

/* the last elastic ring becomes ring 0, and its ratio's difference from 1 is the mesh's error */
static void restart(struct indentation_run *run, double *mesh_error)
{
    size_t last = run->rings - 1;
    *mesh_error = run->ratio[last];
    run->middle[0] = run->middle[last];
    run->ratio[0] = 1.0;
    run->radius[0] = run->radius[last];
    run->ratio[1] = run->ratio[run->rings];
    run->rings = 1;
}

static bool go_on(struct passage *passage)
{
    const struct indentation_plan *plan = passage->plan;
    /* crossings are equal steps of the logarithm of the indentation */
    double span = log(plan->input.indentation / passage->run->middle[0]);
    double part = span > 0.0 ? log(passage->edge / passage->run->middle[0]) / span : 1.0;
    double done = plan->done + plan->share * fmax(0.0, fmin(part, 1.0));
    region_watch(passage->region, &passage->pace, done);
    return pace_ask(&passage->pace, done);
}

static enum percuss_status pass(struct passage *passage)
{
    struct indentation_run *run = passage->run;
    const struct indentation_plan *plan = passage->plan;
    double mesh_error = 1.0;
    bool flowed = false;
    for (size_t node = plan->input.resolution / 2;
         run->rings == 0 || run->middle[run->rings - 1] < plan->input.indentation; node++) {
        if (run->rings == INDENTATION_RINGS_MAX - 2)
            return fault_set(passage->fault, PERCUSS_INTERNAL, "indentation: over %d rings",
                             INDENTATION_RINGS_MAX);
        /* one crossing of an element by the contact's edge */
        enum percuss_status status = cross(passage, node);
        if (status != PERCUSS_OK)
            return status;
        if (run->rings == 0)
            continue;
        /* still elastic: only the last such ring is kept */
        if (!flowed && !flows(passage->region)) {
            restart(run, &mesh_error);
            continue;
        }
        /* the first with flow: from here on the curve is a table's */
        if (!flowed)
            add_elastic_branch(run);
        flowed = true;
        /* its force without the mesh's elastic error, and a branch every so many crossings */
        double force = run->ratio[run->rings] * passage->hertz * pow(passage->edge, 1.5);
        run->ratio[run->rings - 1] /= mesh_error;
        if (plan->branch_every && run->rings % plan->branch_every == 0)
            status = add_branch(passage, force);
        if (status != PERCUSS_OK)
            return status;
        if (!go_on(passage))
            return fault_set(passage->fault, PERCUSS_TIMEOUT, "indentation: stopped at %g m",
                             passage->edge);
    }
    /* nothing flowed up to the end */
    if (run->branches == 0)
        add_elastic_branch(run);
    /* the last branch must not lie below the last ring */
    else if (plan->branch_every && run->largest[run->branches - 1] < passage->edge)
        return add_branch(passage,
                          run->ratio[run->rings] * passage->hertz * pow(passage->edge, 1.5));
    return PERCUSS_OK;
}

enum percuss_status indentation_run(const struct indentation_plan *plan,
                                    struct indentation_run *run, struct fault *fault)
{
    struct passage passage = {.plan = plan,
                              .run = run,
                              .pace = {.watch = plan->watch},
                              .hertz = indentation_hertz(&plan->input),
                              .factor = 1.0,
                              .fault = fault};
    run->rings = run->branches = 0;
    enum percuss_status status = region_create(&plan->input, &passage.region, fault);
    if (status == PERCUSS_OK) {
        region_watch(passage.region, &passage.pace, plan->done);
        status = pass(&passage);
        run->effort = region_effort(passage.region);
    }
    region_destroy(passage.region);
    return status;
}

enum { STEPS = 8, BRANCH_EVERY = 3 };

/* The table from four passages. */

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
        /* steps: a second extrapolation would bring well below a third of the first */
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
