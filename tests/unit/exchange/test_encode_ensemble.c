/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/exchange/encode_ensemble.c, and the copies and digests of ensembles in
 * question.c. */
#include <string.h>

#include "check.h"
#include "exchange/decode.h"
#include "exchange/encode_ensemble.h"
#include "exchange/question.h"

static const uint8_t octets[16] = {1, 2, 3};
static const struct envelope envelope = {octets, octets, 9, "revision", "version"};

/* The smallest report that has something everywhere. */
struct example {
    struct ensemble ensemble;
    struct ensemble_input input;
    struct solve_request request;
    struct ensemble_report report;
    double numbers[3];
    uint64_t counts[3];
    struct report_input inputs[1], tangential[1];
    struct influence_part parts[2];
};

static struct example *make(void)
{
    struct example *e = calloc(1, sizeof *e);
    assert_non_null(e);
    for (int i = 0; i < 3; i++) {
        e->numbers[i] = 0.1 * i;
        e->counts[i] = (uint64_t)i + 10;
    }
    e->report.quantity_count = REPORT_WITHOUT_FRICTION;
    for (int q = 0; q < REPORT_WITHOUT_FRICTION; q++)
        e->report.quantities[q] = (struct report_quantity){
            .name = "restitution",
            .moments = {.mean = 0.5 + q, .count = 7},
            .quantile_count = 2,
            .probabilities = e->numbers,
            .quantiles = e->numbers,
            .quantiles_low = e->numbers,
            .quantiles_high = e->numbers,
            .bins = 2,
            .edges = e->numbers,
            .counts = e->counts,
            .curve_count = 3,
            .curve_values = e->numbers,
            .curve_shares = e->numbers,
        };
    strcpy(e->request.bodies[1].id, "beam");
    e->request.body_count = 2;
    e->input = (struct ensemble_input){.quantity = INPUT_YOUNG, .body = 1};
    e->ensemble.spec.inputs = &e->input;
    e->ensemble.spec.input_count = 1;
    e->ensemble.spec.request = &e->request;
    e->ensemble.count = 20;
    e->parts[1].chaotic = true;
    e->inputs[0] = (struct report_input){.quantity = "restitution",
                                         .indices = {.first_order = 0.125,
                                                     .total = 0.25,
                                                     .first_bounds = {0.1, 0.2},
                                                     .total_bounds = {0.2, 0.3},
                                                     .noise = 0.01},
                                         .part_count = 2,
                                         .parts = e->parts};
    e->report.done = 7;
    e->report.count_length = 3;
    e->report.sub_impact_counts = e->report.significant_counts = e->counts;
    e->report.input_count = 1;
    e->report.inputs = e->inputs;
    e->tangential[0] = e->inputs[0];
    e->tangential[0].quantity = "impulse_tangential_1";
    e->report.tangential_count = 1;
    e->report.tangential = e->tangential;
    e->report.beta.alpha = 1.5;
    e->report.verification = (struct report_verification){
        .count = 5, .within = 0.8, .within_bounds = {0.4, 0.9}, .unmet = 2};
    e->report.warning_count = 1;
    strcpy(e->report.warnings[0], "a warning");
    return e;
}

static void encodes_all(void **state)
{
    (void)state;
    struct example *e = make();
    struct ensemble_ending ending = {PERCUSS_TRUNCATED, "cancelled"};
    struct answer *answer = encode_ensemble(&envelope, &e->ensemble, &e->report, &ending);
    assert_non_null(answer);
    const percuss_v1_EnsembleReply *reply = answer->report;
    assert_int_equal(reply->sequence, 9);
    assert_int_equal(reply->status, percuss_v1_STATUS_TRUNCATED);
    assert_string_equal(reply->message, "cancelled");
    assert_false(reply->complete);
    assert_int_equal(reply->samples, 7);
    assert_int_equal(reply->requested, 20);
    assert_int_equal(reply->statistics._length, 4);
    assert_true(reply->statistics._buffer[2].mean == 2.5);
    assert_int_equal(reply->statistics._buffer[0].bin_edges._length, 3);
    assert_int_equal(reply->statistics._buffer[0].bin_counts._buffer[1], 11);
    assert_int_equal(reply->sub_impact_counts._buffer[2], 12);
    assert_string_equal(reply->sensitivities._buffer[0].input, "young");
    assert_string_equal(reply->sensitivities._buffer[0].body, "beam");
    const percuss_v1_Sensitivity *sensitivity = &reply->sensitivities._buffer[0];
    assert_true(sensitivity->first_order == 0.125 && sensitivity->total == 0.25);
    assert_true(sensitivity->first_order_low == 0.1 && sensitivity->first_order_high == 0.2);
    assert_true(sensitivity->total_low == 0.2 && sensitivity->total_high == 0.3);
    assert_true(sensitivity->noise == 0.01);
    assert_true(sensitivity->parts._buffer[1].chaotic);
    assert_string_equal(sensitivity->quantity, "restitution");
    assert_int_equal(reply->tangential_sensitivities._length, 1);
    assert_string_equal(reply->tangential_sensitivities._buffer[0].quantity,
                        "impulse_tangential_1");
    assert_true(reply->tangential_sensitivities._buffer[0].parts._buffer[1].chaotic);
    assert_int_equal(reply->intervals._length, REPORT_INTERVALS);
    assert_true(reply->beta._buffer[0].alpha == 1.5);
    assert_int_equal(reply->check._buffer[0].count, 5);
    assert_true(reply->check._buffer[0].within == 0.8);
    assert_true(reply->check._buffer[0].within_low == 0.4);
    assert_true(reply->check._buffer[0].within_high == 0.9);
    assert_int_equal(reply->check._buffer[0].unmet, 2);
    assert_string_equal(reply->warnings._buffer[0], "a warning");
    answer_release(answer);
    free(e);
}

/* The lists of a copy are its own, and it is the same question. */
static void copies_are_deep(void **state)
{
    (void)state;
    double values[] = {0.1, 0.2}, quantile = 0.5;
    percuss_v1_EnsembleInput inputs[2] = {{.name = "speed"}, {.name = "site", .body = "beam"}};
    percuss_v1_EnsembleCorrelation pair = {0, 1, 0.3};
    percuss_v1_EnsembleRequest request = {.samples = 5, .seed = 3};
    inputs[0].values._buffer = values;
    inputs[0].values._length = 2;
    request.inputs._buffer = inputs;
    request.inputs._length = 2;
    request.correlations._buffer = &pair;
    request.correlations._length = 1;
    request.quantiles._buffer = &quantile;
    request.quantiles._length = 1;
    struct digest before = question_digest_ensemble(&request);
    percuss_v1_EnsembleRequest *copy = question_copy_ensemble(&request);
    assert_non_null(copy);
    values[1] = 9.0;
    pair.coefficient = 0.9;
    quantile = 0.1;
    strcpy(inputs[1].name, "yield");
    struct digest of_copy = question_digest_ensemble(copy);
    struct digest after = question_digest_ensemble(&request);
    assert_true(of_copy.first == before.first && of_copy.second == before.second);
    assert_true(after.first != before.first);
    free(copy);
}

/* Everything that changes the answer changes the digest. */
static void digests_tell_apart(void **state)
{
    (void)state;
    percuss_v1_EnsembleInput input = {.name = "speed"};
    percuss_v1_EnsembleRequest one = {.samples = 5, .inputs = {._buffer = &input, ._length = 1}};
    percuss_v1_EnsembleRequest others[7];
    for (int i = 0; i < 7; i++)
        others[i] = one;
    others[0].samples = 6;
    others[1].seed = 1;
    others[2].sampling = 1;
    others[3].half_width = 0.1;
    others[4].list_samples = true;
    others[5].bins = 3;
    others[6].contact = 1;
    struct digest digest = question_digest_ensemble(&one);
    for (int i = 0; i < 7; i++)
        assert_true(question_digest_ensemble(&others[i]).first != digest.first);
    input.upper = 1.0;
    assert_true(question_digest_ensemble(&one).first != digest.first);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(encodes_all),
        cmocka_unit_test(copies_are_deep),
        cmocka_unit_test(digests_tell_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
