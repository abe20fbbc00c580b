/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A problem and its assembly, of a steel ball on the paper's beam and what a test adds. */
#ifndef PERCUSS_TEST_ASSEMBLY_BENCH_H
#define PERCUSS_TEST_ASSEMBLY_BENCH_H

#include "physics/support.h"
#include "solve/assemble.h"
#include "solve/contact_model.h"
#include "solve/formulation.h"

struct bench {
    struct lab *lab;
    struct arena arena;
    struct prepared_cache *cache;
    struct problem *problem;
    struct assembly assembly;
};

static inline struct bench *bench_create(void)
{
    struct bench *bench = calloc(1, sizeof *bench);
    assert_non_null(bench);
    bench->lab = lab_create();
    bench->cache = prepared_cache_create();
    assert_non_null(bench->cache);
    lab_add(bench->lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(bench->lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    return bench;
}

static inline void bench_free(struct bench *bench)
{
    prepared_cache_free(bench->cache);
    arena_release(&bench->arena);
    lab_free(bench->lab);
    free(bench);
}

/* Its bodies found and its contacts placed. */
static inline void bench_place(struct bench *bench, const struct solve_request *request)
{
    struct fault fault = {""};
    prepared_cache_use(bench->cache, bench->lab->set.revision);
    bench->problem = problem_create(request, bench->cache, &bench->arena);
    assert_non_null(bench->problem);
    if (placement_find(bench->problem, &bench->lab->set, &fault))
        fail_msg("%s", fault.text);
}

/* With Hertz's law in half-spaces, and the modes up to a frequency (rad/s). */
static inline void bench_assemble(struct bench *bench, double cut)
{
    struct fault fault = {""};
    struct mode_choice choice = {.cut = cut, .most = MODE_CHOICE_MOST};
    assert_int_equal(contact_model_choose(bench->problem, &bench->lab->set, NULL, &fault), PERCUSS_OK);
    assert_true(assemble(&bench->assembly, bench->problem, &choice));
}

#endif
