/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/solve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "solve/error/total.h"
#include "solve/finite_element.h"
#include "solve/formulation.h"
#include "solve/report.h"

struct solve_workspace {
    struct prepared_cache *cache;
    struct arena arena;
    struct solve_account *account; /* NULL: it keeps all */
    size_t counted;                /* bytes of it there */
};

struct solve_workspace *solve_workspace_create(void)
{
    struct solve_workspace *workspace = calloc(1, sizeof *workspace);
    if (!workspace)
        return NULL;
    workspace->cache = prepared_cache_create();
    if (!workspace->cache) {
        free(workspace);
        return NULL;
    }
    return workspace;
}

void solve_workspace_free(struct solve_workspace *workspace)
{
    if (!workspace)
        return;
    if (workspace->account)
        atomic_fetch_sub(&workspace->account->bytes, workspace->counted);
    prepared_cache_free(workspace->cache);
    arena_release(&workspace->arena);
    free(workspace);
}

void solve_workspace_join(struct solve_workspace *workspace, struct solve_account *account)
{
    workspace->account = account;
}

static size_t workspace_bytes(const struct solve_workspace *workspace)
{
    return prepared_cache_bytes(workspace->cache) + workspace->arena.held;
}

/* What is likely to be of no use to others goes first: bodies of one request, then the memory of
 * one large solve, then the catalogue's bodies. */
static void keep_within_account(struct solve_workspace *workspace)
{
    struct solve_account *account = workspace->account;
    if (!account)
        return;
    if (workspace_bytes(workspace) > account->most_each)
        prepared_cache_drop(workspace->cache, true);
    if (workspace_bytes(workspace) > account->most_each)
        arena_release(&workspace->arena);
    if (workspace_bytes(workspace) > account->most_each)
        prepared_cache_drop(workspace->cache, false);
    const size_t bytes = workspace_bytes(workspace);
    atomic_fetch_add(&account->bytes, bytes - workspace->counted);
    workspace->counted = bytes;
}

void solve_workspace_settle(struct solve_workspace *workspace)
{
    arena_reset(&workspace->arena);
    keep_within_account(workspace);
}

/* Clears all but the lists, which are long; their counts tell which entries are filled. */
static void result_clear(struct solve_result *result)
{
    memset(result, 0, offsetof(struct solve_result, contacts));
    result->restitution_by_speed = NAN;
    result->impulse_tangential_by_speed[0] = result->impulse_tangential_by_speed[1] = NAN;
}

static enum percuss_status check_counts(const struct solve_request *request, struct fault *fault)
{
    if (request->body_count < 1 || request->body_count > PERCUSS_MAX_BODIES)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "bodies: %zu given: must be 1 to %d",
                         request->body_count, PERCUSS_MAX_BODIES);
    if (request->contact_count < 1 || request->contact_count > PERCUSS_MAX_CONTACTS)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "contacts: %zu given: must be 1 to %d",
                         request->contact_count, PERCUSS_MAX_CONTACTS);
    for (size_t c = 0; c < request->contact_count; c++) {
        const struct solve_contact *contact = &request->contacts[c];
        if (contact->a >= request->body_count || contact->b >= request->body_count ||
            contact->a == contact->b)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "contacts[%zu]: a %u, b %u: must be two different indices below %zu",
                             c, contact->a, contact->b, request->body_count);
    }
    return PERCUSS_OK;
}

/* Refuses a contact with a number outside its range. */
#define GUARD(kind, name, ...) GUARD_##kind(name, __VA_ARGS__)
#define GUARD_INDEX(name, ...)
#define GUARD_VECTOR(name, ...)
#define GUARD_UNIT(name, ...)
#define GUARD_NUMBER(name, low, high, ...)                                                         \
    if (!(contact->name >= (low) && contact->name <= (high)))                                      \
        return fault_set(fault, PERCUSS_BAD_REQUEST,                                               \
                         "contacts[%zu]." #name ": %g: must be in [%g, %g]", c, contact->name,     \
                         low, high);

/* The endpoint has checked the wire's numbers; this guards the library's own entrance: its callers
 * may set a horizon longer than the wire's. */
static enum percuss_status check_finite(const struct solve_request *request, struct fault *fault)
{
    for (size_t c = 0; c < request->contact_count; c++) {
        const struct solve_contact *contact = &request->contacts[c];
        PERCUSS_CONTACT_FIELDS(GUARD)
    }
    const struct solve_options *options = &request->options;
    if (!(options->horizon >= 0.0 && options->horizon <= 1e12))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.horizon: %g: must be 0 (the default) to 1e12 s",
                         options->horizon);
    if (!(options->tolerance >= 0.0 && options->tolerance <= 1.0))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.tolerance: %g: must be 0 (the default) to 1", options->tolerance);
    return PERCUSS_OK;
}

static enum percuss_status solve_answer(struct solve_workspace *workspace,
                                        const struct solve_context *context,
                                        const struct solve_request *request,
                                        struct solve_result *result)
{
    /* memory of the request */
    struct problem *problem = problem_create(request, workspace->cache, &workspace->arena);
    struct solution *solution = arena_reserve(&workspace->arena, 1, sizeof *solution);
    if (!problem || !solution)
        return fault_set(&result->fault, PERCUSS_INTERNAL, "out of memory");
    /* the request as a problem */
    struct pace pace = {.watch = &context->watch};
    enum percuss_status status = formulate(problem, context, &result->fault);
    /* complete finite elements answer by themselves */
    enum contact_method method = contact_law_asked(request->options.contact_model)->method;
    if (!status && method == CONTACT_COMPLETE)
        return complete_answer(problem, &pace, result);
    /* the solution, and by finite elements in the contact once more */
    bool concurrent = method == CONTACT_CONCURRENT;
    double tolerance = problem->tolerance;
    if (concurrent)
        tolerance *= CONCURRENT_MODES_SHARE;
    if (!status)
        status = solution_find(solution, problem, tolerance, NULL, &workspace->arena, &pace,
                               &result->fault);
    struct concurrent_effort effort;
    if (!status && concurrent)
        status = concurrent_refine(solution, problem, &pace, &effort, &result->fault);
    /* its other errors, the answer, and its histories */
    if (!status)
        status = pace_fault(&result->fault, total_find(problem, solution, !concurrent, &pace));
    if (!status) {
        report_fill(problem, solution, result);
        if (concurrent)
            concurrent_report(&effort, problem, solution, result);
        status = result->status;
    }
    if (request->options.trace && (status == PERCUSS_OK || status == PERCUSS_TRUNCATED))
        status = report_trace(problem, solution, &pace, result);
    return status;
}

enum percuss_status solve(struct solve_workspace *workspace, const struct solve_context *context,
                          const struct solve_request *request, struct solve_result *result)
{
    result_clear(result);
    solve_workspace_settle(workspace);
    prepared_cache_use(workspace->cache, context->catalogue->revision);
    result->status = check_counts(request, &result->fault);
    if (!result->status)
        result->status = check_finite(request, &result->fault);
    if (!result->status)
        result->status = solve_answer(workspace, context, request, result);
    /* an answer that lacked memory is none, whatever its status */
    if (workspace->arena.lacks)
        result->status = fault_set(&result->fault, PERCUSS_INTERNAL, "out of memory");
    return result->status;
}
