/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/surface.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/joined.h"
#include "model/vector.h"

/* ---- boundary: the faces of elements that belong to one element only ---- */

/* faces of the elements in Gmsh's order of nodes, outward: corners, mid nodes, middle */
static const unsigned char TET_FACES[4][6] = {
    {0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 9, 7}, {1, 2, 3, 5, 8, 9}, {0, 3, 2, 7, 8, 6}};
static const unsigned char HEX_FACES[6][9] = {
    {0, 3, 2, 1, 9, 13, 11, 8, 20},   {4, 5, 6, 7, 16, 18, 19, 17, 25},
    {0, 1, 5, 4, 8, 12, 16, 10, 21},  {1, 2, 6, 5, 11, 14, 18, 12, 23},
    {2, 3, 7, 6, 13, 15, 19, 14, 24}, {3, 0, 4, 7, 9, 10, 17, 15, 22}};
/* the triangles have six nodes */
static const unsigned char WEDGE_FACES[5][8] = {{0, 2, 1, 7, 9, 6},
                                                {3, 4, 5, 12, 14, 13},
                                                {0, 1, 4, 3, 6, 10, 12, 8},
                                                {1, 2, 5, 4, 9, 11, 14, 10},
                                                {2, 0, 3, 5, 7, 8, 13, 11}};

/* one face of an element, sorted by its corners in ascending order */
struct entry {
    size_t corners[4]; /* SIZE_MAX for the fourth one of a triangle */
    size_t element;
    unsigned char face;
};

static int face_number(enum element_type type)
{
    return type == ELEMENT_TET10 ? 4 : type == ELEMENT_WEDGE15 ? 5 : 6;
}

/* Its nodes among those of the element; *count: of them. */
static const unsigned char *face_nodes(enum element_type type, int index, int *count)
{
    bool triangle = type == ELEMENT_TET10 || (type == ELEMENT_WEDGE15 && index < 2);
    *count = triangle ? FACE_TRIANGLE6 : type == ELEMENT_HEX27 ? FACE_QUAD9 : FACE_QUAD8;
    return type == ELEMENT_TET10     ? TET_FACES[index]
           : type == ELEMENT_WEDGE15 ? WEDGE_FACES[index]
                                     : HEX_FACES[index];
}

static void boundary_fill_face(const struct solid_mesh *mesh, size_t element, int index,
                               struct surface_face *face)
{
    enum element_type type = mesh->types[element];
    const size_t *nodes = mesh->nodes + mesh->first[element];
    memset(face, 0, sizeof *face);
    int count;
    const unsigned char *local = face_nodes(type, index, &count);
    face->count = count;
    for (int i = 0; i < face->count; i++)
        face->nodes[i] = nodes[local[i]];
    face->element = element;
    face->part = mesh->parts[element];
}

static struct entry make_entry(const struct solid_mesh *mesh, size_t element, int index)
{
    struct surface_face face;
    boundary_fill_face(mesh, element, index, &face);
    struct entry entry = {{SIZE_MAX, SIZE_MAX, SIZE_MAX, SIZE_MAX}, element, (unsigned char)index};
    int corners = surface_face_corners(&face);
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

static int compare_entries(const void *left, const void *right)
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

/* two elements that share corners must share the mid nodes of the edges: otherwise the body is cut
 * there */
static enum percuss_status check_pair(const struct solid_mesh *mesh, const struct entry *pair,
                                      struct fault *fault)
{
    struct surface_face a, b;
    boundary_fill_face(mesh, pair[0].element, pair[0].face, &a);
    boundary_fill_face(mesh, pair[1].element, pair[1].face, &b);
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

/* keeps unpaired faces of the sorted entries */
static enum percuss_status pick_boundary(const struct solid_mesh *mesh, const struct entry *entries,
                                         size_t count, struct surface_face *faces, size_t *kept,
                                         struct fault *fault)
{
    *kept = 0;
    for (size_t i = 0, n; i < count; i += n) {
        for (n = 1; i + n < count && compare_corners(&entries[i], &entries[i + n]) == 0;)
            n++;
        if (n == 1)
            boundary_fill_face(mesh, entries[i].element, entries[i].face, &faces[(*kept)++]);
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

/* the faces of all elements, sorted by corners; NULL: out of memory */
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
    qsort(entries, *total, sizeof *entries, compare_entries);
    return entries;
}

/* The faces that belong to one element only, in the order of elements, as an array to be freed;
 * patch 0. PERCUSS_BAD_REQUEST: three elements share a face, or two do with other mid nodes. */
static enum percuss_status boundary_faces(const struct solid_mesh *mesh,
                                          struct surface_face **faces, size_t *count,
                                          struct fault *fault)
{
    size_t total;
    struct entry *entries = sorted_faces(mesh, &total, fault);
    if (!entries)
        return PERCUSS_INTERNAL;

    /* their largest number: unpaired faces */
    size_t alone = 0;
    for (size_t i = 0; i < total; i++)
        alone += (i == 0 || compare_corners(&entries[i - 1], &entries[i]) != 0) &&
                 (i + 1 == total || compare_corners(&entries[i], &entries[i + 1]) != 0);
    *faces = malloc((alone + 1) * sizeof **faces);
    enum percuss_status status =
        *faces ? pick_boundary(mesh, entries, total, *faces, count, fault)
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

/* ---- patches ---- */

/* faces of one patch turn by less at an edge: cos 35 degrees */
static const double SMOOTH_COSINE = 0.81915204428899180;

/* an edge of a face, sorted by its corners */
struct edge {
    size_t low, high, face;
    double normal[3]; /* of the face at the middle of the edge */
    double length;
};

void surface_face_points(const struct solid_mesh *mesh, const struct surface_face *face,
                         double points[FACE_MOST_NODES][3])
{
    for (int i = 0; i < face->count; i++)
        memcpy(points[i], mesh->points[face->nodes[i]], sizeof points[i]);
}

static void surface_unit_normal(int count, double (*points)[3], double u, double v,
                                double normal[3])
{
    facet_place(count, (const double(*)[3])points, u, v, NULL, normal);
    double length = norm3(normal);
    scale3(length > 0.0 ? 1.0 / length : 0.0, normal, normal);
}

static void fill_edges(const struct solid_mesh *mesh, const struct surface *surface,
                       struct edge *edges)
{
    size_t filled = 0;
    for (size_t f = 0; f < surface->face_count; f++) {
        const struct surface_face *face = &surface->faces[f];
        double points[FACE_MOST_NODES][3];
        surface_face_points(mesh, face, points);
        int corners = surface_face_corners(face);
        for (int i = 0; i < corners; i++) {
            size_t a = face->nodes[i], b = face->nodes[(i + 1) % corners];
            struct edge *edge = &edges[filled++];
            double u, v, way[3];
            facet_node(face->count, corners + i, &u, &v);
            surface_unit_normal(face->count, points, u, v, edge->normal);
            sub3(mesh->points[a], mesh->points[b], way);
            edge->length = norm3(way);
            edge->low = a < b ? a : b;
            edge->high = a < b ? b : a;
            edge->face = f;
        }
    }
}

static int compare_edges(const void *left, const void *right)
{
    const struct edge *a = left, *b = right;
    if (a->low != b->low)
        return a->low < b->low ? -1 : 1;
    if (a->high != b->high)
        return a->high < b->high ? -1 : 1;
    return a->face < b->face ? -1 : a->face > b->face;
}

static int compare_lengths(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

/* joins faces that meet smoothly; where more than two meet in an edge the body touches itself */
static void join_smooth(const struct edge *edges, size_t count, size_t *parent)
{
    for (size_t i = 0, n; i < count; i += n) {
        for (n = 1; i + n < count && edges[i].low == edges[i + n].low &&
                    edges[i].high == edges[i + n].high;)
            n++;
        if (n != 2 || !(dot3(edges[i].normal, edges[i + 1].normal) >= SMOOTH_COSINE))
            continue;
        joined_unite(parent, edges[i].face, edges[i + 1].face);
    }
}

/* numbers the patches by their first faces */
static void number_patches(struct surface *surface, size_t *parent)
{
    surface->patch_count = 0;
    for (size_t f = 0; f < surface->face_count; f++) {
        size_t root = joined_root(parent, f);
        surface->faces[f].patch = root == f ? surface->patch_count++ : surface->faces[root].patch;
    }
}

/* cuts the surface into patches and measures its edges */
static enum percuss_status make_patches(const struct solid_mesh *mesh, struct surface *surface,
                                        struct fault *fault)
{
    /* an edge appears once for each of its faces */
    size_t count = 0;
    for (size_t f = 0; f < surface->face_count; f++)
        count += (size_t)surface_face_corners(&surface->faces[f]);
    struct edge *edges = malloc(count * sizeof *edges);
    double *lengths = malloc(count * sizeof *lengths);
    size_t *parent = malloc(surface->face_count * sizeof *parent);
    enum percuss_status status = PERCUSS_OK;
    if (edges && lengths && parent) {
        /* the size: the median length */
        fill_edges(mesh, surface, edges);
        for (size_t i = 0; i < count; i++)
            lengths[i] = edges[i].length;
        qsort(lengths, count, sizeof *lengths, compare_lengths);
        surface->size = lengths[count / 2];

        /* faces joined across smooth edges make a patch */
        joined_begin(parent, surface->face_count);
        qsort(edges, count, sizeof *edges, compare_edges);
        join_smooth(edges, count, parent);
        number_patches(surface, parent);
    } else {
        status = fault_set(fault, PERCUSS_INTERNAL, "surface of %zu faces: out of memory",
                           surface->face_count);
    }
    free(edges);
    free(lengths);
    free(parent);
    return status;
}

enum percuss_status surface_make(const struct solid_mesh *mesh, struct surface *surface,
                                 struct fault *fault)
{
    memset(surface, 0, sizeof *surface);
    enum percuss_status status = boundary_faces(mesh, &surface->faces, &surface->face_count, fault);
    if (status == PERCUSS_OK && surface->face_count == 0)
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "elements: 0: a mesh must have some");
    if (status == PERCUSS_OK)
        status = make_patches(mesh, surface, fault);
    if (status != PERCUSS_OK)
        surface_free(surface);
    return status;
}

/* Every point of a face lies within this distance of its nearest node. */
static double face_reach(int count, double (*points)[3])
{
    double longest = 0.0, way[3];
    for (int i = 1; i < count; i++) {
        sub3(points[i], points[0], way);
        longest = fmax(longest, norm3(way));
    }
    return longest;
}

static double nearest_node(int count, double (*points)[3], const double p[3])
{
    double nearest = INFINITY, way[3];
    for (int i = 0; i < count; i++) {
        sub3(points[i], p, way);
        nearest = fmin(nearest, norm3(way));
    }
    return nearest;
}

struct surface_place surface_near(const struct solid_mesh *mesh, const struct surface *surface,
                                  const double p[3])
{
    double points[FACE_MOST_NODES][3], bound = INFINITY;
    struct surface_place best = {.face = 0, .foot.distance = INFINITY};

    /* no face farther than the nearest node can be the nearest */
    for (size_t f = 0; f < surface->face_count; f++) {
        surface_face_points(mesh, &surface->faces[f], points);
        bound = fmin(bound, nearest_node(surface->faces[f].count, points, p));
    }
    for (size_t f = 0; f < surface->face_count; f++) {
        const struct surface_face *face = &surface->faces[f];
        surface_face_points(mesh, face, points);
        if (nearest_node(face->count, points, p) > bound + face_reach(face->count, points))
            continue;
        struct facet_foot foot = facet_closest(face->count, (const double(*)[3])points, p);
        if (foot.distance < best.foot.distance) {
            best.face = f;
            best.foot = foot;
            surface_unit_normal(face->count, points, foot.u, foot.v, best.normal);
        }
    }
    return best;
}

void surface_free(struct surface *surface)
{
    free(surface->faces);
    free(surface->points);
    memset(surface, 0, sizeof *surface);
}
