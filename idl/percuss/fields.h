/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The members of the structs of the wire, a list for each struct. The checks of a request, its
 * digest, the copies between the structs of the solver, of the wire and of the C API, JSON in both
 * directions and its schema follow from these lists. A new member of a request stands in
 * percuss_wire.idl, in the public header and here; the compiler finds what is missing.
 *
 * Members come in the order of JSON. F(KIND, name, ...) is called for those that are plain values:
 *   NUMBER, name, lowest, highest, what     a double in that range
 *   DEFAULTED, name, lowest, highest, what  the same, or 0 for the default
 *   VALUE, name, what                       a double that is NAN, or null, where it is undefined
 *   VECTOR, name, limit, what               double[3], each at most `limit` in magnitude
 *   UNIT, name, size, what                  double[size] of norm 1
 *   ID, name, what                          char[PERCUSS_ID_SIZE], not empty
 *   TEXT, name, what                        char[]
 *   OCTETS, name, what                      uint8_t[16]
 *   INDEX, name, what                       uint32_t, into the bodies
 *   COUNT, name, what                       uint32_t or, of the solver, something wider
 *   LONG_COUNT, name, what                  uint64_t
 *   CHOICE, name, choice, count, what       a number of vocabulary.h, of an `enum percuss_<choice>`
 *   FLAG, name, what                        bool
 * and L(KIND, name, ...), often PERCUSS_NONE, for those that have members of their own:
 *   OBJECT, name, element, what             a struct percuss_<element>
 *   LIST, name, count, element, what        `count` of them, a sequence on the wire
 *   TEXTS, name, count, what                `count` texts
 *   OVERRIDES, name, count, what            parameters and their values
 * where `what` begins with the unit. In a request that leaves out a member it is zero, or the
 * quaternion of no rotation. */
#ifndef PERCUSS_FIELDS_H
#define PERCUSS_FIELDS_H

/* Ranges end where no impact makes sense any more, or sums of squares would lose their digits. */
#define PERCUSS_BODY_FIELDS(F, L)                                                                  \
    F(ID, id, "its name in the server's catalogue")                                                \
    F(VECTOR, position, 1e6, "m; of the centre of mass, world")                                    \
    F(UNIT, orientation, 4, "quaternion (w, x, y, z), world = R(q) body")                          \
    F(VECTOR, velocity, 1e6, "m/s; of the centre of mass, world")                                  \
    F(VECTOR, angular_velocity, 1e6, "rad/s; world")                                               \
    F(TEXT, state, "token of an earlier reply; empty: at rest, without dents")                     \
    F(NUMBER, elapsed, 0.0, 1e9, "s; since that state")                                            \
    F(TEXT, specimen, "durable object on a rig; empty: none")                                      \
    L(OVERRIDES, overrides, override_count, "in this request instead of the catalogue's")

#define PERCUSS_CONTACT_FIELDS(F, ...)                                                             \
    F(INDEX, a, "into bodies")                                                                     \
    F(INDEX, b, "into bodies")                                                                     \
    F(VECTOR, point, 1e6, "m; world")                                                              \
    F(UNIT, normal, 3, "world, from b to a")                                                       \
    F(NUMBER, gap, -1e6, 1e6, "m; negative: the bodies overlap already")                           \
    F(NUMBER, gap_acceleration, -1e9, 1e9, "m/s^2; n.(a_A - a_B), negative presses")

/* Of double precision nothing finer than the least tolerance is left. */
#define PERCUSS_OPTION_FIELDS(F, ...)                                                              \
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

#define PERCUSS_SUB_IMPACT_FIELDS(F, ...)                                                          \
    F(VALUE, start, "s; from the stated instant")                                                  \
    F(VALUE, compression_end, "s")                                                                 \
    F(VALUE, end, "s")                                                                             \
    F(VALUE, impulse, "N s")                                                                       \
    F(VALUE, compression_impulse, "N s; up to the largest indentation")                            \
    F(VALUE, peak_force, "N")                                                                      \
    F(VALUE, max_indentation, "m")                                                                 \
    F(VALUE, gap_rate_before, "m/s")                                                               \
    F(VALUE, gap_rate_after, "m/s")                                                                \
    F(FLAG, negligible, "below 1 % of the contact's impulse")

#define PERCUSS_CONTACT_RESULT_FIELDS(F, L)                                                        \
    F(VALUE, impulse, "N s; of all sub-impacts")                                                   \
    F(VECTOR, impulse_vector, INFINITY, "N s; on body a, world")                                   \
    F(VALUE, impulse_compression, "N s; that stops the rigid approach")                            \
    F(VALUE, restitution, "impulse / impulse_compression - 1; undefined where that is 0")          \
    F(VALUE, inverse_effective_mass, "1/kg")                                                       \
    F(VALUE, end_time, "s; end of the last sub-impact")                                            \
    F(COUNT, sub_impact_count, "exact, however many are listed")                                   \
    L(LIST, sub_impacts, sub_impacts_listed, sub_impact, "at most 256; 16 in a batch")

#define PERCUSS_BODY_VELOCITY_FIELDS(F, ...)                                                       \
    F(ID, id, "of the body")                                                                       \
    F(VECTOR, velocity, INFINITY, "m/s; of the centre of mass, world")                             \
    F(VECTOR, angular_velocity, INFINITY, "rad/s; world")

#define PERCUSS_BODY_STATE_FIELDS(F, ...)                                                          \
    F(ID, id, "of the body")                                                                       \
    F(TEXT, state, "token for a later request")

#define PERCUSS_BODY_ENERGY_FIELDS(F, ...)                                                         \
    F(ID, id, "of the body")                                                                       \
    F(VALUE, energy, "J")

#define PERCUSS_ENERGY_FIELDS(F, L)                                                                \
    F(VALUE, available, "J")                                                                       \
    F(VALUE, rigid_after, "J")                                                                     \
    L(LIST, vibration, vibration_count, body_energy, "of each body")                               \
    F(VALUE, damping, "J; with the waves that leave through half-spaces")                          \
    F(VALUE, plastic, "J")                                                                         \
    F(VALUE, stored, "J")                                                                          \
    F(VALUE, closure, "J; available less all the others: a check of the solution")

#define PERCUSS_ERROR_FIELDS(F, ...)                                                               \
    F(VALUE, restitution_time, "of the restitution, by the time steps")                            \
    F(VALUE, restitution_modes, "of the restitution, by the modes left out")                       \
    F(VALUE, impulse_time, "N s")                                                                  \
    F(VALUE, impulse_modes, "N s")                                                                 \
    F(VALUE, restitution_by_speed, "s/m; d(restitution)/d(speed), with `conditioning`")            \
    F(FLAG, tolerance_met, "by these estimates")

#define PERCUSS_BODY_MODEL_FIELDS(F, ...)                                                          \
    F(ID, id, "of the body")                                                                       \
    F(COUNT, modes, "kept in the scene")                                                           \
    F(FLAG, rigid, "whether it does not vibrate")                                                  \
    F(TEXT, theory, "rigid, rod, rayleigh-love, timoshenko, euler-bernoulli")                      \
    F(VALUE, shear_factor, "undefined where there is none")

#define PERCUSS_MODEL_FIELDS(F, L)                                                                 \
    L(LIST, bodies, body_count, body_model, "how each was modelled")                               \
    F(CHOICE, contact_model, contact_model, PERCUSS_CONTACT_COUNT, "local model of the contacts")  \
    F(CHOICE, compliance, compliance, PERCUSS_COMPLIANCE_COUNT,                                    \
      "local compliance of the contacts")                                                          \
    F(CHOICE, method, method, PERCUSS_METHOD_COUNT, "integrator of the fast time scale")           \
    F(TEXT, reason, "why this model")                                                              \
    F(VALUE, omitted_error, "estimated effect on the restitution of what was left out")

#define PERCUSS_TIMING_FIELDS(F, ...)                                                              \
    F(VALUE, queue, "s")                                                                           \
    F(VALUE, solve, "s")

/* What all replies begin with. */
#define PERCUSS_HEAD_FIELDS(F, ...)                                                                \
    F(OCTETS, client, "who asked")                                                                 \
    F(LONG_COUNT, sequence, "of the request")                                                      \
    F(OCTETS, server, "who answered")                                                              \
    F(TEXT, catalogue_revision, "hash of the catalogue")                                           \
    F(TEXT, version, "of the server")                                                              \
    F(CHOICE, status, status, PERCUSS_STATUS_COUNT, "the server's judgement")                      \
    F(TEXT, message, "names the field, its value and what is allowed; empty for OK")

/* What follows the head. */
#define PERCUSS_REPLY_FIELDS(F, L)                                                                 \
    F(FLAG, complete, "false: the restitution is not the final one")                               \
    F(CHOICE, end_reason, end_reason, PERCUSS_END_COUNT, "why the fast time scale ended")          \
    F(VALUE, window, "s; from then on vibration cannot cause a contact")                           \
    L(LIST, contacts, contact_count, contact_result, "in the order of the request")                \
    F(CHOICE, delassus_source, delassus_source, PERCUSS_DELASSUS_COUNT, "whose matrix was used")   \
    L(LIST, velocity_after, velocity_after_count, body_velocity, "with the service's own matrix")  \
    L(LIST, states_after, states_after_count, body_state, "of each body")                          \
    L(OBJECT, energy, energy, "balance")                                                           \
    L(OBJECT, error, error_estimate, "estimates")                                                  \
    L(OBJECT, model, model, "of the impact")                                                       \
    F(VALUE, time_shift, "s; of the touch of a ringing body, from the stated instant")             \
    L(TEXTS, warnings, warning_count, "where the models end")                                      \
    L(OBJECT, timing, timing, "where the server's time went")

/* For members that nothing is done with. */
#define PERCUSS_NONE(kind, ...)

/* Copies a member from *from to *to, two pointers that are there where the list is expanded. */
#define PERCUSS_COPY(kind, name, ...) PERCUSS_COPY_##kind(name)

#define PERCUSS_COPY_NUMBER(name)     to->name = from->name;
#define PERCUSS_COPY_DEFAULTED(name)  to->name = from->name;
#define PERCUSS_COPY_VALUE(name)      to->name = from->name;
#define PERCUSS_COPY_INDEX(name)      to->name = from->name;
#define PERCUSS_COPY_COUNT(name)      to->name = (uint32_t)from->name;
#define PERCUSS_COPY_LONG_COUNT(name) to->name = from->name;
#define PERCUSS_COPY_CHOICE(name)     to->name = from->name;
#define PERCUSS_COPY_FLAG(name)       to->name = from->name;
#define PERCUSS_COPY_VECTOR(name)     PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_UNIT(name)       PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_ID(name)         PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_TEXT(name)       PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_OCTETS(name)     PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_ARRAY(name)                                                                   \
    _Static_assert(sizeof to->name == sizeof from->name, #name " is as long on both sides");       \
    memcpy(to->name, from->name, sizeof to->name);

/* The same value in all of *to's members that may be undefined, see VALUE. */
#define PERCUSS_UNDEFINED(kind, name, ...) PERCUSS_UNDEFINED_##kind(name)
#define PERCUSS_UNDEFINED_VALUE(name)      to->name = NAN;
#define PERCUSS_UNDEFINED_COUNT(name)
#define PERCUSS_UNDEFINED_LONG_COUNT(name)
#define PERCUSS_UNDEFINED_CHOICE(name)
#define PERCUSS_UNDEFINED_FLAG(name)
#define PERCUSS_UNDEFINED_TEXT(name)

#endif
