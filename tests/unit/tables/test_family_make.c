/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/tools/tables/family_make.c: the mesh's error goes, what is beyond
 * the computed depths follows the powers that are known, nothing gives back more than it took; and
 * the shipped family is what the program computes. */
#include <string.h>

#include "base/arena.h"
#include "check.h"
#include "contact/law_table.h"
#include "store/family_file.h"
#include "tables/family_make.h"

/* A fully plastic contact: force over Hertz's and what springs back like d^(-1/2), area like d,
 * each with an error of first order in the mesh. */
static double plastic(const struct contact_family_place *place, double d)
{
    return (1.0 - place->hardening) * pow(d, -0.5) + place->hardening;
}

static size_t asked[FAMILY_FINE + 1];

static enum percuss_status invented(void *context, const struct contact_family_place *place,
                                    size_t resolution, struct family_point *point,
                                    struct fault *fault)
{
    (void)fault;
    double mesh = 1.0 - *(const double *)context / (double)resolution;
    asked[resolution]++;
    for (size_t i = 0; i < FAMILY_DEPTHS; i++) {
        point->force[i] = plastic(place, family_depth(i)) * mesh;
        point->area[i] = 2.0 * mesh;
    }
    for (size_t i = 0; i < FAMILY_SPRINGS; i++)
        point->back[i] = 0.9 * plastic(place, family_largest(i)) * mesh;
    for (size_t b = 0; b < FAMILY_BRANCHES; b++)
        for (size_t j = 0; j < FAMILY_SAMPLES; j++)
            point->share[b][j] = pow((double)j / (FAMILY_SAMPLES - 1), 1.5);
    return PERCUSS_OK;
}

static void the_mesh_s_error_goes(void **state)
{
    (void)state;
    double order = 0.1;
    struct fault fault = {""};
    struct family_source source = {invented, &order};
    struct family_numbers *numbers = family_numbers_make(&source, &fault);
    assert_non_null(numbers);
    struct contact_family_samples samples = family_numbers_samples(numbers);
    size_t tables = samples.count[0] * samples.count[1] * samples.count[2];
    assert_int_equal(asked[FAMILY_COARSE] + asked[FAMILY_FINE], family_passages());
    assert_int_equal(asked[FAMILY_FINE], family_fine_passages());
    /* of the fine mesh: 0.1/12 */
    near_relative(samples.error, order / FAMILY_FINE / (1.0 - order / FAMILY_FINE), 1e-12);
    for (size_t t = 0; t < tables; t++) {
        struct contact_family_place place = {samples.axis[0][t / 12], 0.0, 0.0};
        for (size_t i = 0; i < samples.depths; i++) {
            double expected = plastic(&place, samples.depth[i]);
            bool powers = samples.depth[i] <= samples.computed || place.hardening == 0.0;
            if (powers)
                near_relative(samples.force[t * samples.depths + i], expected, 1e-9);
            if (place.hardening < 1.0)
                near_relative(samples.area[t * samples.depths + i], 2.0, 1e-9);
        }
        for (size_t i = 0; i < samples.springs && place.hardening < 1.0; i++)
            if (samples.largest[i] > 5.0 && samples.largest[i] <= samples.computed)
                near_relative(samples.back[t * samples.springs + i],
                              0.9 * plastic(&place, samples.largest[i]), 1e-9);
    }
    struct contact_family *family = contact_family_create(&samples, &fault);
    if (!family)
        fail_msg("%s", fault.text);
    contact_family_free(family);
    family_numbers_free(numbers);
}

static enum percuss_status stopped(void *context, const struct contact_family_place *place,
                                   size_t resolution, struct family_point *point,
                                   struct fault *fault)
{
    size_t *left = context;
    double order = 0.0;
    if (--*left == 0)
        return fault_set(fault, PERCUSS_INTERNAL, "no equilibrium");
    return invented(&order, place, resolution, point, fault);
}

static void a_point_that_fails_ends_it(void **state)
{
    (void)state;
    for (size_t when = 1; when < 20; when += 6) {
        size_t left = when;
        struct fault fault = {""};
        struct family_source source = {stopped, &left};
        assert_null(family_numbers_make(&source, &fault));
        assert_string_equal(fault.text, "no equilibrium");
        assert_int_equal(left, 0);
    }
}

static struct family_point *compute(const struct contact_family_place *place)
{
    struct indentation_run *runs = calloc(2, sizeof *runs);
    struct family_point *point = calloc(1, sizeof *point);
    struct fault fault = {""};
    struct region_input input = family_input(place, FAMILY_COARSE);
    assert_true(runs && point);
    for (size_t i = 0; i < 2; i++) {
        struct indentation_plan plan = {input, FAMILY_LONG << i, i * FAMILY_BRANCH_EVERY, 0.0, 1.0,
                                        NULL};
        if (indentation_run(&plan, &runs[i], &fault))
            fail_msg("%s", fault.text);
    }
    assert_true(family_point_fill(&runs[0], &runs[1], &input, point));
    free(runs);
    return point;
}

/* Two places of the greatest hardening, whose passages are the shortest: they lie in the file as
 * far apart as they are computed. Seven digits in the file. */
static void the_shipped_family_is_what_the_program_computes(void **state)
{
    (void)state;
    static const struct contact_family_place places[] = {{0.3, 0.3, 0.7}, {0.3, 0.3, 1.0}};
    struct fault fault;
    struct contact_family *family =
        family_file_load(PERCUSS_SOURCE_DIR "/config/tables/" FAMILY_FILE_NAME, &fault);
    if (!family)
        fail_msg("%s", fault.text);
    struct arena arena = {0};
    struct family_point *points[2];
    const struct contact_curves *curves[2];
    for (size_t i = 0; i < 2; i++) {
        points[i] = compute(&places[i]);
        curves[i] = contact_family_curves(family, &places[i], &arena);
    }
    for (size_t i = 0; i < FAMILY_DEPTHS; i++) {
        double slope, d = family_depth(i);
        double ratio =
            spline_at(&curves[1]->loading, d, &slope) / spline_at(&curves[0]->loading, d, &slope);
        near_relative(ratio, curves_two_thirds(points[1]->force[i] / points[0]->force[i]), 1e-6);
    }
    for (size_t i = 0; i < FAMILY_SPRINGS; i++) {
        double slope, at = log(family_largest(i));
        double ratio =
            spline_at(&curves[1]->spring, at, &slope) / spline_at(&curves[0]->spring, at, &slope);
        /* where dents begin the file loses what a contact would have gained */
        if (family_largest(i) > 2.0)
            near_relative(ratio, points[1]->back[i] / points[0]->back[i], 1e-6);
    }
    free(points[0]);
    free(points[1]);
    arena_release(&arena);
    contact_family_free(family);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mesh_s_error_goes),
        cmocka_unit_test(a_point_that_fails_ends_it),
        cmocka_unit_test(the_shipped_family_is_what_the_program_computes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
