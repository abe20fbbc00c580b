/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/api and client/cli where memory runs out: a reply is handed over and printed whole,
 * or it is said that there is no memory. */
#include <jansson.h>
#include <string.h>

#include "convert.h"
#include "gather.h"
#include "memory/failing.h"
#include "reply_json.h"
#include "unit/client/wire_reply.h"

static bool converts_a_reply(void *context)
{
    percuss_v1_Reply wire = wire_reply();
    struct percuss_reply reply;
    (void)context;
    failing_begin();
    enum percuss_result result = convert_reply(&wire, &reply);
    failing_end();
    assert_true(result == PERCUSS_RESULT_OK || result == PERCUSS_RESULT_NO_MEMORY);
    assert_int_equal(reply.contact_count, result ? 0 : 2);
    if (!result)
        assert_int_equal(reply.warning_count, 2);
    percuss_reply_free(&reply);
    return !result;
}

/* A history that comes in parts. */
static bool gathers_a_trace(void *context)
{
    enum { PARTS = 3, INSTANTS = 500 };
    static double numbers[INSTANTS];
    struct gather *gather = context;
    struct percuss_trace trace;
    memset(gather, 0, sizeof *gather);
    failing_begin();
    for (uint32_t part = 0; part < PARTS; part++) {
        percuss_v1_Trace wire = {.contact = 0, .part = part, .parts = PARTS};
        FILL(wire.time, numbers);
        FILL(wire.force, numbers);
        FILL(wire.indentation, numbers);
        FILL(wire.gap, numbers);
        gather_add(gather, &wire);
    }
    assert_true(gather_is_complete(gather, 1));
    enum percuss_result result = gather_collect(gather, 1, &trace);
    failing_end();
    assert_true(result == PERCUSS_RESULT_OK || result == PERCUSS_RESULT_NO_MEMORY);
    assert_true(result || trace.contacts[0].count == (size_t)PARTS * INSTANTS);
    percuss_trace_free(&trace);
    gather_clear(gather);
    return !result;
}

static char *print(const struct percuss_reply *reply)
{
    json_t *root = reply_to_json(reply);
    char *text = json_text(root);
    json_decref(root);
    return text;
}

struct printing {
    struct percuss_reply reply;
    char *expected;
};

static bool prints_a_reply(void *context)
{
    const struct printing *printing = context;
    failing_begin();
    char *text = print(&printing->reply);
    failing_end();
    if (text && strcmp(text, printing->expected) != 0)
        fail_by_memory("the text is another one");
    bool whole = text != NULL;
    free(text);
    return whole;
}

static void replies(void **state)
{
    (void)state;
    assert_true(fail_each("reply", converts_a_reply, NULL, 100) >= 1);
}

static void histories(void **state)
{
    static struct gather gather;
    (void)state;
    /* room for all parts is taken with the first */
    assert_true(fail_each("history", gathers_a_trace, &gather, 100) >= 1);
}

static void json(void **state)
{
    percuss_v1_Reply wire = wire_reply();
    struct printing printing;
    (void)state;
    assert_int_equal(convert_reply(&wire, &printing.reply), PERCUSS_RESULT_OK);
    json_set_alloc_funcs(failing_malloc, failing_free);
    printing.expected = print(&printing.reply);
    assert_non_null(printing.expected);
    assert_true(fail_each("reply as JSON", prints_a_reply, &printing, 400) > 10);
    free(printing.expected);
    json_set_alloc_funcs(malloc, free);
    percuss_reply_free(&printing.reply);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(replies),
        cmocka_unit_test(histories),
        cmocka_unit_test(json),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
