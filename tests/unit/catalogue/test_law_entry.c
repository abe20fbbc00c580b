/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/catalogue/law_entry.c: laws of a catalogue with their files; what is refused
 * is told with its line. */
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "model/material.h"
#include "unit/catalogue/parse.h"

static char folder[] = "/tmp/percuss-laws-XXXXXX";
static const char *const names[] = {"catalogue.yaml", "points.csv", "back.csv"};

static const char *path_of(const char *name)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void write_file(const char *name, const char *text)
{
    FILE *file = fopen(path_of(name), "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static int begin(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : 1;
}

static int end(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(names); i++)
        unlink(path_of(names[i]));
    return rmdir(folder);
}

#define BODIES                                                                                     \
    "materials:\n"                                                                                 \
    "  steel: {young: 210e9, poisson: 0.3, density: 7800}\n"                                       \
    "  rubber: {young: 5e6, poisson: 0.49, density: 1100}\n"                                       \
    "bodies:\n"                                                                                    \
    "  ball: {shape: sphere, material: steel, radius: 0.01}\n"                                     \
    "laws:\n"

static const char GOOD[] =
    "column 1: indentation/m, column 2: force/N\n0, 0\n# smoothed\n1e-3, 10\n2e-3, 40\n";

/* A catalogue of the test's folder with one law, whose keys these are. */
static enum percuss_status load(const char *keys, struct body_set **set, struct fault *fault)
{
    char text[1000];
    snprintf(text, sizeof text, BODIES "  pad: {between: [steel, rubber], %s}\n", keys);
    write_file("catalogue.yaml", text);
    return catalogue_load(path_of("catalogue.yaml"), set, fault);
}

static void refused(const char *keys, const char *message)
{
    struct body_set *set;
    struct fault fault = {0};
    if (load(keys, &set, &fault) != PERCUSS_BAD_REQUEST || !strstr(fault.text, message))
        fail_msg("%s\nexpected %s\nfor %s", fault.text, message, keys);
}

static void powers(void **state)
{
    (void)state;
    struct body_set *set = parse_good(
        BODIES "  pad: {between: [steel, rubber], stiffness: 2e6}\n"
               "  stop: {between: [rubber, rubber], stiffness: 1e5, exponent: 2, hysteresis: 0.3, "
               "deviation: 0.1}\n");
    const struct material steel = {"steel", 1.0, 0.3, 1.0, 1.0, 0.0};
    const struct material rubber = {"rubber", 1.0, 0.3, 1.0, 1.0, 0.0};
    const struct own_law *pad = body_set_law(set, &rubber, &steel);
    const struct own_law *stop = body_set_law(set, &rubber, &rubber);
    assert_ptr_equal(pad, body_set_law(set, &steel, &rubber));
    assert_null(body_set_law(set, &steel, &steel));
    assert_string_equal(pad->name, "pad");
    assert_true(pad->stiffness == 2e6 && pad->exponent == 1.5 && pad->deviation == 0.05);
    assert_true(stop->exponent == 2.0 && stop->hysteresis == 0.3 && stop->deviation == 0.1);
    body_set_free(set);
    parse_bad(BODIES "  a: {between: [steel, rubber], stiffness: 1}\n"
                     "  b: {between: [rubber, steel], stiffness: 1}\n",
              8, "laws.b: between rubber and steel: must have one law, and has that of a");
    parse_bad(BODIES "  a: {between: [steel, wood], stiffness: 1}\n", 7,
              "laws.a.between: wood: unknown material");
}

static void numbers_are_checked(void **state)
{
    (void)state;
    refused("stiffness: -1",
            "laws.pad.stiffness: -1: must be a plain number of N/m^exponent (1e-3 to");
    refused("stiffness: 1, exponent: 0.5", "laws.pad.exponent: 0.5: must be a number >= 1");
    refused("stiffness: 1, hysteresis: 1", "laws.pad.hysteresis: 1: must be a share >= 0 and < 1");
    refused("stiffness: 1, dissipation: -1", "laws.pad.dissipation: -1: must be a number >= 0");
    refused("stiffness: 1, deviation: 2", "laws.pad.deviation: 2: must be a share");
    refused("exponent: 2", "laws.pad: stiffness or points missing: a law must have one of them");
    refused("stiffness: 1, hysteresis: 0.1, dissipation: 1",
            "laws.pad.dissipation: must be absent beside hysteresis");
    refused("stiffness: 1, points: points.csv", "laws.pad.points: must be absent beside stiffness");
    refused("stiffness: 1, unloading: back.csv", "laws.pad.unloading: must be absent beside");
    refused("exponent: 2, points: points.csv", "laws.pad.exponent: must be absent beside points");
}

static void paths_that_are_too_long_are_refused(void **state)
{
    (void)state;
    char text[300];
    snprintf(text, sizeof text, "points: %0256d", 0);
    refused(text, "laws.pad.points: a path of 256 bytes: at most 255 are allowed");
}

/* Files are found beside the catalogue, in either order of unloading. */
static void points(void **state)
{
    (void)state;
    struct body_set *set;
    struct fault fault = {0};
    char revisions[3][PERCUSS_ID_SIZE];
    write_file("points.csv", GOOD);
    write_file("back.csv", "2e-3;40\n1.5e-3;15\n0.5e-3;0\n");
    for (int i = 0; i < 3; i++) {
        if (i == 2)
            write_file("back.csv", "2e-3;40\n1.5e-3;14\n0.5e-3;0\n");
        if (load(i ? "points: points.csv, unloading: back.csv" : "points: points.csv", &set,
                 &fault))
            fail_msg("%s", fault.text);
        const struct own_law *law = &set->laws[0];
        memcpy(revisions[i], set->revision, PERCUSS_ID_SIZE);
        assert_int_equal(law->points.count, 3);
        assert_true(law->points.indentation[2] == 2e-3 && law->points.force[1] == 10.0);
        assert_int_equal(law->unloading.count, i ? 3 : 0);
        assert_true(!i || (law->unloading.indentation[0] == 0.5e-3 &&
                           law->unloading.force[1] == (i == 1 ? 15.0 : 14.0)));
        body_set_free(set);
    }
    /* what the files hold is part of the revision */
    assert_string_not_equal(revisions[0], revisions[1]);
    assert_string_not_equal(revisions[1], revisions[2]);
}

static void lines_of_files(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } bad[] = {
        {"0,0\n1e-3,10\n", "points.csv: 2 points: must have at least 3"},
        {"0,0\n1e-3,10\n0.5e-3,20\n", "points.csv:3: 0.0005 m, 20 N: must rise in both columns"},
        {"0,0\n1e-3,10\n\n2e-3,10\n", "points.csv:4: 0.002 m, 10 N: must rise in both columns"},
        {"0,1\n1e-3,10\n2e-3,20\n", "points.csv:1: 0 m, 1 N: must have no force"},
        {"-1e-3,0\n1e-3,10\n2e-3,20\n", "points.csv:1: -0.001 m, 0 N: must have an indentation of"},
        {"1e-3,0\n2e-3,10\n3e-3,20\n", "points.csv:1: 0.001 m, 0 N: must be at 0 m: the touch"},
        {"d,F\n0,0\nx,1\n", "points.csv:3: must be two numbers with decimal points"},
        {"0,0\n1e-3,nan\n", "points.csv:2: must be two numbers with decimal points"},
        {"mm,N\n0,0\n1,1\n2,2\n", "points.csv:1: must name an indentation in m, then a force in N"},
        {"force/N,indentation/m\n0,0\n1,1\n2,2\n", "points.csv:1: must name an indentation in m"},
        {"\xef\xbb\xbf"
         "0,0\r\n1e-3,10\r\n",
         "points.csv: 2 points: must have"},
        {"0,00001;10,5\n1,1\n", "points.csv:1: must be two numbers with decimal points"},
        {"0,0\n1e-5.5\n2e-5,1\n", "points.csv:2: must be two numbers with decimal points"},
        {"0,0\n0x1p-3,1\n2,2\n", "points.csv:2: must be two numbers with decimal points"},
        {"0,0,0\n1,1,1\n", "points.csv:1: must be two numbers with decimal points"},
    };
    for (size_t i = 0; i < COUNT(bad); i++) {
        write_file("points.csv", bad[i].text);
        refused("points: points.csv", bad[i].message);
    }
    refused("points: none.csv", "none.csv: No such file");
    refused("points: .", ": not a regular file");
    write_file("points.csv", GOOD);
    write_file("back.csv", "0,0\n1e-3,5\n2e-3,41\n");
    refused("points: points.csv, unloading: back.csv",
            "back.csv:3: 0.002 m, 41 N: must be the last one of points, 0.002 m and 40 N");
    write_file("back.csv", "0,0\n1e-3,12\n2e-3,40\n");
    refused("points: points.csv, unloading: back.csv",
            "back.csv: must never bear more than loading: from ");
    /* below loading from the last point, above it from others, where loading bends the other way */
    write_file("points.csv", "0,0\n1e-4,5\n2e-4,30\n3e-4,80\n4e-4,110\n6e-4,130\n1e-3,150\n");
    write_file("back.csv", "0,0\n1e-4,4\n2e-4,25\n3e-4,70\n4e-4,100\n6e-4,120\n1e-3,150\n");
    refused("points: points.csv, unloading: back.csv", ", and make energy");
    /* a pipe is not waited for; a long comment is one line */
    unlink(path_of("points.csv"));
    assert_int_equal(mkfifo(path_of("points.csv"), 0600), 0);
    refused("points: points.csv", "points.csv: not a regular file");
    unlink(path_of("points.csv"));
    char comment[400];
    memset(comment, '#', sizeof comment);
    strcpy(comment + 300, "\n0,0\n1,1\n2,2,\n");
    write_file("points.csv", comment);
    refused("points: points.csv", "points.csv:4: must be two numbers");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers),
        cmocka_unit_test(numbers_are_checked),
        cmocka_unit_test(paths_that_are_too_long_are_refused),
        cmocka_unit_test(points),
        cmocka_unit_test(lines_of_files),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
