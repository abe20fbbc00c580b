/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/error/total.h"

#include <math.h>

#include "base/extremes.h"
#include "model/rigid.h"
#include "model/vector.h"
#include "solve/error/attempt.h"
#include "solve/error/calibration.h"
#include "solve/error/deviation.h"
#include "solve/error/models.h"
#include "solve/error/state.h"
#include "solve/outcome.h"

/* Adds the effect of an impulse's error on the velocities of a body. */
static void add_velocity_error(const struct problem *problem, size_t index, const double *point,
                               const double *direction, double impulse_error,
                               struct solve_body_result *body)
{
    double impulse[3];
    double velocity[3] = {0.0, 0.0, 0.0};
    double angular[3] = {0.0, 0.0, 0.0};
    scale3(impulse_error, direction, impulse);
    rigid_apply_impulse(problem->bodies[index], point, impulse, velocity, angular);
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
            add_velocity_error(problem, side->body, side->site.point, side->direction,
                               result->contacts[c].impulse_error, &result->bodies[side->body]);
        }
    for (size_t i = 0; i < 4 * problem->friction_count; i++) {
        const struct contact_friction *friction = &problem->friction[i / 4];
        const struct contact_side *side = &problem->sides[friction->contact][i % 2];
        add_velocity_error(problem, side->body, side->site.point,
                           friction->sides[i / 2 % 2][i % 2].direction,
                           result->contacts[friction->contact].impulse_tangential_error,
                           &result->bodies[side->body]);
    }
}

/* Of a single contact: by the total error of its restitution. */
static void report_single_impulse(struct solve_result *result)
{
    struct solve_contact_result *contact = &result->contacts[0];
    contact->impulse_error_model = result->restitution_model * contact->impulse_compression;
    contact->impulse_error = result->restitution_total * contact->impulse_compression;
}

/* Of all contacts of a group, the largest change that other solutions make, relative to
 * the contact's scale. */
static double largest_share(const struct problem *problem, const struct solution *solution)
{
    double largest = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++) {
        double scale = outcome_impulse_scale(problem, &solution->outcome, c);
        double distance = neighbours_impulse_distance(solution->neighbours, &solution->outcome, c);
        if (scale > 0.0)
            largest = larger(distance / scale, largest);
    }
    return largest;
}

/* By modes and steps. */
static double numerical(const struct problem *problem, const struct solution *solution, size_t c,
                        double largest)
{
    double scale = outcome_impulse_scale(problem, &solution->outcome, c);
    double distance = neighbours_impulse_distance(solution->neighbours, &solution->outcome, c);
    double error = solution->farther * larger(AGREED * largest * scale, distance);
    double steps = attempt_steps_leave(solution->step_accuracy);
    return larger(error, steps * scale) + solution->error.states.restitution * scale;
}

/* How much more a tangential force moves the surfaces than a normal one: 7/2 of a ball. So much
 * more do errors of modes and steps count along the surface. */
static double along_over_normal(const struct problem *problem, size_t friction)
{
    size_t rows = problem_rows(problem), contact = problem->friction[friction].contact;
    size_t first = problem->contact_count + 2 * friction;
    const double *w = problem->row_w;
    double along = larger(w[first * (rows + 1)], w[(first + 1) * (rows + 1)]);
    return larger(1.0, along / w[contact * (rows + 1)]);
}

/* Of Coulomb's limit, what modes left out do to plain friction that does not slide throughout. */
static double plain_leaves(const struct solution *solution,
                           const struct solve_contact_result *contact)
{
    bool rings = solution->scene->plain && solution->scene->groups > 0;
    return rings && contact->friction_state != PERCUSS_FRICTION_STATE_SLID ? PLAIN_MODES_LEFT : 0.0;
}

/* The largest part of that along a contact's normal, over its own scale: what it does to the
 * restitution. */
static double plain_restitution(const struct problem *problem, const struct solution *solution,
                                const struct solve_result *result)
{
    double largest = 0.0;
    size_t rows = problem_rows(problem);
    for (size_t i = 0; i < problem->friction_count; i++) {
        const struct contact_friction *friction = &problem->friction[i];
        size_t c = friction->contact, tangent = problem->contact_count + 2 * i;
        const double *w = problem->row_w + c * rows;
        double share = friction->coefficient * hypot(w[tangent], w[tangent + 1]) / w[c];
        largest = larger(plain_leaves(solution, &result->contacts[c]) * share, largest);
    }
    return largest;
}

/* Of the tangential impulses: modes and steps by what they do to the normal ones, by the solutions
 * beside and by what cells and bends of the force leave; the models by the coefficient's deviation,
 * by the normal impulse, and by the unknown part of the tangential stiffness, which changes the
 * impulse by less than as much. */
static void report_tangential(const struct problem *problem, const struct solution *solution,
                              struct solve_result *result)
{
    for (size_t i = 0; i < problem->friction_count; i++) {
        const struct contact_friction *friction = &problem->friction[i];
        size_t c = friction->contact;
        struct solve_contact_result *contact = &result->contacts[c];
        double limit =
            friction->coefficient * outcome_impulse_scale(problem, &solution->outcome, c);
        double normal = (result->restitution_time + result->restitution_modes) * limit *
                        along_over_normal(problem, i);
        double cells = FRICTION_LEFT * sqrt(solution->step_accuracy) * limit;
        double models = hypot(solution->error.models.tangential[c],
                              friction->coefficient * contact->impulse_error_model);
        struct deviation_along along = deviation_along(problem, friction);
        models += (along.stiffness + along.waves) * limit;
        contact->impulse_tangential_error_model = models;
        double sum = normal + larger(solution->neighbours->tangential[c], cells) +
                     plain_leaves(solution, contact) * limit + models;
        /* from one end of Coulomb's range to the other */
        contact->impulse_tangential_error =
            smaller(sum, 2.0 * friction->coefficient * (contact->impulse + contact->impulse_error));
    }
}

static void report_impulses(const struct problem *problem, const struct solution *solution,
                            struct solve_result *result)
{
    const struct error_budget *error = &solution->error;
    if (problem->contact_count == 1 && problem->impulse_compression[0] > 0.0) {
        report_single_impulse(result);
        return;
    }
    double largest = largest_share(problem, solution);
    double most = 0.0;
    bool alone = problem->contact_count == 1;
    for (size_t c = 0; c < problem->contact_count; c++)
        most = larger(2.0 * outcome_impulse_scale(problem, &solution->outcome, c), most);
    for (size_t c = 0; c < problem->contact_count; c++) {
        struct solve_contact_result *contact = &result->contacts[c];
        double scale = outcome_impulse_scale(problem, &solution->outcome, c);
        double solved = alone ? result->impulse_time + result->impulse_modes
                              : numerical(problem, solution, c, largest);
        /* from none to a full rebound of the hardest impact */
        double range = larger(contact->impulse, most - contact->impulse);
        contact->impulse_error_model =
            smaller(error->models.impulse[c] + error->states.model * scale, range);
        contact->impulse_error = smaller(contact->impulse_error_model + solved, range);
    }
}

/* A sum, since errors of modes and steps are systematic. */
static void report_total(double model, double yield, double range, struct solve_result *result)
{
    double numerical = result->restitution_time + result->restitution_modes;
    result->restitution_model = model;
    result->restitution_total = smaller(numerical + model, range);
    result->restitution_yield =
        result->restitution_total - smaller(numerical + model - yield, range);
    result->total_met = result->tolerance_met && result->restitution_total <= result->tolerance;
}

void total_report_model(const struct problem *problem, double model, double yield, double range,
                        struct solve_result *result)
{
    report_total(model, yield, range, result);
    report_single_impulse(result);
    report_velocity_errors(problem, result);
}

/* Of modes and steps, and of the states through them. */
static void report_numerical(const struct problem *problem, const struct solution *solution,
                             struct solve_result *result)
{
    const struct error_budget *error = &solution->error;
    double start = error->states.restitution + plain_restitution(problem, solution, result);
    result->restitution_time = error->steps.restitution;
    result->restitution_modes = error->modes.restitution;
    result->impulse_time = error->steps.impulse;
    result->impulse_modes = error->modes.impulse;
    if (start > 0.0) {
        result->restitution_modes =
            smaller(result->restitution_modes + start, outcome_range(problem, &solution->outcome));
        result->impulse_modes += start * problem_largest_compression(problem);
    }
    /* an answer cut off by its effort was compared with no other */
    result->tolerance = problem->tolerance;
    result->tolerance_met =
        solution->tolerance_met && solution->outcome.end_reason != PERCUSS_END_LIMIT &&
        result->restitution_time + result->restitution_modes <= problem->tolerance;
}

/* Shares of the largest impulse, for the bodies' new states. */
static void report_states(const struct problem *problem, const struct solution *solution,
                          struct solve_result *result)
{
    double impulse = 0.0;
    for (size_t c = 0; c < result->contact_count; c++)
        if (result->contacts[c].impulse > impulse)
            impulse = result->contacts[c].impulse;
    double share = impulse > 0.0 ? problem_largest_compression(problem) / impulse : 0.0;
    const struct state_shares shares = {share *
                                            (result->restitution_time + result->restitution_modes),
                                        share * result->restitution_model};
    for (size_t b = 0; b < result->body_count; b++)
        if (result->bodies[b].state_after)
            state_error_after(problem, solution, &shares, b,
                              (struct body_state *)result->bodies[b].state_after);
}

enum percuss_status total_find(const struct problem *problem, struct solution *solution,
                               bool states, struct pace *pace)
{
    enum percuss_status status =
        models_find_error(problem, solution, pace, &solution->error.models);
    if (!status && states)
        status = state_find_error(problem, solution, pace, &solution->error.states);
    return status;
}

void total_report(const struct problem *problem, const struct solution *solution,
                  struct solve_result *result)
{
    const struct error_budget *error = &solution->error;
    report_numerical(problem, solution, result);
    report_total(error->models.restitution + error->states.model, error->models.yield,
                 outcome_range(problem, &solution->outcome), result);
    report_impulses(problem, solution, result);
    report_tangential(problem, solution, result);
    report_velocity_errors(problem, result);
    report_states(problem, solution, result);
}
