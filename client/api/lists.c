/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The lists that clients hand out. */

#include <percuss/percuss.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "percuss/similar.h"

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
