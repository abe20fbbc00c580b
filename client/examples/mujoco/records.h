/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The records of a run: a table on stdout, and CSV for the plots. */
#ifndef MUJOCO_RECORDS_H
#define MUJOCO_RECORDS_H

#include <stdio.h>

#include "engine.h"

enum { RECORD_IMPACTS = 256 };

/* One contact of an impact. */
struct record {
    int impact;
    size_t contact, count; /* which of how many */
    uint32_t a, b;         /* bodies of the contact */
    double time, gap_rate, impulse, restitution, restitution_reply, applied, error, window;
    double delassus[ENGINE_CONTACTS]; /* its row */
    uint32_t sub_impacts;
    bool answered;
};

struct records {
    const char *scene;
    struct engine *engine;
    FILE *sub_impacts;
    int impacts;
    size_t count;
    struct record list[RECORD_IMPACTS];
};

/* The `report` of struct percuss_slow_config, with the records as context. */
void records_report(void *context, const struct percuss_slow_report *report);

/* Takes over the impulses applied in full; at the end of a run. */
void records_finish(struct records *records);

/* Appends to impacts.csv. */
void records_write(const struct records *records, FILE *file);

#endif
