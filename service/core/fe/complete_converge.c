/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/complete_converge.h"

#include <math.h>

/* ---- the mean of impacts on several meshes ---- */

static void add_weighted(double weight, double value, double *sum)
{
    *sum += weight * value;
}

static void add_energy(double weight, const struct complete_energy *energy,
                       struct complete_energy *sum)
{
    add_weighted(weight, energy->available, &sum->available);
    add_weighted(weight, energy->rebound, &sum->rebound);
    add_weighted(weight, energy->vibration, &sum->vibration);
    for (size_t b = 0; b < 2; b++)
        add_weighted(weight, energy->vibration_of[b], &sum->vibration_of[b]);
    add_weighted(weight, energy->plastic, &sum->plastic);
    add_weighted(weight, energy->contact, &sum->contact);
    add_weighted(weight, energy->closure, &sum->closure);
}

static void add_sub_impact(double weight, const struct complete_sub_impact *one,
                           struct complete_sub_impact *sum)
{
    add_weighted(weight, one->start, &sum->start);
    add_weighted(weight, one->end, &sum->end);
    add_weighted(weight, one->impulse, &sum->impulse);
    add_weighted(weight, one->peak_force, &sum->peak_force);
    add_weighted(weight, one->max_indentation, &sum->max_indentation);
    add_weighted(weight, one->compression_end, &sum->compression_end);
    add_weighted(weight, one->compression_impulse, &sum->compression_impulse);
}

static void add_result(double weight, const struct complete_result *result,
                       struct complete_result *sum)
{
    add_weighted(weight, result->impulse, &sum->impulse);
    add_weighted(weight, result->restitution, &sum->restitution);
    add_weighted(weight, result->contact_time, &sum->contact_time);
    add_weighted(weight, result->peak_force, &sum->peak_force);
    add_weighted(weight, result->max_indentation, &sum->max_indentation);
    add_weighted(weight, result->contact_radius, &sum->contact_radius);
    add_weighted(weight, result->end_time, &sum->end_time);
    sum->momentum_error = fmax(sum->momentum_error, result->momentum_error);
    add_energy(weight, &result->energy, &sum->energy);
    for (size_t i = 0; i < result->sub_impacts && i < COMPLETE_SUB_IMPACTS; i++)
        add_sub_impact(weight, &result->sub_impact[i], &sum->sub_impact[i]);
}

bool complete_mean(const struct complete_result *results, const double *weights, size_t count,
                   struct complete_result *mean)
{
    /* alike, and the heaviest */
    size_t heaviest = 0;
    for (size_t k = 0; k < count; k++) {
        if (results[k].sub_impacts != results[0].sub_impacts || results[k].end != results[0].end)
            return false;
        if (weights[k] > weights[heaviest])
            heaviest = k;
    }
    /* its counts */
    const struct complete_result *from = &results[heaviest];
    *mean = (struct complete_result){
        .mass = {from->mass[0], from->mass[1]},
        .sub_impacts = from->sub_impacts,
        .end = from->end,
        .elements = from->elements,
        .plastic_elements = from->plastic_elements,
        .steps = from->steps,
        .levels = from->levels,
        .step = from->step,
    };
    for (size_t k = 0; k < count; k++)
        add_result(weights[k], &results[k], mean);
    return true;
}

/* ---- the limit for small elements ---- */

/* cost of a mesh over that of one half as fine */
static const double TWICE_AS_FINE = 8.0;
/* most solutions that aim at the limit */
enum { AIMS = 3 };
/* allowed distance of the answer from the limit, over the limit's error */
static const double OFF_LIMIT = 0.25;

/* Error of the limit for means without jitter; sets limit and order. */
static double judge_bias(struct complete_convergence *convergence)
{
    const struct swing *swing = convergence->swing;
    const struct swing *finest = &swing[convergence->meshes - 1];
    convergence->restitution = finest->mean;
    convergence->order = NAN;
    if (convergence->meshes < 2)
        return INFINITY;
    /* two meshes: their difference; three: its order too */
    double first = swing[1].mean - swing[0].mean;
    if (convergence->meshes == 2)
        return fabs(first);
    double second = swing[2].mean - swing[1].mean;
    convergence->order = log2(fabs(first / second));
    /* A change of sign is no order: nothing to extrapolate. Two means may lie close together by
     * chance: the error is at least half of the remainder of the first difference at second
     * order. */
    double order = fmin(fmax(convergence->order, 1.0), 2.0);
    if (first * second > 0.0)
        convergence->restitution += second / (exp2(order) - 1.0);
    return fmax(fabs(second), fabs(first) / 8.0);
}

void complete_converge_judge(struct complete_convergence *convergence)
{
    const struct swing *finest = &convergence->swing[convergence->meshes - 1];
    double bias = fmax(judge_bias(convergence), SWING_IN_MEAN * finest->width);
    convergence->error = bias + finest->jitter;
}

/* State while meshes are added. */
struct search {
    struct complete_convergence *convergence;
    struct complete_problem problem; /* as given, but for the progress, mesh and phase */
    struct complete_result latest[SWING_PHASES]; /* of the finest mesh */
    struct complete_result aimed;                /* at the limit */
};

static enum percuss_status solve_one(struct search *search, double phase,
                                     struct complete_result *result, struct fault *fault)
{
    unsigned finer = COMPLETE_MESHES - search->convergence->meshes;
    search->problem.phase = phase;
    search->problem.share = pow(TWICE_AS_FINE, -(double)finer) / (2 * SWING_PHASES);
    enum percuss_status status = impact_complete_solve(&search->problem, result, fault);
    search->problem.done += search->problem.share;
    return status;
}

/* Solves the phases that `count` evenly spread ones lack. */
static enum percuss_status add_phases(struct search *search, unsigned count, struct fault *fault)
{
    struct swing *swing = &search->convergence->swing[search->convergence->meshes - 1];
    /* the known ones in their places among so many */
    unsigned stride = swing->phases ? count / swing->phases : 0;
    for (unsigned k = swing->phases; k-- > 0;) {
        search->latest[k * stride] = search->latest[k];
        swing->restitution[k * stride] = swing->restitution[k];
    }
    /* the others */
    for (unsigned k = 0; k < count; k++) {
        if (stride && k % stride == 0)
            continue;
        enum percuss_status status =
            solve_one(search, (double)k / count, &search->latest[k], fault);
        if (status != PERCUSS_OK)
            return status;
        swing->restitution[k] = search->latest[k].restitution;
    }
    /* the mean of the phases and the limit that follows */
    swing->phases = count;
    swing_judge(swing);
    complete_converge_judge(search->convergence);
    return PERCUSS_OK;
}

static enum percuss_status add_mesh(struct search *search, unsigned finest, struct fault *fault)
{
    unsigned mesh = search->convergence->meshes++;
    search->problem.cells = finest >> (COMPLETE_MESHES - 1 - mesh);
    search->convergence->swing[mesh] = (struct swing){.cells = search->problem.cells};
    return add_phases(search, SWING_PHASES / 2, fault);
}

static void answer_with(struct search *search, const struct complete_result *result)
{
    struct complete_convergence *convergence = search->convergence;
    double off = fabs(result->restitution - convergence->restitution);
    if (!(convergence->error + off < convergence->result_error))
        return;
    convergence->result = *result;
    convergence->cells = search->problem.cells;
    convergence->result_error = convergence->error + off;
}

/* Solves between the two phases around the limit until one is near it. */
static enum percuss_status aim(struct search *search, const struct swing *swing,
                               struct fault *fault)
{
    struct complete_convergence *convergence = search->convergence;
    const double allowed = (1.0 + OFF_LIMIT) * convergence->error;
    struct swing_bracket bracket;
    double phase = swing_phase(swing, convergence->restitution, &bracket);
    for (int i = 0; i < AIMS && convergence->result_error > allowed && isfinite(phase); i++) {
        enum percuss_status status = solve_one(search, fmod(phase, 1.0), &search->aimed, fault);
        if (status != PERCUSS_OK)
            return status;
        answer_with(search, &search->aimed);
        phase = swing_narrow(&bracket, phase, search->aimed.restitution - convergence->restitution);
    }
    return PERCUSS_OK;
}

/* The weighted mean of the finest mesh's phases that equals the limit; where their sub-impacts
 * differ or one phase is nearer, that phase, or one aimed at the limit. */
static enum percuss_status choose(struct search *search, struct fault *fault)
{
    struct complete_convergence *convergence = search->convergence;
    const struct swing *swing = &convergence->swing[convergence->meshes - 1];
    double weights[SWING_PHASES];
    swing_weigh(swing, convergence->restitution, weights);
    convergence->result_error = INFINITY;
    bool alike = complete_mean(search->latest, weights, swing->phases, &search->aimed);
    if (alike)
        answer_with(search, &search->aimed);
    for (unsigned k = 0; k < swing->phases; k++)
        answer_with(search, &search->latest[k]);
    return alike ? PERCUSS_OK : aim(search, swing, fault);
}

enum percuss_status complete_converge(const struct complete_problem *problem, double tolerance,
                                      struct complete_convergence *convergence, struct fault *fault)
{
    struct search search = {.convergence = convergence, .problem = *problem};
    search.problem.done = 0.0;
    search.problem.sample = NULL;
    *convergence = (struct complete_convergence){.error = INFINITY};
    if (problem->cells < 16 || problem->cells % 4)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "cells: %u: must be 16, 20, ...",
                         problem->cells);
    /* finer meshes until the error fits */
    tolerance /= 1.0 + OFF_LIMIT;
    enum percuss_status status = PERCUSS_OK;
    while (status == PERCUSS_OK && convergence->meshes < COMPLETE_MESHES &&
           convergence->error > tolerance) {
        status = add_mesh(&search, problem->cells, fault);
        /* the other phases of a mesh cost little beside the next mesh, which is compared with it */
        double jitter = convergence->swing[convergence->meshes - 1].jitter;
        if (status == PERCUSS_OK && convergence->error > tolerance && jitter > 0.1 * tolerance)
            status = add_phases(&search, SWING_PHASES, fault);
    }
    return status == PERCUSS_OK ? choose(&search, fault) : status;
}
