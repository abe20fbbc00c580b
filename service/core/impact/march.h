/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The march through one impact: back to the touch where bodies overlap, flights and contact phases
 * in turn, and at the end the books and the energy's audit. Methods differ in the contact phase. */
#ifndef PERCUSS_IMPACT_MARCH_H
#define PERCUSS_IMPACT_MARCH_H

#include "base/arena.h"
#include "base/watch.h"
#include "impact/flight.h"
#include "impact/impact.h"
#include "impact/motion.h"

struct march {
    const struct scene *stated; /* the problem's */
    struct scene scene;         /* the same with the outcome's laws, which change as they yield */
    struct impact_outcome *outcome; /* from impact_create; its motion is the present */
    double horizon;                 /* s from the stated instant */
    double accuracy;                /* relative, of the impulses; 0: to rounding */
    unsigned long most;             /* contact steps and flight intervals that are allowed */
    struct pace *pace;              /* NULL: no time limit */
    struct fault *fault;            /* cause of a failure; NULL: not stored */

    enum percuss_status status; /* not OK: it has failed */
    unsigned long used;         /* of `most` */
    double cost;                /* work of a step or interval */
    double damping;             /* taken so far, J */
    bool *closed;               /* [contact]: a sub-impact is under way */
    double *indentation;        /* [contact], local, when the window ends */
    const double *force;        /* [contact], of lossy laws, when the window ends, N */
    double *tangential;         /* [2 frictions], forces of the tangents then, N */
    struct flight flight;
};

/* A method of solving contacts. `state` is its own, of one march. */
struct march_method {
    bool flies; /* passes flights too: its contact phase begins at once and ends the march */
    /* From a touch of `contact` until every contact is open again (NONE) or the march ends. Moves
     * the outcome's motion, keeps its books by march_open and march_close, adds to `used` and
     * `damping`. */
    enum percuss_end_reason (*contact_phase)(void *state, size_t contact);
    /* The march has ended, for outcome->end_reason: the last entries into the books of contacts
     * that are still closed, and their `indentation`. */
    void (*end)(void *state);
};

/* Prepares a march. The members down to `fault` but for `scene` are set. The outcome has no
 * sub-impacts yet, its motion is that of the stated instant. `arena` holds all of it. False: out of
 * memory. */
bool march_create(struct march *march, struct arena *arena);

/* Goes through the impact. PERCUSS_OK (also where no touch was found behind an overlap: see
 * outcome->always_overlapped), TIMEOUT where the pace stopped it, or why it failed: the outcome is
 * then invalid. */
enum percuss_status march_run(struct march *march, const struct march_method *method, void *state,
                              struct arena *arena);

/* A sub-impact of a contact begins at `time`, or ends, with a rigid gap rate. */
void march_open(struct march *march, size_t contact, double time, double gap_rate);
void march_close(struct march *march, size_t contact, double time, double gap_rate);

/* Error of a gap's rate by the errors of the impulses so far, m/s. */
double march_unknown_rate(const struct march *march, size_t contact);

/* Whether any contact is closed. */
bool march_in_contact(const struct march *march);

/* End of a march after the last contact: HANDED_BACK to the slow scale where an acceleration will
 * close a contact again, else SEPARATED. */
enum percuss_end_reason march_parted(const struct march *march);

/* Marks the march as failed: INTERNAL without memory, or another status with its message written.
 * Returns an end of contact phases. */
enum percuss_end_reason march_fail(struct march *march, enum percuss_status status);

struct rewind {
    double longest;          /* s: how far back vibrating bodies are followed */
    unsigned long intervals; /* left for the search, which counts them down */
    struct arena *arena;     /* scratch memory until its next reset */
    struct pace *pace;       /* NULL: no time limit */
    bool beyond;             /* result: vibrating bodies overlapped for all of `longest` */
};

enum rewind_end {
    REWIND_TOUCHED,
    REWIND_NEVER, /* overlapped for all of the past, or (`beyond`) of `longest` */
    REWIND_LIMIT, /* the intervals were spent, or the pace stopped the search */
    REWIND_MEMORY /* it ran out */
};

/* The latest touch before the motion's instant, for a contact that overlaps now, along the motion
 * that motion_rewind takes: *time < 0, s, where it touched. Bodies at rest but for their rigid
 * motion: any time ago; vibrating ones: within `longest`, `beyond` if that was too short. */
enum rewind_end rewind_find(struct rewind *rewind, const struct scene *scene,
                            const struct motion *motion, size_t contact, double *time);

/* Brings a motion back to the touch where bodies overlap at its instant: the latest instant at
 * which all contacts were open, *shift <= 0, s. */
enum rewind_end rewind_to_touch(struct rewind *rewind, const struct scene *scene,
                                struct motion *motion, double *shift);

#endif
