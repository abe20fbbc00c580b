/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/friction_step.h"

#include <math.h>

#include "numeric/lagrange.h"
#include <string.h>

/* The start, the nodes and the end. */
static const size_t INNER = NODES + 1, ALL = NODES + 2;

static void set_point(struct friction_point *point, const double *place, size_t count, double s)
{
    lagrange_values(place, count, s, point->value);
    lagrange_slopes(place, count, s, point->slope);
}

static void set_polynomials(struct friction_points *points)
{
    double place[NODES + 2] = {0.0};
    for (int i = 0; i < NODES; i++)
        place[i + 1] = collocation.node[i];
    place[NODES + 1] = 1.0;
    for (int i = 0; i < NODES; i++)
        set_point(&points->to_node[i], place, INNER, place[i + 1]);
    for (int i = 1; i < NODES; i++)
        set_point(&points->to_middle[i - 1], place, INNER, 0.5 * (place[i] + place[i + 1]));
    set_point(&points->to_end, place, ALL, 1.0);
}

/* The error of a sphere's tangential speed after the impact, over the coefficient's speed, is
 * 0.3/cells^2; the steps' own error goes with their accuracy, too. */
static const double CELLS = 3.0;
enum { FEWEST_CELLS = 16, MOST_CELLS = 256 };

static size_t cells_for(double accuracy)
{
    double cells = CELLS * pow(accuracy, -0.25);
    return cells < FEWEST_CELLS ? FEWEST_CELLS : cells < MOST_CELLS ? (size_t)cells : MOST_CELLS;
}

bool friction_step_create(struct friction_step *step, const struct scene *scene, double accuracy,
                          struct arena *arena)
{
    size_t n = scene->frictions;
    step->count = n;
    step->plain = scene->plain;
    if (step->plain) {
        bool made = coulomb_create(&step->coulomb, scene, arena);
        step->stuck = step->coulomb.stuck;
        return made;
    }
    size_t cells = cells_for(accuracy);
    step->now = arena_take(arena, 3 * n, sizeof *step->now);
    step->stuck = arena_take(arena, n, sizeof *step->stuck);
    step->points = arena_take(arena, 1, sizeof *step->points);
    if (!step->now || !step->stuck || !step->points)
        return false;
    step->along = step->now + n;
    step->after = step->along + n;
    for (size_t i = 0; i < n; i++) {
        const struct scene_friction *of = &scene->friction[i];
        if (!friction_create(&step->now[i], of->coefficient, of->ratio, cells, arena) ||
            !friction_second(&step->along[i], &step->now[i], arena) ||
            !friction_second(&step->after[i], &step->now[i], arena))
            return false;
    }
    set_polynomials(step->points);
    return true;
}

void friction_step_begin(struct friction_step *step, const struct scene *scene, const double *d,
                         const double *depth)
{
    if (step->plain) {
        coulomb_begin(&step->coulomb);
        return;
    }
    for (size_t i = 0; i < step->count; i++) {
        size_t contact = scene->friction[i].contact;
        double none[2];
        friction_touch(&step->now[i], &scene->laws[contact], depth[contact]);
        friction_walk(&step->now[i], fmin(d[contact], 0.0), d + scene_tangent(scene, i), none);
    }
}

/* Goes on along the way to a point, by its polynomials. */
static void walk_to(struct friction *friction, const struct friction_way *way,
                    const struct friction_point *point, bool with_end, double force[2])
{
    double value[3], rate[3];
    for (int r = 0; r < 3; r++) {
        const double *nodes = way->nodes[r];
        value[r] = point->value[0] * way->start[r];
        rate[r] = point->slope[0] * way->start[r];
        for (int j = 0; j < NODES; j++) {
            value[r] += point->value[j + 1] * nodes[j];
            rate[r] += point->slope[j + 1] * nodes[j];
        }
        if (with_end) {
            value[r] += point->value[NODES + 1] * way->end[r];
            rate[r] += point->slope[NODES + 1] * way->end[r];
        }
    }
    friction_walk_curved(friction, value[0], value + 1, rate + 1, force);
}

/* The solved normal force over that of the law at the solved indentation, which differ by what the
 * iteration leaves: so a contact that slides has its coefficient's share to rounding. */
static double solved_share(const struct friction *friction, double normal)
{
    return normal > 0.0 && friction->normal > 0.0 ? normal / friction->normal : 1.0;
}

void friction_step_nodes(struct friction_step *step, size_t i, const struct friction_way *way,
                         bool halved, const double normal[NODES], double (*force)[NODES],
                         double (*stiffness)[NODES])
{
    struct friction *along = &step->along[i];
    double sum[2];
    friction_copy(along, &step->now[i]);
    for (int node = 0; node < NODES; node++) {
        if (halved && node > 0)
            walk_to(along, way, &step->points->to_middle[node - 1], false, sum);
        walk_to(along, way, &step->points->to_node[node], false, sum);
        double share = solved_share(along, normal[node]);
        for (int j = 0; j < 2; j++) {
            force[j][node] = share * sum[j];
            stiffness[j][node] = along->resists[j];
        }
        step->stuck[i][node] = along->stuck;
    }
}

void friction_step_end(struct friction_step *step, size_t i, const struct friction_way *way,
                       double normal, double force[2], double stiffness[2])
{
    struct friction *after = &step->after[i];
    friction_copy(after, &step->along[i]);
    walk_to(after, way, &step->points->to_end, true, force);
    double share = solved_share(after, normal);
    for (int j = 0; j < 2; j++) {
        force[j] *= share;
        stiffness[j] = after->resists[j];
    }
}

void friction_step_deepen(struct friction_step *step, const struct scene *scene, size_t contact,
                          double deeper)
{
    size_t friction = scene_friction_of(scene, contact);
    if (friction < step->count && !step->plain)
        friction_deepen(&step->now[friction], deeper);
}

void friction_step_take(struct friction_step *step)
{
    if (step->plain) {
        coulomb_take(&step->coulomb);
        return;
    }
    for (size_t i = 0; i < step->count; i++) {
        struct friction taken = step->after[i];
        step->after[i] = step->now[i];
        step->now[i] = taken;
    }
}

double friction_step_rounding(const struct friction_step *step, size_t i)
{
    return step->plain ? step->coulomb.rounding[i] : 0.0;
}

double friction_step_lost(const struct friction_step *step, size_t i)
{
    return step->plain ? step->coulomb.lost[i] : step->now[i].lost;
}

double friction_step_stored(const struct friction_step *step, size_t i)
{
    return step->plain ? 0.0 : friction_stored(&step->now[i]);
}

void friction_step_force(const struct friction_step *step, size_t i, double force[2])
{
    if (step->plain)
        memcpy(force, step->coulomb.force[i], sizeof step->coulomb.force[i]);
    else
        friction_force(&step->now[i], force);
}
