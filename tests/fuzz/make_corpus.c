/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Writes the inputs of corpus/ that are no text, where a type of the wire has changed: samples of
 * every type in both byte orders, and a good request alone, in a batch and in an ensemble; and the
 * questions of ROS 2.
 * usage: make_corpus FOLDER */
#include <sys/stat.h>

#include "percuss_msgs.h"
#include "samples.h"
#include "unit/exchange/sample.h"

static const char *folder;

static void write_input(const char *harness, const char *name, const uint8_t *head,
                        size_t head_size, const struct any_bytes *bytes)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, harness);
    mkdir(path, 0777);
    snprintf(path, sizeof path, "%s/%s/%s", folder, harness, name);
    FILE *file = fopen(path, "wb");
    FUZZ_REQUIRE(file && fwrite(head, head_size, 1, file) == 1 &&
                     fwrite(bytes->data, bytes->size, 1, file) == 1 && fclose(file) == 0,
                 "%s: cannot be written", path);
}

static void write_sample(const char *harness, const char *name, int type, bool swapped,
                         const struct any_bytes *bytes)
{
    char whole[128];
    uint8_t head[4] = {(uint8_t)type, swapped, (uint8_t)bytes->size, (uint8_t)(bytes->size >> 8)};
    snprintf(whole, sizeof whole, "%s%s", name, swapped ? "-swapped" : "");
    write_input(harness, whole, head, sizeof head, bytes);
}

static void write_any(void)
{
    static const char to_daemon[] = {0, 2, 4, 11};
    for (int i = 0; i < 2 * ANY_TYPES; i++) {
        int type = i / 2;
        struct any_bytes bytes = any_sample(any_types[type].type, i % 2);
        const char *name = strrchr(any_types[type].topic, '/') + 1;
        bool asks = memchr(to_daemon, type, sizeof to_daemon);
        if (asks)
            write_sample("wire_request", name, type, i % 2, &bytes);
        if (!asks || type == 11)
            write_sample("wire_reply", name, type, i % 2, &bytes);
        free(bytes.data);
    }
}

static void write_good(const char *name, int type, const void *sample)
{
    struct any_bytes bytes = any_bytes_of(sample, any_types[type].type->m_ops, false);
    write_sample("wire_request", name, type, false, &bytes);
    free(bytes.data);
}

static void write_requests(void)
{
    static struct sample sample;
    sample_fill(&sample);
    write_good("good-request", 0, &sample.wire);
    percuss_v1_BatchRequest batch = {.sequence = 3};
    batch.requests._buffer = &sample.wire;
    batch.requests._length = 1;
    write_good("good-batch", 2, &batch);
    /* an impact of one contact at an uncertain speed */
    percuss_v1_EnsembleInput input = {.distribution = 1, .first = 0.1, .second = 0.4};
    snprintf(input.name, sizeof input.name, "speed");
    percuss_v1_EnsembleRequest ensemble = {.sequence = 4, .samples = 100};
    sample.wire.contacts._length = 1;
    sample.wire.delassus._length = 0;
    ensemble.scene = sample.wire;
    ensemble.inputs._buffer = &input;
    ensemble.inputs._length = 1;
    write_good("good-ensemble", 4, &ensemble);
}

/* What once was found: lists of nothing. */
static void write_empty(void)
{
    percuss_v1_BatchRequest batch = {.sequence = 3};
    percuss_v1_EnsembleSamples samples = {.sequence = 4, .columns = 2, .parts = 1};
    write_good("found-empty-batch", 2, &batch);
    struct any_bytes bytes = any_bytes_of(&samples, percuss_v1_EnsembleSamples_desc.m_ops, false);
    write_sample("wire_reply", "found-no-rows", 6, false, &bytes);
    free(bytes.data);
}

/* A question on the topic or one of the service, in both versions of XCDR. */
static void write_question(const char *name, bool service, const void *sample)
{
    const dds_topic_descriptor_t *type = service ? &percuss_msgs_srv_dds__Impact_Request__desc
                                                 : &percuss_msgs_msg_dds__Request__desc;
    for (int way = 0; way < 4; way++) {
        char whole[128];
        const bool swapped = way % 2, big = swapped == (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
        const uint8_t head[] = {service, 0, (uint8_t)((way / 2 ? 6 : 0) + !big), 0, 0};
        struct any_bytes bytes =
            any_bytes_in(way / 2 ? XCDR2 : XCDR1, sample, type->m_ops, swapped);
        snprintf(whole, sizeof whole, "%s-xcdr%d%s", name, 1 + way / 2, swapped ? "-swapped" : "");
        write_input("ros2", whole, head, sizeof head, &bytes);
        free(bytes.data);
    }
}

static void write_ros(void)
{
    static char none[] = "", sphere[] = "steel-sphere", rod[] = "al-rod";
    static char user_data[] = "clientid=0123456789abcdef;";
    percuss_msgs_msg_dds__Override_ override = {.parameter = 1, .value = 0.3};
    percuss_msgs_msg_dds__BodyMotion_ bodies[2] = {{.id = sphere, .state = none, .specimen = none},
                                                   {.id = rod, .state = none, .specimen = none}};
    percuss_msgs_msg_dds__Contact_ contact = {.b = 1, .point.x = 0.5, .normal.x = 1.0};
    double delassus = 50.0;
    percuss_msgs_msg_dds__Question_ question = {.bodies = {._length = 2, ._buffer = bodies},
                                                .contacts = {._length = 1, ._buffer = &contact},
                                                .delassus = {._length = 1, ._buffer = &delassus}};
    bodies[0].position.x = 0.515;
    bodies[0].velocity.x = -0.3;
    bodies[0].orientation.w = bodies[1].orientation.w = 1.0;
    bodies[1].overrides._length = 1;
    bodies[1].overrides._buffer = &override;
    write_question("topic", false, &(percuss_msgs_msg_dds__Request_){.question = question});
    write_question("service", true, &(percuss_msgs_srv_dds__Impact_Request_){.question = question});
    const uint8_t kind = 2;
    struct any_bytes bytes = {(uint8_t *)user_data, sizeof user_data - 1};
    write_input("ros2", "user-data", &kind, sizeof kind, &bytes);
}

int main(int argc, char **argv)
{
    FUZZ_REQUIRE(argc == 2, "usage: make_corpus FOLDER");
    folder = argv[1];
    write_any();
    write_requests();
    write_empty();
    write_ros();
    return 0;
}
