/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Contacts as jumps of a velocity that stand out of the noise of its readings. */
#ifndef PERCUSS_MEASURED_JUMPS_H
#define PERCUSS_MEASURED_JUMPS_H

#include "history.h"

/* A jump counts from so many standard deviations on, and from this share of the largest. */
#define JUMPS_SIGNIFICANT 6.0
#define JUMPS_LEAST_SHARE 2e-3

/* A search under way. */
struct search {
    const struct history *history;
    double acceleration;  /* of A in flight, m/s^2 */
    double deviation;     /* standard, of that */
    double *v;            /* [count]: A's velocity less that of the acceleration */
    size_t count, window; /* readings on each side that are compared */
    double *sum;          /* [count + 1]: running sums of v */
    double noise;
};

/* Readings that belong to a contact: [first, end). */
struct range {
    size_t first, end;
};

/* Of reading i, from the first on, s. */
double jumps_time(const struct search *search, size_t i);

/* The k-th of the flights before, between and behind `count` contacts. */
struct range jumps_flight(const struct search *search, const struct range *ranges, size_t count,
                          size_t k);

/* Of the levelled velocities of the readings [first, end). */
double jumps_mean(const struct search *search, size_t first, size_t end);

/* The largest difference of the means of `window` readings before and behind a reading. */
double jumps_largest(const struct search *search, size_t window);

/* Begins a search whose `v` and `sum` have room: A's velocity without the acceleration. */
void jumps_level(struct search *search, double acceleration);

/* Contacts of the levelled velocity; their number, 0 with the reason. */
size_t jumps_find(struct search *search, struct range *ranges, struct measured_fault *fault);

/* Start or end of a contact: the change of velocity begins with the 5/2 power of time (the force
 * with the 3/2), so two crossings tell where it is zero. */
double jumps_edge(const struct search *search, struct range range, double low, double high,
                  int way);

#endif
