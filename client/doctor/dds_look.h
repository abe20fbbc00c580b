/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What DDS itself knows of a domain, besides what daemons announce. */
#ifndef PERCUSS_DOCTOR_DDS_LOOK_H
#define PERCUSS_DOCTOR_DDS_LOOK_H

#include <stdint.h>

#include "finding.h"

struct dds_look {
    int participant; /* of ours */
    int status_reader;
};

/* Joins the domain; `security` and `partition` may be NULL. False: it cannot, which is found. */
bool dds_look_open(uint32_t domain, const char *partition, const char *security,
                   struct dds_look *look, struct findings *findings);

/* Finds which other processes are in the domain, by now. The number of those that say nothing of
 * themselves: secured ones, to whoever has no identity, and those that are not of Cyclone DDS. */
unsigned dds_look_participants(const struct dds_look *look, struct findings *findings);

/* How far the clock of that server is ahead of ours, s, by an announcement that comes within 1.5 s;
 * NAN: none has come. */
double dds_look_clock(const struct dds_look *look, const uint8_t server[16]);

void dds_look_close(const struct dds_look *look);

#endif
