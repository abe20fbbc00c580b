/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/collision.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fe/active_set.h"

/* What is symmetric about two planes has four quarters. */
static const double QUARTERS = 4.0;
/* Short steps begin where the bodies are nearer than so many flight steps of the approach: a node's
 * own vibration is slower than twice the approach. */
static const double NEAR_STEPS = 3.0;
/* Flight steps from one look at the energies to the next. */
static const size_t LOOK_EVERY = 20;

enum percuss_status collider_create(const struct pair *pair, double contact_step,
                                    double flight_step, struct collider *collider,
                                    struct fault *fault)
{
    *collider =
        (struct collider){.pair = pair, .contact_step = contact_step, .flight_step = flight_step};
    size_t count = pair->pressed[0].count;
    enum percuss_status status = PERCUSS_OK;
    collider->compliance = calloc(count * count, sizeof(double));
    if (!collider->compliance)
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory for %zu contact nodes", count);
    for (int b = 0; b < 2 && status == PERCUSS_OK; b++) {
        const struct system3 *system = &pair->systems[b];
        status = pace3_create(system, RATIONAL_RADAU, contact_step, &collider->contact[b], fault);
        if (status == PERCUSS_OK)
            status = pace3_create(system, RATIONAL_GAUSS, flight_step, &collider->flight[b], fault);
        if (status == PERCUSS_OK &&
            !pressed_add_compliance(system, &pair->pressed[b], &collider->contact[b],
                                    collider->compliance))
            status = fault_set(fault, PERCUSS_INTERNAL, "compliance of the contact nodes: failed");
    }
    if (status != PERCUSS_OK)
        collider_free(collider);
    return status;
}

void collider_free(struct collider *collider)
{
    for (int b = 0; b < 2; b++) {
        pace3_free(&collider->contact[b]);
        pace3_free(&collider->flight[b]);
    }
    free(collider->compliance);
    memset(collider, 0, sizeof *collider);
}

/* A run while it goes on. */
struct run {
    const struct collider *collider;
    const struct collision_settings *settings;
    struct collision *now;
    struct moving moving[2];
    size_t count;
    double *forces; /* [count], N, of a quarter: at the step's beginning */
    struct active_set set;
    bool touching, near; /* a sub-impact is going on; short steps */
    double near_gap;     /* m */
};

static double tried_gap(const struct run *run, size_t i)
{
    return run->collider->pair->initial[i] + moving_at(&run->moving[0], i, true) +
           moving_at(&run->moving[1], i, true);
}

static double least_gap(const struct run *run)
{
    double least = INFINITY;
    for (size_t i = 0; i < run->count; i++)
        least = fmin(least, tried_gap(run, i));
    return least;
}

/* counts an interval of contact */
static void keep_books(struct run *run, double before, double after, double step)
{
    struct collision *now = run->now;
    bool closed = before > 0.0 || after > 0.0;
    if (closed && !run->touching && now->sub_impacts < COLLISION_SUB_IMPACTS) {
        now->sub_impact[now->sub_impacts] =
            (struct collision_sub_impact){.start = now->time - step};
        now->sub_impacts++;
    }
    run->touching = closed;
    now->force = after;
    if (!closed)
        return;
    struct collision_sub_impact *sub = &now->sub_impact[now->sub_impacts - 1];
    sub->end = now->time;
    sub->impulse += 0.5 * (before + after) * step;
    sub->peak_force = fmax(sub->peak_force, after);
    now->impulse += 0.5 * (before + after) * step;
}

/* the next state is the present one */
static void accept(struct run *run, double step)
{
    struct collision *now = run->now;
    now->time += step;
    for (int b = 0; b < 2; b++) {
        moving_accept(&run->moving[b]);
        const struct system3 *system = run->moving[b].system;
        now->place[b] = system3_mean(system, run->moving[b].u, 2);
        now->speed[b] = system3_mean(system, run->moving[b].v, 2);
    }
    now->middle = run->moving[PAIR_BEAM].u[3 * run->collider->pair->axis + 2];
    now->solutions = run->moving[0].solutions + run->moving[1].solutions;
}

static enum percuss_status contact_step(struct run *run, struct fault *fault)
{
    const struct collider *collider = run->collider;
    struct collision *now = run->now;
    bool pressed = now->force > 0.0, solved = true;
    /* as if no force were left at the step's end */
    for (int b = 0; b < 2; b++)
        solved = solved &&
                 moving_try(&run->moving[b], &collider->contact[b], pressed ? run->forces : NULL);
    double *initial = (double *)run->set.initial;
    for (size_t i = 0; i < run->count; i++)
        initial[i] = tried_gap(run, i);
    if (!solved || !active_set_solve(&run->set))
        return fault_set(fault, PERCUSS_INTERNAL, "no set of pressing nodes at %g s", now->time);
    /* the forces that are, and what all of them are along z */
    double total = 0.0;
    now->active = 0;
    for (size_t i = 0; i < run->count; i++) {
        run->forces[i] = run->set.force[i];
        total += QUARTERS * run->forces[i] * collider->pair->pressed[PAIR_SPHERE].directions[i][2];
        now->active += run->set.active[i];
    }
    for (int b = 0; b < 2 && total > 0.0; b++)
        solved = solved && moving_press(&run->moving[b], &collider->contact[b], run->forces);
    if (!solved)
        return fault_set(fault, PERCUSS_INTERNAL, "a factor failed at %g s", now->time);
    double gap = total > 0.0 ? 0.0 : least_gap(run), before = now->force;
    accept(run, collider->contact_step);
    keep_books(run, before, total, collider->contact_step);
    now->contact_steps++;
    run->near = gap < run->near_gap;
    return PERCUSS_OK;
}

static enum percuss_status flight_step(struct run *run, struct fault *fault)
{
    const struct collider *collider = run->collider;
    bool solved = true;
    for (int b = 0; b < 2; b++)
        solved = solved && moving_try(&run->moving[b], &collider->flight[b], NULL);
    if (!solved)
        return fault_set(fault, PERCUSS_INTERNAL, "a factor failed at %g s", run->now->time);
    double gap = least_gap(run);
    run->near = gap < run->near_gap;
    if (gap < 0.0) {
        run->now->refused++;
        return PERCUSS_OK;
    }
    accept(run, collider->flight_step);
    run->now->flight_steps++;
    return PERCUSS_OK;
}

/* energies; whether vibration can no longer close the gap */
static void look(struct run *run)
{
    struct collision *now = run->now;
    const double *mass = run->collider->pair->mass;
    double reduced = 1.0 / (1.0 / mass[0] + 1.0 / mass[1]);
    double rate = now->speed[PAIR_SPHERE] - now->speed[PAIR_BEAM];
    now->available = 0.5 * reduced * pow(run->settings->approach, 2.0);
    now->rebound = 0.5 * reduced * rate * rate;
    now->vibration =
        QUARTERS * (moving_vibration(&run->moving[0]) + moving_vibration(&run->moving[1]));
    now->restitution = now->impulse / (reduced * run->settings->approach) - 1.0;
    double open = now->place[PAIR_SPHERE] - now->place[PAIR_BEAM];
    now->over = run->settings->compliance > 0.0 && rate > 0.0 &&
                open > sqrt(2.0 * now->vibration * run->settings->compliance);
}

static enum percuss_status prepare(struct run *run, struct fault *fault)
{
    const struct pair *pair = run->collider->pair;
    size_t count = pair->pressed[0].count;
    double rise[2] = {0.0, -run->settings->approach};
    run->count = count;
    run->near = true;
    run->near_gap = NEAR_STEPS * run->settings->approach * run->collider->flight_step;
    for (int b = 0; b < 2; b++) {
        enum percuss_status status =
            moving_create(&pair->systems[b], &pair->pressed[b], rise[b], &run->moving[b], fault);
        if (status != PERCUSS_OK)
            return status;
    }
    run->forces = calloc(count, sizeof(double));
    run->set = (struct active_set){.kind = ACTIVE_SET_BY_INDENTATION,
                                   .count = count,
                                   .compliance = run->collider->compliance,
                                   .initial = calloc(count, sizeof(double)),
                                   .force = calloc(count, sizeof(double)),
                                   .active = calloc(count, sizeof(bool)),
                                   .scratch = malloc((count + 1) * (count + 3) * sizeof(double))};
    if (!run->forces || !run->set.initial || !run->set.force || !run->set.active ||
        !run->set.scratch)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory for %zu contact nodes", count);
    return PERCUSS_OK;
}

static void release(struct run *run)
{
    for (int b = 0; b < 2; b++)
        moving_free(&run->moving[b]);
    free(run->forces);
    free((double *)run->set.initial);
    free(run->set.force);
    free(run->set.active);
    free(run->set.scratch);
}

enum percuss_status collider_run(const struct collider *collider,
                                 const struct collision_settings *settings,
                                 struct collision *collision, struct fault *fault)
{
    memset(collision, 0, sizeof *collision);
    for (int b = 0; b < 2; b++)
        collision->factor += kept_factor_size(collider->contact[b].factor);
    struct run run = {.collider = collider, .settings = settings, .now = collision};
    enum percuss_status status = prepare(&run, fault);
    while (status == PERCUSS_OK && !collision->over && collision->time < settings->horizon) {
        status = run.near ? contact_step(&run, fault) : flight_step(&run, fault);
        if (status == PERCUSS_OK && settings->record)
            settings->record(settings->context, collision);
        if (status == PERCUSS_OK && !run.near && collision->flight_steps % LOOK_EVERY == 0)
            look(&run);
        if (!pace_ask(settings->pace, collision->time / settings->horizon))
            status = pace_fault(fault, PERCUSS_TIMEOUT);
    }
    if (status == PERCUSS_OK)
        look(&run);
    release(&run);
    return status;
}
