/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/local: what is opened and refused, questions alone, outstanding, in batches and from
 * several threads, each answered to the same bits; given up by whoever watches. */

#include <percuss/local.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"

#define CATALOGUE PERCUSS_SOURCE_DIR "/config/catalogue.yaml"

enum { THREADS = 4 };

static struct percuss_client *open_client(void)
{
    struct percuss_client *client;
    struct percuss_local_config config = percuss_local_config_default();
    config.catalogue = CATALOGUE;
    if (percuss_local_open(&config, &client))
        fail_msg("%s", percuss_error_text());
    return client;
}

/* The steel sphere on a body of the catalogue. */
static struct percuss_request *question(struct percuss_client *client, const char *b, double speed)
{
    struct percuss_request *request = malloc(sizeof *request);
    struct percuss_body_list bodies;
    assert_non_null(request);
    assert_int_equal(percuss_bodies(client, 0.0, &bodies), PERCUSS_RESULT_OK);
    struct percuss_pair pair = percuss_pair_default(percuss_body_find(&bodies, "steel-sphere"),
                                                    percuss_body_find(&bodies, b));
    pair.speed = speed;
    assert_int_equal(percuss_contact_pair(&pair, request), PERCUSS_RESULT_OK);
    percuss_body_list_free(&bodies);
    return request;
}

/* Its restitution. */
static double solve(struct percuss_client *client, const struct percuss_request *request)
{
    struct percuss_reply reply;
    assert_int_equal(percuss_solve(client, request, 60.0, &reply), PERCUSS_RESULT_OK);
    assert_int_equal(reply.status, PERCUSS_OK);
    double restitution = reply.contacts[0].restitution;
    percuss_reply_free(&reply);
    return restitution;
}

static void test_what_is_wrong_is_named(void **state)
{
    struct percuss_client *client = (struct percuss_client *)&client;
    struct percuss_local_config config = percuss_local_config_default();
    (void)state;
    config.catalogue = "/no/catalogue.yaml";
    assert_int_equal(percuss_local_open(&config, &client), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_null(client);
    assert_non_null(strstr(percuss_error_text(), "catalogue.yaml"));
    config.settings = "/no/percussd.yaml";
    assert_int_equal(percuss_local_open(&config, &client), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_non_null(strstr(percuss_error_text(), "percussd.yaml"));
    config = percuss_local_config_default();
    config.first_sequence = 0;
    assert_int_equal(percuss_local_open(&config, &client), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_non_null(strstr(percuss_error_text(), "first_sequence"));
    percuss_client_free(client);
}

static void test_outstanding_questions_are_solved_by_who_waits(void **state)
{
    struct percuss_client *client = open_client();
    struct percuss_request *request = question(client, "al-beam", 0.3);
    struct percuss_reply reply;
    uint64_t first, second;
    double alone = solve(client, request);
    (void)state;
    assert_int_equal(percuss_submit(client, request, &first), PERCUSS_RESULT_OK);
    assert_int_equal(percuss_submit(client, request, &second), PERCUSS_RESULT_OK);
    assert_int_equal(second, first + 1);
    /* given up at once, it stays */
    assert_int_equal(percuss_wait(client, first, 0.0, &reply), PERCUSS_RESULT_TIMEOUT);
    assert_int_equal(percuss_wait(client, 0, 60.0, &reply), PERCUSS_RESULT_OK);
    assert_int_equal(reply.sequence, first);
    assert_true(reply.contacts[0].restitution == alone);
    percuss_reply_free(&reply);
    assert_int_equal(percuss_wait(client, first, 1.0, &reply), PERCUSS_RESULT_UNKNOWN_SEQUENCE);
    /* a look is enough */
    assert_int_equal(percuss_poll(client, second, &reply), PERCUSS_RESULT_OK);
    percuss_reply_free(&reply);
    assert_int_equal(percuss_wait(client, 0, 1.0, &reply), PERCUSS_RESULT_UNKNOWN_SEQUENCE);
    /* and what is forgotten is nobody's; what is left goes with the client */
    assert_int_equal(percuss_submit(client, request, &first), PERCUSS_RESULT_OK);
    assert_int_equal(percuss_cancel(client, first), PERCUSS_RESULT_OK);
    assert_int_equal(percuss_cancel(client, first), PERCUSS_RESULT_UNKNOWN_SEQUENCE);
    assert_int_equal(percuss_submit(client, request, NULL), PERCUSS_RESULT_OK);
    free(request);
    percuss_client_free(client);
}

static void test_a_batch_answers_as_single_questions_do(void **state)
{
    static const char *const BODIES[] = {"al-rod", "al-beam", "al-rod-1"};
    struct percuss_client *client = open_client();
    struct percuss_request *all = calloc(3, sizeof *all);
    struct percuss_reply replies[3];
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct percuss_request *one = question(client, BODIES[i], 0.2);
        all[i] = *one;
        free(one);
    }
    assert_int_equal(percuss_solve_batch(client, all, 3, 60.0, replies), PERCUSS_RESULT_OK);
    for (int i = 0; i < 3; i++) {
        assert_true(replies[i].contacts[0].restitution == solve(client, &all[i]));
        percuss_reply_free(&replies[i]);
    }
    assert_int_equal(percuss_solve_batch(client, all, 0, 60.0, replies),
                     PERCUSS_RESULT_INVALID_ARGUMENT);
    /* given up as a whole */
    assert_int_equal(percuss_solve_batch(client, all, 3, 0.0, replies), PERCUSS_RESULT_TIMEOUT);
    assert_int_equal(replies[0].contact_count, 0);
    free(all);
    percuss_client_free(client);
}

/* Has enough of it when it was asked so often. */
struct looker {
    int asked, most;
};

static bool look_on(void *context)
{
    struct looker *looker = context;
    return ++looker->asked < looker->most;
}

static void *solve_unwatched(void *client)
{
    struct percuss_request *request = question(client, "al-rod-1", 0.3);
    struct percuss_reply reply;
    /* longer than it takes to be asked, were it watched */
    request->options.contact_model = PERCUSS_CONTACT_COMPLETE_FE;
    request->options.tolerance = 1e-4;
    assert_int_equal(percuss_solve(client, request, 0.5, &reply), PERCUSS_RESULT_TIMEOUT);
    free(request);
    return NULL;
}

static void test_whoever_watches_gives_up_what_takes_long(void **state)
{
    struct percuss_client *client = open_client();
    struct percuss_request *request = question(client, "al-rod-1", 0.3);
    struct looker looker = {0, 3};
    struct percuss_reply reply;
    pthread_t thread;
    (void)state;
    request->options.contact_model = PERCUSS_CONTACT_COMPLETE_FE;
    request->options.tolerance = 1e-4;
    percuss_client_watch(client, look_on, &looker);
    assert_int_equal(percuss_solve(client, request, 600.0, &reply), PERCUSS_RESULT_CANCELLED);
    assert_int_equal(looker.asked, 3);
    assert_non_null(strstr(percuss_error_text(), "given up"));
    /* a batch as a whole; what was submitted stays */
    looker.asked = 0;
    assert_int_equal(percuss_solve_batch(client, request, 1, 600.0, &reply),
                     PERCUSS_RESULT_CANCELLED);
    looker.asked = 0;
    assert_int_equal(percuss_submit(client, request, NULL), PERCUSS_RESULT_OK);
    assert_int_equal(percuss_wait(client, 0, 600.0, &reply), PERCUSS_RESULT_CANCELLED);
    assert_int_equal(percuss_wait(client, 0, 0.0, &reply), PERCUSS_RESULT_TIMEOUT);
    /* not what another thread asks, nor anything once nobody watches */
    looker.asked = 0;
    assert_int_equal(pthread_create(&thread, NULL, solve_unwatched, client), 0);
    pthread_join(thread, NULL);
    percuss_client_watch(client, NULL, NULL);
    assert_int_equal(percuss_solve(client, request, 0.5, &reply), PERCUSS_RESULT_TIMEOUT);
    assert_int_equal(looker.asked, 0);
    free(request);
    percuss_client_free(client);
}

static void test_a_state_is_the_same_for_whoever_names_it(void **state)
{
    struct percuss_client *one = open_client(), *other = open_client();
    struct percuss_request *request = question(one, "al-beam", 0.2);
    struct percuss_reply reply;
    (void)state;
    assert_int_equal(percuss_solve(one, request, 60.0, &reply), PERCUSS_RESULT_OK);
    strcpy(request->bodies[1].state, reply.states_after[1].state);
    percuss_reply_free(&reply);
    /* the ringing beam answers otherwise; another client does not know it */
    double ringing = solve(one, request);
    assert_true(ringing == solve(one, request));
    assert_int_equal(percuss_solve(other, request, 60.0, &reply), PERCUSS_RESULT_OK);
    assert_int_equal(reply.status, PERCUSS_UNKNOWN_STATE);
    percuss_reply_free(&reply);
    request->bodies[1].state[0] = '\0';
    assert_true(ringing != solve(one, request));
    free(request);
    percuss_client_free(one);
    percuss_client_free(other);
}

struct work {
    struct percuss_client *client;
    const struct percuss_request *request;
    double restitution;
};

static void *ask_often(void *context)
{
    struct work *work = context;
    struct percuss_reply reply;
    for (int i = 0; i < 20; i++) {
        if (percuss_solve(work->client, work->request, 60.0, &reply))
            return NULL;
        work->restitution = reply.contacts[0].restitution;
        percuss_reply_free(&reply);
    }
    return work;
}

static void test_threads_share_a_client(void **state)
{
    struct percuss_client *client = open_client();
    struct percuss_request *request = question(client, "al-beam", 0.3);
    struct work work[THREADS];
    pthread_t threads[THREADS];
    double alone = solve(client, request);
    (void)state;
    for (int i = 0; i < THREADS; i++) {
        work[i] = (struct work){client, request, 0.0};
        assert_int_equal(pthread_create(&threads[i], NULL, ask_often, &work[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        void *done;
        assert_int_equal(pthread_join(threads[i], &done), 0);
        assert_non_null(done);
        assert_true(work[i].restitution == alone);
    }
    free(request);
    percuss_client_free(client);
}

static bool cancel(void *context, const struct percuss_ensemble_progress *progress)
{
    *(unsigned *)context += 1;
    return progress->done == 0;
}

static void test_an_ensemble_is_cancelled(void **state)
{
    struct percuss_client *client = open_client();
    struct percuss_ensemble_request *ensemble = malloc(sizeof *ensemble);
    struct percuss_request *scene = question(client, "al-beam", 0.3);
    struct percuss_ensemble_reply reply;
    unsigned told = 0;
    (void)state;
    assert_non_null(ensemble);
    percuss_ensemble_request_init(ensemble);
    ensemble->scene = *scene;
    ensemble->samples = 1000000;
    ensemble->input_count = 1;
    ensemble->inputs[0] = (struct percuss_input){.name = "speed",
                                                 .distribution = PERCUSS_DISTRIBUTION_UNIFORM,
                                                 .first = 0.1,
                                                 .second = 0.4,
                                                 .lower = NAN,
                                                 .upper = NAN};
    assert_int_equal(percuss_solve_ensemble(client, ensemble, 60.0, cancel, &told, &reply),
                     PERCUSS_RESULT_OK);
    assert_int_equal(reply.status, PERCUSS_TRUNCATED);
    assert_true(told > 0 && reply.samples > 0 && reply.samples < 1000000);
    percuss_ensemble_reply_free(&reply);
    free(scene);
    free(ensemble);
    percuss_client_free(client);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_wrong_is_named),
        cmocka_unit_test(test_outstanding_questions_are_solved_by_who_waits),
        cmocka_unit_test(test_whoever_watches_gives_up_what_takes_long),
        cmocka_unit_test(test_a_batch_answers_as_single_questions_do),
        cmocka_unit_test(test_a_state_is_the_same_for_whoever_names_it),
        cmocka_unit_test(test_threads_share_a_client),
        cmocka_unit_test(test_an_ensemble_is_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
