/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/contact/family.c: a family sampled from powers whose
 * exponents depend on the place, so that every curve between the places is known. */
#include <string.h>

#include "check.h"
#include "contact/family.h"
#include "contact/law_closed_form.h"
#include "contact/plastic.h"

enum {
    H = 5,
    P = 3,
    S = 4,
    TABLES = H * P * S,
    DEPTHS = 40,
    SPRINGS = 20,
    BRANCHES = 5,
    SAMPLES = 9
};

static const double hardening[H] = {0.0, 0.01, 0.04, 0.16, 0.36};
static const double poisson[P] = {0.1, 0.3, 0.45};
static const double share[S] = {0.1, 0.4, 0.7, 1.0};

struct sampled {
    struct contact_family_samples samples;
    double depth[DEPTHS], force[TABLES][DEPTHS], area[TABLES][DEPTHS];
    double largest[SPRINGS], back[TABLES][SPRINGS];
    double share[TABLES][BRANCHES][SAMPLES];
};

/* What is left of Hertz's force at a depth: a power that hardening takes back, small enough in its
 * variation that cubics hold it to 1e-4. */
static double force_at(double h, double p, double s, double w)
{
    return pow(w, -0.3 * (1.0 - sqrt(h)) * (1.0 + 0.1 * p) * (0.9 + 0.1 * s));
}

static double back_at(double h, double w)
{
    return pow(w, -0.4 * (1.0 - sqrt(h)));
}

static struct sampled *sample(void)
{
    struct sampled *made = calloc(1, sizeof *made);
    assert_non_null(made);
    for (int i = 0; i < DEPTHS; i++)
        made->depth[i] = pow(10.0, 0.1 * (i + 1));
    for (int i = 0; i < SPRINGS; i++)
        made->largest[i] = pow(10.0, 0.2 * (i + 1));
    for (int t = 0; t < TABLES; t++) {
        double h = hardening[t / S / P], p = poisson[t / S % P], s = share[t % S];
        for (int i = 0; i < DEPTHS; i++) {
            made->force[t][i] = force_at(h, p, s, made->depth[i]);
            made->area[t][i] = 1.0 + 0.1 * log(made->depth[i]);
        }
        for (int i = 0; i < SPRINGS; i++)
            made->back[t][i] = back_at(h, made->largest[i]);
        for (int b = 0; b < BRANCHES; b++)
            for (int j = 0; j < SAMPLES; j++)
                made->share[t][b][j] = pow((double)j / (SAMPLES - 1), 1.5);
    }
    made->samples = (struct contact_family_samples){
        .count = {H, P, S},
        .axis = {hardening, poisson, share},
        .depths = DEPTHS,
        .depth = made->depth,
        .force = made->force[0],
        .area = made->area[0],
        .springs = SPRINGS,
        .largest = made->largest,
        .back = made->back[0],
        .branches = BRANCHES,
        .samples = SAMPLES,
        .share = made->share[0][0],
        .computed = 1e4,
        .error = 1e-3,
    };
    return made;
}

static struct contact_family *make(void)
{
    struct fault fault = {""};
    struct sampled *sampled = sample();
    struct contact_family *family = contact_family_create(&sampled->samples, &fault);
    if (!family)
        fail_msg("%s", fault.text);
    free(sampled);
    return family;
}

static struct hertz_contact contact_of(const struct material *a, const struct material *b,
                                       double radius)
{
    return hertz_contact_make(hertz_effective_modulus(a, b), 0.5 / radius, 0.5 / radius);
}

/* Softer, partner; the former's tangent. */
static void pair_at(const struct contact_family_place *place, struct material pair[2])
{
    double plane = 70e9 / (1.0 - place->poisson * place->poisson);
    double other = plane * place->share / fmax(1.0 - place->share, 1e-9);
    pair[0] = (struct material){"soft", 70e9, place->poisson, 1.0, 1e8, 70e9 * place->hardening};
    pair[1] = (struct material){"hard", other * (1.0 - 0.04), 0.2, 1.0, INFINITY, 0.0};
}

static void a_place_between_the_tables_has_its_curves(void **state)
{
    (void)state;
    struct contact_family *family = make();
    static const struct contact_family_place places[] = {{0.0, 0.3, 0.7},     {0.36, 0.45, 1.0},
                                                         {0.005, 0.35, 0.55}, {0.1, 0.2, 0.25},
                                                         {0.0, 0.38, 0.9},    {0.25, 0.12, 0.8}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        struct material pair[2];
        struct arena arena = {0};
        pair_at(&places[i], pair);
        struct contact_family_place place = contact_family_place(&pair[1], &pair[0]);
        near_relative(place.hardening, places[i].hardening, 1e-12);
        near_relative(place.poisson, places[i].poisson, 1e-12);
        near_relative(place.share, places[i].share, 1e-8);
        near_relative(contact_family_outside(family, &place) + 1.0, 1.0, 1e-7);
        struct hertz_contact hertz = contact_of(&pair[0], &pair[1], 0.02);
        double unit = closed_form_yield(&hertz, &pair[0], &pair[1]);
        struct contact_law law = contact_law_family(contact_family_curves(family, &place, &arena),
                                                    &hertz, &pair[0], &pair[1]);
        /* below yield the law is Hertz's but for the spline's bend there */
        double slope;
        near_relative(contact_law_force(&law, 0.5 * unit, &slope),
                      hertz.stiffness * pow(0.5 * unit, 1.5), 1e-4);
        near_relative(contact_law_limit(&law), unit, 1e-12);
        near_relative(contact_law_table_range(&law), 1e4 * unit, 1e-12);
        /* four places of an exponential's cubic, and ten depths to a decade */
        for (double w = 2.0; w < 9e3; w *= 1.7) {
            double expected = hertz.stiffness * pow(w * unit, 1.5) *
                              force_at(place.hardening, place.poisson, place.share, w);
            near_relative(law.operations->curve->force(&law, w * unit, &slope), expected, 2e-3);
            /* dents begin with the square of the way, not like the power */
            if (w > 4.0)
                near_relative(law.operations->curve->residual(&law, w * unit),
                              w * unit * (1.0 - back_at(place.hardening, w)), 4e-3);
            near_relative(law.operations->curve->radius(&law, w * unit),
                          sqrt(0.02 * w * unit * (1.0 + 0.1 * log(w))), 1e-3);
        }
        arena_release(&arena);
    }
    contact_family_free(family);
}

/* Two equal bodies that both yield: each is one against a rigid flat, whatever its modulus. */
static void equal_bodies_are_ones_on_a_rigid_flat(void **state)
{
    (void)state;
    struct material soft = {"soft", 70e9, 0.33, 1.0, 1e8, 0.0};
    struct material later = soft, hard = soft;
    near_relative(contact_family_place(&soft, &soft).share, 1.0, 1e-15);
    later.yield = 1.5e8;
    hard.yield = 2.5e8;
    assert_true(contact_family_both_yield(&soft, &later));
    assert_false(contact_family_both_yield(&hard, &soft));
    double part = contact_family_place(&soft, &later).share;
    assert_true(part > 0.5 && part < 0.6);
    near_relative(contact_family_place(&hard, &soft).share, 0.5, 1e-15);
}

/* Outside the axes the answer is still one that a law can follow, and it is said how far out. */
/* The family knows nothing of the stress of yield: the law of a metal that yields at another one is
 * the same law rescaled, and so is what it remembers. */
static void another_yield_is_a_rescaled_law(void **state)
{
    (void)state;
    struct contact_family *family = make();
    const struct contact_family_place place = {0.01, 0.33, 0.6};
    struct material pair[2];
    struct arena arena = {0};
    pair_at(&place, pair);
    struct hertz_contact hertz = contact_of(&pair[0], &pair[1], 0.02);
    const struct contact_curves *curves = contact_family_curves(family, &place, &arena);
    struct contact_law law = contact_law_family(curves, &hertz, &pair[1], &pair[0]);
    struct contact_law rescaled = contact_law_rescaled(&law, 1.0, 1.3);
    pair[0].yield *= 1.3;
    struct contact_law other = contact_law_family(curves, &hertz, &pair[1], &pair[0]);
    for (double d = 1e-8; d < 1e-3; d *= 3.1) {
        double slope[2];
        near_relative(contact_law_force(&rescaled, d, &slope[0]),
                      contact_law_force(&other, d, &slope[1]), 1e-12);
        near_relative(slope[0], slope[1], 1e-12);
    }
    contact_law_yield(&rescaled, 1e-4);
    contact_law_yield(&other, 1e-4);
    near_relative(rescaled.history.dent, other.history.dent, 1e-11);
    near_relative(rescaled.history.contact_radius, other.history.contact_radius, 1e-12);
    /* a dent stays what it is under a law that is stiffer all over */
    struct contact_law stiffer = contact_law_rescaled(&other, 1.1, 1.0);
    near_relative(stiffer.history.max_force, 1.1 * other.history.max_force, 1e-15);
    assert_true(stiffer.history.dent == other.history.dent);
    arena_release(&arena);
    contact_family_free(family);
}

static void outside_it_says_so(void **state)
{
    (void)state;
    struct contact_family *family = make();
    struct arena arena = {0};
    static const struct contact_family_place places[] = {
        {0.9, 0.3, 0.7}, {0.0, -0.5, 0.7}, {0.0, 0.4999, 1.0}, {0.0, 0.3, 1e-3}, {0.9, -0.9, 1e-3}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        assert_true(contact_family_outside(family, &places[i]) > 0.0);
        const struct contact_curves *curves = contact_family_curves(family, &places[i], &arena);
        struct contact_law law = contact_law_table(curves);
        double slope, before = 0.0, spring = 2.0;
        for (double w = 0.01; w < 1e6; w *= 1.1) {
            double force = law.operations->curve->force(&law, w, &slope);
            double back = 1.0 - law.operations->curve->residual(&law, w) / w;
            assert_true(force > before && slope > 0.0 && back > 0.0 && back <= spring);
            before = force;
            spring = back;
        }
    }
    arena_release(&arena);
    contact_family_free(family);
}

static void bad_families_are_refused(void **state)
{
    (void)state;
    for (int bad = 0; bad < 7; bad++) {
        struct fault fault = {""};
        struct sampled *sampled = sample();
        struct contact_family_samples *samples = &sampled->samples;
        if (bad == 0)
            sampled->force[7][9] = 0.5 * sampled->force[7][8];
        else if (bad == 1)
            sampled->back[3][2] = 1.01;
        else if (bad == 2)
            sampled->share[3][2][4] = NAN;
        else if (bad == 3)
            samples->count[1] = CONTACT_FAMILY_MOST + 1;
        else if (bad == 4)
            sampled->depth[0] = 1.0;
        else if (bad == 5)
            samples->branches = SPRINGS + 1;
        else
            sampled->area[1][1] = 0.1;
        assert_null(contact_family_create(samples, &fault));
        assert_non_null(strstr(fault.text, "family: "));
        free(sampled);
    }
    contact_family_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_place_between_the_tables_has_its_curves),
        cmocka_unit_test(equal_bodies_are_ones_on_a_rigid_flat),
        cmocka_unit_test(another_yield_is_a_rescaled_law),
        cmocka_unit_test(outside_it_says_so),
        cmocka_unit_test(bad_families_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
