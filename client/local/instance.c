/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "instance.h"

const uint8_t INSTANCE_SERVER[16] = "percuss in here";

uint64_t instance_draw_sequences(struct percuss_client *client, uint64_t wanted, size_t count)
{
    pthread_mutex_lock(&client->lock);
    uint64_t first = wanted ? wanted : client->next_sequence;
    if (first + count > client->next_sequence)
        client->next_sequence = first + count;
    pthread_mutex_unlock(&client->lock);
    return first;
}
