/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bodies that overlap at the stated instant have touched before: the way back to that touch. */
#ifndef PERCUSS_IMPACT_REWIND_H
#define PERCUSS_IMPACT_REWIND_H

#include "base/arena.h"
#include "base/watch.h"
#include "impact/motion.h"

struct rewind {
    double longest;          /* s: how far back vibrating bodies are followed */
    unsigned long intervals; /* that may still be looked at; what was is taken off */
    struct arena *arena;     /* scratch memory until its next reset */
    struct pace *pace;       /* NULL: nobody */
    bool beyond;             /* result: vibrating bodies overlapped for all of `longest` */
};

enum rewind_end {
    REWIND_TOUCHED,
    REWIND_NEVER, /* overlapped for all of the past, or of what was looked at: `beyond` */
    REWIND_LIMIT, /* the intervals were spent, or the pace stopped the search */
    REWIND_MEMORY /* it ran out */
};

/* The latest touch before the motion's instant, for a contact that overlaps now, along the motion
 * that motion_rewind takes: *time < 0, s, where it touched. Bodies at rest but for their rigid
 * motion: any time ago; vibrating ones: within `longest`, and `beyond` says where that was not
 * enough to know. */
enum rewind_end rewind_find(struct rewind *rewind, const struct scene *scene,
                            const struct motion *motion, size_t contact, double *time);

/* Brings a motion back to the touch where bodies overlap at its instant: the latest instant at
 * which all contacts were open, *shift <= 0, s. */
enum rewind_end rewind_to_touch(struct rewind *rewind, const struct scene *scene,
                                struct motion *motion, double *shift);

#endif
