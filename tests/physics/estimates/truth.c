/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "physics/estimates/truth.h"

#include "model/rigid.h"
#include "model/vector.h"
#include "physics/estimates/drawn.h"
#include "solve/assemble.h"
#include "solve/error/attempt.h"
#include "solve/formulation.h"
#include "solve/report.h"

/* Most modes of a family. */
static const size_t MOST_MODES = 4800;
/* CVODE's relative tolerance is a hundredth. */
static const double CVODE_ACCURACY = 1e-8;

/* Of two solutions in a row, modes and accuracies: CVODE's steps follow the highest frequency. */
static const struct growth {
    double first, modes, accuracy, finest;
} growth_modal = {1e-9, 2.0, 0.03, 1e-14}, growth_cvode = {1e-7, 1.4, 0.1, 1e-9};

struct truth_room {
    struct prepared_cache *cache;
    struct arena arena;
    struct body bodies[32];
    struct body_set set;                           /* as the lab's, with fixed numbers of modes */
    struct body_state *states[PERCUSS_MAX_BODIES]; /* along a chain of blows */
};

struct truth_room *truth_room_create(void)
{
    struct truth_room *room = calloc(1, sizeof *room);
    if (!room)
        return NULL;
    room->cache = prepared_cache_create();
    if (!room->cache) {
        free(room);
        return NULL;
    }
    return room;
}

void truth_room_free(struct truth_room *room)
{
    if (!room)
        return;
    for (size_t b = 0; b < PERCUSS_MAX_BODIES; b++)
        free(room->states[b]);
    prepared_cache_free(room->cache);
    arena_release(&room->arena);
    free(room);
}

static void fix_modes(struct truth_room *room, const struct body_set *set, size_t modes)
{
    room->set = *set;
    room->set.bodies = room->bodies;
    assert_true(set->count <= COUNT(room->bodies));
    for (size_t b = 0; b < set->count; b++) {
        room->bodies[b] = set->bodies[b];
        if (body_is_flexible(&room->bodies[b]))
            room->bodies[b].modes = (unsigned)modes;
    }
}

/* One solution; its impulses replace the truth's, and how far they went is its spread. */
struct level {
    size_t modes;
    double accuracy, work; /* allowed */
    bool cvode;
};

static bool solve_scene(struct truth_room *room, const struct problem *problem,
                        const struct level *level, const struct scene *scene,
                        struct impact_outcome *outcome)
{
    struct impact_settings settings = {.accuracy = level->accuracy,
                                       .horizon = attempt_horizon(problem, scene),
                                       .max_work = level->work};
    if (!impact_create(outcome, scene, &room->arena))
        return false;
    enum percuss_status status = level->cvode
                                     ? impact_cvode(scene, &settings, &room->arena, outcome)
                                     : impact_modal(scene, &settings, &room->arena, outcome);
    return status == PERCUSS_OK && !outcome->always_overlapped &&
           outcome->end_reason != PERCUSS_END_LIMIT;
}

/* A request's solution, in the arena until the next one. */
struct solved {
    struct problem *problem;
    struct assembly assembly;
    struct impact_outcome outcome;
};

static bool solve_one(struct truth_room *room, const struct solve_request *request,
                      const struct level *level, struct solved *solved)
{
    struct fault fault = {0};
    const struct mode_choice choice = {.cut = INFINITY, .most = MODE_CHOICE_MOST};
    const struct solve_context means = {.catalogue = &room->set};
    arena_reset(&room->arena);
    struct problem *problem = solved->problem = problem_create(request, room->cache, &room->arena);
    return problem && !formulate(problem, &means, &fault) &&
           assemble(&solved->assembly, problem, &choice) &&
           solve_scene(room, problem, level, &solved->assembly.scene, &solved->outcome);
}

/* The bodies as the earlier blows leave them, by solutions of this level. */
static bool solve_earlier(struct truth_room *room, const struct truth_settings *settings,
                          const struct level *level, struct truth *truth, double *window)
{
    struct solved solved;
    *window = 0.0;
    for (size_t i = 0; i < settings->earlier_count; i++) {
        struct solve_request blow = settings->earlier[i];
        for (size_t b = 0; b < blow.body_count; b++) {
            blow.bodies[b].state = i ? room->states[b] : NULL;
            blow.bodies[b].elapsed -= *window;
        }
        if (!solve_one(room, &blow, level, &solved))
            return false;
        *window = solved.outcome.window;
        truth->work += impact_work(&solved.assembly.scene, &solved.outcome);
        for (size_t b = 0; b < blow.body_count; b++)
            scene_take_state(state_after(&solved.assembly, &solved.outcome, solved.problem, b),
                             &room->states[b]);
    }
    return true;
}

static void find_effects(const struct problem *problem, struct truth *truth)
{
    for (size_t c = 0; c < problem->contact_count; c++)
        for (int which = 0; which < 2; which++) {
            const struct contact_side *side = &problem->sides[c][which];
            struct truth_effect *effect = &truth->effect[c][which];
            *effect = (struct truth_effect){.body = side->body};
            rigid_apply_impulse(problem->bodies[side->body], side->site.point, side->direction,
                                effect->velocity, effect->angular_velocity);
        }
}

static bool solve_level(struct truth_room *room, const struct body_set *set,
                        const struct solve_request *request, const struct truth_settings *settings,
                        const struct level *level, struct truth *truth)
{
    struct solved solved;
    struct solve_request last = *request;
    prepared_cache_use(room->cache, set->revision);
    fix_modes(room, set, level->modes);
    double window;
    if (!solve_earlier(room, settings, level, truth, &window))
        return false;
    for (size_t b = 0; settings->earlier_count && b < last.body_count; b++) {
        last.bodies[b].state = room->states[b];
        last.bodies[b].elapsed -= window;
    }
    if (!solve_one(room, &last, level, &solved))
        return false;
    const struct problem *problem = solved.problem;
    const struct impact_outcome outcome = solved.outcome;
    double impulse[PERCUSS_MAX_CONTACTS] = {0};
    bool first = truth->levels == 0;
    truth->contacts = problem->contact_count;
    truth->sub_impacts = 0;
    for (size_t c = 0; c < truth->contacts; c++) {
        impulse[c] = outcome.tracks[c].impulse;
        truth->compression[c] = problem->impulse_compression[c];
        truth->sub_impacts += outcome.tracks[c].count;
    }
    truth->spread = first ? INFINITY : truth_distance(truth, impulse);
    truth->impulse_spread = first ? INFINITY : truth_impulse_distance(truth, impulse);
    memcpy(truth->impulse, impulse, sizeof impulse);
    truth->tangential_spread = first ? INFINITY : 0.0;
    for (size_t c = 0; c < truth->contacts; c++) {
        const double *t = outcome.tracks[c].tangential, *before = truth->tangential[c];
        double moved = hypot(t[0] - before[0], t[1] - before[1]);
        truth->tangential_spread = fmax(truth->tangential_spread, moved);
        memcpy(truth->tangential[c], t, sizeof truth->tangential[c]);
    }
    find_effects(problem, truth);
    truth->modes = level->modes;
    truth->levels++;
    truth->work += impact_work(&solved.assembly.scene, &outcome);
    truth->end_reason = outcome.end_reason;
    return true;
}

static void print_level(const struct level *level, const struct truth *truth)
{
    printf("  reference: %zu modes of a family, accuracy %.0e%s: e", level->modes, level->accuracy,
           level->cvode ? ", CVODE" : "");
    for (size_t c = 0; c < truth->contacts; c++)
        printf(" %.9f, tangential %.9g %.9g N s;", truth->impulse[c] / truth->compression[c] - 1.0,
               truth->tangential[c][0], truth->tangential[c][1]);
    printf(", %zu sub-impacts, spread %.2e, work %.2e\n", truth->sub_impacts, truth->spread,
           truth->work);
}

bool truth_find(struct truth_room *room, const struct body_set *set,
                const struct solve_request *request, const struct truth_settings *settings,
                struct truth *truth)
{
    const struct growth *growth = settings->cvode ? &growth_cvode : &growth_modal;
    struct level level = {
        .modes = settings->modes, .accuracy = growth->first, .cvode = settings->cvode};
    memset(truth, 0, sizeof *truth);
    truth->spread = INFINITY;
    for (;;) {
        level.work = settings->effort - truth->work;
        if (!solve_level(room, set, request, settings, &level, truth))
            return truth->levels > 1;
        if (settings->chatty)
            print_level(&level, truth);
        if (truth->spread <= settings->goal || level.modes >= MOST_MODES)
            return truth->levels > 1;
        double modes = fmin((double)level.modes * growth->modes, (double)MOST_MODES);
        level.modes = (size_t)modes;
        level.accuracy = fmax(level.accuracy * growth->accuracy, growth->finest);
    }
}

void truth_by_answer(const struct solve_result *result, struct truth *truth)
{
    double largest = 0.0;
    memset(truth, 0, sizeof *truth);
    truth->contacts = result->contact_count;
    truth->end_reason = result->end_reason;
    truth->spread = result->restitution_time + result->restitution_modes;
    for (size_t c = 0; c < truth->contacts; c++) {
        const struct solve_contact_result *contact = &result->contacts[c];
        truth->impulse[c] = contact->impulse;
        truth->compression[c] = contact->impulse_compression;
        truth->sub_impacts += contact->sub_impact_count;
        largest = fmax(largest, contact->impulse_compression);
        memcpy(truth->tangential[c], contact->impulse_tangential, sizeof truth->tangential[c]);
    }
    truth->impulse_spread = truth->spread * largest;
}

bool truth_by_cvode(struct truth_room *room, const struct body_set *set,
                    const struct solve_request *request, const struct truth_settings *settings,
                    struct truth *truth)
{
    const struct level level = {.modes = settings->modes,
                                .accuracy = CVODE_ACCURACY,
                                .work = settings->effort,
                                .cvode = true};
    memset(truth, 0, sizeof *truth);
    bool solved = solve_level(room, set, request, settings, &level, truth);
    if (solved && settings->chatty)
        print_level(&level, truth);
    return solved;
}

double truth_distance(const struct truth *truth, const double *impulse)
{
    double distance = 0.0;
    for (size_t c = 0; c < truth->contacts; c++)
        if (truth->compression[c] > 0.0)
            distance = fmax(distance, fabs(impulse[c] - truth->impulse[c]) / truth->compression[c]);
    return distance;
}

double truth_impulse_distance(const struct truth *truth, const double *impulse)
{
    double distance = 0.0;
    for (size_t c = 0; c < truth->contacts; c++)
        distance = fmax(distance, fabs(impulse[c] - truth->impulse[c]));
    return distance;
}

/* Of the spread of a reference: what it leaves open is in the answer's favour. */
static double left_open(const struct truth *truth, size_t contact)
{
    return fmin(truth->impulse_spread, truth->spread * truth->compression[contact]) +
           1e-9 * truth->impulse[contact];
}

bool truth_covers_impulses(const struct truth *truth, const double *impulse, const double *given)
{
    for (size_t c = 0; c < truth->contacts; c++)
        if (!(fabs(impulse[c] - truth->impulse[c]) <= given[c] + left_open(truth, c)))
            return false;
    return true;
}

/* What the contacts' changes make of a body's velocity and turning, and what is given for both. */
struct sway {
    double velocity[3], angular_velocity[3];
    double given, given_angular;
};

static struct sway sway_of(const struct truth *truth, const double *impulse, const double *given,
                           size_t body)
{
    struct sway sway = {0};
    for (size_t c = 0; c < truth->contacts; c++)
        for (int which = 0; which < 2; which++) {
            const struct truth_effect *effect = &truth->effect[c][which];
            double change = impulse[c] - truth->impulse[c];
            double stated = given[c] + left_open(truth, c);
            if (effect->body != body)
                continue;
            add_scaled3(change, effect->velocity, sway.velocity);
            add_scaled3(change, effect->angular_velocity, sway.angular_velocity);
            sway.given += stated * norm3(effect->velocity);
            sway.given_angular += stated * norm3(effect->angular_velocity);
        }
    return sway;
}

bool truth_covers_velocities(const struct truth *truth, const double *impulse, const double *given)
{
    for (size_t b = 0; b < PERCUSS_MAX_BODIES; b++) {
        struct sway sway = sway_of(truth, impulse, given, b);
        if (!(norm3(sway.velocity) <= sway.given) ||
            !(norm3(sway.angular_velocity) <= sway.given_angular))
            return false;
    }
    return true;
}
