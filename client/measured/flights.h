/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The motion between contacts: even, or with one acceleration that all flights have in common. */
#ifndef PERCUSS_MEASURED_FLIGHTS_H
#define PERCUSS_MEASURED_FLIGHTS_H

#include "jumps.h"

/* A flight's line, y = at + rate (t - middle), and the standard deviations of its rate and
 * of `at`. */
struct line {
    double middle, at, rate;
    double deviation, at_deviation;
    size_t count; /* readings */
};

double line_at(const struct line *line, double t);

/* Acceleration of falling bodies, 0 where none stands out of noise and jumps. False: out of memory.
 */
bool flights_acceleration(struct search *search, double *acceleration);

/* The stated gravity instead of the fitted acceleration, if one stands out of noise. False with the
 * reason if that is another one: a scale or a rate is wrong, or the body does not fall freely. */
bool flights_state_gravity(struct search *search, double *acceleration,
                           struct measured_fault *fault);

/* A flight's velocity, levelled: the mean of its readings, or the slope of its displacements. */
struct line flights_line(const struct search *search, double *levelled, struct range flight);

/* The same of an integral of accelerations, whose errors last: no mean lessens them. From flight to
 * flight its velocity changes by what the contact between them adds; its offset is the mean of all
 * flights' accelerations, and the deviations add up by those of one reading's. */
void flights_follow_integral(struct search *search, const struct range *ranges, size_t count,
                             struct line *lines);

/* Root mean square of the velocities' departures from their flights' lines. */
double flights_misfit(const struct search *search, const struct range *ranges, size_t count);

#endif
