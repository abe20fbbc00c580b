/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/whole.h"

#include <stdint.h>
#include <string.h>

enum { ENCAPSULATION = 4, CLIENT = 16 };

/* What is left of the innermost struct. In XCDR2 nothing is aligned to more than 4 bytes. */
struct cursor {
    const uint8_t *data;
    size_t at, end;
};

static bool skip(struct cursor *cursor, size_t size)
{
    if (size > cursor->end - cursor->at)
        return false;
    cursor->at += size;
    return true;
}

/* A length: of what follows in bytes, or of a sequence in elements. */
static bool read_length(struct cursor *cursor, size_t *length)
{
    uint32_t number;
    size_t aligned = (cursor->at + 3) & ~(size_t)3;
    if (!skip(cursor, aligned - cursor->at) || cursor->end - cursor->at < sizeof number)
        return false;
    memcpy(&number, cursor->data + cursor->at, sizeof number);
    cursor->at += sizeof number;
    *length = number;
    return true;
}

/* An @appendable struct, or a sequence of structs: its size comes first. */
static bool enter(const struct cursor *outer, struct cursor *inner)
{
    size_t size;
    *inner = *outer;
    if (!read_length(inner, &size) || size > inner->end - inner->at)
        return false;
    inner->end = inner->at + size;
    return true;
}

static bool skip_delimited(struct cursor *cursor)
{
    struct cursor inner;
    if (!enter(cursor, &inner))
        return false;
    cursor->at = inner.end;
    return true;
}

/* Client, number. */
static bool skip_header(struct cursor *cursor)
{
    return skip(cursor, CLIENT + sizeof(uint64_t));
}

/* A request up to its last member. */
static bool check_single(struct cursor *cursor)
{
    struct cursor request;
    size_t delassus;
    if (!enter(cursor, &request))
        return false;
    cursor->at = request.end;
    // bodies, contacts, delassus; then options, the struct
    return skip_header(&request) && skip_delimited(&request) && skip_delimited(&request) &&
           read_length(&request, &delassus) && delassus <= request.end / sizeof(double) &&
           skip(&request, delassus * sizeof(double)) && skip_delimited(&request);
}

/* The requests of a batch; it may well end before them. */
static bool check_batch(struct cursor *cursor)
{
    struct cursor batch, requests;
    size_t count;
    if (!enter(cursor, &batch) || !skip_header(&batch))
        return false;
    if (batch.at == batch.end)
        return true;
    bool whole = enter(&batch, &requests) && read_length(&requests, &count);
    for (size_t i = 0; whole && i < count; i++)
        whole = check_single(&requests);
    return whole;
}

/* Its scene is a request; what comes after needs no struct. */
static bool check_ensemble(struct cursor *cursor)
{
    struct cursor ensemble;
    return enter(cursor, &ensemble) && skip_header(&ensemble) && check_single(&ensemble);
}

bool whole_request(enum exchange exchange, const void *data, size_t size)
{
    if (size < ENCAPSULATION)
        return false;
    struct cursor cursor = {(const uint8_t *)data + ENCAPSULATION, 0, size - ENCAPSULATION};
    switch (exchange) {
    case EXCHANGE_SINGLE:
        return check_single(&cursor);
    case EXCHANGE_BATCH:
        return check_batch(&cursor);
    default:
        return check_ensemble(&cursor);
    }
}
