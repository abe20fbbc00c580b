/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* No frame is special: turned, shifted and carried along, a scene gives the same impact; and free
 * bodies keep their momentum and angular momentum. */
#include "physics/support.h"

static struct lab *lab_of_bodies(void)
{
    struct lab *lab = lab_create();
    struct body tipped = make_bar(&rod_kind, ALUMINIUM, 0.010, 0.4);
    struct body flat = make_body(&beam_kind, ALUMINIUM);
    struct body block = make_body(&block_kind, STEEL);
    tipped.tip_radius = 0.015;
    flat.width = 0.03;
    flat.height = 0.012;
    flat.length = 0.5;
    memcpy(block.size, (double[]){0.05, 0.08, 0.03}, sizeof block.size);
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "tipped", tipped);
    lab_add(lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "flat", flat);
    lab_add(lab, "block", block);
    lab_add(lab, "drum", make_bar(&cylinder_kind, STEEL, 0.02, 0.05));
    return lab;
}

enum { SCENES = 6 };

/* Spinning and sliding bodies as well: only the normal gap rate counts. */
static void scenes_make(struct solve_request requests[SCENES])
{
    const struct spot ball = sphere_spot("ball", 0.015);
    const struct spot flat = {"flat", {0.08, 0.004, 0.006}, {0.0, 0.0, 1.0}, 0.4};
    const struct spot flat_edgewise = {"flat", {-0.1, 0.015, 0.002}, {0.0, 1.0, 0.0}, 0.4};
    const struct spot block = {"block", {0.01, -0.02, 0.015}, {0.0, 0.0, 1.0}, 0.3};
    requests[0] = strike(ball, side_spot("beam", 0.12, 0.010, 0.4), 0.25);
    requests[1] = strike(end_spot("tipped", 0.4), side_spot("beam", -0.3, 0.010, 2.0), 0.4);
    requests[2] = strike(ball, flat, 0.3);
    requests[3] = strike(ball, flat_edgewise, 0.3);
    requests[4] = strike(end_spot("tipped", 0.4), block, 0.5);
    struct spot drum = side_spot("drum", 0.01, 0.02, 0.3);
    drum.roll = 1.1; /* across */
    requests[5] = strike(drum, side_spot("beam", 0.2, 0.010, 0.1), 0.3);
    uint64_t seed = 3;
    for (int i = 0; i < SCENES; i++) {
        requests[i].options.tolerance = 1e-8;
        for (int b = 0; b < 2; b++)
            for (int k = 0; k < 3; k++)
                requests[i].bodies[b].angular_velocity[k] = random_between(&seed, -0.2, 0.2);
    }
}

static void turned_and_carried_scenes_are_the_same(void **state)
{
    (void)state;
    static struct solve_result here, there;
    static struct solve_request requests[SCENES];
    struct lab *lab = lab_of_bodies();
    uint64_t seed = 21;
    scenes_make(requests);
    for (int i = 0; i < SCENES; i++) {
        lab_solve(lab, &requests[i], &here);
        for (int turn = 0; turn < 3; turn++) {
            struct solve_request moved = requests[i];
            double q[4];
            double shift[3];
            double velocity[3];
            double rotation[9];
            random_rotation(&seed, q);
            for (int k = 0; k < 3; k++) {
                shift[k] = random_between(&seed, -10.0, 10.0);
                velocity[k] = random_between(&seed, -30.0, 30.0);
            }
            move_scene(&moved, q, shift, velocity);
            lab_solve(lab, &moved, &there);
            /* 10 m and 30 m/s leave roundings of 1e-14 in lever arms and gap rates */
            measured("e", there.contacts[0].restitution, here.contacts[0].restitution, 1e-9);
            assert_int_equal(there.contacts[0].sub_impact_count, here.contacts[0].sub_impact_count);
            rotation_matrix(q, rotation);
            for (int b = 0; b < 2; b++) {
                double expected[3];
                rotate3(rotation, here.bodies[b].velocity, expected);
                add_scaled3(1.0, velocity, expected);
                sub3(there.bodies[b].velocity, expected, expected);
                measured("velocity after", norm3(expected), 0.0, 1e-9);
            }
        }
    }
    lab_free(lab);
}

/* L about the world's origin: r x m v + R I R^T omega; at a contact in the origin. */
static void angular_momentum(const struct body *body, const struct solve_body *pose,
                             const double velocity[3], const double angular_velocity[3],
                             double sum[3])
{
    double r[9];
    double local[3];
    double spin[3];
    double orbit[3];
    rotation_matrix(pose->orientation, r);
    rotate_back3(r, angular_velocity, local);
    for (int k = 0; k < 3; k++)
        local[k] *= body->inertia[k];
    rotate3(r, local, spin);
    cross3(pose->position, velocity, orbit);
    for (int k = 0; k < 3; k++)
        sum[k] += body->mass * orbit[k] + spin[k];
}

static void free_bodies_keep_their_momentum(void **state)
{
    (void)state;
    static struct solve_result result;
    static struct solve_request requests[SCENES];
    struct lab *lab = lab_of_bodies();
    uint64_t seed = 4;
    scenes_make(requests);
    for (int i = 0; i < SCENES; i++) {
        double q[4];
        random_rotation(&seed, q);
        move_scene(&requests[i], q, (double[]){0.3, -0.2, 0.1}, (double[]){0.0, 0.1, -0.2});
        lab_solve(lab, &requests[i], &result);
        assert_true(result.velocities_known);
        double before[6] = {0.0};
        double after[6] = {0.0};
        for (int b = 0; b < 2; b++) {
            const struct solve_body *pose = &requests[i].bodies[b];
            const struct body *body = body_set_find(&lab->set, pose->id);
            add_scaled3(body->mass, pose->velocity, before);
            add_scaled3(body->mass, result.bodies[b].velocity, after);
            angular_momentum(body, pose, pose->velocity, pose->angular_velocity, before + 3);
            angular_momentum(body, pose, result.bodies[b].velocity,
                             result.bodies[b].angular_velocity, after + 3);
        }
        double scale = result.contacts[0].impulse;
        for (int k = 0; k < 6; k++)
            /* equal and opposite impulses on one line: rounding only */
            measured(k < 3 ? "momentum" : "angular momentum", after[k], before[k], 1e-12 * scale);
    }
    lab_free(lab);
}

/* The rigid gap rate of velocity_after at the contact is the one of the last sub-impact:
 * e = -(rate after)/(rate before). */
static void velocities_after_show_the_restitution(void **state)
{
    (void)state;
    static struct solve_result result;
    static struct solve_request requests[SCENES];
    struct lab *lab = lab_of_bodies();
    scenes_make(requests);
    for (int i = 0; i < SCENES; i++) {
        double rate[2] = {0.0, 0.0};
        lab_solve(lab, &requests[i], &result);
        for (int b = 0; b < 2; b++) {
            const struct solve_body *pose = &requests[i].bodies[b];
            double arm[3];
            double turning[3];
            double sign = b == 0 ? 1.0 : -1.0;
            sub3(requests[i].contacts[0].point, pose->position, arm);
            cross3(pose->angular_velocity, arm, turning);
            rate[0] += sign * (pose->velocity[2] + turning[2]);
            cross3(result.bodies[b].angular_velocity, arm, turning);
            rate[1] += sign * (result.bodies[b].velocity[2] + turning[2]);
        }
        const struct solve_contact_result *contact = &result.contacts[0];
        /* the definition of e by Eqs. (4) and (6), rounding only */
        measured("e by velocities", -rate[1] / rate[0], contact->restitution, 1e-12);
        measured("last gap rate",
                 contact->sub_impacts[contact->sub_impact_count - 1].gap_rate_after, rate[1],
                 1e-12);
        measured("first gap rate", contact->sub_impacts[0].gap_rate_before, rate[0], 1e-12);
    }
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turned_and_carried_scenes_are_the_same),
        cmocka_unit_test(free_bodies_keep_their_momentum),
        cmocka_unit_test(velocities_after_show_the_restitution),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
