/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The restitution as a distribution: the reply to an ensemble. SI units; undefined numbers are NAN.
 * Arrays belong to the reply until percuss_ensemble_reply_free. */
#ifndef PERCUSS_ENSEMBLE_REPLY_H
#define PERCUSS_ENSEMBLE_REPLY_H

#include <percuss/reply.h>

struct percuss_statistic {
    char quantity[32]; /* restitution, impulse, end_time, peak_force */
    uint64_t count;
    double mean, mean_low, mean_high; /* with 95 % intervals */
    double standard_deviation, standard_deviation_low, standard_deviation_high;
    double skewness, lowest, highest;
    size_t quantile_count;
    double *probabilities, *quantiles, *quantiles_low, *quantiles_high;
    size_t bin_count;  /* 0: all samples are equal, but for rounding; their deviation is 0 then, and
                          the skewness undefined */
    double *bin_edges; /* bin_count + 1 */
    uint64_t *bin_counts;
    size_t curve_count; /* the distribution function */
    double *curve_values, *curve_shares;
};

/* The restitution along one part of the range of an input. */
struct percuss_input_part {
    double low, high;
    uint64_t count;
    double mean, standard_deviation;
    double local; /* deviation that is left when the input is known to `resolution` */
    bool chaotic; /* that is more than half of the deviation of all samples */
};

struct percuss_sensitivity {
    char input[PERCUSS_ID_SIZE], body[PERCUSS_ID_SIZE];
    double first_order; /* share of the variance that the input explains by itself */
    double first_order_low, first_order_high; /* 95 % */
    double noise; /* one without influence shows less in 95 % of all cases */
    double total; /* share that is left when all others are known, first_order at least */
    double total_low, total_high;                     /* 95 % */
    double mean, standard_deviation, lowest, highest; /* of the input */
    double resolution;
    char quantity[32]; /* whose variance it is */
    size_t part_count;
    struct percuss_input_part *parts;
};

struct percuss_sigma_interval {
    double sigmas, low, high;
    double covered;                     /* share of the samples inside */
    double unphysical;                  /* share of its length where no restitution can be */
    double quantile_low, quantile_high; /* enclose as much as a normal distribution would have */
};

struct percuss_beta_fit {
    double low, high, alpha, beta; /* alpha NAN: none fits */
    double distance, p_value;      /* Kolmogorov-Smirnov; small: refused */
};

/* Some samples solved again by the full accuracy search: ensemble - search. */
struct percuss_ensemble_check {
    uint64_t count;
    double within, largest, mean_shift, mean_shift_half_width, standard_deviation_shift,
        quantile_shift;
    double within_low, within_high; /* 95 %: the share of all samples that agree */
    uint64_t unmet; /* searches that do not reach the tolerance, by their own estimate */
};

struct percuss_ensemble_reply {
    uint8_t client[16];
    uint64_t sequence;
    uint8_t server[16];
    char catalogue_revision[64], version[32];
    enum percuss_status status;
    char message[1024];
    bool complete; /* false: cancelled, or a deadline cut it short */
    uint64_t samples, requested, refused, truncated;
    size_t statistic_count;
    struct percuss_statistic *statistics;
    size_t count_length; /* [k]: samples with k sub-impacts */
    uint64_t *sub_impact_counts, *significant_counts;
    double possible_low, possible_high; /* of the restitution */
    size_t interval_count;
    struct percuss_sigma_interval *intervals;
    struct percuss_beta_fit beta;
    size_t sensitivity_count;
    struct percuss_sensitivity *sensitivities;
    size_t tangential_sensitivity_count; /* of each tangential impulse that varies */
    struct percuss_sensitivity *tangential_sensitivities;
    struct percuss_ensemble_check check;
    double cut, step_accuracy; /* the model of all samples: modes up to this frequency, Hz */
    uint32_t pilots, agreeing;
    size_t warning_count;
    char **warnings;
    struct percuss_timing timing;
    size_t column_count; /* of the listed samples: inputs, restitution, impulse, end_time,
                            peak_force, sub_impacts, significant, status; with friction also
                            impulse_tangential_1 and _2, tangential_restitution,
                            restitution_kinematic */
    double *rows; /* samples x column_count, row-major; NULL: not listed, or not all arrived */
    void *storage;
};

#endif
