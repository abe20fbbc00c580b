/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* mesh/mesh_read: the digest of a mesh's file and of those that its deck includes. */
#include "mesh/mesh_read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"

static char folder[] = "/tmp/test_mesh_digest_XXXXXX";

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? chdir(folder) : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    return chdir("/") || rmdir(folder);
}

static void write_file(const char *name, const char *text)
{
    FILE *stream = fopen(name, "w");
    assert_non_null(stream);
    assert_true(fputs(text, stream) >= 0);
    assert_int_equal(fclose(stream), 0);
}

struct name {
    char text[SHA256_TEXT];
};

static struct name digest(const char *path)
{
    struct fault fault = {""};
    struct name name;
    struct sha256 hash = sha256_begin();
    if (mesh_digest(path, &hash, &fault))
        fail_msg("%s", fault.text);
    sha256_end(&hash, name.text);
    return name;
}

static void a_file_alone_is_its_bytes(void **state)
{
    (void)state;
    static const char text[] = "*NODE\n1, 0, 0, 0\n";
    struct name name;
    struct sha256 hash = sha256_begin();
    sha256_add(&hash, text, strlen(text));
    sha256_end(&hash, name.text);
    write_file("a.inp", text);
    write_file("a.msh", text);
    assert_string_equal(digest("a.inp").text, name.text);
    assert_string_equal(digest("a.msh").text, name.text);
    /* a line that includes means nothing to others */
    write_file("a.msh", "$MeshFormat\n*INCLUDE, INPUT=none\n");
    digest("a.msh");
    remove("a.inp");
    remove("a.msh");
}

static void what_is_included_counts(void **state)
{
    (void)state;
    /* through a folder, a line that goes on, any letters, and another file in between */
    assert_int_equal(system("mkdir parts"), 0);
    write_file("a.inp", "*node\n1, 0, 0, 0\n*include,\ninput = parts/b.inc\n");
    write_file("parts/b.inc", "2, 0, 0, 1\n* Include, Input=\"c.inc\"\n");
    write_file("parts/c.inc", "3, 0, 1, 0\n");
    struct name first = digest("a.inp");
    assert_string_equal(digest("a.inp").text, first.text);
    write_file("parts/c.inc", "3, 0, 2, 0\n");
    assert_string_not_equal(digest("a.inp").text, first.text);
    /* a line that moves from one file into the next one */
    write_file("parts/b.inc", "*INCLUDE, INPUT=c.inc\n4, 0, 0, 0\n");
    first = digest("a.inp");
    write_file("parts/b.inc", "*INCLUDE, INPUT=c.inc\n");
    write_file("parts/c.inc", "4, 0, 0, 0\n3, 0, 2, 0\n");
    assert_string_not_equal(digest("a.inp").text, first.text);
    /* nothing is read after a step, in whatever file it stands */
    write_file("parts/c.inc", "*STEP\n*INCLUDE, INPUT=none\n");
    write_file("parts/b.inc", "*INCLUDE, INPUT=c.inc\n*INCLUDE, INPUT=none\n");
    digest("a.inp");
    assert_int_equal(system("rm -r parts a.inp"), 0);
}

static void what_cannot_be_read_is_named(void **state)
{
    (void)state;
    struct fault fault = {""};
    struct sha256 hash = sha256_begin();
    assert_int_equal(mesh_digest("none.inp", &hash, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "none.inp: No such file"));
    /* a deck is one by whatever name */
    write_file("a.msh", "** made by hand\n*INCLUDE, INPUT=none.inc\n");
    assert_int_equal(mesh_digest("a.msh", &hash, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "none.inc: No such file"));
    remove("a.msh");
    /* itself, over and over: the reader refuses it */
    write_file("a.inp", "*INCLUDE, INPUT=a.inp\n*INCLUDE, INPUT=a.inp\n");
    digest("a.inp");
    remove("a.inp");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_alone_is_its_bytes),
        cmocka_unit_test(what_is_included_counts),
        cmocka_unit_test(what_cannot_be_read_is_named),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
