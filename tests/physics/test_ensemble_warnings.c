/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What single impacts would be warned of reaches the report of an ensemble, counted, whoever solved
 * the samples in whatever order. */
#include "physics/ensemble_lab.h"

static bool warns(const struct ensemble_report *report, const char *words)
{
    for (size_t i = 0; i < report->warning_count; i++)
        if (strstr(report->warnings[i], words))
            return true;
    return false;
}

static void is_same(const struct ensemble_report *a, const struct ensemble_report *b)
{
    assert_int_equal(a->warning_count, b->warning_count);
    for (size_t i = 0; i < a->warning_count; i++)
        assert_string_equal(a->warnings[i], b->warnings[i]);
}

/* The samples that solve() itself would warn of with `words`, and the first of them. */
static uint64_t count_by_solve(struct ensemble_lab *e, const char *words, uint64_t *first)
{
    uint64_t count = 0;
    static struct solve_result result;
    for (uint64_t i = 0; i < e->ensemble.count; i++) {
        double speed;
        struct solve_request request = e->request;
        bool warned = false;
        ensemble_inputs(&e->ensemble, i, &speed);
        request.bodies[0].velocity[2] = -speed;
        lab_solve(e->lab, &request, &result);
        for (size_t w = 0; w < result.warning_count; w++)
            warned = warned || strstr(result.warnings[w], words);
        if (warned && count++ == 0)
            *first = i;
    }
    return count;
}

static void fast_samples_are_counted(void **state)
{
    (void)state;
    static const char *const words[] = {"wave speed in sphere", "wave speed in beam",
                                        "smallest radius of beam"};
    struct ensemble_lab e;
    ensemble_lab_open(&e);
    e.inputs[0] = uncertain(INPUT_SPEED, 0, DISTRIBUTION_IS_UNIFORM, 1.0, 100.0);
    e.spec.samples = 60;
    e.request.options.tolerance = 1e-2;
    ensemble_lab_run(&e, false);
    for (size_t i = 0; i < COUNT(words); i++) {
        char expected[64];
        uint64_t first = 0, count = count_by_solve(&e, words[i], &first);
        assert_true(count > 5 && count < 55);
        snprintf(expected, sizeof expected,
                 "samples: %llu of 60, first %llu: ", (unsigned long long)count,
                 (unsigned long long)first);
        bool found = false;
        for (size_t w = 0; w < e.report.warning_count; w++)
            found = found || (strstr(e.report.warnings[w], words[i]) &&
                              strncmp(e.report.warnings[w], expected, strlen(expected)) == 0);
        if (!found)
            fail_msg("no '%s...%s'", expected, words[i]);
    }
    ensemble_lab_close(&e);
}

/* Two workers that take turns from the end. */
static void order_and_workers_do_not_matter(void **state)
{
    (void)state;
    struct ensemble_lab e;
    struct ensemble_worker *workers[2];
    struct ensemble_report other;
    struct fault fault;
    ensemble_lab_open(&e);
    e.inputs[0] = uncertain(INPUT_SPEED, 0, DISTRIBUTION_IS_UNIFORM, 1.0, 100.0);
    e.inputs[1] = uncertain(INPUT_DIRECTION, 0, DISTRIBUTION_IS_NORMAL, 0.0, 0.05);
    e.spec.input_count = 2;
    e.spec.samples = 60;
    e.request.options.tolerance = 1e-2;
    ensemble_lab_run(&e, false);
    assert_true(warns(&e.report, "slide") && warns(&e.report, "wave speed"));
    struct ensemble_sample *samples = calloc(60, sizeof *samples);
    for (int w = 0; w < 2; w++)
        assert_int_equal(ensemble_worker_create(&workers[w], &e.ensemble, NULL, &fault),
                         PERCUSS_OK);
    for (unsigned i = 60; i-- > 0;)
        ensemble_solve(workers[i % 3 == 0], i, &samples[i], NULL);
    struct report_material material = {60, samples, NULL};
    assert_true(report_create(&other, &e.ensemble, &material, NULL));
    is_same(&e.report, &other);
    report_release(&other);
    for (int w = 0; w < 2; w++)
        ensemble_worker_free(workers[w]);
    free(samples);
    ensemble_lab_close(&e);
}

/* Waves that leave a sphere by its speed are beyond the tolerance of the faster samples. */
static void waves_left_out_are_counted(void **state)
{
    (void)state;
    struct ensemble_lab e;
    ensemble_lab_open(&e);
    lab_add(e.lab, "wall", rigid_wall());
    strcpy(e.request.bodies[1].id, "wall");
    e.request.bodies[1].position[2] = 0.010;
    e.inputs[0] = uncertain(INPUT_SPEED, 0, DISTRIBUTION_IS_UNIFORM, 0.5, 1.5);
    e.spec.samples = 60;
    e.request.options.tolerance = 2e-6; /* 0.01 v/c is as much at 1.04 m/s */
    ensemble_lab_run(&e, false);
    const char *words = "model.omitted_error: waves that the models leave out of compact bodies";
    uint64_t first = 0, fast = count_by_solve(&e, words, &first);
    char expected[160];
    snprintf(expected, sizeof expected, "samples: %llu of 60, first %llu: %s",
             (unsigned long long)fast, (unsigned long long)first, words);
    assert_true(fast > 5 && fast < 55 && warns(&e.report, expected));
    ensemble_lab_close(&e);
}

/* Of a body of plastic: stated, or by how soft it is, which one in five samples or so is. */
static void losses_are_counted(void **state)
{
    (void)state;
    struct ensemble_lab e;
    ensemble_lab_open(&e);
    e.spec.samples = 20;
    e.request.options.tolerance = 1e-2;
    e.lab->bodies[0].loss_factor = 0.05;
    e.request.options.contact_model = PERCUSS_CONTACT_HERTZ;
    ensemble_lab_run(&e, false);
    assert_true(warns(&e.report, "samples: 20 of 20, first 0: contacts[0]: what sphere loses of "
                                 "itself in the contact (loss_factor 0.05) is not in the answer"));
    e.request.options.contact_model = PERCUSS_CONTACT_AUTO;
    ensemble_lab_clear(&e);
    e.request.options.tolerance = 2e-3;
    e.lab->bodies[0].loss_factor = NAN;
    e.inputs[0] = uncertain(INPUT_YOUNG, 0, DISTRIBUTION_IS_UNIFORM, 8e9, 18e9);
    ensemble_lab_run(&e, false);
    uint64_t soft = 0;
    for (uint64_t i = 0; i < 20; i++) {
        double young;
        ensemble_inputs(&e.ensemble, i, &young);
        soft += young < 10e9;
    }
    char expected[64];
    snprintf(expected, sizeof expected, "samples: %llu of 20, first ", (unsigned long long)soft);
    assert_true(soft > 1 && soft < 10 && warns(&e.report, expected));
    assert_true(warns(&e.report, "materials as soft as that of sphere (young "));
    ensemble_lab_close(&e);
}

/* Metals that state no yield, in those samples that press them beyond an ordinary one. */
static void unstated_yields_are_counted(void **state)
{
    (void)state;
    struct ensemble_lab e;
    ensemble_lab_open(&e);
    e.spec.samples = 20;
    e.lab->bodies[0].yield_unstated = true;
    ensemble_lab_run(&e, false);
    assert_true(warns(&e.report, "samples: 20 of 20, first 0: contacts[0]: no yield (or none) is "
                                 "stated of steel (sphere): the answer holds for metals"));
    ensemble_lab_close(&e);
}

/* Where nothing is to be said nothing is; a refusal is quoted. */
static void quiet_and_refused(void **state)
{
    (void)state;
    struct ensemble_lab e;
    ensemble_lab_open(&e);
    ensemble_lab_run(&e, true);
    assert_int_equal(e.report.warning_count, 0);
    ensemble_lab_clear(&e);
    /* overlapping by 10 um while pressed: below 0.14 m/s they cannot have touched before */
    e.request.contacts[0].gap = -1e-5;
    e.request.contacts[0].gap_acceleration = -1000.0;
    ensemble_lab_run(&e, false);
    assert_true(e.report.refused > 5 && e.report.refused < 40);
    assert_true(warns(&e.report, "were refused and are left out, first ") &&
                warns(&e.report, "and vibration they never touched before"));
    ensemble_lab_close(&e);
}

static bool never(void *context, double done)
{
    (void)done;
    ++*(unsigned *)context;
    return false;
}

/* Told of a deadline, a cancel or the end of the daemon at once. CVODE takes long enough to ask. */
static void what_is_quoted_can_be_stopped(void **state)
{
    (void)state;
    struct ensemble_lab e;
    struct ensemble_report stopped;
    unsigned asked = 0;
    const struct watch watch = {never, &asked};
    ensemble_lab_open(&e);
    e.spec.samples = 4;
    e.inputs[0] = uncertain(INPUT_SPEED, 0, DISTRIBUTION_IS_UNIFORM, 0.2, 0.3);
    e.request.options.method = PERCUSS_METHOD_CVODE;
    e.request.options.tolerance = 1e-2;
    e.request.bodies[0].velocity[0] = 0.25; /* slides */
    ensemble_lab_run(&e, false);
    assert_true(warns(&e.report, "slide"));
    struct report_material material = {4, e.samples, NULL};
    assert_true(report_create(&stopped, &e.ensemble, &material, &watch));
    assert_int_equal(asked, 1);
    assert_int_equal(stopped.warning_count, e.report.warning_count);
    assert_string_equal(stopped.warnings[0],
                        "samples: 4 of 4, first 0: (no time was left to say why)");
    report_release(&stopped);
    ensemble_lab_close(&e);
}

/* A model with too few modes, as pilots that agree by luck would choose one. */
static void coarse_models_are_warned_of(void **state)
{
    (void)state;
    struct ensemble_lab e;
    ensemble_lab_open(&e);
    e.spec.samples = 200;
    ensemble_lab_run(&e, true);
    assert_false(warns(&e.report, "verification:"));
    report_release(&e.report);
    e.ensemble.model.model.cut *= 0.3;
    ensemble_lab_solve(&e, true);
    assert_true(warns(&e.report, "% of 200 samples solved again by the accuracy search differ by "
                                 "more than the tolerance of 0.001, by up to 0."));
    ensemble_lab_close(&e);
}

/* A tolerance below rounding is not reached, and the search says so. */
static void unreachable_tolerances_are_warned_of(void **state)
{
    (void)state;
    struct ensemble_lab e;
    ensemble_lab_open(&e);
    e.request.options.tolerance = 1e-12;
    e.spec.samples = 4;
    ensemble_lab_run(&e, true);
    assert_int_equal(e.report.verification.unmet, 4);
    assert_true(warns(&e.report, "verification: 4 of 4 samples: the accuracy search itself does "
                                 "not reach the tolerance of 1e-12"));
    ensemble_lab_close(&e);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fast_samples_are_counted),
        cmocka_unit_test(order_and_workers_do_not_matter),
        cmocka_unit_test(waves_left_out_are_counted),
        cmocka_unit_test(losses_are_counted),
        cmocka_unit_test(unstated_yields_are_counted),
        cmocka_unit_test(quiet_and_refused),
        cmocka_unit_test(what_is_quoted_can_be_stopped),
        cmocka_unit_test(coarse_models_are_warned_of),
        cmocka_unit_test(unreachable_tolerances_are_warned_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
