/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests local/ensemble.c, its parts between processes: an ensemble whose samples others solve is
 * the same to the byte, however they are cut, and what is no part of it is refused. */
#include <math.h>
#include <percuss/ensemble_share.h>
#include <percuss/local.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"

static struct percuss_client *open_client(void)
{
    struct percuss_local_config config = percuss_local_config_default();
    struct percuss_client *client;
    config.catalogue = PERCUSS_SOURCE_DIR "/config/catalogue.yaml";
    config.threads = 2;
    assert_int_equal(percuss_local_open(&config, &client), PERCUSS_RESULT_OK);
    return client;
}

/* A sphere on a rod at uncertain speeds; the caller frees it. */
static struct percuss_ensemble_request *make_request(struct percuss_client *client, uint64_t seed)
{
    struct percuss_body_list bodies;
    struct percuss_ensemble_request *request = malloc(sizeof *request);
    assert_non_null(request);
    assert_int_equal(percuss_bodies(client, 1.0, &bodies), PERCUSS_RESULT_OK);
    struct percuss_pair pair = percuss_pair_default(percuss_body_find(&bodies, "steel-sphere"),
                                                    percuss_body_find(&bodies, "al-beam"));
    pair.speed = 0.25;
    percuss_ensemble_request_init(request);
    assert_int_equal(percuss_contact_pair(&pair, &request->scene), PERCUSS_RESULT_OK);
    percuss_body_list_free(&bodies);
    request->input_count = 1;
    strcpy(request->inputs[0].name, "speed");
    request->inputs[0].distribution = PERCUSS_DISTRIBUTION_UNIFORM;
    request->inputs[0].first = 0.1;
    request->inputs[0].second = 0.4;
    request->inputs[0].lower = request->inputs[0].upper = NAN;
    request->samples = 600;
    request->seed = seed;
    request->list_samples = true;
    return request;
}

/* How the samples are cut and handed over. */
struct plan {
    struct percuss_ensemble_worker *worker;
    uint64_t cut;  /* items of a part */
    bool backward; /* the last part first */
    bool doubled;  /* every part twice */
    uint64_t lost; /* this part never comes; UINT64_MAX: all do */
    unsigned asked;
};

static void hand_over(struct plan *plan, struct percuss_ensemble_sharing *sharing,
                      const struct percuss_ensemble_range *range)
{
    size_t size = percuss_ensemble_part_size(range);
    char *part = malloc(size + 1);
    assert_non_null(part);
    /* octets come from a network: at any address */
    assert_int_equal(percuss_ensemble_worker_solve(plan->worker, range, part), PERCUSS_RESULT_OK);
    memmove(part + 1, part, size);
    /* where a single bit has changed on its way, it is another one */
    for (size_t at = 1; at <= size; at += size - 1) {
        part[at] ^= 1;
        assert_int_equal(percuss_ensemble_take(sharing, part + 1, size),
                         PERCUSS_RESULT_INVALID_ARGUMENT);
        part[at] ^= 1;
    }
    assert_non_null(strstr(percuss_error_text(), "damaged"));
    for (int i = 0; i < (plan->doubled ? 2 : 1); i++)
        assert_int_equal(percuss_ensemble_take(sharing, part + 1, size), PERCUSS_RESULT_OK);
    free(part);
}

static void share(void *context, struct percuss_ensemble_sharing *sharing,
                  const struct percuss_ensemble_range *range)
{
    struct plan *plan = context;
    uint64_t parts = (range->count + plan->cut - 1) / plan->cut;
    plan->asked++;
    for (uint64_t k = 0; k < parts; k++) {
        uint64_t part = plan->backward ? parts - 1 - k : k;
        struct percuss_ensemble_range piece = *range;
        piece.first += part * plan->cut;
        uint64_t left = range->first + range->count - piece.first;
        piece.count = left < plan->cut ? left : plan->cut;
        if (range->extras || part != plan->lost)
            hand_over(plan, sharing, &piece);
    }
}

/* Members that are not pointers, of what is told of the restitution and of every sample. */
static void check_same(const struct percuss_ensemble_reply *one,
                       const struct percuss_ensemble_reply *other)
{
    assert_int_equal(one->status, other->status);
    assert_int_equal(one->samples, other->samples);
    assert_int_equal(one->statistic_count, other->statistic_count);
    for (size_t i = 0; i < one->statistic_count; i++) {
        assert_memory_equal(&one->statistics[i].mean, &other->statistics[i].mean,
                            9 * sizeof(double));
        assert_memory_equal(one->statistics[i].quantiles, other->statistics[i].quantiles,
                            one->statistics[i].quantile_count * sizeof(double));
    }
    assert_memory_equal(&one->check, &other->check, sizeof one->check);
    assert_int_equal(one->warning_count, other->warning_count);
    for (size_t i = 0; i < one->warning_count; i++)
        assert_string_equal(one->warnings[i], other->warnings[i]);
    assert_int_equal(one->column_count, other->column_count);
    assert_memory_equal(one->rows, other->rows,
                        one->samples * one->column_count * sizeof *one->rows);
}

static void same_for_any_cut(void **state)
{
    static const struct plan plans[] = {
        {.cut = 1, .lost = UINT64_MAX},
        {.cut = 7, .backward = true, .lost = UINT64_MAX},
        {.cut = 1000000, .doubled = true, .lost = UINT64_MAX},
    };
    (void)state;
    struct percuss_client *client = open_client(), *other = open_client();
    struct percuss_ensemble_request *request = make_request(client, 7);
    struct percuss_ensemble_reply whole, shared;
    assert_int_equal(percuss_solve_ensemble(client, request, 60.0, NULL, NULL, &whole),
                     PERCUSS_RESULT_OK);
    assert_int_equal(whole.status, PERCUSS_OK);
    for (size_t i = 0; i < COUNT(plans); i++) {
        struct plan plan = plans[i];
        assert_int_equal(percuss_ensemble_worker_create(other, request, &plan.worker),
                         PERCUSS_RESULT_OK);
        assert_int_equal(
            percuss_solve_ensemble_shared(client, request, share, NULL, &plan, &shared),
            PERCUSS_RESULT_OK);
        check_same(&whole, &shared);
        /* samples, and what is solved beside them */
        assert_true(plan.asked >= 2);
        percuss_ensemble_reply_free(&shared);
        percuss_ensemble_worker_free(plan.worker);
    }
    percuss_ensemble_reply_free(&whole);
    free(request);
    percuss_client_free(other);
    percuss_client_free(client);
}

/* As where threads do: at the same numbers of samples. */
static void stops_where_one_process_does(void **state)
{
    (void)state;
    struct percuss_client *client = open_client();
    struct percuss_ensemble_request *request = make_request(client, 7);
    struct percuss_ensemble_reply whole, shared;
    struct plan plan = {.cut = 100, .lost = UINT64_MAX};
    request->samples = 20000;
    request->half_width = 0.02;
    assert_int_equal(percuss_solve_ensemble(client, request, 60.0, NULL, NULL, &whole),
                     PERCUSS_RESULT_OK);
    assert_int_equal(percuss_ensemble_worker_create(client, request, &plan.worker),
                     PERCUSS_RESULT_OK);
    assert_int_equal(percuss_solve_ensemble_shared(client, request, share, NULL, &plan, &shared),
                     PERCUSS_RESULT_OK);
    assert_true(whole.samples < 20000);
    check_same(&whole, &shared);
    percuss_ensemble_worker_free(plan.worker);
    percuss_ensemble_reply_free(&shared);
    percuss_ensemble_reply_free(&whole);
    free(request);
    percuss_client_free(client);
}

/* What comes before the lost part counts, and the message says that some are lost. */
static void a_lost_part_cuts_it_short(void **state)
{
    (void)state;
    struct percuss_client *client = open_client();
    struct percuss_ensemble_request *request = make_request(client, 7);
    struct percuss_ensemble_reply reply;
    struct plan plan = {.cut = 100, .lost = 3};
    assert_int_equal(percuss_ensemble_worker_create(client, request, &plan.worker),
                     PERCUSS_RESULT_OK);
    assert_int_equal(percuss_solve_ensemble_shared(client, request, share, NULL, &plan, &reply),
                     PERCUSS_RESULT_OK);
    assert_int_equal(reply.status, PERCUSS_TRUNCATED);
    assert_int_equal(reply.samples, 300);
    assert_non_null(strstr(reply.message, "samples were lost"));
    percuss_ensemble_worker_free(plan.worker);
    percuss_ensemble_reply_free(&reply);
    free(request);
    percuss_client_free(client);
}

/* Takes nothing that is not a part of it. */
static void share_wrongly(void *context, struct percuss_ensemble_sharing *sharing,
                          const struct percuss_ensemble_range *range)
{
    struct plan *plan = context;
    struct percuss_ensemble_range piece = *range;
    piece.count = 5;
    if (range->extras)
        return;
    size_t size = percuss_ensemble_part_size(&piece);
    char *part = malloc(size);
    assert_non_null(part);
    assert_int_equal(percuss_ensemble_worker_solve(plan->worker, &piece, part), PERCUSS_RESULT_OK);
    /* of another seed, as the worker is */
    assert_int_equal(percuss_ensemble_take(sharing, part, size), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_non_null(strstr(percuss_error_text(), "of another request"));
    /* cut, and nothing at all */
    assert_int_equal(percuss_ensemble_take(sharing, part, size - 1),
                     PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_int_equal(percuss_ensemble_take(sharing, part, 3), PERCUSS_RESULT_INVALID_ARGUMENT);
    part[0] ^= 1;
    assert_int_equal(percuss_ensemble_take(sharing, part, size), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_non_null(strstr(percuss_error_text(), "no part of an ensemble"));
    free(part);
    plan->asked++;
}

static void refuses_what_is_no_part(void **state)
{
    (void)state;
    struct percuss_client *client = open_client();
    struct percuss_ensemble_request *request = make_request(client, 7);
    struct percuss_ensemble_request *another = make_request(client, 8);
    struct percuss_ensemble_reply reply;
    struct plan plan = {0};
    assert_int_equal(percuss_ensemble_worker_create(client, another, &plan.worker),
                     PERCUSS_RESULT_OK);
    assert_int_equal(
        percuss_solve_ensemble_shared(client, request, share_wrongly, NULL, &plan, &reply),
        PERCUSS_RESULT_OK);
    assert_int_equal(plan.asked, 1);
    assert_int_not_equal(reply.status, PERCUSS_OK);
    percuss_ensemble_reply_free(&reply);
    /* nor are there samples beyond the last */
    struct percuss_ensemble_range range = {.first = 599, .count = 2};
    char part[1024];
    assert_int_equal(percuss_ensemble_worker_solve(plan.worker, &range, part),
                     PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_non_null(strstr(percuss_error_text(), "600 samples"));
    percuss_ensemble_worker_free(plan.worker);
    /* what is refused is refused at once */
    another->samples = 0;
    assert_int_equal(percuss_ensemble_worker_create(client, another, &plan.worker),
                     PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_null(plan.worker);
    free(another);
    free(request);
    percuss_client_free(client);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_for_any_cut),
        cmocka_unit_test(stops_where_one_process_does),
        cmocka_unit_test(a_lost_part_cuts_it_short),
        cmocka_unit_test(refuses_what_is_no_part),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
