/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/contact/law_table.c: a table sampled from the closed form follows it, its curves
 * fit together, bad samples are refused. */
#include <string.h>

#include "check.h"
#include "contact/law_closed_form.h"
#include "unit/contact/sampled_table.h"

static struct contact_law closed_form(void)
{
    static const struct material steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
    static const struct material soft = {"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0};
    struct hertz_contact hertz =
        hertz_contact_make(hertz_effective_modulus(&steel, &soft), 0.5 / 0.015, 0.5 / 0.015);
    return contact_law_closed_form(&hertz, &steel, &soft);
}

struct pair {
    struct contact_law closed, table;
    struct contact_curves *curves;
};

static struct pair make_pair(void)
{
    static struct sampled_table sampled;
    struct fault fault = {0};
    struct pair pair = {.closed = closed_form()};
    sampled_table_make(&sampled, &pair.closed, 100.0);
    contact_curves_create(&sampled.table, &pair.curves, &fault);
    if (!pair.curves)
        fail_msg("%s", fault.text);
    pair.table = contact_law_table(pair.curves);
    return pair;
}

static void a_sampled_table_follows_its_law(void **state)
{
    (void)state;
    struct pair pair = make_pair();
    double range = contact_curves_range(pair.curves);
    double slopes[2];
    near_relative(contact_curves_error(pair.curves), 1e-3, 0.0);
    /* 60 points: the law's own bend between Hertz and the second piece limits it */
    for (double d = 1e-9; d < range; d *= 1.03) {
        double force = contact_law_force(&pair.closed, d, &slopes[0]);
        near_relative(contact_law_force(&pair.table, d, &slopes[1]), force, 5e-4);
        near_relative(slopes[1], slopes[0], 1e-2);
        near_relative(pair.table.operations->stored(&pair.table, d),
                      pair.closed.operations->stored(&pair.closed, d), 5e-4);
    }
    /* and the branches, between those sampled too */
    for (double d = 1.4e-6; d < range; d *= 1.3) {
        struct contact_law closed = pair.closed, table = pair.table;
        double whole = closed.operations->stored(&closed, d);
        double lost = contact_law_yield(&closed, d);
        /* of the whole work: twelve branches resolve the onset of yield to some 0.5 % */
        near_relative(whole + contact_law_yield(&table, d), whole + lost, 6e-3);
        if (d > 3e-6)
            near_relative(contact_law_limit(&table), contact_law_limit(&closed), 6e-3);
        double span = contact_law_limit(&table);
        for (double x = 0.05; x < 1.0; x += 0.05)
            near_relative(contact_law_force(&table, x * span, &slopes[0]) / table.history.max_force,
                          x * sqrt(x), 1e-3);
    }
    contact_curves_free(pair.curves);
}

static void its_curves_fit_together(void **state)
{
    (void)state;
    struct pair pair = make_pair();
    struct contact_law law = pair.table;
    for (int loads = 0; loads < 4; loads++) {
        double before = 0.0;
        for (double d = 1e-8; d < 4e-4; d *= 1.02) {
            double slope, ignored;
            double step = 1e-6 * d;
            double force = contact_law_force(&law, d, &slope);
            double above = contact_law_force(&law, d + step, &ignored);
            double below = contact_law_force(&law, d - step, &ignored);
            const struct contact_law_operations *of = law.operations;
            assert_true(force > before);
            before = force;
            /* at once as one by one, on the branch and beyond it */
            const double places[CONTACT_LAW_AT_ONCE] = {d + step, -d, d, 30.0 * d};
            double together[CONTACT_LAW_AT_ONCE], slopes[CONTACT_LAW_AT_ONCE];
            contact_law_forces(&law, places, together, slopes);
            assert_true(together[0] == above && together[2] == force && slopes[2] == slope);
            assert_true(together[1] == 0.0 && slopes[1] == 0.0);
            assert_true(together[3] == contact_law_force(&law, places[3], &ignored));
            if (fabs(d - contact_law_limit(&law)) < 2.0 * step && loads)
                continue;
            /* differences over steps of 1e-6: rounding */
            near_relative(slope, (above - below) / (2.0 * step), 1e-6);
            double power = (of->stored(&law, d + step) - of->stored(&law, d - step)) / (2.0 * step);
            near_relative(power, force, 1e-6);
            near_relative(of->indentation(&law, force), d, 1e-9);
        }
        /* the second one beyond the table */
        contact_law_yield(&law, 2e-5 + 1e-4 * loads - law.history.dent);
        assert_true(law.history.dent < law.history.max_indentation);
    }
    contact_curves_free(pair.curves);
}

static void an_elastic_table_never_yields(void **state)
{
    (void)state;
    static struct sampled_table sampled;
    struct fault fault = {0};
    struct contact_law closed = closed_form();
    sampled_table_make(&sampled, &closed, 100.0);
    sampled.table.branches = 0;
    struct contact_curves *curves;
    contact_curves_create(&sampled.table, &curves, &fault);
    assert_non_null(curves);
    struct contact_law law = contact_law_table(curves);
    double slope;
    assert_true(isinf(contact_law_limit(&law)));
    near_relative(law.operations->indentation(&law, contact_law_force(&law, 3e-5, &slope)), 3e-5,
                  1e-12);
    contact_curves_free(curves);
}

static void bad_samples_are_refused(void **state)
{
    (void)state;
    static struct sampled_table sampled;
    struct contact_law closed = closed_form();
    for (int bad = 0; bad < 7; bad++) {
        struct fault fault = {0};
        struct contact_curves *curves;
        sampled_table_make(&sampled, &closed, 100.0);
        switch (bad) {
        case 0:
            sampled.force[7] = sampled.force[6];
            break;
        case 1:
            sampled.indentation[0] = 1e-9;
            break;
        case 2:
            sampled.residual[3] = sampled.largest[3];
            break;
        case 3:
            sampled.largest[5] = sampled.largest[4];
            break;
        case 4:
            sampled.share[2][4] = NAN;
            break;
        case 5:
            sampled.table.points = 2;
            break;
        default:
            sampled.table.yield = sampled.largest[0];
            break;
        }
        assert_int_equal(contact_curves_create(&sampled.table, &curves, &fault),
                         PERCUSS_BAD_REQUEST);
        assert_null(curves);
        assert_true(strlen(fault.text) > 20);
    }
    contact_curves_free(NULL);
}

/* Third derivative of the force, which is a cubic to the power 3/2 there, on one side of a place.
 */
static double third(const struct contact_law *law, double d, double step)
{
    double slope;
    return (contact_law_force(law, d + 3.0 * step, &slope) -
            3.0 * contact_law_force(law, d + 2.0 * step, &slope) +
            3.0 * contact_law_force(law, d + step, &slope) - contact_law_force(law, d, &slope)) /
           (step * step * step);
}

/* The knots on the way up, against differences: of step 1e-4 d, whose rounding is 1e-4 of F/d^3,
 * and which miss 3e-4 of a fourth derivative. Down they are the same, with the other sign. */
static size_t check_knots(const struct contact_law *law, double from, double to)
{
    double roughest = 0.0;
    struct contact_knot up[CONTACT_KNOTS], down[CONTACT_KNOTS];
    size_t count = law->operations->curve->knots(law, from, to, up);
    assert_true(count < CONTACT_KNOTS);
    assert_int_equal(law->operations->curve->knots(law, to, from, down), count);
    for (size_t i = 0; i < count; i++) {
        double d = up[i].indentation;
        double slope;
        double jump = third(law, d, 1e-4 * d) - third(law, d, -1e-4 * d);
        assert_true(d > from && d < to && (i == 0 || d > up[i - 1].indentation));
        double unit = contact_law_force(law, d, &slope) / (d * d * d);
        near(6.0 * up[i].cube / unit, jump / unit, 0.02 * fabs(jump / unit) + 0.01);
        roughest = fmax(roughest, fabs(jump / unit));
        near_relative(down[count - 1 - i].indentation, d, 1e-14);
        near_relative(down[count - 1 - i].cube, -up[i].cube, 1e-14);
    }
    assert_true(roughest > 1.0);
    return count;
}

static void its_knots_are_where_it_jumps(void **state)
{
    (void)state;
    static struct sampled_table sampled;
    struct fault fault = {0};
    struct contact_curves *curves;
    struct contact_law closed = closed_form();
    sampled_table_make(&sampled, &closed, 100.0);
    for (int i = 5; i < SAMPLED_POINTS; i += 2)
        sampled.force[i] *= 1.0 + 1e-3;
    for (int b = 0; b < SAMPLED_BRANCHES; b++)
        for (int i = 3; i + 1 < SAMPLED_SHARES; i += 2)
            sampled.share[b][i] *= 1.0 + 1e-3;
    assert_int_equal(contact_curves_create(&sampled.table, &curves, &fault), PERCUSS_OK);
    struct contact_law law = contact_law_table(curves);
    const double *place = sampled.indentation;
    /* all places on the way, but for that where it begins */
    assert_int_equal(check_knots(&law, place[8], place[20]), 11);
    /* a branch, down from its top also where rounding has it beyond */
    contact_law_yield(&law, place[20]);
    double span = contact_law_limit(&law);
    assert_int_equal(check_knots(&law, 0.2 * span, 0.9 * span), 11);
    struct contact_knot knots[CONTACT_KNOTS];
    assert_int_equal(law.operations->curve->knots(&law, span * (1.0 + 1e-15), 0.8 * span, knots),
                     3);
    near_relative(knots[0].indentation, span * 15.0 / 16.0, 1e-14);
    contact_curves_free(curves);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sampled_table_follows_its_law),
        cmocka_unit_test(its_curves_fit_together),
        cmocka_unit_test(its_knots_are_where_it_jumps),
        cmocka_unit_test(an_elastic_table_never_yields),
        cmocka_unit_test(bad_samples_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
