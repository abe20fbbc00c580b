/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* From a solution to the reply: contacts, bodies and their states after the impact, errors, reasons
 * and warnings, and time histories. */
#ifndef PERCUSS_SOLVE_REPORT_H
#define PERCUSS_SOLVE_REPORT_H

#include "solve/result.h"
#include "solve/solution.h"

/* Fills everything of `result` that the solution decides; status and message too. */
void report_fill(const struct problem *problem, const struct solution *solution,
                 struct solve_result *result);

/* The state of a body at the end of the window: modes that took part from the outcome, the others
 * of its initial state moved on freely; dents unless the request ignores them. NULL: a rigid body
 * without dents, or out of memory. In the problem's arena. */
const struct body_state *state_after(const struct assembly *assembly,
                                     const struct impact_outcome *outcome,
                                     const struct problem *problem, size_t body);

/* Solves the answer's scene once more by the modal method, with a log of the forces, and sets
 * result->trace. That may take as much work as an answer, and the histories as much again: where it
 * is spent they end, with a warning. Warns where the answer came from another method and that
 * solution differs. Returns result->status, or INTERNAL or TIMEOUT with the message. */
enum percuss_status report_trace(const struct problem *problem, const struct solution *solution,
                                 struct pace *pace, struct solve_result *result);

/* Fills the bodies' velocities after all impulses of result->contacts, by the bodies' own masses.
 */
void report_velocities(const struct problem *problem, struct solve_result *result);

/* Adds a warning while there is room. */
void report_warn(struct solve_result *result, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void report_warnings(const struct warnings *warnings, struct solve_result *result);

#endif
