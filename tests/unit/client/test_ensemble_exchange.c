/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* lib/ensemble_exchange.c: the parts of a list of samples as they arrive. */
#include "ensemble_exchange.h"

#include "check.h"

static percuss_v1_EnsembleSamples part_of(uint32_t part, uint32_t parts, double *rows,
                                          uint32_t count)
{
    percuss_v1_EnsembleSamples wire = {.part = part, .parts = parts, .columns = 2};
    wire.rows._buffer = rows;
    wire.rows._length = count;
    return wire;
}

static void parts_are_put_together(void **state)
{
    (void)state;
    struct ensemble_exchange exchange = {.reply = {.samples = 3}};
    double rows[] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
    percuss_v1_EnsembleSamples first = part_of(0, 2, rows, 4), second = part_of(1, 2, rows + 4, 2);
    /* out of turn: not taken */
    ensemble_exchange_add(&exchange, &second);
    assert_int_equal(exchange.numbers, 0);
    ensemble_exchange_add(&exchange, &first);
    assert_false(ensemble_exchange_is_complete(&exchange));
    ensemble_exchange_add(&exchange, &second);
    assert_true(ensemble_exchange_is_complete(&exchange));
    assert_memory_equal(exchange.rows, rows, sizeof rows);
    free(exchange.rows);
}

/* Of no rows, or rows that do not fit their columns. */
static void strange_parts_do_no_harm(void **state)
{
    (void)state;
    struct ensemble_exchange exchange = {.reply = {.samples = 0}};
    double rows[] = {1.0, 2.0, 3.0};
    percuss_v1_EnsembleSamples none = part_of(0, 1, NULL, 0), odd = part_of(0, 1, rows, 3);
    ensemble_exchange_add(&exchange, &odd);
    assert_int_equal(exchange.arrived, 0);
    ensemble_exchange_add(&exchange, &none);
    assert_true(ensemble_exchange_is_complete(&exchange));
    assert_null(exchange.rows);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_are_put_together),
        cmocka_unit_test(strange_parts_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
