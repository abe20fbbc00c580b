/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the accuracy asked for means to the steps of the modal method. */
#ifndef PERCUSS_IMPACT_STEP_LIMITS_H
#define PERCUSS_IMPACT_STEP_LIMITS_H

#include <stdbool.h>

#include "impact/impact.h"
#include "impact/impact_scale.h"

struct step_limits {
    /* A force's cubic is accurate enough when its highest Legendre coefficient is this share of the
     * contact's force. The impulse converges with the eighth power of the step, the coefficient
     * with the third, hence about accuracy^(3/8). */
    double roughness;
    /* The step in which a contact ends may be this part of its duration (impact_scale.h): the
     * impulse within it is about its 5/2 power, and its end lies somewhere between the nodes. */
    double event_share;
    /* The one in which it begins: the nodes begin with it, and its force like t^(3/2), which they
     * follow to a hundredth of their largest. */
    double opening_share;
    /* Both without and with projected ends (step_ends.h); event first. The latter 0: never. */
    double plain[2], projected[2];
    /* See step_limits_stable. 0.5 still closes the audit to 1e-5 over 20 wave passages, 2 does
     * not; 0.02 closes it to 1e-11. */
    double coupling;
};

struct step_limits step_limits_make(const struct scene *scene, double accuracy,
                                    enum impact_care care);

/* Longer first and last steps where a scene's contacts are one, or a group that does not yield, and
 * their forces there may be projected (step_ends.h). */
void step_limits_project(struct step_limits *limits, const struct scene *scene,
                         const struct impact_settings *settings);

/* A contact begins, with that scale: chooses the shares, and whether its ends are projected. What
 * acceleration presses is back soon after its end, which a long step would not see. */
bool step_limits_open(struct step_limits *limits, const struct scene *scene, size_t contact,
                      const struct impact_scale *scale);

/* The longest step of a contact of that scale, s, that pumps no mode. A mode that the step does not
 * resolve sees the law at four instants only and can be pumped by it. Its coupling to the contact
 * within a step, phi^2 (dF/dd) h / omega, must then stay small. Long contacts on light bodies need
 * this (hundreds of steps); an ordinary impact takes such steps anyway. */
double step_limits_stable(const struct scene *scene, size_t contact,
                          const struct impact_scale *scale, double coupling);

#endif
