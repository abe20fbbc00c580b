/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/store/family_file.c: what is saved comes back, damaged files are named, a store
 * of tables takes the family of its folder. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "contact/plastic.h"
#include "store/family_file.h"
#include "store/table_store.h"

static char folder[] = "/tmp/percuss-family-XXXXXX";
static char path[TABLE_PATH_SIZE];
static const struct family_origin origin = {"test 1", 3.0, 6, 12};

/* Two places along each axis, ten depths. */
static void save(void)
{
    enum { TABLES = 8, DEPTHS = 10, SPRINGS = 6, BRANCHES = 2, SAMPLES = 5 };
    static const double hardening[] = {0.0, 0.25}, poisson[] = {0.2, 0.4}, part[] = {0.5, 1.0};
    static double depth[DEPTHS], force[TABLES][DEPTHS], area[TABLES][DEPTHS];
    static double largest[SPRINGS], back[TABLES][SPRINGS], share[TABLES][BRANCHES][SAMPLES];
    struct fault fault = {""};
    for (int i = 0; i < DEPTHS; i++)
        depth[i] = pow(2.0, i + 1);
    for (int i = 0; i < SPRINGS; i++)
        largest[i] = pow(3.0, i + 1);
    for (int t = 0; t < TABLES; t++) {
        for (int i = 0; i < DEPTHS; i++) {
            force[t][i] = pow(depth[i], -0.3 + 0.01 * t);
            area[t][i] = 1.5;
        }
        for (int i = 0; i < SPRINGS; i++)
            back[t][i] = pow(largest[i], -0.4);
        for (int b = 0; b < BRANCHES; b++)
            for (int j = 0; j < SAMPLES; j++)
                share[t][b][j] = pow(j / 4.0, 1.5);
    }
    struct contact_family_samples samples = {
        .count = {2, 2, 2},
        .axis = {hardening, poisson, part},
        .depths = DEPTHS,
        .depth = depth,
        .force = force[0],
        .area = area[0],
        .springs = SPRINGS,
        .largest = largest,
        .back = back[0],
        .branches = BRANCHES,
        .samples = SAMPLES,
        .share = share[0][0],
        .computed = 1000.0,
        .error = 2e-3,
    };
    if (family_file_save(folder, &samples, &origin, path, &fault))
        fail_msg("%s", fault.text);
}

static void complain(const struct fault *fault)
{
    fail_msg("%s", fault->text);
}

static void what_is_saved_comes_back(void **state)
{
    (void)state;
    struct fault fault = {""};
    save();
    struct contact_family *family = family_file_load(path, &fault);
    if (!family)
        fail_msg("%s", fault.text);
    struct arena arena = {0};
    struct contact_family_place place = {0.25, 0.4, 1.0};
    struct contact_law law = contact_law_table(contact_family_curves(family, &place, &arena));
    double slope, expected = pow(64.0, 1.5 - 0.23);
    double value = law.operations->curve->force(&law, 64.0, &slope);
    /* seven digits */
    assert_true(fabs(value / expected - 1.0) < 1e-6);
    arena_release(&arena);
    contact_family_free(family);
    size_t count;
    struct table_store *store = table_store_create();
    assert_int_equal(table_store_load(store, folder, complain, &count, &fault), PERCUSS_OK);
    assert_int_equal(count, 0);
    assert_non_null(table_store_source(store)->family);
    table_store_free(store);
}

/* Replaces the first `from` in the file. */
static void damage(const char *from, const char *to)
{
    size_t size;
    struct fault fault;
    save();
    char *text;
    assert_int_equal(table_file_read(path, &text, &size, &fault), PERCUSS_OK);
    text[size] = '\0';
    char *at = strstr(text, from);
    assert_non_null(at);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
    fclose(file);
    free(text);
}

static void damaged_files_are_named(void **state)
{
    (void)state;
    static const char *const cases[][3] = {
        {"percuss contact family 1", "percuss contact table 1", "format"},
        {"\"indentation_version\":", "\"indentation_version\":9", "compute the family anew"},
        {"\"depth\":[2.0", "\"depth\":[2.5", "the file is damaged"},
        {"\"force\":[", "\"force\":[1.0,", "force: 81 values"},
        {"\"poisson\":[", "\"poisson\":[0.1,0.15,", "must be as many"},
        {"\"samples\":5", "\"samples\":4", "branches"},
        {"\"branch_count\":2", "\"branch_count\":0", "branches"},
        {"\"computed\":", "\"computed\":-", "must be beyond first yield"},
        {"\"error\":", "\"error\":-", "must be beyond first yield"},
        {"{", "[", "must be JSON"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct fault fault = {""};
        damage(cases[i][0], cases[i][1]);
        assert_null(family_file_load(path, &fault));
        if (!strstr(fault.text, cases[i][2]) || !strstr(fault.text, path))
            fail_msg("%zu: %s", i, fault.text);
    }
    struct fault fault;
    unlink(path);
    assert_null(family_file_load(path, &fault));
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(path);
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_saved_comes_back),
        cmocka_unit_test(damaged_files_are_named),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
