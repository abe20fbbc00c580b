/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/indentation.c: the table of the paper's rod 1, its
 * stated errors, branches, an elastic pair, progress, refusals. */
#include <string.h>

#include "check.h"
#include "fe/indentation.h"

static const struct region_input rod_1 = {
    {{"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0}, {"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0}},
    0.015,
    2.5e-5,
    8,
    0.0};

static void make(const struct region_input *input, struct indentation_table *table)
{
    struct fault fault;
    if (indentation_table_make(input, NULL, table, &fault) != PERCUSS_OK)
        fail_msg("%s", fault.text);
}

/* force over Hertz's between points, linear in the logarithm of the indentation */
static double ratio(const struct indentation_table *table, double d)
{
    size_t i = 1;
    while (i + 1 < table->points && table->indentation[i] < d)
        i++;
    double r[2];
    for (size_t k = 0; k < 2; k++)
        r[k] = table->force[i - 1 + k] / pow(table->indentation[i - 1 + k], 1.5) / table->hertz;
    double part =
        log(d / table->indentation[i - 1]) / log(table->indentation[i] / table->indentation[i - 1]);
    return r[0] + part * (r[1] - r[0]);
}

/* Force over Hertz's on a mesh of resolution 16 with steps of 1/4 and 1/8 of a crossing
 * extrapolated and the mesh's elastic error removed, good to 1e-3. */
static void rod_1_is_within_its_stated_error(void **state)
{
    (void)state;
    static const double converged[][2] = {{5e-6, 0.9275}, {1e-5, 0.8460}, {2.4e-5, 0.7188}};
    struct indentation_table table;
    make(&rod_1, &table);
    assert_true(table.force_error > 0.0 && table.force_error < 4e-3);
    assert_true(table.residual_error < 5e-3);
    assert_true(table.recovery_error < 1e-2);
    for (size_t i = 0; i < 3; i++) {
        double got = ratio(&table, converged[i][0]);
        if (!(fabs(got / converged[i][1] - 1.0) < table.force_error + 1e-3))
            fail_msg("at %g: %g, converged %g", converged[i][0], got, converged[i][1]);
    }
    /* Hertz up to point 0, which lies at Jackson and Green's critical indentation, within a
     * crossing */
    assert_true(fabs(table.force[0] / (table.hertz * pow(table.indentation[0], 1.5)) - 1.0) <
                1e-14);
    double modulus = 0.75 * table.hertz / sqrt(0.015);
    double critical = pow(0.5 * M_PI * 1.295 * exp(0.736 * 0.33) * 205e6 / modulus, 2.0) * 0.015;
    assert_true(table.indentation[0] < 1.05 * critical && table.indentation[0] > 0.75 * critical);
    indentation_table_free(&table);
    assert_null(table.force);
}

static void curves_are_monotone_and_joined(void **state)
{
    (void)state;
    struct indentation_table table;
    struct region_input input = rod_1;
    input.resolution = 6;
    input.materials[1].tangent = 2e9;
    make(&input, &table);
    assert_true(table.indentation[table.points - 1] >= input.indentation);
    for (size_t i = 1; i < table.points; i++) {
        assert_true(table.indentation[i] > table.indentation[i - 1]);
        assert_true(table.force[i] > table.force[i - 1]);
        assert_true(table.radius[i] > table.radius[i - 1]);
    }
    assert_true(table.branches > 3);
    assert_true(table.residual[0] == 0.0 && table.largest[0] == table.indentation[0]);
    for (size_t i = 0; i < table.branches; i++) {
        const double *recovery = table.recovery + i * INDENTATION_SAMPLES;
        assert_true(recovery[0] == 0.0 && recovery[INDENTATION_SAMPLES - 1] == 1.0);
        for (size_t j = 1; j < INDENTATION_SAMPLES; j++)
            assert_true(recovery[j] > recovery[j - 1]);
        assert_true(table.residual[i] < table.largest[i]);
        if (i > 0) {
            assert_true(table.residual[i] / table.largest[i] >
                        table.residual[i - 1] / table.largest[i - 1]);
            double on_curve =
                ratio(&table, table.largest[i]) * table.hertz * pow(table.largest[i], 1.5);
            /* the curve bends between its points */
            assert_true(fabs(table.largest_force[i] / on_curve - 1.0) < 3e-3);
        }
    }
    indentation_table_free(&table);
}

static void elastic_pair_has_one_point(void **state)
{
    (void)state;
    struct indentation_table table;
    struct region_input input = rod_1;
    input.resolution = 6;
    input.materials[1].yield = INFINITY;
    make(&input, &table);
    assert_int_equal(table.points, 1);
    assert_int_equal(table.branches, 1);
    assert_true(table.indentation[0] >= input.indentation);
    assert_true(fabs(table.force[0] / (table.hertz * pow(table.indentation[0], 1.5)) - 1.0) <
                1e-14);
    assert_true(table.force_error < 5e-3);
    indentation_table_free(&table);
}

struct told {
    double last;
    size_t calls;
    double stop;
};

static bool tell(void *context, double done)
{
    struct told *told = context;
    assert_true(done >= told->last && done <= 1.0);
    told->last = done;
    told->calls++;
    return done < told->stop;
}

static void tells_progress_and_stops(void **state)
{
    (void)state;
    struct indentation_table table;
    struct region_input input = rod_1;
    struct fault fault;
    struct told told = {.stop = 2.0};
    struct watch watch = {tell, &told};
    input.resolution = 6;
    input.indentation = 3e-6;
    assert_int_equal(indentation_table_make(&input, &watch, &table, &fault), PERCUSS_OK);
    /* asked within the solutions too: a node's crossing takes seconds on a fine mesh */
    assert_true(told.calls >= table.newton_steps && told.last == 1.0);
    indentation_table_free(&table);
    told = (struct told){.stop = 0.2};
    assert_int_equal(indentation_table_make(&input, &watch, &table, &fault), PERCUSS_TIMEOUT);
    assert_true(told.last < 0.4);
    assert_null(table.force);
    input.resolution = 5;
    assert_int_equal(indentation_table_make(&input, NULL, &table, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "resolution: 5"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rod_1_is_within_its_stated_error),
        cmocka_unit_test(curves_are_monotone_and_joined),
        cmocka_unit_test(elastic_pair_has_one_point),
        cmocka_unit_test(tells_progress_and_stops),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
