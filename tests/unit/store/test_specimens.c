/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests store/specimens.c: what is committed is there after reopening, together or not at all;
 * whose specimen it is; how many replies are kept; files that are refused. */
#include <signal.h>
#include <sqlite3.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "check.h"
#include "store/database.h"
#include "store/specimens.h"

static char folder[64], path[128];

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/percuss-store-XXXXXX");
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/store.db", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    char name[160];
    const char *const ends[] = {"", "-wal", "-shm", "-journal"};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        snprintf(name, sizeof name, "%s%s", path, ends[i]);
        unlink(name);
    }
    return rmdir(folder);
}

static struct body rod(void)
{
    struct body body = {.kind = &rod_kind, .radius = 0.01, .length = 1.0, .tip_radius = INFINITY};
    strcpy(body.id, "rod");
    body.material = (struct material){"al", 70e9, 0.33, 2700.0, 205e6, 0.0};
    return body;
}

/* A state with `count` dents whose numbers all differ and fill the mantissa. */
static struct body_state *dented(size_t count, double seed)
{
    struct body_state sizes = {.dents = count};
    struct body_state *state = malloc(body_state_size(&sizes));
    *state = sizes;
    double *numbers = (double *)body_state_dents(state);
    for (size_t i = 0; i < 8 * count; i++)
        numbers[i] = sin(seed + (double)i) * 1e-5;
    return state;
}

static struct specimen_store *open_store(unsigned replies)
{
    struct fault fault;
    struct specimen_store *store;
    if (specimen_store_open(path, replies, &store, &fault))
        fail_msg("%s", fault.text);
    return store;
}

static void refuses_to_open(const char *expected)
{
    struct fault fault;
    struct specimen_store *store;
    assert_int_equal(specimen_store_open(path, 10, &store, &fault), PERCUSS_BAD_REQUEST);
    assert_null(store);
    if (!strstr(fault.text, expected))
        fail_msg("%s", fault.text);
}

static struct stored_reply reply_of(uint8_t client, uint64_t sequence, char *bytes)
{
    return (struct stored_reply){
        .client = {client},
        .sequence = sequence,
        .content = {sequence * 3, ~sequence},
        .size = strlen(bytes),
        .bytes = bytes,
    };
}

static enum percuss_status hit(struct specimen_store *store, const char *name,
                               const struct body_state *after, uint8_t client, uint64_t sequence)
{
    struct body body = rod();
    struct fault fault;
    char text[64];
    snprintf(text, sizeof text, "reply %u %llu", client, (unsigned long long)sequence);
    struct specimen_change change = {name, &body, after};
    struct stored_reply reply = reply_of(client, sequence, text);
    return specimen_store_commit(store, &change, 1, &reply, &fault);
}

static void has_dents(struct specimen_store *store, const char *name,
                      const struct body_state *expected)
{
    struct body body = rod();
    struct fault fault;
    struct body_state *state;
    if (specimen_store_load(store, name, &body, &state, &fault))
        fail_msg("%s", fault.text);
    if (expected && expected->dents) {
        assert_non_null(state);
        assert_memory_equal(state, expected, body_state_size(expected));
    } else {
        assert_null(state);
    }
    free(state);
}

/* "": there is none. */
static void finds(struct specimen_store *store, uint8_t client, uint64_t sequence,
                  const char *expected)
{
    struct fault fault;
    struct stored_reply reply = {.client = {client}, .sequence = sequence};
    assert_int_equal(specimen_store_find(store, &reply, &fault), PERCUSS_OK);
    if (*expected) {
        assert_int_equal(reply.size, strlen(expected));
        assert_memory_equal(reply.bytes, expected, reply.size);
        assert_true(reply.content[0] == sequence * 3 && reply.content[1] == ~sequence);
    } else {
        assert_null(reply.bytes);
    }
    free(reply.bytes);
}

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

static void execute(const char *text)
{
    sqlite3 *connection;
    assert_int_equal(sqlite3_open(path, &connection), SQLITE_OK);
    assert_int_equal(sqlite3_exec(connection, text, NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(connection);
}

static void refuses_other_files(void **state)
{
    (void)state;
    execute("CREATE TABLE theirs (x)");
    refuses_to_open("is a database of another program");
    unlink(path);
    FILE *file = fopen(path, "w");
    for (int i = 0; i < 1000; i++)
        fputs("no database ", file);
    fclose(file);
    refuses_to_open("store.db: cannot be used");
    unlink(path);
    specimen_store_close(open_store(10));
    execute("PRAGMA user_version = 4");
    refuses_to_open("is of version 4: must be of version 1 to 3");
}

static void refuses_a_damaged_file(void **state)
{
    (void)state;
    struct body_state *dents = dented(BODY_STATE_MAX_DENTS, 1.0);
    struct specimen_store *store = open_store(10);
    assert_int_equal(hit(store, "bar", dents, 1, 1), PERCUSS_OK);
    specimen_store_close(store);
    /* the second page and all that follow */
    FILE *file = fopen(path, "r+");
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    fseek(file, 4096, SEEK_SET);
    for (long i = 4096; i < size; i++)
        fputc(0xa5, file);
    fclose(file);
    refuses_to_open("is damaged");
    free(dents);
}

static void is_damaged(uint8_t client, uint64_t sequence)
{
    struct fault fault;
    struct stored_reply reply = {.client = {client}, .sequence = sequence};
    struct specimen_store *store = open_store(10);
    assert_int_equal(specimen_store_find(store, &reply, &fault), PERCUSS_INTERNAL);
    assert_null(reply.bytes);
    assert_true(reply.damaged);
    assert_non_null(strstr(fault.text, "request 1 is damaged: its size or checksum differs"));
    finds(store, 1, 2, "reply 1 2");
    specimen_store_close(store);
}

/* Whatever has changed in its row. */
static void tells_a_damaged_reply(void **state)
{
    (void)state;
    struct specimen_store *store = open_store(10);
    assert_int_equal(hit(store, "bar", NULL, 1, 1), PERCUSS_OK);
    assert_int_equal(hit(store, "bar", NULL, 1, 2), PERCUSS_OK);
    finds(store, 1, 1, "reply 1 1");
    specimen_store_close(store);
    execute("UPDATE replies SET reply = CAST('reply 1 0' AS BLOB) WHERE sequence = 1");
    is_damaged(1, 1);
    execute("UPDATE replies SET reply = CAST('reply 1 1 ' AS BLOB) WHERE sequence = 1");
    is_damaged(1, 1);
    execute("UPDATE replies SET reply = CAST('reply 1 1' AS BLOB), content = zeroblob(16)"
            " WHERE sequence = 1");
    is_damaged(1, 1);
    execute("UPDATE replies SET checksum = zeroblob(16) WHERE sequence = 1");
    is_damaged(1, 1);
    execute("UPDATE replies SET checksum = x'00' WHERE sequence = 1");
    is_damaged(1, 1);
    execute("UPDATE replies SET content = x'00' WHERE sequence = 1");
    is_damaged(1, 1);
    execute("UPDATE replies SET reply = x'' WHERE sequence = 1");
    is_damaged(1, 1);
}

/* Here for want of memory: says nothing of the reply, which is found when there is some. */
static void what_cannot_be_read_now_is_not_damaged(void **state)
{
    (void)state;
    struct fault fault;
    struct stored_reply reply = {.client = {1}, .sequence = 1};
    enum { LENGTH = 1 << 20 };
    char *text = malloc(LENGTH + 1);
    memset(text, 'x', LENGTH);
    text[LENGTH] = '\0';
    struct specimen_store *store = open_store(10);
    struct stored_reply kept = reply_of(1, 1, text);
    assert_int_equal(specimen_store_commit(store, NULL, 0, &kept, &fault), PERCUSS_OK);
    specimen_store_close(store);
    store = open_store(10);
    /* room for pages, not for the reply */
    sqlite3_hard_heap_limit64(sqlite3_memory_used() + LENGTH / 2);
    assert_int_equal(specimen_store_find(store, &reply, &fault), PERCUSS_INTERNAL);
    assert_null(reply.bytes);
    assert_false(reply.damaged);
    assert_non_null(strstr(fault.text, "stored replies: out of memory"));
    sqlite3_hard_heap_limit64(0);
    finds(store, 1, 1, text);
    specimen_store_close(store);
    free(text);
}

static void count_complaint(void *context, const char *problem)
{
    (void)problem;
    ++*(int *)context;
}

static int complaints(struct specimen_store *store)
{
    int count = 0;
    struct fault fault;
    struct audit audit = {.complain = count_complaint, .context = &count, .structure = true};
    assert_int_equal(specimen_store_audit(store, &audit, &fault), PERCUSS_OK);
    assert_int_equal(audit.damaged, count);
    return count;
}

/* Older versions had fewer checksums: what they kept is found, and has them from now on. */
static void brings_up_to_date(const char *back, int version)
{
    struct body_state *dents = dented(3, 2.0);
    struct specimen_store *store = open_store(3);
    for (uint64_t i = 1; i <= 5; i++)
        assert_int_equal(hit(store, "bar", dents, 1, i), PERCUSS_OK);
    assert_int_equal(hit(store, "smooth", NULL, 1, 6), PERCUSS_OK);
    specimen_store_close(store);
    execute(back);
    execute("ALTER TABLE specimens DROP COLUMN checksum; ALTER TABLE marks DROP COLUMN checksum");
    execute(version == 1 ? "PRAGMA user_version = 1" : "PRAGMA user_version = 2");
    store = open_store(3);
    finds(store, 1, 4, "reply 1 4");
    has_dents(store, "bar", dents);
    has_dents(store, "smooth", NULL);
    assert_int_equal(complaints(store), 0);
    assert_int_equal(hit(store, "bar", dents, 1, 7), PERCUSS_OK);
    specimen_store_close(store);
    /* which tell what is changed behind the store's back */
    execute("UPDATE replies SET reply = zeroblob(9) WHERE sequence = 5");
    execute("UPDATE dents SET residual = residual * 1.001 WHERE number = 2");
    execute("UPDATE marks SET sequence = 1");
    store = open_store(3);
    assert_int_equal(complaints(store), 3);
    specimen_store_close(store);
    free(dents);
}

static void brings_version_1_up_to_date(void **state)
{
    (void)state;
    brings_up_to_date("ALTER TABLE replies DROP COLUMN checksum", 1);
}

static void brings_version_2_up_to_date(void **state)
{
    (void)state;
    brings_up_to_date("", 2);
}

static void count_damaged(void *context, const struct specimen *specimen)
{
    *(int *)context += specimen->damaged;
    assert_true(!specimen->damaged || (strcmp(specimen->name, "bar") == 0 && !specimen->state));
}

#define OF_BAR "specimen = (SELECT id FROM specimens WHERE name = 'bar')"

/* A damaged specimen is refused, the others are not; cleared, it is as new. */
static void tells_a_damaged_specimen(void **state)
{
    static const char *const damages[] = {
        "UPDATE dents SET x = x + 1e-9 WHERE " OF_BAR " AND number = 1",
        "DELETE FROM dents WHERE " OF_BAR " AND number = 2",
        "UPDATE specimens SET impacts = 2 WHERE name = 'bar'",
        "UPDATE specimens SET nature = nature || ' ' WHERE name = 'bar'",
        "UPDATE specimens SET checksum = NULL WHERE name = 'bar'",
        "UPDATE specimens SET checksum = x'00' WHERE name = 'bar'",
    };
    struct body_state *dents = dented(3, 2.0), *loaded;
    struct body body = rod();
    struct fault fault;
    (void)state;
    for (size_t i = 0; i < COUNT(damages); i++) {
        struct specimen_store *store = open_store(10);
        assert_int_equal(hit(store, "bar", dents, 1, 2 * i + 1), PERCUSS_OK);
        assert_int_equal(hit(store, "other", dents, 1, 2 * i + 2), PERCUSS_OK);
        specimen_store_close(store);
        execute(damages[i]);
        store = open_store(10);
        assert_int_equal(complaints(store), 1);
        assert_int_equal(specimen_store_load(store, "bar", &body, &loaded, &fault),
                         PERCUSS_INTERNAL);
        assert_null(loaded);
        assert_non_null(strstr(fault.text, "bar: what the store holds of it is damaged"));
        has_dents(store, "other", dents);
        /* it is listed, and that it is damaged */
        int damaged = 0;
        assert_int_equal(specimen_store_visit(store, NULL, count_damaged, &damaged, &fault),
                         PERCUSS_OK);
        assert_int_equal(damaged, 1);
        assert_int_equal(specimen_store_clear(store, "bar", &fault), PERCUSS_OK);
        assert_int_equal(complaints(store), 0);
        has_dents(store, "bar", NULL);
        specimen_store_close(store);
    }
    free(dents);
}

/* Nobody knows which requests of its client were answered. */
static void a_damaged_mark_refuses(void **state)
{
    (void)state;
    struct fault fault;
    struct stored_reply reply = {.client = {1}, .sequence = 9};
    struct specimen_store *store = open_store(1);
    for (uint64_t i = 1; i <= 3; i++)
        assert_int_equal(hit(store, "bar", NULL, 1, i), PERCUSS_OK);
    specimen_store_close(store);
    execute("UPDATE marks SET sequence = 1");
    store = open_store(1);
    assert_int_equal(specimen_store_find(store, &reply, &fault), PERCUSS_INTERNAL);
    assert_false(reply.damaged);
    assert_non_null(strstr(fault.text, "the mark of a client is damaged"));
    reply.client[0] = 2;
    assert_int_equal(specimen_store_find(store, &reply, &fault), PERCUSS_OK);
    specimen_store_close(store);
}

static void refuses_a_second_process(void **state)
{
    (void)state;
    struct specimen_store *store = open_store(10);
    refuses_to_open("is in use by another process");
    specimen_store_close(store);
    specimen_store_close(open_store(10));
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(keeps_to_the_last_bit),
        WITH_FOLDER(survives_a_kill),
        WITH_FOLDER(refuses_another_body),
        WITH_FOLDER(keeps_the_last_replies),
        WITH_FOLDER(refuses_other_files),
        WITH_FOLDER(refuses_a_damaged_file),
        WITH_FOLDER(refuses_a_second_process),
        WITH_FOLDER(tells_a_damaged_reply),
        WITH_FOLDER(brings_version_1_up_to_date),
        WITH_FOLDER(brings_version_2_up_to_date),
        WITH_FOLDER(tells_a_damaged_specimen),
        WITH_FOLDER(a_damaged_mark_refuses),
        WITH_FOLDER(what_cannot_be_read_now_is_not_damaged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
