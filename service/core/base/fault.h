/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Error messages for users, and the names of statuses and choices. */
#ifndef PERCUSS_BASE_FAULT_H
#define PERCUSS_BASE_FAULT_H

#include "percuss/vocabulary.h"

struct fault {
    char text[640];
};

/* Writes the message (cut to fit) and returns `status`, so that a check reads
 * `return fault_set(fault, PERCUSS_BAD_REQUEST, "contacts[%zu].gap: %g: ...", ...);`.
 * `fault` may be NULL. The message names the field, its value and what is allowed. */
enum percuss_status fault_set(struct fault *fault, enum percuss_status status, const char *format,
                              ...) __attribute__((format(printf, 3, 4)));

/* The wire name of a status, end reason or choice; "?" for a number out of range. */
const char *status_name(unsigned status);
const char *end_reason_name(unsigned end_reason);
const char *contact_model_name(unsigned contact_model);
const char *method_name(unsigned method);
const char *compliance_name(unsigned compliance);
const char *dents_name(unsigned dents);
const char *friction_name(unsigned friction);
const char *parameter_name(unsigned parameter);

#endif
