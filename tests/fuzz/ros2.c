/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the bridge reads of ROS 2: bytes from the network as questions, in either version of XCDR,
 * and user data of peers. What is taken fits the request of libpercuss and its wire, and asks for
 * the same.
 * input: what it is (0 a question on the topic, 1 one of the service, 2 user data), then the bytes,
 * those of a question with the header that says their representation. */
#include "convert.h"
#include "error.h"
#include "fuzz.h"
#include "service.h"
#include "take.h"
#include "unit/wire/any_sample.h"
#include "wire_whole.h"

enum { TOPIC = 0, SERVICE = 1, USER_DATA = 2, KINDS = 3, HEADER = 4, BEYOND = 1024, MARK = 0xa5 };

static void require_same(const double to[3], double x, double y, double z, const char *name)
{
    const double from[3] = {x, y, z};
    FUZZ_REQUIRE(memcmp(to, from, sizeof from) == 0, "another %s", name);
}

static void require_body(const percuss_msgs_msg_dds__BodyMotion_ *from,
                         const percuss_v1_BodyMotion *to)
{
    FUZZ_REQUIRE(strcmp(from->id, to->id) == 0 && strcmp(from->specimen, to->specimen) == 0 &&
                     strcmp(from->state, to->state) == 0,
                 "other names: %s", to->id);
    require_same(to->position, from->position.x, from->position.y, from->position.z, "position");
    require_same(to->velocity, from->velocity.x, from->velocity.y, from->velocity.z, "velocity");
    require_same(to->orientation + 1, from->orientation.x, from->orientation.y, from->orientation.z,
                 "orientation");
    FUZZ_REQUIRE(to->overrides._length == from->overrides._length, "other overrides");
    for (uint32_t i = 0; i < to->overrides._length; i++)
        FUZZ_REQUIRE(to->overrides._buffer[i].parameter == from->overrides._buffer[i].parameter,
                     "override %u", i);
}

static void require_question(const percuss_msgs_msg_dds__Question_ *from,
                             const percuss_v1_Request *to)
{
    FUZZ_REQUIRE(to->bodies._length == from->bodies._length &&
                     to->contacts._length == from->contacts._length &&
                     to->delassus._length == from->delassus._length,
                 "other lists");
    for (uint32_t i = 0; i < to->bodies._length; i++)
        require_body(&from->bodies._buffer[i], &to->bodies._buffer[i]);
    for (uint32_t i = 0; i < to->contacts._length; i++) {
        const percuss_msgs_msg_dds__Contact_ *contact = &from->contacts._buffer[i];
        const percuss_v1_Contact *taken = &to->contacts._buffer[i];
        FUZZ_REQUIRE(taken->a == contact->a && taken->b == contact->b, "other bodies touch");
        require_same(taken->normal, contact->normal.x, contact->normal.y, contact->normal.z,
                     "normal");
    }
    FUZZ_REQUIRE(!to->delassus._length ||
                     memcmp(to->delassus._buffer, from->delassus._buffer,
                            to->delassus._length * sizeof *to->delassus._buffer) == 0,
                 "another delassus");
}

static void ask(const percuss_msgs_msg_dds__Question_ *question)
{
    static struct percuss_request request;
    static struct request_storage storage;
    percuss_v1_Request wire;
    char problem[TAKE_PROBLEM_SIZE];
    if (!take_question(question, &request, problem)) {
        fuzz_refused(PERCUSS_BAD_REQUEST, problem);
        return;
    }
    memset(&wire, 0, sizeof wire);
    if (convert_request(&request, &storage, &wire) == PERCUSS_RESULT_OK)
        require_question(question, &wire);
    else
        fuzz_refused(PERCUSS_BAD_REQUEST, percuss_error_text());
}

/* As wire_topic.c and DDS behind it, with marks where DDS has nothing to write. */
static void give(int kind, unsigned representation, const uint8_t *data, size_t size)
{
    const dds_topic_descriptor_t *type = kind == TOPIC
                                             ? &percuss_msgs_msg_dds__Request__desc
                                             : &percuss_msgs_srv_dds__Impact_Request__desc;
    const bool swapped = representation % 2 == (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__);
    const uint32_t version = representation < 2 ? XCDR1 : XCDR2;
    uint32_t used = 0;
    char *copy = malloc(size + BEYOND);
    FUZZ_REQUIRE(copy, "no memory");
    memcpy(copy, data, size);
    memset(copy + size, MARK, BEYOND);
    bool taken =
        wire_whole_in((int)version, type->m_ops, data, size, swapped) &&
        dds_stream_normalize_data(copy, &used, (uint32_t)size, swapped, version, type->m_ops);
    for (size_t i = 0; i < BEYOND; i++)
        FUZZ_REQUIRE((uint8_t)copy[size + i] == MARK, "DDS writes beyond a question");
    if (taken) {
        void *sample = dds_alloc(type->m_size);
        memset(sample, 0, type->m_size);
        dds_istream_t stream;
        dds_istream_init(&stream, (uint32_t)size, copy, version);
        dds_stream_read(&stream, sample, type->m_ops);
        FUZZ_REQUIRE(stream.m_index <= size, "DDS reads beyond a question");
        ask(kind == TOPIC ? &((percuss_msgs_msg_dds__Request_ *)sample)->question
                          : &((percuss_msgs_srv_dds__Impact_Request_ *)sample)->question);
        dds_sample_free(sample, type, DDS_FREE_ALL);
    }
    free(copy);
}

static void find_client(const uint8_t *data, size_t size)
{
    char id[SERVICE_ID_SIZE];
    bool found = service_client_id(data, size, id);
    size_t length = strnlen(id, sizeof id);
    FUZZ_REQUIRE(length < sizeof id && found == (length > 0) && !strchr(id, ';'), "no id: %s", id);
    FUZZ_REQUIRE(!found || memmem(data, size, id, length), "an id from elsewhere: %s", id);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 1)
        return 0;
    const int kind = data[0] % KINDS;
    /* to its exact size, so that tools see every byte read beyond it */
    uint8_t *copy = malloc(size - 1 + (size == 1));
    FUZZ_REQUIRE(copy, "no memory");
    memcpy(copy, data + 1, size - 1);
    if (kind == USER_DATA)
        find_client(copy, size - 1);
    else if (size - 1 >= HEADER && copy[0] == 0 && (copy[1] < 2 || copy[1] / 2 == 3))
        give(kind, copy[1], copy + HEADER, size - 1 - HEADER);
    free(copy);
    return 0;
}
