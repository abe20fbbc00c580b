/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/store/table_file.c: every bit comes back, damage is refused. */
#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

#include "store/table_file.h"
#include "unit/store/small_table.h"

static const struct table_origin origin = {"test 1", 0.5};

static void same_numbers(const double *a, const double *b, size_t count)
{
    assert_memory_equal(a, b, count * sizeof *a);
}

static void same_table(const struct indentation_table *a, const struct indentation_table *b)
{
    const double left[] = {a->hertz,          a->force_error,  a->residual_error,
                           a->recovery_error, a->input.radius, a->input.indentation};
    const double right[] = {b->hertz,          b->force_error,  b->residual_error,
                            b->recovery_error, b->input.radius, b->input.indentation};
    same_numbers(left, right, 6);
    for (int i = 0; i < 2; i++) {
        const struct material *x = &a->input.materials[i], *y = &b->input.materials[i];
        assert_true(table_same_material(x, y) && x->density == y->density);
        assert_string_equal(x->name, y->name);
    }
    assert_true(a->points == b->points && a->branches == b->branches && a->version == b->version &&
                a->nodes == b->nodes && a->newton_steps == b->newton_steps &&
                a->input.resolution == b->input.resolution);
    same_numbers(a->indentation, b->indentation, a->points);
    same_numbers(a->force, b->force, a->points);
    same_numbers(a->radius, b->radius, a->points);
    same_numbers(a->largest, b->largest, a->branches);
    same_numbers(a->largest_force, b->largest_force, a->branches);
    same_numbers(a->residual, b->residual, a->branches);
    same_numbers(a->recovery, b->recovery, a->branches * INDENTATION_SAMPLES);
}

static void make_folder(char folder[64])
{
    snprintf(folder, 64, "/tmp/percuss-tables-XXXXXX");
    assert_non_null(mkdtemp(folder));
}

static size_t files_in(const char *folder)
{
    DIR *directory = opendir(folder);
    size_t count = 0;
    for (struct dirent *entry; (entry = readdir(directory));)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(directory);
    return count;
}

static void every_bit_comes_back(void **state)
{
    (void)state;
    char top[64], folder[80], path[TABLE_PATH_SIZE];
    struct indentation_table back;
    struct fault fault;
    make_folder(top);
    /* with the folder that it lies in */
    snprintf(folder, sizeof folder, "%s/own/tables", top);
    /* twice: the second one takes the first one's place */
    for (int i = 0; i < 2; i++) {
        if (table_file_save(folder, &small_table, &origin, path, &fault))
            fail_msg("%s", fault.text);
        assert_int_equal(files_in(folder), 1);
        if (table_file_load(path, &back, &fault))
            fail_msg("%s", fault.text);
        same_table(&small_table, &back);
        indentation_table_free(&back);
    }
    unlink(path);
    rmdir(folder);
    *strrchr(folder, '/') = '\0';
    rmdir(folder);
    assert_int_equal(rmdir(top), 0);
}

static void folders_that_do_not_do_are_named(void **state)
{
    (void)state;
    char top[64], path[TABLE_PATH_SIZE], folder[96];
    struct indentation_table back;
    struct fault fault;
    make_folder(top);
    snprintf(folder, sizeof folder, "%s/file", top);
    fclose(fopen(folder, "w"));
    snprintf(folder, sizeof folder, "%s/file/tables", top);
    assert_int_equal(table_file_save(folder, &small_table, &origin, path, &fault),
                     PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, folder));
    assert_int_equal(table_file_load(folder, &back, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, folder));
    assert_int_equal(table_file_load(top, &back, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "must be a file"));
    /* a file where the folder should be */
    snprintf(folder, sizeof folder, "%s/file", top);
    assert_int_equal(table_file_save(folder, &small_table, &origin, path, &fault),
                     PERCUSS_BAD_REQUEST);
    unlink(folder);
    rmdir(top);
}

/* Whatever octet changes: refused, or nothing that counts has changed (names, density, effort). */
static void no_damage_gets_through(void **state)
{
    (void)state;
    char *text = table_json_write(&small_table, &origin);
    assert_non_null(text);
    size_t size = strlen(text);
    struct indentation_table back;
    struct fault fault;
    char before[TABLE_KEY_SIZE], after[TABLE_KEY_SIZE];
    table_content_key(&small_table, before);
    size_t refused = 0;
    for (size_t i = 0; i < size; i += 7) {
        char kept = text[i];
        text[i] = (char)(kept ^ (1 << (i % 7)));
        fault.text[0] = '\0';
        if (table_json_read(text, size, &back, &fault)) {
            refused++;
            assert_true(fault.text[0] && !back.force);
        } else {
            table_content_key(&back, after);
            assert_string_equal(before, after);
            indentation_table_free(&back);
        }
        text[i] = kept;
    }
    /* the most of it are digits that count */
    assert_true(refused > size / 7 / 2);
    /* white space at the very end may be missing */
    for (size_t cut = 0; cut + 2 < size; cut += 11)
        assert_int_equal(table_json_read(text, cut, &back, &fault), PERCUSS_BAD_REQUEST);
    free(text);
}

static void foreign_content_is_refused_by_name(void **state)
{
    (void)state;
    static const char *const texts[][2] = {
        {"", "JSON"},
        {"[]", "format"},
        {"{}", "format"},
        {"{\"format\": 3}", "format"},
        {"{\"format\": \"percuss contact table 1\"}", "indentation_version"},
        {"{\"format\": \"percuss contact table 1\", \"indentation_version\": 999}", "anew"},
        {"{\"format\": \"percuss contact table 1\", \"indentation_version\": 1}", "young"},
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct indentation_table back;
        struct fault fault;
        assert_int_equal(table_json_read(texts[i][0], strlen(texts[i][0]), &back, &fault),
                         PERCUSS_BAD_REQUEST);
        assert_non_null(strstr(fault.text, texts[i][1]));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_bit_comes_back),
        cmocka_unit_test(folders_that_do_not_do_are_named),
        cmocka_unit_test(no_damage_gets_through),
        cmocka_unit_test(foreign_content_is_refused_by_name),
    };
    return cmocka_run_group_tests(tests, make_small_table, free_small_table);
}
