/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/friction_step.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "numeric/lagrange.h"

/* The error of a sphere's tangential speed after the impact, over the coefficient's speed, is
 * 0.3/cells^2; the steps' own error goes with their accuracy, too. */
static const double CELLS = 3.0;
enum { FEWEST_CELLS = 16, MOST_CELLS = 256 };

static size_t cells_for(double accuracy)
{
    double cells = CELLS * pow(accuracy, -0.25);
    return cells < FEWEST_CELLS ? FEWEST_CELLS : cells < MOST_CELLS ? (size_t)cells : MOST_CELLS;
}

/* Of friction `i`, where the contact's law has a loss; else NULL. */
static struct circle_step *circles_of(const struct friction_step *step, size_t i)
{
    return step->circles ? step->circles[i] : NULL;
}

static bool create_circles(struct friction_step *step, const struct scene *scene, size_t i,
                           size_t parts, struct arena *arena)
{
    struct circle_step *made = step->circles[i] = arena_take(arena, 1, sizeof *made);
    return made && circle_step_create(made, scene, i, parts, step->points, arena);
}

static bool create_cells(struct friction_step *step, const struct scene *scene, size_t i,
                         size_t parts, struct arena *arena)
{
    const struct scene_friction *of = &scene->friction[i];
    return friction_create(&step->now[i], of->coefficient, of->ratio, parts, arena) &&
           friction_second(&step->along[i], &step->now[i], arena) &&
           friction_second(&step->after[i], &step->now[i], arena);
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
    step->stuck = arena_take(arena, 2 * n, sizeof *step->stuck);
    step->points = arena_take(arena, 1, sizeof *step->points);
    step->taken = arena_take(arena, 3 * n, sizeof *step->taken);
    step->circles = arena_take(arena, n, sizeof *step->circles);
    if (!step->now || !step->stuck || !step->points || !step->taken || !step->circles)
        return false;
    step->across = step->stuck + n;
    step->along = step->now + n;
    step->after = step->along + n;
    slip_points_make(step->points);
    for (size_t i = 0; i < n; i++) {
        bool lossy = scene->laws[scene->friction[i].contact].operations->lossy;
        if (!(lossy ? create_circles : create_cells)(step, scene, i, cells, arena))
            return false;
    }
    return true;
}

/* The forces from a touch on, over the normal one: on a way in proportion kappa times the rates'
 * ratio where no cell slips, and the coefficient where all do. */
static void begin_taken(const struct scene_friction *friction, const double rate[3],
                        double (*taken)[NODES])
{
    const double *kappa = friction->ratio;
    double over = rate[0] > 0.0 ? 1.0 / rate[0] : 0.0;
    double x = over * (kappa[0] * rate[1] + kappa[1] * rate[2]);
    double y = over * (kappa[1] * rate[1] + kappa[2] * rate[2]);
    double size = hypot(x, y);
    double part = size > friction->coefficient ? friction->coefficient / size : 1.0;
    for (int k = 0; k < NODES; k++) {
        taken[0][k] = 1.0;
        taken[1][k] = part * x;
        taken[2][k] = part * y;
    }
}

void friction_step_begin(struct friction_step *step, const struct scene *scene, double time,
                         const double *d, const double *rate, const double *depth)
{
    if (step->plain) {
        coulomb_begin(&step->coulomb);
        return;
    }
    step->level = 0;
    for (size_t i = 0; i < step->count; i++) {
        size_t contact = scene->friction[i].contact, row = scene_tangent(scene, i);
        const double rates[3] = {rate[contact], rate[row], rate[row + 1]};
        double none[2];
        struct circle_step *circles = circles_of(step, i);
        if (circles) {
            circle_step_begin(circles, depth[contact], time, smaller(d[contact], 0.0), d + row);
        } else {
            friction_touch(&step->now[i], &scene->laws[contact], depth[contact]);
            friction_walk(&step->now[i], smaller(d[contact], 0.0), d + row, none);
        }
        begin_taken(&scene->friction[i], rates, step->taken + 3 * i);
    }
}

void friction_step_predict(const struct friction_step *step, const struct scene *scene, int level,
                           double (*force)[NODES])
{
    const double *node = collocation.node, last[NODES] = {node[1], node[2], node[3], 1.0};
    for (int k = 0; k < NODES; k++) {
        double by[NODES];
        lagrange_values(last, NODES, 1.0 + ldexp(node[k], step->level - level), by);
        for (size_t i = 0; i < step->count; i++) {
            const struct scene_friction *friction = &scene->friction[i];
            size_t row = scene_tangent(scene, i);
            double next[3];
            for (int r = 0; r < 3; r++) {
                const double *taken = step->taken[3 * i + r];
                next[r] =
                    (by[0] * taken[0] + by[1] * taken[1]) + (by[2] * taken[2] + by[3] * taken[3]);
            }
            double over = next[0] > 0.0 ? 1.0 / next[0] : 0.0;
            double share = over * sqrt(next[1] * next[1] + next[2] * next[2]);
            if (share > friction->coefficient)
                over *= friction->coefficient / share;
            for (size_t j = 0; j < 2; j++)
                force[row + j][k] = over * next[1 + j] * force[friction->contact][k];
        }
    }
}

/* The solved normal force over that of the law at the solved indentation, which differ by what the
 * iteration leaves: so a contact that slides has its coefficient's share to rounding. */
static double solved_share(const struct friction *friction, double normal)
{
    return normal > 0.0 && friction->at.force > 0.0 ? normal / friction->at.force : 1.0;
}

/* Walks to the nodes, through the middles between two of them or not. Whether the contact slides
 * throughout: no cell sticks at any node. */
static bool walk_nodes(struct friction_step *step, size_t i, const struct friction_way *way,
                       bool halved, const double normal[NODES], double (*force)[NODES],
                       double (*stiffness)[NODES])
{
    const struct slip_points *points = step->points;
    struct friction *along = &step->along[i];
    struct slip_place now = slip_place_at(way, &points->start);
    double sum[2];
    bool slides = true;
    friction_copy(along, &step->now[i]);
    for (int node = 0; node < NODES; node++) {
        if (halved && node > 0)
            slip_walk(along, way, &points->middle[node - 1], &now, sum);
        slip_walk(along, way, &points->node[node], &now, sum);
        double share = solved_share(along, normal[node]);
        for (int j = 0; j < 2; j++) {
            force[j][node] = share * sum[j];
            stiffness[j][node] = along->resists[j];
        }
        step->across[i][node] = along->resists[2];
        step->stuck[i][node] = along->stuck;
        slides = slides && along->stuck == 0.0;
    }
    return slides;
}

bool friction_step_slid(const struct friction_step *step, size_t i)
{
    const struct circle_step *circles = circles_of(step, i);
    return (circles ? circles->now.stuck : step->now[i].stuck) == 0.0;
}

/* The tangent of the angle by which the slip turns between a step's start and its last node, up to
 * which its way needs no points between the nodes where the contact slides throughout: each of its
 * parts then turns by some degrees, of which the walk leaves little (unit/contact/test_friction.c).
 * Without a limit two_inverse_masses (physics/test_delassus.c) is wrong by twice its tolerance. */
static const double TURNS_LITTLE = 0.2;

static bool turns_little(const struct friction_step *step, const struct friction_way *way)
{
    const struct slip_place start = slip_place_at(way, &step->points->start);
    const struct slip_place last = slip_place_at(way, &step->points->node[NODES - 1]);
    const double *from = start.rate, *to = last.rate;
    double across = from[1] * to[2] - from[2] * to[1];
    return fabs(across) <= TURNS_LITTLE * (from[1] * to[1] + from[2] * to[2]);
}

void friction_step_nodes(struct friction_step *step, size_t i, const struct friction_way *way,
                         const double normal[NODES], double (*force)[NODES],
                         double (*stiffness)[NODES])
{
    struct circle_step *circles = circles_of(step, i);
    if (circles) {
        const struct circle_forces forces = {force, stiffness, step->across[i], step->stuck[i]};
        circle_step_nodes(circles, way, normal, &forces);
        return;
    }
    bool slides = friction_step_slid(step, i) && turns_little(step, way) &&
                  walk_nodes(step, i, way, false, normal, force, stiffness);
    if (!slides)
        walk_nodes(step, i, way, true, normal, force, stiffness);
}

void friction_step_end(struct friction_step *step, size_t i, const struct friction_way *way,
                       double normal, double force[2], double stiffness[2])
{
    struct circle_step *circles = circles_of(step, i);
    if (circles) {
        circle_step_end(circles, way, normal, force, stiffness);
        return;
    }
    struct friction *after = &step->after[i];
    struct slip_place now = slip_place_at(way, &step->points->last);
    friction_copy(after, &step->along[i]);
    slip_walk(after, way, &step->points->end, &now, force);
    double share = solved_share(after, normal);
    for (int j = 0; j < 2; j++) {
        force[j] *= share;
        stiffness[j] = after->resists[j];
    }
}

bool friction_step_slides(const struct friction_step *step, size_t i)
{
    const double *stuck = step->stuck[i];
    const struct circle_step *circles = circles_of(step, i);
    double after = circles ? circles->after.stuck : step->after[i].stuck;
    return stuck[0] + stuck[1] + stuck[2] + stuck[3] + after == 0.0;
}

void friction_step_deepen(struct friction_step *step, const struct scene *scene, size_t contact,
                          double deeper)
{
    size_t friction = scene_friction_of(scene, contact);
    if (friction < step->count && !step->plain && !circles_of(step, friction))
        friction_deepen(&step->now[friction], deeper);
}

void friction_step_take(struct friction_step *step, const struct scene *scene, int level,
                        double (*const force)[NODES], const double *end_force)
{
    if (step->plain) {
        coulomb_take(&step->coulomb);
        return;
    }
    for (size_t i = 0; i < step->count; i++) {
        struct circle_step *circles = circles_of(step, i);
        if (circles) {
            circle_step_take(circles, level, force + scene_tangent(scene, i));
            continue;
        }
        struct friction taken = step->after[i];
        step->after[i] = step->now[i];
        step->now[i] = taken;
    }
    for (size_t i = 0; i < step->count; i++) {
        size_t row = scene_tangent(scene, i), rows[3] = {scene->friction[i].contact, row, row + 1};
        for (int r = 0; r < 3; r++) {
            double *taken = step->taken[3 * i + r];
            memcpy(taken, force[rows[r]] + 1, (NODES - 1) * sizeof *taken);
            taken[NODES - 1] = end_force[rows[r]];
        }
    }
    step->level = level;
}

double friction_step_rounding(const struct friction_step *step, size_t i)
{
    return step->plain ? step->coulomb.rounding[i] : 0.0;
}

double friction_step_lost(const struct friction_step *step, size_t i)
{
    const struct circle_step *circles = circles_of(step, i);
    if (circles)
        return circle_step_lost(circles);
    return step->plain ? step->coulomb.lost[i] : step->now[i].lost;
}

double friction_step_stored(const struct friction_step *step, size_t i)
{
    const struct circle_step *circles = circles_of(step, i);
    if (circles)
        return circles->now.stored;
    return step->plain ? 0.0 : friction_stored(&step->now[i]);
}

void friction_step_force(const struct friction_step *step, size_t i, double force[2])
{
    const struct circle_step *circles = circles_of(step, i);
    if (step->plain)
        memcpy(force, step->coulomb.force[i], sizeof step->coulomb.force[i]);
    else if (circles)
        memcpy(force, circles->now.force, sizeof circles->now.force);
    else
        friction_force(&step->now[i], force);
}
