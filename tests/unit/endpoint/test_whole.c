/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* endpoint/whole.c: samples that end before their struct members do. Bytes are written by hand
 * after the rules of XCDR2; tests with the middleware itself are in
 * client/python/tests/test_peers.py. */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "endpoint/whole.h"

struct bytes {
    uint8_t data[1024];
    size_t size;
};

/* At the next multiple of four. */
static void put(struct bytes *bytes, uint32_t number)
{
    while (bytes->size % 4)
        bytes->data[bytes->size++] = 0;
    memcpy(bytes->data + bytes->size, &number, sizeof number);
    bytes->size += sizeof number;
}

static void put_zeros(struct bytes *bytes, size_t size)
{
    memset(bytes->data + bytes->size, 0, size);
    bytes->size += size;
}

static void put_all(struct bytes *bytes, const struct bytes *other)
{
    memcpy(bytes->data + bytes->size, other->data, other->size);
    bytes->size += other->size;
}

/* With its size in front. */
static struct bytes delimited(const struct bytes *inside)
{
    struct bytes bytes = {.size = 0};
    put(&bytes, (uint32_t)inside->size);
    put_all(&bytes, inside);
    return bytes;
}

static void put_header(struct bytes *bytes)
{
    put_zeros(bytes, 16 + 8); // client, sequence
}

enum { HEADER, BODIES, CONTACTS, DELASSUS, OPTIONS };

/* A request that ends after `last`. */
static struct bytes request(int last)
{
    struct bytes members = {.size = 0};
    put_header(&members);
    for (int list = BODIES; list <= CONTACTS && list <= last; list++) {
        put(&members, 4 + 5); // size of one element that takes five bytes
        put(&members, 1);
        put_zeros(&members, 5);
    }
    if (last >= DELASSUS) {
        put(&members, 1);
        put_zeros(&members, sizeof(double));
    }
    if (last >= OPTIONS) {
        put(&members, 12); // older options, of which the rest takes its default
        put_zeros(&members, 12);
    }
    return delimited(&members);
}

static struct bytes with_encapsulation(const struct bytes *inside)
{
    struct bytes bytes = {.size = 0};
    put_zeros(&bytes, 4);
    put_all(&bytes, inside);
    return bytes;
}

/* Copied to its exact size, so that tools see every byte read beyond it. */
static bool is_whole(enum exchange exchange, const struct bytes *inside)
{
    struct bytes bytes = with_encapsulation(inside);
    uint8_t *copy = malloc(bytes.size);
    assert_non_null(copy);
    memcpy(copy, bytes.data, bytes.size);
    bool whole = whole_request(exchange, copy, bytes.size);
    free(copy);
    return whole;
}

static void a_request_needs_its_options(void **state)
{
    (void)state;
    for (int last = HEADER; last <= OPTIONS; last++) {
        struct bytes bytes = request(last);
        assert_int_equal(is_whole(EXCHANGE_SINGLE, &bytes), last == OPTIONS);
    }
}

static void a_batch_needs_whole_requests(void **state)
{
    (void)state;
    for (int last = HEADER; last <= OPTIONS; last++) {
        struct bytes good = request(OPTIONS), doubtful = request(last);
        struct bytes requests = {.size = 0}, batch = {.size = 0};
        put(&requests, 2);
        put_all(&requests, &good);
        put_all(&requests, &doubtful);
        requests = delimited(&requests);
        put_header(&batch);
        struct bytes empty = delimited(&batch);
        assert_true(is_whole(EXCHANGE_BATCH, &empty));
        put_all(&batch, &requests);
        batch = delimited(&batch);
        assert_int_equal(is_whole(EXCHANGE_BATCH, &batch), last == OPTIONS);
    }
}

static void an_ensemble_needs_a_whole_scene(void **state)
{
    (void)state;
    struct bytes ensemble = {.size = 0};
    put_header(&ensemble);
    struct bytes alone = delimited(&ensemble);
    assert_false(is_whole(EXCHANGE_ENSEMBLE, &alone));
    for (int last = HEADER; last <= OPTIONS; last++) {
        struct bytes scene = request(last), bytes = ensemble;
        put_all(&bytes, &scene);
        bytes = delimited(&bytes);
        assert_int_equal(is_whole(EXCHANGE_ENSEMBLE, &bytes), last == OPTIONS);
    }
}

/* DDS has checked the bytes; all the same nothing is read beyond them. */
static void nothing_is_read_beyond_the_end(void **state)
{
    (void)state;
    struct bytes good = request(OPTIONS);
    for (size_t size = 0; size < good.size; size++) {
        struct bytes cut = good;
        cut.size = size;
        for (int exchange = 0; exchange < EXCHANGE_COUNT; exchange++)
            assert_false(is_whole(exchange, &cut));
    }
    for (size_t at = 0; at + 4 <= good.size; at += 4) {
        struct bytes wrong = good;
        memset(wrong.data + at, 0xff, 4);
        for (int exchange = 0; exchange < EXCHANGE_COUNT; exchange++)
            is_whole(exchange, &wrong);
    }
    assert_false(whole_request(EXCHANGE_SINGLE, good.data, 3));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_request_needs_its_options),
        cmocka_unit_test(a_batch_needs_whole_requests),
        cmocka_unit_test(an_ensemble_needs_a_whole_scene),
        cmocka_unit_test(nothing_is_read_beyond_the_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
