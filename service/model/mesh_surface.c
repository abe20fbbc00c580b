/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/mesh_surface.h"

#include <math.h>
#include <string.h>

#include "model/facet.h"
#include "model/vector.h"

/* Deep enough for 2^40 faces. */
enum { MOST_DEPTH = 64 };
/* Close to a face: within a tenth of its size, where the nearest place is the only foot but on
 * faces as round as they are long. Converged to what is left of a micrometre on a metre. */
enum { QUICK_STEPS = 8 };
static const double QUICK_NEAR = 0.01;
static const double QUICK_SETTLED = 1e-10;
/* Share of a face's shape function below which a node does not count. */
static const double NO_SHARE = 1e-9;

static double box_distance(const struct mesh_box *box, const double p[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        double out = fmax(fmax(box->low[k] - p[k], p[k] - box->high[k]), 0.0);
        sum += out * out;
    }
    return sqrt(sum);
}

static void face_points(const struct mesh_body *body, const struct mesh_body_face *face,
                        double points[FACET_MOST_NODES][3])
{
    for (int i = 0; i < face->count; i++)
        memcpy(points[i], body->points[face->nodes[i]], sizeof points[i]);
}

/* What the face's points and derivatives add up to. */
static void combine(int count, double points[FACET_MOST_NODES][3], const double *weights,
                    double sum[3])
{
    sum[0] = sum[1] = sum[2] = 0.0;
    for (int i = 0; i < count; i++)
        add_scaled3(weights[i], points[i], sum);
}

static bool is_well_inside(int count, double u, double v)
{
    const double margin = 1e-3;
    if (count == 6)
        return u > margin && v > margin && u + v < 1.0 - margin;
    return fabs(u) < 1.0 - margin && fabs(v) < 1.0 - margin;
}

/* The foot of a point that is close to a face and above its inside, as most are: Gauss and Newton
 * from its middle. False: it is none such, or the steps do not settle. */
static bool find_quickly(int count, double points[FACET_MOST_NODES][3], const double p[3],
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
            return foot->distance * foot->distance < QUICK_NEAR * (a + c) &&
                   is_well_inside(count, foot->u, foot->v);
        }
        /* on, unless the step has left the face */
        foot->u += su;
        foot->v += sv;
        if (!(fabs(foot->u) < 2.0 && fabs(foot->v) < 2.0))
            return false;
    }
    return false;
}

static struct facet_foot foot_on(const struct mesh_body *body, unsigned face, const double p[3])
{
    double points[FACET_MOST_NODES][3];
    struct facet_foot foot;
    face_points(body, &body->faces[face], points);
    if (find_quickly(body->faces[face].count, points, p, &foot))
        return foot;
    return facet_closest(body->faces[face].count, (const double(*)[3])points, p);
}

/* The places found so far, by distance: one for each patch. */
struct finding {
    const struct mesh_body *body;
    const double *p;
    struct mesh_place *places;
    int count, most;
    double within; /* nothing farther is looked for */
};

static void place_set(struct mesh_place *place, unsigned face, const struct facet_foot *foot)
{
    *place =
        (struct mesh_place){.face = face, .u = foot->u, .v = foot->v, .distance = foot->distance};
    memcpy(place->point, foot->point, sizeof place->point);
}

static void take_face(struct finding *finding, unsigned face)
{
    struct facet_foot foot = foot_on(finding->body, face, finding->p);
    unsigned patch = finding->body->faces[face].patch;
    if (!(foot.distance <= finding->within))
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
    if (!fresh && !(foot.distance < finding->places[at].distance))
        return;
    place_set(&finding->places[at], face, &foot);
    /* kept by distance */
    for (; at > 0 && finding->places[at].distance < finding->places[at - 1].distance; at--) {
        struct mesh_place swap = finding->places[at];
        finding->places[at] = finding->places[at - 1];
        finding->places[at - 1] = swap;
    }
    if (finding->count == finding->most)
        finding->within = fmin(finding->within, finding->places[finding->count - 1].distance);
}

/* From the root down, the nearer box first. */
static void search(struct finding *finding)
{
    const struct mesh_box *boxes = finding->body->boxes;
    unsigned stack[MOST_DEPTH];
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        /* too far: holds nothing nearer */
        const struct mesh_box *box = &boxes[stack[--depth]];
        if (box_distance(box, finding->p) > finding->within)
            continue;
        /* a leaf: its faces */
        for (unsigned i = 0; i < box->count; i++)
            take_face(finding, finding->body->order[box->first + i]);
        if (box->count > 0 || depth + 2 > MOST_DEPTH)
            continue;
        /* two parts: the nearer comes next */
        unsigned near = box->first, far = box->first + 1;
        if (box_distance(&boxes[far], finding->p) < box_distance(&boxes[near], finding->p)) {
            near++;
            far--;
        }
        stack[depth++] = far;
        stack[depth++] = near;
    }
}

static double rim_distance(const struct mesh_rim *rim, const double p[3])
{
    double along[3];
    double from[3];
    for (int k = 0; k < 3; k++) {
        along[k] = (double)rim->to[k] - (double)rim->from[k];
        from[k] = p[k] - (double)rim->from[k];
    }
    double length2 = dot3(along, along);
    double t = length2 > 0.0 ? fmin(fmax(dot3(from, along) / length2, 0.0), 1.0) : 0.0;
    add_scaled3(-t, along, from);
    return norm3(from);
}

static double distance_to_rim(const struct mesh_body *body, unsigned patch, const double p[3])
{
    double nearest = INFINITY;
    for (size_t i = body->rim_first[patch]; i < body->rim_first[patch + 1]; i++)
        nearest = fmin(nearest, rim_distance(&body->rims[i], p));
    return nearest;
}

int mesh_surface_find(const struct mesh_body *body, const double p[3], double beside,
                      struct mesh_place *places, int most)
{
    /* the nearest of all */
    struct finding finding = {body, p, places, 0, 1, INFINITY};
    search(&finding);
    if (finding.count == 0)
        return 0;
    places[0].to_rim = distance_to_rim(body, body->faces[places[0].face].patch, places[0].point);
    if (places[0].to_rim > beside || most < 2)
        return 1;
    /* near an edge: those of other patches too */
    finding.most = most;
    finding.within = places[0].distance + beside;
    search(&finding);
    for (int i = 0; i < finding.count; i++)
        places[i].to_rim =
            distance_to_rim(body, body->faces[places[i].face].patch, places[i].point);
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

/* The tensor without what it has along the normal: interpolation turns the normal a little. */
static void lay_across(const double n[3], double curvature[9])
{
    double image[3];
    rotate3(curvature, n, image);
    double along = dot3(n, image);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            curvature[3 * i + j] += n[i] * n[j] * along - n[i] * image[j] - image[i] * n[j];
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
        }
    }
    /* a unit normal, and a tensor across it: xx yy zz xy yz zx */
    static const int PLACES[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    double length = norm3(spot.normal);
    scale3(length > 0.0 ? 1.0 / length : 0.0, spot.normal, spot.normal);
    for (int k = 0; k < 9; k++)
        spot.curvature[k] = tensor[PLACES[k]];
    lay_across(spot.normal, spot.curvature);
    return spot;
}
