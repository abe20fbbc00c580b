/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/relaxed.h"

#include <math.h>

bool relaxed_any(const struct problem *problem)
{
    bool any = false;
    for (size_t b = 0; b < problem->body_count; b++)
        any = any || problem->bodies[b]->relaxation.count > 0;
    return any;
}

/* Of both sides of a contact, as their materials are at a frequency, 1/Pa. */
static double compliance_at(const struct problem *problem, size_t c, double omega)
{
    double sum = 0.0;
    for (int which = 0; which < 2; which++) {
        const struct material *material = problem_material(problem, c, which);
        const struct body *body = problem_body(problem, c, which);
        sum += (1.0 - material->poisson * material->poisson) /
               (material->young * relaxation_storage(&body->relaxation, omega));
    }
    return sum;
}

/* The frequency w = w_0 (E(w)/E_0)^(2/5) of a contact, from w_0 with the instantaneous moduli on; 0
 * where it does not close. E grows at most like w^2, so that each step leaves at most 4/5 of the
 * distance between their logarithms. */
static double frequency_of(const struct problem *problem, size_t c)
{
    static const double SAME = 1e-9;
    double first = problem_frequency(problem, c);
    if (!(first > 0.0))
        return 0.0;
    double stiff = compliance_at(problem, c, INFINITY);
    for (double omega = first;;) {
        double next = first * pow(stiff / compliance_at(problem, c, omega), 0.4);
        if (fabs(next - omega) <= SAME * omega)
            return next;
        omega = next;
    }
}

/* Of the fastest contact of a body, or of all where it has none that closes. */
static double fastest(const struct problem *problem, const double *frequency, size_t body)
{
    double own = 0.0, any = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++) {
        const struct contact_side *sides = problem->sides[c];
        any = fmax(any, frequency[c]);
        if (sides[0].body == body || sides[1].body == body)
            own = fmax(own, frequency[c]);
    }
    return own > 0.0 ? own : any;
}

static enum percuss_status relax(struct problem *problem, size_t index, double omega,
                                 struct fault *fault)
{
    const struct body *stiff = problem->bodies[index];
    const struct body_variation softer = {PERCUSS_PARAMETER_YOUNG,
                                          stiff->material.young *
                                              relaxation_storage(&stiff->relaxation, omega)};
    struct body *body = arena_take(problem->arena, 1, sizeof *body);
    struct fault reason = {0};
    if (!body)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    if (body_vary(stiff, &softer, 1, body, &reason))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "bodies[%zu].id: '%s': as its material has relaxed at %.3g Hz: %.400s",
                         index, stiff->id, 0.5 * omega / M_PI, reason.text);
    double scale;
    const struct relaxation near = relaxation_near(&stiff->relaxation, omega, &scale);
    body->relaxed_from = stiff->material.young;
    body->loss_factor = relaxation_loss_factor(&near, omega);
    problem->bodies[index] = body;
    return PERCUSS_OK;
}

enum percuss_status relaxed_bodies(struct problem *problem, struct fault *fault)
{
    double frequency[PERCUSS_MAX_CONTACTS];
    for (size_t c = 0; c < problem->contact_count; c++)
        frequency[c] = frequency_of(problem, c);
    enum percuss_status status = PERCUSS_OK;
    for (size_t b = 0; !status && b < problem->body_count; b++) {
        double omega = fastest(problem, frequency, b);
        if (problem->bodies[b]->relaxation.count > 0 && omega > 0.0)
            status = relax(problem, b, omega, fault);
    }
    return status;
}
