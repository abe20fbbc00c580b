/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A double pendulum in minimal coordinates on the slow scale: its ball meets a wall obliquely, with
 * friction, by the engine's matrix of normals and tangents, and the solver answers. */
#include "cosim/loop.h"

/* Both angles are from the downward vertical towards x, about the world's -y. A uniform rod turns
 * about the pivot in the origin; at its end hinges a light rod that carries a ball. With perp(x, z)
 * = (-z, x) a point p of the ball moves with perp(elbow) angle1' + perp(p - elbow) angle2'. */
struct pendulum {
    struct loop loop; /* of it the lab and the solver */
    double time, angle[2], rate[2];
    double mass[2], length[2], radius, moment;
    double tilt;   /* rad, of the wall's normal from z towards x */
    double gap;    /* of the ball to it */
    size_t asked;  /* for tangents */
    double w[9];   /* what was said then */
    double normal; /* impulse that was applied, and along the surface in the plane of motion, */
    double along;  /* towards +x, N s */
};

static void find_elbow(const struct pendulum *p, double elbow[2])
{
    elbow[0] = p->length[0] * sin(p->angle[0]);
    elbow[1] = -p->length[0] * cos(p->angle[0]);
}

static void find_centre(const struct pendulum *p, double centre[2])
{
    find_elbow(p, centre);
    centre[0] += p->length[1] * sin(p->angle[1]);
    centre[1] -= p->length[1] * cos(p->angle[1]);
}

/* M of both angles, and its inverse. */
static void find_mass(const struct pendulum *p, double m[2][2], double inverse[2][2])
{
    double l1 = p->length[0], l2 = p->length[1];
    m[0][0] = (p->mass[0] / 3.0 + p->mass[1]) * l1 * l1;
    m[1][1] = p->mass[1] * l2 * l2 + p->moment;
    m[0][1] = m[1][0] = p->mass[1] * l1 * l2 * cos(p->angle[0] - p->angle[1]);
    double d = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    inverse[0][0] = m[1][1] / d;
    inverse[1][1] = m[0][0] / d;
    inverse[0][1] = inverse[1][0] = -m[0][1] / d;
}

static double form(double m[2][2], const double a[2], const double b[2])
{
    return a[0] * (m[0][0] * b[0] + m[0][1] * b[1]) + a[1] * (m[1][0] * b[0] + m[1][1] * b[1]);
}

static double kinetic(const struct pendulum *p)
{
    double m[2][2], inverse[2][2];
    find_mass(p, m, inverse);
    return 0.5 * form(m, p->rate, p->rate);
}

/* w of a direction at a point of the ball; y moves nothing. */
static void find_row(const struct pendulum *p, const double point[3], const double direction[3],
                     double w[2])
{
    double elbow[2];
    find_elbow(p, elbow);
    w[0] = -elbow[1] * direction[0] + elbow[0] * direction[2];
    w[1] = -(point[2] - elbow[1]) * direction[0] + (point[0] - elbow[0]) * direction[2];
}

static double sign_of(const struct percuss_slow_contact *contact)
{
    return contact->a == 0 ? 1.0 : -1.0;
}

static bool probe(void *context, struct percuss_slow_view *view)
{
    struct pendulum *p = context;
    double m[2][2], inverse[2][2], centre[2], elbow[2], w[2];
    const struct percuss_slow_contact *contact = view->contacts;
    find_mass(p, m, inverse);
    find_row(p, contact->point, contact->normal, w);
    view->gap_rate[0] = sign_of(contact) * (w[0] * p->rate[0] + w[1] * p->rate[1]);
    if (view->delassus)
        view->delassus[0] = form(inverse, w, w);
    if (!view->bodies)
        return true;
    find_centre(p, centre);
    find_elbow(p, elbow);
    struct percuss_body_motion *ball = &view->bodies[0], *wall = &view->bodies[1];
    ball->position[0] = centre[0];
    ball->position[2] = centre[1];
    ball->velocity[0] = -elbow[1] * p->rate[0] - (centre[1] - elbow[1]) * p->rate[1];
    ball->velocity[2] = elbow[0] * p->rate[0] + (centre[0] - elbow[0]) * p->rate[1];
    ball->angular_velocity[1] = -p->rate[1];
    /* the wall's z is its normal */
    memcpy(wall->position, contact->point, sizeof wall->position);
    wall->orientation[0] = cos(0.5 * p->tilt);
    wall->orientation[2] = sin(0.5 * p->tilt);
    return true;
}

static bool oblique(void *context, size_t count, const struct percuss_slow_contact *contacts,
                    double *delassus)
{
    struct pendulum *p = context;
    double m[2][2], inverse[2][2], w[3][2], second[3];
    const double *n = contacts->normal, *t = contacts->tangent;
    assert_int_equal(count, 1);
    for (int i = 0; i < 3; i++)
        second[i] = n[(i + 1) % 3] * t[(i + 2) % 3] - n[(i + 2) % 3] * t[(i + 1) % 3];
    find_mass(p, m, inverse);
    find_row(p, contacts->point, n, w[0]);
    find_row(p, contacts->point, t, w[1]);
    find_row(p, contacts->point, second, w[2]);
    for (int i = 0; i < 9; i++)
        delassus[i] = form(inverse, w[i / 3], w[i % 3]);
    memcpy(p->w, delassus, sizeof p->w);
    p->asked++;
    return true;
}

/* M^-1 J^T P. */
static bool apply_vector(void *context, const struct percuss_slow_contact *contact,
                         const double impulse[3])
{
    struct pendulum *p = context;
    double m[2][2], inverse[2][2], w[2], sign = sign_of(contact);
    find_mass(p, m, inverse);
    find_row(p, contact->point, impulse, w);
    for (int i = 0; i < 2; i++)
        p->rate[i] += sign * (inverse[i][0] * w[0] + inverse[i][1] * w[1]);
    for (int i = 0; i < 3; i++)
        p->normal += impulse[i] * contact->normal[i];
    p->along += sign * (impulse[0] * cos(p->tilt) - impulse[2] * sin(p->tilt));
    return true;
}

static double now(void *context)
{
    return ((struct pendulum *)context)->time;
}

static struct percuss_slow_contact touch(const struct pendulum *p, double mu)
{
    double centre[2];
    struct percuss_slow_contact contact = {
        .a = 0, .b = 1, .normal = {sin(p->tilt), 0.0, cos(p->tilt)}, .gap = p->gap, .friction = mu};
    find_centre(p, centre);
    contact.point[0] = centre[0] - p->radius * contact.normal[0];
    contact.point[2] = centre[1] - p->radius * contact.normal[2];
    return contact;
}

static const double APPROACH = 0.5, TILT = 0.4;
static const double SWINGS[][2] = {{0.6, 0.9}, {0.6, -0.9}, {-0.4, 1.2}, {1.1, 0.2}};

/* The angles' rates of an approach and of a slip along the surface towards +x. */
static void swing(struct pendulum *p, double slip)
{
    struct percuss_slow_contact contact = touch(p, 0.0);
    const double along[3] = {cos(p->tilt), 0.0, -sin(p->tilt)};
    double n[2], t[2];
    find_row(p, contact.point, contact.normal, n);
    find_row(p, contact.point, along, t);
    double d = n[0] * t[1] - n[1] * t[0];
    p->rate[0] = (-APPROACH * t[1] - n[1] * slip) / d;
    p->rate[1] = (n[0] * slip + APPROACH * t[0]) / d;
}

static struct pendulum *pendulum_create(struct lab *lab, const double angle[2], double slip)
{
    struct pendulum *p = calloc(1, sizeof *p);
    assert_non_null(p);
    p->loop.lab = lab;
    p->mass[0] = 0.2;
    p->mass[1] = lab->bodies[0].mass;
    p->length[0] = 0.3;
    p->length[1] = 0.25;
    p->radius = 0.015;
    p->moment = lab->bodies[0].inertia[0];
    p->tilt = TILT;
    memcpy(p->angle, angle, sizeof p->angle);
    swing(p, slip);
    return p;
}

/* Of a pendulum at the touch, until its answer has been applied. */
static void pendulum_hit(struct pendulum *p, double mu, enum percuss_slow_application application)
{
    static const struct percuss_slow_body bodies[] = {{.id = "ball"},
                                                      {.id = "wall", .fixed = true}};
    struct percuss_slow_config config = percuss_slow_config_default();
    struct percuss_slow *slow;
    struct percuss_slow_contact contact = touch(p, mu);
    config.body_count = 2;
    config.bodies = bodies;
    config.engine = (struct percuss_slow_engine){
        .context = p, .probe = probe, .now = now, .apply_vector = apply_vector, .oblique = oblique};
    config.service = loop_service(&p->loop);
    config.options.tolerance = 1e-4;
    config.application = application;
    assert_int_equal(percuss_slow_create(&config, &slow), PERCUSS_RESULT_OK);
    if (percuss_slow_advance(slow, 1, &contact))
        fail_msg("%s", percuss_slow_error_text());
    /* the pendulum holds its place: what follows is of its rates */
    while (isfinite(percuss_slow_next(slow))) {
        p->time = percuss_slow_next(slow);
        contact = touch(p, mu);
        contact.gap = -1e-6;
        for (int k = 0; k < 3; k++) /* halfway between the surfaces, and the ball's as it was */
            contact.point[k] -= 0.5 * contact.gap * contact.normal[k];
        if (percuss_slow_advance(slow, 1, &contact))
            fail_msg("%s", percuss_slow_error_text());
    }
    percuss_slow_free(slow);
}

static struct lab *open_lab(void)
{
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "wall", rigid_wall());
    return lab;
}

/* Rates of the gap and of the slip, along the surface towards +x. */
static void look(const struct pendulum *p, double *gap, double *slip)
{
    struct percuss_slow_contact contact = touch(p, 0.0);
    const double along[3] = {cos(p->tilt), 0.0, -sin(p->tilt)};
    double w[2];
    find_row(p, contact.point, contact.normal, w);
    *gap = w[0] * p->rate[0] + w[1] * p->rate[1];
    find_row(p, contact.point, along, w);
    *slip = w[0] * p->rate[0] + w[1] * p->rate[1];
}

/* Along the surface friction is mu N against the slip: the gap obeys g'' = (W_nn - mu sign W_nt) N,
 * and the elastic contact gives its rate back. W_nt is found here from both rows and M. */
static void it_slides(void **state)
{
    (void)state;
    static const double mu = 0.1;
    struct lab *lab = open_lab();
    for (size_t i = 0; i < COUNT(SWINGS); i++)
        for (int way = 0; way < 4; way++) {
            double sign = way & 1 ? 1.0 : -1.0, gap, slip, m[2][2], inverse[2][2], n[2], t[2];
            struct pendulum *p = pendulum_create(lab, SWINGS[i], sign * 10.0);
            double before = kinetic(p);
            pendulum_hit(p, mu, way & 2 ? PERCUSS_SLOW_TOTAL : PERCUSS_SLOW_LIST);
            assert_int_equal(p->asked, 1);
            /* the rule's first tangent is y, along which it does not move; the second is x's */
            near(p->w[4], 0.0, 0.0);
            struct percuss_slow_contact contact = touch(p, mu);
            find_mass(p, m, inverse);
            find_row(p, contact.point, contact.normal, n);
            find_row(p, contact.point, (double[]){cos(p->tilt), 0.0, -sin(p->tilt)}, t);
            double felt = form(inverse, n, n) - mu * sign * form(inverse, n, t);
            /* the restitution to 1e-4 of itself */
            measured_relative("impulse", p->normal, 2.0 * APPROACH / felt, 1e-4);
            measured_relative("along", p->along, -mu * sign * p->normal, 1e-9);
            look(p, &gap, &slip);
            measured("gap rate", gap, APPROACH, 1e-4);
            measured("slip", slip,
                     sign * 10.0 +
                         (form(inverse, n, t) - mu * sign * form(inverse, t, t)) * p->normal,
                     1e-9);
            /* the books of the answer are those of M */
            double lost = p->loop.result.energy.friction;
            measured("energy", (before - kinetic(p) - lost) / before, 0.0, 1e-4);
            free(p);
        }
    lab_free(lab);
}

/* It sticks and springs back: the motion and the energy are those of the answer. */
static void it_sticks(void **state)
{
    (void)state;
    struct lab *lab = open_lab();
    for (size_t i = 0; i < COUNT(SWINGS); i++) {
        struct pendulum *p = pendulum_create(lab, SWINGS[i], 0.1);
        const struct solve_contact_result *answer = &p->loop.result.contacts[0];
        double before = kinetic(p), gap, slip;
        pendulum_hit(p, 0.4, PERCUSS_SLOW_LIST);
        assert_int_not_equal(answer->friction_state, PERCUSS_FRICTION_STATE_SLID);
        look(p, &gap, &slip);
        near(gap, answer->restitution_kinematic * APPROACH, 1e-9);
        near(slip, -answer->slip_after[1], 1e-9); /* the second tangent is towards -x */
        near(answer->slip_after[0], 0.0, 1e-12);
        near((before - kinetic(p) - p->loop.result.energy.friction) / before, 0.0, 1e-3);
        free(p);
    }
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_slides),
        cmocka_unit_test(it_sticks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
