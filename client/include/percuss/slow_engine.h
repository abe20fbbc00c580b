/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The callbacks by which the slow scale knows an engine and a service. */
#ifndef PERCUSS_SLOW_ENGINE_H
#define PERCUSS_SLOW_ENGINE_H

#include <percuss/reply.h>
#include <percuss/slow_equations.h>

/* The question to `probe` about the present, and the place of its answer. */
struct percuss_slow_view {
    size_t count;
    const struct percuss_slow_contact *contacts;
    double *gap_rate; /* [count], m/s */
    double *delassus; /* [count x count], 1/kg; NULL: not wanted */
    struct percuss_body_motion
        *bodies; /* [bodies of the configuration]; NULL: not wanted. Position,
                    orientation and velocities of those in the contacts */
};

/* Callbacks return false on failure, which ends the call that needed them (ENGINE in the text). */
struct percuss_slow_engine {
    void *context;
    bool (*probe)(void *context, struct percuss_slow_view *view);
    /* changes the velocities by M^-1 w impulse: + along the normal on a, - on b */
    bool (*apply)(void *context, const struct percuss_slow_contact *contact, double impulse);
    double (*now)(void *context); /* s, of the simulation */
    /* Instead of `apply`, where bodies have coordinates of their own: an impulse on one body, N s,
     * at a point, m, both in the world. Called for a and then, with the opposite impulse, for b. */
    bool (*push)(void *context, uint32_t body, const double impulse[3], const double point[3]);
    /* Beside `apply`, or instead: changes the velocities by M^-1 J^T impulse, with J the Jacobian
     * of the relative velocity of the bodies' points at contact->point: `impulse`, N s, world, acts
     * on a there, and against it on b. Called where an impulse has a tangential part, by friction.
     */
    bool (*apply_vector)(void *context, const struct percuss_slow_contact *contact,
                         const double impulse[3]);
    /* For friction of bodies that joints hold, with apply_vector or push: fills w^T M^-1 w of all
     * directions of up to PERCUSS_MAX_CONTACTS_OBLIQUE contacts, `delassus` [3 count x 3 count],
     * row-major, 1/kg. Row 3i is the normal of contacts[i], 3i + 1 its `tangent` (stated here,
     * unit), 3i + 2 normal x tangent; each is the row for which w.qdot is the velocity of a's point
     * against b's along it. NULL: such bodies have no friction. */
    bool (*oblique)(void *context, size_t count, const struct percuss_slow_contact *contacts,
                    double *delassus);
};

/* The service: `solve` as percuss_solve, `release` as percuss_reply_free. solve NULL: none, every
 * impact has the declared restitution. `problem` (may be NULL): why solve failed. */
struct percuss_slow_service {
    void *context;
    enum percuss_result (*solve)(void *context, const struct percuss_request *request,
                                 struct percuss_reply *reply);
    void (*release)(struct percuss_reply *reply);
    const char *(*problem)(void *context);
};

#endif
