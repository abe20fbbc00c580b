/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The answer of a solve, and its warnings by kinds that can be counted over many solves. */
#ifndef PERCUSS_SOLVE_RESULT_H
#define PERCUSS_SOLVE_RESULT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/fault.h"
#include "base/text.h"
#include "contact/body_state.h"
#include "impact/result.h"

struct trace; /* impact/trace.h */

/* Of two in a row the first is of body a, the second of body b. */
enum warning_kind {
    WARNING_YIELD,
    WARNING_PATCH = 2,
    WARNING_DENT = 4,
    WARNING_EDGE = 6,
    WARNING_SPEED = 8,
    WARNING_TABLE_END = 10,
    WARNING_SLIDING,
    WARNING_DELASSUS,
    WARNING_COMPLIANCE,
    WARNING_NO_TOUCH,
    WARNING_LAW,
    WARNING_LOSS,
    WARNING_WAVES = 18,
    WARNING_BENDING,
    WARNING_UNSTATED = 21,
    WARNING_RIGID,
    WARNING_BREADTH = 24,
    WARNING_TURN = 26,
    WARNING_JAM,
    WARNING_ALONG,
    WARNING_BETWEEN = 30,
    WARNING_KINDS
};
_Static_assert(WARNING_KINDS <= 32, "a set of kinds is 32 bits");

enum { WARNINGS_ROOM = 34, WARNING_SIZE = 1024 };

struct warnings {
    size_t count;
    uint32_t kinds; /* 1 << kind of each that was found, in the list or not */
    enum warning_kind kind[WARNINGS_ROOM];
    char text[WARNINGS_ROOM][WARNING_SIZE];
};

/* Adds one while there is room; of a kind found before (in another contact) only as long as every
 * other kind keeps its place. */
void warnings_add(struct warnings *warnings, enum warning_kind kind, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same of one that is put together by pieces, in *text; false: there is no room. */
bool warnings_begin(struct warnings *warnings, enum warning_kind kind, struct text *text);

/* The first text of a kind, or NULL. */
const char *warnings_text(const struct warnings *warnings, enum warning_kind kind);

struct solve_contact_result {
    double impulse;
    double impulse_vector[3]; /* on body a; normal and tangential part */
    double impulse_compression;
    double restitution; /* NAN where impulse_compression is 0 */
    double inverse_effective_mass;
    double end_time;
    size_t sub_impact_count;              /* exact */
    size_t sub_impacts_listed;            /* at most PERCUSS_MAX_SUB_IMPACTS */
    const struct sub_impact *sub_impacts; /* in the workspace, until its next solve */
    double impulse_error;                 /* N s, all known errors together */
    double impulse_error_model;           /* the models' part of it */
    double friction;                      /* coefficient that was used; 0: none */
    double tangent[3]; /* the first, world; the second: normal x tangent; zero without friction */
    double impulse_tangential[2];          /* on body a */
    double impulse_tangential_error;       /* N s, all known errors together */
    double impulse_tangential_error_model; /* the models' part */
    double slip_before[2], slip_after[2];  /* of the rigid bodies, m/s; zero without friction */
    double tangential_restitution; /* -after.before / before^2; NAN without slip or friction */
    double restitution_kinematic;  /* -gap rate after / before; NAN for groups */
    double restitution_energetic;  /* Stronge's; NAN for groups */
    enum percuss_friction_state friction_state;
};

struct solve_body_result {
    char id[PERCUSS_ID_SIZE];
    double velocity[3]; /* after; only with the service's own W */
    double angular_velocity[3];
    double velocity_error, angular_velocity_error; /* m/s, rad/s, all known errors together */
    double vibration;                              /* J */
    unsigned modes;                                /* kept in the scene */
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
    enum percuss_delassus_source delassus_source;
    bool velocities_known; /* the service's own W was used */
    struct impact_energy energy;
    double restitution_time, restitution_modes, impulse_time, impulse_modes;
    double restitution_by_speed;           /* NAN unless asked for */
    double impulse_tangential_by_speed[2]; /* kg; NAN unless asked for, or without friction */
    bool tolerance_met;
    double restitution_model, restitution_total; /* of the models; of all known errors */
    bool total_met;
    double restitution_yield; /* part of the total from metals without a stated yield */
    double tolerance;         /* on the restitution, as asked for */
    enum percuss_contact_model contact_model;
    enum percuss_compliance compliance;
    enum percuss_method method;
    char reason[512];
    double omitted_error;
    double time_shift;
    const struct trace *trace; /* in the workspace, until its next solve; NULL: not asked for */
    size_t warning_count;
    /* long lists stand last, in this order: solve() clears the members before them */
    struct solve_contact_result contacts[PERCUSS_MAX_CONTACTS];
    struct solve_body_result bodies[PERCUSS_MAX_BODIES];
    char warnings[40][WARNING_SIZE]; /* more than validity.h finds */
};
_Static_assert(sizeof(struct solve_result) ==
                   offsetof(struct solve_result, contacts) +
                       sizeof(struct solve_contact_result[PERCUSS_MAX_CONTACTS]) +
                       sizeof(struct solve_body_result[PERCUSS_MAX_BODIES]) +
                       sizeof(char[40][WARNING_SIZE]),
               "no other member stands behind the first list");

#endif
