/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/collision.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "fe/active_set.h"
#include "spatial/places.h"

/* Nodes that face each other are nearer than this across the normal: m. */
static const double FACING = 1e-9;
/* Bodies symmetric about two planes have four quarters. */
static const double QUARTERS = 4.0;
/* Sides of the sphere's face with the contact over its radius, at most, and layers below it. */
static const double SPHERE_FACE = 0.6;
static const size_t SPHERE_LAYERS = 2;

static enum percuss_status check(const struct pair_input *input, struct fault *fault)
{
    if (input->bricks < 4 || input->bricks > 1000)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "bricks: %zu: must be 4 ... 1000",
                         input->bricks);
    if (0.25 * input->beam_length / (double)input->bricks > SPHERE_FACE * input->sphere_radius)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "bricks: %zu: half of one must be shorter than %g of the sphere's radius",
                         input->bricks, SPHERE_FACE);
    if (input->across < 1 || input->across > 4)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "across: %zu: must be 1 ... 4", input->across);
    if (input->levels < 1 || input->levels > 10)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "levels: %u: must be 1 ... 10", input->levels);
    return PERCUSS_OK;
}

static void masses(const struct pair_input *input, double mass[2])
{
    mass[PAIR_BEAM] = input->materials[PAIR_BEAM].density * M_PI * pow(input->beam_radius, 2.0) *
                      input->beam_length;
    mass[PAIR_SPHERE] =
        input->materials[PAIR_SPHERE].density * 4.0 / 3.0 * M_PI * pow(input->sphere_radius, 3.0);
}

/* Hertz's contact, and the ellipse of the hardest impact of bodies that are rigid but for the
 * contact, where 2/5 k d^(5/2) is the energy of the approach. */
static void size_contact(struct pair *pair)
{
    const struct pair_input *input = &pair->input;
    double along = 0.5 / input->sphere_radius, across = along + 0.5 / input->beam_radius;
    pair->hertz = hertz_contact_make(
        hertz_effective_modulus(&input->materials[0], &input->materials[1]), along, across);
    double mass[2];
    masses(input, mass);
    double energy = 0.5 * pow(input->velocity, 2.0) / (1.0 / mass[0] + 1.0 / mass[1]);
    double approach = pow(energy / (HERTZ_WORK * pair->hertz.stiffness), 0.4);
    hertz_ellipse(&pair->hertz, pair->hertz.stiffness * pow(approach, 1.5), pair->axes);
}

static enum percuss_status make_body(struct pair *pair, int which, const struct shape *shape,
                                     unsigned levels, struct fault *fault)
{
    enum percuss_status status = refined_create(shape, levels, &pair->meshes[which], fault);
    if (status == PERCUSS_OK)
        status = system3_create(&pair->meshes[which], &pair->input.materials[which],
                                &pair->systems[which], fault);
    pair->mass[which] = QUARTERS * pair->systems[which].whole;
    return status;
}

/* The pair's shapes, radii times `swell`, finest where they may touch and as deep as the pressure
 * varies most. The sphere, which is rounder, has bricks of half the size before they are halved. */
static void make_shapes(const struct pair *pair, const double swell[2], struct shape shapes[2])
{
    const struct pair_input *input = &pair->input;
    shapes[PAIR_BEAM] = shape_beam(swell[PAIR_BEAM] * input->beam_radius, input->beam_length,
                                   input->bricks, input->across);
    const double *brick = shapes[PAIR_BEAM].brick;
    double radius = swell[PAIR_SPHERE] * input->sphere_radius;
    double half[2] = {0.5 * brick[0], 0.5 * brick[1]};
    size_t count[3] = {(size_t)(SPHERE_FACE * radius / half[0]),
                       (size_t)(SPHERE_FACE * radius / half[1]), SPHERE_LAYERS};
    shapes[PAIR_SPHERE] = shape_sphere(radius, half, count);
    for (int b = 0; b < 2; b++) {
        shapes[b].core[0] = pair->axes[0];
        shapes[b].core[1] = pair->axes[1];
        shapes[b].core[2] = 0.5 * pair->axes[1];
    }
}

/* Both bodies. Quadratic bricks cut corners off circles: radii a little larger make up for the
 * mass, by which a beam has its stiffness too. */
static enum percuss_status make_bodies(struct pair *pair, struct fault *fault)
{
    const struct pair_input *input = &pair->input;
    enum percuss_status status = PERCUSS_OK;
    struct shape shapes[2];
    double swell[2] = {1.0, 1.0}, exact[2];
    masses(input, exact);
    /* missing mass, before bricks are halved */
    make_shapes(pair, swell, shapes);
    for (int b = 0; b < 2 && status == PERCUSS_OK; b++) {
        status = make_body(pair, b, &shapes[b], 0, fault);
        swell[b] = pow(exact[b] / pair->mass[b], b == PAIR_BEAM ? 1.0 / 2.0 : 1.0 / 3.0);
        refined_free(&pair->meshes[b]);
        system3_free(&pair->systems[b]);
    }
    make_shapes(pair, swell, shapes);
    for (int b = 0; b < 2 && status == PERCUSS_OK; b++)
        status = make_body(pair, b, &shapes[b], input->levels - (b == PAIR_SPHERE), fault);
    return status;
}

/* Direction of the pressure at (x, y): across the surface on which both bodies meet under load, of
 * which each has given way by its share of the compliance. */
static void direction_at(const struct pair *pair, double x, double y, double normal[3])
{
    const struct pair_input *input = &pair->input;
    double soft[2];
    for (int b = 0; b < 2; b++)
        soft[b] = (1.0 - pow(input->materials[b].poisson, 2.0)) / input->materials[b].young;
    double share = soft[PAIR_BEAM] / (soft[PAIR_BEAM] + soft[PAIR_SPHERE]);
    double sphere = 1.0 / input->sphere_radius, beam = 1.0 / input->beam_radius;
    normal[0] = -x * share * sphere;
    normal[1] = -y * (share * (sphere + beam) - beam);
    double length = sqrt(1.0 + normal[0] * normal[0] + normal[1] * normal[1]);
    normal[0] /= length;
    normal[1] /= length;
    normal[2] = 1.0 / length;
}

static double gap_at(const struct pair *pair, double x, double y)
{
    double sphere = pair->input.sphere_radius, beam = pair->input.beam_radius;
    return sphere - sqrt(sphere * sphere - x * x - y * y) + beam - sqrt(beam * beam - y * y);
}

static bool take_room(struct pair *pair, size_t count)
{
    pair->initial = malloc(count * sizeof *pair->initial);
    bool taken = pair->initial != NULL;
    for (int b = 0; b < 2; b++) {
        struct pressed *pressed = &pair->pressed[b];
        pressed->nodes = malloc(count * sizeof *pressed->nodes);
        pressed->directions = malloc(count * sizeof *pressed->directions);
        taken = taken && pressed->nodes && pressed->directions;
    }
    return taken;
}

static void add_facing(struct pair *pair, size_t beam_node, size_t sphere_node)
{
    const double *point = pair->meshes[PAIR_BEAM].points[beam_node];
    size_t nodes[2] = {beam_node, sphere_node}, i = pair->pressed[0].count;
    for (int b = 0; b < 2; b++) {
        struct pressed *pressed = &pair->pressed[b];
        pressed->nodes[i] = pair->systems[b].index[nodes[b]];
        direction_at(pair, point[0], point[1], pressed->directions[i]);
        for (int c = 0; c < 3 && b == PAIR_BEAM; c++)
            pressed->directions[i][c] = -pressed->directions[i][c];
        pressed->count++;
    }
    pair->initial[i] = gap_at(pair, point[0], point[1]);
}

/* finds the sphere's node above each of the beam's within the ellipse */
static bool face_nodes(struct pair *pair)
{
    const struct refined *beam = &pair->meshes[PAIR_BEAM], *sphere = &pair->meshes[PAIR_SPHERE];
    struct places above = {.same = FACING};
    size_t *of_place = malloc(sphere->touching * sizeof *of_place);
    bool faced = of_place && take_room(pair, beam->touching);
    /* the sphere's nodes by the point below them, one for each */
    for (size_t i = 0; faced && i < sphere->touching; i++) {
        const double *point = sphere->points[sphere->surface[i]];
        size_t place = places_add(&above, (const double[3]){point[0], point[1], 0.0});
        faced = place == i;
        of_place[i] = sphere->surface[i];
    }
    /* the beam's within the ellipse */
    for (size_t i = 0; faced && i < beam->touching; i++) {
        size_t node = beam->surface[i];
        const double *point = beam->points[node];
        if (pow(point[0] / pair->axes[0], 2.0) + pow(point[1] / pair->axes[1], 2.0) > 1.0)
            continue;
        /* one above each, both with freedoms of their own */
        size_t place = places_find(&above, (const double[3]){point[0], point[1], 0.0});
        faced = place != SIZE_MAX && pair->systems[PAIR_BEAM].index[node] != SIZE_MAX &&
                pair->systems[PAIR_SPHERE].index[of_place[place]] != SIZE_MAX;
        if (faced)
            add_facing(pair, node, of_place[place]);
    }
    free(of_place);
    places_free(&above);
    return faced && pair->pressed[0].count > 0;
}

/* the beam's node on its axis, within its brick in the middle */
static size_t find_axis(const struct pair *pair)
{
    const struct system3 *beam = &pair->systems[PAIR_BEAM];
    size_t nearest = 0;
    double least = INFINITY;
    for (size_t i = 0; i < beam->nodes; i++) {
        const double *p = beam->points[i];
        double away = hypot(hypot(p[0], p[1]), p[2] + pair->input.beam_radius);
        if (away < least)
            nearest = i;
        least = fmin(least, away);
    }
    return nearest;
}

enum percuss_status pair_create(const struct pair_input *input, struct pair *pair,
                                struct fault *fault)
{
    memset(pair, 0, sizeof *pair);
    pair->input = *input;
    enum percuss_status status = check(input, fault);
    if (status != PERCUSS_OK)
        return status;
    size_contact(pair);
    status = make_bodies(pair, fault);
    if (status == PERCUSS_OK && !face_nodes(pair))
        status = fault_set(fault, PERCUSS_INTERNAL,
                           "out of memory, or surfaces whose nodes do not face each other");
    if (status != PERCUSS_OK)
        pair_free(pair);
    else
        pair->axis = find_axis(pair);
    return status;
}

void pair_free(struct pair *pair)
{
    for (int b = 0; b < 2; b++) {
        refined_free(&pair->meshes[b]);
        system3_free(&pair->systems[b]);
        free(pair->pressed[b].nodes);
        free(pair->pressed[b].directions);
    }
    free(pair->initial);
    memset(pair, 0, sizeof *pair);
}

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
        /* compliance between the contact's nodes in a fine step */
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

/* Parts of a step. */
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

/* the forces at the end of the step, from the gaps without them */
static bool find_forces(struct run *run)
{
    const struct pressed *sphere = &run->collider->pair->pressed[PAIR_SPHERE];
    double *initial = (double *)run->set.initial;
    for (size_t i = 0; i < run->count; i++)
        initial[i] = tried_gap(run, i);
    if (!active_set_solve(&run->set))
        return false;
    /* their sum along z */
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
    /* first without forces at the step's end, then with the forces found there */
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
    /* the second body approaches the first */
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

/* after a step of the chosen runs: records it, and checks the energies of those in flight */
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
