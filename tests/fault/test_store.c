/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests store/ on a disk that loses power, fails or is full, at every operation: the store opens,
 * what was acknowledged is there, and impacts and replies are those before or after a transaction.
 * PERCUSS_FAULTS=whole tries every operation, otherwise some are left out. */
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "fault/disk.h"
#include "fault/impacts.h"
#include "store/database.h"

enum {
    IMPACTS = 96,
    REPLY_SIZE = 60000 /* 15 pages: so many impacts fill the log, which goes into the file then */
};
static const char NAME[] = "store.db";

static bool whole;

static int prepare(void **state)
{
    (void)state;
    disk_install();
    whole = disk_is_whole();
    return 0;
}

static void complain(void *context, const char *problem)
{
    (void)context;
    fail_msg("%s", problem);
}

/* Opens it, as after a start of the daemon. */
static struct specimen_store *open_again(void)
{
    struct specimen_store *store;
    struct fault fault;
    struct audit audit = {.complain = complain, .structure = true};
    if (specimen_store_open(NAME, IMPACTS_KEPT, &store, &fault) ||
        specimen_store_audit(store, &audit, &fault))
        fail_msg("%s", fault.text);
    return store;
}

/* Changes written down when the n-th impact was acknowledged. */
static size_t acknowledged[IMPACTS + 1];

static void record_impacts(void)
{
    struct fault fault;
    disk_clear();
    struct specimen_store *store = open_again();
    for (unsigned impact = 1; impact <= IMPACTS; impact++) {
        if (impacts_hit(store, impact, REPLY_SIZE, &fault))
            fail_msg("%s", fault.text);
        acknowledged[impact] = disk_changes();
        /* a daemon that is stopped writes its log back */
        if (impact == IMPACTS / 4 || impact == IMPACTS) {
            specimen_store_close(store);
            store = impact < IMPACTS ? open_again() : NULL;
        }
    }
}

static void power_is_lost(void **state)
{
    (void)state;
    record_impacts();
    size_t changes = disk_changes(), tried = 0;
    unsigned now = 0, between = 0;
    disk_keep_record();
    for (size_t cut = 1; cut <= changes; cut += whole ? 1 : 13) {
        while (now < IMPACTS && acknowledged[now + 1] <= cut)
            now++;
        for (unsigned seed = 0; seed < (whole ? 3 : 1); seed++, tried++) {
            disk_lose_power(cut, seed);
            struct specimen_store *store = open_again();
            unsigned count = impacts_check(store);
            /* the one that was under way is there wholly or not at all */
            if (count < now || count > now + 1)
                fail_msg("cut %zu: %u impacts of %u", cut, count, now);
            impacts_check_replies(store, count, REPLY_SIZE);
            between += count > now;
            specimen_store_close(store);
        }
    }
    /* chance has let some be whole that were not acknowledged */
    assert_true(between > 0);
    print_message("    power lost %zu times, at %zu changes; %u impacts were there that nobody was "
                  "told of\n",
                  tried, changes, between);
}

/* Does what a client does whose requests fail: asks again with the same number. */
static unsigned go_on(unsigned impacts, unsigned attempts)
{
    struct specimen_store *store;
    struct fault fault;
    unsigned done = 0;
    if (specimen_store_open(NAME, IMPACTS_KEPT, &store, &fault))
        return 0;
    for (unsigned i = 0; i < attempts && done < impacts; i++) {
        struct stored_reply found = impacts_reply(done + 1, 100);
        enum percuss_status status = specimen_store_find(store, &found, &fault);
        if (status == PERCUSS_BAD_REQUEST && done + IMPACTS_KEPT < impacts) {
            done++;
            continue;
        }
        if (!status && !found.bytes)
            status = impacts_hit(store, done + 1, 100, &fault);
        else
            free(found.bytes);
        if (!status)
            done++;
        else
            assert_int_equal(status, PERCUSS_INTERNAL);
    }
    specimen_store_close(store);
    return done;
}

/* A disk that fails while the store is used, then is good again. */
static void survive_failures(bool for_good, bool full)
{
    enum { SOME = 12 };
    unsigned long tried = 0;
    bool failed = true;
    for (unsigned long n = 1; failed; n += whole ? 1 : 1 + n / 40, tried++) {
        disk_clear();
        disk_fail(n, for_good, full);
        unsigned done = go_on(SOME, SOME + 4);
        failed = disk_has_failed();
        assert_true(failed || done == SOME);
        disk_fail(0, false, false);
        /* what was told is there; the rest is asked for again */
        struct specimen_store *store = open_again();
        unsigned count = impacts_check(store);
        if (count < done || count > done + 1)
            fail_msg("operation %lu: %u impacts of %u", n, count, done);
        impacts_check_replies(store, count, 100);
        specimen_store_close(store);
        assert_int_equal(go_on(SOME, SOME), SOME);
        store = open_again();
        assert_int_equal(impacts_check(store), SOME);
        specimen_store_close(store);
    }
    print_message("    %lu failures\n", tried);
}

static void operations_fail(void **state)
{
    (void)state;
    survive_failures(false, false);
    survive_failures(true, false);
}

static void the_disk_is_full(void **state)
{
    (void)state;
    survive_failures(false, true);
    survive_failures(true, true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(power_is_lost),
        cmocka_unit_test(operations_fail),
        cmocka_unit_test(the_disk_is_full),
    };
    return cmocka_run_group_tests(tests, prepare, NULL);
}
