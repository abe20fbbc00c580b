/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the hard cases share: answers judged by what must hold for every one of them. */
#ifndef PERCUSS_TEST_HARD_H
#define PERCUSS_TEST_HARD_H

#include "model/modal_basis.h"
#include "physics/support.h"

/* Solves whatever comes of it; the answer has finite numbers or a message. */
static inline enum percuss_status hard_solve(struct lab *lab, const struct solve_request *request,
                                             struct solve_result *result)
{
    enum percuss_status status = solve(lab->workspace, &lab->means, request, result);
    if (status)
        assert_true(result->fault.text[0] != '\0');
    if (status && status != PERCUSS_TRUNCATED)
        return status;
    assert_true(isfinite(result->energy.closure) && isfinite(result->window));
    assert_true(isfinite(result->restitution_time + result->restitution_modes));
    for (size_t c = 0; c < result->contact_count; c++)
        assert_true(isfinite(result->contacts[c].impulse) && result->contacts[c].impulse >= 0.0);
    return status;
}

/* Share of the energy that the audit misses; of the larger of what is available and `approach`. */
static inline double closure_share(const struct solve_result *result, double approach)
{
    return fabs(result->energy.closure) / fmax(result->energy.available, approach);
}

static inline bool has_warning(const struct solve_result *result, const char *words)
{
    for (size_t i = 0; i < result->warning_count; i++)
        if (strstr(result->warnings[i], words))
            return true;
    return false;
}

/* The end that a finished answer without acceleration has. */
static inline void assert_separated(const struct solve_result *result)
{
    assert_int_equal(result->status, PERCUSS_OK);
    assert_int_equal(result->end_reason, PERCUSS_END_SEPARATED);
    assert_true(result->complete);
}

/* An answer that the horizon or the effort cut: says so in every place. */
static inline void assert_cut(const struct solve_result *result, enum percuss_end_reason reason)
{
    assert_int_equal(result->status, PERCUSS_TRUNCATED);
    assert_int_equal(result->end_reason, reason);
    assert_false(result->complete);
    assert_non_null(strstr(result->fault.text, "not final"));
}

/* Ball of 15 mm steel and the aluminium beam of the paper. */
static inline struct lab *paper_lab(double damping)
{
    struct lab *lab = lab_create();
    struct body beam = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    beam.damping = damping;
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "beam", beam);
    lab_add(lab, "rod", make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "wall", rigid_wall());
    return lab;
}

static inline struct solve_request on_beam(double x, double speed)
{
    return strike(sphere_spot("ball", 0.015), side_spot("beam", x, 0.010, 0.0), speed);
}

static inline struct solve_request on_rod(double speed)
{
    return strike(sphere_spot("ball", 0.015), end_spot("rod", 1.0), speed);
}

static inline struct solve_request on_wall(double speed)
{
    return strike(sphere_spot("ball", 0.015), wall_spot("wall"), speed);
}

#endif
