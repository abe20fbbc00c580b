/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/reply_bytes.h"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_cdrstream.h>
#include <stdlib.h>
#include <string.h>

#include "wire_whole.h"

enum { XCDR2 = 2, FIRST_ROOM = 4096 };

static const bool swapped = __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__;

void *reply_bytes_write(const struct answer *answer, size_t *size)
{
    dds_ostreamLE_t stream;
    dds_ostreamLE_init(&stream, FIRST_ROOM, XCDR2);
    const uint32_t *end =
        dds_stream_writeLE(&stream, (const char *)answer->reply, percuss_v1_Reply_desc.m_ops);
    *size = stream.x.m_index;
    void *bytes = end ? malloc(*size) : NULL;
    if (bytes)
        memcpy(bytes, stream.x.m_buffer, *size);
    dds_ostreamLE_fini(&stream);
    return bytes;
}

/* Checks the bytes, turns them into this machine's order, and decodes them into a zeroed reply. */
static bool reply_bytes_decode(char *bytes, uint32_t size, percuss_v1_Reply *reply)
{
    uint32_t used = 0;
    if (!wire_whole(percuss_v1_Reply_desc.m_ops, bytes, size, swapped) ||
        !dds_stream_normalize_data(bytes, &used, size, swapped, XCDR2, percuss_v1_Reply_desc.m_ops))
        return false;
    dds_istream_t stream;
    dds_istream_init(&stream, size, bytes, XCDR2);
    dds_stream_read(&stream, (char *)reply, percuss_v1_Reply_desc.m_ops);
    dds_istream_fini(&stream);
    return true;
}

static void free_reply(percuss_v1_Reply *reply)
{
    dds_sample_free(reply, &percuss_v1_Reply_desc, DDS_FREE_ALL);
}

struct answer *reply_bytes_read(const void *bytes, size_t size, bool *damaged)
{
    struct answer *answer = answer_create(EXCHANGE_SINGLE, 0);
    char *copy = malloc(size);
    bool good = answer && copy;
    *damaged = good && size > UINT32_MAX;
    if (good && !*damaged) {
        memcpy(copy, bytes, size);
        answer->decoded = answer->reply = dds_alloc(sizeof *answer->reply);
        answer->free_decoded = free_reply;
        memset(answer->reply, 0, sizeof *answer->reply);
        /* about as much in memory as on the wire */
        answer->bytes += sizeof *answer->reply + size;
        *damaged = !reply_bytes_decode(copy, (uint32_t)size, answer->reply);
    }
    free(copy);
    if (good && !*damaged)
        return answer;
    answer_release(answer);
    return NULL;
}
