/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/store/table_key.c: what the key depends on, how deep a table goes. */
#include "unit/store/small_table.h"

static struct region_input sample(void)
{
    return (struct region_input){.materials = {small_steel, small_soft},
                                 .radius = 0.015,
                                 .indentation = 8e-6,
                                 .resolution = 6};
}

static void expect_other(const struct region_input *changed)
{
    struct region_input input = sample();
    char before[TABLE_KEY_SIZE], after[TABLE_KEY_SIZE];
    table_key(&input, before);
    table_key(changed, after);
    assert_int_equal(strlen(before), TABLE_KEY_SIZE - 1);
    assert_string_not_equal(before, after);
}

static void every_input_changes_the_key(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        static const size_t offsets[] = {
            offsetof(struct material, young), offsetof(struct material, poisson),
            offsetof(struct material, yield), offsetof(struct material, tangent)};
        for (size_t k = 0; k < 4; k++) {
            struct region_input input = sample();
            double *value = (double *)((char *)&input.materials[i] + offsets[k]);
            *value = isinf(*value) ? 1e12 : nextafter(*value, INFINITY);
            expect_other(&input);
        }
    }
    struct region_input input = sample();
    input.radius = nextafter(input.radius, 1.0);
    expect_other(&input);
    input = sample();
    input.indentation = nextafter(input.indentation, 1.0);
    expect_other(&input);
    input = sample();
    input.resolution++;
    expect_other(&input);
}

static void names_densities_and_the_order_do_not(void **state)
{
    (void)state;
    struct region_input input = sample(), other = sample();
    snprintf(other.materials[0].name, sizeof other.materials[0].name, "stahl");
    other.materials[1].density = 1.0;
    char before[TABLE_KEY_SIZE], after[TABLE_KEY_SIZE];
    table_key(&input, before);
    table_key(&other, after);
    assert_string_equal(before, after);
    other.materials[0] = input.materials[1];
    other.materials[1] = input.materials[0];
    table_key(&other, after);
    assert_string_equal(before, after);
}

static void numbers_change_the_content_key(void **state)
{
    (void)state;
    char before[TABLE_KEY_SIZE], after[TABLE_KEY_SIZE];
    table_content_key(&small_table, before);
    double *numbers[] = {&small_table.hertz,       &small_table.force_error,
                         &small_table.force[2],    &small_table.indentation[1],
                         &small_table.radius[3],   &small_table.largest[1],
                         &small_table.residual[1], &small_table.recovery[INDENTATION_SAMPLES + 3]};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        double kept = *numbers[i];
        *numbers[i] = nextafter(kept, INFINITY);
        table_content_key(&small_table, after);
        assert_string_not_equal(before, after);
        *numbers[i] = kept;
    }
}

/* The paper's sphere at 0.5 m/s on rod 1 goes 23 um deep: within the table for that speed. An
 * elastic pair: Hertz, (5/4 m v^2 / k)^(2/5). */
static void a_table_is_as_deep_as_its_speed_asks(void **state)
{
    (void)state;
    struct region_input input = table_input(&small_soft, &small_steel, 0.5);
    assert_true(input.indentation / input.radius > 23e-6 / 0.015);
    assert_true(input.indentation / input.radius < 2 * 23e-6 / 0.015);
    struct region_input faster = table_input(&small_soft, &small_steel, 1.0);
    assert_true(faster.indentation > 1.5 * input.indentation);
    struct region_input most = table_input(&small_soft, &small_steel, 100.0);
    assert_true(most.indentation == 0.02 * most.radius);

    input = table_input(&small_steel, &small_steel, 1.0);
    double mass = 4.0 / 3.0 * M_PI * 1e-6 * 7800.0;
    double k = 4.0 / 3.0 * 210e9 / (1.0 - 0.09) / 2.0 * sqrt(0.01);
    assert_true(fabs(input.indentation / (1.25 * pow(1.25 * mass / k, 0.4)) - 1.0) < 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_input_changes_the_key),
        cmocka_unit_test(names_densities_and_the_order_do_not),
        cmocka_unit_test(numbers_change_the_content_key),
        cmocka_unit_test(a_table_is_as_deep_as_its_speed_asks),
    };
    return cmocka_run_group_tests(tests, make_small_table, free_small_table);
}
