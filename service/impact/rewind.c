/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/rewind.h"

#include <math.h>

#include "impact/flight.h"
#include "impact/step_cost.h"

/* Most touches that are gone back to, one after the other. */
enum { MOST_TOUCHES = 64 };

/* What rounding leaves of a touch that two contacts share, over the deepest overlap: as energy,
 * with its power 5/2, it is 1e-15 of the whole. */
static const double SHARED_TOUCH = 1e-6;

/* The nearer root behind us of the rigid approach d + rate t - a t^2/2. */
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

/* What was overlap, seen backward, is a gap seen forward: D(s) = -d(-s) is the approach of a flight
 * with the gap -g(-s) and the coordinates -q(-s), whose rates are g' and v and whose acceleration
 * is -a. Nothing is damped on the way back, see motion_rewind. */
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
    /* what that took */
    rewind->intervals -=
        flight.intervals < rewind->intervals ? flight.intervals : rewind->intervals;
    if (end == FLIGHT_LIMIT || end == FLIGHT_MEMORY)
        return end == FLIGHT_LIMIT ? REWIND_LIMIT : REWIND_MEMORY;
    /* the touch as an instant behind us */
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
 * does. `at` is left out and becomes its contact. */
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
        deepest = fmax(deepest, d);
    }
    return deepest;
}

enum rewind_end rewind_to_touch(struct rewind *rewind, const struct scene *scene,
                                struct motion *motion, double *shift)
{
    /* where one contact touched another one may overlap, from a touch further back */
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
