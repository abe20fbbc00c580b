/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/step_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "impact/oscillator.h"
#include "impact/oscillator_loss.h"
#include "impact/response.h"

/* Frequencies and ratios of 0. */
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
    responses_free(set->responses);
    oscillators_free(set->undamped);
    free(set->which);
    free(set->omega);
    free(set);
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

/* What lies mode after mode. */
static size_t array_count(bool damped)
{
    return 2 * NODES + 4 + 2 * NODES + (damped ? LOSS_TERMS : 0);
}

/* One block: the table, then its arrays, each `stride` long and aligned. */
static struct step_table *table_allocate(size_t stride, bool damped)
{
    /* zero throughout: the modes that only fill the last lanes never move */
    size_t together = RESPONSE_TERMS + (damped ? 0 : MIDDLE_TERMS);
    size_t arrays = array_count(damped) + together;
    size_t header = (sizeof(struct step_table) + 31) / 32 * 32;
    size_t bytes = header + arrays * stride * sizeof(double);
    unsigned char *block = aligned_alloc(32, (bytes + 31) / 32 * 32);
    if (!block)
        return NULL;
    memset(block, 0, bytes);
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

/* A turn of the mode over a time, see middle_term. */
static void fill_turn(double *term, double omega, double time)
{
    double sine = sin(omega * time);
    term[0] = cos(omega * time);
    term[LANES] = sine / omega;
    term[2 * LANES] = -omega * sine;
}

/* The terms of an undamped mode whose forces' effect at the end is known. */
static void fill_middle(struct step_table *table, double omega, double h, size_t k)
{
    double *term = table->middle + k / LANES * LANES * MIDDLE_TERMS + k % LANES;
    fill_turn(term + TURN_HALF * LANES, omega, 0.5 * h);
    fill_turn(term + TURN_WHOLE * LANES, omega, h);
    fill_turn(term + TURN_SHORTER * LANES, omega, 0.75 * h);
    fill_turn(term + TURN_LONGER * LANES, omega, 1.5 * h);
    const double *half = term + TURN_HALF * LANES;
    for (int pair = 0; pair < NODES / 2; pair++) {
        double x = (0.5 - collocation.node[pair]) * h;
        term[(MIDDLE_COSINE + pair) * LANES] = cos(omega * x);
        term[(MIDDLE_SINE + pair) * LANES] = sin(omega * x) / omega;
        /* what the forces of the pair do until the end, turned back by half a step; of the sum only
         * the even part is left, of the difference the odd one */
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

static void fill_mode(struct step_table *table, const struct oscillators *set, double h, size_t k)
{
    double to_q[NODES + 2];
    double to_v[NODES + 2];
    double *response = table->response + k * RESPONSE_TERMS;
    /* at the nodes: of the motion before, and of forces there */
    for (int i = 0; i < NODES; i++) {
        oscillator_map(set->omega[k], set->damping[k], h, collocation.node[i], to_q, to_v);
        table->node_q[i][k] = to_q[0];
        table->node_v[i][k] = to_q[1];
        for (int j = 0; j < NODES; j++)
            response[i * NODES + j] = to_q[j + 2];
    }
    /* at the end */
    oscillator_map(set->omega[k], set->damping[k], h, 1.0, to_q, to_v);
    table->end_qq[k] = to_q[0];
    table->end_qv[k] = to_q[1];
    table->end_vq[k] = to_v[0];
    table->end_vv[k] = to_v[1];
    for (int j = 0; j < NODES; j++) {
        response[NODES * NODES + j] = to_q[j + 2];
        table->force_q[j][k] = to_q[j + 2];
        table->force_v[j][k] = to_v[j + 2];
    }
    /* what damping takes */
    if (set->most_damping > 0.0) {
        double form[LOSS_INPUTS][LOSS_INPUTS];
        oscillator_loss_form(set->omega[k], set->damping[k], h, form);
        for (int r = 0, term = 0; r < LOSS_INPUTS; r++)
            for (int s = 0; s <= r; s++, term++)
                table->loss[term][k] = form[r][s];
    } else {
        fill_middle(table, set->omega[k], h, k);
    }
}

static void gather_middle(double *to, size_t i, const double *from, size_t k)
{
    to += i / LANES * LANES * MIDDLE_TERMS + i % LANES;
    from += k / LANES * LANES * MIDDLE_TERMS + k % LANES;
    for (size_t term = 0; term < MIDDLE_TERMS; term++)
        to[term * LANES] = from[term * LANES];
}

/* The numbers of a part's oscillators from `first` to `count` are the whole's: array after array,
 * as they lie in its block, and terms. A damped whole has none of undamped modes. */
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
        else if (table->middle)
            fill_middle(table, part->omega[i], step_length(level), i);
    }
}

/* The table of a level with the first `count` oscillators at least. NULL: out of memory. */
static const struct step_table *table_of_first(struct oscillators *set, size_t count, int level)
{
    if (!set->tables[level])
        set->tables[level] = table_allocate(set->stride, set->most_damping > 0.0);
    struct step_table *table = set->tables[level];
    const size_t range[] = {set->filled[level], count};
    if (!table || range[0] >= count)
        return table;
    /* from the whole, which has them first */
    if (set->whole) {
        if (!table_of_first(set->whole, set->which[count - 1] + 1, level))
            return NULL;
        gather(table, set, level, range);
    }
    for (size_t k = range[0]; !set->whole && k < count; k++)
        fill_mode(table, set, step_length(level), k);
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
