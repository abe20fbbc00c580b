/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests what endpoint/ makes of requests and results: all of it, or nothing and it says so. */
#include "endpoint/reply_bytes.h"
#include "exchange/batch.h"
#include "exchange/encode.h"
#include "exchange/question.h"
#include "exchange/reply_store.h"
#include "exchange/token_store.h"
#include "memory/failing.h"
#include "unit/exchange/sample.h"

static struct envelope envelope;
static struct solve_result *result;

static int make_result(void **state)
{
    (void)state;
    envelope = sample_envelope(42);
    result = sample_result(2, 3);
    return 0;
}

static int free_result(void **state)
{
    (void)state;
    free(result);
    return 0;
}

static bool encodes(void *context)
{
    (void)context;
    failing_begin();
    struct answer *answer = encode_result(&envelope, result, sample_tokens, 256);
    failing_end();
    bool whole =
        answer && answer->reply->states_after._length == 2 && answer->reply->warnings._length == 2;
    assert_int_equal(whole, answer != NULL);
    answer_release(answer);
    return whole;
}

static bool answers_a_batch(void *context)
{
    (void)context;
    failing_begin();
    struct answer *members[] = {batch_encode_member(&envelope, result, sample_tokens),
                                encode_refusal(&envelope, PERCUSS_BUSY, "later")};
    struct answer *answer = members[0] && members[1] ? batch_answer(&envelope, members, 2) : NULL;
    failing_end();
    assert_true(!answer || answer->member_count == 2);
    for (int i = 0; i < 2 && !answer; i++)
        answer_release(members[i]);
    answer_release(answer);
    return answer != NULL;
}

static bool copies_a_question(void *context)
{
    static struct sample sample;
    (void)context;
    sample_fill(&sample);
    failing_begin();
    percuss_v1_Request *copy = question_copy(&sample.wire, 1);
    failing_end();
    bool same =
        copy && question_digest_single(copy).first == question_digest_single(&sample.wire).first;
    assert_int_equal(same, copy != NULL);
    free(copy);
    return same;
}

/* Bytes that were kept are not called damaged for want of memory. */
static bool reads_bytes(void *context)
{
    (void)context;
    size_t size = 0;
    bool damaged = false;
    struct answer *answer = encode_result(&envelope, result, sample_tokens, 256), *read = NULL;
    failing_begin();
    void *bytes = reply_bytes_write(answer, &size);
    if (bytes)
        read = reply_bytes_read(bytes, size, &damaged);
    failing_end();
    assert_false(damaged);
    assert_true(!read || read->reply->sequence == 42);
    bool whole = read != NULL;
    answer_release(read);
    answer_release(answer);
    free(bytes);
    return whole;
}

/* A state gets a name and is found by it, or it is said to have none. */
static bool names_a_state(void *context)
{
    static const struct token_limits roomy = {100, 1 << 20, 60.0};
    static const struct token_subject beam = {"r1", "beam"};
    (void)context;
    struct body_state *state = calloc(1, sizeof *state + 4 * sizeof(double));
    state->count[0] = 2;
    char token[PERCUSS_ID_SIZE];
    failing_begin();
    struct token_store *store = token_store_create(&roomy);
    bool named = store && token_store_put(store, &beam, state, 0.0, token);
    failing_end();
    const struct body_state *held = named ? token_store_hold(store, token, &beam, 1.0, NULL) : NULL;
    assert_int_equal(held != NULL, named);
    if (held)
        token_store_release(store, held);
    token_store_free(store);
    free(state);
    return named;
}

/* A request is admitted and its reply kept, or it is turned away. */
static bool keeps_a_reply(void *context)
{
    static const struct reply_limits roomy = {8, 1 << 20, 4, 60.0};
    struct request_name name = {sample_client, EXCHANGE_SINGLE, 5};
    struct digest content = {1, 2};
    (void)context;
    struct answer *answer = encode_refusal(&envelope, PERCUSS_BAD_REQUEST, "why not"), *kept = NULL;
    failing_begin();
    struct reply_store *store = reply_store_create(&roomy);
    bool admitted = store && reply_store_admit(store, &name, content, 0.0, &kept) == ADMISSION_NEW;
    if (admitted)
        reply_store_keep(store, &name, answer);
    failing_end();
    if (admitted)
        assert_int_equal(reply_store_admit(store, &name, content, 0.0, &kept), ADMISSION_REPEATED);
    assert_ptr_equal(kept, admitted ? answer : NULL);
    answer_release(kept);
    answer_release(answer);
    reply_store_free(store);
    return admitted;
}

static void whole_or_nothing(void **state)
{
    (void)state;
    assert_true(fail_each("encode", encodes, NULL, 100) >= 1);
    assert_true(fail_each("batch", answers_a_batch, NULL, 100) >= 3);
    assert_true(fail_each("question", copies_a_question, NULL, 100) >= 1);
    assert_true(fail_each("bytes", reads_bytes, NULL, 100) >= 3);
}

static void stores_find_what_they_took(void **state)
{
    (void)state;
    assert_true(fail_each("tokens", names_a_state, NULL, 100) >= 3);
    assert_true(fail_each("replies", keeps_a_reply, NULL, 100) >= 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_or_nothing),
        cmocka_unit_test(stores_find_what_they_took),
    };
    return cmocka_run_group_tests(tests, make_result, free_result);
}
