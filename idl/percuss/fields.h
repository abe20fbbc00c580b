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
 *   OPTIONAL, name, element, what           an object; on the wire a sequence of one, or of none
 *   TEXTS, name, count, what                `count` texts
 *   NUMBERS, name, count, what              `count` doubles
 *   COUNTS, name, count, what               `count` of uint64_t
 *   EDGES, name, count, what                one double more than `count`, none for none
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
    F(NUMBER, gap, -1e3, 1e3, "m; negative: the bodies overlap already")                           \
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

#define PERCUSS_INPUT_FIELDS(F, L)                                                                 \
    F(TEXT, name, "speed, direction; site, young, poisson, density, radius, yield, damping")       \
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

#define PERCUSS_STATISTIC_FIELDS(F, L)                                                             \
    F(TEXT, quantity, "restitution, impulse, end_time, peak_force")                                \
    F(LONG_COUNT, count, "samples that have it")                                                   \
    F(VALUE, mean, "")                                                                             \
    F(VALUE, mean_low, "95 % interval")                                                            \
    F(VALUE, mean_high, "95 % interval")                                                           \
    F(VALUE, standard_deviation, "")                                                               \
    F(VALUE, standard_deviation_low, "95 % interval")                                              \
    F(VALUE, standard_deviation_high, "95 % interval")                                             \
    F(VALUE, skewness, "")                                                                         \
    F(VALUE, lowest, "")                                                                           \
    F(VALUE, highest, "")                                                                          \
    L(NUMBERS, probabilities, quantile_count, "of the quantiles")                                  \
    L(NUMBERS, quantiles, quantile_count, "")                                                      \
    L(NUMBERS, quantiles_low, quantile_count, "95 % interval")                                     \
    L(NUMBERS, quantiles_high, quantile_count, "95 % interval")                                    \
    L(EDGES, bin_edges, bin_count, "of the histogram; none: nothing varies")                       \
    L(COUNTS, bin_counts, bin_count, "of the histogram")                                           \
    L(NUMBERS, curve_values, curve_count, "of the distribution function")                          \
    L(NUMBERS, curve_shares, curve_count, "of the samples that are no larger")

#define PERCUSS_INPUT_PART_FIELDS(F, ...)                                                          \
    F(VALUE, low, "of the input")                                                                  \
    F(VALUE, high, "of the input")                                                                 \
    F(LONG_COUNT, count, "of samples")                                                             \
    F(VALUE, mean, "of the restitution")                                                           \
    F(VALUE, standard_deviation, "of the restitution")                                             \
    F(VALUE, local, "deviation that is left when the input is known to `resolution`")              \
    F(FLAG, chaotic, "that is more than half of the deviation of all samples")

#define PERCUSS_SENSITIVITY_FIELDS(F, L)                                                           \
    F(TEXT, input, "its name")                                                                     \
    F(TEXT, body, "whose it is; empty: the contact's")                                             \
    F(VALUE, first_order, "share of the variance that the input explains by itself")               \
    F(VALUE, first_order_low, "95 % interval")                                                     \
    F(VALUE, first_order_high, "95 % interval")                                                    \
    F(VALUE, noise, "one without influence shows less in 95 % of all cases")                       \
    F(VALUE, total, "share that is left when all others are known")                                \
    F(VALUE, total_low, "95 % interval")                                                           \
    F(VALUE, total_high, "95 % interval")                                                          \
    F(VALUE, mean, "of the input")                                                                 \
    F(VALUE, standard_deviation, "of the input")                                                   \
    F(VALUE, lowest, "of the input")                                                               \
    F(VALUE, highest, "of the input")                                                              \
    F(VALUE, resolution, "a hundredth of the input's range")                                       \
    L(LIST, parts, part_count, input_part, "the restitution along the input")

#define PERCUSS_SIGMA_INTERVAL_FIELDS(F, ...)                                                      \
    F(VALUE, sigmas, "standard deviations from the mean")                                          \
    F(VALUE, low, "")                                                                              \
    F(VALUE, high, "")                                                                             \
    F(VALUE, covered, "share of the samples inside")                                               \
    F(VALUE, unphysical, "share of its length where no restitution can be")                        \
    F(VALUE, quantile_low, "encloses as much as a normal distribution would have")                 \
    F(VALUE, quantile_high, "encloses as much as a normal distribution would have")

#define PERCUSS_BETA_FIT_FIELDS(F, ...)                                                            \
    F(VALUE, low, "range of the distribution")                                                     \
    F(VALUE, high, "range of the distribution")                                                    \
    F(VALUE, alpha, "undefined: none fits")                                                        \
    F(VALUE, beta, "undefined: none fits")                                                         \
    F(VALUE, distance, "Kolmogorov-Smirnov")                                                       \
    F(VALUE, p_value, "small: refused")

#define PERCUSS_ENSEMBLE_CHECK_FIELDS(F, ...)                                                      \
    F(LONG_COUNT, count, "of samples that were solved again by the full accuracy search")          \
    F(VALUE, within, "share that agrees within the tolerance")                                     \
    F(VALUE, largest, "difference")                                                                \
    F(VALUE, mean_shift, "ensemble - search")                                                      \
    F(VALUE, mean_shift_half_width, "95 % interval")                                               \
    F(VALUE, standard_deviation_shift, "ensemble - search")                                        \
    F(VALUE, quantile_shift, "largest of the quantiles")                                           \
    F(VALUE, within_low, "95 % interval: of all samples")                                          \
    F(VALUE, within_high, "95 % interval: of all samples")                                         \
    F(LONG_COUNT, unmet, "searches that do not reach the tolerance, by their own estimate")

/* What follows the head. */
#define PERCUSS_ENSEMBLE_REPLY_FIELDS(F, L)                                                        \
    F(FLAG, complete, "false: cancelled, or a deadline cut it short")                              \
    F(LONG_COUNT, samples, "solved")                                                               \
    F(LONG_COUNT, requested, "samples at most")                                                    \
    F(LONG_COUNT, refused, "left out")                                                             \
    F(LONG_COUNT, truncated, "ended early")                                                        \
    L(LIST, statistics, statistic_count, statistic, "of each quantity")                            \
    L(COUNTS, sub_impact_counts, count_length, "[k]: samples with k sub-impacts")                  \
    L(COUNTS, significant_counts, count_length, "without negligible ones")                         \
    F(VALUE, possible_low, "range that the restitution can have")                                  \
    F(VALUE, possible_high, "range that the restitution can have")                                 \
    L(LIST, intervals, interval_count, sigma_interval, "of the restitution")                       \
    L(OPTIONAL, beta, beta_fit, "a Beta distribution of the restitution")                          \
    L(LIST, sensitivities, sensitivity_count, sensitivity, "to each uncertain input")              \
    L(OPTIONAL, check, ensemble_check, "of the one model for all samples")                         \
    F(VALUE, cut, "Hz; modes up to this frequency")                                                \
    F(VALUE, step_accuracy, "of the time steps")                                                   \
    F(COUNT, pilots, "samples the model was chosen by")                                            \
    F(COUNT, agreeing, "of these, within the tolerance")                                           \
    L(TEXTS, warnings, warning_count, "where the models end")                                      \
    L(OBJECT, timing, timing, "where the server's time went")

#define PERCUSS_SERVER_FIELDS(F, ...)                                                              \
    F(OCTETS, server, "its id")                                                                    \
    F(TEXT, version, "of the program")                                                             \
    F(TEXT, catalogue_revision, "hash of the catalogue")                                           \
    F(TEXT, catalogue, "file")                                                                     \
    F(TEXT, host, "its name")                                                                      \
    F(COUNT, process, "its number")                                                                \
    F(TEXT, state, "ready, draining")                                                              \
    F(COUNT, workers, "threads that solve")                                                        \
    F(COUNT, bodies, "of the catalogue")                                                           \
    F(COUNT, queue_length, "requests that wait")                                                   \
    F(COUNT, queue_capacity, "requests that may wait")                                             \
    F(LONG_COUNT, answered, "requests")                                                            \
    F(LONG_COUNT, refused, "requests")                                                             \
    F(COUNT, specimens, "that it keeps")                                                           \
    F(VALUE, uptime, "s")                                                                          \
    F(TEXT, activity, "what a long computation is doing")                                          \
    F(VALUE, progress, "0..1; undefined: nothing is running")

#define PERCUSS_DENT_FIELDS(F, ...)                                                                \
    F(VECTOR, point, INFINITY, "m; body frame")                                                    \
    F(VALUE, size, "m; radius of the patch")                                                       \
    F(VALUE, max_indentation, "m")                                                                 \
    F(VALUE, max_force, "N")                                                                       \
    F(VALUE, residual_indentation, "m; depth that stays")                                          \
    F(VALUE, contact_radius, "m; at the largest force")

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
