/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/complete_body.c. */
#include <string.h>

#include "check.h"
#include "fe/complete_body.h"

static const struct material aluminium = {"al", 70e9, 0.33, 2700.0, 205e6, 1e9};

static struct body made(struct body body)
{
    struct fault fault = {""};
    body.material = aluminium;
    body.yield_rate = (struct yield_rate){.reference = 40.0, .exponent = 5.0};
    strcpy(body.id, "one");
    if (body_complete(&body, &fault) != PERCUSS_OK)
        fail_msg("%s", fault.text);
    return body;
}

/* the mass of what is meshed is the body's */
static void keeps_size_mass_and_material(void **unused)
{
    (void)unused;
    const struct body bodies[] = {
        made((struct body){.kind = &sphere_kind, .radius = 0.02}),
        made((struct body){
            .kind = &rod_kind, .radius = 0.01, .length = 0.5, .tip_radius = INFINITY}),
        made((struct body){.kind = &cylinder_kind, .radius = 0.03, .length = 0.05}),
        made((struct body){.kind = &block_kind, .size = {0.1, 0.2, 0.3}}),
    };
    for (size_t i = 0; i < sizeof bodies / sizeof *bodies; i++) {
        struct complete_body complete;
        assert_true(complete_body_make(&bodies[i], &complete, NULL) == PERCUSS_OK);
        double r = complete.radius;
        double volume = complete.shape == COMPLETE_SPHERE ? 4.0 / 3.0 * M_PI * r * r * r
                                                          : M_PI * r * r * complete.length;
        assert_true(fabs(volume * 2700.0 / bodies[i].mass - 1.0) < 1e-12);
        assert_true(complete.material.yield == 205e6 && complete.material.tangent == 1e9);
        assert_true(complete.rate.reference == 40.0 && complete.rate.exponent == 5.0);
        assert_true((complete.shape == COMPLETE_SPHERE) == (i == 0));
    }
}

static void refuses_what_it_cannot_mesh(void **unused)
{
    (void)unused;
    const struct {
        struct body body;
        const char *message;
    } cases[] = {
        {made((struct body){.kind = &rod_kind, .radius = 0.01, .length = 0.5, .tip_radius = 0.02}),
         "tip_radius: 0.02"},
        {made((struct body){.kind = &rod_kind,
                            .radius = 0.01,
                            .length = 0.5,
                            .tip_radius = INFINITY,
                            .supports = {SUPPORT_FREE, SUPPORT_CLAMPED}}),
         "supports"},
        {made((struct body){.kind = &rod_kind,
                            .radius = 0.01,
                            .length = 0.5,
                            .tip_radius = INFINITY,
                            .damping = 0.01}),
         "damping: 0.01"},
        {made((struct body){.kind = &half_space_kind}), "half-space"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct complete_body complete;
        struct fault fault = {""};
        assert_true(complete_body_make(&cases[i].body, &complete, &fault) ==
                    PERCUSS_UNSUPPORTED_GEOMETRY);
        if (!strstr(fault.text, cases[i].message) || !strstr(fault.text, "one: "))
            fail_msg("%s", fault.text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keeps_size_mass_and_material),
        cmocka_unit_test(refuses_what_it_cannot_mesh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
