/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/writer_queues.h"

#include <stdlib.h>
#include <sys/queue.h>

#include "exchange/key_map.h"

enum { EXPECTED_WRITERS = 64 };

struct queued_sample {
    STAILQ_ENTRY(queued_sample) next;
    void *sample;
};

/* The samples of one writer, at least one. */
struct writer_queue {
    struct key_node node; /* key: the writer */
    TAILQ_ENTRY(writer_queue) turn;
    STAILQ_HEAD(queued_samples, queued_sample) samples;
    size_t count;
};

struct writer_queues {
    size_t most;
    void (*release)(void *sample);
    struct key_map writers;
    TAILQ_HEAD(queue_turns, writer_queue) turns;
};

struct writer_queues *writer_queues_create(size_t most, void (*release)(void *sample))
{
    struct writer_queues *queues = calloc(1, sizeof *queues);
    if (!queues)
        return NULL;
    if (!key_map_create(&queues->writers, EXPECTED_WRITERS)) {
        free(queues);
        return NULL;
    }
    queues->most = most;
    queues->release = release;
    TAILQ_INIT(&queues->turns);
    return queues;
}

void writer_queues_free(struct writer_queues *queues)
{
    if (!queues)
        return;
    uint64_t writer;
    for (void *sample; (sample = writer_queues_take(queues, &writer));)
        queues->release(sample);
    key_map_release(&queues->writers);
    free(queues);
}

/* NULL: out of memory. */
static struct writer_queue *writer_queue_open(struct writer_queues *queues, uint64_t writer)
{
    struct digest key = {writer, 0};
    struct key_node *node = key_map_find(&queues->writers, key);
    if (node)
        return KEY_MAP_OWNER(node, struct writer_queue, node);
    struct writer_queue *queue = calloc(1, sizeof *queue);
    if (!queue)
        return NULL;
    queue->node.key = key;
    STAILQ_INIT(&queue->samples);
    key_map_insert(&queues->writers, &queue->node);
    TAILQ_INSERT_TAIL(&queues->turns, queue, turn);
    return queue;
}

static void writer_queue_drop_if_empty(struct writer_queues *queues, struct writer_queue *queue)
{
    if (queue->count > 0)
        return;
    key_map_remove(&queues->writers, &queue->node);
    TAILQ_REMOVE(&queues->turns, queue, turn);
    free(queue);
}

/* The oldest one. */
static void *writer_queue_take(struct writer_queue *queue)
{
    struct queued_sample *queued = STAILQ_FIRST(&queue->samples);
    void *sample = queued->sample;
    STAILQ_REMOVE_HEAD(&queue->samples, next);
    queue->count--;
    free(queued);
    return sample;
}

void writer_queues_put(struct writer_queues *queues, uint64_t writer, void *sample)
{
    struct queued_sample *queued = calloc(1, sizeof *queued);
    struct writer_queue *queue = queued ? writer_queue_open(queues, writer) : NULL;
    if (!queue) {
        free(queued);
        queues->release(sample);
        return;
    }
    queued->sample = sample;
    STAILQ_INSERT_TAIL(&queue->samples, queued, next);
    if (++queue->count > queues->most)
        queues->release(writer_queue_take(queue));
}

void *writer_queues_take(struct writer_queues *queues, uint64_t *writer)
{
    struct writer_queue *queue = TAILQ_FIRST(&queues->turns);
    if (!queue)
        return NULL;
    void *sample = writer_queue_take(queue);
    *writer = queue->node.key.first;
    TAILQ_REMOVE(&queues->turns, queue, turn);
    TAILQ_INSERT_TAIL(&queues->turns, queue, turn);
    writer_queue_drop_if_empty(queues, queue);
    return sample;
}

bool writer_queues_is_empty(const struct writer_queues *queues)
{
    return TAILQ_EMPTY(&queues->turns);
}
