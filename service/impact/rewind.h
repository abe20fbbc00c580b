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

/* The latest touch before the motion's instant, for a contact that overlaps now, along the motion
 * that motion_rewind takes: negative time, s; -INFINITY: there was none; NAN: given up, as the
 * intervals were spent, the pace stopped the search, or memory ran out. Bodies at rest but for
 * their rigid motion: any time ago; vibrating ones: within `longest`, and `beyond` says where that
 * was not enough to know. */
double rewind_find(struct rewind *rewind, const struct scene *scene, const struct motion *motion,
                   size_t contact);

#endif
