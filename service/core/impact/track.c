/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/track.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "impact/node_factors.h"

bool track_create(struct track *track, struct arena *arena)
{
    track->list = arena_reserve(arena, PERCUSS_MAX_SUB_IMPACTS, sizeof *track->list);
    track_clear(track);
    return track->list != NULL;
}

void track_clear(struct track *track)
{
    track->count = 0;
    track->impulse = track->moment = 0.0;
    track->inertia = track->viscosity = 0.0;
    track->end_time = 0.0;
    track->tangential[0] = track->tangential[1] = 0.0;
    track->compressed = track->released = 0.0;
}

void track_open(struct track *track, double time, double gap_rate)
{
    track->open = (struct sub_impact){
        .start = time, .compression_end = time, .end = time, .gap_rate_before = gap_rate};
    track->deepened = track->largest_force = 0.0;
    track->stuck = track->slid = false;
}

enum { POINTS = NODES + 2 }; /* start, nodes, end of a step */

/* Newton's method for the peak of a polynomial of degree five: the start is so far within the step,
 * and each round squares the error. */
static const double WITHIN = 0.05;
enum { PEAK_ROUNDS = 4 };

/* A step with a largest value below this share of the contact's is past the peak: the polynomial
 * rises by less between the points. */
static const double PAST_PEAK = 0.999;

/* Newton's form of the polynomial through the step's six values: value[i] becomes the divided
 * difference of the first i + 1. */
static void divide(const double place[POINTS], double value[POINTS])
{
    for (int order = 1; order < POINTS; order++)
        for (int i = POINTS - 1; i >= order; i--)
            value[i] = (value[i] - value[i - 1]) / (place[i] - place[i - order]);
}

/* That polynomial at s, with its derivatives: d[0..2]. */
static void differentiate(const double place[POINTS], const double divided[POINTS], double s,
                          double d[3])
{
    d[0] = divided[POINTS - 1];
    d[1] = d[2] = 0.0;
    for (int i = POINTS - 2; i >= 0; i--) {
        double x = s - place[i];
        d[2] = d[2] * x + 2.0 * d[1];
        d[1] = d[1] * x + d[0];
        d[0] = d[0] * x + divided[i];
    }
}

/* Place of that polynomial's largest value around point i, between the neighbouring points; *peak
 * becomes the value. */
static double peak_around(const double place[POINTS], const double value[POINTS], int i,
                          double *peak)
{
    double d[3];
    double divided[POINTS];
    double low = place[i > 0 ? i - 1 : 0];
    double high = place[i + 1 < POINTS ? i + 1 : i];
    double s = smaller(larger(place[i], WITHIN), 1.0 - WITHIN);
    memcpy(divided, value, sizeof divided);
    divide(place, divided);
    /* a root of its slope, while its second derivative is negative */
    differentiate(place, divided, s, d);
    for (int round = 0; round < PEAK_ROUNDS && d[2] < 0.0; round++) {
        s = smaller(larger(s - d[1] / d[2], low), high);
        differentiate(place, divided, s, d);
    }
    *peak = larger(d[0], value[i]);
    return d[0] > value[i] ? s : place[i];
}

/* Finds the peak of a step that does not end with its largest indentation, and records it if it is
 * the contact's largest. */
static void find_peak(struct sub_impact *open, double time, double h,
                      const struct track_values *values, double deepened)
{
    double place[POINTS] = {0.0};
    double value[POINTS] = {values->start + deepened};
    double indentation;
    int largest = 0;
    /* the indentation at start, nodes and end */
    place[POINTS - 1] = 1.0;
    value[POINTS - 1] = values->end + deepened;
    for (int j = 0; j < NODES; j++) {
        place[j + 1] = collocation.node[j];
        value[j + 1] = values->indentation[j] + deepened;
    }
    for (int i = 1; i < POINTS; i++)
        if (value[i] > value[largest])
            largest = i;
    double s = peak_around(place, value, largest, &indentation);
    if (indentation > open->max_indentation) {
        open->max_indentation = indentation;
        open->compression_end = time + s * h;
        open->compression_impulse = open->impulse + h * collocation_integral(values->force, s);
    }
}

/* Adds the effect of omitted inertia and viscosity: int K' F' dt and int F'^2 dt by the derivatives
 * of the nodes' polynomials. */
static void add_omitted(struct track *track, double h, const struct track_values *values)
{
    node_pair low = {0.0, 0.0};
    node_pair high = {0.0, 0.0};
    double inertia = 0.0;
    double viscosity = 0.0;
    for (int j = 0; j < NODES; j++) {
        low += NODE_CONST_PAIR(collocation.slopes[j]) * values->force[j];
        high += NODE_CONST_PAIR(collocation.slopes[j] + 2) * values->force[j];
    }
    const double sum[NODES] = {low[0], low[1], high[0], high[1]};
    for (int i = 0; i < NODES; i++) {
        inertia += values->stiffness[i] * sum[i];
        viscosity += values->force[i] * sum[i];
    }
    track->inertia += inertia / h;
    track->viscosity += viscosity / h;
}

void track_step(struct track *track, double time, double h, const struct track_values *values)
{
    struct sub_impact *open = &track->open;
    const double *d = values->indentation;
    double before = larger(larger(larger(d[0], d[1]), larger(d[2], d[3])), values->start);
    double impulse = 0.0;
    double later = 0.0;
    for (int j = 0; j < NODES; j++) {
        impulse += collocation.weight[j] * values->force[j];
        later += collocation.weight[j] * collocation.node[j] * values->force[j];
    }
    impulse *= h;
    track->moment += time * impulse + h * h * later;
    /* the largest indentation: while it rises, the step's end; a later step finds the peak */
    if (values->end > before && values->end + track->deepened > open->max_indentation) {
        open->max_indentation = values->end + track->deepened;
        open->compression_end = time + h;
        open->compression_impulse = open->impulse + impulse;
    } else if (larger(before, values->end) + track->deepened > PAST_PEAK * open->max_indentation) {
        find_peak(open, time, h, values, track->deepened);
    }
    open->impulse += impulse;
    add_omitted(track, h, values);
}

/* Where the rate passes zero on a step, by a straight line between nodes; 1: nowhere. */
static double turn_of(const double rate[NODES])
{
    const double *node = collocation.node;
    for (int j = 0; j + 1 < NODES; j++)
        if ((rate[j] < 0.0) != (rate[j + 1] < 0.0))
            return node[j] + (node[j + 1] - node[j]) * rate[j] / (rate[j] - rate[j + 1]);
    return 1.0;
}

void track_work(struct track *track, double h, const double *force, const double *rate)
{
    double power[NODES], sum = 0.0;
    for (int j = 0; j < NODES; j++) {
        power[j] = h * force[j] * rate[j];
        sum += collocation.weight[j] * power[j];
    }
    double before = turn_of(rate) < 1.0 ? collocation_integral(power, turn_of(rate)) : sum;
    const double parts[2] = {before, sum - before};
    for (int i = 0; i < 2; i++)
        *(parts[i] < 0.0 ? &track->compressed : &track->released) += fabs(parts[i]);
}

void track_slide(struct track *track, double h, const double *normal, double (*const force)[NODES],
                 const double *stuck)
{
    for (int j = 0; j < NODES; j++) {
        for (int t = 0; t < 2; t++)
            track->open.impulse_tangential[t] += h * collocation.weight[j] * force[t][j];
        track->slid = track->slid || (normal[j] > 0.0 && stuck[j] == 0.0);
        track->stuck = track->stuck || stuck[j] > 0.0;
    }
}

/* A slip that opposes the one before, but is below this share of it, is none: plain friction stops
 * it to rounding. */
static const double AT_REST = 1e-9;

/* Of the sub-impact under way; one that sticks at first and turns back may slide then. */
static enum percuss_friction_state state_of(const struct track *track)
{
    const double *before = track->open.slip_before, *after = track->open.slip_after;
    if (!track->slid)
        return track->stuck ? PERCUSS_FRICTION_STATE_STUCK : PERCUSS_FRICTION_STATE_NONE;
    double square = before[0] * before[0] + before[1] * before[1];
    if (before[0] * after[0] + before[1] * after[1] < -AT_REST * square)
        return PERCUSS_FRICTION_STATE_REVERSED;
    return track->stuck ? PERCUSS_FRICTION_STATE_PARTLY : PERCUSS_FRICTION_STATE_SLID;
}

void track_close(struct track *track, const struct contact_law *law, double time, double gap_rate)
{
    struct sub_impact *open = &track->open;
    double stiffness;
    if (law->operations->lossy && track->largest_force == 0.0)
        return;
    open->end = time;
    open->gap_rate_after = gap_rate;
    open->peak_force = contact_law_force(law, open->max_indentation - track->deepened, &stiffness);
    if (law->operations->lossy)
        open->peak_force = track->largest_force;
    track->impulse += open->impulse;
    for (int t = 0; t < 2; t++)
        track->tangential[t] += open->impulse_tangential[t];
    open->friction_state = state_of(track);
    track->end_time = time;
    if (track->count < PERCUSS_MAX_SUB_IMPACTS)
        track->list[track->count] = *open;
    track->count++;
}

void track_mark_negligible(struct track *track)
{
    for (size_t i = 0; i < track->count && i < PERCUSS_MAX_SUB_IMPACTS; i++)
        track->list[i].negligible = track->list[i].impulse < IMPACT_NEGLIGIBLE * track->impulse;
}
