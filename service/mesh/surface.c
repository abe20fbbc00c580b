/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/surface.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/boundary.h"
#include "mesh/joined.h"
#include "model/vector.h"

/* faces that turn by more at an edge do not continue each other: cos 35 degrees */
static const double SMOOTH_COSINE = 0.81915204428899180;

/* an edge of a face, found again by its corners */
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

static int corner_count(const struct surface_face *face)
{
    return face->count == FACE_TRIANGLE6 ? 3 : 4;
}

static void unit_normal(int count, double (*points)[3], double u, double v, double normal[3])
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
        int corners = corner_count(face);
        for (int i = 0; i < corners; i++) {
            size_t a = face->nodes[i], b = face->nodes[(i + 1) % corners];
            struct edge *edge = &edges[filled++];
            double u, v, way[3];
            facet_node(face->count, corners + i, &u, &v);
            unit_normal(face->count, points, u, v, edge->normal);
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

static int compare_numbers(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

/* joins faces that meet smoothly; where more than two meet in an edge the body only touches itself
 */
static void join(const struct edge *edges, size_t count, size_t *parent)
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
    /* each face brings all its edges */
    size_t count = 0;
    for (size_t f = 0; f < surface->face_count; f++)
        count += (size_t)corner_count(&surface->faces[f]);
    struct edge *edges = malloc(count * sizeof *edges);
    double *lengths = malloc(count * sizeof *lengths);
    size_t *parent = malloc(surface->face_count * sizeof *parent);
    enum percuss_status status = PERCUSS_OK;
    if (edges && lengths && parent) {
        /* the size: the median length */
        fill_edges(mesh, surface, edges);
        for (size_t i = 0; i < count; i++)
            lengths[i] = edges[i].length;
        qsort(lengths, count, sizeof *lengths, compare_numbers);
        surface->size = lengths[count / 2];

        /* faces that are joined across a smooth edge make a patch */
        joined_begin(parent, surface->face_count);
        qsort(edges, count, sizeof *edges, compare_edges);
        join(edges, count, parent);
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

/* A face lies within this distance of its nearest node: some edge of it. */
static double reach(int count, double (*points)[3])
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
        if (nearest_node(face->count, points, p) > bound + reach(face->count, points))
            continue;
        struct facet_foot foot = facet_closest(face->count, (const double(*)[3])points, p);
        if (foot.distance < best.foot.distance) {
            best.face = f;
            best.foot = foot;
            unit_normal(face->count, points, foot.u, foot.v, best.normal);
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
