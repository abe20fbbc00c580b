/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The library's one entrance: (catalogue, request) -> result. No files, no clock, no globals; same
 * input, same bits. Units SI; conventions as in docs/architecture.md. */
#ifndef PERCUSS_SOLVE_SOLVE_H
#define PERCUSS_SOLVE_SOLVE_H

#include "base/watch.h"
#include "solve/request.h"
#include "solve/result.h"

/* Memory of one worker: prepared bodies (frequencies, step tables) and everything a solve writes.
 */
struct solve_workspace;
struct solve_workspace *solve_workspace_create(void); /* NULL: out of memory */
void solve_workspace_free(struct solve_workspace *workspace);

/* Where the workspace finds tabulated contact laws; borrowed, NULL: nowhere. */
struct contact_table_source;
void solve_workspace_set_tables(struct solve_workspace *workspace,
                                const struct contact_table_source *tables);

/* Who is asked about once a millisecond of a solve whether to go on; otherwise it ends with
 * TIMEOUT. An answer does not depend on it. */
void solve_workspace_watch(struct solve_workspace *workspace, struct watch watch);

/* Answers one request. Always fills `result`; returns result->status. Refusals (BAD_REQUEST, ...)
 * are ordinary results with a message. The catalogue must outlive the call; prepared bodies are
 * cached by catalogue revision. */
enum percuss_status solve(struct solve_workspace *workspace, const struct body_set *catalogue,
                          const struct solve_request *request, struct solve_result *result);

#endif
