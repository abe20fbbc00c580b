/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/step_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "impact/oscillator.h"

/* A set with all frequencies and ratios 0. */
static struct oscillators *allocate(size_t count)
{
    struct oscillators *set = calloc(1, sizeof *set);
    if (!set)
        return NULL;
    set->count = count;
    set->stride = (count + LANES - 1) / LANES * LANES;
    /* both in one block */
    size_t length = set->stride + LANES;
    set->omega = aligned_alloc(32, 2 * length * sizeof *set->omega);
    if (!set->omega) {
        free(set);
        return NULL;
    }
    memset(set->omega, 0, 2 * length * sizeof *set->omega);
    set->damping = set->omega + length;
    set->bytes = sizeof *set + 2 * length * sizeof *set->omega;
    return set;
}

static void set_one(struct oscillators *set, size_t k, double omega, double damping)
{
    set->omega[k] = omega;
    set->damping[k] = damping;
    set->most_damping = fmax(set->most_damping, damping);
}

struct oscillators *oscillators_create(size_t count, const double *omega, double damping)
{
    struct oscillators *set = allocate(count);
    for (size_t k = 0; set && k < count; k++)
        set_one(set, k, omega[k], damping);
    return set;
}

struct oscillators *oscillators_create_each(size_t count, const double *omega,
                                            const double *damping)
{
    struct oscillators *set = allocate(count);
    for (size_t k = 0; set && k < count; k++)
        set_one(set, k, omega[k], damping[k]);
    return set;
}

void oscillators_free(struct oscillators *set)
{
    if (!set)
        return;
    for (int level = 0; level < STEP_LEVELS; level++) {
        free(set->tables[level]);
        free(set->turns[level]);
    }
    oscillators_free(set->undamped);
    free(set->which);
    free(set->omega);
    free(set);
}

size_t oscillators_bytes(const struct oscillators *set)
{
    return set ? set->bytes + oscillators_bytes(set->undamped) : 0;
}

struct oscillators *oscillators_part(struct oscillators *whole, const size_t *which, size_t count)
{
    struct oscillators *part = allocate(count);
    size_t *kept = malloc((count + 1) * sizeof *kept);
    if (!part || !kept) {
        oscillators_free(part);
        free(kept);
        return NULL;
    }
    for (size_t i = 0; i < count; i++) {
        set_one(part, i, whole->omega[which[i]], whole->damping[which[i]]);
        kept[i] = which[i];
    }
    part->whole = whole;
    part->which = kept;
    part->bytes += (count + 1) * sizeof *kept;
    return part;
}

struct oscillators *oscillators_undamped(struct oscillators *set)
{
    if (set->most_damping == 0.0)
        return set;
    if (!set->undamped)
        set->undamped = oscillators_create(set->count, set->omega, 0.0);
    return set->undamped;
}

/* Number of arrays over the modes. */
static size_t array_count(bool damped)
{
    return 2 * NODES + 4 + 2 * NODES + (damped ? LOSS_TERMS : 0);
}

/* One block: the table, then its arrays, each `stride` long and aligned. */
static struct step_table *table_allocate(struct oscillators *set)
{
    const size_t stride = set->stride;
    const bool damped = set->most_damping > 0.0;
    /* zero throughout: the modes that only fill the last lanes never move */
    size_t together = RESPONSE_TERMS + (damped ? 0 : MIDDLE_TERMS);
    size_t arrays = array_count(damped) + together;
    size_t header = (sizeof(struct step_table) + 31) / 32 * 32;
    size_t bytes = header + arrays * stride * sizeof(double);
    unsigned char *block = aligned_alloc(32, (bytes + 31) / 32 * 32);
    if (!block)
        return NULL;
    memset(block, 0, bytes);
    set->bytes += bytes;
    struct step_table *table = (struct step_table *)block;
    double *next = (double *)(block + header);
    /* arrays in the order of the table */
    double **first[] = {table->node_q,  table->node_v,  &table->end_qq,
                        &table->end_qv, &table->end_vq, &table->end_vv,
                        table->force_q, table->force_v, table->loss};
    size_t lengths[] = {NODES, NODES, 1, 1, 1, 1, NODES, NODES, damped ? LOSS_TERMS : 0};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        for (size_t j = 0; j < lengths[i]; j++, next += stride)
            first[i][j] = next;
    }
    table->response = next;
    table->middle = damped ? NULL : next + RESPONSE_TERMS * stride;
    return table;
}

/* Cosine and sine of an angle. */
struct angle {
    double cosine, sine;
};

static struct angle angle_of(double radians)
{
    return (struct angle){cos(radians), sin(radians)};
}

static struct angle sum_of(struct angle a, struct angle b)
{
    return (struct angle){a.cosine * b.cosine - a.sine * b.sine,
                          a.sine * b.cosine + a.cosine * b.sine};
}

static struct angle difference_of(struct angle a, struct angle b)
{
    return (struct angle){a.cosine * b.cosine + a.sine * b.sine,
                          a.sine * b.cosine - a.cosine * b.sine};
}

/* Angles of an undamped mode: half a step, the nodes from its middle, and the turns to other
 * middles. */
struct swing {
    struct angle half, pair[NODES / 2], whole, shorter, longer;
};

static struct swing swing_of(double angle)
{
    struct angle half = angle_of(0.5 * angle);
    struct angle whole = sum_of(half, half);
    return (struct swing){half,
                          {angle_of((0.5 - collocation.node[0]) * angle),
                           angle_of((0.5 - collocation.node[1]) * angle)},
                          whole,
                          sum_of(half, angle_of(0.25 * angle)),
                          sum_of(half, whole)};
}

/* A turn of the mode, see middle_term. */
static void fill_turn(double *term, double omega, struct angle angle)
{
    term[0] = angle.cosine;
    term[LANES] = angle.sine / omega;
    term[2 * LANES] = -omega * angle.sine;
}

/* The terms of an undamped mode; force_q and force_v of the table are filled. */
static void fill_middle(struct step_table *table, double omega, const struct swing *swing, size_t k)
{
    double *term = table->middle + k / LANES * LANES * MIDDLE_TERMS + k % LANES;
    fill_turn(term + TURN_HALF * LANES, omega, swing->half);
    fill_turn(term + TURN_WHOLE * LANES, omega, swing->whole);
    fill_turn(term + TURN_SHORTER * LANES, omega, swing->shorter);
    fill_turn(term + TURN_LONGER * LANES, omega, swing->longer);
    const double *half = term + TURN_HALF * LANES;
    for (int pair = 0; pair < NODES / 2; pair++) {
        term[(MIDDLE_COSINE + pair) * LANES] = swing->pair[pair].cosine;
        term[(MIDDLE_SINE + pair) * LANES] = swing->pair[pair].sine / omega;
        /* the effect of the pair's forces at the end, turned back by half a step; the sum has only
         * the even part left, the difference only the odd one */
        double q[2];
        double v[2];
        for (int side = 0; side < 2; side++) {
            int j = side ? NODES - 1 - pair : pair;
            double to_q = table->force_q[j][k];
            double to_v = table->force_v[j][k];
            q[side] = half[0] * to_q - half[LANES] * to_v;
            v[side] = half[0] * to_v - half[2 * LANES] * to_q;
        }
        term[(MIDDLE_KICK_Q + pair) * LANES] = 0.5 * (q[1] - q[0]);
        term[(MIDDLE_KICK_V + pair) * LANES] = 0.5 * (v[0] + v[1]);
    }
}

/* An undamped mode on a step that is short for it: the nodes lie in pairs around the middle. */
static void fill_short(struct step_table *table, double omega, double h, size_t k)
{
    double by[SERIES_ROWS][NODES];
    struct swing swing = swing_of(omega * h);
    oscillator_series_response(omega * h, h, by);
    for (int i = 0; i < NODES; i++) {
        struct angle at = i < NODES / 2 ? difference_of(swing.half, swing.pair[i])
                                        : sum_of(swing.half, swing.pair[NODES - 1 - i]);
        table->node_q[i][k] = at.cosine;
        table->node_v[i][k] = at.sine / omega;
    }
    table->end_qq[k] = table->end_vv[k] = swing.whole.cosine;
    table->end_qv[k] = swing.whole.sine / omega;
    table->end_vq[k] = -omega * swing.whole.sine;
    memcpy(table->response + k * RESPONSE_TERMS, by, RESPONSE_TERMS * sizeof(double));
    for (int j = 0; j < NODES; j++) {
        table->force_q[j][k] = by[NODES][j];
        table->force_v[j][k] = by[STEP_POINTS][j];
    }
    fill_middle(table, omega, &swing, k);
}

/* Any mode on any step. */
static void fill_mode(struct step_table *table, const struct oscillators *set, double h, size_t k)
{
    double to_q[NODES][NODES + 2];
    double to_v[NODES][NODES + 2];
    double *response = table->response + k * RESPONSE_TERMS;
    /* at the nodes: by the motion before, and by the forces at the nodes */
    oscillator_maps(set->omega[k], set->damping[k], h, NODES, collocation.node, to_q, to_v);
    for (int i = 0; i < NODES; i++) {
        table->node_q[i][k] = to_q[i][0];
        table->node_v[i][k] = to_q[i][1];
        for (int j = 0; j < NODES; j++)
            response[i * NODES + j] = to_q[i][j + 2];
    }
    /* at the end */
    const double end = 1.0;
    oscillator_maps(set->omega[k], set->damping[k], h, 1, &end, to_q, to_v);
    table->end_qq[k] = to_q[0][0];
    table->end_qv[k] = to_q[0][1];
    table->end_vq[k] = to_v[0][0];
    table->end_vv[k] = to_v[0][1];
    for (int j = 0; j < NODES; j++) {
        response[NODES * NODES + j] = to_q[0][j + 2];
        table->force_q[j][k] = to_q[0][j + 2];
        table->force_v[j][k] = to_v[0][j + 2];
    }
    /* the damping loss */
    if (set->most_damping > 0.0) {
        double form[LOSS_INPUTS][LOSS_INPUTS];
        oscillator_loss_form(set->omega[k], set->damping[k], h, form);
        for (int r = 0, term = 0; r < LOSS_INPUTS; r++)
            for (int s = 0; s <= r; s++, term++)
                table->loss[term][k] = form[r][s];
    } else {
        struct swing swing = swing_of(set->omega[k] * h);
        fill_middle(table, set->omega[k], &swing, k);
    }
}

/* Fills in the oscillators range[0] to range[1] of a level's table. */
static void fill(struct step_table *table, const struct oscillators *set, int level,
                 const size_t range[2])
{
    double h = step_length(level);
    for (size_t k = range[0]; k < range[1]; k++) {
        if (set->most_damping == 0.0 && oscillator_series_reaches(set->omega[k] * h))
            fill_short(table, set->omega[k], h, k);
        else
            fill_mode(table, set, h, k);
    }
}

static void gather_middle(double *to, size_t i, const double *from, size_t k)
{
    to += i / LANES * LANES * MIDDLE_TERMS + i % LANES;
    from += k / LANES * LANES * MIDDLE_TERMS + k % LANES;
    for (size_t term = 0; term < MIDDLE_TERMS; term++)
        to[term * LANES] = from[term * LANES];
}

/* Copies the oscillators range[0] to range[1] of a part from the whole's table: array after array,
 * as they lie in its block, and terms. A damped whole has no terms of undamped modes. */
static void gather(struct step_table *table, const struct oscillators *part, int level,
                   const size_t range[2])
{
    const struct step_table *whole = part->whole->tables[level];
    size_t arrays = array_count(part->most_damping > 0.0);
    for (size_t a = 0; a < arrays; a++) {
        const double *from = whole->node_q[0] + a * part->whole->stride;
        double *to = table->node_q[0] + a * part->stride;
        for (size_t i = range[0]; i < range[1]; i++)
            to[i] = from[part->which[i]];
    }
    for (size_t i = range[0]; i < range[1]; i++) {
        size_t k = part->which[i];
        memcpy(table->response + i * RESPONSE_TERMS, whole->response + k * RESPONSE_TERMS,
               RESPONSE_TERMS * sizeof(double));
        if (table->middle && whole->middle)
            gather_middle(table->middle, i, whole->middle, k);
        else if (table->middle) {
            struct swing swing = swing_of(part->omega[i] * step_length(level));
            fill_middle(table, part->omega[i], &swing, i);
        }
    }
}

/* The table of a level with the first `count` oscillators at least. NULL: out of memory. */
static const struct step_table *table_of_first(struct oscillators *set, size_t count, int level)
{
    if (!set->tables[level])
        set->tables[level] = table_allocate(set);
    struct step_table *table = set->tables[level];
    const size_t range[] = {set->filled[level], count};
    if (!table || range[0] >= count)
        return table;
    /* a part: fill the whole, then copy */
    if (set->whole) {
        if (!table_of_first(set->whole, set->which[count - 1] + 1, level))
            return NULL;
        gather(table, set, level, range);
    } else {
        fill(table, set, level, range);
    }
    set->filled[level] = count;
    return table;
}

const struct step_table *oscillators_table(struct oscillators *set, int level)
{
    return table_of_first(set, set->count, level);
}

enum percuss_status oscillators_prepare(struct oscillators *set, size_t count, int level,
                                        struct pace *pace)
{
    if (set->tables[level] && set->filled[level] >= count)
        return PERCUSS_OK;
    if (!pace_ask(pace, 0.0))
        return PERCUSS_TIMEOUT;
    return table_of_first(set, count, level) ? PERCUSS_OK : PERCUSS_INTERNAL;
}
