/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/relaxed.c: bodies of materials that relax, against the same of a
 * modulus and a loss factor that are stated for the impact's frequency. */
#include "contact/hertz.h"
#include "physics/support.h"
#include "solve/repeat.h"

#define ACRYLIC ((struct material){"acrylic", 3.2e9, 0.37, 1190.0, INFINITY, 0.0})

static struct solve_result result;

static const double RADIUS = 0.015, SPEED = 1.0, LOSS = 0.1;

/* Of an elastic contact with `young` of a ball on a rigid wall. */
static double frequency(struct material material)
{
    double mass = material.density * 4.0 / 3.0 * M_PI * pow(RADIUS, 3);
    double k =
        4.0 / 3.0 * material.young / (1.0 - material.poisson * material.poisson) * sqrt(RADIUS);
    double depth = pow(0.5 * mass * SPEED * SPEED / (HERTZ_WORK * k), 0.4);
    return M_PI * SPEED / (HERTZ_DURATION * depth);
}

/* Of a series with the loss factor LOSS and the modulus of the material at that frequency. */
static struct body relaxing(struct body body, double omega)
{
    body.relaxation = relaxation_constant(LOSS, omega);
    body.material.young /= relaxation_storage(&body.relaxation, omega);
    body.loss_factor = NAN;
    return body;
}

static struct body lossy(struct body body)
{
    body.loss_factor = LOSS;
    return body;
}

static void hit_wall(struct body ball, enum percuss_contact_model model)
{
    struct lab *lab = lab_create();
    lab_add(lab, "ball", ball);
    lab_add(lab, "wall", rigid_wall());
    struct solve_request request = strike(sphere_spot("ball", RADIUS), wall_spot("wall"), SPEED);
    request.options.contact_model = model;
    lab_solve(lab, &request, &result);
    lab_free(lab);
}

/* A loss factor is made a series of just this kind: the same answer, but for the iteration that
 * finds the frequency. */
static void a_series_is_its_loss_factor(void **state)
{
    (void)state;
    struct body ball = make_sphere(ACRYLIC, RADIUS);
    static const enum percuss_contact_model models[] = {PERCUSS_CONTACT_AUTO,
                                                        PERCUSS_CONTACT_HERTZ};
    for (size_t i = 0; i < 2; i++) {
        hit_wall(lossy(ball), models[i]);
        const struct solve_result stated = result;
        hit_wall(relaxing(ball, frequency(ACRYLIC)), models[i]);
        assert_int_equal(result.contact_model, stated.contact_model);
        near(result.contacts[0].restitution, stated.contacts[0].restitution, 1e-8);
        near_relative(result.contacts[0].end_time, stated.contacts[0].end_time, 1e-8);
        near(result.restitution_model, stated.restitution_model, 1e-8);
        /* where the law has no loss, that is told */
        assert_int_equal(result.warning_count, stated.warning_count);
        for (size_t w = 0; w < result.warning_count; w++)
            assert_string_equal(result.warnings[w], stated.warnings[w]);
    }
    assert_true(result.warning_count == 1 && strstr(result.warnings[0], "(loss_factor 0.1)"));
}

/* Terms that have relaxed long before, or have no time to, only scale the modulus. */
static void what_is_far_from_the_impact_is_elastic(void **state)
{
    (void)state;
    hit_wall(make_sphere(ACRYLIC, RADIUS), PERCUSS_CONTACT_AUTO);
    const struct solve_result elastic = result;
    struct body ball = make_sphere(ACRYLIC, RADIUS);
    ball.loss_factor = NAN;
    ball.relaxation = (struct relaxation){2, {0.4, 0.3}, {1e-12, 1e12}};
    ball.material.young /= 0.6;
    hit_wall(ball, PERCUSS_CONTACT_AUTO);
    near(result.contacts[0].restitution, elastic.contacts[0].restitution, 1e-6);
    near_relative(result.contacts[0].end_time, elastic.contacts[0].end_time, 1e-6);
    assert_int_equal(result.warning_count, 0);
}

static void hit_rod(struct body rod)
{
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, RADIUS));
    lab_add(lab, "rod", rod);
    struct solve_request request =
        strike(sphere_spot("ball", RADIUS), end_spot("rod", rod.length), 0.5);
    lab_solve(lab, &request, &result);
    lab_free(lab);
}

/* A rod of one loss factor at all frequencies, stated either way: its waves are as fast and lose as
 * much. What remains is the ripple and the ends of the series (10 % of the loss factor, of which e
 * changes by 0.5 for 1), and that steel's share makes the impact's frequency another one. */
static void modes_are_those_of_the_impact_s_frequency(void **state)
{
    (void)state;
    const double most = 0.005;
    struct body rod = make_bar(&rod_kind, ACRYLIC, 0.010, 1.0), stated = lossy(rod);
    stated.damping = 0.5 * LOSS;
    hit_rod(stated);
    const struct solve_result by_factor = result;
    double omega = M_PI / by_factor.contacts[0].end_time;
    struct body series = relaxing(rod, omega);
    series.damping_peak = relaxation_peak_loss(&series.relaxation, 0.0);
    series.damping = 0.5 * series.damping_peak;
    hit_rod(series);
    measured("restitution", result.contacts[0].restitution, by_factor.contacts[0].restitution,
             most);
    measured("duration", result.contacts[0].end_time, by_factor.contacts[0].end_time,
             0.02 * by_factor.contacts[0].end_time);
    /* as stiff as at first it would be another rod */
    series.relaxation.count = 0;
    series.damping_peak = 0.0;
    series.damping = stated.damping;
    series.loss_factor = LOSS;
    hit_rod(series);
    assert_true(fabs(result.contacts[0].restitution - by_factor.contacts[0].restitution) > most);
}

/* The frequency is that of the sample, whatever its worker solved before. */
static void a_sample_has_its_own_modulus(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    struct body rod = make_bar(&rod_kind, ACRYLIC, 0.010, 0.3);
    lab_add(lab, "ball", make_sphere(STEEL, RADIUS));
    lab_add(lab, "rod", relaxing(rod, 2e4));
    struct repeat *alone = repeat_create(), *busy = repeat_create();
    struct solution_model model;
    struct repeat_outcome first, other, again;
    struct fault fault;
    struct solve_request slow = strike(sphere_spot("ball", RADIUS), end_spot("rod", 0.3), 0.02);
    struct solve_request fast = strike(sphere_spot("ball", RADIUS), end_spot("rod", 0.3), 2.0);
    slow.options.contact_model = fast.options.contact_model = PERCUSS_CONTACT_HERTZ;
    assert_int_equal(repeat_search(alone, &lab->means, &slow, 0, &model, &first, &fault),
                     PERCUSS_OK);
    repeat_solve(alone, &lab->means, &slow, 0, &model, false, &first, &fault);
    repeat_solve(busy, &lab->means, &fast, 0, &model, false, &other, &fault);
    repeat_solve(busy, &lab->means, &slow, 0, &model, true, &again, &fault);
    assert_int_equal(again.status, PERCUSS_OK);
    assert_true(again.restitution == first.restitution && again.impulse == first.impulse);
    repeat_free(alone);
    repeat_free(busy);
    lab_free(lab);
}

/* Spheres that creep faster than they touch are viscous ones, F = k (d^1.5 + 1.5 A d^0.5 d'), whose
 * restitution is published: 1 - 1.15344 z + 0.79826 z^2 with z = 1.5 A (k/m)^(2/5) v^(1/5)
 * (R. Ramirez, T. Poeschel, N. V. Brilliantov, T. Schwager, Phys. Rev. E 60 (1999) 4465). Here it
 * is of second order larger: the edge of the contact leaves early (3/8 A^2 d'^2 / d^0.5 of k while
 * it shrinks), and circles that begin to touch have not relaxed yet (3/4 of the same
 * (1 - share)/share less while it grows). Over the way of an elastic contact A^2 d'^2 / d^0.5 of k
 * is the work 5/3 (5/4)^(1/5) / 1.5^2 z^2 of m v^2. */
static double viscous(double z, double share)
{
    const double way = 5.0 / 3.0 * pow(1.25, 0.2) / 2.25;
    double more = way * (0.375 + 0.75 * (1.0 - share) / share);
    return 1.0 - 1.15344 * z + (0.79826 + more) * z * z;
}

static void as_published_of_viscous_spheres(void **state)
{
    (void)state;
    const double time = 1e-6, modulus = ACRYLIC.young / (1.0 - ACRYLIC.poisson * ACRYLIC.poisson);
    double k = 4.0 / 3.0 * modulus * sqrt(RADIUS);
    double mass = ACRYLIC.density * 4.0 / 3.0 * M_PI * pow(RADIUS, 3);
    for (double share = 0.5; share < 1.0; share += 0.3) {
        struct body ball = make_sphere(ACRYLIC, RADIUS);
        ball.loss_factor = NAN;
        ball.relaxation = (struct relaxation){1, {share}, {time * (1.0 - share) / share}};
        ball.material.young /= 1.0 - share;
        for (double speed = 0.01; speed < 2.0; speed *= 10.0) {
            double z = 1.5 * time * pow(k / mass, 0.4) * pow(speed, 0.2);
            struct lab *lab = lab_create();
            lab_add(lab, "ball", ball);
            lab_add(lab, "wall", rigid_wall());
            struct solve_request request =
                strike(sphere_spot("ball", RADIUS), wall_spot("wall"), speed);
            request.options.tolerance = 1e-6;
            lab_solve(lab, &request, &result);
            measured("restitution", result.contacts[0].restitution, viscous(z, share),
                     2.0 * z * z * z + 1e-6);
            lab_free(lab);
        }
    }
}

/* Friction is placed once more on what has relaxed. A ball's rebound is that without friction, and
 * its surface springs back, less than without a loss. */
static void with_friction(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", relaxing(make_sphere(ACRYLIC, RADIUS), frequency(ACRYLIC)));
    lab_add(lab, "wall", rigid_wall());
    struct solve_request request = strike(sphere_spot("ball", RADIUS), wall_spot("wall"), SPEED);
    lab_solve(lab, &request, &result);
    double straight = result.contacts[0].restitution, back[2];
    request.contacts[0].friction = 0.2;
    request.bodies[0].velocity[0] = 0.3 * SPEED;
    for (int lossy = 0; lossy < 2; lossy++) {
        request.options.contact_model = lossy ? PERCUSS_CONTACT_AUTO : PERCUSS_CONTACT_HERTZ;
        lab_solve(lab, &request, &result);
        assert_int_equal(result.contact_model,
                         lossy ? PERCUSS_CONTACT_VISCOELASTIC : PERCUSS_CONTACT_HERTZ);
        back[lossy] = result.contacts[0].tangential_restitution;
        if (lossy)
            near(result.contacts[0].restitution, straight, 1e-6);
        else
            near_relative(result.contacts[0].sub_impacts[0].end, M_PI / frequency(ACRYLIC), 0.002);
    }
    assert_true(back[1] > 0.0 && back[1] < back[0] - 1e-3);
    lab_free(lab);
}

/* Three balls in a row, of which the first one strikes. Two of them are as one of half the mass,
 * modulus and radius. */
static void hit_row(struct body ball)
{
    static const char *const ids[] = {"a", "b", "c"};
    struct lab *lab = lab_create();
    struct solve_request request = {.body_count = 3, .contact_count = 2};
    for (int i = 0; i < 3; i++) {
        lab_add(lab, ids[i], ball);
        strcpy(request.bodies[i].id, ids[i]);
        request.bodies[i].position[0] = 2.0 * RADIUS * i;
        request.bodies[i].orientation[0] = 1.0;
    }
    request.bodies[0].velocity[0] = SPEED;
    for (unsigned c = 0; c < 2; c++) {
        request.contacts[c].a = c;
        request.contacts[c].b = c + 1;
        request.contacts[c].point[0] = RADIUS * (2.0 * c + 1.0);
        request.contacts[c].normal[0] = -1.0;
    }
    lab_solve(lab, &request, &result);
    lab_free(lab);
}

/* A ball that nothing approaches yet is as stiff as at the frequency of the blow. */
static void in_groups_too(void **state)
{
    (void)state;
    const double pair = frequency(ACRYLIC) * pow(0.5, 0.2);
    hit_row(lossy(make_sphere(ACRYLIC, RADIUS)));
    const struct solve_result stated = result;
    hit_row(relaxing(make_sphere(ACRYLIC, RADIUS), pair));
    for (int c = 0; c < 2; c++) {
        near_relative(result.contacts[c].impulse, stated.contacts[c].impulse, 1e-7);
        near_relative(result.contacts[c].end_time, stated.contacts[c].end_time, 1e-7);
    }
}

/* One that has relaxed below what a body may have is refused. */
static void too_soft_is_refused(void **state)
{
    (void)state;
    struct body ball = make_sphere(ACRYLIC, RADIUS);
    ball.material.young = 1e4;
    ball.relaxation = (struct relaxation){1, {0.95}, {1e-9}};
    struct lab *lab = lab_create();
    lab_add(lab, "ball", ball);
    lab_add(lab, "wall", rigid_wall());
    struct solve_request request = strike(sphere_spot("ball", RADIUS), wall_spot("wall"), SPEED);
    assert_int_equal(solve(lab->workspace, &lab->means, &request, &result), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(result.fault.text, "bodies[0].id: 'ball': as its material has relaxed "
                                              "at "));
    assert_non_null(strstr(result.fault.text, "young: 500: must be a finite modulus > 0 Pa"));
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_series_is_its_loss_factor),
        cmocka_unit_test(what_is_far_from_the_impact_is_elastic),
        cmocka_unit_test(modes_are_those_of_the_impact_s_frequency),
        cmocka_unit_test(a_sample_has_its_own_modulus),
        cmocka_unit_test(as_published_of_viscous_spheres),
        cmocka_unit_test(with_friction),
        cmocka_unit_test(in_groups_too),
        cmocka_unit_test(too_soft_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
