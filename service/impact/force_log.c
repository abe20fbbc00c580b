/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/force_log.h"

#include <string.h>

enum { FIRST_ROOM = 256 };

struct force_log force_log_make(struct arena *arena, size_t contacts)
{
    return (struct force_log){.arena = arena, .contacts = contacts, .complete = true};
}

/* The arena takes nothing back: doubling wastes as much as is in use. */
static bool grow(struct force_log *log)
{
    size_t room = log->room ? 2 * log->room : FIRST_ROOM;
    struct force_step *steps = arena_take(log->arena, room, sizeof *steps);
    if (!steps)
        return false;
    if (log->count > 0)
        memcpy(steps, log->steps, log->count * sizeof *steps);
    log->steps = steps;
    log->room = room;
    return true;
}

void force_log_add(struct force_log *log, double start, int level, double (*const force)[NODES],
                   double (*const indentation)[NODES])
{
    size_t size = log->contacts * sizeof *force;
    struct force_step step = {.start = start, .level = level};
    step.force = arena_take(log->arena, log->contacts, sizeof *force);
    step.indentation = arena_take(log->arena, log->contacts, sizeof *indentation);
    if (!step.force || !step.indentation || (log->count == log->room && !grow(log))) {
        log->complete = false;
        return;
    }
    memcpy(step.force, force, size);
    memcpy(step.indentation, indentation, size);
    log->steps[log->count++] = step;
}
