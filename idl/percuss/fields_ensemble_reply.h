/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The members of what an ensemble answers, see fields.h. */
#ifndef PERCUSS_FIELDS_ENSEMBLE_REPLY_H
#define PERCUSS_FIELDS_ENSEMBLE_REPLY_H

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
    F(TEXT, quantity, "whose variance it is")                                                      \
    L(LIST, parts, part_count, input_part, "the quantity along the input")

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
    L(LIST, tangential_sensitivities, tangential_sensitivity_count, sensitivity,                   \
      "of each tangential impulse that varies, with friction")                                     \
    L(OPTIONAL, check, ensemble_check, "of the one model for all samples")                         \
    F(VALUE, cut, "Hz; modes up to this frequency")                                                \
    F(VALUE, step_accuracy, "of the time steps")                                                   \
    F(COUNT, pilots, "samples the model was chosen by")                                            \
    F(COUNT, agreeing, "of these, within the tolerance")                                           \
    L(TEXTS, warnings, warning_count, "where the models end")                                      \
    L(OBJECT, timing, timing, "where the server's time went")

#endif
