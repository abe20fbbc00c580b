/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "physics/estimates/invariants.h"

static const char *contact_broken(const struct solve_contact_result *contact, bool solved)
{
    if (!isfinite(contact->impulse) || contact->impulse < 0.0)
        return "an impulse that pulls, or is none";
    if (solved && contact->impulse_compression > 0.0 && !isfinite(contact->restitution))
        return "no restitution";
    for (size_t i = 0; i < contact->sub_impacts_listed; i++) {
        const struct sub_impact *sub = &contact->sub_impacts[i];
        if (!(sub->impulse >= 0.0) || !(sub->end >= sub->start) || !isfinite(sub->peak_force))
            return "a sub-impact that is none";
        if (i > 0 && !(sub->start >= contact->sub_impacts[i - 1].end))
            return "sub-impacts that overlap";
    }
    return NULL;
}

/* The energy that the approach alone has: acceleration may take nearly all that is available. */
static double approach_energy(const struct solve_result *result)
{
    double sum = 0.0;
    for (size_t c = 0; c < result->contact_count; c++) {
        double p = result->contacts[c].impulse_compression;
        sum += 0.5 * p * p * result->contacts[c].inverse_effective_mass;
    }
    return sum;
}

static const char *estimate_broken(const struct solve_result *result, double tolerance)
{
    double range = 1.0;
    for (size_t c = 0; c < result->contact_count; c++)
        if (result->contacts[c].restitution > range)
            range = result->contacts[c].restitution;
    if (!(result->restitution_time >= 0.0) || !(result->restitution_modes >= 0.0))
        return "an error estimate that is none";
    /* each from -1 to 1, or to e itself */
    if (result->restitution_time > (1.0 + range) * (1.0 + 1e-12) ||
        result->restitution_modes > (1.0 + range) * (1.0 + 1e-12))
        return "an error estimate beyond what e can be wrong by";
    if (result->tolerance_met &&
        result->restitution_time + result->restitution_modes > tolerance * (1.0 + 1e-12))
        return "tolerance_met with a larger error estimate";
    return NULL;
}

const char *invariant_broken(const struct solve_result *result, double tolerance)
{
    if (result->status == PERCUSS_INTERNAL)
        return "INTERNAL";
    if (result->status != PERCUSS_OK && !result->fault.text[0])
        return "no message";
    if (result->status != PERCUSS_OK && result->status != PERCUSS_TRUNCATED)
        return NULL;
    bool limited = result->end_reason == PERCUSS_END_LIMIT;
    if (limited && result->tolerance_met)
        return "cut off, and the tolerance met";
    for (size_t c = 0; c < result->contact_count; c++) {
        const char *broken = contact_broken(&result->contacts[c], !limited);
        if (broken)
            return broken;
    }
    /* ten times the tolerance (docs/lab/accuracy.md) */
    double scale = fmax(result->energy.available, approach_energy(result));
    if (!isfinite(result->energy.closure) ||
        (result->tolerance_met && fabs(result->energy.closure) > 10.0 * tolerance * scale))
        return "energy that does not balance";
    return estimate_broken(result, tolerance);
}
