/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The members of replies, see fields.h. */
#ifndef PERCUSS_FIELDS_REPLY_H
#define PERCUSS_FIELDS_REPLY_H

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
    F(FLAG, negligible, "below 1 % of the contact's impulse")                                      \
    F(PAIR, impulse_tangential, "N s; on body a, along the contact's two tangents")                \
    F(PAIR, slip_before, "m/s; of a's point against b's, vibration not included")                  \
    F(PAIR, slip_after, "m/s")                                                                     \
    F(CHOICE, friction_state, friction_state, PERCUSS_FRICTION_STATE_COUNT, "how it slid")

#define PERCUSS_CONTACT_RESULT_FIELDS(F, L)                                                        \
    F(VALUE, impulse, "N s; of all sub-impacts")                                                   \
    F(VECTOR, impulse_vector, INFINITY, "N s; on body a, world")                                   \
    F(VALUE, impulse_compression, "N s; that stops the rigid approach")                            \
    F(VALUE, restitution, "impulse / impulse_compression - 1; undefined where that is 0")          \
    F(VALUE, inverse_effective_mass, "1/kg")                                                       \
    F(VALUE, end_time, "s; end of the last sub-impact")                                            \
    F(COUNT, sub_impact_count, "exact, however many are listed")                                   \
    L(LIST, sub_impacts, sub_impacts_listed, sub_impact, "at most 256; 16 in a batch")             \
    F(VALUE, impulse_error, "N s; of the impulse: time, modes and models together")                \
    F(VALUE, friction, "coefficient that was used; 0: none")                                       \
    F(VECTOR, tangent, INFINITY,                                                                   \
      "world; first tangent, the second is normal x tangent; zero without friction")               \
    F(PAIR, impulse_tangential, "N s; on body a, along the two tangents")                          \
    F(VALUE, impulse_tangential_error, "N s; of its size: time, modes and models together")        \
    F(PAIR, slip_before,                                                                           \
      "m/s; of a's point against b's, vibration not included; zero without friction")              \
    F(PAIR, slip_after, "m/s; the same after the impact")                                          \
    F(VALUE, tangential_restitution,                                                               \
      "minus the slip after over the slip before, along it; undefined without slip or friction")   \
    F(VALUE, restitution_kinematic, "minus the gap rate after over that before; one contact only") \
    F(VALUE, restitution_energetic,                                                                \
      "root of the normal force's work in release over that in compression; one contact only")     \
    F(CHOICE, friction_state, friction_state, PERCUSS_FRICTION_STATE_COUNT, "how it slid")

#define PERCUSS_BODY_VELOCITY_FIELDS(F, ...)                                                       \
    F(ID, id, "of the body")                                                                       \
    F(VECTOR, velocity, INFINITY, "m/s; of the centre of mass, world")                             \
    F(VECTOR, angular_velocity, INFINITY, "rad/s; world")                                          \
    F(VALUE, velocity_error, "m/s; of the velocity: time, modes and models together")              \
    F(VALUE, angular_velocity_error, "rad/s; the same of the angular velocity")

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
    F(VALUE, damping, "J; with what leaves in waves and what materials lose")                      \
    F(VALUE, plastic, "J")                                                                         \
    F(VALUE, friction, "J; lost by sliding in the contacts")                                       \
    F(VALUE, stored, "J")                                                                          \
    F(VALUE, closure, "J; available less all the others: a check of the solution")

#define PERCUSS_ERROR_FIELDS(F, ...)                                                               \
    F(VALUE, restitution_time, "of the restitution, by the time steps")                            \
    F(VALUE, restitution_modes, "of the restitution, by the modes left out")                       \
    F(VALUE, impulse_time, "N s")                                                                  \
    F(VALUE, impulse_modes, "N s")                                                                 \
    F(VALUE, restitution_by_speed, "s/m; d(restitution)/d(speed), with `conditioning`")            \
    F(FLAG, tolerance_met, "by these estimates of the solution")                                   \
    F(VALUE, restitution_model, "of the restitution, by the models of contact and bodies")         \
    F(VALUE, restitution_total, "of the restitution: time, modes and models together")             \
    F(FLAG, total_met, "the tolerance, by that total")                                             \
    F(VALUE, restitution_yield,                                                                    \
      "of `restitution_total`, what metals whose yield is not stated add: without it they are "    \
      "elastic")                                                                                   \
    F(PAIR, impulse_tangential_by_speed,                                                           \
      "kg; d(impulse_tangential)/d(speed) of the contact with the largest impulse, with "          \
      "`conditioning` and friction")

#define PERCUSS_BODY_MODEL_FIELDS(F, ...)                                                          \
    F(ID, id, "of the body")                                                                       \
    F(COUNT, modes, "kept in the scene")                                                           \
    F(FLAG, rigid, "whether it does not vibrate")                                                  \
    F(TEXT, theory, "rigid, rod, rayleigh-love, timoshenko, euler-bernoulli, ritz, mesh")          \
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
    F(VALUE, window,                                                                               \
      "s; from then on vibration cannot cause a contact; `states_after` are those of that "        \
      "instant")                                                                                   \
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

#endif
