/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Look-up by 128-bit key. The nodes are members of stored structures; the map never owns them. */
#ifndef PERCUSS_EXCHANGE_KEY_MAP_H
#define PERCUSS_EXCHANGE_KEY_MAP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/hash.h"

/* The structure of type `type` that a node is the member `member` of. */
#define KEY_MAP_OWNER(node, type, member) ((type *)((char *)(node)-offsetof(type, member)))

struct key_node {
    struct digest key;
    struct key_node *next;
};

struct key_map {
    struct key_node **buckets;
    size_t mask, count;
};

/* Room for about `expected` nodes; with more it grows. False: out of memory. */
bool key_map_create(struct key_map *map, size_t expected);
void key_map_release(struct key_map *map);

/* The node of that key, or NULL. */
struct key_node *key_map_find(const struct key_map *map, struct digest key);

/* `node->key` must not be in the map. */
void key_map_insert(struct key_map *map, struct key_node *node);

/* `node` must be in the map. */
void key_map_remove(struct key_map *map, struct key_node *node);

/* A client id, or any other 16 octets, as a key. */
struct digest digest_of_octets(const uint8_t octets[16]);

#endif
