/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/circles.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "base/vector_clones.h"

/* As many as cells (contact/friction.c): sixteen depths. */
enum { DEEPER = 4 };

/* A depth that differs by more than this factor divides the indentations anew. */
static const double SAME_DEPTH = 4.0;

static size_t terms_of(const struct circles *circles)
{
    return circles->modes ? circles->modes->count : 0;
}

bool circles_second(struct circles *second, const struct circles *circles, struct arena *arena)
{
    size_t values = (1 + terms_of(circles)) * circles->count;
    *second = *circles;
    double *history = arena_take(arena, CIRCLE_AXES * values + 2 * circles->count, sizeof *history);
    if (!history)
        return false;
    for (size_t j = 0; j < 2; j++)
        second->drawn[j] = history + CIRCLE_AXES * values + j * circles->count;
    for (int axis = 0; axis < CIRCLE_AXES; axis++) {
        second->moved[axis] = history + (size_t)axis * values;
        second->memory[axis] = second->moved[axis] + circles->count;
    }
    return true;
}

bool circles_create(struct circles *circles, const struct contact_law *law, double coefficient,
                    const double ratio[3], size_t parts, struct arena *arena)
{
    size_t count = DEEPER * parts;
    double square = ratio[0] * ratio[2] - ratio[1] * ratio[1];
    *circles = (struct circles){
        .law = law,
        .coefficient = coefficient,
        .ratio = {ratio[0], ratio[1], ratio[2]},
        .over_ratio = {ratio[2] / square, -ratio[1] / square, ratio[0] / square},
        .parts = parts,
        .count = count,
    };
    if (law->operations->remembers) {
        struct recovery_modes *modes = arena_take(arena, 1, sizeof *modes);
        if (!modes)
            return false;
        circles->relaxation = law->table;
        *modes = recovery_modes_make(law->table);
        circles->modes = modes;
    }
    circles->depth = arena_take(arena, 3 * count, sizeof *circles->depth);
    if (!circles->depth)
        return false;
    circles->stiffness = circles->depth + count;
    circles->pressed = circles->depth + 2 * count;
    const struct circles first = *circles;
    return circles_second(circles, &first, arena);
}

void circles_copy(struct circles *to, const struct circles *from)
{
    size_t most = to->reached > from->reached ? to->reached : from->reached;
    size_t size = most * sizeof(double);
    struct circles copy = *from;
    for (int j = 0; j < 2; j++) {
        copy.drawn[j] = to->drawn[j];
        memcpy(to->drawn[j], from->drawn[j], size);
    }
    for (int axis = 0; axis < CIRCLE_AXES; axis++) {
        copy.moved[axis] = to->moved[axis];
        copy.memory[axis] = to->memory[axis];
        memcpy(to->moved[axis], from->moved[axis], size);
        for (size_t k = 0; k < terms_of(from) * from->count; k += from->count)
            memcpy(to->memory[axis] + k, from->memory[axis] + k, size);
    }
    *to = copy;
}

/* ---- From touch to touch ---- */

static void divide(struct circles *circles, double depth)
{
    double below, edge;
    circles->deep = depth;
    contact_law_force(circles->law, 0.0, &below);
    for (size_t c = 0; c < circles->count; c++) {
        double middle = ((double)c + 0.5) / (double)circles->parts;
        double end = ((double)c + 1.0) / (double)circles->parts;
        contact_law_force(circles->law, depth * end * end, &edge);
        circles->depth[c] = depth * middle * middle;
        circles->stiffness[c] = edge - below;
        below = edge;
    }
    for (int axis = 0; axis < CIRCLE_AXES; axis++)
        memset(circles->moved[axis], 0, (1 + terms_of(circles)) * circles->count * sizeof(double));
    for (int j = 0; j < 2; j++)
        memset(circles->drawn[j], 0, circles->count * sizeof(double));
    circles->reached = 0;
}

/* Each circle and axis by itself, free for a time. */
static void recover(struct circles *circles, double time)
{
    const struct recovery_modes *modes = circles->modes;
    double kept[RELAXATION_MOST], terms[RELAXATION_MOST], amplitudes[RELAXATION_MOST];
    for (size_t l = 0; l < modes->count; l++)
        kept[l] = exp(-time / modes->time[l]);
    for (int axis = 0; axis < CIRCLE_AXES; axis++)
        for (size_t c = 0; c < circles->reached; c++) {
            double *memory = circles->memory[axis] + c, left = 0.0;
            for (size_t k = 0; k < modes->count; k++)
                terms[k] = memory[k * circles->count];
            recovery_modes_split(modes, terms, amplitudes);
            for (size_t l = 0; l < modes->count; l++)
                amplitudes[l] *= kept[l];
            recovery_modes_join(modes, amplitudes, terms);
            for (size_t k = 0; k < modes->count; k++) {
                memory[k * circles->count] = terms[k];
                left += circles->relaxation->share[k] * terms[k];
            }
            circles->moved[axis][c] = left;
        }
}

void circles_touch(struct circles *circles, double depth, double time, double indentation,
                   const double displacement[2])
{
    double deeper = depth / circles->deep;
    bool same = circles->deep > 0.0 && deeper < SAME_DEPTH && deeper * SAME_DEPTH > 1.0;
    if (!same || !circles->modes)
        divide(circles, same ? circles->deep : depth);
    else
        recover(circles, time);
    memcpy(circles->displacement, displacement, sizeof circles->displacement);
    memset(circles->force, 0, sizeof circles->force);
    circles->indentation = indentation;
    circles->stuck = circles->stored = 0.0;
}

/* ---- A walk ---- */

/* What the terms keep on a way, and take from displacements, which are linear on it: those at its
 * start and at its end. A spring at the end has `now` of its displacement. */
struct passage {
    size_t terms;
    double kept[RELAXATION_MOST], start[RELAXATION_MOST], end[RELAXATION_MOST];
    double share[RELAXATION_MOST];
    double now;
};

static struct passage pass(const struct circles *circles, double time)
{
    struct passage passage = {.terms = terms_of(circles), .now = 1.0};
    for (size_t k = 0; k < passage.terms; k++) {
        double z = time / circles->relaxation->time[k];
        double share = passage.share[k] = circles->relaxation->share[k];
        passage.kept[k] = exp(-z);
        passage.end[k] = z > 0.0 ? 1.0 + expm1(-z) / z : 0.0;
        passage.start[k] = -expm1(-z) - passage.end[k];
        passage.now -= share * passage.end[k];
    }
    return passage;
}

enum { STRIP = 64 };

/* Part of a loop over circles, which is vectorised as a whole. */
#define EACH_CIRCLE __attribute__((always_inline)) static inline

/* What the terms of an axis take from springs at the end, by what was. */
EACH_CIRCLE void recall(const struct passage *passage, size_t n, size_t stride,
                        const double *restrict moved, const double *restrict memory,
                        double *restrict past)
{
    for (size_t c = 0; c < n; c++)
        past[c] = 0.0;
    for (size_t k = 0; k < passage->terms; k++, memory += stride)
        for (size_t c = 0; c < n; c++)
            past[c] +=
                passage->share[k] * (passage->kept[k] * memory[c] + passage->start[k] * moved[c]);
}

/* The terms and the displacements at the end. */
EACH_CIRCLE void remember(const struct passage *passage, size_t n, size_t stride,
                          const double *restrict to, double *restrict moved,
                          double *restrict memory)
{
    for (size_t k = 0; k < passage->terms; k++, memory += stride)
        for (size_t c = 0; c < n; c++)
            memory[c] = passage->kept[k] * memory[c] +
                        (passage->start[k] * moved[c] + passage->end[k] * to[c]);
    memcpy(moved, to, n * sizeof *moved);
}

/* The normal springs; returns their force. */
VECTOR_CLONES static double press(struct circles *circles, const struct passage *passage,
                                  double indentation, size_t first, size_t n)
{
    double past[STRIP], to[STRIP], sum = 0.0;
    const double *depth = circles->depth + first, *stiffness = circles->stiffness + first;
    double *pressed = circles->pressed + first;
    recall(passage, n, circles->count, circles->moved[0] + first, circles->memory[0] + first, past);
    for (size_t c = 0; c < n; c++) {
        double pushed = indentation - depth[c], force = pushed * passage->now - past[c];
        pressed[c] = force > 0.0 ? force : 0.0;
        to[c] = force > 0.0 ? pushed : past[c] / passage->now;
    }
    remember(passage, n, circles->count, to, circles->moved[0] + first, circles->memory[0] + first);
    for (size_t c = 0; c < n; c++)
        sum += stiffness[c] * pressed[c];
    return sum;
}

/* Along a straight slip of `a` limits (elastically) a small angle between force and slip fades to
 * exp(-a) of itself. The mean slip has the weight (1 - exp(-a) (1 + a))/(a - 1 + exp(-a)) of the
 * direction at the start to that at the end; this is it to first order, and fades, too: equal
 * weights would turn the force to and fro. */
static double start_weight(double a)
{
    return 1.0 / (1.0 + a / 3.0);
}

/* Forces t over a circle's stiffness that come back to the limit from elastic ones by a slip with
 * the direction of w n0 + n, n0 at the start and n at the end:
 *
 *   elastic = limit n + q (w n0 + n),   |n| = 1
 *
 * q >= 0 follows from a quadratic; the slip times kappa is q |w n0 + n|. */
static void come_back(const double elastic[2], const double start[2], double weight, double limit,
                      double end[2], double slip[2])
{
    double above = elastic[0] * elastic[0] + elastic[1] * elastic[1] - limit * limit;
    double with = limit + weight * (elastic[0] * start[0] + elastic[1] * start[1]);
    double under = with * with + (1.0 - weight * weight) * above;
    double q = above / (with + sqrt(under));
    for (int j = 0; j < 2; j++)
        end[j] = (elastic[j] - q * weight * start[j]) / (limit + q);
    for (int j = 0; j < 2; j++)
        slip[j] = q * (weight * start[j] + end[j]);
}

/* Rounds that each leave their part of kappa's anisotropy; one where it has none. */
enum { DIRECTION_ROUNDS = 6 };

/* Brings elastic forces t above the limit back to it, from the direction of `before`, if any. */
static void bring_back(const double kappa[3], double limit, const double before[2], double t[2])
{
    double mean = 0.5 * (kappa[0] + kappa[2]), apart = 0.5 * (kappa[0] - kappa[2]) / mean;
    double size = hypot(before[0], before[1]), end[2], slip[2] = {0.0, 0.0};
    const double elastic[2] = {t[0], t[1]}, between = kappa[1] / mean;
    double start[2] = {0.0, 0.0}, weight = 0.0;
    if (before[0] * t[0] + before[1] * t[1] > 0.0) {
        start[0] = before[0] / size;
        start[1] = before[1] / size;
        weight = start_weight(hypot(t[0], t[1]) / limit - 1.0);
    }
    int rounds = apart == 0.0 && between == 0.0 ? 1 : DIRECTION_ROUNDS;
    for (int round = 0; round < rounds; round++) {
        const double from[2] = {elastic[0] - (apart * slip[0] + between * slip[1]),
                                elastic[1] - (between * slip[0] - apart * slip[1])};
        come_back(from, start, weight, limit, end, slip);
    }
    double over = limit / hypot(end[0], end[1]);
    t[0] = over * end[0];
    t[1] = over * end[1];
}

/* The sums of a walk. */
struct sums {
    double force[2], stuck, turning[3], stored;
};

/* The tangents of a circle that is pressed: `past` of its springs, `to` the displacements at the
 * end. `limit` > 0: over the circle's stiffness. */
static void drag(struct circles *circles, double now, size_t c, double limit, const double past[2],
                 double to[2], struct sums *sums)
{
    const double *kappa = circles->ratio, *over = circles->over_ratio;
    double stiffness = circles->stiffness[c];
    const double e[2] = {to[0] * now - past[0], to[1] * now - past[1]};
    double t[2] = {kappa[0] * e[0] + kappa[1] * e[1], kappa[1] * e[0] + kappa[2] * e[1]};
    double square = t[0] * t[0] + t[1] * t[1];
    if (square > limit * limit) {
        double turns = stiffness * now * limit / sqrt(square);
        const double before[2] = {circles->drawn[0][c], circles->drawn[1][c]};
        bring_back(kappa, limit, before, t);
        double x = t[0] / limit, y = t[1] / limit;
        sums->turning[0] += turns * (1.0 - x * x);
        sums->turning[1] += turns * (1.0 - y * y);
        sums->turning[2] -= turns * x * y;
        to[0] = (over[0] * t[0] + over[1] * t[1] + past[0]) / now;
        to[1] = (over[1] * t[0] + over[2] * t[1] + past[1]) / now;
    } else
        sums->stuck += stiffness * now;
    circles->drawn[0][c] = t[0];
    circles->drawn[1][c] = t[1];
    sums->force[0] += stiffness * t[0];
    sums->force[1] += stiffness * t[1];
    sums->stored += stiffness * (to[0] * (kappa[0] * to[0] + kappa[1] * to[1]) +
                                 to[1] * (kappa[1] * to[0] + kappa[2] * to[1]));
}

/* The part of a way with a contact of the circle. */
static double closed_part(double from, double to, double depth)
{
    return from < depth && to > depth ? (to - depth) / (to - from) : 1.0;
}

/* The tangential springs, whose limits are `share` of the normal ones times the coefficient. */
static void slide(struct circles *circles, const struct passage *passage,
                  const struct circles_target *target, double share, size_t first, size_t n,
                  struct sums *sums)
{
    double past[2][STRIP], to[2][STRIP];
    double *moved[2] = {circles->moved[1] + first, circles->moved[2] + first};
    double *memory[2] = {circles->memory[1] + first, circles->memory[2] + first};
    const double way[2] = {target->displacement[0] - circles->displacement[0],
                           target->displacement[1] - circles->displacement[1]};
    double coefficient = circles->coefficient * share;
    for (int j = 0; j < 2; j++)
        recall(passage, n, circles->count, moved[j], memory[j], past[j]);
    for (size_t i = 0; i < n; i++) {
        size_t c = first + i;
        double part = closed_part(circles->indentation, target->indentation, circles->depth[c]);
        double limit = coefficient * circles->pressed[c];
        const double before[2] = {past[0][i], past[1][i]};
        double end[2] = {moved[0][i] + part * way[0], moved[1][i] + part * way[1]};
        if (limit > 0.0)
            drag(circles, passage->now, c, limit, before, end, sums);
        else /* free: it gives nothing back */
            for (int j = 0; j < 2; j++) {
                end[j] = before[j] / passage->now;
                circles->drawn[j][c] = 0.0;
            }
        to[0][i] = end[0];
        to[1][i] = end[1];
    }
    for (int j = 0; j < 2; j++)
        remember(passage, n, circles->count, to[j], moved[j], memory[j]);
}

/* Circles up to an indentation. */
static size_t touched(const struct circles *circles, double indentation)
{
    if (!(indentation > 0.0))
        return 0;
    double place = (double)circles->parts * sqrt(indentation / circles->deep) + 0.5;
    return place < (double)circles->count ? (size_t)place : circles->count;
}

static void take_sums(struct circles *circles, const struct sums *sums)
{
    const double *kappa = circles->ratio, *turning = sums->turning;
    double stays = circles->modes ? relaxation_storage(circles->relaxation, 0.0) : 1.0;
    memcpy(circles->force, sums->force, sizeof circles->force);
    circles->stuck = sums->stuck;
    circles->stored = 0.5 * stays * sums->stored;
    circles->resists[0] = kappa[0] * (sums->stuck + turning[0]);
    circles->resists[1] = kappa[2] * (sums->stuck + turning[1]);
    circles->resists[2] = kappa[1] * sums->stuck + 0.5 * (kappa[0] + kappa[2]) * turning[2];
}

void circles_walk(struct circles *circles, const struct circles_target *to)
{
    const struct passage passage = pass(circles, to->time);
    size_t end = touched(circles, to->indentation);
    if (end > circles->reached)
        circles->reached = end;
    else
        end = circles->reached;
    double normal = 0.0;
    for (size_t first = 0; first < end; first += STRIP) {
        size_t n = end - first < STRIP ? end - first : STRIP;
        normal += press(circles, &passage, to->indentation, first, n);
    }
    double share = normal > 0.0 && to->normal > 0.0 ? to->normal / normal : 0.0;
    struct sums sums = {.stuck = 0.0};
    for (size_t first = 0; first < end; first += STRIP) {
        size_t n = end - first < STRIP ? end - first : STRIP;
        slide(circles, &passage, to, share, first, n, &sums);
    }
    take_sums(circles, &sums);
    circles->indentation = to->indentation;
    memcpy(circles->displacement, to->displacement, sizeof circles->displacement);
}
