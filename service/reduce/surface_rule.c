/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/surface_rule.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/facet.h"
#include "model/vector.h"

/* Degree 6, twelve points (Dunavant 1985): volume coordinates and the part of the area. */
static const double RULE[SURFACE_RULE_POINTS][4] = {
    {0.501426509658179, 0.249286745170910, 0.249286745170910, 0.116786275726379},
    {0.249286745170910, 0.501426509658179, 0.249286745170910, 0.116786275726379},
    {0.249286745170910, 0.249286745170910, 0.501426509658179, 0.116786275726379},
    {0.873821971016996, 0.063089014491502, 0.063089014491502, 0.050844906370207},
    {0.063089014491502, 0.873821971016996, 0.063089014491502, 0.050844906370207},
    {0.063089014491502, 0.063089014491502, 0.873821971016996, 0.050844906370207},
    {0.053145049844817, 0.310352451033784, 0.636502499121399, 0.082851075618374},
    {0.053145049844817, 0.636502499121399, 0.310352451033784, 0.082851075618374},
    {0.310352451033784, 0.053145049844817, 0.636502499121399, 0.082851075618374},
    {0.310352451033784, 0.636502499121399, 0.053145049844817, 0.082851075618374},
    {0.636502499121399, 0.053145049844817, 0.310352451033784, 0.082851075618374},
    {0.636502499121399, 0.310352451033784, 0.053145049844817, 0.082851075618374}};

size_t surface_rule_triangles(size_t count, struct surface_triangle triangles[2])
{
    static const struct surface_triangle WHOLE = {{{0, 0}, {1, 0}, {0, 1}}};
    static const struct surface_triangle HALVES[2] = {{{{-1, -1}, {1, -1}, {1, 1}}},
                                                      {{{-1, -1}, {1, 1}, {-1, 1}}}};
    if (count == FACE_TRIANGLE6) {
        triangles[0] = WHOLE;
        return 1;
    }
    memcpy(triangles, HALVES, sizeof HALVES);
    return 2;
}

void surface_rule_place(const struct surface_triangle *triangle, double at[][2], double weights[])
{
    const double(*c)[2] = triangle->corners;
    double area = 0.5 * ((c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) -
                         (c[2][0] - c[0][0]) * (c[1][1] - c[0][1]));
    for (int p = 0; p < SURFACE_RULE_POINTS; p++) {
        for (int k = 0; k < 2; k++)
            at[p][k] = RULE[p][0] * c[0][k] + RULE[p][1] * c[1][k] + RULE[p][2] * c[2][k];
        weights[p] = RULE[p][3] * area;
    }
}

void surface_rule_split(const struct surface_triangle *triangle, struct surface_triangle parts[4])
{
    const double(*c)[2] = triangle->corners;
    double middle[3][2];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++)
            middle[i][k] = 0.5 * (c[i][k] + c[(i + 1) % 3][k]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++) {
            parts[i].corners[0][k] = c[i][k];
            parts[i].corners[1][k] = middle[i][k];
            parts[i].corners[2][k] = middle[(i + 2) % 3][k];
            parts[3].corners[i][k] = middle[i][k];
        }
}

void surface_rule_nodes(const struct surface_rule *rule, size_t face,
                        double nodes[FACE_MOST_NODES][3])
{
    const struct surface_face *f = &rule->surface->faces[face];
    for (size_t i = 0; i < f->count; i++)
        memcpy(nodes[i], rule->mesh->points[f->nodes[i]], sizeof nodes[i]);
}

static size_t point_count(size_t count)
{
    return count == FACE_TRIANGLE6 ? SURFACE_RULE_POINTS : 2 * SURFACE_RULE_POINTS;
}

/* local coordinates and weights of all points of a face */
static void place_all(size_t count, double at[SURFACE_RULE_MOST][2],
                      double weights[SURFACE_RULE_MOST])
{
    struct surface_triangle triangles[2];
    size_t triangle_count = surface_rule_triangles(count, triangles);
    for (size_t t = 0; t < triangle_count; t++)
        surface_rule_place(&triangles[t], at + t * SURFACE_RULE_POINTS,
                           weights + t * SURFACE_RULE_POINTS);
}

double surface_rule_sphere(size_t count, double points[][3], double centre[3])
{
    double radius = 0.0;
    memset(centre, 0, 3 * sizeof *centre);
    for (size_t n = 0; n < count; n++)
        add_scaled3(1.0 / (double)count, points[n], centre);
    for (size_t n = 0; n < count; n++) {
        double offset[3];
        sub3(points[n], centre, offset);
        radius = fmax(radius, norm3(offset));
    }
    return radius;
}

static void fill_face(struct surface_rule *rule, size_t face)
{
    size_t count = rule->surface->faces[face].count;
    double nodes[FACE_MOST_NODES][3], at[SURFACE_RULE_MOST][2], weights[SURFACE_RULE_MOST];
    surface_rule_nodes(rule, face, nodes);
    /* points of integration, each with its area as a vector */
    place_all(count, at, weights);
    for (size_t p = 0; p < point_count(count); p++) {
        size_t i = rule->first[face] + p;
        double area[3];
        facet_place((int)count, nodes, at[p][0], at[p][1], rule->points[i], area);
        scale3(weights[p], area, rule->areas[i]);
    }
    rule->radii[face] = surface_rule_sphere(count, nodes, rule->centres[face]);
}

bool surface_rule_make(struct surface_rule *rule, const struct solid_mesh *mesh,
                       const struct surface *surface)
{
    /* room for what there is one of a face */
    size_t faces = surface->face_count, total = 0;
    *rule = (struct surface_rule){.mesh = mesh, .surface = surface};
    rule->first = malloc((faces + 1) * sizeof *rule->first);
    rule->centres = malloc(faces * sizeof *rule->centres);
    rule->radii = malloc(faces * sizeof *rule->radii);
    if (!rule->first || !rule->centres || !rule->radii)
        goto no_memory;
    /* where the points of each face begin */
    for (size_t f = 0; f < faces; f++) {
        rule->first[f] = total;
        total += point_count(surface->faces[f].count);
    }
    rule->first[faces] = total;
    /* the points */
    rule->points = malloc(total * sizeof *rule->points);
    rule->areas = malloc(total * sizeof *rule->areas);
    if (!rule->points || !rule->areas)
        goto no_memory;

    /* shapes at the points, for each type of face */
    static const int COUNTS[3] = {FACE_TRIANGLE6, FACE_QUAD8, FACE_QUAD9};
    for (int kind = 0; kind < 3; kind++) {
        double at[SURFACE_RULE_MOST][2], weights[SURFACE_RULE_MOST];
        place_all((size_t)COUNTS[kind], at, weights);
        for (size_t p = 0; p < point_count((size_t)COUNTS[kind]); p++)
            facet_shape(COUNTS[kind], at[p][0], at[p][1], rule->shapes[COUNTS[kind]][p], NULL,
                        NULL);
    }
    for (size_t f = 0; f < faces; f++)
        fill_face(rule, f);
    return true;

no_memory:
    surface_rule_free(rule);
    return false;
}

void surface_rule_free(struct surface_rule *rule)
{
    free(rule->first);
    free(rule->points);
    free(rule->areas);
    free(rule->centres);
    free(rule->radii);
    *rule = (struct surface_rule){0};
}
