/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/slip_way.h"

#include <math.h>

#include "impact/simd.h"
#include "numeric/lagrange.h"

/* The start and the nodes; and the end. */
enum { INNER = NODES + 1, ALL = WAY_POINTS };

static void find_places(double place[ALL])
{
    place[0] = 0.0;
    for (int i = 0; i < NODES; i++)
        place[i + 1] = collocation.node[i];
    place[ALL - 1] = 1.0;
}

static void set_point(struct slip_point *point, size_t count, double at)
{
    double place[ALL];
    find_places(place);
    *point = (struct slip_point){.at = at, .count = count};
    lagrange_values(place, count, at, point->value);
    lagrange_slopes(place, count, at, point->slope);
}

void slip_points_make(struct slip_points *points)
{
    const double *node = collocation.node;
    set_point(&points->start, INNER, 0.0);
    for (int i = 0; i < NODES; i++)
        set_point(&points->node[i], INNER, node[i]);
    for (int i = 0; i + 1 < NODES; i++)
        set_point(&points->middle[i], INNER, 0.5 * (node[i] + node[i + 1]));
    set_point(&points->last, ALL, node[NODES - 1]);
    set_point(&points->end, ALL, 1.0);
    double place[ALL];
    find_places(place);
    for (int i = 0; i < NODES; i++)
        lagrange_slopes(place, ALL, collocation.node[i], points->node_rate[i]);
}

double slip_work(const struct slip_points *points, const double displacement[WAY_POINTS],
                 const double force[NODES])
{
    double sum = 0.0;
    for (int i = 0; i < NODES; i++) {
        double rate = 0.0;
        for (int j = 0; j < WAY_POINTS; j++)
            rate += points->node_rate[i][j] * displacement[j];
        sum += collocation.weight[i] * force[i] * rate;
    }
    return sum;
}

struct slip_place slip_place_at(const struct friction_way *way, const struct slip_point *point)
{
    struct slip_place place = {.at = point->at};
    const quad by = CONST_QUAD(point->value + 1), by_slope = CONST_QUAD(point->slope + 1);
    for (int r = 0; r < 3; r++) {
        const quad nodes = CONST_QUAD(way->nodes[r]);
        place.value[r] = point->value[0] * way->start[r] + TOTAL(by * nodes);
        place.rate[r] = point->slope[0] * way->start[r] + TOTAL(by_slope * nodes);
        if (point->count == ALL) {
            place.value[r] += point->value[NODES + 1] * way->end[r];
            place.rate[r] += point->slope[NODES + 1] * way->end[r];
        }
    }
    return place;
}

static void go_on(struct friction *friction, const struct slip_place *to, struct slip_place *now,
                  double force[2])
{
    double time = to->at - now->at;
    const double rate[3] = {time * to->rate[0], time * to->rate[1], time * to->rate[2]};
    friction_walk_curved(friction, to->value[0], to->value + 1, rate, force);
    *now = *to;
}

/* The share of a way at which a contact that slides begins to stick: from there on the elastic
 * forces of its cells along the slip no longer outgrow their limits, kappa u' < mu d'. 0: nowhere.
 * The cells know a way by its ends alone, and would miss a slip that still goes on and turns. */
static double begins_to_stick(const struct friction *friction, const struct slip_place *from,
                              const struct slip_place *to)
{
    const double *kappa = friction->ratio, *rate = from->rate, *next = to->rate;
    if (friction->stuck > 0.0 || !(from->value[0] > 0.0))
        return 0.0;
    double x = kappa[0] * rate[1] + kappa[1] * rate[2];
    double y = kappa[1] * rate[1] + kappa[2] * rate[2];
    double size = sqrt(x * x + y * y);
    double along = x * (kappa[0] * next[1] + kappa[1] * next[2]) +
                   y * (kappa[1] * next[1] + kappa[2] * next[2]);
    double before = size - friction->coefficient * rate[0];
    double after = along - friction->coefficient * next[0] * size; /* times the size */
    if (!(before > 0.0) || !(after < 0.0))
        return 0.0;
    return before * size / (before * size - after);
}

void slip_walk(struct friction *friction, const struct friction_way *way,
               const struct slip_point *to, struct slip_place *now, double force[2])
{
    const struct slip_place end = slip_place_at(way, to);
    double part = begins_to_stick(friction, now, &end);
    if (part > 0.0) {
        struct slip_point point;
        set_point(&point, to->count, now->at + part * (end.at - now->at));
        const struct slip_place turn = slip_place_at(way, &point);
        go_on(friction, &turn, now, force);
    }
    go_on(friction, &end, now, force);
}
