/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The library's one entrance: (catalogue, request) -> result. No files, no clock, no globals; same
 * input, same bits. Units SI; conventions as in docs/architecture.md. */
#ifndef PERCUSS_SOLVE_SOLVE_H
#define PERCUSS_SOLVE_SOLVE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/fault.h"
#include "base/watch.h"
#include "impact/result.h"
#include "model/body.h"
#include "solve/body_state.h"

struct trace; /* impact/trace.h */
struct solve_body {
    char id[PERCUSS_ID_SIZE];
    double position[3];
    double orientation[4]; /* (w, x, y, z) */
    double velocity[3];
    double angular_velocity[3];
    const struct body_state *state; /* NULL: at rest, without dents; borrowed */
    double elapsed;                 /* s since that state */
    size_t variation_count;
    struct body_variation variations[PERCUSS_PARAMETER_COUNT]; /* instead of the catalogue's */
};

struct solve_contact {
    unsigned a, b; /* indices into bodies */
    double point[3];
    double normal[3];
    double gap;
    double gap_acceleration;
};

struct solve_options {
    double tolerance; /* on e; 0: 1e-3 */
    double horizon;   /* s; 0: max(20 ms, two longest periods) */
    enum percuss_contact_model contact_model;
    enum percuss_method method;
    enum percuss_compliance compliance;
    enum percuss_dents dents;
    bool conditioning;
    bool trace; /* also the time histories */
};

struct solve_request {
    size_t body_count, contact_count;
    struct solve_body bodies[PERCUSS_MAX_BODIES];
    struct solve_contact contacts[PERCUSS_MAX_CONTACTS];
    const double *delassus; /* contact_count^2, row-major; NULL: the service's; borrowed */
    struct solve_options options;
};

struct solve_contact_result {
    double impulse;
    double impulse_vector[3]; /* on body a */
    double impulse_compression;
    double restitution; /* NAN where impulse_compression is 0 */
    double inverse_effective_mass;
    double end_time;
    size_t sub_impact_count;              /* exact */
    size_t sub_impacts_listed;            /* at most PERCUSS_MAX_SUB_IMPACTS */
    const struct sub_impact *sub_impacts; /* in the workspace, until its next solve */
};

struct solve_body_result {
    char id[PERCUSS_ID_SIZE];
    double velocity[3]; /* after; only with the service's own W */
    double angular_velocity[3];
    double vibration; /* J */
    unsigned modes;   /* kept in the scene */
    bool rigid;
    const char *theory; /* rigid, rod, rayleigh-love, timoshenko, euler-bernoulli */
    double shear_factor;
    const struct body_state *state_after; /* in the workspace, until its next solve; NULL: none */
};

struct solve_result {
    enum percuss_status status;
    struct fault fault; /* the message; empty for OK */
    bool complete;
    enum percuss_end_reason end_reason;
    double window; /* s; from then on vibration cannot cause a contact */
    size_t contact_count, body_count;
    struct solve_contact_result contacts[PERCUSS_MAX_CONTACTS];
    struct solve_body_result bodies[PERCUSS_MAX_BODIES];
    enum percuss_delassus_source delassus_source;
    bool velocities_known; /* the service's own W was used */
    struct impact_energy energy;
    double restitution_time, restitution_modes, impulse_time, impulse_modes;
    double restitution_by_speed; /* NAN unless asked for */
    bool tolerance_met;
    enum percuss_contact_model contact_model;
    enum percuss_compliance compliance;
    enum percuss_method method;
    char reason[512];
    double omitted_error;
    double time_shift;
    const struct trace *trace; /* in the workspace, until its next solve; NULL: not asked for */
    size_t warning_count;
    char warnings[40][256]; /* more than validity.h finds */
};

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
