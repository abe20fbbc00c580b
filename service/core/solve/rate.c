/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/rate.h"

#include <math.h>

#include "contact/law_closed_form.h"
#include "contact/plastic.h"
#include "contact/strain_rate.h"

/* The rate that counts may be that much lower or higher than the mean one, see problem.h. */
static const double SLOWER = 10.0;
static const double FASTER = 2.0;
static const double SPEED_STEP = 1e-3; /* for the slope by speed, relative */

/* The rate at a speed, m/s; the yield stresses over the stated ones. */
static double rate_at(const struct problem *problem, size_t c, double speed, double factors[2])
{
    double w = problem->w[c * (problem->contact_count + 1)];
    return strain_rate_of(
        &problem->hertz[c],
        (const struct material *const[]){problem_material(problem, c, 0),
                                         problem_material(problem, c, 1)},
        (const struct yield_rate *const[]){&problem_body(problem, c, 0)->yield_rate,
                                           &problem_body(problem, c, 1)->yield_rate},
        &(struct strain_rate_blow){.speed = speed, .work = 0.5 * speed * speed / w}, factors);
}

struct contact_rate rate_raise(struct problem *problem, size_t contact, double speed)
{
    struct contact_rate rate = {.raised = {1.0, 1.0}, .slow = 1.0, .fast = 1.0};
    struct contact_side *sides = problem->sides[contact];
    bool depends = false;
    for (int which = 0; which < 2; which++)
        depends =
            depends || (yield_rate_is_stated(&problem_body(problem, contact, which)->yield_rate) &&
                        isfinite(problem_material(problem, contact, which)->yield));
    if (!depends)
        return rate;
    double fastest = problem_approach(problem);
    if (!(speed > 0.0))
        speed = fastest;
    if (!(speed > 0.0))
        return rate;
    /* at the speed, a little above it, and at that of the blow which others may hand on */
    double more[2], most[2];
    rate.mean = rate_at(problem, contact, speed, rate.raised);
    rate_at(problem, contact, (1.0 + SPEED_STEP) * speed, more);
    double highest = fmax(rate.mean, rate_at(problem, contact, fmax(speed, fastest), most));
    for (int which = 0; which < 2; which++)
        sides[which].material.yield *= rate.raised[which];
    int side = closed_form_softer(&sides[0].material, &sides[1].material);
    const struct yield_rate *stated = &problem_body(problem, contact, side)->yield_rate;
    double now = yield_rate_factor(stated, rate.mean);
    rate.slow = yield_rate_factor(stated, rate.mean / SLOWER) / now;
    rate.fast = yield_rate_factor(stated, FASTER * highest) / now;
    rate.by_speed = log(more[side] / rate.raised[side]) / log1p(SPEED_STEP);
    return rate;
}

enum percuss_status rate_follow(const struct problem *problem, double factor, struct scene *scene)
{
    struct contact_law *laws = arena_take(problem->arena, scene->contacts, sizeof *laws);
    if (!laws)
        return PERCUSS_INTERNAL;
    for (size_t c = 0; c < scene->contacts; c++) {
        double by_speed = problem->contact_model.rates[c].by_speed;
        laws[c] = scene->laws[c];
        if (by_speed != 0.0 && laws[c].operations->curve)
            laws[c] = contact_law_rescaled(&laws[c], 1.0, pow(factor, by_speed));
    }
    scene->laws = laws;
    return PERCUSS_OK;
}

void rate_explain(const struct problem *problem, size_t contact, struct text *text)
{
    const struct contact_rate *rate = &problem->contact_model.rates[contact];
    for (int which = 0; which < 2; which++) {
        if (!(rate->raised[which] > 1.0))
            continue;
        text_format(text, "; yield of %s raised %.3g times by the strain rate, ",
                    problem_body(problem, contact, which)->id, rate->raised[which]);
        text_add_number(text, rate->mean, 2);
        text_add(text, " 1/s");
    }
}
