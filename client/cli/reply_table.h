/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A reply for people. */
#ifndef PERCUSS_CLI_REPLY_TABLE_H
#define PERCUSS_CLI_REPLY_TABLE_H

#include <percuss/percuss.h>

#include "scene.h"

/* Prints the answer to stdout; message and warnings to stderr. `request` is the question, `scene`
 * the same in words; NULL: a whole request was asked. */
void reply_table_print(const struct percuss_request *request, const struct percuss_reply *reply,
                       const struct scene_text *scene);

/* Prints the meaning of a status that is not OK, and the warnings, to stderr. */
void reply_table_tell(const struct percuss_reply *reply);

/* Estimated error of the restitution: time steps and modes together; NAN: unknown. */
double reply_restitution_error(const struct percuss_reply *reply);

/* The same with that of the models; NAN: unknown, as to a server of 0.1.0. */
double reply_total_error(const struct percuss_reply *reply);

/* Whether one of its contacts has friction. */
bool reply_has_friction(const struct percuss_reply *reply);

/* Listed sub-impacts that are not negligible. */
unsigned reply_significant(const struct percuss_contact_result *contact);

#endif
