/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/key_map.h"

#include <stdlib.h>
#include <string.h>

static struct key_node **bucket(const struct key_map *map, struct digest key)
{
    /* keys may be small numbers or ids with equal ends, so all of their bits are mixed */
    uint64_t mixed = (key.first ^ key.second * 0x9e3779b97f4a7c15u) * 0xff51afd7ed558ccdu;
    return &map->buckets[(mixed ^ mixed >> 32) & map->mask];
}

bool key_map_create(struct key_map *map, size_t expected)
{
    size_t count = 16;
    while (count < expected)
        count *= 2;
    *map = (struct key_map){.buckets = calloc(count, sizeof(struct key_node *)), .mask = count - 1};
    return map->buckets != NULL;
}

void key_map_release(struct key_map *map)
{
    free(map->buckets);
    *map = (struct key_map){0};
}

struct key_node *key_map_find(const struct key_map *map, struct digest key)
{
    struct key_node *node = *bucket(map, key);
    while (node && (node->key.first != key.first || node->key.second != key.second))
        node = node->next;
    return node;
}

static void link_in(struct key_map *map, struct key_node *node)
{
    struct key_node **head = bucket(map, node->key);
    node->next = *head;
    *head = node;
    map->count++;
}

/* Twice the buckets; without memory for them the chains just get longer. */
static void grow(struct key_map *map)
{
    size_t count = 2 * (map->mask + 1);
    struct key_map larger = {.buckets = calloc(count, sizeof(struct key_node *)),
                             .mask = count - 1};
    if (!larger.buckets)
        return;
    for (size_t i = 0; i <= map->mask; i++) {
        struct key_node *next;
        for (struct key_node *node = map->buckets[i]; node; node = next) {
            next = node->next;
            link_in(&larger, node);
        }
    }
    free(map->buckets);
    *map = larger;
}

void key_map_insert(struct key_map *map, struct key_node *node)
{
    if (map->count > map->mask)
        grow(map);
    link_in(map, node);
}

void key_map_remove(struct key_map *map, struct key_node *node)
{
    struct key_node **link = bucket(map, node->key);
    while (*link != node)
        link = &(*link)->next;
    *link = node->next;
    map->count--;
}

struct digest digest_of_octets(const uint8_t octets[16])
{
    struct digest key;
    memcpy(&key, octets, sizeof key);
    return key;
}
