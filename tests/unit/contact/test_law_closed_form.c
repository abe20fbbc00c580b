/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/contact/law_closed_form.c and plastic.c: the loading curve is smooth and rises,
 * branches lead back to it, and every loop dissipates its area. */
#include "check.h"
#include "contact/law_closed_form.h"
#include "contact/plastic.h"

static const struct material steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
static const struct material soft = {"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0};
static const struct material hard = {"al-575", 70e9, 0.33, 2700.0, 575e6, 0.0};

/* The paper's sphere on a plane. */
static struct hertz_contact sphere_on(const struct material *plane)
{
    return hertz_contact_make(hertz_effective_modulus(&steel, plane), 0.5 / 0.015, 0.5 / 0.015);
}

static struct contact_law law_on(const struct material *plane)
{
    struct hertz_contact hertz = sphere_on(plane);
    return contact_law_closed_form(&hertz, &steel, plane);
}

static double force_at(const struct contact_law *law, double d)
{
    double slope;
    return contact_law_force(law, d, &slope);
}

/* Work from one indentation to another by the trapezoidal rule with 1e5 points. */
static double work(const struct contact_law *law, double from, double to)
{
    const int points = 100000;
    double sum = 0.5 * (force_at(law, from) + force_at(law, to));
    for (int i = 1; i < points; i++)
        sum += force_at(law, from + (to - from) * i / points);
    return sum * (to - from) / points;
}

static void loading_is_hertz_then_the_published_curve(void **state)
{
    (void)state;
    struct hertz_contact hertz = sphere_on(&soft);
    struct contact_law law = law_on(&soft);
    struct contact_law elastic = contact_law_hertz(hertz.stiffness);
    double yield = closed_form_yield(&hertz, &steel, &soft);
    /* (pi 1.651016 205e6 / (2 5.8610e10))^2 0.015 */
    near_relative(yield, 1.23444e-6, 1e-5);
    for (double w = 0.01; w <= 1.9; w += 0.05)
        assert_true(force_at(&law, w * yield) == force_at(&elastic, w * yield));
    /* F over Hertz's, by the formula in another program */
    static const double published[][2] = {{3.8, 0.9309060305301421},   {5.0, 0.9000448407900946},
                                          {8.0, 0.8418841697715741},   {16.0, 0.7448759590753382},
                                          {50.0, 0.5649594445865177},  {200.0, 0.3443146538487319},
                                          {1000.0, 0.1504591120488886}};
    for (size_t i = 0; i < sizeof published / sizeof *published; i++) {
        double d = published[i][0] * yield;
        near_relative(force_at(&law, d) / force_at(&elastic, d), published[i][1], 1e-12);
    }
}

static void value_and_slope_are_continuous(void **state)
{
    (void)state;
    static const struct material *const planes[] = {&soft, &hard};
    for (int p = 0; p < 2; p++) {
        struct hertz_contact hertz = sphere_on(planes[p]);
        struct contact_law law = law_on(planes[p]);
        double yield = closed_form_yield(&hertz, &steel, planes[p]);
        static const double joints[] = {1.0, 1.9, 3.8};
        for (int i = 0; i < 3; i++) {
            double slope[2];
            double below = contact_law_force(&law, joints[i] * yield * (1 - 1e-9), slope);
            double above = contact_law_force(&law, joints[i] * yield * (1 + 1e-9), slope + 1);
            near_relative(above, below, 4e-9);
            near_relative(slope[1], slope[0], 1e-7);
        }
        double before = 0.0;
        for (double d = 1e-9; d < 1e-2; d *= 1.01) {
            double slope;
            double force = contact_law_force(&law, d, &slope);
            double step = 1e-5 * d;
            assert_true(force > before);
            /* central differences: second order */
            near_relative(
                slope, (force_at(&law, d + step) - force_at(&law, d - step)) / (2.0 * step), 1e-8);
            near_relative(law.operations->indentation(&law, force), d, 1e-13);
            before = force;
        }
    }
}

static void stored_energy_is_the_area(void **state)
{
    (void)state;
    struct contact_law law = law_on(&soft);
    /* trapezoids: (1e-5)^2 times the bend, and the root at 0 */
    for (double d = 1e-6; d < 1e-3; d *= 3.0)
        near_relative(law.operations->stored(&law, d), work(&law, 0.0, d), 1e-7);
    /* the rule itself, against its own value with the range halved */
    double whole = law.operations->stored(&law, 2e-4);
    double rate = (law.operations->stored(&law, 2e-4 * (1 + 1e-4)) -
                   law.operations->stored(&law, 2e-4 * (1 - 1e-4))) /
                  (2e-4 * 2e-4);
    assert_true(whole > 0.0);
    near_relative(rate, force_at(&law, 2e-4), 1e-7);
}

static void a_loop_dissipates_its_area(void **state)
{
    (void)state;
    struct contact_law law = law_on(&soft);
    static const double peaks[] = {2e-6, 5e-6, 2e-5, 2.5e-5, 1e-4, 2e-3};
    for (size_t i = 0; i < sizeof peaks / sizeof *peaks; i++) {
        double residual = law.history.dent;
        double peak = peaks[i] - residual;
        assert_true(peak > contact_law_limit(&law));
        double loading = work(&law, 0.0, peak);
        double lost = contact_law_yield(&law, peak);
        double deeper = law.history.dent - residual;
        near_relative(lost, loading - work(&law, 0.0, peak - deeper), 1e-6);
        near_relative(law.history.max_indentation, peaks[i], 1e-15);
        assert_true(deeper > 0.0 && law.history.dent < peaks[i]);
        assert_true(law.history.contact_radius > sqrt(0.9 * 0.015 * peaks[i]));
    }
}

static void reloading_follows_the_branch_then_the_virgin_curve(void **state)
{
    (void)state;
    const struct contact_law virgin = law_on(&soft);
    struct contact_law law = virgin;
    contact_law_yield(&law, 1e-5);
    double span = contact_law_limit(&law);
    near_relative(span, 1e-5 - law.history.dent, 1e-14);
    near_relative(law.history.max_force, force_at(&virgin, 1e-5), 1e-15);
    near_relative(force_at(&law, span), law.history.max_force, 1e-14);
    for (double x = 0.1; x < 1.0; x += 0.1)
        near_relative(force_at(&law, x * span), law.history.max_force * x * sqrt(x), 1e-12);
    for (double d = 1.01e-5; d < 1e-3; d *= 2.0)
        near_relative(force_at(&law, d - law.history.dent), force_at(&virgin, d), 1e-12);
    /* within the elastic range nothing is remembered to be lost: the same force, the same energy */
    near_relative(law.operations->stored(&law, span), 0.4 * law.history.max_force * span, 1e-14);
}

/* Hertz's part stays what it is where the stress of yield is another one; what stays then is that
 * of the metal which yields so. */
static void rescaled_it_yields_later(void **state)
{
    (void)state;
    const double more = 1.3;
    struct material harder = soft;
    harder.yield *= more;
    struct contact_law law = law_on(&soft);
    struct contact_law rescaled = contact_law_rescaled(&law, 1.0, more);
    struct contact_law other = law_on(&harder);
    const struct plastic_curve *curve = law.operations->curve;
    near_relative(curve->yield(&rescaled), curve->yield(&other), 1e-15);
    for (double w = 0.1; w < 3000.0; w *= 1.7) {
        double d = w * curve->yield(&law);
        near_relative(curve->residual(&rescaled, d) + d, curve->residual(&other, d) + d, 1e-12);
        /* but for the growth of the radius, whose exponent has 23 yields over E* in it */
        near_relative(force_at(&rescaled, d), force_at(&other, d), 0.01);
    }
    struct contact_law stiffer = contact_law_rescaled(&law, 1.1, 1.0);
    near_relative(force_at(&stiffer, 1e-5), 1.1 * force_at(&law, 1e-5), 1e-15);
}

static void what_stays_grows_from_nothing(void **state)
{
    (void)state;
    struct hertz_contact hertz = sphere_on(&soft);
    double yield = closed_form_yield(&hertz, &steel, &soft);
    double before = 0.0;
    double back = 0.0;
    for (double w = 1.0 + 1e-9; w < 1e7; w *= 1.1) {
        struct contact_law law = law_on(&soft);
        contact_law_yield(&law, w * yield);
        double residual = law.history.dent;
        double rest = w * yield - residual;
        assert_true(residual >= before && rest > 0.0);
        if (w < 1.01)
            assert_true(residual < 1e-3 * yield);
        /* the published fit */
        if (w > 1.9 && w < 2000.0)
            near_relative(residual, 1.02 * w * yield * (1.0 - pow((w + 5.9) / 6.9, -0.54)), 1e-12);
        before = residual;
        back = rest / (w * yield);
    }
    assert_true(back < 0.01);
}

static void the_softer_body_yields(void **state)
{
    (void)state;
    struct hertz_contact hertz = sphere_on(&soft);
    assert_int_equal(closed_form_softer(&steel, &soft), 1);
    assert_int_equal(closed_form_softer(&soft, &steel), 0);
    assert_int_equal(closed_form_softer(&hard, &soft), 1);
    assert_int_equal(closed_form_softer(&steel, &steel), -1);
    assert_true(isinf(closed_form_yield(&hertz, &steel, &steel)));
    near_relative(closed_form_yield(&hertz, &hard, &soft), closed_form_yield(&hertz, &soft, &steel),
                  1e-15);
    near_relative(closed_form_radius(&hertz), 0.015, 1e-14);
}

static void memory_is_carried_to_another_partner_by_its_force(void **state)
{
    (void)state;
    struct contact_law law = law_on(&soft);
    contact_law_yield(&law, 2e-5);
    struct contact_history dent = law.history;
    struct contact_law same = law_on(&soft);
    contact_law_remember(&same, &dent);
    assert_memory_equal(&same.history, &dent, sizeof dent);
    /* a smaller sphere needs a deeper dent for the same force */
    struct hertz_contact small =
        hertz_contact_make(hertz_effective_modulus(&steel, &soft), 0.5 / 0.005, 0.5 / 0.005);
    struct contact_law other = contact_law_closed_form(&small, &steel, &soft);
    contact_law_remember(&other, &dent);
    near_relative(other.history.max_force, dent.max_force, 1e-12);
    assert_true(other.history.max_indentation > dent.max_indentation);
    /* one so large that this force does not make it yield remembers nothing */
    struct hertz_contact large =
        hertz_contact_make(hertz_effective_modulus(&steel, &soft), 0.5 / 0.5, 0.5 / 0.5);
    other = contact_law_closed_form(&large, &steel, &soft);
    contact_law_remember(&other, &dent);
    assert_true(other.history.max_force == 0.0);
    /* nor does an elastic law */
    other = contact_law_hertz(1e9);
    contact_law_remember(&other, &dent);
    assert_true(other.history.max_force == 0.0 && isinf(contact_law_limit(&other)));
}

/* Speed that a kilogramme gets back from the law's curves, in steps of velocity Verlet. */
static double bounce(struct contact_law law, double speed)
{
    const double step = 1e-3 * law.operations->curve->yield(&law) / speed;
    double d = 0.0, v = speed, force = 0.0;
    while (v > 0.0) {
        v -= 0.5 * step * force;
        d += step * v;
        force = law.operations->curve->force(&law, d, &(double){0.0});
        v -= 0.5 * step * force;
    }
    contact_law_yield(&law, d);
    d -= law.history.dent;
    do {
        force = force_at(&law, d);
        v -= 0.5 * step * force;
        d += step * v;
        force = d > 0.0 ? force_at(&law, d) : 0.0;
        v -= 0.5 * step * force;
    } while (d > 0.0);
    return -v;
}

/* The published fit of the restitution is that of the published curves. */
static void what_comes_back_is_the_published_fit(void **state)
{
    (void)state;
    static const struct material *const planes[] = {&soft, &hard};
    static const double speeds[] = {1.5, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0};
    for (int p = 0; p < 2; p++) {
        struct hertz_contact hertz = sphere_on(planes[p]);
        struct contact_law law = law_on(planes[p]);
        double depth = closed_form_yield(&hertz, &steel, planes[p]);
        /* of a kilogramme whose energy is just that of yield */
        double first = sqrt(2.0 * HERTZ_WORK * hertz.stiffness * pow(depth, 2.5));
        for (size_t i = 0; i < sizeof speeds / sizeof *speeds; i++) {
            double fit = closed_form_restitution(speeds[i] * speeds[i],
                                                 planes[p]->yield / hertz.effective_modulus);
            double moved = bounce(law, speeds[i] * first) / (speeds[i] * first);
            print_message("%g times the speed of yield: moved %.4f, fit %.4f\n", speeds[i], moved,
                          fit);
            near(fit, moved, 0.03);
        }
    }
    /* nothing is lost up to yield, and it falls by Johnson's power beyond the fit */
    assert_true(closed_form_restitution(1.0, 0.003) == 1.0);
    near_relative(closed_form_restitution(1e6 * 256.0, 0.003),
                  0.5 * closed_form_restitution(1e6, 0.003), 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loading_is_hertz_then_the_published_curve),
        cmocka_unit_test(value_and_slope_are_continuous),
        cmocka_unit_test(stored_energy_is_the_area),
        cmocka_unit_test(a_loop_dissipates_its_area),
        cmocka_unit_test(reloading_follows_the_branch_then_the_virgin_curve),
        cmocka_unit_test(rescaled_it_yields_later),
        cmocka_unit_test(what_stays_grows_from_nothing),
        cmocka_unit_test(the_softer_body_yields),
        cmocka_unit_test(what_comes_back_is_the_published_fit),
        cmocka_unit_test(memory_is_carried_to_another_partner_by_its_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
