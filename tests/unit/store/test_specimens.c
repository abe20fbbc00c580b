/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests store/specimens.c: what is committed is there after reopening, together or not at all;
 * whose specimen it is; how many replies are kept. */
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "unit/store/specimen_lab.h"

static void count_impacts(void *context, const struct specimen *specimen)
{
    *(uint64_t *)context += specimen->impacts;
}

static uint64_t impacts(struct specimen_store *store, const char *name)
{
    uint64_t count = 0;
    struct fault fault;
    assert_int_equal(specimen_store_visit(store, name, count_impacts, &count, &fault), PERCUSS_OK);
    return count;
}

static void keeps_to_the_last_bit(void **state)
{
    (void)state;
    struct body_state *one = dented(1, 1.0), *many = dented(BODY_STATE_MAX_DENTS, 2.0);
    struct specimen_store *store = open_store(10);
    has_dents(store, "bar", NULL);
    assert_int_equal(hit(store, "bar", many, 1, 7), PERCUSS_OK);
    assert_int_equal(hit(store, "bar", one, 1, UINT64_MAX), PERCUSS_OK);
    assert_int_equal(hit(store, "other", many, 2, 7), PERCUSS_OK);
    assert_int_equal(hit(store, "smooth", NULL, 2, 8), PERCUSS_OK);
    for (int round = 0; round < 2; round++) {
        has_dents(store, "bar", one);
        has_dents(store, "other", many);
        has_dents(store, "smooth", NULL);
        finds(store, 1, 7, "reply 1 7");
        finds(store, 1, UINT64_MAX, "reply 1 18446744073709551615");
        finds(store, 2, 7, "reply 2 7");
        finds(store, 3, 7, "");
        assert_int_equal(impacts(store, "bar"), 2);
        assert_int_equal(impacts(store, NULL), 4);
        assert_int_equal(specimen_store_count(store), 3);
        specimen_store_close(store);
        store = open_store(10);
    }
    specimen_store_close(store);
    free(one);
    free(many);
}

/* A process that dies with the transaction open, or right after it. */
static void survives_a_kill(void **state)
{
    (void)state;
    struct body_state *first = dented(3, 1.0), *second = dented(4, 2.0);
    pid_t child = fork();
    if (child == 0) {
        struct specimen_store *store = open_store(10);
        if (hit(store, "bar", first, 1, 1) == PERCUSS_OK)
            raise(SIGKILL);
        _exit(1);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    struct specimen_store *store = open_store(10);
    has_dents(store, "bar", first);
    finds(store, 1, 1, "reply 1 1");
    /* the second reply of this number cannot be stored, so the dents are not either */
    assert_int_equal(hit(store, "bar", second, 1, 1), PERCUSS_INTERNAL);
    has_dents(store, "bar", first);
    assert_int_equal(impacts(store, "bar"), 1);
    assert_int_equal(hit(store, "bar", second, 1, 2), PERCUSS_OK);
    has_dents(store, "bar", second);
    specimen_store_close(store);
    free(first);
    free(second);
}

static void refuses_another_body(void **state)
{
    (void)state;
    struct body_state *dents = dented(1, 1.0), *loaded;
    struct fault fault;
    struct specimen_store *store = open_store(10);
    assert_int_equal(hit(store, "bar", dents, 1, 1), PERCUSS_OK);
    struct body body = rod();
    strcpy(body.id, "beam");
    assert_int_equal(specimen_store_load(store, "bar", &body, &loaded, &fault),
                     PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "bar: is a specimen of rod, not of beam"));
    body = rod();
    body.material.yield = 206e6;
    assert_int_equal(specimen_store_load(store, "bar", &body, &loaded, &fault),
                     PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "bar: is a specimen of another rod"));
    assert_null(loaded);
    /* what the dents do not depend on may change */
    body = rod();
    body.damping = 0.01;
    body.modes = 7;
    assert_int_equal(specimen_store_load(store, "bar", &body, &loaded, &fault), PERCUSS_OK);
    free(loaded);
    /* cleared, the name is free; the reply is still known */
    assert_int_equal(specimen_store_clear(store, "bar", &fault), PERCUSS_OK);
    assert_int_equal(specimen_store_clear(store, "bar", &fault), PERCUSS_OK);
    assert_int_equal(specimen_store_count(store), 0);
    strcpy(body.id, "beam");
    assert_int_equal(specimen_store_load(store, "bar", &body, &loaded, &fault), PERCUSS_OK);
    assert_null(loaded);
    finds(store, 1, 1, "reply 1 1");
    specimen_store_close(store);
    free(dents);
}

static void keeps_the_last_replies(void **state)
{
    (void)state;
    struct fault fault;
    struct specimen_store *store = open_store(4);
    for (uint64_t i = 1; i <= 10; i++)
        assert_int_equal(hit(store, "bar", NULL, 1, i), PERCUSS_OK);
    finds(store, 1, 7, "reply 1 7");
    struct stored_reply old = {.client = {1}, .sequence = 6};
    assert_int_equal(specimen_store_find(store, &old, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "sequence: 6: replies up to 6"));
    /* a lower limit holds from the next one on */
    specimen_store_close(store);
    store = open_store(2);
    assert_int_equal(hit(store, "bar", NULL, 2, 1), PERCUSS_OK);
    old.sequence = 9;
    assert_int_equal(specimen_store_find(store, &old, &fault), PERCUSS_BAD_REQUEST);
    finds(store, 1, 10, "reply 1 10");
    finds(store, 1, 11, "");
    finds(store, 2, 1, "reply 2 1");
    assert_int_equal(impacts(store, "bar"), 11);
    specimen_store_close(store);
}

/* 1 MiB and what one impact writes; without the bound 300 impacts of 9 pages make 4 MiB. */
static void bounds_the_log(void **state)
{
    (void)state;
    char name[160], text[20000];
    struct stat log;
    struct body body = rod();
    struct fault fault;
    struct specimen_store *store = open_store(9);
    struct body_state *dents = dented(30, 1.0);
    memset(text, 'a', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    snprintf(name, sizeof name, "%s-wal", path);
    off_t most = 0;
    for (uint64_t i = 1; i <= 300; i++) {
        struct specimen_change change = {"bar", &body, dents};
        struct stored_reply reply = reply_of(1, i, text);
        assert_int_equal(specimen_store_commit(store, &change, 1, &reply, &fault), PERCUSS_OK);
        assert_int_equal(stat(name, &log), 0);
        most = log.st_size > most ? log.st_size : most;
    }
    print_message("    at most %ld KiB\n", (long)most / 1024);
    assert_true(most > 900 * 1024 && most < 1200 * 1024);
    specimen_store_close(store);
    free(dents);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(keeps_to_the_last_bit), WITH_FOLDER(survives_a_kill),
        WITH_FOLDER(refuses_another_body),  WITH_FOLDER(keeps_the_last_replies),
        WITH_FOLDER(bounds_the_log),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
