/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/batch.h"

#include <string.h>

#include "exchange/encode.h"
#include "percuss/fields.h"

/* Serialised sizes: numbers of 8 bytes are aligned to 4, every structure and every list of
 * structures begins with 4 bytes of its length, a list with 4 more of its count. Texts and lists
 * are counted apart from their structure. */
#define SIZE(kind, ...) +SIZE_##kind
#define SIZE_VALUE      8
#define SIZE_VECTOR     24
#define SIZE_PAIR       16
#define SIZE_CHOICE     4
#define SIZE_COUNT      4
#define SIZE_FLAG       4
#define SIZE_ID         0
#define SIZE_TEXT       0
#define SIZE_LIST       8

enum {
    REPLY_FIXED = 512,
    CONTACT_FIXED = 4 PERCUSS_CONTACT_RESULT_FIELDS(SIZE, SIZE),
    SUB_IMPACT = 4 PERCUSS_SUB_IMPACT_FIELDS(SIZE),
    VELOCITY_FIXED = 4 PERCUSS_BODY_VELOCITY_FIELDS(SIZE),
    STATE_FIXED = 4 PERCUSS_BODY_STATE_FIELDS(SIZE),
    ENERGY_FIXED = 4 PERCUSS_BODY_ENERGY_FIELDS(SIZE),
    MODEL_FIXED = 4 PERCUSS_BODY_MODEL_FIELDS(SIZE),
    PART_FIXED = 1408 /* with the longest texts it can hold */
};

/* Its length, the terminating zero and the padding to the next multiple of 4. */
static size_t text_size(const char *text)
{
    return 4 + strlen(text) + 1 + 3;
}

static size_t contacts_size(const percuss_v1_Reply *reply)
{
    size_t size = 0;
    for (uint32_t i = 0; i < reply->contacts._length; i++)
        size += CONTACT_FIXED + SUB_IMPACT * (size_t)reply->contacts._buffer[i].sub_impacts._length;
    return size;
}

static size_t bodies_size(const percuss_v1_Reply *reply)
{
    size_t size = 0;
    for (uint32_t i = 0; i < reply->velocity_after._length; i++)
        size += VELOCITY_FIXED + text_size(reply->velocity_after._buffer[i].id);
    for (uint32_t i = 0; i < reply->states_after._length; i++)
        size += STATE_FIXED + text_size(reply->states_after._buffer[i].id) +
                text_size(reply->states_after._buffer[i].state);
    for (uint32_t i = 0; i < reply->energy.vibration._length; i++)
        size += ENERGY_FIXED + text_size(reply->energy.vibration._buffer[i].id);
    for (uint32_t i = 0; i < reply->model.bodies._length; i++)
        size += MODEL_FIXED + text_size(reply->model.bodies._buffer[i].id) +
                text_size(reply->model.bodies._buffer[i].theory);
    return size;
}

size_t batch_reply_size(const percuss_v1_Reply *reply)
{
    size_t size = REPLY_FIXED + text_size(reply->message) + text_size(reply->model.reason);
    for (uint32_t i = 0; i < reply->warnings._length; i++)
        size += text_size(reply->warnings._buffer[i]);
    return size + contacts_size(reply) + bodies_size(reply);
}

struct answer *batch_encode_member(const struct envelope *envelope,
                                   const struct solve_result *result,
                                   const char (*tokens)[PERCUSS_ID_SIZE])
{
    struct answer *answer = NULL;
    for (size_t listed = BATCH_SUB_IMPACTS;; listed /= 2) {
        answer = encode_result(envelope, result, tokens, listed);
        if (!answer || listed == 0 ||
            batch_reply_size(answer->reply) <= BATCH_PART_BYTES - PART_FIXED)
            return answer;
        answer_release(answer);
    }
}

/* How many of the replies fit into one part; at least one. */
static size_t fitting(struct answer *const *members, size_t count)
{
    size_t size = PART_FIXED + batch_reply_size(members[0]->reply), fit = 1;
    for (; fit < count; fit++) {
        size += batch_reply_size(members[fit]->reply);
        if (size > BATCH_PART_BYTES)
            break;
    }
    return fit;
}

static size_t count_parts(struct answer *const *members, size_t count)
{
    size_t parts = 0;
    for (size_t first = 0; first < count; first += fitting(members + first, count - first))
        parts++;
    return parts;
}

/* Room for the parts, the replies side by side as a part's list has them, and the members. */
static struct answer *create(size_t parts, size_t count)
{
    struct answer *answer =
        answer_create(EXCHANGE_BATCH, answer_room(parts, sizeof *answer->parts) +
                                          answer_room(count, sizeof *answer->reply) +
                                          answer_room(count, sizeof *answer->members));
    if (!answer)
        return NULL;
    answer->parts = answer_take(answer, parts, sizeof *answer->parts);
    answer->part_count = parts;
    answer->reply = answer_take(answer, count, sizeof *answer->reply);
    answer->members = answer_take(answer, count, sizeof *answer->members);
    answer->member_count = count;
    return answer;
}

struct answer *batch_answer(const struct envelope *envelope, struct answer *const *members,
                            size_t count)
{
    struct answer *answer = create(count_parts(members, count), count);
    if (!answer)
        return NULL;
    /* the replies of all members, one after the other */
    for (size_t i = 0; i < count; i++) {
        answer->members[i] = members[i];
        answer->reply[i] = *members[i]->reply;
        answer->bytes += members[i]->bytes;
        answer->passing = answer->passing || members[i]->passing;
    }
    /* parts, each of as many of them as its sample holds */
    size_t first = 0;
    for (size_t i = 0; i < answer->part_count; i++) {
        percuss_v1_BatchReply *part = &answer->parts[i];
        size_t fit = fitting(members + first, count - first);
        encode_batch_head(part, envelope, PERCUSS_OK, "");
        part->part = (uint32_t)i;
        part->parts = (uint32_t)answer->part_count;
        part->replies._buffer = answer->reply + first;
        part->replies._length = part->replies._maximum = (uint32_t)fit;
        first += fit;
    }
    return answer;
}
