/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/way_step.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "numeric/lagrange.h"
#include "numeric/linear.h"

/* As node_solver.c. */
enum { MAX_ITERATIONS = 40 };
static const double ROUNDING = 1e-15;

bool way_step_create(struct way_step **step, const struct scene *scene, struct arena *arena)
{
    const struct contact_law *law = &scene->laws[0];
    *step = NULL;
    for (size_t c = 0; c < scene->contacts; c++)
        if (scene->laws[c].operations->lossy && scene->contacts > 1)
            return false;
    if (!law->operations->lossy)
        return true;
    struct way_step *made = *step = arena_take(arena, 1, sizeof *made);
    if (!made)
        return false;
    made->law = law;
    made->compliance = scene->residual[0];
    if (!law->operations->remembers)
        return true;
    made->memory = arena_take(arena, 1, sizeof *made->memory);
    if (made->memory)
        memory_step_create(made->memory, law);
    return made->memory != NULL;
}

bool way_step_prepare(struct way_step *step, int level, struct arena *arena)
{
    return !step->memory || memory_step_prepare(step->memory, level, arena);
}

void way_step_begin(struct way_step *step, double time)
{
    step->parted = step->memory && memory_step_begin(step->memory, time);
    step->touched_at = step->parted_at = time;
    step->largest = step->now = step->approach = 0.0;
}

/* ---- Rates ---- */

enum { PLACES = STEP_POINTS + 1 }; /* start, nodes, end of a step */

/* The place of a point of the step, or of its start, -1. */
static double place_of(int point)
{
    return point < 0 ? 0.0 : point < NODES ? collocation.node[point] : 1.0;
}

/* Slopes at a point of the polynomial through all places: under a cubic force a body moves along
 * one of the fifth degree. */
static void differentiate(int point, double by[PLACES])
{
    double place[PLACES];
    for (int j = 0; j < PLACES; j++)
        place[j] = place_of(j - 1);
    lagrange_slopes(place, PLACES, place_of(point), by);
}

/* ---- A step ---- */

static double largest_of(const double *values, int count)
{
    double largest = 0.0;
    for (int i = 0; i < count; i++)
        largest = larger(largest, fabs(values[i]));
    return largest;
}

/* d at a point that is taken by the force at another one: the end has the compliance of its own. */
static double taken_by(const struct way_step *step, const struct way_problem *problem, int point,
                       int by)
{
    if (by < NODES)
        return problem->coupling[point][by];
    return point == NODES ? step->compliance : 0.0;
}

/* Of the approach: nothing but the compliance is between it and d. */
static double without_compliance(const struct way_step *step, const struct way_problem *problem,
                                 int point, int by)
{
    return taken_by(step, problem, point, by) - (point == by ? step->compliance : 0.0);
}

/* ---- Laws that remember ---- */

/* Newton's system for the indentations. */
static void find_excess(const struct way_step *step, const struct way_problem *problem,
                        double matrix[STEP_POINTS * STEP_POINTS], double excess[STEP_POINTS])
{
    for (int i = 0; i < STEP_POINTS; i++) {
        excess[i] = step->indentation[i] - problem->target[i];
        for (int j = 0; j < STEP_POINTS; j++)
            matrix[i * STEP_POINTS + j] = i == j;
        for (int l = 0; l < STEP_POINTS; l++) {
            double taken = taken_by(step, problem, i, l);
            excess[i] += taken * step->force[l];
            for (int j = 0; j < STEP_POINTS; j++)
                matrix[i * STEP_POINTS + j] += taken * step->slope[l][j];
        }
    }
}

/* Newton's method for them, with the turn where it is. */
static bool solve_memory(struct way_step *step, const struct way_problem *problem,
                         unsigned long *iterations)
{
    double rounding = ROUNDING * largest_of(problem->target, STEP_POINTS);
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        double matrix[STEP_POINTS * STEP_POINTS], change[STEP_POINTS];
        memory_step_forces(step->memory, step->indentation, step->force, step->slope);
        find_excess(step, problem, matrix, change);
        ++*iterations;
        if (!linear_solve(STEP_POINTS, matrix, change) ||
            !isfinite(largest_of(change, STEP_POINTS)))
            return false;
        for (int i = 0; i < STEP_POINTS; i++)
            step->indentation[i] -= change[i];
        double most = largest_of(change, STEP_POINTS);
        if (most > problem->last * largest_of(step->indentation, STEP_POINTS) && most > rounding)
            continue;
        for (int i = 0; i < STEP_POINTS; i++) {
            for (int j = 0; j < STEP_POINTS; j++)
                step->force[i] -= step->slope[i][j] * change[j];
            step->force[i] = larger(step->force[i], 0.0);
        }
        return true;
    }
    return false;
}

/* The force behind the turn differs little from that of a contact that grows: each round shifts the
 * turn by far less than the one before. */
enum { TURN_ROUNDS = 3 };

static bool follow_memory(struct way_step *step, const struct way_problem *problem,
                          unsigned long *iterations)
{
    memory_step_start(step->memory, step->level);
    if (!solve_memory(step, problem, iterations))
        return false;
    /* while the forces are those without a turn, or with the one that is gone */
    for (int round = 0; round < TURN_ROUNDS; round++) {
        if (!memory_step_turns(step->memory, step->indentation))
            break;
        if (!solve_memory(step, problem, iterations))
            return false;
    }
    for (int i = 0; i < NODES; i++)
        step->stiffness[i] = step->slope[i][i];
    return true;
}

/* ---- Laws that have the rate in them ---- */

/* The approaches' rates at the points: without force, and less by a force, 1/(N s). */
struct rates {
    double free[STEP_POINTS], by[STEP_POINTS][NODES];
};

static struct rates find_rates(const struct way_step *step, const struct way_problem *problem)
{
    double h = step_length(step->level);
    struct rates rates = {{0.0}, {{0.0}}};
    for (int i = 0; i < STEP_POINTS; i++) {
        double slope[PLACES];
        differentiate(i, slope);
        rates.free[i] = slope[0] * step->approach / h;
        for (int l = 0; l < STEP_POINTS; l++) {
            rates.free[i] += slope[l + 1] * problem->target[l] / h;
            for (int j = 0; j < NODES; j++)
                rates.by[i][j] += slope[l + 1] * without_compliance(step, problem, l, j) / h;
        }
    }
    return rates;
}

/* Newton's system for the forces: indentations, approaches' rates, the law's forces. */
static void find_lack(struct way_step *step, const struct way_problem *problem,
                      const struct rates *rates, double matrix[STEP_POINTS * STEP_POINTS],
                      double lack[STEP_POINTS])
{
    for (int i = 0; i < STEP_POINTS; i++) {
        double d = problem->target[i], rate = rates->free[i], viscosity;
        for (int j = 0; j < STEP_POINTS; j++) {
            d -= taken_by(step, problem, i, j) * step->force[j];
            rate -= j < NODES ? rates->by[i][j] * step->force[j] : 0.0;
        }
        step->indentation[i] = d;
        lack[i] = step->force[i] - step->law->operations->moving(step->law, d, rate,
                                                                 &step->stiffness[i], &viscosity);
        for (int j = 0; j < STEP_POINTS; j++) {
            double by = step->stiffness[i] * taken_by(step, problem, i, j);
            by += j < NODES ? viscosity * rates->by[i][j] : 0.0;
            matrix[i * STEP_POINTS + j] = by + (i == j);
        }
    }
}

static bool follow_rate(struct way_step *step, const struct way_problem *problem,
                        unsigned long *iterations)
{
    const struct rates rates = find_rates(step, problem);
    double rounding = ROUNDING * largest_of(problem->target, STEP_POINTS);
    for (int i = 0; i < STEP_POINTS; i++)
        step->force[i] = contact_law_force(step->law, step->indentation[i], &step->stiffness[i]);
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        double matrix[STEP_POINTS * STEP_POINTS], change[STEP_POINTS];
        find_lack(step, problem, &rates, matrix, change);
        ++*iterations;
        if (!linear_solve(STEP_POINTS, matrix, change))
            return false;
        double most = largest_of(change, STEP_POINTS);
        if (!isfinite(most))
            return false;
        for (int i = 0; i < STEP_POINTS; i++) {
            step->force[i] -= change[i];
            for (int j = 0; j < STEP_POINTS; j++)
                step->indentation[i] += taken_by(step, problem, i, j) * change[j];
        }
        if (most > problem->last * largest_of(step->force, STEP_POINTS) &&
            most > rounding * largest_of(step->stiffness, STEP_POINTS))
            continue;
        for (int i = 0; i < STEP_POINTS; i++)
            step->force[i] = larger(step->force[i], 0.0);
        return true;
    }
    return false;
}

bool way_step_solve(struct way_step *step, const struct way_problem *problem,
                    double indentation[NODES], double force[NODES], unsigned long *iterations)
{
    step->level = problem->level;
    memcpy(step->indentation, indentation, NODES * sizeof *indentation);
    step->indentation[NODES] = collocation_last(indentation);
    if (!(step->memory ? follow_memory : follow_rate)(step, problem, iterations))
        return false;
    memcpy(indentation, step->indentation, NODES * sizeof *indentation);
    memcpy(force, step->force, NODES * sizeof *force);
    return true;
}

bool way_step_bends(const struct way_step *step)
{
    const struct way_taken ends = {.nodes = step->indentation,
                                   .end = step->indentation[NODES],
                                   .end_force = step->force[NODES]};
    if (!step->parted && !(ends.end_force > 0.0))
        return true;
    return step->memory ? memory_step_renews(step->memory, &ends, step->parted)
                        : step->parted && ends.end_force > 0.0;
}

/* ---- Accepted steps ---- */

/* The work on the approach. */
static double work_of(const struct way_step *step, const struct way_taken *taken)
{
    double sum = 0.0;
    for (int i = 0; i < NODES; i++) {
        double by[PLACES];
        differentiate(i, by);
        double rate = by[0] * step->approach;
        for (int j = 0; j < STEP_POINTS; j++) {
            double force = j < NODES ? taken->forces[j] : taken->end_force;
            double d = j < NODES ? taken->nodes[j] : taken->end;
            rate += by[j + 1] * (d + step->compliance * force);
        }
        sum += collocation.weight[i] * taken->forces[i] * rate;
    }
    return sum;
}

/* The share of the step after which no point bears a force: the line through the last two nodes
 * that do, up to the next point. */
static double parting(const double forces[NODES])
{
    int last = NODES - 1;
    while (last >= 0 && !(forces[last] > 0.0))
        last--;
    if (last < 0)
        return 0.0;
    double from = collocation.node[last];
    double until = last + 1 < NODES ? collocation.node[last + 1] : 1.0;
    if (last == 0 || !(forces[last - 1] > forces[last]))
        return from;
    double falls = (forces[last - 1] - forces[last]) / (from - collocation.node[last - 1]);
    return smaller(from + forces[last] / falls, until);
}

static void note_force(struct way_step *step, const struct way_taken *taken)
{
    bool bears = taken->end_force > 0.0 || largest_of(taken->forces, NODES) > 0.0;
    if (!bears && step->largest == 0.0)
        step->touched_at = step->parted_at = taken->time + step_length(taken->level);
    step->work += work_of(step, taken);
    step->now = taken->end_force;
    step->approach = taken->end + step->compliance * step->now;
    if (bears)
        step->largest = larger(step->largest, collocation_peak(taken->forces));
    if (!(taken->end_force > 0.0) && (bears || !step->parted))
        step->parted_at = taken->time + step_length(taken->level) * parting(taken->forces);
    step->parted = !(taken->end_force > 0.0);
}

void way_step_take(struct way_step *step, double time, double end_rate, const double nodes[NODES],
                   const double forces[NODES])
{
    const struct way_taken taken = {.time = time,
                                    .level = step->level,
                                    .nodes = nodes,
                                    .forces = forces,
                                    .end = step->indentation[NODES],
                                    .end_rate = end_rate,
                                    .end_force = step->force[NODES]};
    note_force(step, &taken);
    if (step->memory)
        memory_step_take(step->memory, &taken, step->parted);
}

double way_step_lost(const struct way_step *step, double indentation)
{
    double series = 0.5 * step->compliance * step->now * step->now;
    return step->work - series - step->law->operations->stored(step->law, indentation);
}
