/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A request as the searches meet it: its problem, and what all attempts at it share. */
#ifndef PERCUSS_TEST_SEARCH_LAB_H
#define PERCUSS_TEST_SEARCH_LAB_H

#include "physics/support.h"
#include "solve/error/calibration.h"
#include "solve/error/neighbours.h"
#include "solve/error/refinement.h"
#include "solve/formulation.h"

struct search {
    struct lab *lab;
    struct prepared_cache *cache;
    struct arena arena;
    struct neighbours neighbours;
    struct attempt_context context;
};

/* A steel ball, and an aluminium rod and beams of a metre that it strikes. */
static inline struct search *search_create(void)
{
    struct search *search = calloc(1, sizeof *search);
    assert_non_null(search);
    search->lab = lab_create();
    search->cache = prepared_cache_create();
    assert_non_null(search->cache);
    struct body three = make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0);
    three.modes = 3;
    lab_add(search->lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(search->lab, "rod", make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(search->lab, "three", three);
    lab_add(search->lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    return search;
}

static inline void search_free(struct search *search)
{
    arena_release(&search->arena);
    prepared_cache_free(search->cache);
    lab_free(search->lab);
    free(search);
}

/* Formulates the request, which must stay, with the effort that one has. */
static inline struct attempt_context *search_begin(struct search *search,
                                                   const struct solve_request *request)
{
    struct fault fault = {""};
    struct solve_context means = {.catalogue = &search->lab->set};
    arena_reset(&search->arena);
    prepared_cache_use(search->cache, search->lab->set.revision);
    struct problem *problem = problem_create(request, search->cache, &search->arena);
    assert_non_null(problem);
    if (formulate(problem, &means, &fault))
        fail_msg("%s", fault.text);
    search->context = (struct attempt_context){
        .problem = problem,
        .arena = &search->arena,
        .work = attempt_work_allowed(PERCUSS_METHOD_MODAL),
        .neighbours = &search->neighbours,
    };
    return &search->context;
}

/* An attempt with `most` modes of each body and those steps, solved; the effort is not counted. */
static inline struct attempt search_attempt(const struct search *search, size_t most,
                                            double accuracy)
{
    struct attempt_context context = search->context;
    struct attempt attempt = {.choice = {.cut = INFINITY, .most = most}, .accuracy = accuracy};
    assert_int_equal(attempt_assemble(&context, &attempt), PERCUSS_OK);
    assert_int_equal(attempt_run(&context, &attempt, &attempt.assembly->scene), PERCUSS_OK);
    return attempt;
}

/* |e - e of a reference| of the first contact. */
static inline double search_error(const struct search *search, const struct attempt *attempt,
                                  const struct attempt *reference)
{
    return outcome_compare(search->context.problem, &attempt->outcome, &reference->outcome)
        .restitution;
}

static inline struct solve_request search_on_rod(const char *rod, double tolerance)
{
    struct solve_request request = strike(sphere_spot("ball", 0.015), end_spot(rod, 1.0), 0.3);
    request.options.tolerance = tolerance;
    return request;
}

/* Two sub-impacts: the beam swings back. */
static inline struct solve_request search_on_beam(double tolerance)
{
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), side_spot("beam", 0.0, 0.010, 0.0), 0.287);
    request.options.tolerance = tolerance;
    return request;
}

#endif
