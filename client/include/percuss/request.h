/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A request: which bodies touch where. SI units; quaternions (w, x, y, z), world = R(q) body; body
 * frame: origin in the centre of mass, rods and beams along x. */
#ifndef PERCUSS_REQUEST_H
#define PERCUSS_REQUEST_H

#include <percuss/result.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A parameter of a body in this request only, instead of the catalogue's. */
struct percuss_override {
    enum percuss_parameter parameter; /* PERCUSS_PARAMETER_YOUNG, ... */
    double value;
};

/* One body at the stated instant. */
struct percuss_body_motion {
    char id[PERCUSS_ID_SIZE];       /* name in the server's catalogue */
    double position[3];             /* of the centre of mass, world, m */
    double orientation[4];          /* unit quaternion */
    double velocity[3];             /* of the centre of mass, world, m/s */
    double angular_velocity[3];     /* world, rad/s */
    char state[PERCUSS_ID_SIZE];    /* token of an earlier reply; "": at rest, without dents */
    double elapsed;                 /* s since that state: that of its reply's `window` */
    char specimen[PERCUSS_ID_SIZE]; /* durable object on a rig; "": none */
    uint32_t override_count;
    struct percuss_override overrides[PERCUSS_PARAMETER_COUNT]; /* each parameter once */
};

struct percuss_contact {
    uint32_t a, b;           /* indices into bodies */
    double point[3];         /* world, m */
    double normal[3];        /* world, unit, from b to a */
    double gap;              /* m; negative: the bodies overlap already */
    double gap_acceleration; /* n.(a_A - a_B), m/s^2; negative presses */
    double friction;         /* coefficient; 0: the catalogue's for the two materials, if any */
    double tangent[3]; /* world; first tangential direction, made normal to `normal`; zero: the
                          world axis least parallel to the normal (x before y before z) */
};

struct percuss_options {
    double tolerance; /* on the restitution; 0: 1e-3 */
    double horizon;   /* s; 0: max(20 ms, two longest periods) */
    enum percuss_contact_model contact_model;
    enum percuss_method method;
    enum percuss_compliance compliance;
    enum percuss_dents dents;
    bool conditioning; /* also report d(restitution)/d(speed) */
    bool trace;        /* the server also writes time histories on topic percuss/v1/Trace, see
                          percuss_solve_traced */
    double deadline;   /* s from arrival until the server gives up; 0: none */
    enum percuss_friction friction; /* law of the tangential forces of contacts with a
                                       coefficient */
};

/* About 32 KiB; only the first body_count and contact_count elements are read. */
struct percuss_request {
    uint64_t sequence; /* 0: the client counts. Set it to repeat a request after a time-out */
    size_t body_count, contact_count;
    struct percuss_body_motion bodies[PERCUSS_MAX_BODIES];
    struct percuss_contact contacts[PERCUSS_MAX_CONTACTS];
    const double *delassus; /* the caller's w^T M^-1 w, delassus_rows x delassus_rows, row-major,
                               1/kg; borrowed; NULL: the server's own */
    struct percuss_options options;
    /* 0 or contact_count: a row for the normal of each contact. 3 contact_count: row 3i is the
     * normal of contact i, 3i + 1 its first tangent and 3i + 2 its second one, normal x first. Row
     * r of w has velocity of a's point against b's along its direction = w_r . (the simulator's
     * generalized velocities). A request in which a contact has friction needs 3 contact_count, of
     * up to PERCUSS_MAX_CONTACTS_OBLIQUE contacts; of those without, the tangents' numbers are not
     * used. */
    size_t delassus_rows;
};

/* Every option at its default. */
PERCUSS_API struct percuss_options percuss_options_default(void);

/* An empty request with default options. */
PERCUSS_API void percuss_request_init(struct percuss_request *request);

/* Appends a body at the origin, unrotated, at rest, without state. Returns it for the caller to
 * fill; NULL if the request is full or the id longer than 63 bytes, and percuss_error_text says
 * which. */
PERCUSS_API struct percuss_body_motion *percuss_request_add_body(struct percuss_request *request,
                                                                 const char *id);

/* Appends a contact of bodies[a] on bodies[b] with zero point, normal and gap. Returns it for the
 * caller to fill; NULL if the request is full, and percuss_error_text says so. */
PERCUSS_API struct percuss_contact *percuss_request_add_contact(struct percuss_request *request,
                                                                uint32_t a, uint32_t b);

#ifdef __cplusplus
}
#endif

#endif
