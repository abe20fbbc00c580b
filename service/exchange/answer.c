/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/answer.h"

#include <assert.h>
#include <stdalign.h>
#include <stdlib.h>

static const size_t GRAIN = alignof(max_align_t);

static size_t round_up(size_t bytes)
{
    return (bytes + GRAIN - 1) / GRAIN * GRAIN;
}

size_t answer_room(size_t count, size_t size)
{
    return round_up(count * size);
}

struct answer *answer_create(enum exchange exchange, size_t room)
{
    size_t bytes = round_up(sizeof(struct answer)) + room;
    struct answer *answer = calloc(1, bytes);
    if (!answer)
        return NULL;
    atomic_init(&answer->holders, 1);
    answer->exchange = exchange;
    answer->bytes = bytes;
    answer->room = room;
    return answer;
}

struct answer *answer_hold(struct answer *answer)
{
    atomic_fetch_add(&answer->holders, 1);
    return answer;
}

void answer_release(struct answer *answer)
{
    if (!answer || atomic_fetch_sub(&answer->holders, 1) > 1)
        return;
    for (size_t i = 0; i < answer->member_count; i++)
        answer_release(answer->members[i]);
    if (answer->decoded)
        answer->free_decoded(answer->decoded);
    free(answer);
}

void *answer_take(struct answer *answer, size_t count, size_t size)
{
    char *memory = (char *)answer + round_up(sizeof *answer) + answer->taken;
    answer->taken += answer_room(count, size);
    assert(answer->taken <= answer->room);
    return memory;
}
