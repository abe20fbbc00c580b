/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_CLI_ENSEMBLE_OUTPUT_H
#define PERCUSS_CLI_ENSEMBLE_OUTPUT_H

#include <jansson.h>
#include <percuss/percuss.h>

#include "cli.h"
#include "plot.h"

/* The reply for people. */
void ensemble_print_table(const struct percuss_ensemble_request *request,
                          const struct percuss_ensemble_reply *reply, bool whole);

/* The reply with the wire's names and nesting; the caller releases it. */
json_t *ensemble_to_json(const struct percuss_ensemble_reply *reply);

/* Its JSON Schema; the caller releases it. */
json_t *ensemble_schema(void);

/* Writes the listed samples, one a line. False: the file could not be written, or there are none;
 * complains. */
bool ensemble_write_csv(const char *file, const struct percuss_ensemble_request *request,
                        const struct percuss_ensemble_reply *reply, bool units);

/* Writes the page of the reply, with its first listed samples. Exit code; complains. */
int ensemble_write_page(const char *file, const char *title,
                        const struct percuss_ensemble_request *request,
                        const struct percuss_ensemble_reply *reply, const struct common *common);

/* Draws the reply, and the restitution over the speed from its listed samples. Exit code;
 * complains. */
int ensemble_plot(const struct plot_output *output, const char *scene,
                  const struct percuss_ensemble_request *request,
                  const struct percuss_ensemble_reply *reply);

#endif
