/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/mesh_surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/facet.h"
#include "model/vector.h"

/* Deep enough for 2^40 faces. */
enum { MOST_DEPTH = 64 };
/* Faces around a node, and further ones with overlapping boxes. */
enum { MOST_LATER = 16 };
/* Close to a face: within a tenth of its size, where the nearest place is the only foot except on
 * faces as round as they are long. Smaller steps than QUICK_SETTLED have converged, to less than a
 * micrometre on a metre; a foot beyond an edge by less than QUICK_RIM is on it. */
enum { QUICK_STEPS = 8 };
static const double QUICK_NEAR = 0.01;
static const double QUICK_SETTLED = 1e-10;
static const double QUICK_RIM = 1e-9;
/* A place as near as this is on the surface, in sizes of the body. */
static const double ENOUGH = 1e-12;
/* Share of a face's shape function below which a node does not count. */
static const double NO_SHARE = 1e-9;

/* Squared; 0 inside. */
static double box_distance2(const struct mesh_box *box, const double p[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        double below = (double)box->low[k] - p[k], above = p[k] - (double)box->high[k];
        double out = below > above ? below : above;
        sum += out > 0.0 ? out * out : 0.0;
    }
    return sum;
}

static void face_points(const struct mesh_body *body, const struct mesh_body_face *face,
                        double points[FACET_MOST_NODES][3])
{
    for (int i = 0; i < face->count; i++)
        memcpy(points[i], body->points[face->nodes[i]], sizeof points[i]);
}

/* Weighted sum of the face's points. */
static void combine(int count, double points[FACET_MOST_NODES][3], const double *weights,
                    double sum[3])
{
    sum[0] = sum[1] = sum[2] = 0.0;
    for (int i = 0; i < count; i++)
        add_scaled3(weights[i], points[i], sum);
}

/* Position of a point relative to a face after a few steps. */
enum nearness { ABOVE, BESIDE, UNKNOWN };

/* Moves (u, v), which is outside, to the nearest place of the face in local coordinates. True: that
 * is on an edge with the direction `way`; false: a corner. */
static bool pull_inside(int count, double at[2], double way[2])
{
    double u = at[0], v = at[1];
    way[0] = way[1] = 0.0;
    if (count == 6 && u + v > 1.0) {
        double over = 0.5 * (u + v - 1.0);
        at[0] = fmin(fmax(u - over, 0.0), 1.0);
        at[1] = 1.0 - at[0];
        way[0] = 1.0;
        way[1] = -1.0;
        return at[0] > 0.0 && at[1] > 0.0;
    }
    double low = count == 6 ? 0.0 : -1.0;
    at[0] = fmin(fmax(u, low), 1.0);
    at[1] = fmin(fmax(v, low), 1.0);
    way[0] = at[0] == u;
    way[1] = at[1] == v;
    return at[0] == u || at[1] == v;
}

/* The foot of a point that is close to a face and above it, the usual case, by Gauss-Newton steps
 * from the middle. BESIDE: the foot on the continued face is beyond its edge, at (u, v). */
static enum nearness find_quickly(int count, double points[FACET_MOST_NODES][3], const double p[3],
                                  struct facet_foot *foot)
{
    double n[FACET_MOST_NODES], du[FACET_MOST_NODES], dv[FACET_MOST_NODES];
    double r[3], xu[3], xv[3];
    /* from the middle */
    foot->u = foot->v = count == 6 ? 1.0 / 3.0 : 0.0;
    for (int step = 0; step < QUICK_STEPS; step++) {
        /* the point there, and how far p is off along u and v */
        facet_shape(count, foot->u, foot->v, n, du, dv);
        combine(count, points, n, foot->point);
        combine(count, points, du, xu);
        combine(count, points, dv, xv);
        sub3(p, foot->point, r);
        /* least squares of the tangents */
        double a = dot3(xu, xu), b = dot3(xu, xv), c = dot3(xv, xv);
        double gu = dot3(r, xu), gv = dot3(r, xv), share = 1.0 / (a * c - b * b);
        double su = share * (c * gu - b * gv), sv = share * (a * gv - b * gu);
        /* settled: a foot if it lies near and well inside */
        if (fabs(su) + fabs(sv) < QUICK_SETTLED) {
            foot->distance = norm3(r);
            foot->at_rim = false;
            if (!facet_is_inside(count, foot->u, foot->v, QUICK_RIM))
                return BESIDE;
            return foot->distance * foot->distance < QUICK_NEAR * (a + c) ? ABOVE : UNKNOWN;
        }
        /* on, unless the step has left the face */
        foot->u += su;
        foot->v += sv;
        if (!(fabs(foot->u) < 2.0 && fabs(foot->v) < 2.0))
            return BESIDE;
    }
    return UNKNOWN;
}

/* Lower bound of p's distance from the face: the distance from a plane that has all control points,
 * and so the face, beyond it. The plane is normal to the way from p to the place of the edge
 * nearest to (u, v). */
static double bound_distance(const struct mesh_body_face *face, double points[FACET_MOST_NODES][3],
                             const double p[3], const struct facet_foot *foot)
{
    double n[FACET_MOST_NODES], du[FACET_MOST_NODES], dv[FACET_MOST_NODES], h[FACET_MOST_NODES];
    double at[2] = {foot->u, foot->v}, way[2], normal[3], xu[3], xv[3];
    if (!isfinite(at[0]) || !isfinite(at[1]))
        return 0.0;
    bool on_edge = pull_inside(face->count, at, way);
    facet_shape(face->count, at[0], at[1], n, du, dv);
    combine(face->count, points, n, normal);
    sub3(normal, p, normal);
    /* across the edge */
    if (on_edge) {
        double tangent[3] = {0.0, 0.0, 0.0};
        combine(face->count, points, du, xu);
        combine(face->count, points, dv, xv);
        add_scaled3(way[0], xu, tangent);
        add_scaled3(way[1], xv, tangent);
        add_scaled3(-dot3(normal, tangent) / dot3(tangent, tangent), tangent, normal);
    }
    double length = norm3(normal);
    if (!(length > 0.0))
        return 0.0;
    /* heights of the nodes, then of the control points */
    for (int i = 0; i < face->count; i++)
        h[i] = dot3(normal, points[i]);
    return (facet_lowest(face->count, h) - dot3(normal, p)) / length;
}

/* The places found so far, by distance: one for each patch. */
struct finding {
    const struct mesh_body *body;
    const double *p;
    struct mesh_place *places;
    int count, most;
    double within; /* farther places are not searched */
    double enough; /* the search ends with a place as near */
    /* faces with a lower bound of their distance: searched last, usually not at all */
    int later_count;
    unsigned later[MOST_LATER];
    double later_bound[MOST_LATER];
};

static void place_set(struct mesh_place *place, unsigned face, const struct facet_foot *foot)
{
    *place =
        (struct mesh_place){.face = face, .u = foot->u, .v = foot->v, .distance = foot->distance};
    memcpy(place->point, foot->point, sizeof place->point);
}

static void keep_foot(struct finding *finding, unsigned face, const struct facet_foot *foot)
{
    unsigned patch = finding->body->faces[face].patch;
    if (!(foot->distance <= finding->within))
        return;
    /* in the place of its patch, or of the farthest */
    int at = 0;
    while (at < finding->count && finding->body->faces[finding->places[at].face].patch != patch)
        at++;
    bool fresh = at == finding->count && finding->count < finding->most;
    if (fresh)
        finding->count++;
    else if (at == finding->count)
        at--;
    if (!fresh && !(foot->distance < finding->places[at].distance))
        return;
    place_set(&finding->places[at], face, foot);
    /* kept by distance */
    for (; at > 0 && finding->places[at].distance < finding->places[at - 1].distance; at--) {
        struct mesh_place swap = finding->places[at];
        finding->places[at] = finding->places[at - 1];
        finding->places[at - 1] = swap;
    }
    if (finding->count == finding->most)
        finding->within = fmin(finding->within, finding->places[finding->count - 1].distance);
}

/* The complete search of a face, where the quick one does not decide. */
static void look_closely(struct finding *finding, unsigned face)
{
    const struct mesh_body_face *at = &finding->body->faces[face];
    double points[FACET_MOST_NODES][3];
    face_points(finding->body, at, points);
    struct facet_foot foot = facet_closest(at->count, (const double(*)[3])points, finding->p);
    keep_foot(finding, face, &foot);
}

static void take_face(struct finding *finding, unsigned face)
{
    const struct mesh_body_face *at = &finding->body->faces[face];
    double points[FACET_MOST_NODES][3];
    struct facet_foot foot;
    face_points(finding->body, at, points);
    enum nearness nearness = find_quickly(at->count, points, finding->p, &foot);
    if (nearness == ABOVE) {
        keep_foot(finding, face, &foot);
        return;
    }
    double bound = nearness == BESIDE ? bound_distance(at, points, finding->p, &foot) : 0.0;
    if (bound > finding->within)
        return;
    if (finding->later_count < MOST_LATER) {
        finding->later[finding->later_count] = face;
        finding->later_bound[finding->later_count++] = bound;
    } else
        look_closely(finding, face);
}

/* The nearest first. */
static void take_later(struct finding *finding)
{
    while (finding->later_count > 0 && !(finding->within <= finding->enough)) {
        int first = 0, last = --finding->later_count;
        for (int i = 1; i <= last; i++)
            if (finding->later_bound[i] < finding->later_bound[first])
                first = i;
        if (finding->later_bound[first] <= finding->within)
            look_closely(finding, finding->later[first]);
        finding->later[first] = finding->later[last];
        finding->later_bound[first] = finding->later_bound[last];
    }
}

/* From the root down, the nearer box first: the faces with the point inside their boxes, or all
 * others. */
static void search_boxes(struct finding *finding, bool inside)
{
    const struct mesh_box *boxes = finding->body->boxes;
    struct {
        unsigned box;
        double distance2;
    } stack[MOST_DEPTH];
    int depth = 0;
    stack[depth].box = 0;
    stack[depth++].distance2 = box_distance2(&boxes[0], finding->p);
    while (depth > 0 && !(finding->within <= finding->enough)) {
        /* too far: holds nothing nearer */
        const struct mesh_box *box = &boxes[stack[--depth].box];
        double distance2 = stack[depth].distance2;
        double reach = inside ? 0.0 : finding->within;
        if (distance2 > reach * reach)
            continue;
        /* a leaf: its faces */
        for (unsigned i = 0; i < box->count && inside == (distance2 == 0.0); i++)
            take_face(finding, finding->body->order[box->first + i]);
        if (box->count > 0 || depth + 2 > MOST_DEPTH)
            continue;
        /* two parts: the nearer comes next */
        double first2 = box_distance2(&boxes[box->first], finding->p);
        double second2 = box_distance2(&boxes[box->first + 1], finding->p);
        unsigned nearer = second2 < first2;
        stack[depth].box = box->first + 1 - nearer;
        stack[depth++].distance2 = nearer ? first2 : second2;
        stack[depth].box = box->first + nearer;
        stack[depth++].distance2 = nearer ? second2 : first2;
    }
}

/* A point on the surface lies in the boxes of its faces: then no other face is near. */
static void surface_search(struct finding *finding)
{
    search_boxes(finding, true);
    search_boxes(finding, false);
    take_later(finding);
}

int mesh_surface_find(const struct mesh_body *body, const double p[3], double beside,
                      struct mesh_place *places, int most)
{
    /* the nearest of all */
    double size = fmax(body->high[0] - body->low[0],
                       fmax(body->high[1] - body->low[1], body->high[2] - body->low[2]));
    struct finding finding = {
        body, p, places, .most = 1, .within = INFINITY, .enough = ENOUGH * size};
    surface_search(&finding);
    if (finding.count == 0)
        return 0;
    places[0].to_rim =
        mesh_body_rim_distance(body, body->faces[places[0].face].patch, places[0].point);
    if (places[0].to_rim > beside || most < 2)
        return 1;
    /* near an edge: those of other patches too */
    finding.most = most;
    finding.enough = -1.0;
    finding.later_count = 0;
    finding.within = places[0].distance + beside;
    surface_search(&finding);
    for (int i = 0; i < finding.count; i++)
        places[i].to_rim =
            mesh_body_rim_distance(body, body->faces[places[i].face].patch, places[i].point);
    return finding.count;
}

double mesh_surface_face_size(const struct mesh_body *body, unsigned face)
{
    const struct mesh_body_face *at = &body->faces[face];
    int corners = at->count == 6 ? 3 : 4;
    double longest2 = 0.0;
    for (int i = 0; i < corners; i++) {
        double edge[3];
        sub3(body->points[at->nodes[i]], body->points[at->nodes[(i + 1) % corners]], edge);
        longest2 = fmax(longest2, dot3(edge, edge));
    }
    return sqrt(longest2);
}

/* Removes the tensor's part along the normal: interpolation turns the normal a little. */
static void tensor_lay_across(const double n[3], double curvature[9])
{
    double image[3];
    rotate3(curvature, n, image);
    double along = dot3(n, image);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            curvature[3 * i + j] += n[i] * n[j] * along - n[i] * image[j] - image[i] * n[j];
}

/* The flexibility of the added site there, if there is one. */
static void take_added(const struct mesh_body *body, unsigned face, const double *shape,
                       struct mesh_spot *spot)
{
    double points[FACET_MOST_NODES][3], point[3];
    face_points(body, &body->faces[face], points);
    combine(body->faces[face].count, points, shape, point);
    const struct mesh_body_site *site = mesh_body_added_at(body, face, point);
    spot->unsolved = !site;
    if (!site)
        return;
    spot->flexibility = site->flexibility;
    memcpy(spot->tensor, site->tensor, sizeof spot->tensor);
}

struct mesh_spot mesh_surface_at(const struct mesh_body *body, unsigned face, double u, double v)
{
    const struct mesh_body_face *at = &body->faces[face];
    double shape[FACET_MOST_NODES];
    double tensor[6] = {0.0};
    struct mesh_spot spot = {.doubt = 0.0};
    facet_shape(at->count, u, v, shape, NULL, NULL);
    /* of the nodes */
    for (int i = 0; i < at->count; i++) {
        for (int k = 0; k < 3; k++)
            spot.normal[k] += shape[i] * (double)at->normal[i][k];
        for (int k = 0; k < 6; k++)
            tensor[k] += shape[i] * (double)at->curvature[i][k];
        spot.doubt += fabs(shape[i]) * (double)at->doubt[i];
        if (fabs(shape[i]) > NO_SHARE) {
            spot.flexibility += shape[i] * at->flexibility[i];
            spot.slope += shape[i] * at->flexibility_slope[i];
            for (int k = 0; k < 6; k++)
                spot.tensor[k] += body->all_ways ? shape[i] * (double)at->tensor[i][k] : NAN;
        }
    }
    if (mesh_body_is_later(body))
        take_added(body, face, shape, &spot);
    /* a unit normal, and a tensor across it: xx yy zz xy yz zx */
    static const int PLACES[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    double length = norm3(spot.normal);
    scale3(length > 0.0 ? 1.0 / length : 0.0, spot.normal, spot.normal);
    for (int k = 0; k < 9; k++)
        spot.curvature[k] = tensor[PLACES[k]];
    tensor_lay_across(spot.normal, spot.curvature);
    mesh_body_set_normal(spot.normal, spot.flexibility, spot.tensor);
    return spot;
}

/* The tree of boxes and the sharp edges, which the search needs. */

enum { LEAF_FACES = 1 };

/* Two of the nodes that bound a face, and the third between them. */
struct edge {
    unsigned low, high; /* corners */
    unsigned middle;
    unsigned patch;
};

/* The control points of a quadratic curve a, m, b: it stays within the box of a, b and 2 m - (a +
 * b)/2 (Bernstein's form, a convex combination). */
static void edge_control(const double a[3], const double m[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; k++)
        c[k] = facet_control(a[k], m[k], b[k]);
}

/* Control points of the face: its corners, those of its edges, and that of a quadrilateral's
 * middle, from both middle lines in the same way. */
static int controls_of(const struct mesh_body *body, const struct mesh_body_face *face,
                       double points[FACET_MOST_NODES][3])
{
    int corners = face->count == 6 ? 3 : 4;
    double nodes[FACET_MOST_NODES][3];
    for (int i = 0; i < face->count; i++)
        memcpy(nodes[i], body->points[face->nodes[i]], sizeof nodes[i]);
    for (int i = 0; i < corners; i++) {
        memcpy(points[i], nodes[i], sizeof points[i]);
        edge_control(nodes[i], nodes[corners + i], nodes[(i + 1) % corners], points[corners + i]);
    }
    if (corners == 3)
        return 6;
    /* eight nodes: the middle one is interpolated from the others */
    for (int k = 0; face->count == 8 && k < 3; k++)
        nodes[8][k] = 0.5 * (nodes[4][k] + nodes[5][k] + nodes[6][k] + nodes[7][k]) -
                      0.25 * (nodes[0][k] + nodes[1][k] + nodes[2][k] + nodes[3][k]);
    /* along the middle line from edge 3 to edge 1, then across */
    double middle[3];
    edge_control(nodes[7], nodes[8], nodes[5], middle);
    edge_control(points[4], middle, points[6], points[8]);
    return 9;
}

static struct mesh_box box_of_face(const struct mesh_body *body, unsigned f)
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
        /* rounding to float */
        double pad = 1e-6 * fmax(fabs(low), fabs(high));
        box.low[k] = (float)(low - pad);
        box.high[k] = (float)(high + pad);
    }
    return box;
}

static void join_boxes(struct mesh_box *box, const struct mesh_box *other)
{
    for (int k = 0; k < 3; k++) {
        box->low[k] = fminf(box->low[k], other->low[k]);
        box->high[k] = fmaxf(box->high[k], other->high[k]);
    }
}

/* Context of the sort of faces by the middles of their boxes along an axis. */
struct box_order {
    const struct mesh_box *boxes;
    int axis;
};

static int by_middle(const void *a, const void *b, void *data)
{
    const struct box_order *order = data;
    const unsigned *x = a;
    const unsigned *y = b;
    float p = order->boxes[*x].low[order->axis] + order->boxes[*x].high[order->axis];
    float q = order->boxes[*y].low[order->axis] + order->boxes[*y].high[order->axis];
    return p < q ? -1 : p > q ? 1 : (*x > *y) - (*x < *y);
}

/* The box of faces order[first .. first + count), divided at the median along its longest side. */
static void divide_box(struct mesh_body *body, const struct mesh_box *boxes, unsigned at,
                       unsigned first, unsigned count)
{
    struct mesh_box box = boxes[body->order[first]];
    for (unsigned i = 1; i < count; i++)
        join_boxes(&box, &boxes[body->order[first + i]]);
    box.first = first;
    box.count = count;
    if (count > LEAF_FACES) {
        /* halves, side by side in the list */
        struct box_order order = {boxes, 0};
        for (int k = 1; k < 3; k++)
            if (box.high[k] - box.low[k] > box.high[order.axis] - box.low[order.axis])
                order.axis = k;
        qsort_r(body->order + first, count, sizeof *body->order, by_middle, &order);
        unsigned half = count / 2;
        unsigned next = (unsigned)body->box_count;
        body->box_count += 2;
        box.first = next;
        box.count = 0;
        divide_box(body, boxes, next, first, half);
        divide_box(body, boxes, next + 1, first + half, count - half);
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
        boxes[f] = box_of_face(body, f);
        body->order[f] = f;
    }
    body->box_count = 1;
    if (good)
        divide_box(body, boxes, 0, 0, count);
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
