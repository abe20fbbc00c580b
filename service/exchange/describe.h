/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bodies of the catalogue as they are announced. */
#ifndef PERCUSS_EXCHANGE_DESCRIBE_H
#define PERCUSS_EXCHANGE_DESCRIBE_H

#include "model/body.h"
#include "percuss_wire.h"

/* Room for what a sample points to. */
struct describer {
    percuss_v1_BodySite sites[BODY_MOST_SITES];
    percuss_v1_MaterialLosses losses;
    percuss_v1_RelaxationTerm terms[RELAXATION_TERMS];
    percuss_v1_MaterialPair *pairs, *of_body; /* [pair_count], of the catalogue and of one body */
    percuss_v1_ContactLaw *laws;
    size_t pair_count;
};

/* Looks at the pairs of materials that a catalogue states, for describe_end. False: out of memory,
 * and there is nothing to end. */
bool describe_begin(struct describer *describer, const struct body_set *set);
void describe_end(struct describer *describer);

/* Fills everything but the server; the sample points into the describer until the next one. */
void describe_body(struct describer *describer, const struct body *body, percuss_v1_Body *wire);

#endif
