/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/flight.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "impact/flight_kernel.h"
#include "impact/flight_root.h"

enum {
    /* Levels by which the first interval is tried longer than the shortest, the next after one as
     * long as tried, and the next after any other: of 0 to 4, the least work on the benchmark's
     * beam. */
    FIRST_TRY = 3,
    AFTER_SUCCESS = 3,
    AFTER_REFUSAL = 1,
    /* limit of these for any: see FLIGHT_TURN_ANGLE */
    LONGEST_TRY = 20,
    /* intervals between updates of decayed amplitudes */
    REFRESH = 8
};

bool flight_create(struct flight *flight, const struct scene *scene, struct arena *arena)
{
    *flight = (struct flight){0};
    size_t pairs = scene->groups * scene->contacts;
    flight->reach = arena_take(arena, pairs, sizeof *flight->reach);
    flight->bend = arena_take(arena, pairs, sizeof *flight->bend);
    flight->bound = arena_take(arena, scene->contacts, sizeof *flight->bound);
    flight->unknown = arena_take(arena, scene->contacts, sizeof *flight->unknown);
    flight->followed = arena_take(arena, scene->groups, sizeof *flight->followed);
    flight->swing = arena_reserve(arena, scene->groups, sizeof *flight->swing);
    if (!flight->reach || !flight->bend || !flight->bound || !flight->unknown ||
        !flight->followed || !flight->swing)
        return false;
    for (size_t g = 0; g < scene->groups; g++)
        flight->swing[g] = sqrt(1.0 - scene->group[g].set->most_damping);
    /* the bounds of the modes at each contact that they move */
    for (size_t i = 0; i < pairs; i++) {
        const struct scene_group *group = &scene->group[i / scene->contacts];
        size_t room = group->stride / LANES + 1;
        flight->damped = flight->damped || group->set->most_damping > 0.0;
        if (!group->participation[i % scene->contacts])
            continue;
        flight->reach[i] = arena_reserve(arena, room, sizeof(double));
        flight->bend[i] = arena_reserve(arena, room, sizeof(double));
        if (!flight->reach[i] || !flight->bend[i])
            return false;
    }
    return motion_create(&flight->probe, scene, arena);
}

/* a = sqrt(q^2 + v^2/omega^2) bounds |q| for good, damped or not: the energy cannot grow. */
static void find_bounds(struct flight *flight, const struct scene *scene,
                        const struct motion *motion)
{
    for (size_t c = 0; c < scene->contacts; c++) {
        flight->bound[c] = 0.0;
        for (size_t g = 0; g < scene->groups; g++) {
            struct flight_modes modes =
                flight_modes_of(&scene->group[g], c, motion->q[g], motion->v[g]);
            size_t pair = g * scene->contacts + c;
            if (!modes.phi)
                continue;
            flight_kernel_bounds(&modes, flight->reach[pair], flight->bend[pair]);
            flight->bound[c] += flight->reach[pair][0];
        }
    }
}

/* Bounds of the gap at a contact within an interval. */
struct outlook {
    double derivative[SCAN_TERMS]; /* of the rigid gap and of the modes in the series */
    double fast;                   /* the other modes' amplitudes */
    double rest;                   /* the series' remainder at the end */
};

/* The remainder of the series at h over the modes' bend: h^8/8!. */
static double remainder_share(double h)
{
    double h2 = h * h;
    double h4 = h2 * h2;
    return h4 * h4 * (1.0 / 40320.0);
}

/* Adds to the series the modes with a remainder at h of at most their amplitude. A mode q = Re(A
 * e^(lambda t)) with |lambda| = omega has |q^(n)| <= |A| omega^n, and |A|^2 (1 - zeta^2) = q^2 +
 * v^2/omega^2 + 2 zeta q v/omega <= (1 + zeta) a^2. */
static void look_closer(const struct flight *flight, const struct scene *scene,
                        const struct motion *now, size_t c, double h, struct outlook *outlook)
{
    double share = remainder_share(h);
    outlook->fast = 0.0;
    outlook->rest = 0.0;
    for (size_t g = 0; g < scene->groups; g++) {
        const double *reach = flight->reach[g * scene->contacts + c];
        const double *bend = flight->bend[g * scene->contacts + c];
        if (!reach)
            continue;
        size_t first = flight->followed[g];
        size_t last = first;
        while (last < scene->group[g].stride / LANES &&
               (bend[last + 1] - bend[last]) * share <= reach[last] - reach[last + 1])
            last++;
        outlook->fast += reach[last];
        outlook->rest += bend[last] * share / flight->swing[g];
        if (last == first)
            continue;
        /* the lanes from the first new one on */
        struct flight_modes modes = flight_modes_of(&scene->group[g], c, now->q[g], now->v[g]);
        flight->followed[g] = last;
        modes.length = (last - first) * LANES;
        modes.omega += first * LANES;
        modes.phi += first * LANES;
        modes.q += first * LANES;
        modes.v += first * LANES;
        if (modes.damping)
            modes.damping += first * LANES;
        flight_kernel_derivatives(&modes, outlook->derivative);
    }
}

/* Whether the gap stays open for h. With t = s h the series is a polynomial p(s), bounded by its
 * Bernstein coefficients (see flight_root.c). The remainder is at most its value at h times s^8 <=
 * s^7, which changes only the last coefficient. */
static bool stays_open(const struct outlook *outlook, double h)
{
    /* 1/n!, and 1/binomial(7, n) */
    static const double FACTORIAL[SCAN_TERMS] = {
        1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0, 1.0 / 5040.0};
    static const double BINOMIAL[SCAN_TERMS] = {1.0,        1.0 / 7.0,  1.0 / 21.0, 1.0 / 35.0,
                                                1.0 / 35.0, 1.0 / 21.0, 1.0 / 7.0,  1.0};
    double b[SCAN_TERMS];
    b[0] = outlook->derivative[0] - outlook->fast;
    if (b[0] < 0.0)
        return false;
    /* the power series in s; most gaps that close are closed at its end */
    double power = h;
    double end = b[0];
#pragma GCC unroll 8
    for (int n = 1; n < SCAN_TERMS; n++) {
        b[n] = outlook->derivative[n] * (power * FACTORIAL[n]);
        end += b[n];
        power *= h;
    }
    if (end < outlook->rest)
        return false;
#pragma GCC unroll 8
    for (int n = 1; n < SCAN_TERMS; n++)
        b[n] *= BINOMIAL[n];
    b[SCAN_TERMS - 1] -= outlook->rest;
    /* Bernstein's coefficients, by repeated sums of neighbours */
#pragma GCC unroll 8
    for (int round = 1; round < SCAN_TERMS; round++)
#pragma GCC unroll 8
        for (int j = SCAN_TERMS - 1; j >= round; j--)
            b[j] += b[j - 1];
    for (int j = 1; j < SCAN_TERMS; j++)
        if (b[j] < 0.0)
            return false;
    return true;
}

/* The level of the longest step, from levels[0] to levels[1], on which contact c stays open;
 * levels[1] + 1: none. */
static int open_level(struct flight *flight, const struct scene *scene, const struct motion *now,
                      size_t c, const int levels[2])
{
    struct outlook outlook = {
        .derivative = {now->gap[c], now->gap_rate[c], scene->gap_acceleration[c]}};
    memset(flight->followed, 0, scene->groups * sizeof *flight->followed);
    for (int level = levels[0]; level <= levels[1]; level++) {
        double h = step_length(level);
        look_closer(flight, scene, now, c, h, &outlook);
        if (stays_open(&outlook, h))
            return level;
    }
    return levels[1] + 1;
}

/* The instant, from now, from which every rigid gap exceeds its bound for good (or, under a
 * pressing acceleration, first does while it opens); INFINITY: never within the time `left`. */
static double completion(const struct flight *flight, const struct scene *scene,
                         const struct motion *motion, double left)
{
    double from = 0.0;
    double until = INFINITY;
    for (size_t c = 0; c < scene->contacts; c++) {
        double first;
        double last;
        double excess = motion->gap[c] - flight->bound[c];
        double rate = flight_root_rate(excess, motion->gap_rate[c], flight->unknown[c], left);
        flight_root_exceeds(excess, rate, scene->gap_acceleration[c], &first, &last);
        from = larger(from, first);
        until = smaller(until, last);
    }
    return from <= until ? from : INFINITY;
}

/* A contact that touches already and closes. */
static bool touches_now(const struct scene *scene, const struct motion *motion, size_t *contact)
{
    for (size_t c = 0; c < scene->contacts; c++) {
        double approach;
        double rate;
        motion_approach(motion, scene, c, &approach, &rate);
        if (approach >= 0.0 && rate > 0.0) {
            *contact = c;
            return true;
        }
    }
    return false;
}

/* State of a search. */
struct scan {
    struct flight *flight;
    const struct scene *scene;
    const struct motion *start, *now; /* of flight, of interval */
    double allowed;
    double end;             /* from the start: complete, or out of time */
    enum flight_end reason; /* which of the two */
    int floor;              /* level of the shortest interval */
    int level;              /* of the last one passed */
    int longer;             /* levels by which the next may be longer */
};

/* The modes' bounds from now on, and the instant from which they exclude a touch. */
static void find_end(struct scan *scan)
{
    find_bounds(scan->flight, scan->scene, scan->now);
    double passed = scan->now->time - scan->start->time;
    double complete =
        passed + completion(scan->flight, scan->scene, scan->now, scan->allowed - passed);
    scan->reason = complete <= scan->allowed ? FLIGHT_COMPLETE : FLIGHT_TIMEOUT;
    scan->end = smaller(complete, scan->allowed);
}

/* Finds the next interval that stays open. Returns the time from now of a touch in it; INFINITY:
 * none. */
static double look_ahead(struct scan *scan, size_t *contact)
{
    const struct scene *scene = scan->scene;
    int longest = scan->floor > LONGEST_TRY ? scan->floor - LONGEST_TRY : 0;
    int tried = scan->level - scan->longer;
    int levels[2] = {tried > longest ? tried : longest, scan->floor};
    double first = INFINITY;
    for (size_t c = 0; c < scene->contacts; c++) {
        double touch;
        levels[0] = open_level(scan->flight, scene, scan->now, c, levels);
        if (levels[0] <= scan->floor)
            continue;
        /* the shortest are searched for it */
        levels[0] = scan->floor;
        if (flight_root_touch(scan->now, scene, c, step_length(scan->floor), &touch) &&
            touch < first) {
            first = touch;
            *contact = c;
        }
    }
    scan->level = levels[0];
    scan->longer = scan->level == tried ? AFTER_SUCCESS : AFTER_REFUSAL;
    return first;
}

/* Sets the probe's rigid part `time` after a motion or itself. */
static void move_gaps(struct motion *probe, const struct scene *scene, const struct motion *from,
                      double time)
{
    probe->time = from->time + time;
    for (size_t c = 0; c < scene->rows; c++) {
        double a = scene->gap_acceleration[c];
        probe->gap[c] = from->gap[c] + time * (from->gap_rate[c] + 0.5 * a * time);
        probe->gap_rate[c] = from->gap_rate[c] + a * time;
    }
}

/* Moves the probe to the interval's end, exactly. False: out of memory. */
static bool pass(struct scan *scan)
{
    struct motion *probe = &scan->flight->probe;
    for (size_t g = 0; g < scan->scene->groups; g++) {
        const struct scene_group *group = &scan->scene->group[g];
        const double *table = flight_table(group->set, scan->level);
        if (!table)
            return false;
        struct flight_modes modes = flight_modes_of(group, 0, scan->now->q[g], scan->now->v[g]);
        flight_kernel_step(table, &modes, probe->q[g], probe->v[g]);
    }
    move_gaps(probe, scan->scene, scan->now, step_length(scan->level));
    scan->now = probe;
    return true;
}

/* Ends the flight with the probe `left` from now, `time` from its start. */
static enum flight_end land(struct scan *scan, enum flight_end end, double time, double left)
{
    struct motion *probe = &scan->flight->probe;
    for (size_t g = 0; g < scan->scene->groups; g++) {
        struct flight_modes modes =
            flight_modes_of(&scan->scene->group[g], 0, scan->now->q[g], scan->now->v[g]);
        flight_kernel_turn(&modes, larger(0.0, left), probe->q[g], probe->v[g]);
    }
    move_gaps(probe, scan->scene, scan->start, time);
    return end;
}

/* Searches interval by interval. */
static enum flight_end follow(struct scan *scan, unsigned long intervals, double *time,
                              size_t *contact)
{
    struct flight *flight = scan->flight;
    for (unsigned long i = 1;; i++) {
        double from = scan->now->time - scan->start->time;
        double left = scan->end - from;
        *time = scan->end;
        if (!(left > 0.0))
            return land(scan, scan->reason, *time, left);
        /* an interval that stays open, or one with a touch */
        if (i > intervals || !pace_keeps(flight->pace, flight->cost))
            return FLIGHT_LIMIT;
        flight->intervals++;
        double touch = look_ahead(scan, contact);
        if (touch < left) {
            *time = from + touch;
            return land(scan, FLIGHT_TOUCH, *time, touch);
        }
        if (left <= step_length(scan->level))
            return land(scan, scan->reason, *time, left);
        /* past it; an interval that does not advance the time is rounding */
        double before = scan->now->time;
        if (!pass(scan))
            return FLIGHT_MEMORY;
        if (!(scan->now->time > before))
            return land(scan, scan->reason, *time, left);
        if (flight->damped && i % REFRESH == 0)
            find_end(scan);
    }
}

enum flight_end flight_find(struct flight *flight, const struct scene *scene,
                            const struct motion *motion, double allowed, unsigned long intervals,
                            double *time, size_t *contact)
{
    int floor = step_level(smaller(flight_root_longest(scene), allowed));
    struct scan scan = {.flight = flight,
                        .scene = scene,
                        .start = motion,
                        .now = motion,
                        .allowed = allowed,
                        .floor = floor,
                        .level = floor,
                        .longer = FIRST_TRY};
    if (allowed > 0.0 && touches_now(scene, motion, contact)) {
        motion_copy(&flight->probe, motion, scene);
        *time = 0.0;
        return FLIGHT_TOUCH;
    }
    find_end(&scan);
    return follow(&scan, intervals, time, contact);
}
