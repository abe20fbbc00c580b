/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/contact_model.c: tables where there are some, what the reply says,
 * several contacts, elliptic ones, dents that are many. Tables are sampled from the closed form,
 * whose answer is known. */
#include "contact/law_closed_form.h"
#include "physics/support.h"
#include "unit/contact/sampled_table.h"

#define AL_205 ((struct material){"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0})

static struct solve_result result, other;

/* One table, for the paper's sphere on rod 1. */
struct tables {
    struct contact_curves *curves;
    struct contact_table_source source;
    int asked;
};

static const struct contact_curves *look_up(void *context, const struct contact_pair *pair)
{
    struct tables *tables = context;
    tables->asked++;
    bool fits = strcmp(pair->a->name, "steel") == 0 && strcmp(pair->b->name, "al-205") == 0 &&
                fabs(pair->curvature[0] - 0.5 / 0.015) < 1e-9 &&
                pair->curvature[1] == pair->curvature[0];
    return fits ? tables->curves : NULL;
}

/* Up to `range` times the indentation at yield. */
static struct tables *tables_create(struct lab *lab, double range)
{
    static struct sampled_table sampled;
    struct fault fault = {""};
    struct tables *tables = calloc(1, sizeof *tables);
    struct material steel = STEEL, soft = AL_205;
    struct hertz_contact hertz =
        hertz_contact_make(hertz_effective_modulus(&steel, &soft), 0.5 / 0.015, 0.5 / 0.015);
    struct contact_law law = contact_law_closed_form(&hertz, &steel, &soft);
    assert_non_null(tables);
    sampled_table_make(&sampled, &law, range);
    contact_curves_create(&sampled.table, &tables->curves, &fault);
    assert_non_null(tables->curves);
    tables->source = (struct contact_table_source){.context = tables, .find = look_up};
    lab->means.tables = &tables->source;
    return tables;
}

static void tables_free(struct tables *tables)
{
    contact_curves_free(tables->curves);
    free(tables);
}

static struct lab *bodies(void)
{
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "small", make_sphere(STEEL, 0.005));
    lab_add(lab, "rod", make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "rod-1", make_bar(&rod_kind, AL_205, 0.010, 1.0));
    lab_add(lab, "beam-1", make_bar(&beam_kind, AL_205, 0.010, 1.0));
    lab_add(lab, "wall", make_body(&half_space_kind, AL_205));
    return lab;
}

static struct solve_request blow(const char *rod, double speed, double tolerance)
{
    struct solve_request request = strike(sphere_spot("ball", 0.015), end_spot(rod, 1.0), speed);
    request.options.tolerance = tolerance;
    return request;
}

static void a_table_answers_like_what_it_was_sampled_from(void **state)
{
    (void)state;
    struct lab *lab = bodies();
    struct tables *tables = tables_create(lab, 60.0);
    for (double speed = 0.05; speed < 1.0; speed *= 1.7) {
        struct solve_request request = blow("rod-1", speed, 1e-6);
        lab_solve(lab, &request, &result);
        assert_int_equal(result.contact_model, PERCUSS_CONTACT_TABLE);
        assert_non_null(strstr(result.reason, "table"));
        assert_true(result.tolerance_met && tables->asked > 0);
        request.options.contact_model = PERCUSS_CONTACT_CLOSED_FORM;
        lab_solve(lab, &request, &other);
        assert_int_equal(other.contact_model, PERCUSS_CONTACT_CLOSED_FORM);
        /* 5e-4 of the force between the samples, 5e-3 of the work at the onset of yield */
        measured("e", result.contacts[0].restitution, other.contacts[0].restitution, 1e-3);
        measured("closure", result.energy.closure / result.energy.available, 0.0, 1e-5);
        request.options.contact_model = PERCUSS_CONTACT_TABLE;
        lab_solve(lab, &request, &other);
        assert_true(other.contacts[0].impulse == result.contacts[0].impulse);
    }
    tables_free(tables);
    lab_free(lab);
}

/* The audit closes with a table too, and CVODE agrees. */
static void a_table_keeps_the_energy(void **state)
{
    (void)state;
    struct lab *lab = bodies();
    struct tables *tables = tables_create(lab, 60.0);
    struct solve_request request = blow("rod-1", 0.3, 1e-8);
    lab_solve(lab, &request, &result);
    measured("closure", result.energy.closure / result.energy.available, 0.0, 1e-9);
    struct body rod = lab->bodies[3];
    rod.modes = 12;
    lab_add(lab, "rod-1", rod);
    lab_solve(lab, &request, &result);
    request.options.method = PERCUSS_METHOD_CVODE;
    request.options.tolerance = 1e-7;
    lab_solve(lab, &request, &other);
    assert_int_equal(other.contact_model, PERCUSS_CONTACT_TABLE);
    measured("e", other.contacts[0].restitution, result.contacts[0].restitution, 1e-6);
    tables_free(tables);
    lab_free(lab);
}

static void without_a_fitting_table_auto_says_so(void **state)
{
    (void)state;
    struct lab *lab = bodies();
    struct tables *tables = tables_create(lab, 60.0);
    struct solve_request request = strike(sphere_spot("small", 0.005), end_spot("rod-1", 1.0), 0.3);
    lab_solve(lab, &request, &result);
    assert_int_equal(result.contact_model, PERCUSS_CONTACT_CLOSED_FORM);
    assert_non_null(strstr(result.reason, "no table for these bodies"));
    request.options.contact_model = PERCUSS_CONTACT_TABLE;
    assert_int_equal(solve(lab->workspace, &lab->means, &request, &result), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(result.fault.text, "small on rod-1"));
    /* a pair that cannot yield needs none */
    tables->asked = 0;
    request = blow("rod", 0.3, 1e-3);
    lab_solve(lab, &request, &result);
    assert_int_equal(result.contact_model, PERCUSS_CONTACT_HERTZ);
    assert_int_equal(tables->asked, 0);
    tables_free(tables);
    lab_free(lab);
}

static double strike_wall(struct lab *lab, double speed)
{
    struct solve_request request = strike(sphere_spot("ball", 0.015), wall_spot("wall"), speed);
    request.options.tolerance = 1e-6;
    lab_solve(lab, &request, &result);
    assert_int_not_equal(result.contact_model, PERCUSS_CONTACT_CLOSED_FORM);
    return result.contacts[0].restitution;
}

/* Beyond its end a table goes on without a jump, ever less springs back, and in the end
 * e ~ v^(-1/4) (Johnson, Contact Mechanics, 1985, section 6.4). */
static void a_table_that_ends_too_early_goes_on(void **state)
{
    (void)state;
    struct lab *lab = bodies();
    struct tables *tables = tables_create(lab, 8.0);
    struct solve_request request = blow("rod-1", 0.1, 1e-4);
    lab_solve(lab, &request, &result);
    assert_int_equal(result.contact_model, PERCUSS_CONTACT_TABLE);
    assert_int_equal(result.warning_count, 0);
    enum percuss_contact_model models[] = {PERCUSS_CONTACT_AUTO, PERCUSS_CONTACT_TABLE};
    for (int m = 0; m < 2; m++) {
        request = blow("rod-1", 0.5, 1e-4);
        request.options.contact_model = models[m];
        lab_solve(lab, &request, &result);
        assert_int_equal(result.contact_model, PERCUSS_CONTACT_TABLE);
        assert_non_null(strstr(result.reason, "the table ends before that"));
        assert_true(result.warning_count == 1 && strstr(result.warnings[0], "table ends"));
    }
    /* 1 % of speed changes e by a quarter of it or less everywhere; a jump would be more */
    double before = 1.0;
    for (double speed = 0.005; speed < 20.0; speed *= 1.01) {
        double e = strike_wall(lab, speed);
        assert_true(e < before + 1e-6);
        if (speed > 0.02)
            assert_true(e > 0.99 * before);
        before = e;
    }
    /* what the straight line leaves of the power at 100 times the speed of the table's end */
    measured("power", log(strike_wall(lab, 20.0) / strike_wall(lab, 2.0)) / log(10.0), -0.25, 0.02);
    tables_free(tables);
    lab_free(lab);
}

static void an_elliptic_contact_is_named_an_approximation(void **state)
{
    (void)state;
    struct lab *lab = bodies();
    struct solve_request request =
        strike(sphere_spot("ball", 0.015), side_spot("beam-1", 0.1, 0.010, 0.0), 0.3);
    lab_solve(lab, &request, &result);
    assert_int_equal(result.contact_model, PERCUSS_CONTACT_CLOSED_FORM);
    assert_non_null(strstr(result.reason, "sphere of equal stiffness"));
    assert_true(result.energy.plastic > 0.0);
    lab_free(lab);
}

static void hardening_left_out_is_named(void **state)
{
    (void)state;
    struct lab *lab = bodies();
    struct body rod = lab->bodies[3];
    rod.material.tangent = 1e9;
    lab_add(lab, "rod-1", rod);
    struct solve_request request = blow("rod-1", 0.3, 1e-3);
    lab_solve(lab, &request, &result);
    assert_non_null(strstr(result.reason, "hardening of rod-1 left out"));
    lab_free(lab);
}

/* A ball between two others on a soft wall: every contact has its own law and dent. */
static void several_contacts_yield_by_themselves(void **state)
{
    (void)state;
    struct lab *lab = bodies();
    struct solve_request request = {.body_count = 3, .contact_count = 2};
    struct solve_request one = strike(sphere_spot("ball", 0.015), wall_spot("wall"), 0.4);
    request.bodies[0] = one.bodies[0];
    request.bodies[1] = one.bodies[1];
    request.bodies[2] = one.bodies[0];
    request.bodies[2].position[0] = 5.0;    /* out of reach of the other's waves */
    request.bodies[2].velocity[2] = -0.002; /* too slow to leave a dent */
    request.contacts[0] = one.contacts[0];
    request.contacts[1] = one.contacts[0];
    request.contacts[1].a = 2;
    request.contacts[1].point[0] = 5.0;
    request.options.tolerance = 1e-6;
    lab_solve(lab, &request, &result);
    one.options.tolerance = 1e-6;
    double e = result.contacts[0].restitution;
    double second = result.contacts[1].restitution;
    assert_true(second > 0.9995);
    assert_int_equal(result.bodies[1].state_after->dents, 1);
    measured("place", body_state_dents(result.bodies[1].state_after)->point[0], 0.0, 1e-12);
    lab_solve(lab, &one, &other);
    measured("first contact", e, other.contacts[0].restitution, 1e-6);
    one.bodies[0].velocity[2] = -0.002;
    lab_solve(lab, &one, &other);
    measured("second contact", second, other.contacts[0].restitution, 1e-6);
    lab_free(lab);
}

/* 300 dents side by side: the state keeps the deepest 256. */
static void dents_are_bounded(void **state)
{
    (void)state;
    struct lab *lab = bodies();
    struct body_state *before = NULL;
    for (int i = 0; i < BODY_STATE_MAX_DENTS + 4; i++) {
        struct spot spot = wall_spot("wall");
        spot.point[0] = 0.01 * i;
        struct solve_request request = strike(sphere_spot("ball", 0.015), spot, 0.1 + 0.001 * i);
        request.bodies[1].state = before;
        lab_solve(lab, &request, &result);
        const struct body_state *after = result.bodies[1].state_after;
        assert_int_equal(after->dents,
                         i < BODY_STATE_MAX_DENTS ? (size_t)i + 1 : BODY_STATE_MAX_DENTS);
        bool full = false;
        for (size_t w = 0; w < result.warning_count; w++)
            full = full || strstr(result.warnings[w], "no more are kept");
        assert_true(full == (i >= BODY_STATE_MAX_DENTS - 1));
        free(before);
        before = malloc(body_state_size(after));
        assert_non_null(before);
        memcpy(before, after, body_state_size(after));
    }
    /* the first four made place */
    for (size_t i = 0; i < before->dents; i++)
        assert_true(body_state_dents(before)[i].point[0] > 0.035);
    free(before);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_answers_like_what_it_was_sampled_from),
        cmocka_unit_test(a_table_keeps_the_energy),
        cmocka_unit_test(without_a_fitting_table_auto_says_so),
        cmocka_unit_test(a_table_that_ends_too_early_goes_on),
        cmocka_unit_test(an_elliptic_contact_is_named_an_approximation),
        cmocka_unit_test(hardening_left_out_is_named),
        cmocka_unit_test(several_contacts_yield_by_themselves),
        cmocka_unit_test(dents_are_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
