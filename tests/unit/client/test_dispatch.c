/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/api/dispatch.c: the public functions serve a client that another library has made,
 * and tell what it says. */

#include <percuss/percuss.h>

#include "check.h"
#include "operations.h"

struct percuss_client {
    const struct client_operations *operations;
    int asked;
};

static const char *say(void)
{
    return "words of another library";
}

static enum percuss_result answer(struct percuss_client *client,
                                  const struct percuss_request *request, double timeout,
                                  struct percuss_reply *reply)
{
    assert_non_null(request);
    assert_true(timeout == 2.5);
    reply->status = PERCUSS_BUSY;
    client->asked++;
    return PERCUSS_RESULT_OK;
}

static enum percuss_result refuse(struct percuss_client *client, uint64_t sequence, double timeout,
                                struct percuss_reply *reply)
{
    (void)client, (void)timeout, (void)reply;
    return sequence == 7 ? PERCUSS_RESULT_UNKNOWN_SEQUENCE : PERCUSS_RESULT_NO_MEMORY;
}

static const struct client_operations OTHERS = {.error_text = say, .solve = answer, .wait = refuse};

static void test_a_client_of_another_library_is_asked(void **state)
{
    struct percuss_client client = {.operations = &OTHERS};
    struct percuss_reply reply = {.status = PERCUSS_OK};
    static struct percuss_request request;
    (void)state;
    assert_int_equal(percuss_solve(&client, &request, 2.5, &reply), PERCUSS_RESULT_OK);
    assert_int_equal(reply.status, PERCUSS_BUSY);
    assert_int_equal(client.asked, 1);
}

static void test_its_words_are_told_once(void **state)
{
    struct percuss_client client = {.operations = &OTHERS};
    struct percuss_reply reply;
    (void)state;
    assert_int_equal(percuss_wait(&client, 7, 0.0, &reply), PERCUSS_RESULT_UNKNOWN_SEQUENCE);
    assert_string_equal(percuss_error_text(), "words of another library");
    /* as they are: a library begins that of NO_MEMORY itself */
    assert_int_equal(percuss_wait(&client, 8, 0.0, &reply), PERCUSS_RESULT_NO_MEMORY);
    assert_string_equal(percuss_error_text(), "words of another library");
    percuss_client_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_client_of_another_library_is_asked),
        cmocka_unit_test(test_its_words_are_told_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
