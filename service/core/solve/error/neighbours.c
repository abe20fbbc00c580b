/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/error/neighbours.h"

#include <math.h>
#include <string.h>

#include "solve/outcome.h"

void neighbours_begin(struct neighbours *neighbours, const struct problem *problem,
                      const struct impact_outcome *answer)
{
    neighbours->solutions = 1;
    neighbours->answer = *answer;
    memset(neighbours->vibration, 0, problem->body_count * sizeof *neighbours->vibration);
    for (size_t c = 0; c < problem->contact_count; c++) {
        neighbours->low[c] = neighbours->high[c] = outcome_restitution(problem, answer, c);
        neighbours->weakest[c] = neighbours->strongest[c] = answer->tracks[c].impulse;
        neighbours->fewest[c] = neighbours->most[c] = answer->tracks[c].count;
        neighbours->tangential[c] = 0.0;
    }
}

void neighbours_add(struct neighbours *neighbours, const struct problem *problem,
                    const struct impact_outcome *other)
{
    neighbours->solutions++;
    outcome_widen_vibration(problem, &neighbours->answer, other, neighbours->vibration);
    for (size_t c = 0; c < problem->contact_count; c++) {
        double e = outcome_restitution(problem, other, c);
        size_t count = other->tracks[c].count;
        neighbours->tangential[c] = fmax(neighbours->tangential[c],
                                         outcome_tangential_change(&neighbours->answer, other, c));
        neighbours->low[c] = fmin(neighbours->low[c], e);
        neighbours->high[c] = fmax(neighbours->high[c], e);
        neighbours->weakest[c] = fmin(neighbours->weakest[c], other->tracks[c].impulse);
        neighbours->strongest[c] = fmax(neighbours->strongest[c], other->tracks[c].impulse);
        if (count < neighbours->fewest[c])
            neighbours->fewest[c] = count;
        if (count > neighbours->most[c])
            neighbours->most[c] = count;
    }
}

double neighbours_distance(const struct neighbours *neighbours, const struct problem *problem,
                           const struct impact_outcome *answer)
{
    double largest = 0.0;
    if (neighbours->solutions < 2)
        return INFINITY;
    for (size_t c = 0; c < problem->contact_count; c++) {
        double e = outcome_restitution(problem, answer, c); /* NAN: fmax leaves it out */
        largest = fmax(largest, fmax(e - neighbours->low[c], neighbours->high[c] - e));
    }
    return largest;
}

double neighbours_impulse_distance(const struct neighbours *neighbours,
                                   const struct impact_outcome *answer, size_t contact)
{
    double impulse = answer->tracks[contact].impulse;
    if (neighbours->solutions < 2)
        return INFINITY;
    return fmax(impulse - neighbours->weakest[contact], neighbours->strongest[contact] - impulse);
}
