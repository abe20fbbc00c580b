/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests store/backup.c: a copy is whole, and links at its names lead to no other file. */
#include "store/backup.h"

#include <stdlib.h>
#include <sys/stat.h>

#include "store/database.h"
#include "unit/store/specimen_lab.h"

static void complain(void *context, const char *problem)
{
    (void)context;
    fail_msg("%s", problem);
}

static void is_a_copy(const char *copy)
{
    struct fault fault = {""};
    struct stat about;
    struct specimen_store *store;
    struct audit audit = {.complain = complain, .structure = true};
    assert_int_equal(lstat(copy, &about), 0);
    assert_true(S_ISREG(about.st_mode));
    assert_int_equal(specimen_store_open(copy, 9, &store, &fault), PERCUSS_OK);
    assert_int_equal(specimen_store_audit(store, &audit, &fault), PERCUSS_OK);
    assert_int_equal(audit.specimens, 1);
    specimen_store_close(store);
}

static void follows_no_link(void **state)
{
    (void)state;
    char copy[200], part[240], victim[160], linked[160], text[16] = "";
    struct fault fault = {""};
    struct specimen_store *store = open_store(9);
    struct body_state *dents = dented(3, 1.0);
    assert_int_equal(hit(store, "bar", dents, 1, 1), PERCUSS_OK);
    snprintf(copy, sizeof copy, "%s/copy.db", folder);
    snprintf(part, sizeof part, "%s.part", copy);
    snprintf(victim, sizeof victim, "%s/victim", folder);
    /* an empty file could become a database by itself */
    FILE *file = fopen(victim, "w");
    fclose(file);
    assert_int_equal(symlink(victim, part), 0);
    assert_int_equal(backup_write(store, copy, &fault), PERCUSS_OK);
    file = fopen(victim, "r");
    assert_int_equal(fread(text, 1, sizeof text, file), 0);
    fclose(file);
    is_a_copy(copy);
    /* through a link of its folder, in place of the former copy */
    snprintf(linked, sizeof linked, "%s-link", folder);
    assert_int_equal(symlink(folder, linked), 0);
    snprintf(copy, sizeof copy, "%s/copy.db", linked);
    assert_int_equal(backup_write(store, copy, &fault), PERCUSS_OK);
    is_a_copy(copy);
    assert_int_not_equal(access(part, F_OK), 0);
    unlink(linked);
    /* to a folder that is missing */
    assert_int_equal(backup_write(store, copy, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "-link/: cannot be written: No such file or directory"));
    snprintf(copy, sizeof copy, "%s/copy.db", folder);
    unlink(copy);
    unlink(victim);
    specimen_store_close(store);
    free(dents);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(follows_no_link, make_folder, remove_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
