/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/coulomb.c: rigid bodies in closed form. test_friction_random.c has
 * bodies that vibrate and yield, unit/solve/test_oblique.c a beam. */
#include "impact/coulomb.h"

#include <math.h>

#include "model/relaxation.h"
#include "unit/impact/toy_scene.h"

static const double MU = 0.3;

/* Slip before and after are those of one point of unit mass, turned by spin 3.5 times as light
 * along two tangents: a solid sphere on a half-space. */
static void sphere_init(struct toy *toy, struct scene_friction *friction, double mu)
{
    toy_init(toy, 1);
    *friction = (struct scene_friction){.coefficient = mu, .ratio = {0.8, 0.0, 0.8}};
    scene_set_frictions(&toy->scene, 1);
    toy->scene.friction = friction;
    toy->scene.plain = true;
    toy->w[4] = toy->w[8] = 3.5;
    toy->gap_rate[0] = -1.0;
}

static const double ACCURACY[] = {1e-3, 1e-5, 1e-8};

/* The slip after is none, or what the coefficient of the normal impulse leaves: psi2 = 0 up to
 * psi1 = 4 chi, where mu (1 + e) times 3.5 is the slip before over the approach. To rounding: where
 * it sticks the rate is zero at the end of each step. */
static void spheres(void **state)
{
    (void)state;
    for (size_t a = 0; a < COUNT(ACCURACY); a++)
        for (double slip = 0.0; slip < 4.0; slip += 0.37) {
            struct toy toy;
            struct scene_friction friction;
            sphere_init(&toy, &friction, MU);
            toy.gap_rate[1] = 0.6 * slip;
            toy.gap_rate[2] = 0.8 * slip;
            struct impact_outcome outcome = toy_run(&toy, ACCURACY[a], 100.0);
            const struct track *track = &outcome.tracks[0];
            double left = fmax(0.0, slip - 3.5 * MU * track->impulse);
            near(outcome.motion.gap_rate[1], 0.6 * left, 1e-13);
            near(outcome.motion.gap_rate[2], 0.8 * left, 1e-13);
            near(hypot(track->tangential[0], track->tangential[1]), (slip - left) / 3.5, 1e-13);
            /* as the normal motion's own */
            near(outcome.energy.closure / outcome.energy.available, 0.0, 1e-5);
            near(outcome.energy.friction, (slip * slip - left * left) / 7.0,
                 1e-12 * outcome.energy.available);
            assert_int_equal(track->list[0].friction_state, left > 0.0 ? PERCUSS_FRICTION_STATE_SLID
                                                            : slip > 0.0
                                                                ? PERCUSS_FRICTION_STATE_PARTLY
                                                                : PERCUSS_FRICTION_STATE_STUCK);
            /* a step that sticks and slides is found in some ten halvings */
            assert_true(outcome.rejected < 30);
            toy_free(&toy);
        }
}

/* A body in a joint that no force moves along one tangent, or along both: what slides there goes
 * on, and what stands is as if that tangent were not. */
static void held_along_a_tangent(void **state)
{
    (void)state;
    static const double w[][2] = {{3.5, 0.0}, {0.0, 3.5}, {0.0, 0.0}};
    for (size_t i = 0; i < COUNT(w); i++)
        for (int moving = 0; moving < 4; moving++) {
            struct toy toy;
            struct scene_friction friction;
            sphere_init(&toy, &friction, MU);
            toy.w[4] = w[i][0];
            toy.w[8] = w[i][1];
            toy.gap_rate[1] = moving & 1 ? 0.5 : 0.0;
            toy.gap_rate[2] = moving & 2 ? 0.5 : 0.0;
            const struct impact_outcome outcome = toy_run(&toy, 1e-5, 100.0);
            const struct track *track = &outcome.tracks[0];
            double limit = MU * track->impulse;
            double size = hypot(track->tangential[0], track->tangential[1]);
            bool slides = false;
            for (int t = 0; t < 2; t++) {
                bool moves = moving & (1 << t), held = w[i][t] == 0.0;
                slides = slides || (moves && held);
                /* beside a slip that goes on the other one fades, as the force turns to that */
                if (held || moving != 3)
                    near(outcome.motion.gap_rate[1 + t], moves && held ? 0.5 : 0.0, 1e-12);
            }
            if (slides && moving != 3)
                near(size, limit, 1e-12);
            assert_true(size <= limit * (1.0 + 1e-12));
            near(outcome.energy.closure / outcome.energy.available, 0.0, 1e-5);
            toy_free(&toy);
        }
}

/* ---- Laws that lose ---- */

/* Hunt and Crossley's law, with a loss so large that it parts while indented, and two of materials
 * that relax. */
static const struct relaxation slow = {1, {0.5}, {4.0}}, fast = {2, {0.3, 0.4}, {0.2, 3.0}};
enum { LOSSY = 4 };

static void lossy_laws(struct contact_law laws[LOSSY])
{
    laws[0] = contact_law_dissipative(1.0, 1.5, 0.3);
    laws[1] = contact_law_dissipative(1.0, 2.0, 2.0);
    laws[2] = contact_law_viscoelastic(1.0, &slow);
    laws[3] = contact_law_viscoelastic(1.0, &fast);
}

/* A sphere's normal motion is that without friction, and its slip as above: by the normal impulse
 * alone. */
static void lossy_spheres(void **state)
{
    (void)state;
    struct contact_law laws[LOSSY];
    lossy_laws(laws);
    for (size_t l = 0; l < LOSSY; l++) {
        struct toy alone;
        toy_init(&alone, 1);
        alone.gap_rate[0] = -1.0;
        alone.laws[0] = laws[l];
        const struct impact_outcome bare = toy_run(&alone, 1e-6, 100.0);
        assert_true(bare.tracks[0].impulse < 1.95);
        for (double slip = 0.0; slip < 3.0; slip += 0.7) {
            struct toy toy;
            struct scene_friction friction;
            sphere_init(&toy, &friction, MU);
            toy.laws[0] = laws[l];
            toy.gap_rate[1] = 0.6 * slip;
            toy.gap_rate[2] = 0.8 * slip;
            const struct impact_outcome outcome = toy_run(&toy, 1e-6, 100.0);
            const struct track *track = &outcome.tracks[0];
            double left = fmax(0.0, slip - 3.5 * MU * track->impulse);
            /* each round goes on where Newton's method ended, by its last change at this accuracy;
             * where it stops the steps are others */
            bool same = left > 0.0 || slip == 0.0;
            near(track->impulse, bare.tracks[0].impulse, same ? 1e-9 : 1e-6);
            /* rounding of some hundred steps, more than elastic contacts take */
            near(outcome.motion.gap_rate[1], 0.6 * left, 1e-12);
            near(outcome.motion.gap_rate[2], 0.8 * left, 1e-12);
            near(outcome.energy.friction, (slip * slip - left * left) / 7.0, 1e-12);
            near(outcome.energy.damping, bare.energy.damping, 2e-6);
            near(outcome.energy.closure, 0.0, 1e-6);
            toy_free(&toy);
        }
        toy_free(&alone);
    }
}

/* A bar that falls askew and slides throughout: its normal motion is that without friction of a
 * body with the inverse mass w_nn - mu w_nt, and as much less residual flexibility. By CVODE. */
static void lossy_bars(void **state)
{
    (void)state;
    struct contact_law laws[LOSSY];
    lossy_laws(laws);
    for (size_t l = 0; l < LOSSY; l++)
        for (int way = -1; way <= 1; way += 2) {
            const double soft = 0.1;
            struct toy toy, alone;
            struct scene_friction friction;
            sphere_init(&toy, &friction, MU);
            toy.laws[0] = laws[l];
            toy.gap_rate[1] = 20.0 * way;
            toy.w[1] = toy.w[3] = 0.9;
            toy.residual[0] = 2.0 * soft;
            toy.residual[1] = toy.residual[3] = soft;
            toy.residual[4] = toy.residual[8] = 3.0 * soft;
            toy_init(&alone, 1);
            alone.laws[0] = laws[l];
            alone.gap_rate[0] = -1.0;
            alone.w[0] = 1.0 - 0.9 * MU * way;
            alone.residual[0] = (2.0 - MU * way) * soft;
            const struct impact_outcome outcome = toy_run(&toy, 1e-9, 100.0);
            const struct impact_outcome bare = toy_cvode(&alone, 1e-11, 100.0);
            near_relative(outcome.tracks[0].impulse, bare.tracks[0].impulse, 1e-6);
            /* cvode's is the largest at its steps */
            near_relative(outcome.tracks[0].list[0].peak_force, bare.tracks[0].list[0].peak_force,
                          1e-4);
            near_relative(outcome.tracks[0].tangential[0], -way * MU * outcome.tracks[0].impulse,
                          1e-12);
            near(outcome.energy.closure / outcome.energy.available, 0.0, 1e-7);
            toy_free(&toy);
            toy_free(&alone);
        }
}

/* Gap, slip, a mode's q, and their rates under Hunt and Crossley's force and mu times it. */
struct pushed {
    double omega, phi[2], w[2], mu, loss;
};

static double push(const struct pushed *of, const double y[6], double rate[6])
{
    double d = -y[0] - of->phi[0] * y[2], speed = -y[3] - of->phi[0] * y[5];
    double force = d > 0.0 ? fmax(0.0, d * sqrt(d) * (1.0 + of->loss * speed)) : 0.0;
    memcpy(rate, y + 3, 3 * sizeof *rate);
    rate[3] = (1.0 - of->mu * of->w[0]) * force;
    rate[4] = (of->w[0] - of->mu * of->w[1]) * force;
    rate[5] = (of->phi[0] - of->mu * of->phi[1]) * force - of->omega * of->omega * y[2];
    return force;
}

/* The same with a mode, which friction drives, by Runge and Kutta's steps; it slides throughout. */
static void a_lossy_bar_rings(void **state)
{
    (void)state;
    enum { STEPS = 40000 };
    static const double participation[] = {0.5, 0.4, 0.0};
    const struct pushed of = {2.5, {0.5, 0.4}, {0.6, 3.5}, MU, 0.4};
    const double h = 6.0 / STEPS;
    double y[6] = {0.0, 0.0, 0.0, -1.0, 20.0, 0.0}, impulse = 0.0;
    for (int step = 0; step < STEPS; step++) {
        static const double weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
        static const double part[4] = {0.0, 0.5, 0.5, 1.0};
        double rate[6] = {0.0}, sum[6] = {0.0};
        for (int s = 0; s < 4; s++) {
            double at[6];
            for (int k = 0; k < 6; k++)
                at[k] = y[k] + part[s] * h * rate[k];
            impulse += weight[s] * h * push(&of, at, rate);
            for (int k = 0; k < 6; k++)
                sum[k] += weight[s] * rate[k];
        }
        for (int k = 0; k < 6; k++)
            y[k] += h * sum[k];
    }
    struct toy toy;
    struct scene_friction friction;
    sphere_init(&toy, &friction, MU);
    toy.laws[0] = contact_law_dissipative(1.0, 1.5, of.loss);
    toy.w[1] = toy.w[3] = of.w[0];
    toy.gap_rate[1] = 20.0;
    toy_add(&toy, 0, 1, &of.omega, 0.0, participation);
    const struct impact_outcome outcome = toy_run(&toy, 1e-9, 6.0);
    near_relative(outcome.tracks[0].impulse, impulse, 1e-6);
    near(outcome.motion.gap_rate[0], y[3], 1e-6);
    near(outcome.motion.gap_rate[1], y[4], 1e-6);
    near(outcome.energy.closure / outcome.energy.available, 0.0, 1e-7);
    toy_free(&toy);
}

/* Bodies so light along one tangent that the slip turns; without friction across it the limit of
 * that turn is the point's own path, by short steps. */
static void slips_that_turn(void **state)
{
    (void)state;
    static const double light[2] = {3.5, 1.0};
    double rate[2][2] = {{0.0}};
    struct toy toy;
    struct scene_friction friction;
    sphere_init(&toy, &friction, MU);
    toy.w[8] = light[1];
    toy.gap_rate[1] = 2.0;
    toy.gap_rate[2] = 1.0;
    struct impact_outcome outcome = toy_run(&toy, 1e-8, 100.0);
    /* d(slip)/d(normal impulse) = -mu light slip/|slip|, by the middle, with 1000 and 2000 steps */
    for (int way = 0; way < 2; way++) {
        int steps = 1000 << way;
        double h = outcome.tracks[0].impulse / steps, *slip = rate[way];
        slip[0] = 2.0;
        slip[1] = 1.0;
        for (int i = 0; i < steps; i++) {
            double size = hypot(slip[0], slip[1]), middle[2];
            for (int t = 0; t < 2; t++)
                middle[t] = slip[t] - 0.5 * h * MU * light[t] * slip[t] / size;
            size = hypot(middle[0], middle[1]);
            for (int t = 0; t < 2; t++)
                slip[t] -= h * MU * light[t] * middle[t] / size;
        }
    }
    for (int t = 0; t < 2; t++) {
        near(rate[0][t], rate[1][t], 1e-7);
        near(outcome.motion.gap_rate[1 + t], rate[1][t], 1e-7);
    }
    toy_free(&toy);
}

/* A sphere falls straight into a right-angled groove without spin. It slides along both walls, down
 * against (1 + mu) and up with (1 - mu) of their force: it rebounds with the root of the quotient.
 * From mu = 1 on it stays wedged, and presses. */
static void in_a_groove(void **state)
{
    (void)state;
    enum { ROWS = 6 };
    static const double x[ROWS] = {M_SQRT1_2, -M_SQRT1_2, M_SQRT1_2, 0.0, -M_SQRT1_2, 0.0};
    static const double z[ROWS] = {M_SQRT1_2, M_SQRT1_2, -M_SQRT1_2, 0.0, -M_SQRT1_2, 0.0};
    static const double turn[ROWS] = {0.0, 0.0, 1.0, 0.0, -1.0, 0.0};
    static const double coefficients[] = {0.05, 0.3, 0.9, 1.2};
    for (size_t i = 0; i < COUNT(coefficients); i++) {
        double mu = coefficients[i];
        struct toy toy;
        struct scene_friction friction[2];
        toy_init(&toy, 2);
        for (size_t c = 0; c < 2; c++)
            friction[c] =
                (struct scene_friction){.contact = c, .coefficient = mu, .ratio = {0.8, 0.0, 0.8}};
        scene_set_frictions(&toy.scene, 2);
        toy.scene.friction = friction;
        toy.scene.plain = true;
        for (size_t a = 0; a < ROWS; a++)
            for (size_t b = 0; b < ROWS; b++)
                toy.w[a * ROWS + b] = x[a] * x[b] + z[a] * z[b] + 2.5 * turn[a] * turn[b] +
                                      (a == b && (a == 3 || a == 5) ? 3.5 : 0.0);
        for (size_t r = 0; r < ROWS; r++)
            toy.gap_rate[r] = -z[r];
        struct impact_outcome outcome = toy_run(&toy, 1e-8, 100.0);
        double rebound = mu < 1.0 ? sqrt((1.0 - mu) / (1.0 + mu)) : 0.0;
        for (size_t r = 0; r < ROWS; r++)
            near(outcome.motion.gap_rate[r], z[r] * rebound, 1e-6);
        assert_int_equal(outcome.end_reason,
                         mu < 1.0 ? PERCUSS_END_SEPARATED : PERCUSS_END_IN_CONTACT);
        near(outcome.energy.closure / outcome.energy.available, 0.0, 1e-7);
        toy_free(&toy);
    }
}

/* Two contacts of one body that slide the same way, and stop together: how they share what stops
 * them is not determined, the motion is. One is three times as stiff. */
static void two_of_one_body(void **state)
{
    (void)state;
    enum { ROWS = 6 };
    for (double slip = 0.3; slip < 3.0; slip += 0.8) {
        struct toy toy;
        struct scene_friction friction[2] = {
            {.contact = 0, .coefficient = MU, .ratio = {0.8, 0.0, 0.8}},
            {.contact = 1, .coefficient = MU, .ratio = {0.8, 0.0, 0.8}}};
        toy_init(&toy, 2);
        scene_set_frictions(&toy.scene, 2);
        toy.scene.friction = friction;
        toy.scene.plain = true;
        toy.laws[1] = contact_law_hertz(3.0);
        for (size_t a = 0; a < ROWS; a++)
            for (size_t b = 0; b < ROWS; b++)
                toy.w[a * ROWS + b] = a < 2 ? a == b : b >= 2 && a % 2 == b % 2;
        for (size_t c = 0; c < 2; c++) {
            toy.gap_rate[c] = -1.0;
            toy.gap_rate[2 + 2 * c] = 0.6 * slip;
            toy.gap_rate[3 + 2 * c] = -0.8 * slip;
        }
        struct impact_outcome outcome = toy_run(&toy, 1e-6, 100.0);
        double pressed = outcome.tracks[0].impulse + outcome.tracks[1].impulse;
        double left = fmax(0.0, slip - MU * pressed);
        for (size_t c = 0; c < 2; c++) {
            near(outcome.motion.gap_rate[2 + 2 * c], 0.6 * left, 1e-6);
            near(outcome.motion.gap_rate[3 + 2 * c], -0.8 * left, 1e-6);
        }
        near(outcome.energy.friction, 0.5 * (slip * slip - left * left), 1e-6);
        toy_free(&toy);
    }
}

/* What the surfaces slid before they touch is no slip of the contact. */
static void slid_before_the_touch(void **state)
{
    (void)state;
    double impulse[3], travel[3];
    for (int way = 0; way < 3; way++) {
        struct toy toy;
        struct scene_friction friction;
        sphere_init(&toy, &friction, 0.1);
        toy.gap_rate[1] = 0.5;
        toy.gap[0] = way == 2 ? 5.0 : 0.0;
        toy.gap[1] = way == 1 ? 2.0 : 0.0;
        struct impact_outcome outcome = toy_run(&toy, 1e-6, 100.0);
        impulse[way] = outcome.tracks[0].tangential[0];
        /* and where the surfaces are is known afterwards */
        travel[way] = outcome.motion.gap[1] - toy.gap[1];
        toy_free(&toy);
    }
    near_relative(impulse[1], impulse[0], 1e-10);
    near_relative(impulse[2], impulse[0], 1e-10);
    near_relative(travel[1], travel[0], 1e-10);
    assert_true(travel[2] > travel[0] + 2.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spheres),           cmocka_unit_test(held_along_a_tangent),
        cmocka_unit_test(slips_that_turn),   cmocka_unit_test(in_a_groove),
        cmocka_unit_test(two_of_one_body),   cmocka_unit_test(slid_before_the_touch),
        cmocka_unit_test(lossy_spheres),     cmocka_unit_test(lossy_bars),
        cmocka_unit_test(a_lossy_bar_rings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
