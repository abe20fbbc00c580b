/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The answers of a query: one, or several to different speeds and contact models. */
#ifndef PERCUSS_CLI_QUERY_OUTPUT_H
#define PERCUSS_CLI_QUERY_OUTPUT_H

#include <jansson.h>

#include "plot_impact.h"
#include "scene.h"

/* Answers to print, one after the other. */
struct query_output {
    bool json, csv, units;
    bool several;                   /* each is told from the others by speed and contact model */
    unsigned count;                 /* printed so far */
    json_t *answers;                /* of several as JSON, until the end */
    const struct scene_text *scene; /* the question in words; NULL: a whole request */
};

/* Prints the answer to this speed (m/s); `spread` is how it spreads, NULL: not asked for. */
void query_output_add(struct query_output *output, const struct impact_run *run, double speed,
                      const struct percuss_ensemble_reply *spread);

/* Prints what is left. */
void query_output_end(struct query_output *output);

#endif
