/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/way_contact.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"

bool way_contact_create(struct way_contact *contact, const struct contact_law *law,
                        double compliance, struct arena *arena)
{
    *contact = (struct way_contact){.law = law, .compliance = compliance, .parted = true};
    if (!law->operations->remembers)
        return true;
    contact->memory = arena_take(arena, 1, sizeof *contact->memory);
    if (contact->memory)
        memory_step_create(contact->memory, law);
    return contact->memory != NULL;
}

bool way_contact_prepare(struct way_contact *contact, int level, struct arena *arena)
{
    return !contact->memory || memory_step_prepare(contact->memory, level, arena);
}

void way_contact_begin(struct way_contact *contact, double time, double approach, bool touches)
{
    bool left = contact->memory && memory_step_begin(contact->memory, time);
    contact->parted = left || !touches;
    contact->approach = contact->own_approach = approach;
}

void way_contact_touch(struct way_contact *contact, double time)
{
    contact->touched_at = contact->parted_at = time;
    contact->largest = 0.0;
}

/* ---- A step ---- */

void way_contact_start(struct way_contact *contact, int level)
{
    if (contact->memory)
        memory_step_start(contact->memory, level);
}

/* Of a law whose force at a point depends on the indentation there, and the rate. */
static void find_at_points(struct way_contact *contact, const double rate[STEP_POINTS],
                           double force[STEP_POINTS])
{
    const struct contact_law *law = contact->law;
    memset(contact->slope, 0, sizeof contact->slope);
    for (int i = 0; i < STEP_POINTS; i++) {
        double d = contact->indentation[i], *slope = &contact->slope[i][i];
        force[i] = law->operations->moving
                       ? law->operations->moving(law, d, rate[i], slope, &contact->viscosity[i])
                       : contact_law_force(law, d, slope);
    }
}

void way_contact_forces(struct way_contact *contact, const double rate[STEP_POINTS],
                        double force[STEP_POINTS])
{
    if (contact->memory)
        memory_step_forces(contact->memory, contact->indentation, force, contact->slope);
    else
        find_at_points(contact, rate, force);
}

bool way_contact_turns(struct way_contact *contact)
{
    return contact->memory && memory_step_turns(contact->memory, contact->indentation);
}

static struct way_taken taken_of(const struct way_contact *contact, int level, double time)
{
    const double *d = contact->indentation, *by = collocation.end[1];
    return (struct way_taken){
        .time = time,
        .level = level,
        .nodes = d,
        .forces = contact->force,
        .end = d[NODES],
        .end_rate =
            (by[0] * d[0] + by[1] * d[1] + by[2] * d[2] + by[3] * d[3]) / step_length(level),
        .end_force = contact->force[NODES],
    };
}

bool way_contact_bends(const struct way_contact *contact)
{
    bool bears = contact->force[NODES] > 0.0;
    if (!contact->law->operations->lossy)
        return false;
    if (!contact->parted && !bears)
        return true;
    /* it touches again what it had parted from */
    if (!contact->memory)
        return contact->parted && bears && contact->own_approach > 0.0;
    const struct way_taken ends = {.nodes = contact->indentation,
                                   .end = contact->indentation[NODES],
                                   .end_force = contact->force[NODES]};
    return memory_step_renews(contact->memory, &ends, contact->parted);
}

/* ---- Accepted steps ---- */

static double largest_of(const double values[NODES])
{
    return larger(larger(fabs(values[0]), fabs(values[1])),
                  larger(fabs(values[2]), fabs(values[3])));
}

/* The work on d + compliance F. */
static double work_of(const struct way_contact *contact, const struct way_slopes *slopes)
{
    double sum = 0.0;
    for (int i = 0; i < NODES; i++) {
        double rate = slopes->by[i][0] * contact->own_approach;
        for (int j = 0; j < STEP_POINTS; j++)
            rate += slopes->by[i][j + 1] *
                    (contact->indentation[j] + contact->compliance * contact->force[j]);
        sum += collocation.weight[i] * contact->force[i] * rate;
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

static void note_force(struct way_contact *contact, const struct way_taken *taken)
{
    double length = step_length(taken->level);
    bool bears = taken->end_force > 0.0 || largest_of(taken->forces) > 0.0;
    if (!bears && contact->largest == 0.0)
        contact->touched_at = contact->parted_at = taken->time + length;
    if (bears)
        contact->largest = larger(contact->largest, collocation_peak(taken->forces));
    if (!(taken->end_force > 0.0) && (bears || !contact->parted))
        contact->parted_at = taken->time + length * parting(taken->forces);
    contact->parted = !(taken->end_force > 0.0);
}

void way_contact_take(struct way_contact *contact, const struct way_slopes *slopes, int level,
                      double time, double approach)
{
    const struct way_taken taken = taken_of(contact, level, time);
    contact->work += work_of(contact, slopes);
    note_force(contact, &taken);
    contact->approach = approach;
    contact->own_approach = taken.end + contact->compliance * taken.end_force;
    if (contact->memory)
        memory_step_take(contact->memory, &taken, contact->parted);
}

double way_contact_lost(const struct way_contact *contact, double indentation, double force)
{
    double series = 0.5 * contact->compliance * force * force;
    return contact->work - series - contact->law->operations->stored(contact->law, indentation);
}
