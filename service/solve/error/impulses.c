/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/error/impulses.h"

#include <math.h>

#include "model/rigid.h"
#include "model/vector.h"
#include "solve/error/attempt.h"
#include "solve/error/calibration.h"
#include "solve/outcome.h"

/* Adds the effect of a contact's impulse error on the velocities of one of its bodies. */
static void add_velocity_error(const struct problem *problem, const struct contact_side *side,
                               double impulse_error, struct solve_body_result *body)
{
    double impulse[3];
    double velocity[3] = {0.0, 0.0, 0.0};
    double angular[3] = {0.0, 0.0, 0.0};
    scale3(impulse_error, side->direction, impulse);
    rigid_apply_impulse(problem->bodies[side->body], side->site.point, impulse, velocity, angular);
    body->velocity_error += norm3(velocity);
    body->angular_velocity_error += norm3(angular);
}

/* The errors of a body's contacts add up: none of them is known to balance another. */
static void report_velocity_errors(const struct problem *problem, struct solve_result *result)
{
    if (!result->velocities_known)
        return;
    for (size_t b = 0; b < problem->body_count; b++)
        result->bodies[b].velocity_error = result->bodies[b].angular_velocity_error = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++)
        for (int which = 0; which < 2; which++) {
            const struct contact_side *side = &problem->sides[c][which];
            add_velocity_error(problem, side, result->contacts[c].impulse_error,
                               &result->bodies[side->body]);
        }
}

void impulse_error_alone(const struct problem *problem, struct solve_result *result)
{
    struct solve_contact_result *contact = &result->contacts[0];
    contact->impulse_error_model = result->restitution_model * contact->impulse_compression;
    contact->impulse_error = result->restitution_total * contact->impulse_compression;
    report_velocity_errors(problem, result);
}

/* Of all contacts of a group, the largest change that other solutions make, relative to
 * the contact's scale. */
static double largest_share(const struct problem *problem, const struct solution *solution)
{
    double largest = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++) {
        double scale = outcome_impulse_scale(problem, &solution->outcome, c);
        double distance = neighbours_impulse_distance(&solution->neighbours, &solution->outcome, c);
        if (scale > 0.0)
            largest = fmax(largest, distance / scale);
    }
    return largest;
}

/* By modes and steps. */
static double numerical(const struct problem *problem, const struct solution *solution, size_t c,
                        double largest)
{
    double scale = outcome_impulse_scale(problem, &solution->outcome, c);
    double distance = neighbours_impulse_distance(&solution->neighbours, &solution->outcome, c);
    double error = solution->farther * fmax(distance, AGREED * largest * scale);
    double steps = attempt_steps_leave(solution->step_accuracy);
    return fmax(error, steps * scale) + solution->start * scale;
}

void impulse_error_report(const struct problem *problem, const struct solution *solution,
                          const struct model_error *model, double start,
                          struct solve_result *result)
{
    if (problem->contact_count == 1 && problem->impulse_compression[0] > 0.0) {
        impulse_error_alone(problem, result);
        return;
    }
    double largest = largest_share(problem, solution);
    double most = 0.0;
    bool alone = problem->contact_count == 1;
    for (size_t c = 0; c < problem->contact_count; c++)
        most = fmax(most, 2.0 * outcome_impulse_scale(problem, &solution->outcome, c));
    for (size_t c = 0; c < problem->contact_count; c++) {
        struct solve_contact_result *contact = &result->contacts[c];
        double scale = outcome_impulse_scale(problem, &solution->outcome, c);
        double solved = alone ? result->impulse_time + result->impulse_modes
                              : numerical(problem, solution, c, largest);
        /* from none to a full rebound of the hardest impact */
        double range = fmax(contact->impulse, most - contact->impulse);
        contact->impulse_error_model = fmin(model->impulse[c] + start * scale, range);
        contact->impulse_error = fmin(contact->impulse_error_model + solved, range);
    }
    report_velocity_errors(problem, result);
}
