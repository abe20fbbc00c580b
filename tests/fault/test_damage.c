/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests store/ on a file of which some bytes are not what was written: it is noticed, when the
 * store is opened or looked through, or nothing that the store says has changed.
 * PERCUSS_FAULTS=whole tries every byte. */
#include <sqlite3.h>
#include <string.h>

#include "check.h"
#include "fault/disk.h"
#include "fault/impacts.h"
#include "store/database.h"

enum { IMPACTS = 40, REPLY_SIZE = 300 };
static const char NAME[] = "store.db";

static size_t changes;

/* A store, written back and closed. */
static int make_store(void **state)
{
    (void)state;
    struct specimen_store *store;
    struct fault fault;
    disk_install();
    disk_clear();
    assert_int_equal(specimen_store_open(NAME, IMPACTS_KEPT, &store, &fault), PERCUSS_OK);
    for (unsigned impact = 1; impact <= IMPACTS; impact++)
        assert_int_equal(impacts_hit(store, impact, REPLY_SIZE, &fault), PERCUSS_OK);
    specimen_store_close(store);
    changes = disk_changes();
    disk_keep_record();
    return 0;
}

static void count_complaint(void *context, const char *problem)
{
    (void)context, (void)problem;
}

/* Whether damage is noticed; fails the test where it is not, and something differs. */
static bool is_noticed(void)
{
    struct specimen_store *store;
    struct fault fault = {""};
    struct audit audit = {.complain = count_complaint};
    if (specimen_store_open(NAME, IMPACTS_KEPT, &store, &fault)) {
        assert_non_null(strstr(fault.text, NAME));
        return true;
    }
    enum percuss_status status = specimen_store_audit(store, &audit, &fault);
    if (!status && !audit.damaged) {
        assert_int_equal(impacts_check(store), IMPACTS);
        impacts_check_replies(store, IMPACTS, REPLY_SIZE);
    }
    specimen_store_close(store);
    return status || audit.damaged;
}

static size_t restore(void)
{
    disk_lose_power(changes, 0);
    return disk_size(NAME);
}

static void sixty_four_random_bytes(void **state)
{
    (void)state;
    unsigned noticed = 0, trials = disk_is_whole() ? 20000 : 1000;
    for (unsigned i = 0; i < trials; i++) {
        unsigned char bytes[64];
        size_t size = restore();
        for (size_t k = 0; k < sizeof bytes; k++)
            bytes[k] = (unsigned char)disk_draw(256);
        disk_write(NAME, disk_draw((unsigned)(size - sizeof bytes)), bytes, sizeof bytes);
        noticed += is_noticed();
    }
    print_message("    noticed %u of %u; the others changed nothing that the store says\n", noticed,
                  trials);
    /* the rest of the file is free pages, which replies that went have left */
    assert_true(noticed > trials / 10);
}

static void one_bit(void **state)
{
    (void)state;
    size_t size = restore(), noticed = 0, tried = 0;
    for (size_t at = 0; at < size; at += disk_is_whole() ? 1 : 37, tried++) {
        restore();
        unsigned char byte = disk_byte(NAME, at) ^ (unsigned char)(1 << at % 8);
        disk_write(NAME, at, &byte, 1);
        noticed += is_noticed();
    }
    print_message("    noticed %zu of %zu\n", noticed, tried);
}

static void a_part_is_lost(void **state)
{
    (void)state;
    size_t size = restore(), tried = 0;
    for (size_t cut = 0; cut < size; cut += disk_is_whole() ? 64 : 512, tried++) {
        restore();
        disk_cut(NAME, cut);
        /* an empty file is a new store: nothing tells it from one */
        if (cut > 0)
            assert_true(is_noticed());
    }
    print_message("    cut at %zu places\n", tried);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sixty_four_random_bytes),
        cmocka_unit_test(one_bit),
        cmocka_unit_test(a_part_is_lost),
    };
    return cmocka_run_group_tests(tests, make_store, NULL);
}
