/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Results of the fast scale, contact by contact. */
#ifndef PERCUSS_IMPACT_RESULT_H
#define PERCUSS_IMPACT_RESULT_H

#include <stdbool.h>

#include "percuss/vocabulary.h"

/* Share of a contact's impulse below which a sub-impact counts as negligible. */
static const double IMPACT_NEGLIGIBLE = 0.01;

/* A maximal interval with local indentation > 0. */
struct sub_impact {
    double start; /* s from the stated instant */
    double compression_end;
    double end;
    double impulse;
    double compression_impulse; /* up to the largest indentation */
    double peak_force;
    double max_indentation;
    double gap_rate_before; /* rigid gap rate, m/s */
    double gap_rate_after;
    bool negligible;                      /* below 1 % of the contact's impulse */
    double impulse_tangential[2];         /* N s, on body a along the contact's tangents */
    double slip_before[2], slip_after[2]; /* of the rigid bodies, m/s; zero without friction */
    enum percuss_friction_state friction_state;
};

/* J; every term computed by itself, so that the closure checks the solution. */
struct impact_energy {
    double available;
    double rigid_after;
    double vibration; /* all bodies */
    double damping;   /* with the radiation into half-spaces, see solve/radiation.h */
    double plastic;
    double friction; /* lost by sliding in the contacts */
    double stored;
    double closure; /* available - all the others */
};

#endif
