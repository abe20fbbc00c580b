/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The inputs of a solve. A request names bodies by their ids, with their poses, velocities and
 * contacts; percuss/fields.h describes its members. Units SI; conventions as at the top of
 * idl/percuss_wire.idl. */
#ifndef PERCUSS_SOLVE_REQUEST_H
#define PERCUSS_SOLVE_REQUEST_H

#include <stdbool.h>
#include <stddef.h>

#include "base/watch.h"
#include "contact/body_state.h"
#include "model/body.h"
#include "percuss/fields.h"

/* The members that requests have on the wire, but for the texts that name a body's earlier
 * state. */
#define SOLVE_MEMBER(kind, name, ...)      SOLVE_MEMBER_##kind(name, __VA_ARGS__)
#define SOLVE_MEMBER_NUMBER(name, ...)     double name;
#define SOLVE_MEMBER_DEFAULTED(name, ...)  double name;
#define SOLVE_MEMBER_VECTOR(name, ...)     double name[3];
#define SOLVE_MEMBER_UNIT(name, size, ...) double name[size];
#define SOLVE_MEMBER_ID(name, ...)         char name[PERCUSS_ID_SIZE];
#define SOLVE_MEMBER_TEXT(name, ...)
#define SOLVE_MEMBER_INDEX(name, ...)          unsigned name;
#define SOLVE_MEMBER_CHOICE(name, choice, ...) enum percuss_##choice name;
#define SOLVE_MEMBER_FLAG(name, ...)           bool name;

struct solve_body {
    PERCUSS_BODY_FIELDS(SOLVE_MEMBER, PERCUSS_NONE)
    const struct body_state *state; /* NULL: at rest, without dents; borrowed */
    size_t variation_count;
    struct body_variation variations[PERCUSS_PARAMETER_COUNT]; /* instead of the catalogue's */
};

struct solve_contact {
    PERCUSS_CONTACT_FIELDS(SOLVE_MEMBER)
};

struct solve_options {
    PERCUSS_OPTION_FIELDS(SOLVE_MEMBER) /* the deadline is for the watch, the solver has no clock */
};

/* Shifts of a contact's models: force, compliance in series, stress of yield, coefficient of
 * friction (of which the stated one is the median of a log-normal distribution). */
enum {
    SOLVE_SHIFT_FORCE,
    SOLVE_SHIFT_COMPLIANCE,
    SOLVE_SHIFT_YIELD,
    SOLVE_SHIFT_FRICTION,
    SOLVE_SHIFTS
};

/* Another coefficient of friction of one contact than the request and the catalogue state. */
struct solve_friction {
    bool given;
    size_t contact;
    double coefficient; /* 0: none */
};

struct solve_request {
    size_t body_count, contact_count;
    struct solve_body bodies[PERCUSS_MAX_BODIES];
    struct solve_contact contacts[PERCUSS_MAX_CONTACTS];
    const double *delassus; /* row-major; NULL: the service's; borrowed */
    bool delassus_oblique;  /* it has 3 rows a contact: of its normal, its first and its second
                               tangent, as fast as these stand here; else one, the normal's */
    struct solve_options options;
    double model_shift[SOLVE_SHIFTS]; /* of the models, in standard deviations of their errors
                                         (model_shift.h); 0: as they are */
    struct solve_friction friction;   /* instead of the stated one */
};

/* Default horizon, s, or two longest periods where they are more: the sub-impacts of bodies on a
 * bench are over by then. */
static const double SOLVE_HORIZON = 0.020;
/* Default tolerance: the scatter of measured restitutions. */
static const double SOLVE_TOLERANCE = 1e-3;

struct contact_table_source; /* contact/law_table.h */

/* Other inputs of a solve than the request; all borrowed. */
struct solve_context {
    const struct body_set *catalogue;
    const struct contact_table_source *tables; /* of contact laws; NULL: none */
    struct watch watch; /* polled about once a millisecond; where it says stop, the solve ends with
                           TIMEOUT */
};

/* Velocity of a's point of a contact against b's, world, m/s. */
void solve_contact_velocity(const struct solve_request *request, size_t contact,
                            double velocity[3]);

/* On the restitution: as stated, or the default. */
static inline double solve_tolerance(const struct solve_options *options)
{
    return options->tolerance > 0.0 ? options->tolerance : SOLVE_TOLERANCE;
}

#endif
