/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/complete_mean.h"

#include <math.h>

static void add(double weight, double value, double *sum)
{
    *sum += weight * value;
}

static void add_energy(double weight, const struct complete_energy *energy,
                       struct complete_energy *sum)
{
    add(weight, energy->available, &sum->available);
    add(weight, energy->rebound, &sum->rebound);
    add(weight, energy->vibration, &sum->vibration);
    for (size_t b = 0; b < 2; b++)
        add(weight, energy->vibration_of[b], &sum->vibration_of[b]);
    add(weight, energy->plastic, &sum->plastic);
    add(weight, energy->contact, &sum->contact);
    add(weight, energy->closure, &sum->closure);
}

static void add_sub_impact(double weight, const struct complete_sub_impact *one,
                           struct complete_sub_impact *sum)
{
    add(weight, one->start, &sum->start);
    add(weight, one->end, &sum->end);
    add(weight, one->impulse, &sum->impulse);
    add(weight, one->peak_force, &sum->peak_force);
    add(weight, one->max_indentation, &sum->max_indentation);
    add(weight, one->compression_end, &sum->compression_end);
    add(weight, one->compression_impulse, &sum->compression_impulse);
}

static void add_result(double weight, const struct complete_result *result,
                       struct complete_result *sum)
{
    add(weight, result->impulse, &sum->impulse);
    add(weight, result->restitution, &sum->restitution);
    add(weight, result->contact_time, &sum->contact_time);
    add(weight, result->peak_force, &sum->peak_force);
    add(weight, result->max_indentation, &sum->max_indentation);
    add(weight, result->contact_radius, &sum->contact_radius);
    add(weight, result->end_time, &sum->end_time);
    sum->momentum_error = fmax(sum->momentum_error, result->momentum_error);
    add_energy(weight, &result->energy, &sum->energy);
    for (size_t i = 0; i < result->sub_impacts && i < COMPLETE_SUB_IMPACTS; i++)
        add_sub_impact(weight, &result->sub_impact[i], &sum->sub_impact[i]);
}

bool complete_mean(const struct complete_result *results, const double *weights, size_t count,
                   struct complete_result *mean)
{
    /* alike, and the heaviest */
    size_t heaviest = 0;
    for (size_t k = 0; k < count; k++) {
        if (results[k].sub_impacts != results[0].sub_impacts || results[k].end != results[0].end)
            return false;
        if (weights[k] > weights[heaviest])
            heaviest = k;
    }
    /* its counts */
    const struct complete_result *from = &results[heaviest];
    *mean = (struct complete_result){
        .mass = {from->mass[0], from->mass[1]},
        .sub_impacts = from->sub_impacts,
        .end = from->end,
        .elements = from->elements,
        .plastic_elements = from->plastic_elements,
        .steps = from->steps,
        .levels = from->levels,
        .step = from->step,
    };
    for (size_t k = 0; k < count; k++)
        add_result(weights[k], &results[k], mean);
    return true;
}
