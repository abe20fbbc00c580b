/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The tree of boxes and the sharp edges of a surface. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/facet.h"
#include "model/mesh_surface.h"
#include "model/vector.h"

enum { LEAF_FACES = 1 };

/* Two of the nodes that bound a face, and the third between them. */
struct edge {
    unsigned low, high; /* corners */
    unsigned middle;
    unsigned patch;
};

/* The control points of a quadratic curve a, m, b: it stays within the box of a, b and 2 m - (a +
 * b)/2 (Bernstein's form, a convex combination). */
static void control(const double a[3], const double m[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; k++)
        c[k] = 2.0 * m[k] - 0.5 * (a[k] + b[k]);
}

/* Control points of the face: corners, of the edges, and of a quadrilateral's middle, which comes
 * of its two middle lines' as those of its edges do. */
static int controls_of(const struct mesh_body *body, const struct mesh_body_face *face,
                       double points[FACET_MOST_NODES][3])
{
    int corners = face->count == 6 ? 3 : 4;
    double nodes[FACET_MOST_NODES][3];
    for (int i = 0; i < face->count; i++)
        memcpy(nodes[i], body->points[face->nodes[i]], sizeof nodes[i]);
    for (int i = 0; i < corners; i++) {
        memcpy(points[i], nodes[i], sizeof points[i]);
        control(nodes[i], nodes[corners + i], nodes[(i + 1) % corners], points[corners + i]);
    }
    if (corners == 3)
        return 6;
    /* the middle node of eight is what the others make of it */
    for (int k = 0; face->count == 8 && k < 3; k++)
        nodes[8][k] = 0.5 * (nodes[4][k] + nodes[5][k] + nodes[6][k] + nodes[7][k]) -
                      0.25 * (nodes[0][k] + nodes[1][k] + nodes[2][k] + nodes[3][k]);
    /* along the middle line from edge 3 to edge 1, then across */
    double middle[3];
    control(nodes[7], nodes[8], nodes[5], middle);
    control(points[4], middle, points[6], points[8]);
    return 9;
}

static struct mesh_box face_box(const struct mesh_body *body, unsigned f)
{
    double points[FACET_MOST_NODES][3];
    int count = controls_of(body, &body->faces[f], points);
    struct mesh_box box = {.first = f, .count = 1};
    for (int k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (int i = 0; i < count; i++) {
            low = fmin(low, points[i][k]);
            high = fmax(high, points[i][k]);
        }
        /* what floats leave */
        double pad = 1e-6 * fmax(fabs(low), fabs(high));
        box.low[k] = (float)(low - pad);
        box.high[k] = (float)(high + pad);
    }
    return box;
}

static void join(struct mesh_box *box, const struct mesh_box *other)
{
    for (int k = 0; k < 3; k++) {
        box->low[k] = fminf(box->low[k], other->low[k]);
        box->high[k] = fmaxf(box->high[k], other->high[k]);
    }
}

/* What sorts faces by the middles of their boxes along an axis. */
struct order {
    const struct mesh_box *boxes;
    int axis;
};

static int by_middle(const void *a, const void *b, void *data)
{
    const struct order *order = data;
    const unsigned *x = a;
    const unsigned *y = b;
    float p = order->boxes[*x].low[order->axis] + order->boxes[*x].high[order->axis];
    float q = order->boxes[*y].low[order->axis] + order->boxes[*y].high[order->axis];
    return p < q ? -1 : p > q ? 1 : (*x > *y) - (*x < *y);
}

/* The box of faces order[first .. first + count), divided at the median along its longest side. */
static void divide(struct mesh_body *body, const struct mesh_box *boxes, unsigned at,
                   unsigned first, unsigned count)
{
    struct mesh_box box = boxes[body->order[first]];
    for (unsigned i = 1; i < count; i++)
        join(&box, &boxes[body->order[first + i]]);
    box.first = first;
    box.count = count;
    if (count > LEAF_FACES) {
        /* halves, side by side in the list */
        struct order order = {boxes, 0};
        for (int k = 1; k < 3; k++)
            if (box.high[k] - box.low[k] > box.high[order.axis] - box.low[order.axis])
                order.axis = k;
        qsort_r(body->order + first, count, sizeof *body->order, by_middle, &order);
        unsigned half = count / 2;
        unsigned next = (unsigned)body->box_count;
        body->box_count += 2;
        box.first = next;
        box.count = 0;
        divide(body, boxes, next, first, half);
        divide(body, boxes, next + 1, first + half, count - half);
    }
    body->boxes[at] = box;
}

static bool make_tree(struct mesh_body *body)
{
    unsigned count = (unsigned)body->face_count;
    struct mesh_box *boxes = malloc((count + 1) * sizeof *boxes);
    body->boxes = malloc(2 * ((size_t)count + 1) * sizeof *body->boxes);
    body->order = malloc((count + 1) * sizeof *body->order);
    bool good = boxes && body->boxes && body->order;
    for (unsigned f = 0; good && f < count; f++) {
        boxes[f] = face_box(body, f);
        body->order[f] = f;
    }
    body->box_count = 1;
    if (good)
        divide(body, boxes, 0, 0, count);
    free(boxes);
    return good;
}

static int by_corners(const void *a, const void *b)
{
    const struct edge *x = a;
    const struct edge *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    if (x->high != y->high)
        return x->high < y->high ? -1 : 1;
    return (x->patch > y->patch) - (x->patch < y->patch);
}

static int by_patch(const void *a, const void *b)
{
    const struct edge *x = a;
    const struct edge *y = b;
    return x->patch != y->patch ? (x->patch > y->patch) - (x->patch < y->patch) : by_corners(a, b);
}

static size_t list_edges(const struct mesh_body *body, struct edge *edges)
{
    size_t count = 0;
    for (size_t f = 0; f < body->face_count; f++) {
        const struct mesh_body_face *face = &body->faces[f];
        int corners = face->count == 6 ? 3 : 4;
        for (int i = 0; i < corners; i++) {
            unsigned a = face->nodes[i], b = face->nodes[(i + 1) % corners];
            edges[count++] = (struct edge){.low = a < b ? a : b,
                                           .high = a < b ? b : a,
                                           .middle = face->nodes[corners + i],
                                           .patch = face->patch};
        }
    }
    return count;
}

/* Keeps the edges that do not lie between two faces of one patch; their number. */
static size_t keep_sharp(struct edge *edges, size_t count)
{
    size_t kept = 0;
    qsort(edges, count, sizeof *edges, by_corners);
    for (size_t i = 0; i < count; i++) {
        bool inside = i + 1 < count && by_corners(&edges[i], &edges[i + 1]) == 0;
        if (inside)
            i++;
        else
            edges[kept++] = edges[i];
    }
    qsort(edges, kept, sizeof *edges, by_patch);
    return kept;
}

static struct mesh_rim rim_between(const struct mesh_body *body, unsigned a, unsigned b)
{
    struct mesh_rim rim;
    for (int k = 0; k < 3; k++) {
        rim.from[k] = (float)body->points[a][k];
        rim.to[k] = (float)body->points[b][k];
    }
    return rim;
}

static bool make_rims(struct mesh_body *body)
{
    struct edge *edges = malloc((4 * body->face_count + 1) * sizeof *edges);
    for (size_t f = 0; f < body->face_count; f++)
        if (body->faces[f].patch >= body->patch_count)
            body->patch_count = (size_t)body->faces[f].patch + 1;
    body->rim_first = calloc(body->patch_count + 1, sizeof *body->rim_first);
    size_t count = edges ? keep_sharp(edges, list_edges(body, edges)) : 0;
    body->rims = malloc((2 * count + 1) * sizeof *body->rims);
    bool good = edges && body->rim_first && body->rims;
    /* two chords of every curved edge, by patch */
    for (size_t i = 0; good && i < count; i++) {
        body->rims[2 * i] = rim_between(body, edges[i].low, edges[i].middle);
        body->rims[2 * i + 1] = rim_between(body, edges[i].middle, edges[i].high);
        body->rim_first[edges[i].patch + 1] = 2 * (i + 1);
    }
    for (size_t p = 0; good && p < body->patch_count; p++)
        if (body->rim_first[p + 1] < body->rim_first[p])
            body->rim_first[p + 1] = body->rim_first[p];
    free(edges);
    return good;
}

/* By Gauss's rule with a point in each quarter of a quadrilateral, or three of a triangle. */
static double face_area(const struct mesh_body *body, const struct mesh_body_face *face)
{
    static const double ROOT = 0.57735026918962576451; /* 1/sqrt(3) */
    const double triangle[3][2] = {{1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}};
    const double square[4][2] = {{-ROOT, -ROOT}, {ROOT, -ROOT}, {ROOT, ROOT}, {-ROOT, ROOT}};
    bool three = face->count == 6;
    double points[FACET_MOST_NODES][3];
    double sum = 0.0;
    for (int i = 0; i < face->count; i++)
        memcpy(points[i], body->points[face->nodes[i]], sizeof points[i]);
    for (int i = 0; i < (three ? 3 : 4); i++) {
        const double *at = three ? triangle[i] : square[i];
        double area[3];
        facet_place(face->count, (const double(*)[3])points, at[0], at[1], NULL, area);
        sum += norm3(area) / (three ? 6.0 : 1.0);
    }
    return sum;
}

bool mesh_surface_prepare(struct mesh_body *body)
{
    for (int k = 0; k < 3; k++) {
        body->low[k] = INFINITY;
        body->high[k] = -INFINITY;
    }
    body->area = 0.0;
    for (size_t f = 0; f < body->face_count; f++) {
        body->area += face_area(body, &body->faces[f]);
        for (int i = 0; i < body->faces[f].count; i++)
            for (int k = 0; k < 3; k++) {
                double x = body->points[body->faces[f].nodes[i]][k];
                body->low[k] = fmin(body->low[k], x);
                body->high[k] = fmax(body->high[k], x);
            }
    }
    return make_tree(body) && make_rims(body);
}
