/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The numbered choices of the wire with their names, one list each; the same numbers stand as
 * constants in percuss_wire.idl, and a test compares them. Used by the service and by clients. */
#ifndef PERCUSS_VOCABULARY_H
#define PERCUSS_VOCABULARY_H

#define PERCUSS_STATUS_LIST(X)                                                                     \
    X(OK, "OK")                                                                                    \
    X(TRUNCATED, "TRUNCATED")                                                                      \
    X(BAD_REQUEST, "BAD_REQUEST")                                                                  \
    X(NOT_APPROACHING, "NOT_APPROACHING")                                                          \
    X(UNKNOWN_BODY, "UNKNOWN_BODY")                                                                \
    X(UNSUPPORTED_GEOMETRY, "UNSUPPORTED_GEOMETRY")                                                \
    X(UNKNOWN_STATE, "UNKNOWN_STATE")                                                              \
    X(BUSY, "BUSY")                                                                                \
    X(TIMEOUT, "TIMEOUT")                                                                          \
    X(INTERNAL, "INTERNAL")

#define PERCUSS_END_REASON_LIST(X)                                                                 \
    X(NONE, "NONE")                                                                                \
    X(SEPARATED, "SEPARATED")                                                                      \
    X(HANDED_BACK, "HANDED_BACK")                                                                  \
    X(HORIZON, "HORIZON")                                                                          \
    X(IN_CONTACT, "IN_CONTACT")                                                                    \
    X(LIMIT, "LIMIT")

#define PERCUSS_CONTACT_MODEL_LIST(X)                                                              \
    X(AUTO, "auto")                                                                                \
    X(HERTZ, "hertz")                                                                              \
    X(CLOSED_FORM, "closed-form")                                                                  \
    X(TABLE, "table")                                                                              \
    X(CONCURRENT_FE, "concurrent-fe")                                                              \
    X(COMPLETE_FE, "complete-fe")                                                                  \
    X(VISCOELASTIC, "viscoelastic")                                                                \
    X(LAW, "law")

#define PERCUSS_METHOD_LIST(X)                                                                     \
    X(MODAL, "modal")                                                                              \
    X(CVODE, "cvode")

#define PERCUSS_COMPLIANCE_LIST(X)                                                                 \
    X(DEFAULT, "default")                                                                          \
    X(HALF_SPACE, "half-space")                                                                    \
    X(MATCHED, "matched")

#define PERCUSS_DENTS_LIST(X)                                                                      \
    X(KEEP, "keep")                                                                                \
    X(IGNORE, "ignore")

#define PERCUSS_DELASSUS_SOURCE_LIST(X)                                                            \
    X(SERVICE, "service")                                                                          \
    X(CLIENT, "client")

#define PERCUSS_FRICTION_LIST(X)                                                                   \
    X(MICRO_SLIP, "micro-slip")                                                                    \
    X(PLAIN, "plain")                                                                              \
    X(NONE, "none")

/* How a contact with friction moved along its tangent plane: without sliding, in part of the patch
 * or of the time, in one direction throughout, or back at last. */
#define PERCUSS_FRICTION_STATE_LIST(X)                                                             \
    X(NONE, "none")                                                                                \
    X(STUCK, "stuck")                                                                              \
    X(PARTLY, "partly")                                                                            \
    X(SLID, "slid")                                                                                \
    X(REVERSED, "reversed")

/* What a request may change of a body; units and ranges as in the catalogue. */
#define PERCUSS_PARAMETER_LIST(X)                                                                  \
    X(YOUNG, "young")                                                                              \
    X(POISSON, "poisson")                                                                          \
    X(DENSITY, "density")                                                                          \
    X(YIELD, "yield")                                                                              \
    X(TANGENT, "tangent")                                                                          \
    X(DAMPING, "damping")                                                                          \
    X(RADIUS, "radius")                                                                            \
    X(SCALE, "scale")

#define PERCUSS_STATUS_MEMBER(name, text)         PERCUSS_##name,
#define PERCUSS_END_MEMBER(name, text)            PERCUSS_END_##name,
#define PERCUSS_CONTACT_MEMBER(name, text)        PERCUSS_CONTACT_##name,
#define PERCUSS_METHOD_MEMBER(name, text)         PERCUSS_METHOD_##name,
#define PERCUSS_COMPLIANCE_MEMBER(name, text)     PERCUSS_COMPLIANCE_##name,
#define PERCUSS_DENTS_MEMBER(name, text)          PERCUSS_DENTS_##name,
#define PERCUSS_DELASSUS_MEMBER(name, text)       PERCUSS_DELASSUS_##name,
#define PERCUSS_FRICTION_MEMBER(name, text)       PERCUSS_FRICTION_##name,
#define PERCUSS_FRICTION_STATE_MEMBER(name, text) PERCUSS_FRICTION_STATE_##name,
#define PERCUSS_PARAMETER_MEMBER(name, text)      PERCUSS_PARAMETER_##name,

enum percuss_status { PERCUSS_STATUS_LIST(PERCUSS_STATUS_MEMBER) PERCUSS_STATUS_COUNT };
enum percuss_end_reason { PERCUSS_END_REASON_LIST(PERCUSS_END_MEMBER) PERCUSS_END_COUNT };
enum percuss_contact_model {
    PERCUSS_CONTACT_MODEL_LIST(PERCUSS_CONTACT_MEMBER) PERCUSS_CONTACT_COUNT
};
enum percuss_method { PERCUSS_METHOD_LIST(PERCUSS_METHOD_MEMBER) PERCUSS_METHOD_COUNT };
enum percuss_compliance {
    PERCUSS_COMPLIANCE_LIST(PERCUSS_COMPLIANCE_MEMBER) PERCUSS_COMPLIANCE_COUNT
};
enum percuss_dents { PERCUSS_DENTS_LIST(PERCUSS_DENTS_MEMBER) PERCUSS_DENTS_COUNT };
enum percuss_delassus_source {
    PERCUSS_DELASSUS_SOURCE_LIST(PERCUSS_DELASSUS_MEMBER) PERCUSS_DELASSUS_COUNT
};
enum percuss_friction { PERCUSS_FRICTION_LIST(PERCUSS_FRICTION_MEMBER) PERCUSS_FRICTION_COUNT };
enum percuss_friction_state {
    PERCUSS_FRICTION_STATE_LIST(PERCUSS_FRICTION_STATE_MEMBER) PERCUSS_FRICTION_STATE_COUNT
};
enum percuss_parameter { PERCUSS_PARAMETER_LIST(PERCUSS_PARAMETER_MEMBER) PERCUSS_PARAMETER_COUNT };

/* Sizes on the wire, terminating zero included. */
enum {
    PERCUSS_ID_SIZE = 64,
    PERCUSS_MAX_BODIES = 64,
    PERCUSS_MAX_CONTACTS = 64,
    PERCUSS_MAX_CONTACTS_OBLIQUE = 21, /* with a matrix of their normals and tangents */
    PERCUSS_MAX_DELASSUS = 4096,       /* numbers of a matrix */
    PERCUSS_MAX_SUB_IMPACTS = 256,
    PERCUSS_MAX_SITES = 32,
    PERCUSS_MAX_BATCH = 256
};

#endif
