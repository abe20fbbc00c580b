/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/coulomb.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "numeric/lagrange.h"
#include "numeric/linear.h"

/* Of Radau's right rule with four points: the zeros of P4 - P3 on 0..1. */
static const double POINT[NODES] = {0.088587959512703947396, 0.40946686444073471087,
                                    0.78765946176084705603, 1.0};

static void set_polynomials(struct coulomb_points *points)
{
    double way[WAY_POINTS] = {0.0}, quartic[NODES + 1] = {0.0}, slopes[NODES + 1];
    memcpy(quartic + 1, POINT, sizeof POINT);
    lagrange_values(POINT, NODES, 0.0, points->at_start);
    memcpy(way + 1, collocation.node, sizeof collocation.node);
    way[WAY_POINTS - 1] = 1.0;
    for (int i = 0; i < NODES; i++) {
        lagrange_slopes(way, WAY_POINTS, POINT[i], points->rate[i]);
        lagrange_slopes(way, WAY_POINTS, collocation.node[i], points->node_rate[i]);
        lagrange_values(POINT, NODES, collocation.node[i], points->to_node[i]);
        lagrange_values(collocation.node, NODES, POINT[i], points->from_node[i]);
        lagrange_slopes(quartic, NODES + 1, POINT[i], slopes);
        points->jump[i] = slopes[0] - points->rate[i][0];
    }
}

bool coulomb_create(struct coulomb *coulomb, const struct scene *scene, struct arena *arena)
{
    size_t n = scene->frictions;
    *coulomb = (struct coulomb){.count = n};
    coulomb->points = arena_take(arena, 1, sizeof *coulomb->points);
    coulomb->stuck = arena_take(arena, n, sizeof *coulomb->stuck);
    coulomb->force = arena_take(arena, 2 * n, sizeof *coulomb->force);
    coulomb->lost = arena_take(arena, 4 * n, sizeof *coulomb->lost);
    if (!coulomb->points || !coulomb->stuck || !coulomb->force || !coulomb->lost)
        return false;
    coulomb->after = coulomb->force + n;
    coulomb->losing = coulomb->lost + n;
    coulomb->reach = coulomb->lost + 2 * n;
    coulomb->rounding = coulomb->lost + 3 * n;
    set_polynomials(coulomb->points);
    return true;
}

/* Of row a by row b. */
static void set_response(const struct coulomb_points *points, const double by[STEP_POINTS][NODES],
                         double residual, double (*response)[NODES])
{
    for (int j = 0; j < NODES; j++) {
        double fall[STEP_POINTS] = {0.0};
        for (int k = 0; k < STEP_POINTS; k++)
            for (int m = 0; m < NODES; m++)
                fall[k] += by[k][m] * points->to_node[m][j];
        /* the last point is the end, where a block has no residual flexibility */
        fall[NODES] += j == NODES - 1 ? residual : 0.0;
        for (int i = 0; i < NODES; i++) {
            response[i][j] = -residual * points->jump[i] * points->at_start[j];
            for (int k = 0; k < STEP_POINTS; k++)
                response[i][j] += points->rate[i][k + 1] * fall[k];
        }
    }
}

bool coulomb_prepare(struct coulomb *coulomb, const struct scene *scene,
                     const struct coupling *coupling, int level, struct arena *arena)
{
    if (coulomb->level[level])
        return true;
    struct coulomb_response *responses = arena_reserve(arena, coulomb->count, sizeof *responses);
    if (!responses)
        return false;
    for (size_t i = 0; i < coulomb->count; i++)
        for (size_t a = 0; a < 2; a++)
            for (size_t b = 0; b < 2; b++) {
                size_t row = scene_tangent(scene, i) + a, other = scene_tangent(scene, i) + b;
                double residual = scene->residual[row * scene->rows + other];
                double between[STEP_POINTS][NODES];
                bool own = a == b;
                if (!own)
                    coupling_between(scene, level, row, other, between);
                set_response(coulomb->points,
                             own ? coupling_own(coupling, level, row)->by
                                 : (const double(*)[NODES])between,
                             residual, responses[i].by[a][b]);
            }
    coulomb->level[level] = responses;
    return true;
}

/* ---- The law at the points ---- */

enum { UNKNOWNS = 2 * NODES };

/* Forces at the points, by tangents, under which the rates are `free` less the response. */
struct slide {
    const struct coulomb_response *response;
    double free[2][NODES], limit[NODES]; /* m, N */
    int like[NODES];         /* the point itself, or where its limit is not positive the nearest
                                that has one */
    double stiffness[NODES]; /* of a rate's excess, N/m: the points' own */
    double share;            /* of the limits that is in force */
    double rounding;         /* of a rate times its stiffness, N */
    double force[2][NODES];
    bool sticks[NODES];
};

static double rate_at(const struct slide *slide, int tangent, int point)
{
    double rate = slide->free[tangent][point];
    for (int b = 0; b < 2; b++)
        for (int j = 0; j < NODES; j++)
            rate -= slide->response->by[tangent][b][point][j] * slide->force[b][j];
    return rate;
}

/* Beside a contact's end the normal force's cubic goes below zero. The tangential one is there the
 * same share of it as at the nearest point where it presses. */
static void write_beside(struct slide *slide, int i, double (*matrix)[UNKNOWNS], double *excess)
{
    int like = slide->like[i];
    double share = slide->limit[i] / slide->limit[like];
    slide->sticks[i] = slide->sticks[like];
    for (int a = 0; a < 2; a++) {
        double *row = matrix[2 * i + a];
        memset(row, 0, sizeof *matrix);
        row[2 * i + a] = 1.0;
        row[2 * like + a] = -share;
        excess[2 * i + a] = slide->force[a][i] - share * slide->force[a][like];
    }
}

/* Whether no force moves a point along a tangent: bodies in joints. What slides along it goes on.
 */
static bool is_held(const struct slide *slide, int tangent, int point)
{
    return slide->response->by[tangent][tangent][point][point] == 0.0;
}

/* Newton's equations of a point: T is the nearest force in Coulomb's circle to T + stiffness v. */
static void write_point(struct slide *slide, int i, double (*matrix)[UNKNOWNS], double *excess)
{
    double limit = slide->share * slide->limit[i], pull[2], rate[2];
    for (int a = 0; a < 2; a++) {
        rate[a] = slide->stiffness[i] * rate_at(slide, a, i);
        pull[a] = slide->force[a][i] + rate[a];
    }
    double size = hypot(pull[0], pull[1]);
    const bool held[2] = {is_held(slide, 0, i), is_held(slide, 1, i)};
    slide->sticks[i] = size <= limit && !(held[0] && fabs(rate[0]) > slide->rounding) &&
                       !(held[1] && fabs(rate[1]) > slide->rounding);
    for (int a = 0; a < 2; a++) {
        double *row = matrix[2 * i + a];
        memset(row, 0, sizeof *matrix);
        if (slide->sticks[i])
            excess[2 * i + a] = -rate[a];
        else
            excess[2 * i + a] = slide->force[a][i] - limit * pull[a] / size;
        row[2 * i + a] = slide->sticks[i] ? 0.0 : 1.0;
        for (int c = 0; c < 2; c++) {
            /* change of the projection by that of the pull */
            double turn = slide->sticks[i]
                              ? a == c
                              : limit / size * ((a == c) - pull[a] / size * (pull[c] / size));
            row[2 * i + c] -= slide->sticks[i] ? 0.0 : turn;
            for (int b = 0; b < 2; b++)
                for (int j = 0; j < NODES; j++)
                    row[2 * j + b] += turn * slide->stiffness[i] * slide->response->by[c][b][i][j];
        }
        /* none is needed to stick along it */
        if (slide->sticks[i] && held[a]) {
            row[2 * i + a] = 1.0;
            excess[2 * i + a] = slide->force[a][i];
        }
    }
}

/* What the forces miss of the law, over the limits: some roundings of a sum of eight. Or over the
 * rates' own rounding. */
static const double LAST_EXCESS = 1e-13;
enum { MOST_ROUNDS = 12 };

/* Newton's method, which may go in a circle from a bad start. Where all points stick or slide along
 * a line the equations are linear: one round; none from forces that fulfil them already. */
static bool find_forces(struct slide *slide)
{
    double last = slide->rounding;
    for (int i = 0; i < NODES; i++)
        last = larger(last, LAST_EXCESS * slide->limit[i]);
    for (int round = 0; round < MOST_ROUNDS; round++) {
        double matrix[UNKNOWNS][UNKNOWNS], change[UNKNOWNS], largest = 0.0;
        for (int i = 0; i < NODES; i++)
            if (slide->like[i] == i)
                write_point(slide, i, matrix, change);
        for (int i = 0; i < NODES; i++)
            if (slide->like[i] != i)
                write_beside(slide, i, matrix, change);
        for (int k = 0; k < UNKNOWNS; k++)
            largest = larger(largest, fabs(change[k]));
        if (largest <= last)
            return true;
        if (!linear_solve(UNKNOWNS, matrix[0], change))
            return false;
        for (int k = 0; k < UNKNOWNS; k++)
            slide->force[k % 2][k / 2] -= change[k];
    }
    return false;
}

/* The smallest share of the limits by which the way to them goes on. */
static const double LEAST_PART = 1e-4;

/* From no force on with growing limits, along which the forces are continuous: the response times
 * positive weights of the points is positive definite, as that of Radau's rule and its inverse are.
 */
static bool raise_limits(struct slide *slide)
{
    double done = 0.0, part = 0.5;
    memset(slide->force, 0, sizeof slide->force);
    while (done < 1.0) {
        struct slide next = *slide;
        next.share = smaller(done + part, 1.0);
        for (int k = 0; done > 0.0 && k < UNKNOWNS; k++)
            next.force[k % 2][k / 2] *= next.share / done;
        if (find_forces(&next)) {
            *slide = next;
            done = next.share;
            part *= 2.0;
        } else if ((part *= 0.5) < LEAST_PART)
            return false;
    }
    return true;
}

static void find_likes(struct slide *slide)
{
    for (int i = 0; i < NODES; i++) {
        slide->like[i] = i;
        for (int away = 1; !(slide->limit[slide->like[i]] > 0.0) && away < NODES; away++) {
            if (i >= away && slide->limit[i - away] > 0.0)
                slide->like[i] = i - away;
            else if (i + away < NODES && slide->limit[i + away] > 0.0)
                slide->like[i] = i + away;
        }
    }
}

/* A point that slides has its limit to rounding. */
static void shorten(struct slide *slide)
{
    for (int i = 0; i < NODES; i++) {
        double size = hypot(slide->force[0][i], slide->force[1][i]);
        if (!slide->sticks[i] && slide->limit[i] > 0.0 && size > 0.0)
            for (int a = 0; a < 2; a++)
                slide->force[a][i] *= slide->limit[i] / size;
    }
}

/* A rate within the rounding is none. */
static bool sticks_at(const struct slide *slide, int point, double rounding)
{
    int like = slide->like[point];
    double rate = hypot(rate_at(slide, 0, like), rate_at(slide, 1, like));
    return slide->sticks[like] || rate * slide->stiffness[like] <= rounding;
}

static double at_way(const struct friction_way *way, int tangent, const double by[WAY_POINTS])
{
    const double *nodes = way->nodes[1 + tangent];
    double sum = by[0] * way->start[1 + tangent] + by[WAY_POINTS - 1] * way->end[1 + tangent];
    for (int j = 0; j < NODES; j++)
        sum += by[j + 1] * nodes[j];
    return sum;
}

static double product(const double by[NODES], const double values[NODES])
{
    return (by[0] * values[0] + by[1] * values[1]) + (by[2] * values[2] + by[3] * values[3]);
}

/* Of the largest limit. */
static const double PULL = 4.0;

/* Of a rate by six displacements, whose weights' sizes sum up to some 50. */
static const double ROUNDING = 2e-14;

void coulomb_begin(struct coulomb *coulomb)
{
    memset(coulomb->force, 0, coulomb->count * sizeof *coulomb->force);
}

/* The rates' part by the start's forces, times the points' jumps. */
static double jump_of(const struct coulomb *coulomb, const struct scene *scene, size_t i,
                      size_t tangent, double (*const force)[NODES])
{
    size_t row = scene_tangent(scene, i);
    const double *residual = scene->residual + (row + tangent) * scene->rows + row;
    double sum = 0.0;
    for (int b = 0; b < 2; b++)
        sum += residual[b] * (coulomb->force[i][b] - product(coulomb->points->at_start, force[b]));
    return sum;
}

bool coulomb_solve(struct coulomb *coulomb, const struct scene *scene, size_t i, int level,
                   const struct friction_way *way, const double normal[NODES],
                   double (*force)[NODES])
{
    const struct coulomb_points *points = coulomb->points;
    struct slide slide = {.response = &coulomb->level[level][i], .share = 1.0};
    double stiffest = 0.0, most = 0.0;
    for (int p = 0; p < NODES; p++) {
        slide.limit[p] = scene->friction[i].coefficient * product(points->from_node[p], normal);
        most = larger(most, slide.limit[p]);
        for (int a = 0; a < 2; a++)
            slide.force[a][p] = product(points->from_node[p], force[a]);
    }
    if (!(most > 0.0)) {
        memset(coulomb->stuck[i], 0, sizeof coulomb->stuck[i]);
        memset(force, 0, 2 * sizeof *force);
        coulomb->rounding[i] = 0.0;
        return true;
    }
    const double jump[2] = {jump_of(coulomb, scene, i, 0, slide.force),
                            jump_of(coulomb, scene, i, 1, slide.force)};
    for (int p = 0; p < NODES; p++) {
        const struct coulomb_response *own = slide.response;
        double moves = fabs(own->by[0][0][p][p] + own->by[1][1][p][p]);
        for (int a = 0; a < 2; a++)
            slide.free[a][p] =
                at_way(way, a, points->rate[p]) - jump[a] * points->jump[p] - rate_at(&slide, a, p);
        /* what no force moves slides: its rate pulls by more than the limits */
        double rate = hypot(slide.free[0][p], slide.free[1][p]);
        slide.stiffness[p] = moves > 0.0 ? 2.0 / moves : rate > 0.0 ? PULL * most / rate : 0.0;
        stiffest = larger(stiffest, slide.stiffness[p]);
    }
    coulomb->rounding[i] = slide.rounding = ROUNDING * coulomb->reach[i] * stiffest;
    find_likes(&slide);
    if (!find_forces(&slide) && !raise_limits(&slide))
        return false;
    shorten(&slide);
    for (int node = 0; node < NODES; node++) {
        coulomb->stuck[i][node] = sticks_at(&slide, node, coulomb->rounding[i]);
        for (int a = 0; a < 2; a++)
            force[a][node] = product(points->to_node[node], slide.force[a]);
    }
    return true;
}

void coulomb_end(struct coulomb *coulomb, size_t i, const struct friction_way *way,
                 double (*const force)[NODES])
{
    coulomb->losing[i] = 0.0;
    for (int a = 0; a < 2; a++) {
        coulomb->after[i][a] = collocation_last(force[a]);
        for (int j = 0; j < NODES; j++)
            coulomb->losing[i] +=
                collocation.weight[j] * force[a][j] * at_way(way, a, coulomb->points->node_rate[j]);
    }
}

void coulomb_take(struct coulomb *coulomb)
{
    for (size_t i = 0; i < coulomb->count; i++) {
        coulomb->lost[i] += coulomb->losing[i];
        memcpy(coulomb->force[i], coulomb->after[i], sizeof coulomb->force[i]);
    }
}
