/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/circle_step.h"

#include <string.h>

#include "impact/step_table.h"

bool circle_step_create(struct circle_step *step, const struct scene *scene, size_t i, size_t parts,
                        const struct slip_points *points, struct arena *arena)
{
    const struct scene_friction *of = &scene->friction[i];
    *step = (struct circle_step){.points = points};
    return circles_create(&step->now, &scene->laws[of->contact], of->coefficient, of->ratio, parts,
                          arena) &&
           circles_second(&step->along, &step->now, arena) &&
           circles_second(&step->after, &step->now, arena);
}

void circle_step_begin(struct circle_step *step, double depth, double time, double indentation,
                       const double displacement[2])
{
    circles_touch(&step->now, depth, time - step->time, indentation, displacement);
    step->time = time;
}

/* From one place of the way to another, under this normal force there. */
static void go_on(struct circles *circles, double length, const struct slip_place *to,
                  struct slip_place *now, double normal)
{
    const struct circles_target target = {
        .indentation = to->value[0],
        .displacement = {to->value[1], to->value[2]},
        .normal = normal,
        .time = length * (to->at - now->at),
    };
    circles_walk(circles, &target);
    *now = *to;
}

void circle_step_nodes(struct circle_step *step, const struct friction_way *way,
                       const double normal[NODES], const struct circle_forces *forces)
{
    const struct slip_points *points = step->points;
    struct circles *along = &step->along;
    struct slip_place now = slip_place_at(way, &points->start);
    circles_copy(along, &step->now);
    for (int node = 0; node < NODES; node++) {
        if (node > 0) {
            const struct slip_place middle = slip_place_at(way, &points->middle[node - 1]);
            go_on(along, way->time, &middle, &now, collocation_value(normal, middle.at));
        }
        const struct slip_place place = slip_place_at(way, &points->node[node]);
        go_on(along, way->time, &place, &now, normal[node]);
        for (int j = 0; j < 2; j++) {
            forces->force[j][node] = along->force[j];
            forces->stiffness[j][node] = along->resists[j];
        }
        forces->across[node] = along->resists[2];
        forces->stuck[node] = along->stuck;
    }
}

void circle_step_end(struct circle_step *step, const struct friction_way *way, double normal,
                     double force[2], double stiffness[2])
{
    const struct slip_points *points = step->points;
    const struct slip_place end = slip_place_at(way, &points->end);
    struct slip_place now = slip_place_at(way, &points->last);
    circles_copy(&step->after, &step->along);
    go_on(&step->after, way->time, &end, &now, normal);
    for (int j = 0; j < 2; j++) {
        force[j] = step->after.force[j];
        stiffness[j] = step->after.resists[j];
        step->slip[j][0] = way->start[1 + j];
        memcpy(step->slip[j] + 1, way->nodes[1 + j], NODES * sizeof(double));
        step->slip[j][WAY_POINTS - 1] = way->end[1 + j];
    }
}

void circle_step_take(struct circle_step *step, int level, double (*const force)[NODES])
{
    struct circles taken = step->after;
    step->after = step->now;
    step->now = taken;
    step->time += step_length(level);
    for (int j = 0; j < 2; j++)
        step->work += slip_work(step->points, step->slip[j], force[j]);
}

double circle_step_lost(const struct circle_step *step)
{
    return step->work - step->now.stored;
}
