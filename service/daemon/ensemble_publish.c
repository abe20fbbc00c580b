/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/ensemble_publish.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exchange/encode_ensemble.h"

/* Listed samples: parts of about this size, but no more of them than the writer keeps; each may
 * take so many tenths of a second. */
enum { PART_BYTES = 64 * 1024, MOST_PARTS = 1000, PATIENCE = 20 };

void ensemble_publish_progress(struct shared *shared, const struct ensemble_entry *entry,
                               uint64_t done, uint64_t samples,
                               const struct report_progress *progress)
{
    percuss_v1_EnsembleProgress sample = {
        .sequence = entry->sequence,
        .done = done,
        .samples = samples,
        .mean = progress ? progress->mean : NAN,
        .standard_deviation = progress ? progress->deviation : NAN,
        .half_width = progress ? progress->half_width : NAN,
    };
    memcpy(sample.client, entry->client, sizeof sample.client);
    endpoint_publish(shared->endpoint, entry->client, CHANNEL_PROGRESS, &sample, 0);
}

static void publish_waiting(void *context, const struct ensemble_entry *waiting)
{
    ensemble_publish_progress(context, waiting, 0, waiting->samples, NULL);
}

void ensemble_publish_waiting(struct shared *shared)
{
    ensembles_visit_waiting(&shared->ensembles, publish_waiting, shared);
}

bool ensemble_publish_samples(struct shared *shared, const struct ensemble_entry *entry,
                              const struct ensemble *ensemble,
                              const struct ensemble_sample *samples, uint64_t done)
{
    /* rows a part */
    size_t columns = encode_sample_columns(ensemble);
    uint64_t rows = PART_BYTES / (columns * sizeof(double));
    if (rows * MOST_PARTS < done)
        rows = (done + MOST_PARTS - 1) / MOST_PARTS;
    uint64_t parts = (done + rows - 1) / rows;
    double *values = malloc(rows * columns * sizeof *values);
    if (!values)
        return false;
    /* the parts, until the client takes no more */
    enum delivery delivery = DELIVERY_DONE;
    for (uint64_t part = 0; delivery == DELIVERY_DONE && part < parts; part++) {
        uint64_t first = part * rows;
        uint64_t count = done - first < rows ? done - first : rows;
        for (uint64_t i = 0; i < count; i++)
            encode_sample(ensemble, first + i, &samples[first + i], values + i * columns);
        percuss_v1_EnsembleSamples sample = {
            .sequence = entry->sequence,
            .part = (uint32_t)part,
            .parts = (uint32_t)parts,
            .columns = (uint32_t)columns,
            .first = first,
            .rows = {._buffer = values,
                     ._length = (uint32_t)(count * columns),
                     ._maximum = (uint32_t)(count * columns)},
        };
        memcpy(sample.client, entry->client, sizeof sample.client);
        delivery =
            endpoint_publish(shared->endpoint, entry->client, CHANNEL_SAMPLES, &sample, PATIENCE);
    }
    free(values);
    return true;
}
