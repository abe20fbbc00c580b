/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/sites_spread.h"

#include <math.h>
#include <stdlib.h>

#include "base/watch.h"
#include "model/facet.h"
#include "model/vector.h"
#include "reduce/edge_fit.h"
#include "reduce/flexibility.h"

/* of the mesh's edges: nearer to a sharp edge the field is not known (site_choice.c's first row) */
static const double KNOWN_FROM = 0.3;
/* nodes nearer than this get values by fit: on the edge and in the middle of a face at it */
static const double FITTED_TO = 0.6;
/* how much a node's own value weighs beside one point of its face, where shape functions of the
 * order of 0.1 are what is fitted: it decides only where the points say nothing */
static const double OWN_WEIGHT = 1e-4;
/* how far a fit may move a value, times E and the distance from which on the field is known: what
 * an edge is worth there (0.27) ten times over, as at a corner where few points are known */
static const double MOST_MOVED = 3.0;

enum { GRID = 5 };

double sites_mean_curvature(const struct surface_point *point)
{
    return 0.5 * (point->curvature[0] + point->curvature[4] + point->curvature[8]);
}

/* points inside a face, in local coordinates */
static size_t grid_points(size_t count, double at[GRID * GRID][2])
{
    size_t filled = 0;
    for (size_t i = 0; i < GRID; i++)
        for (size_t j = 0; j < GRID; j++) {
            double a = ((double)i + 0.5) / GRID, b = ((double)j + 0.5) / GRID;
            bool triangle = count == FACE_TRIANGLE6;
            if (triangle && a + b > 1.0)
                continue;
            at[filled][0] = triangle ? a : 2.0 * a - 1.0;
            at[filled++][1] = triangle ? b : 2.0 * b - 1.0;
        }
    return filled;
}

/* Faces of one patch and one material, which have one value at a node that they share. */
struct group {
    const struct site_field *field;
    const struct surface_rule *rule;
    size_t patch, part;
    double *known; /* [nodes], of those of the group's faces */
    size_t *index; /* [nodes]: which unknown a node is; KNOWN, ELSEWHERE */
    size_t unknowns;
    struct edge_fit fit;
};
static const size_t KNOWN = (size_t)-1, ELSEWHERE = (size_t)-2;

static bool is_in(const struct group *group, size_t face)
{
    const struct surface_face *f = &group->rule->surface->faces[face];
    return f->patch == group->patch && f->part == group->part;
}

/* The field at the face's nodes that no face before had; nodes near an edge become unknowns. */
static void take_nodes(struct group *group, size_t face)
{
    const struct surface *surface = group->rule->surface;
    const struct surface_face *f = &surface->faces[face];
    for (size_t n = 0; n < f->count; n++) {
        size_t node = f->nodes[n];
        if (group->index[node] != ELSEWHERE)
            continue;
        const double *point = group->rule->mesh->points[node];
        double value = site_field_at(group->field, f, point, surface->points[face][n].normal);
        double edge = flexibility_edges_distance(group->field->edges, f->patch, point);
        bool unknown = edge < FITTED_TO * surface->size && !isnan(value);
        group->known[node] = value;
        group->index[node] = unknown ? group->unknowns++ : KNOWN;
    }
}

/* What the shape functions make of the nodes' values is to be the field inside the face. False: out
 * of memory. */
static bool add_rows(struct group *group, size_t face)
{
    const struct surface_rule *rule = group->rule;
    const struct surface_face *f = &rule->surface->faces[face];
    double nodes[FACE_MOST_NODES][3], at[GRID * GRID][2];
    /* a face with unknowns, all of it known */
    bool any = false, whole = true;
    for (size_t n = 0; n < f->count; n++) {
        any = any || group->index[f->nodes[n]] != KNOWN;
        whole = whole && !isnan(group->known[f->nodes[n]]);
    }
    surface_rule_nodes(rule, face, nodes);
    size_t points = any && whole ? grid_points(f->count, at) : 0;
    for (size_t p = 0; p < points; p++) {
        double x[3], outward[3], shape[FACE_MOST_NODES];
        facet_place(f->count, (const double(*)[3])nodes, at[p][0], at[p][1], x, outward);
        scale3(1.0 / norm3(outward), outward, outward);
        double edge =
            flexibility_edges_distance(group->field->edges, f->patch, x) / rule->surface->size;
        double rest = site_field_at(group->field, f, x, outward);
        if (edge < KNOWN_FROM || isnan(rest))
            continue;
        /* an error matters the more the less a flexibility is in doubt for other reasons */
        struct edge_row row = {.rest = rest, .weight = edge * edge * edge};
        facet_shape(f->count, at[p][0], at[p][1], shape, NULL, NULL);
        for (size_t n = 0; n < f->count; n++) {
            size_t node = f->nodes[n];
            if (group->index[node] == KNOWN) {
                row.rest -= shape[n] * group->known[node];
                continue;
            }
            row.index[row.count] = group->index[node];
            row.shape[row.count++] = shape[n];
        }
        if (!edge_fit_add(&group->fit, &row))
            return false;
    }
    return true;
}

/* Nodes near an edge get the values that serve all faces about them best. False: out of memory. */
static bool fit_group(struct group *group)
{
    const struct surface *surface = group->rule->surface;
    double *values = calloc(group->unknowns + 1, sizeof *values);
    bool good = values;
    for (size_t f = 0; good && f < surface->face_count; f++)
        good = !is_in(group, f) || add_rows(group, f);
    /* from the nodes' own values */
    for (size_t node = 0; good && node < group->rule->mesh->node_count; node++)
        if (group->index[node] < group->unknowns)
            values[group->index[node]] = group->known[node];
    good = good && edge_fit_solve(&group->fit, group->unknowns, OWN_WEIGHT, values);
    /* no further than edges account for */
    double young = group->rule->mesh->part[group->part].material.young;
    double most = MOST_MOVED / (young * KNOWN_FROM * surface->size);
    for (size_t node = 0; good && node < group->rule->mesh->node_count; node++)
        if (group->index[node] < group->unknowns) {
            double moved = values[group->index[node]] - group->known[node];
            group->known[node] += fmax(-most, fmin(moved, most));
        }
    free(values);
    return good;
}

/* With the slope that a half-space of that curvature has. */
static void fill_face(const struct group *group, size_t face, struct mesh_body_face *result)
{
    const struct surface_face *f = &group->rule->surface->faces[face];
    const struct material *material = &group->rule->mesh->part[f->part].material;
    for (size_t n = 0; n < f->count; n++) {
        double curvature = sites_mean_curvature(&group->rule->surface->points[face][n]);
        result->flexibility[n] = group->known[f->nodes[n]];
        result->flexibility_slope[n] =
            flexibility_slope(material->young, material->poisson, curvature);
    }
}

/* False: out of memory. */
static bool spread_group(struct group *group, struct mesh_body *body)
{
    const struct surface *surface = group->rule->surface;
    size_t members = 0;
    /* what is known of its nodes */
    for (size_t node = 0; node < group->rule->mesh->node_count; node++)
        group->index[node] = ELSEWHERE;
    group->unknowns = group->fit.count = 0;
    for (size_t f = 0; f < surface->face_count; f++)
        if (is_in(group, f)) {
            take_nodes(group, f);
            members++;
        }
    if (members == 0)
        return true;
    /* what is fitted; all of it to the faces */
    bool good = group->unknowns == 0 || fit_group(group);
    for (size_t f = 0; good && f < surface->face_count; f++)
        if (is_in(group, f))
            fill_face(group, f, &body->faces[f]);
    return good;
}

enum percuss_status sites_spread(const struct site_field *field, const struct surface_rule *rule,
                                 struct mesh_body *body, struct fault *fault)
{
    size_t nodes = rule->mesh->node_count;
    struct group group = {.field = field,
                          .rule = rule,
                          .known = malloc(nodes * sizeof *group.known),
                          .index = malloc(nodes * sizeof *group.index)};
    bool good = group.known && group.index;
    for (group.patch = 0; good && group.patch < rule->surface->patch_count; group.patch++)
        for (group.part = 0; good && group.part < rule->mesh->part_count; group.part++)
            good = spread_group(&group, body);
    free(group.known);
    free(group.index);
    edge_fit_free(&group.fit);
    return good ? PERCUSS_OK : pace_fault(fault, PERCUSS_INTERNAL);
}
