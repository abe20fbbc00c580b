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
    /* room for the compliance of both together */
    enum percuss_status status = PERCUSS_OK;
    collider->compliance = calloc(count * count, sizeof(double));
    if (!collider->compliance)
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory for %zu contact nodes", count);
    /* each body: a fine step in contact, a coarse one in flight */
    for (int b = 0; b < 2 && status == PERCUSS_OK; b++) {
        const struct system3 *system = &pair->systems[b];
        status = pace3_create(system, RATIONAL_RADAU, contact_step, &collider->contact[b], fault);
        if (status == PERCUSS_OK)
            status = pace3_create(system, RATIONAL_GAUSS, flight_step, &collider->flight[b], fault);
        /* what the contact's nodes do to each other in a fine step */
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

/* One impact while it goes on. */
struct run {
    const struct collider *collider;
    double approach; /* m/s */
    struct collision *now;
    struct moving moving[2];
    size_t count;
    double *forces; /* [count], N, of a quarter: at the step's beginning */
    struct active_set set;
    double total;    /* N, at the end of the step that is tried */
    bool near;       /* short steps */
    double near_gap; /* m */
};

/* All of them. */
struct runs {
    const struct collider *collider;
    const struct collision_settings *settings;
    size_t count;
    struct run *run;
    struct run **chosen;   /* those that take the same kind of step */
    double complex *right; /* of the larger body, [count] */
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

void collision_keep(struct collision *now, double before, double after, double step)
{
    now->force = after;
    if (!(before > 0.0 || after > 0.0))
        return;
    /* an opening shorter than a step does not divide a sub-impact */
    struct collision_sub_impact *sub = &now->sub_impact[now->sub_impacts - (now->sub_impacts > 0)];
    bool goes_on = now->sub_impacts > 0 && sub->end > now->time - 1.5 * step;
    if (!goes_on && now->sub_impacts < COLLISION_SUB_IMPACTS) {
        sub = &now->sub_impact[now->sub_impacts++];
        *sub = (struct collision_sub_impact){.start = now->time - step};
    }
    /* forces go linearly */
    double impulse = 0.5 * (before + after) * step;
    sub->end = now->time;
    sub->impulse += impulse;
    sub->peak_force = fmax(sub->peak_force, after);
    now->impulse += impulse;
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
}

/* What a step is made of. */
enum part { FREE, PRESSED };

/* one part of the step of the chosen runs' body b, all at once */
static bool solve_chosen(const struct runs *runs, size_t chosen, int b, const struct pace3 *pace,
                         enum part part)
{
    size_t n = runs->collider->pair->systems[b].freedoms;
    for (size_t i = 0; i < chosen; i++) {
        struct run *run = runs->chosen[i];
        if (part == FREE)
            moving_load(&run->moving[b], pace, run->now->force > 0.0 ? run->forces : NULL,
                        runs->right + i * n);
        else
            moving_load_end(&run->moving[b], pace, run->forces, runs->right + i * n);
    }
    if (!kept_factor_solve(pace->factor, chosen, runs->right))
        return false;
    for (size_t i = 0; i < chosen; i++) {
        struct moving *moving = &runs->chosen[i]->moving[b];
        (part == FREE ? moving_try : moving_press)(moving, pace, runs->right + i * n);
    }
    return true;
}

/* the forces at the end of the step, from where the bodies would be without */
static bool find_forces(struct run *run)
{
    const struct pressed *sphere = &run->collider->pair->pressed[PAIR_SPHERE];
    double *initial = (double *)run->set.initial;
    for (size_t i = 0; i < run->count; i++)
        initial[i] = tried_gap(run, i);
    if (!active_set_solve(&run->set))
        return false;
    /* what all of them are along z */
    run->total = 0.0;
    run->now->active = 0;
    for (size_t i = 0; i < run->count; i++) {
        run->forces[i] = run->set.force[i];
        run->total += QUARTERS * run->forces[i] * sphere->directions[i][2];
        run->now->active += run->set.active[i];
    }
    return true;
}

static size_t choose(const struct runs *runs, bool near)
{
    size_t chosen = 0;
    for (size_t i = 0; i < runs->count; i++) {
        struct run *run = &runs->run[i];
        bool going = !run->now->over && run->now->time < runs->settings->horizon;
        if (going && run->near == near)
            runs->chosen[chosen++] = run;
    }
    return chosen;
}

static enum percuss_status contact_steps(const struct runs *runs, size_t chosen,
                                         struct fault *fault)
{
    const struct collider *collider = runs->collider;
    bool solved = true, pressing = false;
    /* as if no force were left at the step's end, then the forces that are */
    for (int b = 0; b < 2; b++)
        solved = solved && solve_chosen(runs, chosen, b, &collider->contact[b], FREE);
    for (size_t i = 0; i < chosen && solved; i++) {
        solved = find_forces(runs->chosen[i]);
        pressing |= runs->chosen[i]->total > 0.0;
    }
    for (int b = 0; b < 2 && pressing; b++)
        solved = solved && solve_chosen(runs, chosen, b, &collider->contact[b], PRESSED);
    if (!solved)
        return fault_set(fault, PERCUSS_INTERNAL,
                         "no set of pressing nodes was found, or a factor failed");
    for (size_t i = 0; i < chosen; i++) {
        struct run *run = runs->chosen[i];
        double gap = run->total > 0.0 ? 0.0 : least_gap(run), before = run->now->force;
        accept(run, collider->contact_step);
        collision_keep(run->now, before, run->total, collider->contact_step);
        run->now->contact_steps++;
        run->near = gap < run->near_gap;
    }
    return PERCUSS_OK;
}

static enum percuss_status flight_steps(const struct runs *runs, size_t chosen, struct fault *fault)
{
    const struct collider *collider = runs->collider;
    bool solved = true;
    for (int b = 0; b < 2; b++)
        solved = solved && solve_chosen(runs, chosen, b, &collider->flight[b], FREE);
    if (!solved)
        return fault_set(fault, PERCUSS_INTERNAL, "a factor failed");
    for (size_t i = 0; i < chosen; i++) {
        /* a step that ends in a contact is taken back */
        struct run *run = runs->chosen[i];
        double gap = least_gap(run);
        run->near = gap < run->near_gap;
        if (gap < 0.0) {
            run->now->refused++;
            continue;
        }
        accept(run, collider->flight_step);
        run->now->flight_steps++;
    }
    return PERCUSS_OK;
}

/* energies; whether vibration can no longer close the gap */
static void look(struct run *run, const struct collision_settings *settings)
{
    struct collision *now = run->now;
    const double *mass = run->collider->pair->mass;
    double reduced = 1.0 / (1.0 / mass[0] + 1.0 / mass[1]);
    double rate = now->speed[PAIR_SPHERE] - now->speed[PAIR_BEAM];
    now->available = 0.5 * reduced * pow(run->approach, 2.0);
    now->rebound = 0.5 * reduced * rate * rate;
    now->vibration =
        QUARTERS * (moving_vibration(&run->moving[0]) + moving_vibration(&run->moving[1]));
    now->restitution = now->impulse / (reduced * run->approach) - 1.0;
    double open = now->place[PAIR_SPHERE] - now->place[PAIR_BEAM];
    now->over = settings->compliance > 0.0 && rate > 0.0 &&
                open > sqrt(2.0 * now->vibration * settings->compliance);
}

static enum percuss_status prepare(struct run *run, struct fault *fault)
{
    const struct pair *pair = run->collider->pair;
    size_t count = pair->pressed[0].count;
    double rise[2] = {0.0, -run->approach};
    /* near at first: fine steps */
    run->count = count;
    run->near = true;
    run->near_gap = NEAR_STEPS * run->approach * run->collider->flight_step;
    /* the second body comes at the first */
    for (int b = 0; b < 2; b++) {
        enum percuss_status status =
            moving_create(&pair->systems[b], &pair->pressed[b], rise[b], &run->moving[b], fault);
        if (status != PERCUSS_OK)
            return status;
        run->now->factor += kept_factor_size(run->collider->contact[b].factor);
    }
    /* room for the forces, and for which nodes touch */
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

static enum percuss_status prepare_all(struct runs *runs, const double *approach,
                                       struct collision *collisions, struct fault *fault)
{
    const struct system3 *systems = runs->collider->pair->systems;
    size_t most =
        systems[0].freedoms > systems[1].freedoms ? systems[0].freedoms : systems[1].freedoms;
    runs->run = calloc(runs->count, sizeof *runs->run);
    runs->chosen = calloc(runs->count, sizeof *runs->chosen);
    runs->right = malloc(runs->count * most * sizeof *runs->right);
    if (!runs->run || !runs->chosen || !runs->right)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory for %zu impacts", runs->count);
    memset(collisions, 0, runs->count * sizeof *collisions);
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; i < runs->count && status == PERCUSS_OK; i++) {
        runs->run[i] = (struct run){
            .collider = runs->collider, .approach = approach[i], .now = &collisions[i]};
        status = prepare(&runs->run[i], fault);
    }
    return status;
}

static void release(struct runs *runs)
{
    for (size_t i = 0; runs->run && i < runs->count; i++) {
        struct run *run = &runs->run[i];
        for (int b = 0; b < 2; b++)
            moving_free(&run->moving[b]);
        free(run->forces);
        free((double *)run->set.initial);
        free(run->set.force);
        free(run->set.active);
        free(run->set.scratch);
    }
    free(runs->run);
    free(runs->chosen);
    free(runs->right);
}

/* after a step of the chosen runs: those in flight are looked at now and then */
static void report(const struct runs *runs, size_t chosen, bool near)
{
    const struct collision_settings *settings = runs->settings;
    for (size_t i = 0; i < chosen; i++) {
        struct run *run = runs->chosen[i];
        if (settings->record)
            settings->record(settings->context, (size_t)(run - runs->run), run->now);
        if (!near && run->now->flight_steps % LOOK_EVERY == 0)
            look(run, settings);
    }
}

enum percuss_status collider_run(const struct collider *collider,
                                 const struct collision_settings *settings, size_t count,
                                 const double *approach, struct collision *collisions,
                                 struct fault *fault)
{
    struct runs runs = {.collider = collider, .settings = settings, .count = count};
    enum percuss_status status = prepare_all(&runs, approach, collisions, fault);
    bool going = true;
    /* runs in flight step together, then those in contact */
    while (status == PERCUSS_OK && going) {
        going = false;
        for (int near = 0; near < 2 && status == PERCUSS_OK; near++) {
            size_t chosen = choose(&runs, near);
            if (chosen == 0)
                continue;
            going = true;
            status = (near ? contact_steps : flight_steps)(&runs, chosen, fault);
            report(&runs, chosen, near);
        }
        /* between steps it can be stopped */
        if (!pace_ask(settings->pace, collisions[0].time / settings->horizon))
            status = pace_fault(fault, PERCUSS_TIMEOUT);
    }
    /* a last look at each */
    for (size_t i = 0; i < count && status == PERCUSS_OK; i++)
        look(&runs.run[i], settings);
    release(&runs);
    return status;
}
