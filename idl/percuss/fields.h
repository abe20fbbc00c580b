/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The members of the wire's structs that are plain values, a list for each struct. The checks of a
 * request, its digest, the copies between the structs of the solver, of the wire and of the C API,
 * JSON in both directions and its schema follow from these lists. A new member of a request stands
 * in percuss_wire.idl, in the public header and here; the compiler finds what is missing.
 *
 * F(KIND, name, ...) is called for each member in the order of JSON, with
 *   NUMBER, name, lowest, highest, what     a double in that range
 *   DEFAULTED, name, lowest, highest, what  the same, or 0 for the default
 *   VECTOR, name, limit, what               double[3], each at most `limit` in magnitude
 *   UNIT, name, size, what                  double[size] of norm 1
 *   ID, name, what                          char[PERCUSS_ID_SIZE], not empty
 *   TEXT, name, what                        char[]
 *   INDEX, name, what                       uint32_t, into the bodies
 *   CHOICE, name, choice, count, what       a number of vocabulary.h, of an `enum percuss_<choice>`
 *   FLAG, name, what                        bool
 * where `what` begins with the unit. In a request that leaves out a member it is zero, or the
 * quaternion of no rotation. */
#ifndef PERCUSS_FIELDS_H
#define PERCUSS_FIELDS_H

/* Ranges end where no impact makes sense any more, or sums of squares would lose their digits. */
#define PERCUSS_BODY_FIELDS(F)                                                                     \
    F(ID, id, "its name in the server's catalogue")                                                \
    F(VECTOR, position, 1e6, "m; of the centre of mass, world")                                    \
    F(UNIT, orientation, 4, "quaternion (w, x, y, z), world = R(q) body")                          \
    F(VECTOR, velocity, 1e6, "m/s; of the centre of mass, world")                                  \
    F(VECTOR, angular_velocity, 1e6, "rad/s; world")                                               \
    F(TEXT, state, "token of an earlier reply; empty: at rest, without dents")                     \
    F(NUMBER, elapsed, 0.0, 1e9, "s; since that state")                                            \
    F(TEXT, specimen, "durable object on a rig; empty: none")

#define PERCUSS_CONTACT_FIELDS(F)                                                                  \
    F(INDEX, a, "into bodies")                                                                     \
    F(INDEX, b, "into bodies")                                                                     \
    F(VECTOR, point, 1e6, "m; world")                                                              \
    F(UNIT, normal, 3, "world, from b to a")                                                       \
    F(NUMBER, gap, -1e6, 1e6, "m; negative: the bodies overlap already")                           \
    F(NUMBER, gap_acceleration, -1e9, 1e9, "m/s^2; n.(a_A - a_B), negative presses")

/* Of double precision nothing finer than the least tolerance is left. */
#define PERCUSS_OPTION_FIELDS(F)                                                                   \
    F(DEFAULTED, tolerance, 1e-12, 1.0, "on the restitution; 0: 1e-3")                             \
    F(DEFAULTED, horizon, 1e-9, 10.0, "s; 0: the longer of 20 ms and two longest periods")         \
    F(CHOICE, contact_model, contact_model, PERCUSS_CONTACT_COUNT, "local model of the contacts")  \
    F(CHOICE, method, method, PERCUSS_METHOD_COUNT, "integrator of the fast time scale")           \
    F(CHOICE, compliance, compliance, PERCUSS_COMPLIANCE_COUNT,                                    \
      "local compliance of the contacts")                                                          \
    F(CHOICE, dents, dents, PERCUSS_DENTS_COUNT, "of earlier impacts")                             \
    F(FLAG, conditioning, "also report d(restitution)/d(speed)")                                   \
    F(FLAG, trace, "also write the time histories")                                                \
    F(NUMBER, deadline, 0.0, 1e9, "s; from the arrival until the server gives up; 0: none")

/* Copies a member from *from to *to, two pointers that are there where the list is expanded. */
#define PERCUSS_COPY(kind, name, ...) PERCUSS_COPY_##kind(name)

#define PERCUSS_COPY_NUMBER(name)    to->name = from->name;
#define PERCUSS_COPY_DEFAULTED(name) to->name = from->name;
#define PERCUSS_COPY_INDEX(name)     to->name = from->name;
#define PERCUSS_COPY_CHOICE(name)    to->name = from->name;
#define PERCUSS_COPY_FLAG(name)      to->name = from->name;
#define PERCUSS_COPY_VECTOR(name)    PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_UNIT(name)      PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_ID(name)        PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_TEXT(name)      PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_ARRAY(name)                                                                   \
    _Static_assert(sizeof to->name == sizeof from->name, #name " is as long on both sides");       \
    memcpy(to->name, from->name, sizeof to->name);

#endif
