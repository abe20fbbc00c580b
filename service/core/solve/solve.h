/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The library's one entrance: (context, request) -> result. No files, no clock, no globals; same
 * input, same bits. Units SI; conventions as in solve/request.h. */
#ifndef PERCUSS_SOLVE_SOLVE_H
#define PERCUSS_SOLVE_SOLVE_H

#include <stdatomic.h>

#include "solve/request.h"
#include "solve/result.h"

/* Memory of one worker: prepared bodies (frequencies, step tables) and everything a solve writes.
 */
struct solve_workspace;
struct solve_workspace *solve_workspace_create(void); /* NULL: out of memory */
void solve_workspace_free(struct solve_workspace *workspace);

/* What workspaces keep from one solve to the next. */
struct solve_account {
    size_t most_each;    /* bytes; a solve needs its own on top */
    atomic_size_t bytes; /* of all, each as it was when it settled */
};

/* From now on the workspace keeps to the account, which must outlive it. */
void solve_workspace_join(struct solve_workspace *workspace, struct solve_account *account);

/* After a solve: keeps no more than its account allows. What the last result points to is lost. */
void solve_workspace_settle(struct solve_workspace *workspace);

/* Answers one request. Always fills `result`; returns result->status. Refusals (BAD_REQUEST, ...)
 * are ordinary results with a message. Prepared bodies are cached by the catalogue's revision. An
 * answer does not depend on the watch. */
enum percuss_status solve(struct solve_workspace *workspace, const struct solve_context *context,
                          const struct solve_request *request, struct solve_result *result);

#endif
