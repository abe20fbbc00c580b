/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The processes of mpirun: the first one asks, the others solve. */
#ifndef PERCUSS_MPI_TEAM_H
#define PERCUSS_MPI_TEAM_H

#include "cli.h"

/* Of the first process: the others begin, or go home. Once. */
void team_begin(bool work);

/* Of the others: whether there is work. */
bool team_waits(void);

/* As percuss_solve_ensemble, with the samples solved by all processes, which *begun says have been
 * told. Does not return in any but the first: they end when it has what it wants. */
enum percuss_result team_solve(struct percuss_client *client,
                               const struct percuss_ensemble_request *request, double timeout,
                               percuss_progress_function *progress, void *context,
                               struct percuss_ensemble_reply *reply, bool *begun);

#endif
