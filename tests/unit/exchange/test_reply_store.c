/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests endpoint/reply_store.c: repeated requests, misused numbers, and what is forgotten when. */
#include "sample.h"

#include "exchange/encode.h"
#include "exchange/reply_store.h"

static const struct reply_limits roomy = {8, 1 << 20, 4, 60.0};
static const struct digest this_content = {1, 2}, other_content = {1, 3};

static struct request_name name_of(const uint8_t *client, uint64_t sequence)
{
    return (struct request_name){client, EXCHANGE_SINGLE, sequence};
}

static enum admission admit(struct reply_store *store, const uint8_t *client, uint64_t sequence,
                            struct digest content, double now)
{
    struct answer *answer;
    struct request_name name = name_of(client, sequence);
    enum admission admission = reply_store_admit(store, &name, content, now, &answer);
    assert_int_equal(answer != NULL, admission == ADMISSION_REPEATED);
    answer_release(answer);
    return admission;
}

static void keep(struct reply_store *store, const uint8_t *client, uint64_t sequence)
{
    struct request_name name = name_of(client, sequence);
    struct envelope envelope = sample_envelope(sequence);
    struct answer *answer = encode_refusal(&envelope, PERCUSS_BAD_REQUEST, "why not");
    reply_store_keep(store, &name, answer);
    answer_release(answer);
}

static void repeats_the_very_reply(void **state)
{
    (void)state;
    struct reply_store *store = reply_store_create(&roomy);
    struct request_name name = name_of(sample_client, 5);
    struct envelope envelope = sample_envelope(5);
    struct answer *answer = encode_refusal(&envelope, PERCUSS_BAD_REQUEST, "why not"), *stored;
    assert_int_equal(admit(store, sample_client, 5, this_content, 0.0), ADMISSION_NEW);
    assert_int_equal(admit(store, sample_client, 5, this_content, 0.0), ADMISSION_PENDING);
    reply_store_keep(store, &name, answer);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(reply_store_admit(store, &name, this_content, 0.0, &stored),
                         ADMISSION_REPEATED);
        assert_ptr_equal(stored, answer);
        answer_release(stored);
    }
    answer_release(answer);
    reply_store_free(store);
}

static void tells_other_content_under_the_same_number(void **state)
{
    (void)state;
    struct reply_store *store = reply_store_create(&roomy);
    assert_int_equal(admit(store, sample_client, 5, this_content, 0.0), ADMISSION_NEW);
    assert_int_equal(admit(store, sample_client, 5, other_content, 0.0), ADMISSION_CONFLICT);
    keep(store, sample_client, 5);
    assert_int_equal(admit(store, sample_client, 5, other_content, 0.0), ADMISSION_CONFLICT);
    assert_int_equal(admit(store, sample_client, 5, this_content, 0.0), ADMISSION_REPEATED);
    reply_store_free(store);
}

static void keeps_clients_and_topics_apart(void **state)
{
    (void)state;
    struct answer *answer;
    struct reply_store *store = reply_store_create(&roomy);
    struct request_name batch = {sample_client, EXCHANGE_BATCH, 5};
    assert_int_equal(admit(store, sample_client, 5, this_content, 0.0), ADMISSION_NEW);
    assert_int_equal(admit(store, sample_server, 5, other_content, 0.0), ADMISSION_NEW);
    assert_int_equal(reply_store_admit(store, &batch, other_content, 0.0, &answer), ADMISSION_NEW);
    assert_int_equal(reply_store_clients(store), 2);
    reply_store_free(store);
}

static void a_forgotten_request_may_be_asked_again(void **state)
{
    (void)state;
    struct reply_store *store = reply_store_create(&roomy);
    struct request_name name = name_of(sample_client, 5);
    assert_int_equal(admit(store, sample_client, 5, this_content, 0.0), ADMISSION_NEW);
    reply_store_forget(store, &name);
    assert_int_equal(admit(store, sample_client, 5, this_content, 0.0), ADMISSION_NEW);
    keep(store, sample_client, 5);
    reply_store_forget(store, &name);
    assert_int_equal(admit(store, sample_client, 5, this_content, 0.0), ADMISSION_REPEATED);
    reply_store_free(store);
}

static void keeps_the_last_ones_of_each_client(void **state)
{
    (void)state;
    struct reply_store *store = reply_store_create(&roomy);
    assert_int_equal(admit(store, sample_server, 1, this_content, 0.0), ADMISSION_NEW);
    keep(store, sample_server, 1);
    /* numbers in any order */
    for (uint64_t i = 0; i < 20; i++) {
        assert_int_equal(admit(store, sample_client, i * 7919 % 101, this_content, 0.0),
                         ADMISSION_NEW);
        keep(store, sample_client, i * 7919 % 101);
    }
    for (uint64_t i = 12; i < 20; i++)
        assert_int_equal(admit(store, sample_client, i * 7919 % 101, this_content, 0.0),
                         ADMISSION_REPEATED);
    assert_int_equal(admit(store, sample_server, 1, this_content, 0.0), ADMISSION_REPEATED);
    assert_int_equal(admit(store, sample_client, 11 * 7919 % 101, this_content, 0.0),
                     ADMISSION_NEW);
    reply_store_free(store);
}

static void stays_within_its_memory(void **state)
{
    (void)state;
    const struct reply_limits small = {1024, 20000, 4, 60.0};
    struct reply_store *store = reply_store_create(&small);
    for (uint64_t i = 1; i <= 100; i++) {
        assert_int_equal(admit(store, sample_client, i, this_content, 0.0), ADMISSION_NEW);
        keep(store, sample_client, i);
        assert_in_range(reply_store_bytes(store), 0, 20000);
    }
    assert_int_equal(admit(store, sample_client, 100, this_content, 0.0), ADMISSION_REPEATED);
    reply_store_free(store);
}

static void forgets_clients_gone_too_long(void **state)
{
    (void)state;
    struct reply_store *store = reply_store_create(&roomy);
    reply_store_set_present(store, sample_client, true, 0.0);
    admit(store, sample_client, 1, this_content, 0.0);
    keep(store, sample_client, 1);
    admit(store, sample_server, 1, this_content, 0.0);
    /* one is there and silent, the other has never been seen to read */
    reply_store_sweep(store, 61.0);
    assert_int_equal(reply_store_clients(store), 1);
    reply_store_set_present(store, sample_client, false, 100.0);
    reply_store_sweep(store, 159.0);
    assert_int_equal(admit(store, sample_client, 1, this_content, 159.0), ADMISSION_REPEATED);
    reply_store_sweep(store, 220.0);
    assert_int_equal(reply_store_clients(store), 0);
    assert_int_equal(reply_store_bytes(store), 0);
    reply_store_free(store);
}

/* Gone is who was there: of a client never seen to read, the reader may just not be known yet. */
static void knows_who_has_gone(void **state)
{
    (void)state;
    struct reply_store *store = reply_store_create(&roomy);
    assert_false(reply_store_is_gone(store, sample_client));
    admit(store, sample_client, 1, this_content, 0.0);
    assert_false(reply_store_is_gone(store, sample_client));
    reply_store_set_present(store, sample_client, true, 0.0);
    reply_store_set_present(store, sample_client, true, 0.0);
    reply_store_set_present(store, sample_client, false, 0.0);
    assert_false(reply_store_is_gone(store, sample_client));
    reply_store_set_present(store, sample_client, false, 0.0);
    assert_true(reply_store_is_gone(store, sample_client));
    reply_store_set_present(store, sample_client, true, 0.0);
    assert_false(reply_store_is_gone(store, sample_client));
    reply_store_free(store);
}

static void remembers_a_bounded_number_of_clients(void **state)
{
    (void)state;
    struct reply_store *store = reply_store_create(&roomy);
    for (uint8_t i = 1; i < 100; i++) {
        const uint8_t client[16] = {i};
        assert_int_equal(admit(store, client, 1, this_content, i * 1e-3), ADMISSION_NEW);
        assert_in_range(reply_store_clients(store), 1, 4);
    }
    reply_store_free(store);
}

/* The reply comes after its place has been given away: it is simply not kept. */
static void an_answer_may_come_too_late(void **state)
{
    (void)state;
    struct reply_store *store = reply_store_create(&roomy);
    for (uint64_t i = 1; i <= 20; i++)
        admit(store, sample_client, i, this_content, 0.0);
    keep(store, sample_client, 1);
    assert_int_equal(admit(store, sample_client, 1, this_content, 0.0), ADMISSION_NEW);
    reply_store_free(store);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(repeats_the_very_reply),
        cmocka_unit_test(tells_other_content_under_the_same_number),
        cmocka_unit_test(keeps_clients_and_topics_apart),
        cmocka_unit_test(a_forgotten_request_may_be_asked_again),
        cmocka_unit_test(keeps_the_last_ones_of_each_client),
        cmocka_unit_test(stays_within_its_memory),
        cmocka_unit_test(forgets_clients_gone_too_long),
        cmocka_unit_test(knows_who_has_gone),
        cmocka_unit_test(remembers_a_bounded_number_of_clients),
        cmocka_unit_test(an_answer_may_come_too_late),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
