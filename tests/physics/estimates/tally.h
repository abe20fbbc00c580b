/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Answers against what they converge to, counted by class, number of sub-impacts and tolerance. */
#ifndef PERCUSS_TEST_ESTIMATES_TALLY_H
#define PERCUSS_TEST_ESTIMATES_TALLY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* One answer to one scene. */
struct verdict {
    uint64_t scene;
    double tolerance;
    double reported;   /* error.restitution_time + restitution_modes */
    double true_error; /* NAN: the answer has no restitution */
    double spread;     /* of the reference, see truth.h; INFINITY: none was found */
    double reported_impulse, true_impulse_error, impulse_spread; /* N s, of any contact */
    bool met;
    bool impulses, velocities; /* each contact's and each body's own error covers it */
    double tangential_share;   /* largest error of a tangential impulse over what is stated */
    size_t sub_impacts, true_sub_impacts;
    size_t modes;   /* of all bodies */
    double seconds; /* processor time */
};

enum { TALLY_NAMED = 12 };

/* One line of the table. */
struct tally {
    size_t judged, met, covered, impulse_covered, wrong, miscounted;
    size_t impulses, velocities; /* covered of every contact, of every body */
    size_t tangential;           /* covered tangential impulses of every contact */
    size_t unsettled;            /* the reference did not converge to a tenth of the tolerance */
    size_t unsettled_met;        /* and the answer claims to be within its tolerance */
    size_t unsolved;             /* no restitution in the answer */
    uint64_t wrong_scenes[TALLY_NAMED];
    double worst_share; /* largest true error over the reported one */
    uint64_t worst_scene;
    double *over; /* reported over true, of each judged */
    size_t room;
    double seconds, slowest;
};

/* A reference is good enough for a tolerance if its spread is below this share of it. */
static const double TALLY_SETTLED = 0.1;

/* Whether it is met and wrong. */
bool tally_add(struct tally *tally, const struct verdict *verdict);

/* Median of reported over true error; 0: nothing judged. */
double tally_median_over(const struct tally *tally);

void tally_head(FILE *file, bool csv);
void tally_print(FILE *file, const struct tally *tally, const char *name, double tolerance,
                 bool csv);
void tally_free(struct tally *tally);

#endif
