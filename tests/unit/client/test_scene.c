/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/cli/scene.c: options of friction, angle and spin, and the request that they make. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "check.h"
#include "scene.h"

enum { MOST_WORDS = 16 };

static struct scene scene;
static struct percuss_request request;

/* Reads words between blanks into the scene. */
static void read_words(const char *text, enum scene_angles angles)
{
    static char copy[256];
    char *words[MOST_WORDS + 1] = {0}, *rest = copy;
    int count = 0;
    snprintf(copy, sizeof copy, "percuss %s", text);
    for (char *word; (word = strsep(&rest, " ")) && count < MOST_WORDS;)
        words[count++] = word;
    scene = scene_default();
    scene.angles = angles;
    argp_parse(&scene_argp, count, words, 0, NULL, &scene);
}

/* The same of words that end the process with a message. */
static void refuse(const char *text, enum scene_angles angles, const char *message)
{
    int ends[2], status;
    char said[512] = "";
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        dup2(ends[1], STDERR_FILENO);
        read_words(text, angles);
        _exit(EXIT_SUCCESS);
    }
    close(ends[1]);
    size_t size = 0;
    for (ssize_t got; (got = read(ends[0], said + size, sizeof said - 1 - size)) > 0;)
        size += (size_t)got;
    close(ends[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    if (!WIFEXITED(status) || WEXITSTATUS(status) == 0 || !strstr(said, message))
        fail_msg("%s: '%s' does not say '%s'", text, said, message);
}

/* A sphere of 15 mm on a half-space, at 2 m/s. */
static void make_request(void)
{
    static const struct percuss_body bodies[2] = {
        {.id = "s", .shape = "sphere", .half_extents = {0.015, 0.015, 0.015}, .radius = 0.015},
        {.id = "h", .shape = "half-space", .mass = INFINITY}};
    const struct scene_bodies placed = {.pair = percuss_pair_default(&bodies[0], &bodies[1])};
    assert_int_equal(scene_request(&scene, &placed, 2.0, &request), EXIT_ANSWERED);
}

static void expect_velocities(double along, double normal, double spin)
{
    const struct percuss_body_motion *a = &request.bodies[0];
    assert_true(fabs(a->velocity[0] - along) < 1e-14 && a->velocity[1] == 0.0);
    assert_true(fabs(a->velocity[2] - normal) < 1e-14);
    assert_true(a->angular_velocity[0] == 0.0 && a->angular_velocity[2] == 0.0);
    assert_true(fabs(a->angular_velocity[1] - spin) < 1e-13);
}

static void straight_impacts_are_as_before(void **state)
{
    (void)state;
    read_words("--a s --b h", ANGLES_ONE);
    assert_false(scene.askew);
    make_request();
    expect_velocities(0.0, -2.0, 0.0);
    const struct percuss_contact *contact = &request.contacts[0];
    assert_true(contact->friction == 0.0 && contact->tangent[0] == 0.0);
    assert_int_equal(request.options.friction, PERCUSS_FRICTION_MICRO_SLIP);
    read_words("--angle 0", ANGLES_ONE);
    assert_true(scene.askew);
    make_request();
    expect_velocities(0.0, -2.0, 0.0);
}

static void a_flight_is_divided(void **state)
{
    (void)state;
    read_words("--angle 30 --spin 4 --friction 0.25 --friction-law plain", ANGLES_ONE);
    make_request();
    expect_velocities(1.0, -sqrt(3.0), -4.0);
    assert_true(request.contacts[0].friction == 0.25 && request.contacts[0].tangent[0] == 1.0);
    assert_int_equal(request.options.friction, PERCUSS_FRICTION_PLAIN);
    assert_true(fabs(scene_normal_share(&scene) - sqrt(0.75)) < 1e-15);
    /* with their units, and in the other direction */
    read_words("--angle -30deg --spin -4rad/s", ANGLES_ONE);
    make_request();
    expect_velocities(-1.0, -sqrt(3.0), 4.0);
}

/* None, where 0 alone would be the catalogue's. */
static void no_coefficient_is_no_friction(void **state)
{
    (void)state;
    read_words("--friction 0", ANGLES_ONE);
    make_request();
    assert_true(request.contacts[0].friction == 0.0);
    assert_int_equal(request.options.friction, PERCUSS_FRICTION_NONE);
    read_words("--friction-law none --friction 0.3", ANGLES_ONE);
    make_request();
    assert_true(request.contacts[0].friction == 0.3);
    assert_int_equal(request.options.friction, PERCUSS_FRICTION_NONE);
}

static void angles_are_swept(void **state)
{
    (void)state;
    read_words("--angle 0:80:9", ANGLES_SWEPT);
    assert_true(scene.angle_list && scene.angle == 0.0 && scene.last_angle == 80.0);
    assert_int_equal(scene.angle_count, 9);
    read_words("--angle 0:80:9 --angle -10", ANGLES_SWEPT);
    assert_false(scene.angle_list);
    assert_true(scene.angle == -10.0 && scene.last_angle == -10.0 && scene.angle_count == 1);
    refuse("--angle 0:90:9", ANGLES_SWEPT, "or LO:HI:N, for example 0:80:9");
    refuse("--angle 50:40:9", ANGLES_SWEPT, "--angle: '50:40:9'");
    refuse("--angle 0:80", ANGLES_SWEPT, "--angle: '0:80'");
    refuse("--angle 0:80:0", ANGLES_SWEPT, "--angle: '0:80:0'");
    refuse("--angle 0:80:99999999", ANGLES_SWEPT, "--angle: '0:80:99999999'");
    refuse("--angle 0:80:9", ANGLES_ONE, "--angle: '0:80:9'");
}

static void refuses_what_cannot_be(void **state)
{
    (void)state;
    refuse("--angle 90", ANGLES_ONE, "more than -90 and less than 90");
    refuse("--angle -91", ANGLES_ONE, "more than -90 and less than 90");
    refuse("--angle nan", ANGLES_ONE, "--angle: 'nan'");
    refuse("--angle 30rad", ANGLES_ONE, "--angle: '30rad'");
    refuse("--spin fast", ANGLES_ONE, "--spin: 'fast': a number of rad/s is needed");
    refuse("--friction -0.1", ANGLES_ONE, "--friction: '-0.1': a coefficient of 0 to 10");
    refuse("--friction 10.5", ANGLES_ONE, "--friction: '10.5': a coefficient of 0 to 10");
    refuse("--friction-law wet", ANGLES_ONE, "is not one of: micro-slip, plain, none");
    refuse("--angle 10", ANGLES_NONE, "--angle: '10': only straight impacts are compared");
    refuse("--spin 10", ANGLES_NONE, "--spin: '10': only straight impacts are compared");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(straight_impacts_are_as_before), cmocka_unit_test(a_flight_is_divided),
        cmocka_unit_test(no_coefficient_is_no_friction),  cmocka_unit_test(angles_are_swept),
        cmocka_unit_test(refuses_what_cannot_be),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
