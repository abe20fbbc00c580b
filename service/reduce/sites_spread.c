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

/* of the mesh's edges: nodes nearer to a sharp edge than this get values by fit: on the edge and in
 * the middle of a face at it */
static const double FITTED_TO = 0.6;
/* how much the mean of what is known about a node weighs beside one point of its face, where shape
 * functions of the order of 0.1 are what is fitted: it decides only where the points say nothing */
static const double MEAN_WEIGHT = 1e-4;

/* and a place that was solved for */
static const double SITE_WEIGHT = 10.0;

enum { GRID = 6 };

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
    double *values, *weights; /* [unknowns]: means of what is known about them */
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
        double edge = flexibility_edges_distance(group->field->edges, f->patch, point);
        bool unknown = edge < FITTED_TO * surface->size;
        group->index[node] = unknown ? group->unknowns++ : KNOWN;
        group->known[node] =
            unknown ? 0.0 : site_field_at(group->field, f, point, surface->points[face][n].normal);
    }
}

/* An error matters the more the less a flexibility is in doubt for other reasons. */
static double weight_of(const struct group *group, double edge)
{
    double part = fmin(edge / group->rule->surface->size, 1.0);
    return part * part * part;
}

/* The field at a point of a face, and how much it weighs there: 0 where it is not known. Nearer to
 * an edge than any place it goes on as its edge terms do, and weighs little. */
static double look_at(const struct group *group, size_t face, const double at[2], double *weight)
{
    const struct surface_rule *rule = group->rule;
    const struct surface_face *f = &rule->surface->faces[face];
    double nodes[FACE_MOST_NODES][3], x[3], outward[3];
    surface_rule_nodes(rule, face, nodes);
    facet_place(f->count, (const double(*)[3])nodes, at[0], at[1], x, outward);
    scale3(1.0 / norm3(outward), outward, outward);
    double edge = flexibility_edges_distance(group->field->edges, f->patch, x);
    double value = site_field_at(group->field, f, x, outward);
    *weight = isnan(value) ? 0.0 : weight_of(group, edge);
    return value;
}

/* What the shape functions make of the nodes' values at a point of a face is to be the value.
 * False: out of memory. */
static bool add_row(struct group *group, size_t face, const double at[2], double value,
                    double weight)
{
    const struct surface_face *f = &group->rule->surface->faces[face];
    struct edge_row row = {.rest = value, .weight = weight};
    double shape[FACE_MOST_NODES];
    facet_shape(f->count, at[0], at[1], shape, NULL, NULL);
    /* known nodes' parts go to the other side; unknowns get a mean */
    for (size_t n = 0; n < f->count; n++) {
        size_t node = f->nodes[n], index = group->index[node];
        if (index == KNOWN) {
            row.rest -= shape[n] * group->known[node];
            continue;
        }
        row.index[row.count] = index;
        row.shape[row.count++] = shape[n];
        group->values[index] += weight * value;
        group->weights[index] += weight;
    }
    return edge_fit_add(&group->fit, &row);
}

/* A face with nodes to be fitted, all others known. */
static bool is_fitted(const struct group *group, size_t face)
{
    const struct surface_face *f = &group->rule->surface->faces[face];
    bool any = false, whole = true;
    for (size_t n = 0; n < f->count; n++) {
        any = any || group->index[f->nodes[n]] != KNOWN;
        whole = whole && !isnan(group->known[f->nodes[n]]);
    }
    return any && whole;
}

/* The field all over the face. False: out of memory. */
static bool add_rows(struct group *group, size_t face)
{
    double at[GRID * GRID][2];
    bool good = true;
    size_t points =
        is_fitted(group, face) ? grid_points(group->rule->surface->faces[face].count, at) : 0;
    for (size_t p = 0; p < points && good; p++) {
        double weight, value = look_at(group, face, at[p], &weight);
        good = weight == 0.0 || add_row(group, face, at[p], value, weight);
    }
    return good;
}

/* What was solved for, in its own place: also nearer to the edge than the field is known, where
 * somebody asked for it. False: out of memory. */
static bool add_sites(struct group *group)
{
    const struct site_field *field = group->field;
    bool good = true;
    for (size_t i = 0; i < field->count && good; i++) {
        const struct flexibility_place *place = &field->places[i];
        const double at[2] = {place->u, place->v};
        if (isnan(field->values[i]) || !is_in(group, place->face) || !is_fitted(group, place->face))
            continue;
        double weight = place->edge < flexibility_edges_known(field->edges, place->face)
                            ? 1.0
                            : weight_of(group, place->edge);
        good = add_row(group, place->face, at, field->values[i], SITE_WEIGHT * weight);
    }
    return good;
}

/* Nodes near an edge get the values that serve all faces about them best; those about which nothing
 * is known get none. False: out of memory. */
static bool fit_group(struct group *group)
{
    const struct surface *surface = group->rule->surface;
    bool good = true;
    for (size_t f = 0; good && f < surface->face_count; f++)
        good = !is_in(group, f) || add_rows(group, f);
    good = good && add_sites(group);
    /* from the mean of what is known about each */
    for (size_t i = 0; i < group->unknowns; i++)
        group->values[i] = group->weights[i] > 0.0 ? group->values[i] / group->weights[i] : 0.0;
    good = good && edge_fit_solve(&group->fit, group->unknowns, MEAN_WEIGHT, group->values);
    for (size_t node = 0; good && node < group->rule->mesh->node_count; node++) {
        size_t index = group->index[node];
        if (index < group->unknowns)
            group->known[node] = group->weights[index] > 0.0 ? group->values[index] : NAN;
    }
    return good;
}

/* The fit of all nodes near edges. False: out of memory. */
static bool fit_unknowns(struct group *group)
{
    if (group->unknowns == 0)
        return true;
    group->values = calloc(2 * group->unknowns, sizeof *group->values);
    if (!group->values)
        return false;
    group->weights = group->values + group->unknowns;
    bool good = fit_group(group);
    free(group->values);
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
    bool good = fit_unknowns(group);
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
