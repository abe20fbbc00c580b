/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/rate.h"

#include <math.h>

#include "contact/law_closed_form.h"
#include "contact/plastic.h"
#include "contact/strain_rate.h"

/* The rate that counts may be so many times as low or high. Complete finite elements with the rate
 * of each point have 0.79 to 1.74 times it, two standard deviations of the logarithm being a factor
 * of 1.7 (docs/lab/contact-models.md). */
static const double SPAN = 2.0;
static const double SPEED_STEP = 1e-3; /* for the slope by speed, relative */

/* The rates at a speed, m/s. */
static void rates_at(const struct problem *problem, size_t c, double speed,
                     struct strain_rate found[2])
{
    double w = problem->w[c * (problem->contact_count + 1)];
    strain_rate_of(&problem->hertz[c],
                   (const struct material *const[]){problem_material(problem, c, 0),
                                                    problem_material(problem, c, 1)},
                   (const struct yield_rate *const[]){&problem_body(problem, c, 0)->yield_rate,
                                                      &problem_body(problem, c, 1)->yield_rate},
                   &(struct strain_rate_blow){.speed = speed, .work = 0.5 * speed * speed / w},
                   found);
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
    struct strain_rate now[2], more[2], most[2];
    rates_at(problem, contact, speed, now);
    rates_at(problem, contact, (1.0 + SPEED_STEP) * speed, more);
    rates_at(problem, contact, fmax(speed, fastest), most);
    for (int which = 0; which < 2; which++) {
        rate.rate[which] = now[which].rate;
        rate.raised[which] = now[which].factor;
        sides[which].material.yield *= now[which].factor;
    }
    int side = closed_form_softer(&sides[0].material, &sides[1].material);
    const struct yield_rate *stated = &problem_body(problem, contact, side)->yield_rate;
    double factor = yield_rate_factor(stated, now[side].rate);
    double highest = fmax(now[side].rate, most[side].rate);
    rate.slow = yield_rate_factor(stated, now[side].rate / SPAN) / factor;
    rate.fast = yield_rate_factor(stated, SPAN * highest) / factor;
    rate.by_speed = log(more[side].factor / now[side].factor) / log1p(SPEED_STEP);
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
        text_add_number(text, rate->rate[which], 2);
        text_add(text, " 1/s");
    }
}
