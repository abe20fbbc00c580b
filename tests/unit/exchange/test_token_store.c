/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests endpoint/token_store.c: tokens by content, their bounds, and states in use. */
#include "sample.h"

#include <pthread.h>

#include "exchange/token_store.h"
#include "model/bar.h"

static const struct token_limits roomy = {100, 1 << 20, 60.0};
static const struct token_subject beam = {"r1", "beam"};

/* A state of two modes with this number in it. */
static struct body_state *state_of(double number)
{
    struct body_state *state = calloc(1, sizeof *state + 4 * sizeof(double));
    assert_non_null(state);
    state->count[BAR_LONGITUDINAL] = 2;
    state->coordinates[3] = number;
    return state;
}

static void put(struct token_store *store, const struct token_subject *subject, double number,
                double now, char token[PERCUSS_ID_SIZE])
{
    struct body_state *state = state_of(number);
    token_store_put(store, subject, state, now, token);
    free(state);
}

static void refused(struct token_store *store, const char *token,
                    const struct token_subject *subject, double now, const char *fragment)
{
    struct fault fault = {""};
    assert_null(token_store_hold(store, token, subject, now, &fault));
    if (!strstr(fault.text, fragment))
        fail_msg("\"%s\" does not say \"%s\"", fault.text, fragment);
}

static void gives_back_what_was_put(void **state)
{
    (void)state;
    char token[PERCUSS_ID_SIZE], again[PERCUSS_ID_SIZE], other[PERCUSS_ID_SIZE];
    struct token_store *store = token_store_create(&roomy);
    put(store, &beam, 1.5, 0.0, token);
    put(store, &beam, 1.5, 1.0, again);
    put(store, &beam, 2.5, 1.0, other);
    assert_int_equal(strlen(token), 32);
    assert_string_equal(token, again);
    assert_string_not_equal(token, other);
    assert_int_equal(token_store_count(store), 2);
    const struct body_state *held = token_store_hold(store, token, &beam, 2.0, NULL);
    assert_non_null(held);
    assert_int_equal(held->count[BAR_LONGITUDINAL], 2);
    assert_true(held->coordinates[3] == 1.5);
    token_store_release(store, held);
    token_store_free(store);
}

/* The same state of another body or catalogue is another one. */
static void keeps_bodies_and_revisions_apart(void **state)
{
    (void)state;
    const struct token_subject rod = {"r1", "rod"}, later = {"r2", "beam"};
    char token[PERCUSS_ID_SIZE], others[2][PERCUSS_ID_SIZE];
    struct token_store *store = token_store_create(&roomy);
    put(store, &beam, 1.5, 0.0, token);
    put(store, &rod, 1.5, 0.0, others[0]);
    put(store, &later, 1.5, 0.0, others[1]);
    assert_int_equal(token_store_count(store), 3);
    refused(store, token, &rod, 0.0, "is a state of beam: must be one of rod");
    refused(store, token, &later, 0.0, "belongs to catalogue revision r1");
    token_store_free(store);
}

static void refuses_what_is_no_token(void **state)
{
    (void)state;
    char token[PERCUSS_ID_SIZE];
    struct token_store *store = token_store_create(&roomy);
    put(store, &beam, 1.5, 0.0, token);
    static const char *const texts[] = {"x", "0123456789abcdef0123456789abcdef",
                                        "0123456789ABCDEF0123456789ABCDEF",
                                        "+123456789abcdef 123456789abcdef"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        refused(store, texts[i], &beam, 0.0, "must be a token of a recent reply");
    token[31] = '\0';
    refused(store, token, &beam, 0.0, "must be a token of a recent reply");
    token_store_free(store);
}

static void forgets_the_least_recently_used(void **state)
{
    (void)state;
    const struct token_limits few = {3, 1 << 20, 60.0};
    char tokens[4][PERCUSS_ID_SIZE];
    struct token_store *store = token_store_create(&few);
    for (int i = 0; i < 3; i++)
        put(store, &beam, i, i, tokens[i]);
    token_store_release(store, token_store_hold(store, tokens[0], &beam, 4.0, NULL));
    put(store, &beam, 3, 5.0, tokens[3]);
    assert_int_equal(token_store_count(store), 3);
    refused(store, tokens[1], &beam, 5.0, "not known (any more)");
    token_store_release(store, token_store_hold(store, tokens[0], &beam, 5.0, NULL));
    token_store_free(store);
}

static void forgets_what_is_too_much_memory(void **state)
{
    (void)state;
    const struct token_limits small = {100, 1000, 60.0};
    char token[PERCUSS_ID_SIZE];
    struct token_store *store = token_store_create(&small);
    for (int i = 0; i < 50; i++)
        put(store, &beam, i, 0.0, token);
    assert_in_range(token_store_count(store), 1, 5);
    token_store_release(store, token_store_hold(store, token, &beam, 0.0, NULL));
    token_store_free(store);
}

static void forgets_what_is_old(void **state)
{
    (void)state;
    char token[PERCUSS_ID_SIZE];
    struct token_store *store = token_store_create(&roomy);
    put(store, &beam, 1.0, 0.0, token);
    token_store_release(store, token_store_hold(store, token, &beam, 59.0, NULL));
    token_store_release(store, token_store_hold(store, token, &beam, 118.0, NULL));
    refused(store, token, &beam, 179.0, "not known (any more)");
    put(store, &beam, 1.0, 200.0, token);
    token_store_sweep(store, 261.0);
    assert_int_equal(token_store_count(store), 0);
    token_store_free(store);
}

/* A solve may go on with a state that has expired meanwhile. */
static void a_held_state_outlives_its_token(void **state)
{
    (void)state;
    const struct token_limits one = {1, 1 << 20, 60.0};
    char token[PERCUSS_ID_SIZE], other[PERCUSS_ID_SIZE];
    struct token_store *store = token_store_create(&one);
    put(store, &beam, 1.0, 0.0, token);
    const struct body_state *held = token_store_hold(store, token, &beam, 0.0, NULL);
    put(store, &beam, 2.0, 0.0, other);
    refused(store, token, &beam, 0.0, "not known (any more)");
    assert_true(held->coordinates[3] == 1.0);
    token_store_release(store, held);
    token_store_free(store);
}

static void *use(void *argument)
{
    struct token_store *store = argument;
    for (int i = 0; i < 3000; i++) {
        char token[PERCUSS_ID_SIZE];
        struct fault fault;
        put(store, &beam, i % 7, 0.0, token);
        const struct body_state *held = token_store_hold(store, token, &beam, 0.0, &fault);
        if (!held)
            continue;
        assert_true(held->coordinates[3] == i % 7);
        token_store_release(store, held);
    }
    return NULL;
}

static void serves_several_threads(void **state)
{
    (void)state;
    const struct token_limits few = {4, 1 << 20, 60.0};
    struct token_store *store = token_store_create(&few);
    pthread_t threads[4];
    for (int i = 0; i < 4; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, use, store), 0);
    for (int i = 0; i < 4; i++)
        pthread_join(threads[i], NULL);
    assert_in_range(token_store_count(store), 1, 4);
    token_store_free(store);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gives_back_what_was_put),
        cmocka_unit_test(keeps_bodies_and_revisions_apart),
        cmocka_unit_test(refuses_what_is_no_token),
        cmocka_unit_test(forgets_the_least_recently_used),
        cmocka_unit_test(forgets_what_is_too_much_memory),
        cmocka_unit_test(forgets_what_is_old),
        cmocka_unit_test(a_held_state_outlives_its_token),
        cmocka_unit_test(serves_several_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
