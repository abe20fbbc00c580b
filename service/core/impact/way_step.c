/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/way_step.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "impact/coupling.h"
#include "numeric/lagrange.h"
#include "numeric/linear.h"

/* As node_solver.c. */
enum { MAX_ITERATIONS = 40 };
static const double ROUNDING = 1e-15;

static struct way_slopes slopes_make(void)
{
    struct way_slopes slopes;
    double place[WAY_PLACES] = {0.0};
    memcpy(place + 1, collocation.node, sizeof collocation.node);
    place[WAY_PLACES - 1] = 1.0;
    for (int i = 0; i < STEP_POINTS; i++)
        lagrange_slopes(place, WAY_PLACES, place[i + 1], slopes.by[i]);
    return slopes;
}

bool way_step_create(struct way_step **step, const struct scene *scene, struct arena *arena)
{
    size_t n = scene->contacts, unknowns = n * STEP_POINTS;
    *step = NULL;
    if (!scene_is_lossy(scene))
        return true;
    struct way_step *made = arena_take(arena, 1, sizeof *made);
    if (!made)
        return false;
    made->scene = scene;
    made->slopes = slopes_make();
    made->contact = arena_take(arena, n, sizeof *made->contact);
    made->target = arena_take(arena, 4 * n, sizeof *made->target);
    made->matrix = arena_reserve(arena, unknowns * unknowns, sizeof(double));
    made->press = arena_take(arena, n, sizeof *made->press);
    made->present = arena_take(arena, n, sizeof *made->present);
    if (!made->contact || !made->target || !made->matrix || !made->press || !made->present)
        return false;
    made->approach = made->target + n;
    made->excess = made->approach + n;
    made->change = made->excess + n;
    *step = made;
    for (size_t c = 0; c < n; c++)
        if (!way_contact_create(&made->contact[c], &scene->laws[c],
                                scene->residual[c * (scene->rows + 1)], arena))
            return false;
    return true;
}

static double residual_of(const struct way_step *step, size_t a, size_t b)
{
    return step->scene->residual[a * step->scene->rows + b];
}

bool way_step_prepare(struct way_step *step, int level, struct arena *arena)
{
    size_t n = step->scene->contacts;
    if (step->coupling[level])
        return true;
    struct way_block *blocks = arena_take(arena, n * n, sizeof *blocks);
    if (!blocks)
        return false;
    for (size_t p = 0; p < n * n; p++) {
        double by[STEP_POINTS][NODES];
        coupling_between(step->scene, level, p / n, p % n, by);
        for (int i = 0; i < STEP_POINTS; i++)
            memcpy(blocks[p].by[i], by[i], sizeof by[i]);
        blocks[p].by[NODES][NODES] = residual_of(step, p / n, p % n);
    }
    for (size_t c = 0; c < n; c++)
        if (!way_contact_prepare(&step->contact[c], level, arena))
            return false;
    step->coupling[level] = blocks;
    return true;
}

static const struct way_block *block_of(const struct way_step *step, size_t a, size_t b)
{
    return &step->coupling[step->level][a * step->scene->contacts + b];
}

/* ---- Motion under the forces ---- */

static bool bears(const struct way_contact *contact)
{
    bool any = false;
    for (int i = 0; i < STEP_POINTS; i++)
        any = any || contact->force[i] != 0.0;
    return any;
}

/* Indentations of a contact by the forces of all; `approach` becomes the bodies'. */
static void place_contact(struct way_step *step, size_t a, double approach[STEP_POINTS])
{
    double *d = step->contact[a].indentation;
    memcpy(d, step->target[a], sizeof step->target[a]);
    memcpy(approach, step->approach[a], sizeof step->approach[a]);
    for (size_t b = 0; b < step->scene->contacts; b++) {
        const struct way_block *block = block_of(step, a, b);
        const double *force = step->contact[b].force;
        if (!bears(&step->contact[b]))
            continue;
        for (int i = 0; i < STEP_POINTS; i++) {
            double taken = 0.0;
            for (int j = 0; j < STEP_POINTS; j++)
                taken += block->by[i][j] * force[j];
            d[i] -= taken;
            approach[i] -= taken - residual_of(step, a, b) * force[i];
        }
    }
}

/* The rates of an approach. */
static void find_rates(const struct way_step *step, size_t a, const double approach[STEP_POINTS],
                       double rate[STEP_POINTS])
{
    double h = step_length(step->level);
    for (int i = 0; i < STEP_POINTS; i++) {
        const double *by = step->slopes.by[i];
        rate[i] = by[0] * step->contact[a].approach;
        for (int j = 0; j < STEP_POINTS; j++)
            rate[i] += by[j + 1] * approach[j];
        rate[i] /= h;
    }
}

/* ---- Newton's system ---- */

/* What the forces have more than the laws. */
static void find_excess(struct way_step *step)
{
    for (size_t a = 0; a < step->scene->contacts; a++) {
        struct way_contact *contact = &step->contact[a];
        double approach[STEP_POINTS], rate[STEP_POINTS] = {0.0}, force[STEP_POINTS];
        place_contact(step, a, approach);
        if (contact->law->operations->moving)
            find_rates(step, a, approach, rate);
        way_contact_forces(contact, rate, force);
        for (int i = 0; i < STEP_POINTS; i++)
            step->excess[a][i] = contact->force[i] - force[i];
    }
}

/* Slopes of a contact's law by the approaches at all points: those by the indentations, and by the
 * rates, which the approaches make up. `rates` becomes the second part. */
static void find_slopes(const struct way_step *step, const struct way_contact *contact,
                        struct way_block *all, struct way_block *rates)
{
    double h = step_length(step->level);
    for (int i = 0; i < STEP_POINTS; i++)
        for (int j = 0; j < STEP_POINTS; j++) {
            rates->by[i][j] = contact->viscosity[i] * step->slopes.by[i][j + 1] / h;
            all->by[i][j] = contact->slope[i][j] + rates->by[i][j];
        }
}

/* The excess of contact a by the forces of b, in rows of the matrix from `row` on. */
static void fill_pair(const struct way_step *step, size_t a, size_t b, const struct way_block *all,
                      const struct way_block *rates, double *row)
{
    const struct way_block *coupling = block_of(step, a, b);
    double residual = residual_of(step, a, b);
    for (int i = 0; i < STEP_POINTS; i++, row += step->pressed * STEP_POINTS)
        for (int j = 0; j < STEP_POINTS; j++) {
            double sum = a == b && i == j ? 1.0 : 0.0;
            for (int l = 0; l < STEP_POINTS; l++)
                sum += all->by[i][l] * coupling->by[l][j];
            row[j] = sum - rates->by[i][j] * residual;
        }
}

/* Whether a contact has a force or gets one: others stay as they are. */
static bool presses(const struct way_contact *contact)
{
    bool any = bears(contact);
    for (int i = 0; i < STEP_POINTS; i++)
        for (int j = 0; j < STEP_POINTS; j++)
            any = any || contact->slope[i][j] != 0.0;
    return any;
}

/* The system of the contacts that press. */
static void fill_matrix(struct way_step *step)
{
    size_t n = step->scene->contacts;
    step->pressed = 0;
    for (size_t c = 0; c < n; c++)
        if (presses(&step->contact[c]))
            step->press[step->pressed++] = c;
    for (size_t p = 0; p < step->pressed; p++) {
        struct way_block all, rates;
        double *rows = step->matrix + p * STEP_POINTS * step->pressed * STEP_POINTS;
        find_slopes(step, &step->contact[step->press[p]], &all, &rates);
        for (size_t q = 0; q < step->pressed; q++)
            fill_pair(step, step->press[p], step->press[q], &all, &rates, rows + q * STEP_POINTS);
        memcpy(step->change[p], step->excess[step->press[p]], sizeof step->change[p]);
    }
}

/* ---- A step ---- */

static double largest_of(const double values[STEP_POINTS])
{
    double largest = 0.0;
    for (int i = 0; i < STEP_POINTS; i++)
        largest = larger(largest, fabs(values[i]));
    return largest;
}

/* The largest change of a force, the largest force, and that of rounded approaches. */
struct way_progress {
    double change, force, rounding;
};

static struct way_progress improve(struct way_step *step)
{
    struct way_progress progress = {0.0, 0.0, 0.0};
    for (size_t p = 0; p < step->pressed; p++) {
        struct way_contact *contact = &step->contact[step->press[p]];
        double stiffest = 0.0;
        for (int i = 0; i < STEP_POINTS; i++) {
            contact->force[i] -= step->change[p][i];
            stiffest = larger(stiffest, fabs(contact->slope[i][i]));
        }
        double reach = stiffest * largest_of(step->target[step->press[p]]);
        progress.change = larger(progress.change, largest_of(step->change[p]));
        progress.force = larger(progress.force, largest_of(contact->force));
        progress.rounding = larger(progress.rounding, ROUNDING * reach);
    }
    return progress;
}

/* The indentations of forces that push. */
static void keep_pushing(struct way_step *step)
{
    double approach[STEP_POINTS];
    for (size_t a = 0; a < step->scene->contacts; a++)
        for (int i = 0; i < STEP_POINTS; i++)
            step->contact[a].force[i] = larger(step->contact[a].force[i], 0.0);
    for (size_t a = 0; a < step->scene->contacts; a++)
        place_contact(step, a, approach);
}

static bool solve_forces(struct way_step *step, double last, unsigned long *iterations)
{
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        find_excess(step);
        fill_matrix(step);
        ++*iterations;
        if (!linear_solve(step->pressed * STEP_POINTS, step->matrix, step->change[0]))
            return false;
        struct way_progress progress = improve(step);
        if (!isfinite(progress.change))
            return false;
        if (progress.change > last * progress.force && progress.change > progress.rounding)
            continue;
        keep_pushing(step);
        return true;
    }
    return false;
}

static void start_forces(struct way_step *step, double (*const indentation)[NODES])
{
    static const double at_rest[STEP_POINTS] = {0.0};
    for (size_t a = 0; a < step->scene->contacts; a++) {
        struct way_contact *contact = &step->contact[a];
        memcpy(contact->indentation, indentation[a], sizeof indentation[a]);
        contact->indentation[NODES] = collocation_last(indentation[a]);
        way_contact_start(contact, step->level);
        way_contact_forces(contact, at_rest, contact->force);
    }
}

/* The force behind a turn differs little from that of a contact that grows: each round shifts the
 * turn by far less than the one before. */
enum { TURN_ROUNDS = 3 };

/* Whether a contact's forces are not those with its turn, or without one that is gone. */
static bool turn(struct way_step *step)
{
    bool any = false;
    for (size_t a = 0; a < step->scene->contacts; a++)
        any = way_contact_turns(&step->contact[a]) || any;
    return any;
}

bool way_step_solve(struct way_step *step, int level, double (*const indentation)[NODES],
                    double last, unsigned long *iterations)
{
    step->level = level;
    start_forces(step, indentation);
    if (!solve_forces(step, last, iterations))
        return false;
    for (int round = 0; round < TURN_ROUNDS && turn(step); round++)
        if (!solve_forces(step, last, iterations))
            return false;
    return true;
}

/* ---- Accepted steps ---- */

void way_step_take(struct way_step *step, size_t contact, double time)
{
    struct way_contact *of = &step->contact[contact];
    double approach[STEP_POINTS];
    place_contact(step, contact, approach);
    way_contact_take(of, &step->slopes, step->level, time, approach[NODES]);
    step->present[contact] = of->force[NODES];
}

double way_step_lost(const struct way_step *step, const double *indentation)
{
    double sum = 0.0;
    for (size_t c = 0; c < step->scene->contacts; c++)
        if (step->contact[c].law->operations->lossy)
            sum += way_contact_lost(&step->contact[c], indentation[c], step->present[c]);
    return sum;
}
