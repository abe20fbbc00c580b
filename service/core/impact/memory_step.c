/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/memory_step.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"

void memory_step_create(struct memory_step *step, const struct contact_law *law)
{
    *step = (struct memory_step){.stiffness = law->parameters[0],
                                 .modes = recovery_modes_make(law->table)};
    contact_memory_begin(&step->memory, law->table, &step->modes);
}

/* Whether the surface has not recovered from an earlier touch, and the contact grows on it. */
static bool grows_on_rest(const struct memory_step *step)
{
    return step->memory.left.reach > 0.0 && !step->memory.shrinks;
}

bool memory_step_begin(struct memory_step *step, double time)
{
    recovery_fade(&step->memory.left, &step->modes, time - step->time);
    step->time = time;
    return step->memory.left.reach > 0.0;
}

/* ---- Tables of a level ---- */

/* Of the step, at a node or the end. */
static double share_of(int point)
{
    return point < NODES ? collocation.node[point] : 1.0;
}

static double sum_of(const double by[NODES], const double values[NODES])
{
    return (by[0] * values[0] + by[1] * values[1]) + (by[2] * values[2] + by[3] * values[3]);
}

/* z int_0^x exp(-z (x - s)) s^m ds for m = 0 to 3: by parts, each from the one before it, or for
 * short steps by its series z x^(m+1) m! sum (-z x)^n / (m + n + 1)!. */
static void integrate(double z, double x, double integral[NODES])
{
    static const double SHORT = 1.0;
    enum { TERMS = 20 };
    double power = 1.0;
    if (z * x > SHORT) {
        integral[0] = -expm1(-z * x);
        for (int m = 1; m < NODES; m++) {
            power *= x;
            integral[m] = power - m / z * integral[m - 1];
        }
        return;
    }
    for (int m = 0; m < NODES; m++) {
        power *= x;
        double term = power * z / (m + 1), sum = 0.0;
        for (int n = 1; n <= TERMS; n++) {
            sum += term;
            term *= -z * x / (m + n + 1);
        }
        integral[m] = sum;
    }
}

static void fill_recovery(struct memory_level *table, const struct recovery_modes *modes, double h)
{
    for (size_t l = 0; l < modes->count; l++) {
        double z = h / modes->time[l], integral[NODES];
        integrate(z, 1.0, integral);
        for (int j = 0; j < NODES; j++)
            table->pressed[l][j] = modes->driven[l] * sum_of(collocation.monomial[j], integral);
        for (int i = 0; i < STEP_POINTS; i++)
            table->fades[i][l] = exp(-z * share_of(i));
    }
}

static void fill(struct memory_level *table, const struct relaxation *relaxation, double h)
{
    for (size_t k = 0; k < relaxation->count; k++)
        for (int i = 0; i < STEP_POINTS; i++) {
            double x = share_of(i), integral[NODES];
            integrate(h / relaxation->time[k], x, integral);
            table->kept[k][i] = exp(-h / relaxation->time[k] * x);
            for (int j = 0; j < NODES; j++) {
                for (int m = 0; m < NODES; m++)
                    table->by[k][i][j] += collocation.monomial[j][m] * integral[m];
                table->all[i][j] += relaxation->share[k] * table->by[k][i][j];
            }
        }
}

bool memory_step_prepare(struct memory_step *step, int level, struct arena *arena)
{
    struct memory_level **table = &step->levels[level];
    if (*table)
        return true;
    *table = arena_take(arena, 1, sizeof **table);
    if (!*table)
        return false;
    fill(*table, step->memory.relaxation, step_length(level));
    fill_recovery(*table, &step->modes, step_length(level));
    return true;
}

/* ---- Along a step ---- */

/* Coefficients of the cubic through the nodes. */
static void expand(const double values[NODES], double c[NODES])
{
    memset(c, 0, NODES * sizeof *c);
    for (int j = 0; j < NODES; j++)
        for (int m = 0; m < NODES; m++)
            c[m] += values[j] * collocation.monomial[j][m];
}

/* d less what is left of the free surface's displacement, as a parabola of y: w (memory.h). */
static void press(const struct memory_step *step, int point, double d, double pressed[3])
{
    const double *left = step->left[point];
    pressed[0] = d - left[0];
    pressed[1] = -1.0 - left[1];
    pressed[2] = -left[2];
}

/* d^(3/2), or G (memory.h), which the memory of a contact that grows follows, and its slope. */
static double raised(const struct memory_step *step, int point, double d, double *slope)
{
    if (grows_on_rest(step)) {
        double pressed[3];
        press(step, point, d, pressed);
        return contact_memory_shrinking(1.0, d, pressed, step->memory.left.reach, slope);
    }
    double root = d > 0.0 ? sqrt(d) : 0.0;
    *slope = 1.5 * root;
    return root * d;
}

/* At the nodes, while the contact grows: those values, how far the middle is pressed, and the
 * width.
 */
struct grown {
    double raised[NODES], middle[NODES], width[NODES];
};

static struct grown grow_at_nodes(const struct memory_step *step, const double nodes[NODES])
{
    struct grown grown;
    for (int i = 0; i < NODES; i++) {
        double slope, pressed[3];
        grown.raised[i] = raised(step, i, nodes[i], &slope);
        grown.middle[i] = larger(nodes[i], 0.0); /* one of a group may be open still */
        grown.width[i] = nodes[i];
        if (!grows_on_rest(step))
            continue;
        press(step, i, nodes[i], pressed);
        grown.middle[i] = larger(pressed[0], 0.0);
        grown.width[i] = contact_memory_edge(nodes[i], pressed, step->memory.left.reach);
    }
    return grown;
}

/* The width of a contact that grows, at the end of the step. */
static double width_at_end(const struct memory_step *step, double end)
{
    double pressed[3];
    if (!grows_on_rest(step))
        return end;
    press(step, NODES, end, pressed);
    return contact_memory_edge(end, pressed, step->memory.left.reach);
}

/* Of the cubic through the nodes, over the step's length. */
static double slope_at_end(const double values[NODES])
{
    return sum_of(collocation.end[1], values);
}

/* Term k at a share x of the step. */
static double memory_at(double z, double x, double start, const double values[NODES])
{
    double c[NODES], integral[NODES];
    expand(values, c);
    integrate(z, x, integral);
    return exp(-z * x) * start + sum_of(c, integral);
}

/* What is remembered where the contact turns from growing to shrinking, by the indentations at the
 * points. False: it does not turn on the step: also where the cubic of its width does, but it is
 * wider at the end, as one that begins slowly. */
static bool find_turn(struct memory_step *step, const double d[STEP_POINTS])
{
    step->turn = INFINITY;
    if (step->memory.shrinks)
        return false;
    const struct grown grown = grow_at_nodes(step, d);
    double x = collocation_turn(grown.width);
    if (!(x > 0.0 && x < 1.0 && collocation_value(grown.width, x) > 0.0))
        return false;
    if (width_at_end(step, d[NODES]) > collocation_value(grown.width, x))
        return false;
    step->turned = step->memory;
    for (size_t k = 0; k < step->memory.relaxation->count; k++) {
        double z = step_length(step->level) / step->memory.relaxation->time[k];
        step->turned.center[k] = memory_at(z, x, step->memory.center[k], grown.middle);
        step->turned.total[k] = memory_at(z, x, step->memory.total[k], grown.raised);
    }
    recovery_fade(&step->turned.left, &step->modes, step_length(step->level) * x);
    contact_memory_shrink(&step->turned, collocation_value(grown.width, x));
    step->turn = x;
    return true;
}

/* ---- Forces ---- */

/* A point of the step without what the nodes add. */
struct recollection {
    double remembered; /* sum of share times the kept part of total or center */
    double slope, bend;
};

/* Of a point before the turn. */
static struct recollection recall(const struct memory_step *step, const struct memory_level *table,
                                  int point)
{
    const struct contact_memory *memory = &step->memory;
    struct recollection sum = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < memory->relaxation->count; k++) {
        double share = memory->relaxation->share[k], kept = table->kept[k][point];
        const double *from = memory->shrinks ? memory->center : memory->total;
        sum.remembered += share * kept * from[k];
        sum.slope += share * (kept * memory->slope[k] - (1.0 - kept));
        sum.bend += share * kept * memory->bend[k];
    }
    return sum;
}

/* Of a point behind it: its parabolas fade from there on. */
static struct recollection recall_turned(const struct memory_step *step,
                                         const struct memory_level *table, int point)
{
    const struct contact_memory *memory = &step->memory, *turned = &step->turned;
    struct recollection sum = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < memory->relaxation->count; k++) {
        double share = memory->relaxation->share[k];
        double z = step_length(step->level) / memory->relaxation->time[k];
        double kept = exp(-z * (share_of(point) - step->turn));
        sum.remembered += share * table->kept[k][point] * (memory->center[k] + step->middle[k]);
        sum.slope += share * (kept * turned->slope[k] - (1.0 - kept));
        sum.bend += share * kept * turned->bend[k];
    }
    return sum;
}

/* The values that the memory at a point follows: those of all nodes, and their slopes. */
static bool follows_depths(const struct memory_step *step, int point)
{
    return step->memory.shrinks || share_of(point) > step->turn;
}

/* Force at a point for an indentation d there and those of all nodes. `slopes`: by these and, at
 * last, by d. */
static double force_at(const struct memory_step *step, const struct memory_level *table, int point,
                       double d, const double nodes[NODES], double slopes[STEP_POINTS])
{
    bool depths = follows_depths(step, point);
    const struct contact_memory *memory = step->memory.shrinks ? &step->memory : &step->turned;
    struct recollection sum = depths && !step->memory.shrinks ? recall_turned(step, table, point)
                                                              : recall(step, table, point);
    double values[NODES], rise[NODES], own = 1.0, slope, force;
    for (int j = 0; j < NODES; j++) {
        values[j] = nodes[j];
        rise[j] = 1.0;
        if (!depths)
            values[j] = raised(step, j, nodes[j], &rise[j]);
    }
    double remembered = sum.remembered + sum_of(table->all[point], values);
    if (depths) {
        const double pressed[3] = {d - remembered, -1.0 - sum.slope, -sum.bend};
        force = contact_memory_shrinking(step->stiffness, d, pressed, memory->width, &slope);
    } else {
        double grown = raised(step, point, d, &own);
        force = contact_memory_growing(step->stiffness, grown, remembered, &slope);
    }
    for (int j = 0; j < NODES; j++)
        slopes[j] = -slope * table->all[point][j] * rise[j];
    slopes[NODES] = slope * own;
    return force;
}

/* What is left of the surface on the step. */
static void find_left(struct memory_step *step, const struct memory_level *table)
{
    memset(step->middle, 0, sizeof step->middle);
    if (!grows_on_rest(step))
        return;
    for (int point = 0; point < STEP_POINTS; point++)
        recovery_shape(&step->memory.left, &step->modes, table->fades[point], step->left[point]);
    recovery_modes_join(&step->modes, step->memory.left.center, step->middle);
}

void memory_step_start(struct memory_step *step, int level)
{
    step->level = level;
    step->turn = INFINITY;
    find_left(step, step->levels[level]);
}

void memory_step_forces(const struct memory_step *step, const double d[STEP_POINTS],
                        double force[STEP_POINTS], double slope[STEP_POINTS][STEP_POINTS])
{
    const struct memory_level *table = step->levels[step->level];
    for (int i = 0; i < STEP_POINTS; i++) {
        double slopes[STEP_POINTS];
        force[i] = force_at(step, table, i, d[i], d, slopes);
        memcpy(slope[i], slopes, sizeof slopes);
        slope[i][NODES] = 0.0;
        slope[i][i] += slopes[NODES];
    }
}

bool memory_step_turns(struct memory_step *step, const double d[STEP_POINTS])
{
    bool turned = step->turn < 1.0;
    return find_turn(step, d) || turned;
}

/* ---- Accepted steps ---- */

bool memory_step_renews(const struct memory_step *step, const struct way_taken *ends, bool parted)
{
    if (step->memory.shrinks)
        return ends->end > ends->nodes[NODES - 1];
    return step->memory.left.reach > 0.0 && parted && ends->end_force > 0.0;
}

/* The modes of recovery over a step that the forces press, from the memory where it begins. */
static void take_left(struct memory_step *step, const struct way_taken *taken, bool turns)
{
    struct recovery *left = &step->memory.left;
    const struct memory_level *table = step->levels[taken->level];
    bool shrinks = step->memory.shrinks || turns;
    double since[RELAXATION_MOST];
    recovery_modes_split(&step->modes, step->memory.total, since);
    for (size_t l = 0; l < step->modes.count; l++) {
        double kept = table->fades[NODES][l];
        if (turns)
            left->total[l] += since[l];
        left->total[l] *= kept;
        left->center[l] *= kept;
        if (shrinks)
            left->total[l] += sum_of(table->pressed[l], taken->forces) / step->stiffness;
    }
}

/* The memories over the step. */
static void take_terms(struct memory_step *step, const struct way_taken *taken,
                       const struct grown *grown, bool turns)
{
    struct contact_memory *memory = &step->memory;
    const struct memory_level *table = step->levels[taken->level];
    bool presses = memory->shrinks || turns;
    for (size_t k = 0; k < memory->relaxation->count; k++) {
        double kept = table->kept[k][NODES];
        if (turns)
            memory->center[k] += step->middle[k];
        memory->center[k] = kept * memory->center[k] +
                            sum_of(table->by[k][NODES], presses ? taken->nodes : grown->middle);
        memory->total[k] = kept * memory->total[k] + sum_of(table->by[k][NODES], grown->raised);
        if (turns)
            kept =
                exp(-step_length(taken->level) / memory->relaxation->time[k] * (1.0 - step->turn));
        const struct contact_memory *from = turns ? &step->turned : memory;
        memory->slope[k] = kept * from->slope[k] - (1.0 - kept);
        memory->bend[k] = kept * from->bend[k];
    }
}

void memory_step_take(struct memory_step *step, const struct way_taken *taken, bool parted)
{
    struct contact_memory *memory = &step->memory;
    bool turns = step->turn < 1.0;
    const struct grown grown = grow_at_nodes(step, taken->nodes);
    double end = width_at_end(step, taken->end), widest = collocation_peak(grown.width);
    if (memory->left.reach > 0.0 || turns)
        take_left(step, taken, turns);
    take_terms(step, taken, &grown, turns);
    if (turns) {
        memory->shrinks = true;
        memory->width = memory->left.reach = step->turned.width;
    }
    /* its width does: d may fall beside it, as under a surface that recovers faster */
    if (!memory->shrinks && end > 0.0 && slope_at_end(grown.width) < 0.0)
        contact_memory_shrink(memory, end);
    /* a turn that was missed: at the largest width of the step */
    if (!memory->shrinks && parted && memory->total[0] > 0.0 && widest > 0.0)
        contact_memory_shrink(memory, widest);
    /* one that turns just before the end does not grow again, though the rate is about 0 still */
    if (memory->shrinks && (parted || (taken->end_rate > 0.0 && !turns)))
        contact_memory_renew(memory);
    step->time = taken->time + step_length(taken->level);
}
