/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/solid_mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

void solid_mesh_free(struct solid_mesh *mesh)
{
    free(mesh->points);
    free(mesh->labels);
    free(mesh->types);
    free(mesh->first);
    free(mesh->nodes);
    free(mesh->parts);
    free(mesh->element_labels);
    free(mesh->part);
    for (size_t i = 0; i < mesh->set_count; i++)
        free(mesh->set[i].nodes);
    free(mesh->set);
    free(mesh->masses);
    free(mesh->remarks);
    memset(mesh, 0, sizeof *mesh);
}

/* ---- sets by name ---- */

enum { FULL_NAME_SIZE = 3 * MESH_NAME_SIZE };

/* "SCOPE.NAME (KIND)", without what there is not. */
static void full_name(const struct mesh_set *set, const char *scope, bool kind,
                      char text[FULL_NAME_SIZE])
{
    snprintf(text, FULL_NAME_SIZE, "%s%s%s%s%s%s", scope, *scope ? "." : "", set->name,
             kind && set->kind ? " (" : "", kind && set->kind ? set->kind : "",
             kind && set->kind ? ")" : "");
}

static bool is_called(const struct mesh_set *set, const char *name)
{
    const char *scopes[] = {"", set->scope, set->instance};
    char text[FULL_NAME_SIZE];
    for (int i = 0; i < 6; i++) {
        full_name(set, scopes[i / 2], i % 2, text);
        if (strcasecmp(text, name) == 0)
            return true;
    }
    return false;
}

static bool same_nodes(const struct mesh_set *a, const struct mesh_set *b)
{
    return a->count == b->count && memcmp(a->nodes, b->nodes, a->count * sizeof *a->nodes) == 0;
}

/* All sets, or those of a name; not the ones that a program has made for itself (_NAME). */
static void list_sets(const struct solid_mesh *mesh, const char *name, char *list, size_t size)
{
    size_t filled = 0;
    for (size_t i = 0; i < mesh->set_count; i++) {
        const struct mesh_set *set = &mesh->set[i];
        char text[FULL_NAME_SIZE];
        if (name ? !is_called(set, name) : set->name[0] == '_')
            continue;
        full_name(set, set->scope, name != NULL, text);
        if (filled + strlen(text) + sizeof ", 1234567 nodes, ..." > size) {
            snprintf(list + filled, size - filled, ", ...");
            return;
        }
        filled += (size_t)snprintf(list + filled, size - filled, name ? "%s%s, %zu nodes" : "%s%s",
                                   filled ? (name ? "; " : ", ") : "", text, set->count);
    }
}

enum percuss_status solid_mesh_find_set(const struct solid_mesh *mesh, const char *name,
                                        size_t *index, struct fault *fault)
{
    char list[400] = "none";
    bool several = false;
    *index = mesh->set_count;
    for (size_t i = 0; i < mesh->set_count; i++) {
        if (!is_called(&mesh->set[i], name))
            continue;
        several =
            several || (*index < mesh->set_count && !same_nodes(&mesh->set[i], &mesh->set[*index]));
        *index = i;
    }
    if (*index < mesh->set_count && !several)
        return PERCUSS_OK;
    list_sets(mesh, several ? name : NULL, list, sizeof list);
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     several ? "%s: is the name of several sets: must be one of: %s"
                             : "%s: must be the name of a set of nodes: %s",
                     name, list);
}
