/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/yielding.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "contact/plastic.h"

bool yielding_create(struct yielding *yielding, struct arena *arena)
{
    size_t n = yielding->scene->contacts;
    yielding->any = yielding->approaching = false;
    for (size_t c = 0; c < n; c++)
        yielding->any = yielding->any || yielding->scene->laws[c].operations->curve;
    if (!yielding->any)
        return true;
    yielding->event = arena_take(arena, n, sizeof *yielding->event);
    return yielding->event != NULL;
}

/* Gives near_peak and near_kink errors of an eighth and a quarter of the accuracy. */
static const double NEARNESS = 0.5;

/* An event up to this many steps ahead is placed anew by the motion at the end of the step: there a
 * parabola is accurate. */
static const double FORESIGHT = 2.0;

/* The present motion gives the peak within this many times the distance at which a step must end:
 * the peak may lie behind or ahead, and has been placed anew meanwhile. */
static const double AROUND_PEAK = 2.0;

/* If unloading begins a time t late or early, the force has an error of the slope's jump times the
 * travel a t^2/2 during that time: the impulse has one of about (t/duration)^3. The duration is
 * that of unloading where it is shorter: a deep dent springs back by very little, at once. */
static double near_peak(const struct yielding *yielding, double duration)
{
    return NEARNESS * cbrt(yielding->accuracy) * duration;
}

/* Where reloading comes back to the virgin curve the travel is v t: the error is (t/duration)^2. */
static double near_kink(const struct yielding *yielding, double duration)
{
    return NEARNESS * sqrt(yielding->accuracy) * duration;
}

/* Coefficients of the derivative of the cubic through the nodes, a parabola. */
static void find_rate(const double values[NODES], double rate[3])
{
    memset(rate, 0, 3 * sizeof *rate);
    for (int j = 0; j < NODES; j++)
        for (int m = 0; m < 3; m++)
            rate[m] += values[j] * collocation.monomial[j][m + 1];
    rate[1] *= 2.0;
    rate[2] *= 3.0;
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
    bool turns;                                /* from rising to falling, */
    double peak;                               /* at this share of the step, */
    double largest;                            /* with this indentation */
};

/* Inserts the first turn, where the rate changes sign between two points. */
static void add_peak(struct path *path, const double nodes[NODES], double before)
{
    double rate[3];
    find_rate(nodes, rate);
    for (int i = 1; i < path->points; i++) {
        double after = rate[0] + path->place[i] * (rate[1] + path->place[i] * rate[2]);
        double step = path->place[i] - path->place[i - 1];
        if (before > 0.0 && after <= 0.0) {
            /* where the line between the two rates is zero */
            path->turns = true;
            path->peak = path->place[i - 1] + step * before / (before - after);
            path->largest = collocation_value(nodes, path->peak);
            /* as one more point */
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

/* Whether an indentation is passed, and at which share of the step first, linear between the points
 * around. */
static bool passes_on(const struct path *path, double target, double *place)
{
    for (int i = 1; i < path->points; i++) {
        double before = fmin(path->value[i - 1], target);
        if (!(path->value[i] > target))
            continue;
        *place = path->place[i - 1] + (path->place[i] - path->place[i - 1]) * (target - before) /
                                          (path->value[i] - before);
        return true;
    }
    return false;
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

/* Relative rounding of the limit, a difference of depths: half a bit of each and of their sums. */
static const double ROUNDING = 4.0 * DBL_EPSILON;

/* Whether an indentation exceeds the limit. A peak is accurate to the third power of its nearness:
 * one that exceeds the limit by less, or by the rounding of a deep dent, is the same peak again. */
static bool exceeds(const struct yielding *yielding, size_t contact, double indentation)
{
    const struct contact_law *law = &yielding->scene->laws[contact];
    double rounding = ROUNDING * law->history.max_indentation;
    return indentation > contact_law_limit(law) * (1.0 + yielding->accuracy) + rounding;
}

/* Time in which a contact unloads from the peak of its path, by the deceleration there. */
static double unloading_time(const struct yielding *yielding, size_t contact,
                             const struct path *path, double h)
{
    const struct contact_law *law = &yielding->scene->laws[contact];
    double depth = path->largest + law->history.dent;
    double springs_back = depth - law->operations->curve->residual(law, depth);
    double bend = -bend_at(yielding->step->indentation[contact], path->peak) / (h * h);
    return bend > 0.0 ? sqrt(2.0 * springs_back / bend) : INFINITY;
}

/* Notes an event if it is the first so far. */
static void note(struct yielding *yielding, size_t contact, struct yielding_event event)
{
    struct yielding_event *first = &yielding->event[contact];
    if (first->kind == EVENT_NONE || event.time < first->time)
        *first = event;
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
    double dent = law->history.dent;
    double place;
    /* an event expected on this step is searched again */
    if (yielding->event[contact].time < time + h)
        yielding->event[contact].kind = EVENT_NONE;
    /* reloading comes back to the virgin curve */
    double within = near_kink(yielding, duration);
    if (law->history.max_indentation > 0.0 && path.value[0] + rise * within < limit &&
        passes_on(&path, limit, &place))
        note(yielding, contact,
             (struct yielding_event){EVENT_PASSING, time + h * place, within, limit});

    /* the curve has a joint; a single contact may pass it (modal.c) */
    within = near_peak(yielding, duration);
    double start = fmax(path.value[0] + rise * within + dent, law->history.max_indentation);
    double joint = law->operations->curve->joint(law, start) - dent;
    bool corrected = yielding->scene->contacts == 1 && law->operations->curve->knots;
    if (!corrected && passes_on(&path, joint, &place))
        note(yielding, contact,
             (struct yielding_event){EVENT_PASSING, time + h * place, within, joint});

    /* loading beyond the limit ends; an indentation that already falls from there turned between
     * two steps, by less than the rounding of either */
    if (path.rise <= 0.0 && exceeds(yielding, contact, path.value[0])) {
        path.turns = true;
        path.peak = 0.0;
        path.largest = path.value[0];
    }
    if (!path.turns || !exceeds(yielding, contact, path.largest))
        return;
    within = near_peak(yielding, fmin(duration, unloading_time(yielding, contact, &path, h)));
    note(yielding, contact,
         (struct yielding_event){EVENT_PEAK, time + h * path.peak, within, path.largest});
}

/* First positive root of d + v t + a t^2/2 = target; INFINITY: none. */
static double rise_time(const struct contact_start *now, double target)
{
    double left = target - now->indentation;
    double under = now->rate * now->rate + 2.0 * now->curvature * left;
    double root = now->rate + sqrt(fmax(0.0, under));
    return under >= 0.0 && root > 0.0 ? 2.0 * left / root : INFINITY;
}

/* Places the expected event anew by the present motion, after a step that ended near it. */
static void correct(struct yielding *yielding, size_t contact)
{
    struct yielding_event *event = &yielding->event[contact];
    const struct contact_start *now = &yielding->now[contact];
    double left = event->kind == EVENT_PASSING ? rise_time(now, event->indentation)
                                               : -now->rate / now->curvature;
    if (isfinite(left))
        event->time = yielding->outcome->motion.time + left;
}

int yielding_level(const struct yielding *yielding, int level)
{
    for (size_t c = 0; c < yielding->scene->contacts; c++) {
        const struct yielding_event *event = &yielding->event[c];
        double left = event->time + event->within - yielding->outcome->motion.time;
        while (event->kind != EVENT_NONE && level < STEP_LEVELS - 1 && step_length(level) > left)
            level++;
    }
    return level;
}

static bool is_due(const struct yielding *yielding, size_t contact)
{
    const struct yielding_event *event = &yielding->event[contact];
    return event->kind != EVENT_NONE &&
           event->time - yielding->outcome->motion.time <= event->within;
}

/* Makes an indentation of a contact the largest so far. */
static void yield(struct yielding *yielding, size_t contact, double indentation)
{
    struct impact_outcome *outcome = yielding->outcome;
    struct contact_law *law = &outcome->laws[contact];
    double before = law->history.dent;
    outcome->plastic += contact_law_yield(law, indentation);
    double deeper = law->history.dent - before;
    outcome->motion.gap[contact] += deeper;
    outcome->tracks[contact].deepened += deeper;
    yielding->now[contact].indentation -= deeper;
    if (yielding->scene->frictions)
        friction_step_deepen(yielding->step->friction, yielding->scene, contact, deeper);
}

/* The largest indentation of a contact that is near its peak, by the motion at this instant. If the
 * deceleration changes before the peak, the step that contains the peak gives it (`seen`), or the
 * dent would be lost. False: the peak is not near. */
static bool find_peak(const struct yielding *yielding, size_t contact, bool seen, double *peak)
{
    const struct contact_start *now = &yielding->now[contact];
    const struct yielding_event *event = &yielding->event[contact];
    double left = -now->rate / now->curvature;
    bool near = now->curvature < 0.0 && fabs(left) <= AROUND_PEAK * event->within;
    *peak = near ? now->indentation + 0.5 * now->rate * left : event->indentation;
    return near || seen;
}

/* Takes the expected event. True: the law yielded; false: an indentation is passed, or the largest
 * one stayed below the limit. */
static bool take(struct yielding *yielding, size_t contact, bool seen)
{
    struct yielding_event *event = &yielding->event[contact];
    double peak;
    bool yields = event->kind == EVENT_PEAK && yielding->closed[contact] &&
                  find_peak(yielding, contact, seen, &peak) && exceeds(yielding, contact, peak);
    event->kind = EVENT_NONE;
    if (yields)
        yield(yielding, contact, peak);
    return yields;
}

/* Restores the level of the steps before the approach. */
static void resume(struct yielding *yielding, int *level)
{
    if (yielding->approaching)
        *level = yielding->resume;
    yielding->approaching = false;
}

bool yielding_passes(struct yielding *yielding, double h, int *level)
{
    double end = yielding->outcome->motion.time + h;
    bool passes = false;
    bool yielded = false;
    /* the events on the step; one that is due already is taken where the step begins */
    for (size_t c = 0; c < yielding->scene->contacts; c++) {
        const struct yielding_event *event = &yielding->event[c];
        if (!yielding->scene->laws[c].operations->curve)
            continue;
        expect(yielding, c, h);
        if (event->kind == EVENT_NONE || !(end > event->time + event->within))
            continue;
        if (is_due(yielding, c))
            yielded = take(yielding, c, true) || yielded;
        else
            passes = true;
    }
    /* the next step: with the new law, or up to the first event */
    if (yielded) {
        resume(yielding, level);
    } else if (passes) {
        if (!yielding->approaching)
            yielding->resume = *level;
        yielding->approaching = true;
        *level = yielding_level(yielding, *level);
    }
    return passes || yielded;
}

bool yielding_meet(struct yielding *yielding, double h, int *level)
{
    bool met = false;
    for (size_t c = 0; c < yielding->scene->contacts; c++) {
        const struct yielding_event *event = &yielding->event[c];
        double left = event->time - yielding->outcome->motion.time;
        if (event->kind == EVENT_NONE)
            continue;
        /* a past event is of the accepted step; a coming one maybe of a rejected step */
        bool seen = left <= 0.0;
        if (!is_due(yielding, c) && left <= FORESIGHT * h)
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
