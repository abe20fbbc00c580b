/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/contact_step.c and node_solver.c: single steps against a fine
 * Runge-Kutta integration of the same equations, their order, and the local indentations. */
#include "impact/contact_step.h"
#include "unit/impact/toy_scene.h"

static const double omegas[] = {2.0, 11.0, 60.0};
/* contact by contact */
static const double shapes[] = {0.6, -0.4, 0.3, 0.2, 0.5, -0.3};
enum { MODES = 3, STATE = 4 + 2 * MODES };

/* Two contacts coupled rigidly, by modes and by residual flexibility; compressed already, so that
 * the forces are smooth. */
static void make(struct toy *toy, double damping)
{
    static const double q[MODES] = {0.01, -0.02, 0.003}, v[MODES] = {-0.1, 0.2, 0.05};
    toy_init(toy, 2);
    memcpy(toy->w, (double[]){1.0, 0.3, 0.3, 2.0}, 4 * sizeof(double));
    memcpy(toy->residual, (double[]){0.02, -0.005, -0.005, 0.03}, 4 * sizeof(double));
    toy->gap[0] = -0.5;
    toy->gap[1] = -0.4;
    toy->gap_rate[0] = -0.3;
    toy->gap_rate[1] = 0.1;
    toy->gap_acceleration[0] = -0.2;
    toy->laws[0] = contact_law_hertz(3.0);
    toy->laws[1] = contact_law_linear(4.0);
    toy_ring(toy, toy_add(toy, 0, MODES, omegas, damping, shapes), q, v);
}

/* d_i of d + residual F(d) = approach, by plain iteration: the residuals are small. */
static void local(const struct toy *toy, const double approach[2], double d[2], double force[2])
{
    double slope;
    d[0] = approach[0];
    d[1] = approach[1];
    for (int i = 0; i < 200; i++) {
        for (int c = 0; c < 2; c++)
            force[c] = contact_law_force(&toy->laws[c], d[c], &slope);
        for (int c = 0; c < 2; c++)
            d[c] =
                approach[c] - toy->residual[2 * c] * force[0] - toy->residual[2 * c + 1] * force[1];
    }
}

/* y: gaps, rates, q, v. */
static void rates(const struct toy *toy, double damping, const double y[STATE], double r[STATE])
{
    double approach[2] = {-y[0], -y[1]}, d[2], force[2];
    for (int c = 0; c < 2; c++)
        for (int k = 0; k < MODES; k++)
            approach[c] -= shapes[c * MODES + k] * y[4 + k];
    local(toy, approach, d, force);
    for (int c = 0; c < 2; c++) {
        r[c] = y[2 + c];
        r[2 + c] =
            toy->gap_acceleration[c] + toy->w[2 * c] * force[0] + toy->w[2 * c + 1] * force[1];
    }
    for (int k = 0; k < MODES; k++) {
        r[4 + k] = y[4 + MODES + k];
        r[4 + MODES + k] = shapes[k] * force[0] + shapes[MODES + k] * force[1] -
                           omegas[k] * (2.0 * damping * y[4 + MODES + k] + omegas[k] * y[4 + k]);
    }
}

static void runge_kutta(const struct toy *toy, double damping, double time, int steps,
                        double y[STATE])
{
    double h = time / steps;
    for (int n = 0; n < steps; n++) {
        double k[4][STATE], at[STATE];
        memcpy(at, y, sizeof at);
        for (int s = 0; s < 4; s++) {
            rates(toy, damping, at, k[s]);
            for (int i = 0; i < STATE; i++)
                at[i] = y[i] + (s == 2 ? 1.0 : 0.5) * h * k[s][i];
        }
        for (int i = 0; i < STATE; i++)
            y[i] += h / 6.0 * (k[0][i] + 2.0 * k[1][i] + 2.0 * k[2][i] + k[3][i]);
    }
}

static void start_values(const struct toy *toy, struct motion *motion,
                         struct contact_start start[2])
{
    double approach[2], rate[2], d[2], force[2];
    for (size_t c = 0; c < 2; c++)
        motion_approach(motion, &toy->scene, c, &approach[c], &rate[c]);
    local(toy, approach, d, force);
    for (size_t c = 0; c < 2; c++)
        start[c] = (struct contact_start){d[c], rate[c], 0.0, 0.0};
}

/* Largest difference of a chain of `count` steps of a level from Runge and Kutta's. `loss`: NULL
 * where the modes are carried from step to step, else the motion is whole between them, which tells
 * better starting values. */
static double difference(struct toy *toy, double damping, int level, int count, double *loss)
{
    struct contact_start start[2];
    struct contact_step step = {0};
    struct motion motion;
    double y[STATE];
    assert_true(contact_step_create(&step, &toy->scene, 0.0, &toy->arena));
    assert_true(motion_create(&motion, &toy->scene, &toy->arena));
    motion_start(&motion, &toy->scene);
    memcpy(y, motion.gap, 2 * sizeof *y);
    memcpy(y + 2, motion.gap_rate, 2 * sizeof *y);
    memcpy(y + 4, motion.q[0], MODES * sizeof *y);
    memcpy(y + 4 + MODES, motion.v[0], MODES * sizeof *y);
    runge_kutta(toy, damping, count * step_length(level), 8000, y);
    start_values(toy, &motion, start);
    for (int i = 0; i < count; i++) {
        assert_int_equal(contact_step_solve(&step, &toy->scene, &motion, level, start),
                         STEP_SOLVED);
        contact_step_take(&step, &toy->scene, &motion);
        for (int c = 0; c < 2; c++)
            start[c] = (struct contact_start){step.end_indentation[c], 0.0, 0.0, 0.0};
        if (loss) {
            *loss += step.loss;
            contact_step_leave(&step, &toy->scene, &motion);
            start_values(toy, &motion, start);
        }
    }
    contact_step_leave(&step, &toy->scene, &motion);
    double worst = 0.0;
    for (int c = 0; c < 2; c++) {
        worst = fmax(worst, fabs(motion.gap[c] - y[c]));
        worst = fmax(worst, fabs(motion.gap_rate[c] - y[2 + c]));
    }
    for (int k = 0; k < MODES; k++) {
        worst = fmax(worst, fabs(motion.q[0][k] - y[4 + k]) * omegas[k]);
        worst = fmax(worst, fabs(motion.v[0][k] - y[4 + MODES + k]));
    }
    return worst;
}

static void a_step_matches_runge_kutta(void **state)
{
    (void)state;
    static const double dampings[] = {0.0, 0.05, 0.6};
    for (int i = 0; i < 3; i++) {
        struct toy toy;
        double loss = 0.0;
        make(&toy, dampings[i]);
        /* one step of 1/32 s, a third of the fastest radian: eighth order and more; Runge and
         * Kutta's own (60/32/8000)^4 is below 1e-14 */
        measured("a step of 1/32", difference(&toy, dampings[i], 5, 1, &loss), 0.0, 1e-9);
        assert_true(dampings[i] > 0.0 ? loss > 0.0 : loss == 0.0);
        measured("sixteen carried", difference(&toy, dampings[i], 6, 16, NULL), 0.0, 1e-9);
        toy_free(&toy);
    }
}

/* Gauss collocation: the error at a given time falls with the eighth power of the step. */
static void the_order_is_eight(void **state)
{
    (void)state;
    struct toy toy;
    double loss = 0.0;
    make(&toy, 0.0);
    double error[3];
    for (int i = 0; i < 3; i++)
        error[i] = difference(&toy, 0.0, 3 + i, 4 << i, &loss);
    /* the fastest mode's force turns by 7.5 rad in a step of 1/8: a factor of 2^8 in the end, 150
     * and 180 here */
    assert_true(error[0] > 64.0 * error[1]);
    assert_true(error[1] > 64.0 * error[2]);
    toy_free(&toy);
}

/* No modes, linear law, one contact: a mass on a spring, exact to the eighth order. */
static void a_mass_on_a_spring(void **state)
{
    (void)state;
    struct toy toy;
    struct contact_step step = {0};
    struct motion motion;
    toy_init(&toy, 1);
    toy.laws[0] = contact_law_linear(9.0); /* omega = 3 with w = 1 */
    toy.gap[0] = -1.0;
    assert_true(contact_step_create(&step, &toy.scene, 0.0, &toy.arena));
    assert_true(motion_create(&motion, &toy.scene, &toy.arena));
    motion_start(&motion, &toy.scene);
    struct contact_start start = {1.0, 0.0, -9.0, 0.0};
    assert_int_equal(contact_step_solve(&step, &toy.scene, &motion, 3, &start), STEP_SOLVED);
    measured("untouched", motion.gap[0], -1.0, 0.0);
    contact_step_take(&step, &toy.scene, &motion);
    contact_step_leave(&step, &toy.scene, &motion);
    measured("gap", motion.gap[0], -cos(3.0 / 8.0), 1e-10);
    measured("rate", motion.gap_rate[0], 3.0 * sin(3.0 / 8.0), 1e-10);
    measured("indentation", step.end_indentation[0], cos(3.0 / 8.0), 1e-10);
    for (int i = 0; i < NODES; i++)
        measured("force", step.force[0][i], 9.0 * cos(3.0 / 8.0 * collocation.node[i]), 1e-5);
    measured("time", motion.time, 0.125, 0.0);
    toy_free(&toy);
}

/* F_i = law(d_i - sum residual F): closed contacts obey it, an open one has none. */
static void local_indentations(void **state)
{
    (void)state;
    struct toy toy;
    make(&toy, 0.0);
    for (double approach = 1e-9; approach < 10.0; approach *= 7.0) {
        double approaches[2] = {approach, 0.3 * approach}, d[2], force[2], matrix[4], expected[2],
               forces[2], slope;
        memcpy(d, approaches, sizeof d);
        assert_true(contact_local_indentation(&toy.scene, approaches, d, force, matrix));
        local(&toy, approaches, expected, forces);
        for (int c = 0; c < 2; c++) {
            measured("both", d[c], expected[c], 1e-12 * approach);
            measured("force", force[c], forces[c], 1e-11 * forces[c]);
        }
        approaches[1] = -approach;
        assert_true(contact_local_indentation(&toy.scene, approaches, d, force, matrix));
        measured("closed", d[0] + 0.02 * force[0], approaches[0], 1e-13 * approach);
        measured("its force", force[0], contact_law_force(&toy.laws[0], d[0], &slope),
                 1e-11 * force[0]);
        measured("open", d[1], approaches[1] + 0.005 * force[0], 1e-13 * approach);
        assert_true(force[1] == 0.0);
    }
    toy_free(&toy);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_step_matches_runge_kutta),
        cmocka_unit_test(the_order_is_eight),
        cmocka_unit_test(a_mass_on_a_spring),
        cmocka_unit_test(local_indentations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
