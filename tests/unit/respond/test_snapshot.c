/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests respond/snapshot.c: who holds a snapshot keeps it through a reload. */
#include <stdio.h>
#include <unistd.h>

#include "check.h"
#include "model/ritz_store.h"
#include "respond/snapshot.h"

static char path[] = "/tmp/percuss_snapshot_XXXXXX";

static void write_catalogue(const char *radius)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file,
            "materials:\n"
            "  steel: {young: 210e9, poisson: 0.3, density: 7800}\n"
            "bodies:\n"
            "  ball: {shape: sphere, material: steel, radius: %s}\n",
            radius);
    fclose(file);
}

static int create_file(void **state)
{
    (void)state;
    int file = mkstemp(path);
    return file < 0 ? -1 : close(file);
}

static int remove_file(void **state)
{
    (void)state;
    return unlink(path);
}

static void a_job_keeps_its_snapshot_through_a_reload(void **state)
{
    (void)state;
    struct snapshots snapshots;
    struct table_cache tables;
    struct snapshot *before;
    struct fault fault;
    write_catalogue("0.010");
    assert_int_equal(snapshots_open(&snapshots, RITZ_STORE_BYTES, path, &tables, "", &fault),
                     PERCUSS_OK);
    struct snapshot *held = snapshots_hold(&snapshots);
    assert_ptr_equal(held->tables, &tables);
    write_catalogue("0.020");
    assert_int_equal(snapshots_reload(&snapshots, path, &before, &fault), PERCUSS_OK);
    assert_ptr_equal(before, held);
    snapshots_release(&snapshots, before);
    /* the old one is still whole, the new one is what is held from now on */
    assert_true(body_set_find(held->set, "ball")->radius == 0.010);
    struct snapshot *now = snapshots_hold(&snapshots);
    assert_ptr_not_equal(now, held);
    assert_ptr_equal(now->tables, &tables);
    assert_true(body_set_find(now->set, "ball")->radius == 0.020);
    assert_string_not_equal(now->set->revision, held->set->revision);
    snapshots_release(&snapshots, now);
    snapshots_release(&snapshots, held);
    snapshots_close(&snapshots);
}

static void a_bad_catalogue_changes_nothing(void **state)
{
    (void)state;
    struct snapshots snapshots;
    struct snapshot *before;
    struct fault fault;
    write_catalogue("-1");
    assert_int_not_equal(snapshots_open(&snapshots, RITZ_STORE_BYTES, path, NULL, "", &fault),
                         PERCUSS_OK);
    snapshots_close(&snapshots);
    write_catalogue("0.010");
    assert_int_equal(snapshots_open(&snapshots, RITZ_STORE_BYTES, path, NULL, "", &fault),
                     PERCUSS_OK);
    struct snapshot *held = snapshots_hold(&snapshots);
    write_catalogue("-1");
    assert_int_not_equal(snapshots_reload(&snapshots, path, &before, &fault), PERCUSS_OK);
    assert_null(before);
    struct snapshot *now = snapshots_hold(&snapshots);
    assert_ptr_equal(now, held);
    snapshots_release(&snapshots, now);
    snapshots_release(&snapshots, held);
    snapshots_close(&snapshots);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_job_keeps_its_snapshot_through_a_reload),
        cmocka_unit_test(a_bad_catalogue_changes_nothing),
    };
    return cmocka_run_group_tests(tests, create_file, remove_file);
}
