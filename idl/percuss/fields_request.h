/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The members of requests and of what an ensemble asks for, see fields.h. */
#ifndef PERCUSS_FIELDS_REQUEST_H
#define PERCUSS_FIELDS_REQUEST_H

/* Ranges end where no impact makes sense any more, or sums of squares would lose their digits. */
#define PERCUSS_BODY_FIELDS(F, L)                                                                  \
    F(ID, id, "its name in the server's catalogue")                                                \
    F(VECTOR, position, 1e6, "m; of the centre of mass, world")                                    \
    F(UNIT, orientation, 4, "quaternion (w, x, y, z), world = R(q) body")                          \
    F(VECTOR, velocity, 1e6, "m/s; of the centre of mass, world")                                  \
    F(VECTOR, angular_velocity, 1e6, "rad/s; world")                                               \
    F(TEXT, state, "token of an earlier reply; empty: at rest, without dents")                     \
    F(NUMBER, elapsed, 0.0, 1e9, "s; since that state, which is that at `window` of its reply")    \
    F(TEXT, specimen, "durable object on a rig; empty: none")                                      \
    L(OVERRIDES, overrides, override_count, "in this request instead of the catalogue's")

#define PERCUSS_CONTACT_PLACE_FIELDS(F, ...)                                                       \
    F(INDEX, a, "into bodies")                                                                     \
    F(INDEX, b, "into bodies")                                                                     \
    F(VECTOR, point, 1e6, "m; world")                                                              \
    F(UNIT, normal, 3, "world, from b to a")                                                       \
    F(NUMBER, gap, -1e3, 1e3, "m; negative: the bodies overlap already")                           \
    F(NUMBER, gap_acceleration, -1e9, 1e9, "m/s^2; n.(a_A - a_B), negative presses")

/* Since version 0.3: apart, for the digest of a question without them is that of earlier versions.
 */
#define PERCUSS_CONTACT_FRICTION_FIELDS(F, ...)                                                    \
    F(NUMBER, friction, 0.0, 10.0,                                                                 \
      "coefficient of friction; 0: the catalogue's for the two materials, none if it states none") \
    F(VECTOR, tangent, 1e6,                                                                        \
      "world; first tangential direction, made normal to `normal`; zero: a fixed rule")

#define PERCUSS_CONTACT_FIELDS(F, ...)                                                             \
    PERCUSS_CONTACT_PLACE_FIELDS(F)                                                                \
    PERCUSS_CONTACT_FRICTION_FIELDS(F)

/* Of double precision nothing finer than the least tolerance is left. */
#define PERCUSS_OPTION_FIRST_FIELDS(F, ...)                                                        \
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

#define PERCUSS_OPTION_FRICTION_FIELDS(F, ...)                                                     \
    F(CHOICE, friction, friction, PERCUSS_FRICTION_COUNT,                                          \
      "law of the tangential forces where a coefficient is stated; plain: without the contact's "  \
      "own compliance")

#define PERCUSS_OPTION_FIELDS(F, ...)                                                              \
    PERCUSS_OPTION_FIRST_FIELDS(F)                                                                 \
    PERCUSS_OPTION_FRICTION_FIELDS(F)

#define PERCUSS_INPUT_FIELDS(F, L)                                                                 \
    F(TEXT, name,                                                                                  \
      "speed, direction, model-force, model-compliance, model-yield, model-friction, friction; "   \
      "site, young, poisson, density, radius, yield, damping, scale")                              \
    F(TEXT, body, "its id; empty: the contact's")                                                  \
    F(CHOICE, distribution, distribution, PERCUSS_DISTRIBUTION_COUNT, "of the values")             \
    F(VALUE, first, "the value, the lowest one or the mean")                                       \
    F(VALUE, second, "the highest one or the standard deviation")                                  \
    F(VALUE, lower, "truncation; undefined: none")                                                 \
    F(VALUE, upper, "truncation; undefined: none")                                                 \
    L(NUMBERS, values, value_count, "of a list")

#define PERCUSS_CORRELATION_FIELDS(F, ...)                                                         \
    F(COUNT, first, "into inputs")                                                                 \
    F(COUNT, second, "into inputs")                                                                \
    F(VALUE, coefficient, "of a Gaussian copula")

/* All that an ensemble asks for beside its impact. */
#define PERCUSS_ENSEMBLE_FIELDS(F, L)                                                              \
    L(LIST, inputs, input_count, input, "what is uncertain")                                       \
    L(LIST, correlations, correlation_count, correlation, "of inputs")                             \
    F(CHOICE, sampling, sampling, PERCUSS_SAMPLING_COUNT, "how inputs are drawn")                  \
    F(LONG_COUNT, samples, "at most; 0: the values of the lists side by side, each once")          \
    F(LONG_COUNT, seed, "of the random numbers")                                                   \
    F(VALUE, half_width, "stop when the mean's 95 % interval is within; 0: never")                 \
    F(VALUE, quantile_half_width, "and those of all quantiles; 0: whatever they are")              \
    L(NUMBERS, quantiles, quantile_count, "probabilities; none: a default set")                    \
    F(COUNT, bins, "of the histogram; 0: a default number")                                        \
    F(COUNT, contact, "index of the one that is looked at")                                        \
    F(FLAG, list_samples, "also hand over every sample")

#endif
