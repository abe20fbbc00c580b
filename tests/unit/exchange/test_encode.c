/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests endpoint/encode.c, batch.c and answer.c: replies with results, refusals, and the parts of a
 * batch against what they really take serialised. */
#include "sample.h"

#include <dds/ddsi/ddsi_cdrstream.h>
#include <math.h>

#include "exchange/batch.h"
#include "exchange/encode.h"
#include "impact/trace.h"

static void copies_a_result(void **state)
{
    (void)state;
    struct envelope envelope = sample_envelope(42);
    struct solve_result *result = sample_result(2, 3);
    struct answer *answer = encode_result(&envelope, result, sample_tokens, 256);
    const percuss_v1_Reply *reply = answer->reply;
    assert_memory_equal(reply->client, sample_client, 16);
    assert_memory_equal(reply->server, sample_server, 16);
    assert_true(reply->sequence == 42);
    assert_string_equal(reply->catalogue_revision, "revision");
    assert_string_equal(reply->version, "1.2.3");
    assert_int_equal(reply->status, PERCUSS_OK);
    assert_int_equal(reply->contacts._length, 2);
    assert_true(reply->contacts._buffer[1].impulse == 2.0);
    assert_int_equal(reply->contacts._buffer[1].sub_impact_count, 1003);
    assert_int_equal(reply->contacts._buffer[1].sub_impacts._length, 3);
    assert_true(reply->contacts._buffer[1].sub_impacts._buffer[2].start == 2.0);
    assert_int_equal(reply->velocity_after._length, 2);
    assert_true(reply->velocity_after._buffer[1].velocity[0] == 1.0);
    assert_string_equal(reply->states_after._buffer[0].state, sample_tokens[0]);
    assert_string_equal(reply->states_after._buffer[1].state, "");
    assert_true(reply->energy.vibration._buffer[1].energy == 0.125);
    assert_string_equal(reply->model.bodies._buffer[0].theory, "euler-bernoulli");
    assert_string_equal(reply->warnings._buffer[1], "mind the step");
    assert_true(reply->energy.available == 4.0 && reply->energy.friction == 0.25);
    const percuss_v1_ContactResult *contact = &reply->contacts._buffer[1];
    const percuss_v1_SubImpact *sub = &contact->sub_impacts._buffer[2];
    assert_true(contact->friction == 0.3 && contact->tangent[2] == 1.0);
    assert_true(contact->impulse_tangential[0] == -4.0 && contact->impulse_tangential[1] == 5.0);
    assert_true(contact->impulse_tangential_error == 6.0);
    assert_true(contact->slip_before[0] == 7.0 && isnan(contact->slip_after[1]));
    assert_true(contact->tangential_restitution == 8.0 && contact->restitution_kinematic == 9.0);
    assert_true(contact->restitution_energetic == 10.0);
    assert_int_equal(contact->friction_state, percuss_v1_FRICTION_STATE_SLID);
    assert_true(sub->impulse_tangential[1] == 11.0 && sub->slip_before[0] == 12.0);
    assert_true(isnan(sub->slip_after[0]));
    assert_int_equal(sub->friction_state, percuss_v1_FRICTION_STATE_STUCK);
    answer_release(answer);
    free(result);
}

static void leaves_velocities_out_that_are_not_known(void **state)
{
    (void)state;
    struct envelope envelope = sample_envelope(1);
    struct solve_result *result = sample_result(2, 0);
    result->velocities_known = false;
    struct answer *answer = encode_result(&envelope, result, sample_tokens, 256);
    assert_int_equal(answer->reply->velocity_after._length, 0);
    assert_int_equal(answer->reply->states_after._length, 2);
    answer_release(answer);
    free(result);
}

static void all_undefined(const percuss_v1_Reply *reply)
{
    const percuss_v1_Energy *energy = &reply->energy;
    const percuss_v1_ErrorEstimate *error = &reply->error;
    const double numbers[] = {
        reply->window,
        reply->time_shift,
        energy->available,
        energy->rigid_after,
        energy->damping,
        energy->plastic,
        energy->friction,
        energy->stored,
        energy->closure,
        error->restitution_time,
        error->restitution_modes,
        error->impulse_time,
        error->impulse_modes,
        error->restitution_by_speed,
        error->restitution_model,
        error->restitution_total,
        error->restitution_yield,
        error->impulse_tangential_by_speed[0],
        error->impulse_tangential_by_speed[1],
        reply->model.omitted_error,
    };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        assert_true(isnan(numbers[i]));
}

static void a_refusal_holds_no_numbers(void **state)
{
    (void)state;
    struct envelope envelope = sample_envelope(1);
    struct solve_result *result = sample_result(2, 2);
    for (enum percuss_status status = 0; status < PERCUSS_STATUS_COUNT; status++) {
        result->status = status;
        snprintf(result->fault.text, sizeof result->fault.text, "reason %d", status);
        struct answer *answer = encode_result(&envelope, result, sample_tokens, 256);
        assert_int_equal(answer->reply->status, status);
        assert_string_equal(answer->reply->message, result->fault.text);
        if (!encode_status_has_result(status)) {
            all_undefined(answer->reply);
            assert_int_equal(answer->reply->contacts._length, 0);
            assert_int_equal(answer->reply->states_after._length, 0);
            assert_int_equal(answer->reply->warnings._length, 0);
            assert_int_equal(answer->reply->end_reason, PERCUSS_END_NONE);
            assert_false(answer->reply->complete);
        }
        answer_release(answer);
    }
    free(result);
}

static void says_which_refusals_are_of_the_moment(void **state)
{
    (void)state;
    struct envelope envelope = sample_envelope(1);
    for (enum percuss_status status = 0; status < PERCUSS_STATUS_COUNT; status++) {
        bool passing =
            status == PERCUSS_BUSY || status == PERCUSS_TIMEOUT || status == PERCUSS_INTERNAL;
        struct answer *answer = encode_refusal(&envelope, status, "");
        assert_int_equal(answer->passing, passing);
        struct answer *batch = batch_answer(&envelope, &answer, 1);
        assert_int_equal(batch->passing, passing);
        answer_release(batch);
    }
}

/* What Cyclone makes of a sample, in bytes. */
static size_t serialised(const void *sample, const dds_topic_descriptor_t *type)
{
    dds_ostream_t stream = {.m_xcdr_version = 2};
    dds_stream_write(&stream, sample, type->m_ops);
    size_t size = stream.m_index;
    free(stream.m_buffer);
    return size;
}

static void bounds_the_size_of_a_reply(void **state)
{
    (void)state;
    struct envelope envelope = sample_envelope(1);
    static const size_t counts[] = {1, 2, 3, 17, 64}, lists[] = {0, 1, 2, 16, 256};
    for (size_t i = 0; i < 5; i++) {
        for (size_t k = 0; k < 5; k++) {
            struct solve_result *result = sample_result(counts[i], lists[k]);
            struct answer *answer = encode_result(&envelope, result, sample_tokens, lists[k]);
            size_t real = serialised(answer->reply, &percuss_v1_Reply_desc);
            size_t bound = batch_reply_size(answer->reply);
            assert_in_range(real, 1, bound);
            assert_true((double)bound < 1.1 * (double)real + 300.0);
            answer_release(answer);
            free(result);
        }
    }
}

/* Every reply once, in order, in parts that know their place and their size. */
static void check_parts(const struct answer *batch, size_t count)
{
    size_t seen = 0;
    for (size_t i = 0; i < batch->part_count; i++) {
        const percuss_v1_BatchReply *part = &batch->parts[i];
        assert_int_equal(part->part, i);
        assert_int_equal(part->parts, batch->part_count);
        assert_true(part->sequence == 99);
        assert_in_range(serialised(part, &percuss_v1_BatchReply_desc), 1, BATCH_PART_BYTES);
        for (uint32_t k = 0; k < part->replies._length; k++)
            assert_true(part->replies._buffer[k].sequence == seen++);
    }
    assert_int_equal(seen, count);
}

static void cuts_a_batch(size_t count, size_t contacts, size_t listed)
{
    struct envelope envelope = sample_envelope(99);
    struct answer *members[PERCUSS_MAX_BATCH];
    struct solve_result *result = sample_result(contacts, listed);
    for (size_t i = 0; i < count; i++) {
        struct envelope own = sample_envelope(i);
        members[i] = batch_encode_member(&own, result, sample_tokens);
        assert_in_range(members[i]->reply->contacts._buffer[0].sub_impacts._length, 0,
                        BATCH_SUB_IMPACTS);
        assert_int_equal(members[i]->reply->contacts._buffer[0].sub_impact_count, listed + 1000);
    }
    struct answer *batch = batch_answer(&envelope, members, count);
    check_parts(batch, count);
    answer_release(batch);
    free(result);
}

static void cuts_batches_into_parts(void **state)
{
    (void)state;
    cuts_a_batch(1, 1, 1);
    cuts_a_batch(256, 1, 1);
    cuts_a_batch(256, 2, 256);
    cuts_a_batch(3, 64, 256);
}

/* Histories of two contacts, the second one with friction or without. */
enum { INSTANTS = 2 * TRACE_PART_INSTANTS + 7, TRACED = 2 };
static double histories[13][INSTANTS];
static struct trace_contact traced[TRACED];

static struct answer *encode_histories(bool friction)
{
    struct trace trace = {INSTANTS, TRACED, histories[0], traced};
    struct envelope envelope = sample_envelope(9);
    for (int k = 0; k < 13; k++)
        for (int i = 0; i < INSTANTS; i++)
            histories[k][i] = 1e4 * k + i;
    for (int c = 0; c < TRACED; c++)
        traced[c] = (struct trace_contact){.force = histories[1],
                                           .indentation = histories[2],
                                           .gap = histories[3],
                                           .gap_rate = histories[4],
                                           .displacement = {histories[5], histories[7]},
                                           .velocity = {histories[6], histories[8]}};
    for (int t = 0; t < 2 && friction; t++) {
        traced[1].tangential[t] = histories[9 + t];
        traced[1].slip[t] = histories[11 + t];
    }
    struct solve_result *result = sample_result(TRACED, 1);
    result->trace = &trace;
    struct answer *answer = encode_result(&envelope, result, sample_tokens, 16);
    free(result);
    return answer;
}

/* Every instant of every column once, in samples of bounded size. */
static void cuts_histories_into_parts(void **state)
{
    (void)state;
    struct answer *answer = encode_histories(false);
    assert_int_equal(answer->trace_count, 3 * TRACED);
    for (uint32_t i = 0; i < answer->trace_count; i++) {
        const percuss_v1_Trace *part = &answer->traces[i];
        uint32_t first = part->part * TRACE_PART_INSTANTS;
        assert_int_equal(part->contact, i / 3);
        assert_int_equal(part->part, i % 3);
        assert_int_equal(part->parts, 3);
        assert_true(part->sequence == 9);
        assert_int_equal(part->velocity_b._length, i % 3 == 2 ? 7 : TRACE_PART_INSTANTS);
        assert_true(part->time._buffer[0] == first);
        assert_true(part->displacement_a._buffer[6] == 5e4 + 6 + first);
        assert_true(part->velocity_b._buffer[6] == 8e4 + 6 + first);
        assert_int_equal(part->force_tangential_1._length + part->slip_2._length, 0);
        assert_in_range(serialised(part, &percuss_v1_Trace_desc), 1, BATCH_PART_BYTES);
    }
    answer_release(answer);
}

/* Parts with friction have fewer instants, so that they are no larger. */
static void cuts_histories_of_friction(void **state)
{
    (void)state;
    enum { OF_PART = TRACE_PART_INSTANTS * 9 / 13, PARTS = INSTANTS / OF_PART + 1 };
    struct answer *answer = encode_histories(true);
    assert_int_equal(answer->trace_count, PARTS * TRACED);
    for (uint32_t i = 0; i < answer->trace_count; i++) {
        const percuss_v1_Trace *part = &answer->traces[i];
        double first = part->time._buffer[0];
        assert_true(first == (double)part->part * OF_PART);
        assert_int_equal(part->slip_2._length, part->contact == 1 ? part->time._length : 0);
        assert_in_range(serialised(part, &percuss_v1_Trace_desc), 1, BATCH_PART_BYTES);
        if (part->contact != 1)
            continue;
        assert_true(part->force_tangential_1._buffer[2] == 9e4 + 2 + first);
        assert_true(part->force_tangential_2._buffer[2] == 10e4 + 2 + first);
        assert_true(part->slip_1._buffer[2] == 11e4 + 2 + first);
        assert_true(part->slip_2._buffer[2] == 12e4 + 2 + first);
    }
    answer_release(answer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(copies_a_result),
        cmocka_unit_test(leaves_velocities_out_that_are_not_known),
        cmocka_unit_test(a_refusal_holds_no_numbers),
        cmocka_unit_test(says_which_refusals_are_of_the_moment),
        cmocka_unit_test(bounds_the_size_of_a_reply),
        cmocka_unit_test(cuts_batches_into_parts),
        cmocka_unit_test(cuts_histories_into_parts),
        cmocka_unit_test(cuts_histories_of_friction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
