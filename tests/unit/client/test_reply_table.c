/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/cli/reply_table.c: what is said of friction, where there is any, and of speeds. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "convert.h"
#include "reply_table.h"
#include "unit/client/wire_reply.h"

static char printed[8192];

/* What it prints on stdout. */
static void print(const struct percuss_request *request, const struct percuss_reply *reply)
{
    FILE *file = tmpfile();
    fflush(stdout);
    int kept = dup(STDOUT_FILENO);
    assert_true(file && kept >= 0 && dup2(fileno(file), STDOUT_FILENO) >= 0);
    reply_table_print(request, reply, NULL);
    fflush(stdout);
    assert_true(dup2(kept, STDOUT_FILENO) >= 0);
    close(kept);
    rewind(file);
    printed[fread(printed, 1, sizeof printed - 1, file)] = '\0';
    fclose(file);
}

static void expect(const char *text)
{
    if (!strstr(printed, text))
        fail_msg("'%s' is not in\n%s", text, printed);
}

static unsigned count(const char *text)
{
    unsigned found = 0;
    for (const char *at = printed; (at = strstr(at, text)); at++)
        found++;
    return found;
}

static void friction_is_told_where_it_is(void **state)
{
    (void)state;
    static struct percuss_request request;
    struct percuss_reply reply;
    percuss_v1_Reply wire = wire_reply();
    percuss_request_init(&request);
    assert_int_equal(convert_reply(&wire, &reply), PERCUSS_RESULT_OK);
    assert_true(reply_has_friction(&reply));
    print(&request, &reply);
    expect("\n  friction     0.3, partly\n"
           "  tangential   (51, 52) N s +- 53\n"
           "  slip         (54, nan) m/s, after it (0, 55) m/s  (tangential restitution 56)\n"
           "  kinematic    57 is the restitution by the rates of the gap\n");
    expect("indent./um  tangential/N s  slip\n");
    expect("(46, 47)  reversed  negligible\n");
    expect(", plastic 110.34 %, friction 200.00 %, stored 113.79 %");
    /* one number, where there is nothing along the second tangent, and nothing of no error */
    reply.contacts[0].impulse_tangential[1] = 1e-18;
    reply.contacts[0].impulse_tangential_error = 0.0;
    /* what sticks has the rounding of a slip */
    reply.contacts[0].slip_before[1] = 0.0;
    reply.contacts[0].slip_after[0] = reply.contacts[0].slip_after[1] = -1e-15;
    reply.contacts[0].tangential_restitution = 1e-16;
    print(&request, &reply);
    expect("\n  tangential   51 N s\n");
    expect("\n  slip         54 m/s, after it 0 m/s  (tangential restitution 0)\n");
    /* the second contact has none, as all contacts of older servers */
    assert_int_equal(count("  friction  "), 1);
    reply.contacts[0].friction = 0.0;
    print(&request, &reply);
    assert_false(reply_has_friction(&reply));
    assert_int_equal(count("  friction  ") + count("tangential") + count("reversed"), 0);
    percuss_reply_free(&reply);
}

/* A beam that turns about y, hit beside its middle: its surface moves along x, too. */
static void the_question_says_how_fast_it_slides(void **state)
{
    (void)state;
    static struct percuss_request request;
    struct percuss_contact_result contact = {.restitution = 0.5};
    struct percuss_reply reply = {.contact_count = 1, .contacts = &contact};
    percuss_request_init(&request);
    percuss_request_add_body(&request, "a")->velocity[2] = -0.3;
    percuss_request_add_body(&request, "b");
    struct percuss_contact *place = percuss_request_add_contact(&request, 0, 1);
    place->normal[2] = 1.0;
    print(&request, &reply);
    expect("  impact       0.3 m/s at (0, 0, 0) m\n");
    request.bodies[1].angular_velocity[1] = -1.0;
    place->point[0] = 0.1;
    place->point[2] = 0.01;
    print(&request, &reply);
    expect("  impact       0.4 m/s at (0.1, 0, 0.01) m, sliding at 0.01 m/s\n");
}

/* As of most contacts of a row. */
static void bodies_at_rest_approach_at_no_speed(void **state)
{
    (void)state;
    static struct percuss_request request;
    struct percuss_contact_result contact = {.restitution = 0.5};
    struct percuss_reply reply = {.contact_count = 1, .contacts = &contact};
    percuss_request_init(&request);
    percuss_request_add_body(&request, "a");
    percuss_request_add_body(&request, "b");
    percuss_request_add_contact(&request, 0, 1)->normal[2] = 1.0;
    print(&request, &reply);
    expect("  impact       0 m/s at (0, 0, 0) m\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(friction_is_told_where_it_is),
        cmocka_unit_test(the_question_says_how_fast_it_slides),
        cmocka_unit_test(bodies_at_rest_approach_at_no_speed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
