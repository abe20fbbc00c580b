/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/rewind.h"

#include <math.h>

#include "impact/flight.h"
#include "impact/impact.h"

/* The nearer root behind us of the rigid approach d + rate t - a t^2/2. */
static double rigid_root(double d, double rate, double a)
{
    double discriminant = rate * rate + 2.0 * a * d;
    if (!(rate > 0.0) || discriminant < 0.0)
        return -INFINITY;
    return -2.0 * d / (rate + sqrt(discriminant));
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
    mirror->scene = (struct scene){.contacts = 1,
                                   .groups = scene->groups,
                                   .bodies = scene->bodies,
                                   .gap_acceleration = &mirror->acceleration};
    mirror->scene.group = arena_take(arena, scene->groups + 1, sizeof *mirror->scene.group);
    if (!mirror->scene.group)
        return false;
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
    mirror->motion.gap[0] = -motion->gap[contact];
    mirror->motion.gap_rate[0] = motion->gap_rate[contact];
    for (size_t g = 0; g < scene->groups; g++)
        for (size_t k = 0; k < scene->group[g].count; k++) {
            mirror->motion.q[g][k] = -motion->q[g][k];
            mirror->motion.v[g][k] = motion->v[g][k];
        }
    return true;
}

static double find_ringing(struct rewind *rewind, const struct scene *scene,
                           const struct motion *motion, size_t contact)
{
    struct mirror mirror;
    struct flight flight;
    double time;
    size_t only;
    if (!mirror_create(&mirror, scene, motion, contact, rewind->arena) ||
        !flight_create(&flight, &mirror.scene, rewind->arena))
        return NAN;
    flight.pace = rewind->pace;
    flight.cost = impact_step_cost(scene);
    enum flight_end end = flight_find(&flight, &mirror.scene, &mirror.motion, rewind->longest,
                                      rewind->intervals, &time, &only);
    rewind->intervals -=
        flight.intervals < rewind->intervals ? flight.intervals : rewind->intervals;
    if (end == FLIGHT_LIMIT)
        return NAN;
    rewind->beyond = rewind->beyond || end == FLIGHT_TIMEOUT;
    return end == FLIGHT_TOUCH ? -time : -INFINITY;
}

double rewind_find(struct rewind *rewind, const struct scene *scene, const struct motion *motion,
                   size_t contact)
{
    double d;
    double rate;
    motion_approach(motion, scene, contact, &d, &rate);
    if (is_still(motion, scene, contact))
        return rigid_root(d, rate, scene->gap_acceleration[contact]);
    return find_ringing(rewind, scene, motion, contact);
}
