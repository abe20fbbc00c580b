/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/sites_spread.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/watch.h"
#include "model/facet.h"
#include "model/vector.h"
#include "numeric/linear.h"
#include "reduce/flexibility.h"

/* of the mesh's edges: nearer to a sharp edge the field is not known (site_choice.c's first row) */
static const double KNOWN_FROM = 0.3;
/* nodes nearer than this get values by fit: on the edge and in the middle of a face at it */
static const double FITTED_TO = 0.6;
/* how much a node's own value weighs beside one point of its face, where shape functions of the
 * order of 0.1 are what is fitted: it decides only where the points say nothing */
static const double OWN_WEIGHT = 1e-4;

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

/* Least squares for the values of the nodes that are marked, the others' given: what the face's
 * shape functions make of them is to be the field inside the face. */
static void fit_marked(const struct site_field *field, const struct surface_rule *rule, size_t face,
                       const bool marked[FACE_MOST_NODES], double values[FACE_MOST_NODES])
{
    const struct surface_face *f = &rule->surface->faces[face];
    size_t index[FACE_MOST_NODES], size = 0;
    double nodes[FACE_MOST_NODES][3], at[GRID * GRID][2];
    double matrix[FACE_MOST_NODES * FACE_MOST_NODES] = {0.0}, side[FACE_MOST_NODES] = {0.0};
    surface_rule_nodes(rule, face, nodes);
    for (size_t n = 0; n < f->count; n++)
        if (marked[n])
            index[size++] = n;

    for (size_t i = 0; i < size; i++) {
        matrix[i * size + i] = OWN_WEIGHT;
        side[i] = OWN_WEIGHT * values[index[i]];
    }
    size_t points = grid_points(f->count, at);
    for (size_t p = 0; p < points; p++) {
        double x[3], outward[3], shape[FACE_MOST_NODES];
        facet_place(f->count, (const double(*)[3])nodes, at[p][0], at[p][1], x, outward);
        scale3(1.0 / norm3(outward), outward, outward);
        double edge = flexibility_edges_distance(field->edges, f->patch, x) / rule->surface->size;
        double rest = site_field_at(field, f, x, outward);
        if (edge < KNOWN_FROM || isnan(rest))
            continue;
        /* an error matters the more the less a flexibility is in doubt for other reasons */
        double weight = edge * edge * edge;
        facet_shape(f->count, at[p][0], at[p][1], shape, NULL, NULL);
        for (size_t n = 0; n < f->count; n++)
            rest -= marked[n] ? 0.0 : shape[n] * values[n];
        for (size_t i = 0; i < size; i++) {
            side[i] += weight * shape[index[i]] * rest;
            for (size_t j = 0; j < size; j++)
                matrix[i * size + j] += weight * shape[index[i]] * shape[index[j]];
        }
    }
    if (!linear_solve(size, matrix, side))
        return;
    for (size_t i = 0; i < size; i++)
        values[index[i]] = side[i];
}

static void fill_face(const struct site_field *field, const struct surface_rule *rule, size_t face,
                      const double values[FACE_MOST_NODES], struct mesh_body_face *result)
{
    const struct surface_face *f = &rule->surface->faces[face];
    const struct material *material = &rule->mesh->part[f->part].material;
    bool marked[FACE_MOST_NODES] = {false}, any = false, whole = true;
    double own[FACE_MOST_NODES];
    /* nodes near an edge; and whether all of the face is known */
    memcpy(own, values, sizeof own);
    for (size_t n = 0; n < f->count; n++) {
        double edge =
            flexibility_edges_distance(field->edges, f->patch, rule->mesh->points[f->nodes[n]]);
        marked[n] = edge < FITTED_TO * rule->surface->size;
        any = any || marked[n];
        whole = whole && !isnan(own[n]);
    }
    /* these are fitted to the field inside the face */
    if (any && whole)
        fit_marked(field, rule, face, marked, own);
    /* with the slope that a half-space of that curvature has */
    for (size_t n = 0; n < f->count; n++) {
        double curvature = sites_mean_curvature(&rule->surface->points[face][n]);
        result->flexibility[n] = own[n];
        result->flexibility_slope[n] =
            flexibility_slope(material->young, material->poisson, curvature);
    }
}

enum percuss_status sites_spread(const struct site_field *field, const struct surface_rule *rule,
                                 struct mesh_body *body, struct fault *fault)
{
    const struct surface *surface = rule->surface;
    size_t nodes = rule->mesh->node_count;
    double *known = malloc(nodes * sizeof *known);
    const struct surface_face **of = calloc(nodes, sizeof *of); /* the face it was found for */
    if (!known || !of) {
        free(known);
        free(of);
        return pace_fault(fault, PERCUSS_INTERNAL);
    }
    /* faces of one patch and material have one value at a node that they share */
    for (size_t f = 0; f < surface->face_count; f++) {
        const struct surface_face *face = &surface->faces[f];
        double values[FACE_MOST_NODES] = {0.0};
        for (size_t n = 0; n < face->count; n++) {
            size_t node = face->nodes[n];
            if (!of[node] || of[node]->patch != face->patch || of[node]->part != face->part)
                known[node] = site_field_at(field, face, rule->mesh->points[node],
                                            surface->points[f][n].normal);
            of[node] = face;
            values[n] = known[node];
        }
        fill_face(field, rule, f, values, &body->faces[f]);
    }
    free(known);
    free(of);
    return PERCUSS_OK;
}
