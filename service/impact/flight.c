/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/flight.h"

#include <math.h>
#include <string.h>

#include "impact/flight_root.h"
#include "impact/kernel.h"

/* Modes with omega h below this are followed by their tangent, the others bounded by their
 * amplitude a: the departure from the tangent is (omega h)^2/2 a at most, 1.1 a here, and grows. */
static const double SLOW_ANGLE = 1.5;
/* At this omega h of the fastest mode an interval is as short as it needs to be: the approach has
 * at most one peak in it, and flight_root.c has a power series for it. */
static const double FLOOR_ANGLE = 0.5;

enum { REFRESH = 32 /* intervals between two looks at the decayed amplitudes */ };

bool flight_create(struct flight *flight, const struct scene *scene, struct arena *arena)
{
    *flight = (struct flight){0};
    /* bounds by contact, and what each level makes of them */
    flight->amplitude = arena_take(arena, scene->groups, sizeof *flight->amplitude);
    flight->bound = arena_take(arena, scene->contacts, sizeof *flight->bound);
    flight->approach = arena_take(arena, scene->contacts, sizeof *flight->approach);
    flight->rate = arena_take(arena, scene->contacts, sizeof *flight->rate);
    flight->all_modes = arena_take(arena, scene->contacts * STEP_LEVELS, sizeof(double));
    flight->slow_modes = arena_take(arena, scene->contacts * STEP_LEVELS, sizeof(double));
    flight->slow_count = arena_take(arena, scene->groups * STEP_LEVELS, sizeof(size_t));
    if (!flight->slow_count || !flight->amplitude || !flight->bound || !flight->approach ||
        !flight->rate || !flight->all_modes || !flight->slow_modes)
        return false;
    /* the modes' amplitudes */
    for (size_t g = 0; g < scene->groups; g++) {
        flight->amplitude[g] = arena_take(arena, scene->group[g].stride, sizeof(double));
        if (!flight->amplitude[g])
            return false;
    }
    return motion_create(&flight->probe, scene, arena);
}

/* a = sqrt(q^2 + v^2/omega^2) bounds |q| for good, damped or not: the energy cannot grow. */
static void find_amplitudes(struct flight *flight, const struct scene *scene,
                            const struct motion *motion)
{
    memset(flight->known, 0, sizeof flight->known);
    memset(flight->bound, 0, scene->contacts * sizeof *flight->bound);
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        for (size_t k = 0; k < group->count; k++) {
            double v = motion->v[g][k] / group->set->omega[k];
            flight->amplitude[g][k] = sqrt(motion->q[g][k] * motion->q[g][k] + v * v);
        }
        for (size_t c = 0; c < scene->contacts; c++)
            for (size_t k = 0; group->participation[c] && k < group->count; k++)
                flight->bound[c] += fabs(group->participation[c][k]) * flight->amplitude[g][k];
    }
}

/* How many modes of a group are slow on a step; the others are bounded. */
static size_t count_slow(const struct scene_group *group, double h)
{
    size_t count = 0;
    while (count < group->count && group->set->omega[count] * h < SLOW_ANGLE)
        count++;
    return count;
}

/* Bounds of the modes' departure from tangent (slow) and from zero (fast) within a step of a level:
 * |q''| <= omega^2 a sqrt(1 + 4 zeta^2) by the energy bound. */
static void find_remainders(struct flight *flight, const struct scene *scene, int level)
{
    double h = step_length(level);
    double *all = flight->all_modes + level;
    double *slow = flight->slow_modes + level;
    for (size_t c = 0; c < scene->contacts; c++)
        all[c * STEP_LEVELS] = slow[c * STEP_LEVELS] = 0.0;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        /* how many are slow enough to be followed */
        double stiffer = sqrt(1.0 + 4.0 * group->set->most_damping * group->set->most_damping);
        size_t followed = count_slow(group, h);
        flight->slow_count[g * STEP_LEVELS + (size_t)level] = followed;
        for (size_t c = 0; c < scene->contacts; c++) {
            const double *phi = group->participation[c];
            for (size_t k = 0; phi && k < group->count; k++) {
                /* from the tangent by (omega h)^2/2 a sqrt(1 + 4 zeta^2), from zero by a */
                double angle = group->set->omega[k] * h;
                double reach = fabs(phi[k]) * flight->amplitude[g][k];
                double bend = 0.5 * angle * angle * stiffer * reach;
                all[c * STEP_LEVELS] += bend;
                slow[c * STEP_LEVELS] += k < followed ? bend : reach;
            }
        }
    }
    flight->known[level] = true;
}

/* Rigid approach and rate plus those of the modes that are slow on a step of the level. */
static void slow_approach(const struct flight *flight, const struct scene *scene, size_t contact,
                          int level, double *approach, double *rate)
{
    /* the rigid bodies */
    *approach = -flight->probe.gap[contact];
    *rate = -flight->probe.gap_rate[contact];
    for (size_t g = 0; g < scene->groups; g++) {
        const double *phi = scene->group[g].participation[contact];
        size_t count = flight->slow_count[g * STEP_LEVELS + (size_t)level];
        double d;
        double d_rate;
        if (!phi || !count)
            continue;
        /* the slow modes, the last few one by one */
        size_t whole = count / LANES * LANES;
        const double *q = flight->probe.q[g];
        const double *v = flight->probe.v[g];
        kernel_dot2(whole, phi, q, v, &d, &d_rate);
        for (size_t k = whole; k < count; k++) {
            d += phi[k] * q[k];
            d_rate += phi[k] * v[k];
        }
        *approach -= d;
        *rate -= d_rate;
    }
}

/* Whether contact c stays open for one step of the level. */
static bool stays_open(const struct flight *flight, const struct scene *scene, size_t c, int level)
{
    double h = step_length(level);
    double pull = -0.5 * scene->gap_acceleration[c] * h * h; /* what acceleration closes */
    double d = flight->approach[c];
    double rate = flight->rate[c];
    /* by the tangent of all modes; a parabola that opens upward is largest at its ends */
    double rise = fmax(0.0, flight->all_modes[c * STEP_LEVELS + (size_t)level] + pull);
    if (d <= 0.0 && d + rate * h + rise < 0.0)
        return true;
    /* by that of the slow ones */
    double margin = flight->slow_modes[c * STEP_LEVELS + (size_t)level];
    slow_approach(flight, scene, c, level, &d, &rate);
    return fmax(d, d + rate * h + fmax(0.0, pull)) + margin < 0.0;
}

static bool all_stay_open(struct flight *flight, const struct scene *scene, int level)
{
    if (!flight->known[level])
        find_remainders(flight, scene, level);
    for (size_t c = 0; c < scene->contacts; c++)
        if (!stays_open(flight, scene, c, level))
            return false;
    return true;
}

/* The instant, from now, from which every rigid gap exceeds its bound for good (or, under a
 * pressing acceleration, first does while it opens); INFINITY: never. */
static double completion(const struct flight *flight, const struct scene *scene,
                         const struct motion *motion)
{
    double from = 0.0;
    double until = INFINITY;
    for (size_t c = 0; c < scene->contacts; c++) {
        double first;
        double last;
        flight_root_exceeds(motion->gap[c] - flight->bound[c], motion->gap_rate[c],
                            scene->gap_acceleration[c], &first, &last);
        from = fmax(from, first);
        until = fmin(until, last);
    }
    return from <= until ? from : INFINITY;
}

static void find_approaches(struct flight *flight, const struct scene *scene)
{
    for (size_t c = 0; c < scene->contacts; c++)
        motion_approach(&flight->probe, scene, c, &flight->approach[c], &flight->rate[c]);
}

/* The next step of the scan, along exact motion. OK, INTERNAL (no memory) or TIMEOUT. */
static enum percuss_status move_probe(struct flight *flight, const struct scene *scene, int level)
{
    for (size_t g = 0; g < scene->groups; g++) {
        enum percuss_status status = oscillators_prepare(scene->group[g].set, level, flight->pace);
        if (status != PERCUSS_OK)
            return status;
    }
    motion_step(&flight->probe, &flight->probe, scene, level);
    find_approaches(flight, scene);
    return PERCUSS_OK;
}

/* Looks into the shortest interval [from, from + h] contact by contact. */
static bool touch_within(const struct flight *flight, const struct scene *scene, double from,
                         double h, double *time, size_t *contact)
{
    bool found = false;
    for (size_t c = 0; c < scene->contacts; c++) {
        double t;
        if (flight_root_touch(&flight->probe, scene, c, 0.0, h, &t) &&
            (!found || from + t < *time)) {
            found = true;
            *time = from + t;
            *contact = c;
        }
    }
    return found;
}

static int floor_level(const struct scene *scene, double allowed)
{
    double highest = scene_highest_frequency(scene);
    double shortest = highest > 0.0 ? FLOOR_ANGLE / highest : allowed;
    return step_level(fmin(shortest, allowed));
}

enum flight_end flight_find(struct flight *flight, const struct scene *scene,
                            const struct motion *motion, double allowed, unsigned long intervals,
                            double *time, size_t *contact)
{
    int floor = floor_level(scene, allowed);
    int level = floor;
    int passed = 0;
    int wait = 1;
    /* the modes' bounds, and the instant from which they exclude a touch */
    motion_copy(&flight->probe, motion, scene);
    find_approaches(flight, scene);
    find_amplitudes(flight, scene, motion);
    double complete = completion(flight, scene, motion);
    for (unsigned long i = 1; flight->probe.time - motion->time < fmin(complete, allowed); i++) {
        if (!pace_keeps(flight->pace, flight->cost))
            return FLIGHT_LIMIT;
        flight->intervals++;
        /* an interval that may not stay open is halved */
        double from = flight->probe.time - motion->time;
        bool open = all_stay_open(flight, scene, level);
        if (!open && level < floor) {
            level++;
            passed = 0;
            wait = 2;
            continue;
        }
        /* the shortest ones are looked into */
        if (!open && touch_within(flight, scene, from, step_length(level), time, contact) &&
            *time < fmin(complete, allowed))
            return FLIGHT_TOUCH;
        /* past it, along exact motion */
        double before = flight->probe.time;
        enum percuss_status moved = move_probe(flight, scene, level);
        if (moved == PERCUSS_INTERNAL)
            return FLIGHT_MEMORY;
        if (moved != PERCUSS_OK || i >= intervals)
            return FLIGHT_LIMIT;
        /* what is left to the end is rounding of the time */
        if (!(flight->probe.time > before))
            break;
        /* after a refusal two steps before the next try of longer ones */
        passed = open ? passed + 1 : 0;
        if (passed >= wait && level > 0) {
            level--;
            wait = 1;
        }
        /* damping has lowered the bounds */
        if (i % REFRESH == 0) {
            find_amplitudes(flight, scene, &flight->probe);
            complete =
                flight->probe.time - motion->time + completion(flight, scene, &flight->probe);
        }
    }
    *time = fmin(complete, allowed);
    return complete <= allowed ? FLIGHT_COMPLETE : FLIGHT_TIMEOUT;
}
