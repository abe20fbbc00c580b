/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Questions to the service, and the vibration that its answers name. */
#ifndef PERCUSS_SLOW_QUESTION_H
#define PERCUSS_SLOW_QUESTION_H

#include "group.h"

/* The question about a group. False: too many contacts or bodies for one, or a contact states
 * friction that its group cannot have; group->why says which. */
bool question_make(const struct percuss_slow *slow, struct group *group, double now,
                   struct percuss_request *request);

/* Whether the question has the engine's matrix of normals and tangents (group_probe_oblique). */
bool question_is_oblique(const struct percuss_slow *slow, const struct group *group);

/* Whether the reply to a question without a matrix is about bodies as heavy as the engine's; else
 * the difference is in group->why. */
bool question_has_these_masses(const struct percuss_slow *slow, struct group *group,
                               const struct percuss_request *request,
                               const struct percuss_reply *reply);

/* Puts it, again where that helps. Not OK: no usable answer, as question_put. *reply is to be
 * released in any case. */
enum percuss_result question_ask(struct percuss_slow *slow, struct group *group,
                                 struct percuss_request *request, struct percuss_reply *reply);

/* One question as it is. INVALID_ARGUMENT: refused, now and always; any other: no answer came. The
 * reason is in group->why. */
enum percuss_result question_put(struct percuss_slow *slow, struct group *group,
                                 const struct percuss_request *request,
                                 struct percuss_reply *reply);

/* Fails with the reason in group->why. */
enum percuss_result question_fail(const struct percuss_slow *slow, const struct group *group,
                                  enum percuss_result result);

/* Keeps the tokens of a reply to a request about these contacts; they hold at `time`. */
void tokens_keep(struct percuss_slow *slow, const struct percuss_slow_contact *contacts,
                 const struct percuss_request *request, const struct percuss_reply *reply,
                 double time);

/* Back to the tokens of a request at `time`. */
void tokens_restore(struct percuss_slow *slow, const struct percuss_slow_contact *contacts,
                    const struct percuss_request *request, double time);

/* The vibration of these contacts' bodies is unknown: taken as rest. */
void tokens_forget(struct percuss_slow *slow, size_t count,
                   const struct percuss_slow_contact *contacts);

#endif
