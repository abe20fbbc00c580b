/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/march.h"

#include <float.h>
#include <math.h>

#include "base/extremes.h"
#include "impact/energy.h"
#include "impact/flight.h"
#include "impact/impact_scale.h"

bool march_create(struct march *march, struct arena *arena)
{
    const struct scene *scene = march->stated;
    march->scene = *scene;
    march->scene.laws = march->outcome->laws;
    impact_begin(march->outcome, scene);
    motion_start(&march->outcome->motion, scene);
    march->closed = arena_take(arena, scene->contacts, sizeof *march->closed);
    march->indentation = arena_take(arena, scene->contacts, sizeof *march->indentation);
    if (scene->frictions)
        march->tangential = arena_take(arena, 2 * scene->frictions, sizeof *march->tangential);
    if (!march->closed || !march->indentation || (scene->frictions && !march->tangential) ||
        !flight_create(&march->flight, scene, arena))
        return false;
    march->cost = march->flight.cost = step_cost(scene);
    march->flight.pace = march->pace;
    return true;
}

/* Of the rigid bodies, at a contact with friction. */
static void find_slip(const struct march *march, size_t contact, double slip[2])
{
    const struct scene *scene = &march->scene;
    size_t friction = scene_friction_of(scene, contact);
    for (size_t t = 0; friction < scene->frictions && t < 2; t++)
        slip[t] = march->outcome->motion.gap_rate[scene_tangent(scene, friction) + t];
}

void march_open(struct march *march, size_t contact, double time, double gap_rate)
{
    march->closed[contact] = true;
    track_open(&march->outcome->tracks[contact], time, gap_rate);
    if (march->scene.frictions)
        find_slip(march, contact, march->outcome->tracks[contact].open.slip_before);
}

void march_close(struct march *march, size_t contact, double time, double gap_rate)
{
    march->closed[contact] = false;
    if (march->scene.frictions)
        find_slip(march, contact, march->outcome->tracks[contact].open.slip_after);
    track_close(&march->outcome->tracks[contact], &march->scene.laws[contact], time, gap_rate);
}

/* Relative errors: of the impulses, at least the rounding of sums over steps, and at most the
 * coarsest accuracy; of the stated rates, which are differences of bodies' speeds. */
static const double ROUNDING_OF_STEPS = 1e-11;
static const double COARSEST_STEPS = 1e-5;
static const double ROUNDING_OF_SPEEDS = 8.0 * DBL_EPSILON;

double march_unknown_rate(const struct march *march, size_t contact)
{
    const struct scene *scene = march->stated;
    double changed = 0.0;
    double fastest = 0.0;
    for (size_t c = 0; c < scene->contacts; c++) {
        double w = scene->w[contact * scene->rows + c];
        changed += fabs(w) * march->outcome->tracks[c].impulse;
        double speed = fabs(scene->gap_rate[c]);
        fastest = speed > fastest ? speed : fastest;
    }
    double steps = march->accuracy < ROUNDING_OF_STEPS ? ROUNDING_OF_STEPS
                   : march->accuracy > COARSEST_STEPS  ? COARSEST_STEPS
                                                       : march->accuracy;
    return steps * changed + ROUNDING_OF_SPEEDS * fastest;
}

bool march_in_contact(const struct march *march)
{
    for (size_t c = 0; c < march->scene.contacts; c++)
        if (march->closed[c])
            return true;
    return false;
}

enum percuss_end_reason march_parted(const struct march *march)
{
    for (size_t c = 0; c < march->scene.contacts; c++)
        if (march->scene.gap_acceleration[c] < 0.0)
            return PERCUSS_END_HANDED_BACK;
    return PERCUSS_END_SEPARATED;
}

enum percuss_end_reason march_fail(struct march *march, enum percuss_status status)
{
    march->status = status;
    return PERCUSS_END_LIMIT;
}

static enum percuss_end_reason no_memory(struct march *march)
{
    return march_fail(march, pace_fault(march->fault, PERCUSS_INTERNAL));
}

/* Moves bodies that overlap at the stated instant back to their touch. NONE: go on. */
static enum percuss_end_reason find_start(struct march *march, struct arena *arena)
{
    struct impact_outcome *outcome = march->outcome;
    struct rewind rewind = {march->horizon, march->most, arena, march->pace, false};
    enum rewind_end end =
        rewind_to_touch(&rewind, &march->scene, &outcome->motion, &outcome->time_shift);
    outcome->always_overlapped = end == REWIND_NEVER;
    outcome->beyond_horizon = rewind.beyond;
    march->used = march->most - rewind.intervals;
    if (end == REWIND_MEMORY)
        return no_memory(march);
    return end == REWIND_LIMIT ? PERCUSS_END_LIMIT : PERCUSS_END_NONE;
}

/* Free motion to the next touch. NONE: touched. */
static enum percuss_end_reason fly(struct march *march, size_t *contact)
{
    double time = 0.0;
    struct motion *motion = &march->outcome->motion;
    unsigned long before = march->flight.intervals;
    double allowed = march->horizon - motion->time;
    /* the last step of a contact phase may have taken more than was left */
    unsigned long left = march->used < march->most ? march->most - march->used : 0;
    for (size_t c = 0; c < march->scene.contacts; c++)
        march->flight.unknown[c] = march_unknown_rate(march, c);
    enum flight_end end =
        flight_find(&march->flight, &march->scene, motion, allowed, left, &time, contact);
    march->used += march->flight.intervals - before;
    if (end == FLIGHT_MEMORY)
        return no_memory(march);
    if (end == FLIGHT_LIMIT || march->used > march->most)
        return PERCUSS_END_LIMIT;
    /* the energy that damping takes, and the motion at the end */
    march->damping += motion_free_loss(motion, &march->scene, time);
    motion_copy(motion, &march->flight.probe, &march->scene);
    if (end == FLIGHT_TIMEOUT)
        return PERCUSS_END_HORIZON;
    return end == FLIGHT_COMPLETE ? march_parted(march) : PERCUSS_END_NONE;
}

/* Start of the first sub-impact of all, 0 when there is none. */
static double first_touch(const struct march *march)
{
    double first = INFINITY;
    for (size_t c = 0; c < march->scene.contacts; c++)
        if (march->outcome->tracks[c].count)
            first = smaller(first, march->outcome->tracks[c].list[0].start);
    return isfinite(first) ? first : 0.0;
}

/* Closes the books at the end of the window and audits the energy. */
static enum percuss_status finish(struct march *march, struct arena *arena)
{
    struct impact_outcome *outcome = march->outcome;
    const struct motion *motion = &outcome->motion;
    for (size_t c = 0; c < march->scene.contacts; c++) {
        if (march->closed[c])
            march_close(march, c, motion->time, motion->gap_rate[c]);
        track_mark_negligible(&outcome->tracks[c]);
    }
    outcome->window = motion->time;
    outcome->effort = march->used;
    if (outcome->time_shift == 0.0)
        outcome->time_shift = first_touch(march);
    const struct energy_end end = {march->indentation, march->force, march->tangential,
                                   march->damping};
    if (!energy_audit(march->stated, &end, arena, outcome))
        return pace_fault(march->fault, PERCUSS_INTERNAL);
    return pace_status(march->pace);
}

enum percuss_status march_run(struct march *march, const struct march_method *method, void *state,
                              struct arena *arena)
{
    size_t contact = 0;
    /* back to where bodies that overlap have touched */
    enum percuss_end_reason end = find_start(march, arena);
    if (march->outcome->always_overlapped)
        return PERCUSS_OK;
    /* flights and contact phases in turn */
    while (end == PERCUSS_END_NONE) {
        if (!method->flies)
            end = fly(march, &contact);
        if (end == PERCUSS_END_NONE)
            end = method->contact_phase(state, contact);
    }
    /* the method's own end, then the books */
    if (march->status != PERCUSS_OK)
        return march->status;
    march->outcome->end_reason = end;
    method->end(state);
    return finish(march, arena);
}

/* Most touches to which a motion is moved back, one after the other. */
enum { MOST_TOUCHES = 64 };

/* Overlap by rounding at a touch that two contacts share, over the deepest overlap: its energy, of
 * the power 5/2, is 1e-15 of the whole. */
static const double SHARED_TOUCH = 1e-6;

/* The latest root t < 0 of the rigid approach d + rate t - a t^2/2. */
static enum rewind_end rigid_root(double d, double rate, double a, double *time)
{
    double discriminant = rate * rate + 2.0 * a * d;
    if (!(rate > 0.0) || discriminant < 0.0)
        return REWIND_NEVER;
    *time = -2.0 * d / (rate + sqrt(discriminant));
    return isfinite(*time) ? REWIND_TOUCHED : REWIND_NEVER;
}

static bool is_still(const struct motion *motion, const struct scene *scene, size_t contact)
{
    for (size_t g = 0; g < scene->groups; g++)
        for (size_t k = 0; scene->group[g].participation[contact] && k < scene->group[g].count; k++)
            if (motion->q[g][k] != 0.0 || motion->v[g][k] != 0.0)
                return false;
    return true;
}

/* The overlap backward in time is the gap of a flight forward in time: D(s) = -d(-s) is the
 * approach for the gap -g(-s) and the coordinates -q(-s), with the rates g' and v and the
 * acceleration -a. The way back has no damping, see motion_rewind. */
struct mirror {
    struct scene scene;
    struct motion motion;
    double acceleration;
};

static bool mirror_create(struct mirror *mirror, const struct scene *scene,
                          const struct motion *motion, size_t contact, struct arena *arena)
{
    *mirror = (struct mirror){.acceleration = -scene->gap_acceleration[contact]};
    /* this contact alone, its acceleration turned round */
    mirror->scene = (struct scene){.contacts = 1,
                                   .rows = 1,
                                   .groups = scene->groups,
                                   .bodies = scene->bodies,
                                   .gap_acceleration = &mirror->acceleration};
    mirror->scene.group = arena_take(arena, scene->groups + 1, sizeof *mirror->scene.group);
    if (!mirror->scene.group)
        return false;
    /* the modes, undamped */
    for (size_t g = 0; g < scene->groups; g++) {
        struct scene_group *group = &mirror->scene.group[g];
        *group = scene->group[g];
        group->participation += contact;
        group->set = oscillators_undamped(group->set);
        if (!group->set)
            return false;
    }
    if (!motion_create(&mirror->motion, &mirror->scene, arena))
        return false;
    /* gap and coordinates turned round */
    mirror->motion.gap[0] = -motion->gap[contact];
    mirror->motion.gap_rate[0] = motion->gap_rate[contact];
    for (size_t g = 0; g < scene->groups; g++)
        for (size_t k = 0; k < scene->group[g].count; k++) {
            mirror->motion.q[g][k] = -motion->q[g][k];
            mirror->motion.v[g][k] = motion->v[g][k];
        }
    return true;
}

static enum rewind_end find_ringing(struct rewind *rewind, const struct scene *scene,
                                    const struct motion *motion, size_t contact, double *time)
{
    struct mirror mirror;
    struct flight flight;
    size_t only;
    if (!mirror_create(&mirror, scene, motion, contact, rewind->arena) ||
        !flight_create(&flight, &mirror.scene, rewind->arena))
        return REWIND_MEMORY;
    /* forward to the touch */
    flight.pace = rewind->pace;
    flight.cost = step_cost(scene);
    enum flight_end end = flight_find(&flight, &mirror.scene, &mirror.motion, rewind->longest,
                                      rewind->intervals, time, &only);
    /* the intervals that it used */
    rewind->intervals -=
        flight.intervals < rewind->intervals ? flight.intervals : rewind->intervals;
    if (end == FLIGHT_LIMIT || end == FLIGHT_MEMORY)
        return end == FLIGHT_LIMIT ? REWIND_LIMIT : REWIND_MEMORY;
    /* the touch as an instant in the past */
    rewind->beyond = rewind->beyond || end == FLIGHT_TIMEOUT;
    *time = -*time;
    return end == FLIGHT_TOUCH ? REWIND_TOUCHED : REWIND_NEVER;
}

enum rewind_end rewind_find(struct rewind *rewind, const struct scene *scene,
                            const struct motion *motion, size_t contact, double *time)
{
    double d;
    double rate;
    motion_approach(motion, scene, contact, &d, &rate);
    if (is_still(motion, scene, contact))
        return rigid_root(d, rate, scene->gap_acceleration[contact], time);
    return find_ringing(rewind, scene, motion, contact, time);
}

/* The earliest of the last touches of the contacts that overlap by more than `allowed`; 0: none
 * does. Contact *at is not looked at; *at becomes the contact of the touch. */
static enum rewind_end find_touch(const struct scene *scene, struct rewind *rewind,
                                  const struct motion *motion, double allowed, size_t *at,
                                  double *earliest)
{
    size_t left_out = *at;
    *earliest = 0.0;
    for (size_t c = 0; c < scene->contacts; c++) {
        /* contacts that overlap, but for the one that now touches */
        double d;
        double rate;
        motion_approach(motion, scene, c, &d, &rate);
        if (d <= allowed || c == left_out)
            continue;
        /* each one's last touch, and the earliest of these */
        double back;
        enum rewind_end end = rewind_find(rewind, scene, motion, c, &back);
        if (end != REWIND_TOUCHED)
            return end;
        if (back < *earliest) {
            *earliest = back;
            *at = c;
        }
    }
    return REWIND_TOUCHED;
}

static double deepest_overlap(const struct scene *scene, const struct motion *motion)
{
    double deepest = 0.0;
    for (size_t c = 0; c < scene->contacts; c++) {
        double d;
        double rate;
        motion_approach(motion, scene, c, &d, &rate);
        deepest = larger(d, deepest);
    }
    return deepest;
}

enum rewind_end rewind_to_touch(struct rewind *rewind, const struct scene *scene,
                                struct motion *motion, double *shift)
{
    /* at one contact's touch another one may overlap, from an earlier touch */
    double allowed = SHARED_TOUCH * deepest_overlap(scene, motion);
    size_t at = scene->contacts;
    *shift = 0.0;
    for (int round = 0; round < MOST_TOUCHES; round++) {
        double earliest;
        enum rewind_end found =
            find_touch(scene, rewind, motion, round ? allowed : 0.0, &at, &earliest);
        if (found != REWIND_TOUCHED || earliest == 0.0)
            return found;
        motion_rewind(motion, scene, -earliest);
        *shift += earliest;
    }
    return REWIND_NEVER;
}
