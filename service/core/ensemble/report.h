/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Report of an ensemble, from its samples in order. */
#ifndef PERCUSS_ENSEMBLE_REPORT_H
#define PERCUSS_ENSEMBLE_REPORT_H

#include "base/arena.h"
#include "ensemble/extras.h"
#include "ensemble/indices.h"
#include "ensemble/interval.h"
#include "ensemble/summary.h"

enum {
    REPORT_QUANTITIES = 8,
    REPORT_WITHOUT_FRICTION = 4, /* the first ones */
    REPORT_INTERVALS = 4,
    REPORT_PARTS = 32,
    REPORT_CURVE = 512, /* intervals of the distribution function, at most */
    REPORT_WARNINGS = 32,
    REPORT_WARNING_SIZE = 1152
};

/* Quantities of the impacts; from TANGENTIAL on of contacts with friction only. Tangential impulses
 * are on body a, along the contact's tangents. */
enum report_of {
    REPORT_RESTITUTION,
    REPORT_IMPULSE,
    REPORT_END_TIME,
    REPORT_PEAK_FORCE,
    REPORT_TANGENTIAL,
    REPORT_TANGENTIAL_SECOND,
    REPORT_TANGENTIAL_RESTITUTION,
    REPORT_KINEMATIC
};

/* One quantity of the impacts. */
struct report_quantity {
    const char *name; /* restitution, impulse, end_time, peak_force, ... */
    struct moments moments;
    struct interval mean, deviation; /* 95 % */
    size_t quantile_count;
    const double *probabilities;
    double *quantiles, *quantiles_low, *quantiles_high;
    size_t bins; /* 0: the values do not vary */
    double *edges;
    uint64_t *counts;
    size_t curve_count; /* the distribution function: all values where they are few, else quantiles
                           at equal steps */
    double *curve_values, *curve_shares;
};

/* Influence of one uncertain input on the restitution, or on a tangential impulse. */
struct report_input {
    const char *quantity;   /* name of the quantity */
    size_t input;           /* index into the spec's */
    struct indices indices; /* the total one NAN: not found, or it is correlated */
    struct moments values;
    double resolution; /* of the parts: a hundredth of the input's range */
    size_t part_count;
    struct influence_part *parts; /* along the input */
};

/* Samples solved again by the full accuracy search. */
struct report_verification {
    size_t count;
    double within;                            /* share that agrees within the tolerance */
    struct interval within_bounds;            /* 95 %: of all samples */
    double largest;                           /* difference */
    double mean_shift, mean_shift_half_width; /* ensemble - search; 95 % */
    double deviation_shift;
    double quantile_shift; /* largest, of the quantiles asked for */
    size_t unmet;          /* searches that do not reach the tolerance, by their own estimate */
};

struct ensemble_report {
    struct arena memory; /* of all arrays */
    uint64_t done;       /* samples solved */
    uint64_t refused, truncated;
    size_t quantity_count;
    struct report_quantity quantities[REPORT_QUANTITIES];
    size_t count_length; /* [k]: samples with k sub-impacts; k < count_length */
    uint64_t *sub_impact_counts, *significant_counts;
    struct shape_range range; /* of the restitution */
    struct sigma_interval intervals[REPORT_INTERVALS];
    struct beta_fit beta;
    size_t input_count; /* uncertain ones */
    struct report_input *inputs;
    size_t tangential_count; /* the same of each tangential impulse that varies */
    struct report_input *tangential;
    struct report_verification verification;
    size_t warning_count;
    char warnings[REPORT_WARNINGS][REPORT_WARNING_SIZE];
};

/* Samples 0 .. done - 1 and the extras that belong to them. Borrowed. */
struct report_material {
    uint64_t done;
    const struct ensemble_sample *samples;
    const struct ensemble_extra *extras; /* NULL: none were solved */
};

void report_release(struct ensemble_report *report);

/* Mean of the restitution so far, for progress and for stopping. */
struct report_progress {
    double mean, deviation;
    double half_width;          /* of the mean's 95 % interval */
    double quantile_half_width; /* largest of the quantiles asked for; where they are wanted */
    bool enough;                /* the bounds that were asked for are met */
};
struct report_progress report_progress(const struct ensemble *ensemble,
                                       const struct ensemble_sample *samples, uint64_t done,
                                       bool quantiles);

/* The report on the material. Samples that its warnings quote are solved again; where `watch`
 * (NULL: none) stops that, these words are left out. False: out of memory. Release it all the same.
 */
bool report_create(struct ensemble_report *report, const struct ensemble *ensemble,
                   const struct report_material *material, const struct watch *watch);

#endif
