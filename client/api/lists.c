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

enum { FIRST_PAIRS = 16 };

struct lists_bodies lists_begin_bodies(size_t most)
{
    struct lists_bodies made = {.list.bodies = calloc(most + 1, sizeof *made.list.bodies)};
    made.failed = !made.list.bodies;
    return made;
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

/* Bodies of one material have the same pairs. */
static void sort_pairs(struct percuss_body_list *list)
{
    struct percuss_material_pair *pairs = list->pairs;
    if (list->pair_count == 0)
        return;
    qsort(pairs, list->pair_count, sizeof *pairs, by_materials);
    size_t last = 0;
    for (size_t i = 1; i < list->pair_count; i++)
        if (by_materials(&pairs[last], &pairs[i]) != 0)
            pairs[++last] = pairs[i];
    list->pair_count = last + 1;
}

/* Room for one more pair: by those that stand twice, if that makes half of it, or twice as much. */
static bool make_room(struct lists_bodies *made)
{
    struct percuss_body_list *list = &made->list;
    if (list->pair_count < made->pair_room)
        return true;
    sort_pairs(list);
    if (made->pair_room > 0 && list->pair_count <= made->pair_room / 2)
        return true;
    size_t room = made->pair_room > 0 ? 2 * made->pair_room : FIRST_PAIRS;
    struct percuss_material_pair *pairs = realloc(list->pairs, room * sizeof *pairs);
    if (!pairs)
        return false;
    list->pairs = pairs;
    made->pair_room = room;
    return true;
}

void lists_add_body(struct lists_bodies *made, const percuss_v1_Body *wire)
{
    struct percuss_body_list *list = &made->list;
    if (made->failed)
        return;
    if (list->count == 0)
        memcpy(list->catalogue_revision, wire->catalogue_revision, sizeof list->catalogue_revision);
    made->mixed = made->mixed || strcmp(list->catalogue_revision, wire->catalogue_revision) != 0;
    convert_announced_body(wire, &list->bodies[list->count++]);
    for (uint32_t i = 0; i < wire->pairs._length && !made->failed; i++) {
        made->failed = !make_room(made);
        if (!made->failed)
            convert_announced_pair(&wire->pairs._buffer[i], &list->pairs[list->pair_count++]);
    }
}

enum percuss_result lists_end_bodies(struct lists_bodies *made, struct percuss_body_list *list)
{
    *list = made->list;
    if (made->failed) {
        percuss_body_list_free(list);
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a list of bodies");
    }
    qsort(list->bodies, list->count, sizeof *list->bodies, by_id);
    sort_pairs(list);
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
