/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Rows of spheres that touch, hit from one side or from both, equal or not: against the row's own
 * equations of motion integrated here step by step, without anything of the solver. */
#include "physics/support.h"

enum { LONGEST = 24 };

struct row {
    int count;
    double radius[LONGEST], speed[LONGEST];
    double mass[LONGEST], stiffness[LONGEST], place[LONGEST];
};

static double hertz_force(double stiffness, double indentation)
{
    return indentation > 0.0 ? stiffness * indentation * sqrt(indentation) : 0.0;
}

static void accelerations(const struct row *row, const double *x, double *a)
{
    for (int i = 0; i < row->count; i++)
        a[i] = 0.0;
    for (int i = 0; i + 1 < row->count; i++) {
        double force = hertz_force(row->stiffness[i], x[i] - x[i + 1]);
        a[i] -= force / row->mass[i];
        a[i + 1] += force / row->mass[i + 1];
    }
}

/* One step of the classical Runge-Kutta method for displacements x and speeds v. */
static void runge_kutta(const struct row *row, double h, double *x, double *v)
{
    static const double ahead[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0, 2.0, 2.0, 1.0};
    double dx[4][LONGEST], dv[4][LONGEST], at[LONGEST];
    for (int s = 0; s < 4; s++) {
        for (int i = 0; i < row->count; i++) {
            at[i] = x[i] + (s ? ahead[s] * h * dx[s - 1][i] : 0.0);
            dx[s][i] = v[i] + (s ? ahead[s] * h * dv[s - 1][i] : 0.0);
        }
        accelerations(row, at, dv[s]);
    }
    for (int i = 0; i < row->count; i++)
        for (int s = 0; s < 4; s++) {
            x[i] += h * weight[s] / 6.0 * dx[s][i];
            v[i] += h * weight[s] / 6.0 * dv[s][i];
        }
}

static bool is_over(const struct row *row, const double *x, const double *v)
{
    for (int i = 0; i + 1 < row->count; i++)
        if (x[i] > x[i + 1] || v[i] > v[i + 1])
            return false;
    return true;
}

/* Speeds after all contacts, with steps of duration / `steps` of the first contact's duration. */
static void integrate(const struct row *row, double steps, double *v)
{
    double x[LONGEST] = {0.0};
    double fastest = 0.0, stiffest = 0.0, lightest = INFINITY;
    for (int i = 0; i < row->count; i++) {
        v[i] = row->speed[i];
        fastest = fmax(fastest, fabs(v[i]));
        lightest = fmin(lightest, row->mass[i]);
        stiffest = fmax(stiffest, i + 1 < row->count ? row->stiffness[i] : 0.0);
    }
    double h = pow(lightest / (stiffest * sqrt(fastest)), 0.4) / steps;
    for (long step = 0; step < 100000000 && (step % 16 || step == 0 || !is_over(row, x, v)); step++)
        runge_kutta(row, h, x, v);
}

static struct solve_request row_request(struct lab *lab, struct row *row)
{
    struct solve_request request = {.body_count = (size_t)row->count,
                                    .contact_count = (size_t)row->count - 1};
    double flexibility = 2.0 * (1.0 - STEEL.poisson * STEEL.poisson) / STEEL.young;
    double x = 0.0;
    for (int i = 0; i < row->count; i++) {
        struct solve_body *body = &request.bodies[i];
        snprintf(body->id, sizeof body->id, "s%d", i);
        lab_add(lab, body->id, make_sphere(STEEL, row->radius[i]));
        row->mass[i] = STEEL.density * 4.0 / 3.0 * M_PI * pow(row->radius[i], 3.0);
        x += i ? row->radius[i - 1] + row->radius[i] : 0.0;
        body->orientation[0] = 1.0;
        body->position[0] = x;
        body->velocity[0] = row->speed[i];
        if (i == 0)
            continue;
        double radius = 1.0 / (1.0 / row->radius[i - 1] + 1.0 / row->radius[i]);
        row->stiffness[i - 1] = 4.0 / 3.0 / flexibility * sqrt(radius);
        request.contacts[i - 1] = (struct solve_contact){.a = (unsigned)i,
                                                         .b = (unsigned)i - 1,
                                                         .point = {x - row->radius[i], 0.0, 0.0},
                                                         .normal = {1.0, 0.0, 0.0}};
    }
    /* rows this long spend the effort allowed on many slow contacts before 1e-8 is reached */
    request.options.tolerance = row->count > 14 ? 1e-6 : 1e-8;
    return request;
}

/* Solves both ways; the speeds agree within `allowed` of the fastest, and nothing is lost. */
static void compare(struct row *row, double allowed)
{
    static struct solve_result result;
    double expected[LONGEST], coarse[LONGEST];
    double before = 0.0, after = 0.0, energy = 0.0, left = 0.0, fastest = 0.0;
    struct lab *lab = lab_create();
    struct solve_request request = row_request(lab, row);
    lab_solve(lab, &request, &result);
    assert_int_equal(result.end_reason, PERCUSS_END_SEPARATED);
    integrate(row, 1000.0, coarse);
    integrate(row, 2000.0, expected);
    for (int i = 0; i < row->count; i++)
        fastest = fmax(fastest, fabs(row->speed[i]));
    for (int i = 0; i < row->count; i++) {
        double v = result.bodies[i].velocity[0];
        /* the reference's own error, from two step lengths */
        measured("reference", coarse[i], expected[i], 0.3 * allowed * fastest);
        measured("speed", v, expected[i], allowed * fastest);
        before += row->mass[i] * row->speed[i];
        after += row->mass[i] * v;
        energy += 0.5 * row->mass[i] * row->speed[i] * row->speed[i];
        left += 0.5 * row->mass[i] * v * v;
    }
    /* each impulse acts on two spheres: rounding only */
    measured("momentum", after, before, 1e-12 * row->mass[0] * fastest);
    /* elastic: the audit's promise at these tolerances */
    measured_relative("energy", left, energy, row->count > 14 ? 1e-5 : 1e-9);
    lab_free(lab);
}

static struct row equal_row(int count)
{
    struct row row = {.count = count};
    for (int i = 0; i < count; i++)
        row.radius[i] = 0.01;
    return row;
}

static void equal_spheres_hit_from_one_side(void **state)
{
    (void)state;
    static const int counts[] = {2, 3, 4, 6, 10, 20};
    for (size_t i = 0; i < COUNT(counts); i++) {
        struct row row = equal_row(counts[i]);
        row.speed[0] = 1.0;
        compare(&row, 1e-6);
    }
}

static void several_spheres_hit_many(void **state)
{
    (void)state;
    struct row row = equal_row(6);
    row.speed[0] = row.speed[1] = 0.3;
    compare(&row, 1e-6);
}

/* From both sides, alike (the mirror image stays one) and not. */
static void rows_hit_from_both_sides(void **state)
{
    (void)state;
    for (int count = 3; count <= 7; count += 2) {
        struct row row = equal_row(count);
        row.speed[0] = 0.4;
        row.speed[count - 1] = -0.4;
        compare(&row, 1e-6);
        row.speed[count - 1] = -0.15;
        compare(&row, 1e-6);
    }
}

static void unequal_masses(void **state)
{
    (void)state;
    struct row tapered = {.count = 7, .speed = {0.5}};
    for (int i = 0; i < 7; i++)
        tapered.radius[i] = 0.012 * pow(0.85, i);
    compare(&tapered, 1e-6);
    struct row rising = {.count = 6, .speed = {0.5}};
    for (int i = 0; i < 6; i++)
        rising.radius[i] = 0.005 * pow(1.3, i);
    compare(&rising, 1e-6);
    /* a light one between two heavy ones is hit many times in one group */
    struct row squeezed = {.count = 3, .speed = {0.3, 0.0, -0.1}, .radius = {0.02, 0.008, 0.02}};
    compare(&squeezed, 1e-6);
    struct row mixed = {.count = 8,
                        .speed = {0.7, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.2},
                        .radius = {0.01, 0.006, 0.013, 0.009, 0.004, 0.011, 0.012, 0.008}};
    compare(&mixed, 1e-6);
}

/* Equal spheres, one gap between the others: each hands its speed on, and no two of those at rest
 * approach each other. */
static void rows_with_gaps_come_to_rest(void **state)
{
    (void)state;
    static struct solve_result result;
    static const enum percuss_method methods[] = {PERCUSS_METHOD_MODAL, PERCUSS_METHOD_CVODE};
    static const double horizons[] = {0.0, 1.0}, tolerances[] = {1e-3, 1e-6};
    const double gap = 1e-4;
    for (int i = 0; i < 16; i++) {
        struct lab *lab = lab_create();
        struct row row = equal_row(i & 1 ? 5 : 3);
        row.speed[0] = 1.0;
        struct solve_request request = row_request(lab, &row);
        for (int k = 1; k < row.count; k++) {
            request.bodies[k].position[0] += (k - 1) * gap;
            request.contacts[k - 1].point[0] += (k - 1) * gap;
            request.contacts[k - 1].gap = k > 1 ? gap : 0.0;
        }
        request.options.method = methods[i >> 1 & 1];
        request.options.horizon = horizons[i >> 2 & 1];
        request.options.tolerance = tolerances[i >> 3 & 1];
        lab_solve(lab, &request, &result);
        assert_int_equal(result.end_reason, PERCUSS_END_SEPARATED);
        for (int k = 0; k < row.count; k++)
            measured("speed", result.bodies[k].velocity[0], k + 1 < row.count ? 0.0 : 1.0, 1e-5);
        lab_free(lab);
    }
}

/* The third sphere flees, so that the second follows it at `slow` m/s, some 30 um behind. */
static enum percuss_status follow(double slow, double horizon, struct solve_result *result)
{
    struct lab *lab = lab_create();
    struct row row = equal_row(3);
    row.speed[0] = 1.0;
    row.speed[2] = 1.0 - slow;
    struct solve_request request = row_request(lab, &row);
    request.options.horizon = horizon;
    request.options.tolerance = 1e-6;
    enum percuss_status status = solve(lab->workspace, &lab->means, &request, result);
    lab_free(lab);
    return status;
}

/* Speeds that the solution knows, however small, close their gap; those that take longer than the
 * horizon are not taken for none. */
static void slow_approaches_are_followed(void **state)
{
    (void)state;
    static struct solve_result result;
    static const double slow[] = {1e-2, 1e-3, 1e-4};
    for (size_t i = 0; i < COUNT(slow); i++) {
        assert_int_equal(follow(slow[i], 1.0, &result), PERCUSS_OK);
        assert_int_equal(result.end_reason, PERCUSS_END_SEPARATED);
        assert_int_equal(result.contacts[1].sub_impact_count, 1);
        measured_relative("exchanged", 1.0 - result.bodies[1].velocity[0], slow[i], 1e-4);
    }
    assert_int_equal(follow(1e-4, 0.01, &result), PERCUSS_TRUNCATED);
    assert_int_equal(result.end_reason, PERCUSS_END_HORIZON);
    assert_int_equal(follow(1e-7, 1.0, &result), PERCUSS_TRUNCATED);
    assert_int_equal(result.end_reason, PERCUSS_END_HORIZON);
}

/* Too much for one request: said, and not called accurate. */
static void effort_is_bounded(void **state)
{
    (void)state;
    static struct solve_result result;
    struct lab *lab = lab_create();
    struct row row = equal_row(24);
    row.speed[0] = 1.0;
    struct solve_request request = row_request(lab, &row);
    request.options.tolerance = 1e-8;
    assert_int_equal(solve(lab->workspace, &lab->means, &request, &result), PERCUSS_TRUNCATED);
    assert_int_equal(result.end_reason, PERCUSS_END_LIMIT);
    assert_false(result.tolerance_met);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_spheres_hit_from_one_side),
        cmocka_unit_test(several_spheres_hit_many),
        cmocka_unit_test(rows_hit_from_both_sides),
        cmocka_unit_test(unequal_masses),
        cmocka_unit_test(rows_with_gaps_come_to_rest),
        cmocka_unit_test(slow_approaches_are_followed),
        cmocka_unit_test(effort_is_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
