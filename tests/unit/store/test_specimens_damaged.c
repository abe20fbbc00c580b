/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests store/specimens.c beside test_specimens.c: files that are refused, older versions, what is
 * damaged behind the store's back. */
#include <sqlite3.h>

#include "store/database.h"
#include "unit/store/specimen_lab.h"

static void refuses_to_open(const char *expected)
{
    struct fault fault;
    struct specimen_store *store;
    assert_int_equal(specimen_store_open(path, 10, &store, &fault), PERCUSS_BAD_REQUEST);
    assert_null(store);
    if (!strstr(fault.text, expected))
        fail_msg("%s", fault.text);
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

static void refuses_a_second_process(void **state)
{
    (void)state;
    struct specimen_store *store = open_store(10);
    refuses_to_open("is in use by another process");
    specimen_store_close(store);
    specimen_store_close(open_store(10));
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

int main(void)
{
    const struct CMUnitTest tests[] = {
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
