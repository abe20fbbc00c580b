/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The paper's sphere on its beam as an ensemble, solved in one thread. */
#ifndef PERCUSS_TEST_ENSEMBLE_LAB_H
#define PERCUSS_TEST_ENSEMBLE_LAB_H

#include "ensemble/create.h"
#include "ensemble/report.h"
#include "physics/support.h"

struct ensemble_lab {
    struct lab *lab;
    struct solve_request request;
    struct ensemble_spec spec;
    struct ensemble_input inputs[4];
    struct ensemble ensemble;
    struct ensemble_sample *samples;
    struct ensemble_report report;
};

static inline struct ensemble_input uncertain(enum input_quantity quantity, size_t body,
                                              enum distribution distribution, double first,
                                              double second)
{
    return (struct ensemble_input){.quantity = quantity,
                                   .body = body,
                                   .distribution = distribution,
                                   .first = first,
                                   .second = second,
                                   .lower = NAN,
                                   .upper = NAN};
}

/* A sphere above the middle of a beam that lies along x, which it approaches with 0.25 m/s. */
static inline void ensemble_lab_open(struct ensemble_lab *e)
{
    memset(e, 0, sizeof *e);
    e->lab = lab_create();
    lab_add(e->lab, "sphere", make_sphere(STEEL, 0.015));
    lab_add(e->lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    e->request = (struct solve_request){
        .body_count = 2,
        .contact_count = 1,
        .bodies = {{.id = "sphere",
                    .position = {0.0, 0.0, 0.025},
                    .orientation = {1.0, 0.0, 0.0, 0.0},
                    .velocity = {0.0, 0.0, -0.25}},
                   {.id = "beam", .orientation = {1.0, 0.0, 0.0, 0.0}}},
        .contacts = {{.a = 0, .b = 1, .point = {0.0, 0.0, 0.010}, .normal = {0.0, 0.0, 1.0}}},
    };
    e->spec = (struct ensemble_spec){.catalogue = &e->lab->set,
                                     .request = &e->request,
                                     .input_count = 1,
                                     .inputs = e->inputs,
                                     .samples = 100,
                                     .seed = 1};
    e->inputs[0] = uncertain(INPUT_SPEED, 0, DISTRIBUTION_IS_UNIFORM, 0.089, 0.411);
}

/* Solves all samples by the model that the ensemble has; `extras`: also what the report is checked
 * by. */
static inline void ensemble_lab_solve(struct ensemble_lab *e, bool extras)
{
    struct fault fault = {""};
    struct ensemble_worker *worker;
    assert_int_equal(ensemble_worker_create(&worker, &e->ensemble, NULL, &fault), PERCUSS_OK);
    uint64_t count = e->ensemble.count, more = ensemble_extras(&e->ensemble, count);
    free(e->samples);
    e->samples = calloc(count, sizeof *e->samples);
    struct ensemble_extra *extra = extras ? calloc(more + 1, sizeof *extra) : NULL;
    for (uint64_t i = 0; i < count; i++)
        ensemble_solve(worker, i, &e->samples[i], &fault);
    for (uint64_t k = 0; extras && k < more; k++)
        extra[k] = ensemble_extra(worker, count, k);
    struct report_material material = {count, e->samples, extra};
    assert_true(report_create(&e->report, &e->ensemble, &material, NULL));
    free(extra);
    ensemble_worker_free(worker);
}

/* The same, from the choice of the model on. */
static inline void ensemble_lab_run(struct ensemble_lab *e, bool extras)
{
    struct fault fault = {""};
    if (ensemble_create(&e->ensemble, &e->spec, NULL, &fault))
        fail_msg("%s", fault.text);
    ensemble_lab_solve(e, extras);
}

static inline void ensemble_lab_clear(struct ensemble_lab *e)
{
    report_release(&e->report);
    ensemble_release(&e->ensemble);
    free(e->samples);
    e->samples = NULL;
}

static inline void ensemble_lab_close(struct ensemble_lab *e)
{
    ensemble_lab_clear(e);
    lab_free(e->lab);
}

#endif
