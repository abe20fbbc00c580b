/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/yielding.h"

#include <math.h>
#include <string.h>

#include "contact/plastic.h"

bool yielding_create(struct yielding *yielding, struct arena *arena)
{
    size_t n = yielding->scene->contacts;
    yielding->any = false;
    yielding->resume = -1;
    for (size_t c = 0; c < n; c++)
        yielding->any = yielding->any || yielding->scene->laws[c].operations->curve;
    if (!yielding->any)
        return true;
    yielding->when = arena_take(arena, n, sizeof(double));
    yielding->target = arena_take(arena, n, sizeof(double));
    yielding->within = arena_take(arena, n, sizeof(double));
    yielding->largest = arena_take(arena, n, sizeof(double));
    for (size_t c = 0; yielding->when && c < n; c++)
        yielding->when[c] = INFINITY;
    return yielding->when && yielding->target && yielding->within && yielding->largest;
}

/* Unloading that begins a time t late, or early, gives a force wrong by its slope's jump times the
 * travel, a t^2/2, for that time: the impulse is wrong by about (t/duration)^3. The duration is
 * that of unloading where it is shorter: a deep dent springs back by next to nothing, at once. */
static double near_peak(const struct yielding *yielding, double duration)
{
    return 0.5 * cbrt(yielding->accuracy) * duration;
}

/* Where reloading comes back to the virgin curve the travel is v t: (t/duration)^2. */
static double near_kink(const struct yielding *yielding, double duration)
{
    return 0.5 * sqrt(yielding->accuracy) * duration;
}

/* Rate of the cubic through the nodes. */
static double rate_at(const double values[NODES], double s)
{
    double rate = 0.0;
    for (int j = 0; j < NODES; j++) {
        const double *c = collocation.monomial[j];
        rate += values[j] * (c[1] + s * (2.0 * c[2] + 3.0 * s * c[3]));
    }
    return rate;
}

/* Second derivative of the cubic through the nodes. */
static double bend_at(const double values[NODES], double s)
{
    double bend = 0.0;
    for (int j = 0; j < NODES; j++)
        bend +=
            values[j] * (2.0 * collocation.monomial[j][2] + 6.0 * s * collocation.monomial[j][3]);
    return bend;
}

/* One contact on the step just solved: start, nodes, end, and the first instant at which the
 * indentation turns. */
struct path {
    int points;
    double place[NODES + 3], value[NODES + 3]; /* share of the step, m */
    double rise;                               /* rate at the start, m/s */
    double peak;                               /* share of the step; INFINITY: none */
    double largest;                            /* indentation there */
};

/* Inserts the first turn, where the rate changes sign between two points. */
static void add_peak(struct path *path, const double nodes[NODES], double before)
{
    path->peak = INFINITY;
    for (int i = 1; i < path->points; i++) {
        double after = rate_at(nodes, path->place[i]);
        double step = path->place[i] - path->place[i - 1];
        if (before > 0.0 && after <= 0.0) {
            path->peak = path->place[i - 1] + step * before / (before - after);
            path->largest = collocation_value(nodes, path->peak);
            size_t rest = (size_t)(path->points - i);
            memmove(path->place + i + 1, path->place + i, rest * sizeof(double));
            memmove(path->value + i + 1, path->value + i, rest * sizeof(double));
            path->place[i] = path->peak;
            path->value[i] = path->largest;
            path->points++;
            return;
        }
        before = after;
    }
}

static struct path path_of(const struct yielding *yielding, size_t contact, double h)
{
    const double *nodes = yielding->step->indentation[contact];
    struct path path = {.points = NODES + 2, .rise = yielding->now[contact].rate};
    path.value[0] = yielding->now[contact].indentation;
    for (int j = 0; j < NODES; j++) {
        path.place[j + 1] = collocation.node[j];
        path.value[j + 1] = nodes[j];
    }
    path.place[NODES + 1] = 1.0;
    path.value[NODES + 1] = yielding->step->end_indentation[contact];
    add_peak(&path, nodes, h * path.rise);
    return path;
}

/* Where an indentation is first passed, linear between the points around; INFINITY: nowhere. */
static double crossing_on(const struct path *path, double target)
{
    for (int i = 1; i < path->points; i++) {
        double before = fmin(path->value[i - 1], target);
        if (path->value[i] > target)
            return path->place[i - 1] + (path->place[i] - path->place[i - 1]) * (target - before) /
                                            (path->value[i] - before);
    }
    return INFINITY;
}

/* Duration of the contact, or of the shortest one while it is still open. */
static double duration_of(const struct yielding *yielding, size_t contact)
{
    double shortest = INFINITY;
    if (yielding->closed[contact])
        return yielding->scales[contact].duration;
    for (size_t c = 0; c < yielding->scene->contacts; c++)
        if (yielding->closed[c])
            shortest = fmin(shortest, yielding->scales[c].duration);
    return shortest;
}

/* A peak is met to the third power of its nearness: one that exceeds the limit by less is the same
 * again. */
static bool exceeds(const struct yielding *yielding, size_t contact, double indentation)
{
    double limit = contact_law_limit(&yielding->scene->laws[contact]);
    return indentation > limit * (1.0 + yielding->accuracy);
}

/* Time in which a contact unloads from the peak of its path, by the deceleration there. */
static double unloading_time(const struct yielding *yielding, size_t contact,
                             const struct path *path, double h)
{
    const struct contact_law *law = &yielding->scene->laws[contact];
    double depth = path->largest + law->history.residual;
    double springs_back = depth - law->operations->curve->residual(law, depth);
    double bend = -bend_at(yielding->step->indentation[contact], path->peak) / (h * h);
    return bend > 0.0 ? sqrt(2.0 * springs_back / bend) : INFINITY;
}

/* Notes an event at a share of the step if it is the first so far. */
static void note(struct yielding *yielding, size_t contact, double when, double target,
                 double within)
{
    if (!(when < yielding->when[contact]))
        return;
    yielding->when[contact] = when;
    yielding->target[contact] = target;
    yielding->within[contact] = within;
}

/* Looks for the first event of a contact on the step just solved. One that was expected beyond the
 * step stays. */
static void expect(struct yielding *yielding, size_t contact, double h)
{
    const struct contact_law *law = &yielding->scene->laws[contact];
    struct path path = path_of(yielding, contact, h);
    double time = yielding->outcome->motion.time;
    double duration = duration_of(yielding, contact);
    double limit = contact_law_limit(law);
    double rise = fmax(0.0, path.rise);
    double residual = law->history.residual;
    double within = near_kink(yielding, duration);
    if (yielding->when[contact] < time + h)
        yielding->when[contact] = INFINITY;
    if (law->history.max_indentation > 0.0 && path.value[0] + rise * within < limit)
        note(yielding, contact, time + h * crossing_on(&path, limit), limit, within);

    within = near_peak(yielding, duration);
    double start = fmax(path.value[0] + rise * within + residual, law->history.max_indentation);
    double joint = law->operations->curve->joint(law, start) - residual;
    note(yielding, contact, time + h * crossing_on(&path, joint), joint, within);

    if (!exceeds(yielding, contact, path.largest))
        return;
    within = near_peak(yielding, fmin(duration, unloading_time(yielding, contact, &path, h)));
    double peak = time + h * path.peak;
    note(yielding, contact, peak, INFINITY, within);
    if (yielding->when[contact] == peak)
        yielding->largest[contact] = path.largest;
}

/* First positive root of d + v t + a t^2/2 = target; INFINITY: none. */
static double rise_time(const struct contact_start *now, double target)
{
    double left = target - now->indentation;
    double under = now->rate * now->rate + 2.0 * now->curvature * left;
    double root = now->rate + sqrt(fmax(0.0, under));
    return under >= 0.0 && root > 0.0 ? 2.0 * left / root : INFINITY;
}

/* The expected event from the motion at its present end, once a step that ends there came near. */
static void correct(struct yielding *yielding, size_t contact)
{
    const struct contact_start *now = &yielding->now[contact];
    double target = yielding->target[contact];
    double left = isfinite(target) ? rise_time(now, target) : -now->rate / now->curvature;
    if (isfinite(left))
        yielding->when[contact] = yielding->outcome->motion.time + left;
}

int yielding_level(const struct yielding *yielding, int level)
{
    for (size_t c = 0; c < yielding->scene->contacts; c++) {
        double left = yielding->when[c] + yielding->within[c] - yielding->outcome->motion.time;
        while (level < STEP_LEVELS - 1 && step_length(level) > left)
            level++;
    }
    return level;
}

static bool is_due(const struct yielding *yielding, size_t contact)
{
    return yielding->when[contact] - yielding->outcome->motion.time <= yielding->within[contact];
}

/* Makes an indentation of a contact the largest so far. */
static void yield(struct yielding *yielding, size_t contact, double indentation)
{
    struct impact_outcome *outcome = yielding->outcome;
    struct contact_law *law = &outcome->laws[contact];
    double before = law->history.residual;
    outcome->plastic += contact_law_yield(law, indentation);
    double deeper = law->history.residual - before;
    outcome->motion.gap[contact] += deeper;
    outcome->tracks[contact].deepened += deeper;
    yielding->now[contact].indentation -= deeper;
}

/* The largest indentation of a contact that is near its peak; NAN: it is not. The motion at this
 * instant tells, unless its deceleration changes on the way to the peak: then the step that has the
 * peak in it does (`seen`), or the dent would be lost. */
static double peak_indentation(const struct yielding *yielding, size_t contact, bool seen)
{
    const struct contact_start *now = &yielding->now[contact];
    double left = -now->rate / now->curvature;
    if (now->curvature < 0.0 && fabs(left) <= 2.0 * yielding->within[contact])
        return now->indentation + 0.5 * now->rate * left;
    return seen ? yielding->largest[contact] : NAN;
}

/* The expected event is here. True: the law yielded; otherwise an indentation is passed, or the
 * largest one stayed below the limit after all. */
static bool take(struct yielding *yielding, size_t contact, bool seen)
{
    yielding->when[contact] = INFINITY;
    if (isfinite(yielding->target[contact]) || !yielding->closed[contact])
        return false;
    double peak = peak_indentation(yielding, contact, seen);
    if (!exceeds(yielding, contact, peak))
        return false;
    yield(yielding, contact, peak);
    return true;
}

/* Steps as long as before the approach. */
static void resume(struct yielding *yielding, int *level)
{
    if (yielding->resume >= 0)
        *level = yielding->resume;
    yielding->resume = -1;
}

bool yielding_passes(struct yielding *yielding, double h, int *level)
{
    double end = yielding->outcome->motion.time + h;
    bool passes = false;
    bool yielded = false;
    for (size_t c = 0; c < yielding->scene->contacts; c++) {
        if (!yielding->scene->laws[c].operations->curve)
            continue;
        expect(yielding, c, h);
        if (!(end > yielding->when[c] + yielding->within[c]))
            continue;
        if (is_due(yielding, c))
            yielded = take(yielding, c, true) || yielded;
        else
            passes = true;
    }
    if (yielded) {
        resume(yielding, level);
    } else if (passes) {
        yielding->resume = yielding->resume < 0 ? *level : yielding->resume;
        *level = yielding_level(yielding, *level);
    }
    return passes || yielded;
}

bool yielding_meet(struct yielding *yielding, double h, int *level)
{
    bool met = false;
    for (size_t c = 0; c < yielding->scene->contacts; c++) {
        double left = yielding->when[c] - yielding->outcome->motion.time;
        if (!isfinite(left))
            continue;
        /* what lies behind is of the step just made; ahead, maybe of one that was not made */
        bool seen = left <= 0.0;
        if (!is_due(yielding, c) && left <= 2.0 * h)
            correct(yielding, c);
        if (!is_due(yielding, c))
            continue;
        take(yielding, c, seen);
        met = true;
    }
    if (met)
        resume(yielding, level);
    return met;
}

void yielding_end(struct yielding *yielding)
{
    for (size_t c = 0; c < yielding->scene->contacts; c++)
        if (yielding->closed[c] &&
            yielding->now[c].indentation > contact_law_limit(&yielding->scene->laws[c]))
            yield(yielding, c, yielding->now[c].indentation);
}
