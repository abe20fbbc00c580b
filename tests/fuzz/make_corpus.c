/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Writes the inputs of corpus/ that are no text, where a type of the wire has changed: samples of
 * every type in both byte orders, and a good request alone, in a batch and in an ensemble.
 * usage: make_corpus FOLDER */
#include <sys/stat.h>

#include "samples.h"
#include "unit/exchange/sample.h"

static const char *folder;

static void write_sample(const char *harness, const char *name, int type, bool swapped,
                         const struct any_bytes *bytes)
{
    char path[512];
    uint8_t head[4] = {(uint8_t)type, swapped, (uint8_t)bytes->size, (uint8_t)(bytes->size >> 8)};
    snprintf(path, sizeof path, "%s/%s", folder, harness);
    mkdir(path, 0777);
    snprintf(path, sizeof path, "%s/%s/%s%s", folder, harness, name, swapped ? "-swapped" : "");
    FILE *file = fopen(path, "wb");
    FUZZ_REQUIRE(file && fwrite(head, sizeof head, 1, file) == 1 &&
                     fwrite(bytes->data, bytes->size, 1, file) == 1 && fclose(file) == 0,
                 "%s: cannot be written", path);
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

int main(int argc, char **argv)
{
    FUZZ_REQUIRE(argc == 2, "usage: make_corpus FOLDER");
    folder = argv[1];
    write_any();
    write_requests();
    write_empty();
    return 0;
}
