/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A campaign over the scenes of one class: every scene is answered at three tolerances, and each
 * answer judged by what the scene converges to. */
#ifndef PERCUSS_TEST_ESTIMATES_CAMPAIGN_H
#define PERCUSS_TEST_ESTIMATES_CAMPAIGN_H

#include "physics/estimates/drawn.h"
#include "physics/estimates/tally.h"
#include "physics/estimates/truth.h"

enum { CAMPAIGN_TOLERANCES = 3, CAMPAIGN_STRATA = 4 };
extern const double campaign_tolerances[CAMPAIGN_TOLERANCES];

struct campaign_settings {
    enum scene_class class;
    uint64_t first, count;
    double effort;  /* of a scene's reference, see truth.h */
    uint64_t cvode; /* every so many scenes the reference is compared with CVODE's; 0: never */
    bool plain;     /* plain friction in place of micro-slip */
    bool csv;       /* tables as CSV */
    bool list;      /* each answer as a line of CSV */
    bool chatty;    /* each scene with everything */
};

struct campaign {
    struct campaign_settings settings;
    struct lab *lab;
    struct truth_room *room;
    struct tally all[CAMPAIGN_TOLERANCES];
    struct tally strata[CAMPAIGN_STRATA][CAMPAIGN_TOLERANCES]; /* by sub-impacts */
    size_t answered, refused;                                  /* scenes */
    size_t wrong;           /* scenes with an answer that is met and wrong */
    size_t broken;          /* answers that break an invariant; each is printed */
    size_t by_cvode;        /* scenes with friction that CVODE judges */
    size_t compared, apart; /* with CVODE, and more than TALLY_SETTLED tolerances apart */
    double farthest;
    uint64_t farthest_scene;
};

/* Runs it; tallies are freed by campaign_release. */
void campaign_run(struct campaign *campaign, const struct campaign_settings *settings);
void campaign_print(const struct campaign *campaign);
void campaign_release(struct campaign *campaign);

#endif
