/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/step_table.c: the ladder of steps and tables that hold the
 * oscillators' maps bit by bit. */
#include "check.h"
#include "impact/oscillator.h"
#include "impact/step_table.h"

static const double omegas[] = {10.0, 200.0, 3e3, 4e4, 5e5, 6e6};
enum { MODES = 6 };

static void the_ladder_halves(void **state)
{
    (void)state;
    for (int level = 0; level < STEP_LEVELS; level++) {
        assert_true(step_length(level) == ldexp(1.0, -level));
        assert_int_equal(step_level(step_length(level)), level);
        /* the finest level whose step is not longer: just below one, the next */
        int below = step_level(nextafter(step_length(level), 0.0));
        assert_int_equal(below, level + 1 < STEP_LEVELS ? level + 1 : level);
        assert_int_equal(step_level(1.5 * step_length(level)), level);
    }
    assert_int_equal(step_level(100.0), 0);
    assert_int_equal(step_level(1e-30), STEP_LEVELS - 1);
}

static void tables_hold_the_maps(void **state)
{
    (void)state;
    const double damping[MODES] = {0.02, 0.0, 0.5, 1e-3, 0.02, 0.1};
    struct oscillators *set = oscillators_create_each(MODES, omegas, damping);
    assert_non_null(set);
    assert_int_equal(set->stride, 8);
    assert_true(set->most_damping == 0.5);
    for (int level = 8; level < 24; level += 5) {
        const struct step_table *table = oscillators_table(set, level);
        assert_non_null(table);
        assert_ptr_equal(table, oscillators_table(set, level));
        double h = step_length(level);
        for (size_t k = 0; k < MODES; k++) {
            double to_q[NODES + 2], to_v[NODES + 2];
            const double *response = table->response + k * RESPONSE_TERMS;
            for (int i = 0; i < NODES; i++) {
                oscillator_map(omegas[k], damping[k], h, collocation.node[i], to_q, to_v);
                assert_true(table->node_q[i][k] == to_q[0] && table->node_v[i][k] == to_q[1]);
                /* places together have the series of the one that needs most terms */
                for (int j = 0; j < NODES; j++)
                    near(response[i * NODES + j], to_q[2 + j],
                         1e-15 * h * fmin(h, 1.0 / omegas[k]));
            }
            oscillator_map(omegas[k], damping[k], h, 1.0, to_q, to_v);
            assert_true(table->end_qq[k] == to_q[0] && table->end_qv[k] == to_q[1]);
            assert_true(table->end_vq[k] == to_v[0] && table->end_vv[k] == to_v[1]);
            for (int j = 0; j < NODES; j++)
                assert_true(table->force_q[j][k] == to_q[2 + j] &&
                            response[NODES * NODES + j] == to_q[2 + j] &&
                            table->force_v[j][k] == to_v[2 + j]);
            double form[LOSS_INPUTS][LOSS_INPUTS];
            oscillator_loss_form(omegas[k], damping[k], h, form);
            for (int r = 0, term = 0; r < LOSS_INPUTS; r++)
                for (int s = 0; s <= r; s++, term++)
                    assert_true(table->loss[term][k] == form[r][s]);
        }
    }
    oscillators_free(set);
}

/* Turns are free motions; what a force does at the middle is what it does at the end, turned back.
 */
static void middles_hold_turns(void **state)
{
    (void)state;
    static const double steps[] = {0.5, 1.0, 0.75, 1.5};
    struct oscillators *set = oscillators_create(MODES, omegas, 0.0);
    assert_non_null(set);
    for (int level = 8; level < 24; level += 5) {
        const struct step_table *table = oscillators_table(set, level);
        double h = step_length(level);
        assert_non_null(table);
        for (size_t k = 0; k < MODES; k++) {
            const double *term = table->middle + k / LANES * LANES * MIDDLE_TERMS + k % LANES;
            for (int i = 0; i < 4; i++) {
                const double *turn = term + (TURN_HALF + 3 * i) * LANES;
                double q = 0.0, v = omegas[k];
                oscillator_advance(omegas[k], 0.0, steps[i] * h, &q, &v);
                near(turn[LANES] * omegas[k], q, 1e-15);
                near(turn[0], v / omegas[k], 1e-15);
                near(turn[2 * LANES], -q * omegas[k], 1e-15 * omegas[k]);
            }
            for (int j = 0; j < NODES; j++) {
                int pair = j < 2 ? j : NODES - 1 - j;
                double x = (collocation.node[j] - 0.5) * h, to_q[NODES + 2], to_v[NODES + 2];
                double cosine = term[(MIDDLE_COSINE + pair) * LANES];
                double sine = term[(MIDDLE_SINE + pair) * LANES] * (j < 2 ? -1.0 : 1.0);
                double q = term[(MIDDLE_KICK_Q + pair) * LANES] * (j < 2 ? -1.0 : 1.0);
                double v = term[(MIDDLE_KICK_V + pair) * LANES];
                near(cosine, cos(omegas[k] * x), 1e-14 * (1.0 + omegas[k] * h));
                near(sine * omegas[k], sin(omegas[k] * x), 1e-14 * (1.0 + omegas[k] * h));
                oscillator_map(omegas[k], 0.0, h, 1.0, to_q, to_v);
                double back = -0.5 * h;
                oscillator_advance(omegas[k], 0.0, back, &to_q[2 + j], &to_v[2 + j]);
                /* a force of one for a time h */
                near(v, to_v[2 + j], 1e-14 * h);
                near(q, to_q[2 + j], 1e-14 * h * fmin(h, 1.0 / omegas[k]));
            }
        }
    }
    oscillators_free(set);
}

/* Vector loops read whole lanes: padding must be zero and rows aligned. */
static void padding_is_zero(void **state)
{
    (void)state;
    struct oscillators *set = oscillators_create(MODES, omegas, 0.0);
    assert_non_null(set);
    const struct step_table *table = oscillators_table(set, 12);
    assert_non_null(table);
    const double *rows[] = {table->node_q[0],  table->node_v[3],  table->end_qq,  table->end_vv,
                            table->force_q[1], table->force_v[2], table->response};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_int_equal((uintptr_t)rows[i] % 32, 0);
        for (size_t k = MODES; rows[i] != table->response && k < set->stride; k++)
            assert_true(rows[i][k] == 0.0);
    }
    assert_null(table->loss[0]); /* undamped: none */
    assert_int_equal((uintptr_t)table->middle % 32, 0);
    for (size_t i = MODES * RESPONSE_TERMS; i < set->stride * RESPONSE_TERMS; i++)
        assert_true(table->response[i] == 0.0);
    for (int term = 0; term < MIDDLE_TERMS; term++)
        for (size_t k = MODES; k < set->stride; k++)
            assert_true(table->middle[LANES * MIDDLE_TERMS + term * LANES + (int)(k % LANES)] ==
                        0.0);
    oscillators_free(set);
    oscillators_free(NULL);
}

/* Some of a set's oscillators have the whole's numbers. */
static void a_part_has_the_tables_of_the_whole(void **state)
{
    (void)state;
    const size_t which[] = {0, 2, 3, 5};
    const double damping[MODES] = {0.02, 0.3, 0.0, 1e-3, 0.02, 0.1};
    struct oscillators *whole = oscillators_create_each(MODES, omegas, damping);
    struct oscillators *part = oscillators_part(whole, which, 4);
    assert_non_null(part);
    assert_int_equal(part->stride, 4);
    const struct step_table *some = oscillators_table(part, 15);
    const struct step_table *all = oscillators_table(whole, 15);
    assert_non_null(some);
    for (size_t i = 0; i < 4; i++) {
        size_t k = which[i];
        assert_true(part->omega[i] == omegas[k] && part->damping[i] == damping[k]);
        assert_true(some->node_q[3][i] == all->node_q[3][k]);
        assert_true(some->end_qv[i] == all->end_qv[k] && some->end_vv[i] == all->end_vv[k]);
        assert_true(some->force_v[2][i] == all->force_v[2][k]);
        for (size_t term = 0; term < RESPONSE_TERMS; term++)
            assert_true(some->response[i * RESPONSE_TERMS + term] ==
                        all->response[k * RESPONSE_TERMS + term]);
        assert_true(some->loss[LOSS_TERMS - 1][i] == all->loss[LOSS_TERMS - 1][k]);
    }
    assert_true(part->most_damping == 0.1);
    oscillators_free(part);
    oscillators_free(whole);
}

/* The first ones asked for, then more: the numbers of all at once, of a part as well. */
static void tables_grow(void **state)
{
    (void)state;
    static const size_t which[] = {1, 2, 4, 5}, counts[] = {2, 1, 5, 6};
    for (int damped = 0; damped < 2; damped++) {
        struct oscillators *grown = oscillators_create(MODES, omegas, 0.1 * damped);
        struct oscillators *whole = oscillators_create(MODES, omegas, 0.1 * damped);
        struct oscillators *part = oscillators_part(grown, which, 4);
        struct oscillators *whole_part = oscillators_part(whole, which, 4);
        assert_true(grown && whole && part && whole_part);
        for (int i = 0; i < 4; i++) {
            size_t some = counts[i] < 4 ? counts[i] : 4;
            assert_int_equal(oscillators_prepare(part, some, 14, NULL), PERCUSS_OK);
            assert_int_equal(oscillators_prepare(grown, counts[i], 14, NULL), PERCUSS_OK);
        }
        const struct step_table *tables[2][2] = {
            {oscillators_table(grown, 14), oscillators_table(whole, 14)},
            {oscillators_table(part, 14), oscillators_table(whole_part, 14)}};
        for (int i = 0; i < 2; i++) {
            size_t arrays = 20 + RESPONSE_TERMS + (damped ? LOSS_TERMS : MIDDLE_TERMS);
            assert_memory_equal(tables[i][0]->node_q[0], tables[i][1]->node_q[0],
                                arrays * (i ? part : grown)->stride * sizeof(double));
        }
        oscillators_free(part);
        oscillators_free(whole_part);
        oscillators_free(grown);
        oscillators_free(whole);
    }
}

static void an_empty_set_is_a_set(void **state)
{
    (void)state;
    struct oscillators *set = oscillators_create(0, omegas, 0.1);
    assert_non_null(set);
    assert_int_equal(set->stride, 0);
    assert_non_null(oscillators_table(set, 10));
    oscillators_free(set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_ladder_halves),
        cmocka_unit_test(tables_hold_the_maps),
        cmocka_unit_test(middles_hold_turns),
        cmocka_unit_test(padding_is_zero),
        cmocka_unit_test(a_part_has_the_tables_of_the_whole),
        cmocka_unit_test(tables_grow),
        cmocka_unit_test(an_empty_set_is_a_set),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
