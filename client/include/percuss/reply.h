/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A reply: impulses, restitution, sub-impacts, and how they were computed. SI units; undefined
 * numbers are NAN. Arrays belong to the reply until percuss_reply_free. */
#ifndef PERCUSS_REPLY_H
#define PERCUSS_REPLY_H

#include <percuss/request.h>

/* An interval in which the bodies are pressed together. */
struct percuss_sub_impact {
    double start, compression_end, end; /* s from the stated instant */
    double impulse;                     /* N s */
    double compression_impulse;         /* up to the largest indentation */
    double peak_force;                  /* N */
    double max_indentation;             /* m */
    double gap_rate_before, gap_rate_after;
    bool negligible;                      /* below 1 % of the contact's impulse */
    double impulse_tangential[2];         /* N s, on body a along the contact's tangents */
    double slip_before[2], slip_after[2]; /* m/s, of a's point against b's along both */
    enum percuss_friction_state friction_state;
};

struct percuss_contact_result {
    double impulse;                /* of all sub-impacts, N s */
    double impulse_vector[3];      /* on body a, world */
    double impulse_compression;    /* that stops the rigid approach, N s */
    double restitution;            /* impulse / impulse_compression - 1 */
    double inverse_effective_mass; /* 1/kg */
    double end_time;               /* end of the last sub-impact, s */
    uint32_t sub_impact_count;     /* exact */
    uint32_t sub_impacts_listed;   /* at most PERCUSS_MAX_SUB_IMPACTS; 16 in a batch */
    struct percuss_sub_impact *sub_impacts;
    double impulse_error; /* N s; by time, modes and models together; 0 from servers before it */
    /* friction; 0 or NAN from servers before it */
    double friction;   /* coefficient that was used; 0: none */
    double tangent[3]; /* world, unit, the second one is normal x tangent; zero without friction */
    double impulse_tangential[2];         /* N s, on body a along both; part of impulse_vector */
    double impulse_tangential_error;      /* N s; by time, modes and models together */
    double slip_before[2], slip_after[2]; /* m/s, of a's point against b's, vibration not included;
                                             zero without friction */
    double tangential_restitution; /* -slip_after.slip_before / slip_before^2; NAN without either */
    double restitution_kinematic;  /* -gap rate after / before; NAN where there are more contacts */
    double restitution_energetic; /* Stronge's: root of the normal force's work in release over that
                                     in compression; NAN likewise */
    enum percuss_friction_state friction_state;
};

struct percuss_body_velocity {
    char id[PERCUSS_ID_SIZE];
    double velocity[3], angular_velocity[3]; /* world */
    double velocity_error;                   /* m/s; by time, modes and models together */
    double angular_velocity_error;           /* rad/s */
};

struct percuss_body_state {
    char id[PERCUSS_ID_SIZE], state[PERCUSS_ID_SIZE]; /* token for a later request */
};

struct percuss_body_energy {
    char id[PERCUSS_ID_SIZE];
    double energy; /* J */
};

struct percuss_energy { /* J */
    double available, rigid_after;
    size_t vibration_count;
    struct percuss_body_energy *vibration;
    double damping, plastic, stored; /* damping: with the waves that leave through
                                        half-spaces and what materials lose in a contact */
    double closure;                  /* available less all the others: a check of the solution */
    double friction;                 /* lost by sliding in the contacts */
};

struct percuss_error_estimate {
    double restitution_time, restitution_modes; /* by the time steps; by the modes left out */
    double impulse_time, impulse_modes;         /* N s */
    double restitution_by_speed;                /* s/m; NAN unless asked for (conditioning) */
    bool tolerance_met;                         /* by time and modes */
    double restitution_model;                   /* by the models of contact and bodies */
    double restitution_total;                   /* all three */
    bool total_met;                             /* the tolerance, by that */
    double restitution_yield;              /* of that: the part of metals without a stated yield */
    double impulse_tangential_by_speed[2]; /* kg; NAN unless asked for, or without friction */
};

struct percuss_body_model {
    char id[PERCUSS_ID_SIZE];
    uint32_t modes;
    bool rigid;
    char theory[32];
    double shear_factor; /* NAN where there is none */
};

struct percuss_model {
    size_t body_count;
    struct percuss_body_model *bodies;
    enum percuss_contact_model contact_model;
    enum percuss_compliance compliance;
    enum percuss_method method;
    char reason[512];     /* why this model */
    double omitted_error; /* estimated effect of the omission on the restitution */
};

struct percuss_timing {
    double queue, solve; /* s */
};

struct percuss_reply {
    uint8_t client[16];
    uint64_t sequence;
    uint8_t server[16];
    char catalogue_revision[64], version[32];
    enum percuss_status status; /* a newer server may send a number that has no name here */
    char message[1024];         /* empty for OK */
    bool complete;
    enum percuss_end_reason end_reason;
    double window; /* s; from then on vibration cannot cause a contact */
    size_t contact_count;
    struct percuss_contact_result *contacts;
    enum percuss_delassus_source delassus_source;
    size_t velocity_after_count; /* 0 unless the server's own inverse mass matrix was used */
    struct percuss_body_velocity *velocity_after;
    size_t states_after_count;
    struct percuss_body_state *states_after;
    struct percuss_energy energy;
    struct percuss_error_estimate error;
    struct percuss_model model;
    double time_shift; /* of the touch, s (a ringing body) */
    size_t warning_count;
    char **warnings;
    struct percuss_timing timing;
    void *storage; /* the library's: holds the arrays */
};

#endif
