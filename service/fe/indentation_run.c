/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/indentation_run.h"

#include <math.h>

struct passage {
    const struct indentation_plan *plan;
    struct indentation_run *run;
    struct region *region;
    struct pace pace; /* asks whoever is told of the progress, within the region's solutions too */
    double hertz;
    double edge;   /* m, indentation at the last edge */
    double factor; /* between the last two edges */
    struct fault *fault;
};

double indentation_hertz(const struct region_input *input)
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

/* From the state whose contact edge is at one node to that of the next, in steps; the mean over the
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
        /* short of the edge: beyond it the way back would be an unloading */
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

/* Unloads from the committed state, which stays. Unloading is elastic, the dent conforming to what
 * made it, so that each sample may be reached in one step. */
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

/* the last elastic ring becomes ring 0, and what its ratio is off 1 is the mesh's error */
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
        /* its force without the mesh's elastic error, and now and then a branch */
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
