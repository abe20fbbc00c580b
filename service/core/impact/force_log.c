/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/force_log.h"

#include <string.h>

enum { FIRST_ROOM = 256 };

struct force_log force_log_make(struct arena *arena, size_t rows)
{
    return (struct force_log){.arena = arena, .rows = rows, .complete = true};
}

/* The arena frees nothing: doubling wastes as much as is in use. */
static bool grow(struct force_log *log)
{
    size_t room = log->room ? 2 * log->room : FIRST_ROOM;
    struct force_step *steps = arena_reserve(log->arena, room, sizeof *steps);
    double(*values)[NODES] =
        arena_reserve(log->arena, 2 * log->rows * (room - log->count), sizeof *values);
    if (!steps || !values)
        return false;
    if (log->count > 0)
        memcpy(steps, log->steps, log->count * sizeof *steps);
    log->steps = steps;
    log->values = values;
    log->room = room;
    return true;
}

void force_log_add(struct force_log *log, double start, int level, double (*const force)[NODES],
                   double (*const indentation)[NODES], size_t contacts, const struct track *tracks)
{
    size_t n = log->rows;
    struct force_step step = {.start = start, .level = level};
    log->complete = log->complete && !(log->most > 0 && log->count == log->most) &&
                    (log->count < log->room || grow(log));
    if (log->dents && log->complete) {
        step.deepened = arena_take(log->arena, n, sizeof *step.deepened);
        log->complete = step.deepened != NULL;
    }
    if (!log->complete)
        return;
    step.force = log->values;
    step.indentation = log->values + n;
    log->values += 2 * n;
    for (size_t c = 0; c < n; c++) { /* constant sizes: no calls */
        memcpy(step.force[c], force[c], sizeof *force);
        memcpy(step.indentation[c], indentation[c], sizeof *indentation);
    }
    for (size_t c = 0; log->dents && c < contacts; c++)
        step.deepened[c] = tracks[c].deepened;
    log->steps[log->count++] = step;
}
