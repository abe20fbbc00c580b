/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/nearby.h"

#include <math.h>
#include <string.h>

#include "solve/outcome.h"

void nearby_begin(struct nearby *nearby, const struct problem *problem,
                  const struct impact_outcome *answer)
{
    nearby->solutions = 1;
    nearby->answer = *answer;
    memset(nearby->vibration, 0, problem->body_count * sizeof *nearby->vibration);
    for (size_t c = 0; c < problem->contact_count; c++) {
        nearby->low[c] = nearby->high[c] = outcome_restitution(problem, answer, c);
        nearby->weakest[c] = nearby->strongest[c] = answer->tracks[c].impulse;
        nearby->fewest[c] = nearby->most[c] = answer->tracks[c].count;
    }
}

void nearby_add(struct nearby *nearby, const struct problem *problem,
                const struct impact_outcome *other)
{
    nearby->solutions++;
    outcome_widen_vibration(problem, &nearby->answer, other, nearby->vibration);
    for (size_t c = 0; c < problem->contact_count; c++) {
        double e = outcome_restitution(problem, other, c);
        size_t count = other->tracks[c].count;
        nearby->low[c] = fmin(nearby->low[c], e);
        nearby->high[c] = fmax(nearby->high[c], e);
        nearby->weakest[c] = fmin(nearby->weakest[c], other->tracks[c].impulse);
        nearby->strongest[c] = fmax(nearby->strongest[c], other->tracks[c].impulse);
        if (count < nearby->fewest[c])
            nearby->fewest[c] = count;
        if (count > nearby->most[c])
            nearby->most[c] = count;
    }
}

double nearby_distance(const struct nearby *nearby, const struct problem *problem,
                       const struct impact_outcome *answer)
{
    double largest = 0.0;
    if (nearby->solutions < 2)
        return INFINITY;
    for (size_t c = 0; c < problem->contact_count; c++) {
        double e = outcome_restitution(problem, answer, c); /* NAN: fmax leaves it out */
        largest = fmax(largest, fmax(e - nearby->low[c], nearby->high[c] - e));
    }
    return largest;
}

double nearby_impulse_distance(const struct nearby *nearby, const struct impact_outcome *answer,
                               size_t contact)
{
    double impulse = answer->tracks[contact].impulse;
    if (nearby->solutions < 2)
        return INFINITY;
    return fmax(impulse - nearby->weakest[contact], nearby->strongest[contact] - impulse);
}
