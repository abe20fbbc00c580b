/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a scene converges to: solutions below solve() with ever more modes, fixed in number and
 * without the mode choice's judgement, and ever shorter steps, until two in a row agree. */
#ifndef PERCUSS_TEST_ESTIMATES_TRUTH_H
#define PERCUSS_TEST_ESTIMATES_TRUTH_H

#include "physics/support.h"

struct truth_settings {
    double goal;   /* two solutions agree on the restitution: within this */
    double effort; /* at most, of all solutions; the unit is impact_settings.max_work's */
    size_t modes;  /* of a family of a body, in the first solution */
    const struct solve_request *earlier; /* blows before it, each from what the one before left in
                                            this reference: the request's states do not count,
                                            and `elapsed` is from the stated instant of that one */
    size_t earlier_count;                /* 0: the request's states do */
    bool cvode;                          /* all solutions by CVODE, for contacts with friction */
    bool chatty;                         /* print each */
};

/* What a unit impulse of a contact does to one of its bodies, body frame. */
struct truth_effect {
    size_t body;
    double velocity[3], angular_velocity[3];
};

struct truth {
    size_t contacts, sub_impacts; /* of all contacts together */
    double impulse[PERCUSS_MAX_CONTACTS];
    double tangential[PERCUSS_MAX_CONTACTS][2];
    double compression[PERCUSS_MAX_CONTACTS]; /* impulses, Eq. (4) */
    struct truth_effect effect[PERCUSS_MAX_CONTACTS][2];
    double spread;            /* between the last two solutions, in restitution; INFINITY: no two */
    double impulse_spread;    /* in impulse, N s */
    double tangential_spread; /* in tangential impulse, N s; 0 of an answer */
    size_t modes;             /* of a family, in the last one */
    size_t levels;
    double work;
    enum percuss_end_reason end_reason;
};

/* Memory and prepared bodies, for many scenes. */
struct truth_room;
struct truth_room *truth_room_create(void); /* NULL: out of memory */
void truth_room_free(struct truth_room *room);

/* The tolerance is not the request's: settings->goal. False: the request is refused or no solution
 * was complete within the effort. */
bool truth_find(struct truth_room *room, const struct body_set *set,
                const struct solve_request *request, const struct truth_settings *settings,
                struct truth *truth);

/* By an answer whose tolerance is as tight as is affordable. */
void truth_by_answer(const struct solve_result *result, struct truth *truth);

/* One solution by CVODE with so many modes of each family: nothing of the modal method's
 * integration in time is in it. */
bool truth_by_cvode(struct truth_room *room, const struct body_set *set,
                    const struct solve_request *request, const struct truth_settings *settings,
                    struct truth *truth);

/* Largest difference in restitution of any contact that approached, from a set of impulses. */
double truth_distance(const struct truth *truth, const double *impulse);

/* Whether errors of the impulses, `given` of each contact, cover the difference from a set of them:
 * of all contacts; and what they make of the bodies' velocities together, of all bodies. */
bool truth_covers_impulses(const struct truth *truth, const double *impulse, const double *given);
bool truth_covers_velocities(const struct truth *truth, const double *impulse, const double *given);

/* The same in impulse, of any contact, N s. */
double truth_impulse_distance(const struct truth *truth, const double *impulse);

#endif
