/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/step_ends.c: moments of forces that begin or end on a step. */
#include "check.h"
#include "impact/step_ends.h"

/* Indentation (s - begin)(end - s)(1 + s/3): zero twice. */
struct bow {
    double begin, end;
};

static double bow_at(const struct bow *bow, double s)
{
    return (s - bow->begin) * (bow->end - s) * (1.0 + s / 3.0);
}

static struct step_values bow_values(const struct bow *bow, double nodes[NODES])
{
    for (int j = 0; j < NODES; j++)
        nodes[j] = bow_at(bow, collocation.node[j]);
    return (struct step_values){bow->begin == 0.0 ? 0.0 : bow_at(bow, 0.0), bow_at(bow, 1.0),
                                nodes};
}

static void forces_at(const struct contact_law *law, const double nodes[NODES], double force[NODES])
{
    double stiffness;
    for (int j = 0; j < NODES; j++)
        force[j] = contact_law_force(law, nodes[j], &stiffness);
}

/* Moment of the law's force between two shares, by the midpoint rule with points that lie close at
 * both ends: s = from + (to - from) x^2 (3 - 2 x). */
static double moment_between(const struct contact_law *law, const struct bow *bow,
                             const double shares[2], int power)
{
    enum { POINTS = 20000 };
    double sum = 0.0;
    for (int i = 0; i < POINTS; i++) {
        double x = (i + 0.5) / POINTS;
        double s = shares[0] + (shares[1] - shares[0]) * x * x * (3.0 - 2.0 * x);
        double stiffness;
        sum += contact_law_force(law, bow_at(bow, s), &stiffness) * pow(s, power) * 6.0 * x *
               (1.0 - x) * (shares[1] - shares[0]) / POINTS;
    }
    return sum;
}

/* The largest difference of the moments of a cubic through these forces, over the impulse. */
static double miss(const struct contact_law *law, const struct bow *bow, const double shares[2],
                   const double force[NODES])
{
    double largest = 0.0;
    double impulse = moment_between(law, bow, shares, 0);
    for (int power = 0; power < 4; power++) {
        double sum = 0.0;
        for (int j = 0; j < NODES; j++)
            sum += collocation.weight[j] * force[j] * pow(collocation.node[j], power);
        largest = fmax(largest, fabs(sum - moment_between(law, bow, shares, power)) / impulse);
    }
    return largest;
}

static void a_beginning_has_its_moments(void **state)
{
    (void)state;
    const struct contact_law law = contact_law_hertz(2.0);
    const struct bow bow = {0.0, 3.0};
    const double shares[2] = {0.0, 1.0};
    double nodes[NODES];
    double force[NODES];
    struct step_end step = {&law, 0.0, bow_values(&bow, nodes)};
    forces_at(&law, nodes, force);
    /* by the nodes alone */
    double before = miss(&law, &bow, shares, force);
    assert_true(before > 1e-5 && before < 1e-3);
    /* the factor of s^(3/2), (1 + ...)^(3/2), is no polynomial: its terms from s^5 on */
    assert_true(step_ends_project(&step, force));
    near(miss(&law, &bow, shares, force), 0.0, 1e-7);
}

/* In a group contacts begin anywhere on a step, also behind its last node. */
static void a_beginning_within_has_its_moments(void **state)
{
    (void)state;
    const struct contact_law law = contact_law_hertz(2.0);
    for (double begin = 0.03; begin < 0.99; begin += 0.0485) {
        const struct bow bow = {begin, 3.0};
        const double shares[2] = {begin, 1.0};
        double nodes[NODES];
        double force[NODES];
        struct step_end step = {&law, 0.0, bow_values(&bow, nodes)};
        forces_at(&law, nodes, force);
        assert_true(miss(&law, &bow, shares, force) > 1e-5);
        near(step_ends_touch(&step.values), begin, 1e-8);
        assert_true(step_ends_project(&step, force));
        near(miss(&law, &bow, shares, force), 0.0, 1e-7);
    }
}

static void an_end_has_its_moments(void **state)
{
    (void)state;
    const struct contact_law law = contact_law_hertz(2.0);
    for (double end = 0.03; end < 1.0; end += 0.0485) {
        const struct bow bow = {-2.0, end};
        const double shares[2] = {0.0, end};
        double nodes[NODES];
        double force[NODES];
        struct step_end step = {&law, 0.0, bow_values(&bow, nodes)};
        forces_at(&law, nodes, force);
        assert_true(miss(&law, &bow, shares, force) > 1e-5);
        /* the secant rule's last round but one is below 1e-7 of the step */
        near(step_ends_release(&step.values), end, 1e-8);
        assert_true(step_ends_project(&step, force));
        near(miss(&law, &bow, shares, force), 0.0, 1e-6);
    }
}

/* With a series compliance c the approach a = d + c F is the smooth one. */
static void a_compliance_leaves_the_approach_smooth(void **state)
{
    (void)state;
    const struct contact_law law = contact_law_hertz(2.0);
    const double c = 0.1;
    double impulse = 0.0;
    double nodes[NODES];
    double force[NODES];
    /* a = s on the step: d + 0.2 d^(3/2) = s, by s as a function of the root of d */
    enum { POINTS = 20000 };
    double root = 1.0;
    for (int i = 0; i < 50; i++)
        root -= (root * root * (1.0 + 2.0 * c * root) - 1.0) / (root * (2.0 + 6.0 * c * root));
    for (int i = 0; i < POINTS; i++) {
        double r = root * (i + 0.5) / POINTS;
        impulse += 2.0 * r * r * r * (2.0 * r + 6.0 * c * r * r) * root / POINTS;
    }
    for (int j = 0; j < NODES; j++) {
        double r = 1.0;
        for (int i = 0; i < 50; i++)
            r -= (r * r * (1.0 + 2.0 * c * r) - collocation.node[j]) / (r * (2.0 + 6.0 * c * r));
        nodes[j] = r * r;
    }
    struct step_end step = {&law, c, {0.0, root * root, nodes}};
    forces_at(&law, nodes, force);
    assert_true(step_ends_project(&step, force));
    double sum = 0.0;
    for (int j = 0; j < NODES; j++)
        sum += collocation.weight[j] * force[j];
    /* the factor of s^(3/2) has a root of s in it, 3 c s^(1/2), of which the quadrature misses 5e-5
     */
    near(sum, impulse, 2e-5 * impulse);
}

static void what_neither_begins_nor_ends_stays(void **state)
{
    (void)state;
    const struct contact_law law = contact_law_hertz(2.0);
    /* closed throughout; begins and ends; the same within; open throughout */
    static const struct bow bows[] = {{-1.0, 2.0}, {0.0, 0.5}, {0.3, 0.6}, {1.5, 2.0}};
    for (size_t i = 0; i < sizeof bows / sizeof *bows; i++) {
        double nodes[NODES];
        double force[NODES] = {1.0, 2.0, 3.0, 4.0};
        struct step_end step = {&law, 0.0, bow_values(&bows[i], nodes)};
        assert_false(step_ends_project(&step, force));
        for (int j = 0; j < NODES; j++)
            assert_true(force[j] == j + 1.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_beginning_has_its_moments),
        cmocka_unit_test(a_beginning_within_has_its_moments),
        cmocka_unit_test(an_end_has_its_moments),
        cmocka_unit_test(a_compliance_leaves_the_approach_smooth),
        cmocka_unit_test(what_neither_begins_nor_ends_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
