/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The configuration of DDS that CYCLONEDDS_URI names, as Cyclone DDS itself understands it: told
 * to, it writes down every setting, and what it chooses. */
#ifndef PERCUSS_DOCTOR_CONFIGURATION_H
#define PERCUSS_DOCTOR_CONFIGURATION_H

#include <stdint.h>

#include "watched.h"

/* CYCLONEDDS_URI, or NULL: not set. */
const char *configuration_given(void);

/* Calls a function that joins a domain of DDS for the first time in this process, and has Cyclone
 * DDS write that to standard error. */
int configuration_trace(int (*join)(void *context), void *context);

/* Looks at what a process that did so has written. `taken`: participant indices of the domain that
 * others have. */
void configuration_look(const struct watched *end, unsigned taken, struct findings *findings);

#endif
