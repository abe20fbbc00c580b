/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests catalogue/ and store/, with SQLite and the writer of JSON asking the same memory: what is
 * read is whole, what is written too, and files are not called bad for want of memory. (The reader
 * of jansson 2.14 loses letters then, and says so of none.) */
#include <jansson.h>
#include <malloc.h>
#include <sqlite3.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "catalogue/catalogue.h"
#include "memory/failing.h"
#include "store/specimens.h"
#include "store/table_file.h"
#include "store/table_store.h"
#include "unit/store/small_table.h"

static char folder[] = "/tmp/percuss-memory-XXXXXX";
static char path[64];

/* What SQLite wants to know besides. */
static void *sqlite_malloc(int size)
{
    return failing_malloc((size_t)size);
}

static void *sqlite_realloc(void *old, int size)
{
    return failing_realloc(old, (size_t)size);
}

static int sqlite_size(void *piece)
{
    return piece ? (int)malloc_usable_size(piece) : 0;
}

static int sqlite_round_up(int size)
{
    return (size + 15) & ~15;
}

static int nothing(void *context)
{
    (void)context;
    return SQLITE_OK;
}

static void nothing_more(void *context)
{
    (void)context;
}

static int prepare(void **state)
{
    static sqlite3_mem_methods methods = {
        sqlite_malloc,   failing_free, sqlite_realloc, sqlite_size,
        sqlite_round_up, nothing,      nothing_more,   NULL};
    assert_int_equal(sqlite3_config(SQLITE_CONFIG_MALLOC, &methods), SQLITE_OK);
    assert_int_equal(sqlite3_initialize(), SQLITE_OK);
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/store.db", folder);
    return make_small_table(state);
}

static int clean(void **state)
{
    const char *const ends[] = {"", "-wal", "-shm", "-journal"};
    for (size_t i = 0; i < COUNT(ends); i++) {
        char name[80];
        snprintf(name, sizeof name, "%s%s", path, ends[i]);
        unlink(name);
    }
    rmdir(folder);
    return free_small_table(state);
}

static bool loads_the_catalogue(void *context)
{
    (void)context;
    struct body_set *set;
    struct fault fault = {""};
    failing_begin();
    enum percuss_status status =
        catalogue_load(PERCUSS_SOURCE_DIR "/config/catalogue.yaml", &set, &fault);
    bool whole = !is_out_of_memory(status, fault.text);
    assert_int_equal(set != NULL, whole);
    body_set_free(set);
    return whole;
}

/* A catalogue with friction. */
static bool loads_friction(void *context)
{
    (void)context;
    static const char text[] = "materials: {m: {young: 1e9, poisson: 0.3, density: 1}}\n"
                               "bodies: {w: {shape: half-space, material: m}}\n"
                               "friction: [{between: [m, m], coefficient: 0.2}]\n";
    struct body_set *set;
    struct fault fault = {""};
    failing_begin();
    enum percuss_status status = catalogue_parse(text, sizeof text - 1, "f.yaml", &set, &fault);
    bool whole = !is_out_of_memory(status, fault.text);
    assert_int_equal(set != NULL, whole);
    assert_true(!whole || set->friction_count == 1);
    body_set_free(set);
    return whole;
}

/* Dents go into the store and come out again with their reply, or nothing has changed. */
static bool keeps_a_dent(void *context)
{
    (void)context;
    struct fault fault = {""};
    struct specimen_store *store;
    struct body_state *state = calloc(1, sizeof *state + sizeof(struct dent)), *loaded = NULL;
    state->dents = 1;
    struct body body = {.id = "rod", .kind = &rod_kind, .radius = 0.01, .length = 1.0};
    struct specimen_change change = {"one", &body, state};
    static uint64_t sequence;
    struct stored_reply reply = {
        .client = {7}, .sequence = ++sequence, .size = 5, .bytes = "reply"};
    struct stored_reply found = {.client = {7}, .sequence = sequence};
    failing_begin();
    enum percuss_status status = specimen_store_open(path, 10, &store, &fault);
    if (!status)
        status = specimen_store_commit(store, &change, 1, &reply, &fault);
    bool committed = !status;
    if (!status)
        status = specimen_store_load(store, "one", &body, &loaded, &fault);
    if (!status)
        status = specimen_store_find(store, &found, &fault);
    failing_end();
    if (!committed && store) {
        struct fault unread;
        assert_int_equal(specimen_store_find(store, &found, &unread), PERCUSS_OK);
        assert_null(found.bytes);
    }
    bool whole = !is_out_of_memory(status, fault.text);
    assert_true(!whole || (loaded && loaded->dents == 1 && found.size == 5));
    free(found.bytes);
    free(loaded);
    free(state);
    specimen_store_close(store);
    return whole;
}

static void complain(const struct fault *fault)
{
    is_out_of_memory(PERCUSS_INTERNAL, fault->text);
    failing_begin();
}

/* Tables that are left out for want of memory are complained about for that. */
static bool loads_tables(void *context)
{
    (void)context;
    struct fault fault = {""};
    size_t count = 0;
    failing_begin();
    struct table_store *store = table_store_create();
    enum percuss_status status =
        store
            ? table_store_load(store, PERCUSS_SOURCE_DIR "/config/tables", complain, &count, &fault)
            : PERCUSS_OK;
    bool whole = !is_out_of_memory(status, fault.text) && count == 2;
    table_store_free(store);
    return whole;
}

static bool writes_a_table(void *context)
{
    static const struct table_origin origin = {"test 1", 3.0};
    const char *expected = context;
    failing_begin();
    char *text = table_json_write(&small_table, &origin);
    failing_end();
    if (text && expected && strcmp(text, expected) != 0)
        fail_by_memory("the text is another one");
    bool whole = text != NULL;
    free(text);
    return whole;
}

static void a_catalogue(void **state)
{
    (void)state;
    assert_true(fail_each("catalogue", loads_the_catalogue, NULL, 100) > 3);
    assert_true(fail_each("friction", loads_friction, NULL, 100) > 3);
}

static void specimens(void **state)
{
    (void)state;
    assert_true(fail_each("specimens", keeps_a_dent, NULL, 100) > 10);
}

static void tables(void **state)
{
    (void)state;
    assert_true(fail_each("tables", loads_tables, NULL, 10) > 10);
}

static void a_table_as_text(void **state)
{
    (void)state;
    static const struct table_origin origin = {"test 1", 3.0};
    char *text = table_json_write(&small_table, &origin);
    json_set_alloc_funcs(failing_malloc, failing_free);
    assert_true(fail_each("table as text", writes_a_table, text, 100) > 10);
    json_set_alloc_funcs(malloc, free);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_catalogue),
        cmocka_unit_test(specimens),
        cmocka_unit_test(tables),
        cmocka_unit_test(a_table_as_text),
    };
    return cmocka_run_group_tests(tests, prepare, clean);
}
