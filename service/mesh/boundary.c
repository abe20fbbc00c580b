/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/boundary.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/joined.h"

/* faces of the elements in Gmsh's order of nodes, outward: corners, mid nodes, middle */
static const unsigned char TET_FACES[4][6] = {
    {0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 9, 7}, {1, 2, 3, 5, 8, 9}, {0, 3, 2, 7, 8, 6}};
static const unsigned char HEX_FACES[6][9] = {
    {0, 3, 2, 1, 9, 13, 11, 8, 20},   {4, 5, 6, 7, 16, 18, 19, 17, 25},
    {0, 1, 5, 4, 8, 12, 16, 10, 21},  {1, 2, 6, 5, 11, 14, 18, 12, 23},
    {2, 3, 7, 6, 13, 15, 19, 14, 24}, {3, 0, 4, 7, 9, 10, 17, 15, 22}};

/* one face of an element, found again by its corners in ascending order */
struct entry {
    size_t corners[4]; /* SIZE_MAX for the fourth one of a triangle */
    size_t element;
    unsigned char face;
};

static int face_number(enum element_type type)
{
    return type == ELEMENT_TET10 ? 4 : 6;
}

static void fill_face(const struct solid_mesh *mesh, size_t element, int index,
                      struct surface_face *face)
{
    enum element_type type = mesh->types[element];
    const size_t *nodes = mesh->nodes + mesh->first[element];
    memset(face, 0, sizeof *face);
    face->count = type == ELEMENT_TET10   ? FACE_TRIANGLE6
                  : type == ELEMENT_HEX20 ? FACE_QUAD8
                                          : FACE_QUAD9;
    const unsigned char *local = type == ELEMENT_TET10 ? TET_FACES[index] : HEX_FACES[index];
    for (int i = 0; i < face->count; i++)
        face->nodes[i] = nodes[local[i]];
    face->element = element;
    face->part = mesh->parts[element];
}

static struct entry make_entry(const struct solid_mesh *mesh, size_t element, int index)
{
    struct surface_face face;
    fill_face(mesh, element, index, &face);
    struct entry entry = {{SIZE_MAX, SIZE_MAX, SIZE_MAX, SIZE_MAX}, element, (unsigned char)index};
    int corners = face.count == FACE_TRIANGLE6 ? 3 : 4;
    for (int i = 0; i < corners; i++) {
        int at = i;
        for (; at > 0 && entry.corners[at - 1] > face.nodes[i]; at--)
            entry.corners[at] = entry.corners[at - 1];
        entry.corners[at] = face.nodes[i];
    }
    return entry;
}

static int compare_corners(const struct entry *a, const struct entry *b)
{
    for (int i = 0; i < 4; i++)
        if (a->corners[i] != b->corners[i])
            return a->corners[i] < b->corners[i] ? -1 : 1;
    return 0;
}

static int compare(const void *left, const void *right)
{
    const struct entry *a = left, *b = right;
    int order = compare_corners(a, b);
    if (order)
        return order;
    return a->element != b->element ? (a->element < b->element ? -1 : 1) : a->face - b->face;
}

static int compare_places(const void *left, const void *right)
{
    const struct surface_face *a = left, *b = right;
    return a->element < b->element ? -1 : a->element > b->element;
}

/* two elements that share corners share the mid nodes of the edges too: else the body is cut there
 */
static enum percuss_status check_pair(const struct solid_mesh *mesh, const struct entry *pair,
                                      struct fault *fault)
{
    struct surface_face a, b;
    fill_face(mesh, pair[0].element, pair[0].face, &a);
    fill_face(mesh, pair[1].element, pair[1].face, &b);
    for (int i = 0; i < a.count; i++) {
        bool found = false;
        for (int j = 0; j < b.count; j++)
            found = found || a.nodes[i] == b.nodes[j];
        if (!found || a.count != b.count)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "elements %zu and %zu share the corners of a face but not its mid "
                             "nodes (node %zu): must be one conforming mesh of second order",
                             mesh->element_labels[a.element], mesh->element_labels[b.element],
                             mesh->labels[a.nodes[i]]);
    }
    return PERCUSS_OK;
}

/* keeps those that stand alone among the sorted entries */
static enum percuss_status pick(const struct solid_mesh *mesh, const struct entry *entries,
                                size_t count, struct surface_face *faces, size_t *kept,
                                struct fault *fault)
{
    *kept = 0;
    for (size_t i = 0, n; i < count; i += n) {
        for (n = 1; i + n < count && compare_corners(&entries[i], &entries[i + n]) == 0;)
            n++;
        if (n == 1)
            fill_face(mesh, entries[i].element, entries[i].face, &faces[(*kept)++]);
        else if (n > 2)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "elements %zu, %zu and %zu share one face: elements must not overlap "
                             "(is the part in the file twice?)",
                             mesh->element_labels[entries[i].element],
                             mesh->element_labels[entries[i + 1].element],
                             mesh->element_labels[entries[i + 2].element]);
        else if (check_pair(mesh, &entries[i], fault) != PERCUSS_OK)
            return PERCUSS_BAD_REQUEST;
    }
    return PERCUSS_OK;
}

/* the faces of all elements, those with the same corners beside each other; NULL: out of memory */
static struct entry *sorted_faces(const struct solid_mesh *mesh, size_t *total, struct fault *fault)
{
    *total = 0;
    for (size_t e = 0; e < mesh->element_count; e++)
        *total += (size_t)face_number(mesh->types[e]);
    struct entry *entries = malloc((*total + 1) * sizeof *entries);
    if (!entries) {
        fault_set(fault, PERCUSS_INTERNAL, "%zu faces: out of memory", *total);
        return NULL;
    }
    size_t filled = 0;
    for (size_t e = 0; e < mesh->element_count; e++)
        for (int i = 0; i < face_number(mesh->types[e]); i++)
            entries[filled++] = make_entry(mesh, e, i);
    qsort(entries, *total, sizeof *entries, compare);
    return entries;
}

enum percuss_status boundary_faces(const struct solid_mesh *mesh, struct surface_face **faces,
                                   size_t *count, struct fault *fault)
{
    size_t total;
    struct entry *entries = sorted_faces(mesh, &total, fault);
    if (!entries)
        return PERCUSS_INTERNAL;

    /* how many there will be at most: those alone */
    size_t alone = 0;
    for (size_t i = 0; i < total; i++)
        alone += (i == 0 || compare_corners(&entries[i - 1], &entries[i]) != 0) &&
                 (i + 1 == total || compare_corners(&entries[i], &entries[i + 1]) != 0);
    *faces = malloc((alone + 1) * sizeof **faces);
    enum percuss_status status =
        *faces ? pick(mesh, entries, total, *faces, count, fault)
               : fault_set(fault, PERCUSS_INTERNAL, "%zu faces: out of memory", alone);
    free(entries);
    if (status != PERCUSS_OK) {
        free(*faces);
        *faces = NULL;
        *count = 0;
        return status;
    }
    qsort(*faces, *count, sizeof **faces, compare_places);
    return PERCUSS_OK;
}

enum percuss_status boundary_join(const struct solid_mesh *mesh, size_t *parent,
                                  struct fault *fault)
{
    size_t total;
    struct entry *entries = sorted_faces(mesh, &total, fault);
    if (!entries)
        return PERCUSS_INTERNAL;
    joined_begin(parent, mesh->element_count);
    for (size_t i = 1; i < total; i++)
        if (compare_corners(&entries[i - 1], &entries[i]) == 0)
            joined_unite(parent, entries[i - 1].element, entries[i].element);
    free(entries);
    return PERCUSS_OK;
}
