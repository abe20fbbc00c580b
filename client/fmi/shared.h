/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The variables that both FMUs have: source, bodies, and the last impact. */
#ifndef PERCUSS_FMI_SHARED_H
#define PERCUSS_FMI_SHARED_H

#include <stdint.h>

#include "variable.h"

/* The choice of the source that source.h opens. */
struct source_choice {
    char catalogue[VARIABLE_TEXT_SIZE];
    char library[VARIABLE_TEXT_SIZE];
    int32_t domain;
    bool service;
};

struct impact {
    double impulse, restitution, duration, error, total_error;
    double gap_rate_before, gap_rate_after;
    double inverse_effective_mass;
    double vector[3], friction_loss; /* N s, on A, world; J */
    double rebound;                  /* -gap rate after / before */
    int32_t sub_impacts;
};

struct shared {
    double time;
    struct source_choice source;
    char body_a[VARIABLE_TEXT_SIZE], body_b[VARIABLE_TEXT_SIZE];
    char site_a[VARIABLE_TEXT_SIZE], site_b[VARIABLE_TEXT_SIZE];
    double at, tolerance;
    struct impact last;
    int32_t impacts;
};

#define SHARED_PARAMETER(type, member, unit, start, text, meaning)                                 \
    VARIABLE_PARAMETER, VARIABLE_##type, unit, offsetof(struct shared, member), start, text, meaning
#define SHARED_RESULT(type, member, unit, meaning)                                                 \
    VARIABLE_DISCRETE, VARIABLE_##type, unit, offsetof(struct shared, member), 0.0, NULL, meaning

/* The first rows of every table. */
#define SHARED_VARIABLES(default_b)                                                                \
    {"time", VARIABLE_TIME, VARIABLE_FLOAT64, "s", offsetof(struct shared, time), 0.0,             \
     NULL,   "time"},                                                                              \
        {"body_a", SHARED_PARAMETER(STRING, body_a, NULL, 0.0, "steel-sphere",                     \
                                    "body A of the catalogue, the one that comes")},               \
        {"body_b", SHARED_PARAMETER(STRING, body_b, NULL, 0.0, default_b,                          \
                                    "body B of the catalogue, the one that is hit")},              \
        {"at", SHARED_PARAMETER(FLOAT64, at, NULL, 0.5, NULL,                                      \
                                "place of the impact along a beam, 0..1")},                        \
        {"site_a",                                                                                 \
         SHARED_PARAMETER(STRING, site_a, NULL, 0.0, "",                                           \
                          "place of the impact on body A: a site's name; empty: the default")},    \
        {"site_b", SHARED_PARAMETER(STRING, site_b, NULL, 0.0, "", "the same on body B")},         \
        {"tolerance", SHARED_PARAMETER(FLOAT64, tolerance, NULL, 1e-3, NULL,                       \
                                       "wanted accuracy of the restitution")},                     \
        {"catalogue", SHARED_PARAMETER(STRING, source.catalogue, NULL, 0.0, "",                    \
                                       "file of the bodies; empty: the one inside the FMU")},      \
        {"service",                                                                                \
         SHARED_PARAMETER(BOOLEAN, source.service, NULL, 0.0, NULL,                                \
                          "whether a percussd is asked, instead of solving in this process")},     \
        {"domain", SHARED_PARAMETER(INT32, source.domain, NULL, 0.0, NULL,                         \
                                    "DDS domain of that percussd, 0..230")},                       \
        {"library",                                                                                \
         SHARED_PARAMETER(STRING, source.library, NULL, 0.0, "libpercuss.so." PERCUSS_SOVERSION,   \
                          "the client library that asks it")},                                     \
        {"impulse", SHARED_RESULT(FLOAT64, last.impulse, "N.s",                                    \
                                  "of the last impact, along the normal: on A, against it on B")}, \
        {"restitution", SHARED_RESULT(FLOAT64, last.restitution, NULL,                             \
                                      "of the last impact; 0 before the first one")},              \
        {"duration", SHARED_RESULT(FLOAT64, last.duration, "s", "until the last contact ended")},  \
        {"sub_impacts",                                                                            \
         SHARED_RESULT(INT32, last.sub_impacts, NULL, "contacts in the last impact")},             \
        {"error", SHARED_RESULT(FLOAT64, last.error, NULL,                                         \
                                "estimate for the restitution, by time steps and modes")},         \
        {"total_error", SHARED_RESULT(FLOAT64, last.total_error, NULL,                             \
                                      "the same, with that of the models of contact and bodies")}, \
        {"gap_rate_before",                                                                        \
         SHARED_RESULT(FLOAT64, last.gap_rate_before, "m/s", "at the last touch")},                \
        {"gap_rate_after", SHARED_RESULT(FLOAT64, last.gap_rate_after, "m/s",                      \
                                         "rigid gap rate after the last impact")},                 \
    {                                                                                              \
        "impacts", SHARED_RESULT(INT32, impacts, NULL, "counted since the start")                  \
    }

#endif
