/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests store/, catalogue/ and mesh/ on files whose n-th operation fails: what is read is whole or
 * refused with the file's name, what is written is there wholly or not at all, and nothing is left
 * beside it or open. */
#include <dirent.h>
#include <hdf5.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "bodies/made_mesh.h"
#include "catalogue/catalogue.h"
#include "check.h"
#include "fault/interpose.h"
#include "mesh/body_file.h"
#include "mesh/mesh_read.h"
#include "store/table_file.h"
#include "store/table_key.h"
#include "store/table_store.h"
#include "unit/store/small_table.h"

static char folder[64], path[TABLE_PATH_SIZE];
static const char CATALOGUE[] = PERCUSS_SOURCE_DIR "/config/catalogue.yaml";
static const char TABLES[] = PERCUSS_SOURCE_DIR "/config/tables";

/* What is tried, and then calls over(). True: it did what it does when nothing fails. */
typedef bool file_trial(void);

static bool failed, fails_for_good;

static void over(void)
{
    failed = interpose_has_failed();
    interpose_files(NULL, 0, false);
}

static int prepare(void **state)
{
    strcpy(folder, "/tmp/percuss-files-XXXXXX");
    assert_non_null(mkdtemp(folder));
    return make_small_table(state);
}

static unsigned files_in(const char *name)
{
    DIR *all = opendir(name);
    unsigned count = 0;
    assert_non_null(all);
    while (readdir(all))
        count++;
    closedir(all);
    return count - 2;
}

static int clean(void **state)
{
    unlink(path);
    rmdir(folder);
    return free_small_table(state);
}

static unsigned open_files(void)
{
    return files_in("/proc/self/fd");
}

/* The first operation fails, the second, ..., until a trial makes no such; then all from there on.
 */
static void fail_each_operation(const char *what, const char *where, file_trial *trial)
{
    unsigned long most = 0;
    /* what is opened once for all */
    assert_true(trial());
    for (int for_good = 0; for_good < 2; for_good++) {
        fails_for_good = for_good;
        failed = true;
        for (unsigned long at = 1; failed; at++) {
            unsigned before = open_files();
            interpose_files(where, at, for_good);
            bool good = trial();
            most = failed ? at : most;
            assert_true(failed || good);
            if (open_files() != before)
                fail_msg("%s: operation %lu leaves a file open", what, at);
        }
    }
    print_message("    %-20s %lu operations\n", what, most);
    assert_true(most > 0);
}

/* The file is named in what is said. */
static void is_told(enum percuss_status status, const struct fault *fault, const char *name)
{
    assert_true(status == PERCUSS_BAD_REQUEST || status == PERCUSS_INTERNAL);
    if (!strstr(fault->text, name))
        fail_msg("not named: %s", fault->text);
}

static void remove_all(void)
{
    DIR *all = opendir(folder);
    const struct dirent *entry;
    assert_non_null(all);
    while ((entry = readdir(all)))
        unlinkat(dirfd(all), entry->d_name, 0);
    closedir(all);
}

static bool saves_a_table(void)
{
    static const struct table_origin origin = {"test 1", 3.0};
    struct indentation_table read;
    struct fault fault = {""};
    enum percuss_status status = table_file_save(folder, &small_table, &origin, path, &fault);
    over();
    if (status)
        is_told(status, &fault, folder);
    /* nothing but the table, and that is whole; where nothing can be removed a part may lie aside
     */
    bool there = access(path, F_OK) == 0;
    assert_true(there || status);
    assert_true(files_in(folder) == there || fails_for_good);
    if (there) {
        assert_int_equal(table_file_load(path, &read, &fault), PERCUSS_OK);
        indentation_table_free(&read);
    }
    remove_all();
    return !status;
}

static void complain(const struct fault *fault)
{
    assert_non_null(strstr(fault->text, TABLES));
}

static bool loads_tables(void)
{
    struct fault fault = {""};
    size_t count = 0;
    struct table_store *store = table_store_create();
    enum percuss_status status = table_store_load(store, TABLES, complain, &count, &fault);
    over();
    if (status)
        is_told(status, &fault, TABLES);
    bool whole = !status && count == 2 && table_store_source(store)->family;
    table_store_free(store);
    return whole;
}

/* With the reduced bodies that it names. */
static bool loads_the_catalogue(void)
{
    static char revision[PERCUSS_ID_SIZE];
    struct body_set *set;
    struct fault fault = {""};
    enum percuss_status status = catalogue_load(CATALOGUE, &set, &fault);
    over();
    assert_int_equal(set != NULL, !status);
    if (status) {
        is_told(status, &fault, "catalogue.yaml");
        return false;
    }
    if (!revision[0])
        strcpy(revision, set->revision);
    assert_string_equal(set->revision, revision);
    body_set_free(set);
    return true;
}

static struct mesh_body *made;

/* HDF5 keeps a file open whose closing has failed: nothing can be done about that here. */
static bool writes_a_body(void)
{
    struct mesh_body *read;
    struct fault fault = {""};
    enum percuss_status status = body_file_write(path, made, &fault);
    over();
    if (status) {
        /* where only the name could not be synchronised, the file is there and whole */
        is_told(status, &fault, folder);
        bool there = access(path, F_OK) == 0;
        assert_true(files_in(folder) == there || fails_for_good);
        if (there && body_file_read(path, &read, &fault))
            fail_msg("%s", fault.text);
        if (there)
            mesh_body_free(read);
        remove_all();
        return false;
    }
    if (body_file_read(path, &read, &fault))
        fail_msg("%s", fault.text);
    assert_int_equal(read->mode_count, made->mode_count);
    mesh_body_free(read);
    remove_all();
    return true;
}

static bool reads_a_body(void)
{
    static const char SHIPPED[] = PERCUSS_SOURCE_DIR "/config/bodies/half-plate-20.h5";
    struct mesh_body *read;
    struct fault fault = {""};
    enum percuss_status status = body_file_read(SHIPPED, &read, &fault);
    over();
    assert_int_equal(read != NULL, !status);
    if (status)
        is_told(status, &fault, "half-plate-20.h5");
    mesh_body_free(read);
    return !status;
}

static void files_of_tables(void **state)
{
    (void)state;
    fail_each_operation("saving a table", folder, saves_a_table);
    fail_each_operation("loading tables", TABLES, loads_tables);
}

static void files_of_the_catalogue(void **state)
{
    (void)state;
    fail_each_operation("loading a catalogue", PERCUSS_SOURCE_DIR "/config/", loads_the_catalogue);
}

static void a_body_file(void **state)
{
    (void)state;
    struct body rod = {.kind = &rod_kind, .radius = 0.01, .length = 0.2, .tip_radius = INFINITY};
    struct fault fault;
    strcpy(rod.id, "rod");
    rod.material = small_soft;
    assert_int_equal(body_complete(&rod, &fault), PERCUSS_OK);
    made = made_mesh_bar(&(struct made_mesh){.bar = &rod, .modes = 3, .around = 8, .along = 4});
    assert_non_null(made);
    snprintf(path, sizeof path, "%s/body.h5", folder);
    fail_each_operation("writing a body", folder, writes_a_body);
    fail_each_operation("reading a body", PERCUSS_SOURCE_DIR "/config/bodies", reads_a_body);
    mesh_body_free(made);
}

/* Cut anywhere, with other numbers, it is no table. */
static void a_table_that_is_cut_off(void **state)
{
    static const struct table_origin origin = {"test 1", 3.0};
    struct indentation_table read;
    struct fault fault;
    (void)state;
    char *text = table_json_write(&small_table, &origin);
    size_t size = strlen(text), digits = 0;
    while (text[size - 1] == '\n')
        size--;
    for (size_t cut = 0; cut < size; cut += 7)
        assert_int_equal(table_json_read(text, cut, &read, &fault), PERCUSS_BAD_REQUEST);
    /* another digit: the hashes tell, unless it is of what says how the table was made */
    char key[TABLE_KEY_SIZE], expected[TABLE_KEY_SIZE];
    table_content_key(&small_table, expected);
    for (size_t i = 0; i < size; i += 11) {
        char was = text[i];
        if (was < '0' || was > '9')
            continue;
        text[i] = was == '9' ? '1' : (char)(was + 1);
        enum percuss_status status = table_json_read(text, size, &read, &fault);
        if (!status) {
            /* the last of 17 digits may make no difference */
            table_content_key(&read, key);
            assert_string_equal(key, expected);
            indentation_table_free(&read);
        }
        digits += status == PERCUSS_BAD_REQUEST;
        text[i] = was;
    }
    assert_true(digits > 100);
    free(text);
}

int main(void)
{
    /* as the programs do that write: before HDF5 is used at all, or its end of the process falls
     * over a file whose closing has failed */
    H5dont_atexit();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_of_tables),
        cmocka_unit_test(files_of_the_catalogue),
        cmocka_unit_test(a_body_file),
        cmocka_unit_test(a_table_that_is_cut_off),
    };
    return cmocka_run_group_tests(tests, prepare, clean);
}
