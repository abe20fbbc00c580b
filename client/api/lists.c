/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The lists that clients hand out. */

#include <percuss/percuss.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "error.h"
#include "lists.h"
#include "percuss/similar.h"

bool lists_begin_bodies(struct percuss_body_list *list, size_t most)
{
    *list = (struct percuss_body_list){.bodies = calloc(most + 1, sizeof *list->bodies)};
    return list->bodies;
}

static bool has_pair(const struct percuss_body_list *list, const percuss_v1_MaterialPair *wire)
{
    for (size_t i = 0; i < list->pair_count; i++)
        if (strcmp(list->pairs[i].material_a, wire->material_a) == 0 &&
            strcmp(list->pairs[i].material_b, wire->material_b) == 0)
            return true;
    return false;
}

bool lists_add_body(struct percuss_body_list *list, const percuss_v1_Body *wire)
{
    convert_announced_body(wire, &list->bodies[list->count++]);
    /* bodies of one material have the same ones */
    for (uint32_t i = 0; i < wire->pairs._length; i++) {
        const percuss_v1_MaterialPair *pair = &wire->pairs._buffer[i];
        if (has_pair(list, pair))
            continue;
        struct percuss_material_pair *pairs =
            realloc(list->pairs, (list->pair_count + 1) * sizeof *pairs);
        if (!pairs)
            return false;
        list->pairs = pairs;
        convert_announced_pair(pair, &pairs[list->pair_count++]);
    }
    return true;
}

static int by_id(const void *left, const void *right)
{
    const struct percuss_body *a = left, *b = right;
    return strcmp(a->id, b->id);
}

static int by_materials(const void *left, const void *right)
{
    const struct percuss_material_pair *a = left, *b = right;
    int order = strcmp(a->material_a, b->material_a);
    return order ? order : strcmp(a->material_b, b->material_b);
}

enum percuss_result lists_end_bodies(struct percuss_body_list *list, bool whole)
{
    if (!whole) {
        percuss_body_list_free(list);
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a list of bodies");
    }
    qsort(list->bodies, list->count, sizeof *list->bodies, by_id);
    if (list->pairs)
        qsort(list->pairs, list->pair_count, sizeof *list->pairs, by_materials);
    return PERCUSS_RESULT_OK;
}

const struct percuss_body *percuss_body_find(const struct percuss_body_list *list, const char *id)
{
    if (ERROR_NULL(list, id) || (list->count > 0 && ERROR_NULL(list->bodies)))
        return NULL;
    for (size_t i = 0; i < list->count; i++)
        if (!strcmp(list->bodies[i].id, id))
            return &list->bodies[i];
    /* a slip of the fingers */
    struct similar similar = similar_to(id);
    for (size_t i = 0; i < list->count; i++)
        similar_offer(&similar, list->bodies[i].id);
    const char *nearest = similar.nearest;
    error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "id: '%.63s': no such body among %zu%s%s%s", id,
              list->count, nearest ? "; did you mean '" : "", nearest ? nearest : "",
              nearest ? "'?" : "");
    return NULL;
}

void percuss_body_list_free(struct percuss_body_list *list)
{
    if (!list)
        return;
    free(list->bodies);
    free(list->pairs);
    *list = (struct percuss_body_list){0};
}

void percuss_server_list_free(struct percuss_server_list *list)
{
    if (!list)
        return;
    for (size_t i = 0; list->servers && i < list->count; i++)
        free(list->servers[i].tasks);
    free(list->servers);
    *list = (struct percuss_server_list){0};
}

void percuss_specimen_list_free(struct percuss_specimen_list *list)
{
    if (!list)
        return;
    for (size_t i = 0; list->specimens && i < list->count; i++)
        free(list->specimens[i].dents);
    free(list->specimens);
    *list = (struct percuss_specimen_list){0};
}
