/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Requests that state the simulator's own w^T M^-1 w of normals and tangents: the bodies' own
 * matrix changes nothing; those of other bodies and of mechanisms have these bodies' answers. */
#include "physics/support.h"

enum { MOST = 3, ROWS = 3 * MOST };
static struct solve_result result, other;

/* ---- The matrix, by the bodies' masses in the world ---- */

struct arm {
    unsigned body;
    double direction[3], point[3];
};

static void find_arm(const struct solve_contact *contact, int row, struct arm *arm)
{
    double second[3];
    cross3(contact->normal, contact->tangent, second);
    memcpy(arm->direction,
           row == 0   ? contact->normal
           : row == 1 ? contact->tangent
                      : second,
           sizeof arm->direction);
    memcpy(arm->point, contact->point, sizeof arm->point);
}

/* d_i.d_j/m + (r_i x d_i).I^-1 (r_j x d_j), I^-1 = sum of axis axis^T/moment. */
static double respond(const struct body *body, const struct solve_body *at, const struct arm *i,
                      const struct arm *j)
{
    double rotation[9], r[2][3], moment[2][3];
    const struct arm *arms[2] = {i, j};
    if (isinf(body->mass))
        return 0.0;
    rotation_matrix(at->orientation, rotation);
    for (int k = 0; k < 2; k++) {
        sub3(arms[k]->point, at->position, r[k]);
        cross3(r[k], arms[k]->direction, moment[k]);
    }
    double sum = dot3(i->direction, j->direction) / body->mass;
    for (int a = 0; a < 3; a++) {
        const double axis[3] = {rotation[a], rotation[3 + a], rotation[6 + a]};
        sum += dot3(axis, moment[0]) * dot3(axis, moment[1]) / body->inertia[a];
    }
    return sum;
}

/* Rows normal, first and second tangent of each contact; the first one is stated and a unit one. */
static void find_matrix(const struct lab *lab, const struct solve_request *request, double *w)
{
    size_t n = request->contact_count;
    for (size_t i = 0; i < 3 * n; i++)
        for (size_t j = 0; j < 3 * n; j++) {
            const struct solve_contact *x = &request->contacts[i / 3];
            const struct solve_contact *y = &request->contacts[j / 3];
            struct arm of, at;
            find_arm(x, (int)(i % 3), &of);
            find_arm(y, (int)(j % 3), &at);
            w[i * 3 * n + j] = 0.0;
            for (int p = 0; p < 4; p++) {
                unsigned a = p / 2 ? x->b : x->a, b = p % 2 ? y->b : y->a;
                double sign = p == 0 || p == 3 ? 1.0 : -1.0;
                if (a == b)
                    w[i * 3 * n + j] +=
                        sign * respond(body_set_find(&lab->set, request->bodies[a].id),
                                       &request->bodies[a], &of, &at);
            }
        }
}

static bool warned(const struct solve_result *of, const char *text)
{
    for (size_t i = 0; i < of->warning_count; i++)
        if (strstr(of->warnings[i], text))
            return true;
    return false;
}

static void state_matrix(struct solve_request *request, const double *w)
{
    request->delassus = w;
    request->delassus_oblique = true;
}

/* ---- The bodies' own ---- */

/* Both answers, that by the matrix in `result`. */
static void ask_both(struct lab *lab, struct solve_request *request, const double *w)
{
    request->delassus = NULL;
    lab_solve(lab, request, &other);
    state_matrix(request, w);
    lab_solve(lab, request, &result);
    assert_int_equal(other.delassus_source, PERCUSS_DELASSUS_SERVICE);
    assert_int_equal(result.delassus_source, PERCUSS_DELASSUS_CLIENT);
    assert_false(warned(&result, "delassus"));
}

/* To what the rounding of the matrix leaves. */
static void same_answers(void)
{
    static const double left = 1e-9;
    for (size_t c = 0; c < result.contact_count; c++) {
        const struct solve_contact_result *a = &result.contacts[c], *b = &other.contacts[c];
        near_relative(a->impulse, b->impulse, left);
        near_relative(a->inverse_effective_mass, b->inverse_effective_mass, left);
        assert_int_equal(a->friction_state, b->friction_state);
        assert_int_equal(a->sub_impact_count, b->sub_impact_count);
        for (int t = 0; t < 2; t++) {
            near(a->impulse_tangential[t], b->impulse_tangential[t], left * b->impulse);
            near(a->slip_before[t], b->slip_before[t], left);
            near(a->slip_after[t], b->slip_after[t], left);
        }
    }
    near_relative(result.energy.available, other.energy.available, left);
    near(result.energy.friction, other.energy.friction, left * other.energy.available);
    near(result.energy.rigid_after, other.energy.rigid_after, left * other.energy.available);
}

static struct solve_request slides(const struct lab *lab, struct spot a, struct spot b, double mu)
{
    (void)lab;
    struct solve_request request = strike(a, b, 0.5);
    request.bodies[0].velocity[0] = 0.3;
    request.bodies[0].velocity[1] = 0.2;
    request.contacts[0].friction = mu;
    request.contacts[0].tangent[0] = 1.0;
    return request;
}

/* W_tt = 7/2 W_nn of a solid ball, and nothing couples. */
static void a_ball_on_a_wall(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "wall", rigid_wall());
    struct solve_request request = slides(lab, sphere_spot("ball", 0.015), wall_spot("wall"), 0.2);
    double m = lab->bodies[0].mass, w[ROWS * ROWS];
    find_matrix(lab, &request, w);
    for (int i = 0; i < 9; i++)
        near(w[i] * m, i == 0 ? 1.0 : i == 4 || i == 8 ? 3.5 : 0.0, 1e-12);
    ask_both(lab, &request, w);
    same_answers();
    lab_free(lab);
}

/* Friction on the cap of a leaning bar presses it against the wall: W_nt is not 0. */
static void a_leaning_bar(void **state)
{
    (void)state;
    static const double r = 6.35e-3, lean = 0.5;
    struct lab *lab = lab_create();
    struct body bar = make_bar(&beam_kind, STEEL, r, 0.2);
    bar.tip_radius = r;
    lab_add(lab, "bar", bar);
    lab_add(lab, "wall", rigid_wall());
    struct spot cap = {"bar",
                       {-0.1 + r * (1.0 - cos(lean)), 0.0, -r * sin(lean)},
                       {-cos(lean), 0.0, -sin(lean)},
                       0.0};
    struct solve_request request = slides(lab, cap, wall_spot("wall"), 0.1);
    double w[ROWS * ROWS];
    /* the second tangent holds some of both couplings */
    request.contacts[0].tangent[0] = cos(0.7);
    request.contacts[0].tangent[1] = sin(0.7);
    find_matrix(lab, &request, w);
    assert_true(fabs(w[1]) > 0.1 * w[0] && fabs(w[2]) > 0.1 * w[0] && fabs(w[5]) > 0.1 * w[0]);
    ask_both(lab, &request, w);
    same_answers();
    lab_free(lab);
}

/* A ball in a groove: each wall's tangent is partly the other one's normal. */
static void a_ball_in_a_groove(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.01));
    lab_add(lab, "wall", rigid_wall());
    struct solve_request request = {.body_count = 3, .contact_count = 2};
    double w[ROWS * ROWS];
    request.bodies[0] =
        (struct solve_body){.id = "ball", .orientation = {1.0}, .velocity = {0.1, 0.3, -1.0}};
    for (int side = 0; side < 2; side++) {
        const double outward[3] = {0.0, side ? -M_SQRT1_2 : M_SQRT1_2, M_SQRT1_2};
        struct solve_contact *contact = &request.contacts[side];
        *contact = (struct solve_contact){
            .b = (unsigned)side + 1, .friction = side ? 0.1 : 0.3, .tangent = {1.0}};
        memcpy(contact->normal, outward, sizeof outward);
        scale3(-0.01, outward, contact->point);
        memcpy(request.bodies[side + 1].id, "wall", 5);
        put(&request.bodies[side + 1], &(struct spot){"wall", {0.0}, {0.0, 0.0, 1.0}, 0.0},
            outward);
        memcpy(request.bodies[side + 1].position, contact->point, sizeof contact->point);
    }
    find_matrix(lab, &request, w);
    ask_both(lab, &request, w);
    same_answers();
    lab_free(lab);
}

/* Balls on a beam, which vibrates: tangents askew to its axis, and one of the contacts without
 * friction, whose tangents' numbers say nothing. */
static void balls_on_a_beam(void **state)
{
    (void)state;
    static const double places[MOST] = {-0.31, 0.02, 0.25};
    struct lab *lab = lab_create();
    struct solve_request request = {.body_count = MOST + 1, .contact_count = MOST};
    double w[ROWS * ROWS];
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    request.bodies[0] = (struct solve_body){.id = "beam", .orientation = {1.0}};
    for (unsigned i = 0; i < MOST; i++) {
        request.bodies[i + 1] = (struct solve_body){.id = "ball",
                                                    .position = {places[i], 0.0, 0.025},
                                                    .orientation = {1.0},
                                                    .velocity = {0.1, 0.05, -0.2 - 0.1 * i}};
        request.contacts[i] = (struct solve_contact){.a = i + 1,
                                                     .point = {places[i], 0.0, 0.010},
                                                     .normal = {0.0, 0.0, 1.0},
                                                     .friction = i == 1 ? 0.0 : 0.2,
                                                     .tangent = {cos(i + 0.4), sin(i + 0.4)}};
    }
    find_matrix(lab, &request, w);
    assert_true(fabs(w[1 * ROWS + 2]) > 0.01 * w[ROWS + 1]);
    ask_both(lab, &request, w);
    same_answers();
    for (int i = 0; i < ROWS; i++)
        w[4 * ROWS + i] = w[i * ROWS + 4] = 1e6;
    lab_solve(lab, &request, &result);
    assert_false(warned(&result, "delassus"));
    same_answers();
    lab_free(lab);
}

/* ---- Those of others ---- */

/* A ball of half the density is the same contact on half the mass; its matrix is what the answer
 * goes by, and the warning says that it is not the catalogue's. */
static void another_ball(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    struct body light = make_sphere(STEEL, 0.015);
    light.material.density *= 0.5;
    lab_add(lab, "heavy", make_sphere(STEEL, 0.015));
    lab_add(lab, "light", light);
    lab_add(lab, "wall", rigid_wall());
    double w[ROWS * ROWS];
    for (int i = 0; i < 2; i++) {
        /* sticks at first and springs back, or slides throughout */
        double mu = i ? 0.05 : 0.4;
        struct solve_request request =
            slides(lab, sphere_spot("light", 0.015), wall_spot("wall"), mu);
        find_matrix(lab, &request, w);
        lab_solve(lab, &request, &other);
        memcpy(request.bodies[0].id, "heavy", 6);
        state_matrix(&request, w);
        lab_solve(lab, &request, &result);
        assert_true(warned(&result, "delassus: differs from that of the catalogue's bodies by up"));
        same_answers();
    }
    lab_free(lab);
}

/* W_tt with chi 1.4412 and 1 of both tangents, chi = kappa W_tt/(2 W_nn): a foundation of 2000
 * cells, psi = kappa/mu slip/approach before and after. */
static void two_inverse_masses(void **state)
{
    (void)state;
    static const double row[][4] = {
        {1.5, 1.0, -0.5362, -0.7410}, {2.4, 1.8, -0.9181, -0.9794}, {3.0, 3.0, -0.3851, -0.1766}};
    static const double mu = 0.25, kappa = 1.4 / 1.7;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "wall", rigid_wall());
    double m = lab->bodies[0].mass, w[9] = {1.0 / m, 0.0, 0.0, 0.0, 3.5 / m, 0.0, 0.0, 0.0};
    w[8] = 2.0 / kappa / m;
    for (size_t i = 0; i < COUNT(row); i++) {
        struct solve_request request = strike(sphere_spot("ball", 0.015), wall_spot("wall"), 1.0);
        for (int t = 0; t < 2; t++)
            request.bodies[0].velocity[t] = row[i][t] * mu / kappa;
        request.contacts[0].friction = mu;
        request.contacts[0].tangent[0] = 1.0;
        request.options.tolerance = 1e-4;
        state_matrix(&request, w);
        lab_solve(lab, &request, &result);
        /* with the half digit of the values; the answer's own error is 1e-4 */
        for (int t = 0; t < 2; t++)
            measured("slip after", result.contacts[0].slip_after[t] * kappa / mu, row[i][2 + t],
                     1.5e-4);
        near(result.contacts[0].restitution, 1.0, 1e-5);
    }
    lab_free(lab);
}

/* ---- A double pendulum ----
 *
 * A uniform rod of mass m1 and length l1 turns about a pivot; at its end hinges a light rod of
 * length l2 that carries a ball, mass m2, radius R, which meets a wall (normal z). Angles are from
 * the downward vertical towards x, both absolute: with u = (sin, -cos) of an angle and perp(x, z) =
 * (-z, x), the ball's point moves with perp(l1 u1) theta1' + perp(l2 u2 - R n) theta2'. */

struct pendulum {
    double m1, l1, l2, radius, m2, i2, angle[2];
    double mass[2][2], inverse[2][2];
    double across[2], along[2]; /* w of the normal and of x */
};

static void find_pendulum(struct pendulum *p)
{
    double s1 = sin(p->angle[0]), c1 = cos(p->angle[0]);
    double s2 = sin(p->angle[1]), c2 = cos(p->angle[1]);
    p->along[0] = p->l1 * c1;
    p->across[0] = p->l1 * s1;
    p->along[1] = p->l2 * c2 + p->radius;
    p->across[1] = p->l2 * s2;
    p->mass[0][0] = p->m1 * p->l1 * p->l1 / 3.0 + p->m2 * p->l1 * p->l1;
    p->mass[1][1] = p->m2 * p->l2 * p->l2 + p->i2;
    p->mass[0][1] = p->mass[1][0] = p->m2 * p->l1 * p->l2 * (c1 * c2 + s1 * s2);
    double d = p->mass[0][0] * p->mass[1][1] - p->mass[0][1] * p->mass[1][0];
    p->inverse[0][0] = p->mass[1][1] / d;
    p->inverse[1][1] = p->mass[0][0] / d;
    p->inverse[0][1] = p->inverse[1][0] = -p->mass[0][1] / d;
}

static double form(double m[2][2], const double a[2], const double b[2])
{
    return a[0] * (m[0][0] * b[0] + m[0][1] * b[1]) + a[1] * (m[1][0] * b[0] + m[1][1] * b[1]);
}

/* Its matrix: in its plane, of which the second tangent is the normal; nothing moves along that. */
static void pendulum_matrix(struct pendulum *p, double w[9])
{
    memset(w, 0, 9 * sizeof *w);
    w[0] = form(p->inverse, p->across, p->across);
    w[4] = form(p->inverse, p->along, p->along);
    w[1] = w[3] = form(p->inverse, p->across, p->along);
}

/* Angular velocities that give the point these speeds, and the ball its motion. */
static void swing(const struct pendulum *p, double approach, double slip, double turning[2],
                  struct solve_body *ball)
{
    double d = p->across[0] * p->along[1] - p->across[1] * p->along[0];
    turning[0] = (-approach * p->along[1] - p->across[1] * slip) / d;
    turning[1] = (p->across[0] * slip + approach * p->along[0]) / d;
    ball->velocity[0] = p->along[0] * turning[0] + (p->along[1] - p->radius) * turning[1];
    ball->velocity[2] = p->across[0] * turning[0] + p->across[1] * turning[1];
    ball->angular_velocity[1] = -turning[1]; /* from x to z is about -y */
}

static struct pendulum hang(const struct body *ball, double first, double second)
{
    struct pendulum p = {.m1 = 0.2,
                         .l1 = 0.3,
                         .l2 = 0.25,
                         .radius = 0.015,
                         .m2 = ball->mass,
                         .i2 = ball->inertia[0],
                         .angle = {first, second}};
    find_pendulum(&p);
    return p;
}

/* The ball's approach at 0.5 m/s with a slip along x; turning: the angles' rates. */
static struct solve_request swung(const struct pendulum *p, double slip, double mu,
                                  double turning[2])
{
    struct solve_request request = strike(sphere_spot("ball", p->radius), wall_spot("wall"), 0.0);
    swing(p, 0.5, slip, turning, &request.bodies[0]);
    request.contacts[0].friction = mu;
    request.contacts[0].tangent[0] = 1.0;
    return request;
}

/* By M itself: the speeds of the point after the answer's impulse, and the energy that is gone. */
static void check_motion(struct pendulum *p, const double turning[2])
{
    const struct solve_contact_result *contact = &result.contacts[0];
    double push[2], after[2], before = 0.5 * form(p->mass, turning, turning);
    for (int i = 0; i < 2; i++)
        push[i] = p->across[i] * contact->impulse + p->along[i] * contact->impulse_tangential[0];
    for (int i = 0; i < 2; i++)
        after[i] = turning[i] + p->inverse[i][0] * push[0] + p->inverse[i][1] * push[1];
    near(contact->slip_after[0], p->along[0] * after[0] + p->along[1] * after[1], 1e-9);
    near(-contact->restitution_kinematic * -0.5, p->across[0] * after[0] + p->across[1] * after[1],
         1e-9);
    near(contact->slip_after[1], 0.0, 1e-12);
    near(contact->impulse_tangential[1], 0.0, 1e-12 * contact->impulse);
    /* the books of the cells close to the tolerance */
    near(before - 0.5 * form(p->mass, after, after), result.energy.friction, 1e-3 * before);
    near_relative(result.energy.available, before, 1e-9);
}

static const double SWINGS[][2] = {{0.6, 0.9}, {0.6, -0.9}, {-0.4, 1.2}, {1.1, 0.2}};

/* Where it slides throughout T = -mu N: the gap obeys g'' = (W_nn - mu sign W_nt) N, and the
 * elastic contact gives back its rate: P = 2 approach/(W_nn - mu sign W_nt). */
static void a_double_pendulum_slides(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "wall", rigid_wall());
    for (size_t i = 0; i < COUNT(SWINGS); i++)
        for (int sign = -1; sign <= 1; sign += 2) {
            struct pendulum p = hang(&lab->bodies[0], SWINGS[i][0], SWINGS[i][1]);
            double w[9], turning[2], mu = 0.1;
            struct solve_request request = swung(&p, sign * 10.0, mu, turning);
            pendulum_matrix(&p, w);
            assert_true(fabs(w[1]) > 0.01 * w[0]);
            state_matrix(&request, w);
            lab_solve(lab, &request, &result);
            const struct solve_contact_result *contact = &result.contacts[0];
            assert_int_equal(contact->friction_state, PERCUSS_FRICTION_STATE_SLID);
            /* to the tolerance, 1e-3 of the restitution */
            measured_relative("impulse", contact->impulse, 1.0 / (w[0] - mu * sign * w[1]), 5e-4);
            measured_relative("along", contact->impulse_tangential[0],
                              -mu * sign * contact->impulse, 1e-9);
            near(contact->restitution, contact->impulse * w[0] / 0.5 - 1.0, 1e-12);
            check_motion(&p, turning);
        }
    lab_free(lab);
}

/* Where it sticks at first: both methods, and the same with a second tangent that could move. */
static void a_double_pendulum_sticks(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "wall", rigid_wall());
    for (size_t i = 0; i < COUNT(SWINGS); i++) {
        struct pendulum p = hang(&lab->bodies[0], SWINGS[i][0], SWINGS[i][1]);
        double w[9], turning[2];
        struct solve_request request = swung(&p, 0.1, 0.4, turning);
        request.options.tolerance = 1e-4;
        pendulum_matrix(&p, w);
        state_matrix(&request, w);
        lab_solve(lab, &request, &result);
        assert_int_not_equal(result.contacts[0].friction_state, PERCUSS_FRICTION_STATE_SLID);
        check_motion(&p, turning);
        request.options.method = PERCUSS_METHOD_CVODE;
        lab_solve(lab, &request, &other);
        double scale = result.contacts[0].impulse;
        measured("CVODE", other.contacts[0].impulse / scale, 1.0, 1e-4);
        measured("CVODE along", other.contacts[0].impulse_tangential[0] / scale,
                 result.contacts[0].impulse_tangential[0] / scale, 1e-4);
        /* what hardly moves holds still: MuJoCo's mass matrix leaves some rounding */
        request.options.method = PERCUSS_METHOD_MODAL;
        for (int k = 0; k < 2; k++) {
            w[8] = k ? w[4] : 1e-17 * w[4];
            lab_solve(lab, &request, &other);
            near_relative(other.contacts[0].impulse, scale, 1e-9);
            near_relative(other.contacts[0].impulse_tangential[0],
                          result.contacts[0].impulse_tangential[0], 1e-9);
        }
    }
    lab_free(lab);
}

/* ---- What is refused, and what is warned of ---- */

static void refuse(struct lab *lab, const struct solve_request *request, const char *why)
{
    solve(lab->workspace, &lab->means, request, &result);
    assert_int_equal(result.status, PERCUSS_BAD_REQUEST);
    if (!strstr(result.fault.text, why))
        fail_msg("%s", result.fault.text);
}

static void what_is_refused(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "wall", rigid_wall());
    struct solve_request request = slides(lab, sphere_spot("ball", 0.015), wall_spot("wall"), 0.2);
    double w[9], normal = 1.0 / lab->bodies[0].mass;
    find_matrix(lab, &request, w);
    /* one of the normals alone */
    request.delassus = &normal;
    refuse(lab, &request, "delassus: 1 x 1 numbers: where a contact has friction it must be 3 x 3");
    refuse(lab, &request, "options.friction none leaves friction out");
    request.options.friction = PERCUSS_FRICTION_NONE;
    lab_solve(lab, &request, &result);
    double smooth = result.contacts[0].impulse;
    /* more than the rows of one fit; the same contact again and again is as good as others */
    static double many[22 * 22];
    struct solve_request more = request;
    more.options.friction = PERCUSS_FRICTION_MICRO_SLIP;
    more.contact_count = 22;
    more.delassus = many;
    for (size_t c = 1; c < 22; c++)
        more.contacts[c] = more.contacts[0];
    refuse(lab, &more,
           "delassus: 22 x 22 numbers: where a contact has friction it must be left "
           "out: 3 rows for each of up to 21 contacts");
    /* without friction the tangents' rows are not used */
    state_matrix(&request, w);
    w[4] = -0.5 * w[8];
    lab_solve(lab, &request, &result);
    near_relative(result.contacts[0].impulse, smooth, 1e-12);
    request.options.friction = PERCUSS_FRICTION_MICRO_SLIP;
    refuse(lab, &request, "delassus: smallest eigenvalue is -0.5 of the largest");
    /* the normal is fast enough for the tangents, and they for each other, not all three */
    memcpy(w, (double[]){2.0, 1.5, 1.5, 1.5, 2.0, -0.5, 1.5, -0.5, 2.0}, sizeof w);
    refuse(lab, &request, "must be positive semidefinite");
    memcpy(w, (double[]){2.0, 0.0, 0.0, 0.0, 2.0, 0.1, 0.0, 0.2, 2.0}, sizeof w);
    refuse(lab, &request, "delassus[7] and [5]: 0.2 and 0.1: the matrix must be symmetric");
    memcpy(w, (double[]){0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0}, sizeof w);
    refuse(lab, &request, "delassus[0]: 0: the diagonal");
    memcpy(w, (double[]){2.0, 0.0, 0.0, 0.0, NAN, 0.0, 0.0, 0.0, 2.0}, sizeof w);
    refuse(lab, &request, "delassus");
    lab_free(lab);
}

/* 1 % of the contact's largest inverse mass, in any of its rows. */
static void what_is_warned_of(void **state)
{
    (void)state;
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "wall", rigid_wall());
    struct solve_request request = slides(lab, sphere_spot("ball", 0.015), wall_spot("wall"), 0.2);
    double own[9], w[9];
    find_matrix(lab, &request, own);
    for (int i = 0; i < 9; i++)
        for (int far = 0; far < 2; far++) {
            int mirror = i % 3 * 3 + i / 3;
            memcpy(w, own, sizeof w);
            w[i] -= (far ? 0.02 : 0.005) * own[4];
            w[mirror] = w[i];
            state_matrix(&request, w);
            lab_solve(lab, &request, &result);
            assert_true(warned(&result, "delassus: differs") == (far == 1));
        }
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_on_a_wall),
        cmocka_unit_test(a_leaning_bar),
        cmocka_unit_test(a_ball_in_a_groove),
        cmocka_unit_test(balls_on_a_beam),
        cmocka_unit_test(another_ball),
        cmocka_unit_test(two_inverse_masses),
        cmocka_unit_test(a_double_pendulum_slides),
        cmocka_unit_test(a_double_pendulum_sticks),
        cmocka_unit_test(what_is_refused),
        cmocka_unit_test(what_is_warned_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
