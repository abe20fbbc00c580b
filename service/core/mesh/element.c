/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/element.h"

#include <math.h>
#include <string.h>

#include "model/vector.h"

/* Corners at the ends of the edge of each mid node of a tetrahedron, nodes 4 to 9. */
static const unsigned char TET_EDGES[6][2] = {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {3, 2}, {3, 1}};

/* Natural coordinates of a hexahedron's nodes: corners, edges, faces, the middle. */
static const signed char HEX_NODES[27][3] = {
    {-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},
    {-1, 1, 1},   {0, -1, -1}, {-1, 0, -1}, {-1, -1, 0}, {1, 0, -1},  {1, -1, 0}, {0, 1, -1},
    {1, 1, 0},    {-1, 1, 0},  {0, -1, 1},  {-1, 0, 1},  {1, 0, 1},   {0, 1, 1},  {0, 0, -1},
    {0, -1, 0},   {-1, 0, 0},  {1, 0, 0},   {0, 1, 0},   {0, 0, 1},   {0, 0, 0}};

/* Corners at the ends of the edge of each mid node of a wedge, nodes 6 to 14. */
static const unsigned char WEDGE_EDGES[9][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4},
                                                {2, 5}, {3, 4}, {3, 5}, {4, 5}};

static void wedge_node(size_t node, double at[3])
{
    static const double corners[6][3] = {{0.0, 0.0, -1.0}, {1.0, 0.0, -1.0}, {0.0, 1.0, -1.0},
                                         {0.0, 0.0, 1.0},  {1.0, 0.0, 1.0},  {0.0, 1.0, 1.0}};
    const unsigned char *edge = node < 6 ? NULL : WEDGE_EDGES[node - 6];
    for (int i = 0; i < 3; i++)
        at[i] = edge ? 0.5 * (corners[edge[0]][i] + corners[edge[1]][i]) : corners[node][i];
}

void element_node(enum element_type type, size_t node, double at[3])
{
    static const double corners[4][3] = {{0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    if (type == ELEMENT_WEDGE15) {
        wedge_node(node, at);
        return;
    }
    for (int i = 0; i < 3; i++) {
        if (type != ELEMENT_TET10)
            at[i] = HEX_NODES[node][i];
        else if (node < 4)
            at[i] = corners[node][i];
        else
            at[i] = 0.5 * (corners[TET_EDGES[node - 4][0]][i] + corners[TET_EDGES[node - 4][1]][i]);
    }
}

bool element_edge(enum element_type type, size_t node, size_t ends[2])
{
    double middle[3], corners[8][3];
    size_t count = element_corner_count(type), zeros = 0;
    if (node < count)
        return false;
    element_node(type, node, middle);
    for (size_t i = 0; i < count; i++)
        element_node(type, i, corners[i]);
    for (int k = 0; k < 3; k++)
        zeros += middle[k] == 0.0;
    if (type == ELEMENT_HEX27 && zeros > 1)
        return false;
    for (size_t i = 0; i < count; i++)
        for (size_t j = i + 1; j < count; j++) {
            bool between = true;
            for (int k = 0; k < 3; k++)
                between = between && 0.5 * (corners[i][k] + corners[j][k]) == middle[k];
            if (between) {
                ends[0] = i;
                ends[1] = j;
                return true;
            }
        }
    return false;
}

/* N = L(2L - 1) at corners, 4 L_i L_j on edges, in volume coordinates L. */
static void tet_shapes(const double at[3], double *shape, double (*gradient)[3])
{
    static const double slopes[4][3] = {
        {-1.0, -1.0, -1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    double part[4] = {1.0 - at[0] - at[1] - at[2], at[0], at[1], at[2]};
    for (int i = 0; i < 4; i++) {
        shape[i] = part[i] * (2.0 * part[i] - 1.0);
        scale3(4.0 * part[i] - 1.0, slopes[i], gradient[i]);
    }
    for (int e = 0; e < 6; e++) {
        int i = TET_EDGES[e][0], j = TET_EDGES[e][1];
        shape[4 + e] = 4.0 * part[i] * part[j];
        for (int k = 0; k < 3; k++)
            gradient[4 + e][k] = 4.0 * (part[i] * slopes[j][k] + part[j] * slopes[i][k]);
    }
}

/* Serendipity (Zienkiewicz, Taylor, The Finite Element Method 1, 8.13), L being the volume
 * coordinate of a corner or a mid node's corners i, j in the triangle: corners L(1 + zz_i)(2L - 2 +
 * zz_i)/2, edges of the triangles 2 L_i L_j (1 + zz_i), edges between them L(1 - z^2). */
static void wedge_shapes(const double at[3], double *shape, double (*gradient)[3])
{
    static const double slopes[3][2] = {{-1.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}};
    double part[3] = {1.0 - at[0] - at[1], at[0], at[1]}, z = at[2];
    for (size_t n = 0; n < 6; n++) {
        double sign = n < 3 ? -1.0 : 1.0, l = part[n % 3], up = 1.0 + sign * z;
        shape[n] = 0.5 * l * up * (2.0 * l - 2.0 + sign * z);
        for (int k = 0; k < 2; k++)
            gradient[n][k] = 0.5 * up * (4.0 * l - 2.0 + sign * z) * slopes[n % 3][k];
        gradient[n][2] = 0.5 * l * sign * (2.0 * l - 1.0 + 2.0 * sign * z);
    }
    for (size_t n = 6; n < 15; n++) {
        int i = WEDGE_EDGES[n - 6][0], j = WEDGE_EDGES[n - 6][1];
        bool between = j == i + 3;
        double sign = i < 3 ? -1.0 : 1.0, a = part[i % 3], b = between ? 1.0 : part[j % 3];
        double factor = between ? 1.0 - z * z : 2.0 * (1.0 + sign * z);
        shape[n] = a * b * factor;
        for (int k = 0; k < 2; k++)
            gradient[n][k] =
                factor * (between ? slopes[i % 3][k] : a * slopes[j % 3][k] + b * slopes[i % 3][k]);
        gradient[n][2] = a * b * (between ? -2.0 * z : 2.0 * sign);
    }
}

/* Serendipity: corners (1 + xx_i)(1 + yy_i)(1 + zz_i)(xx_i + yy_i + zz_i - 2)/8, edges (1 - x^2)(1
 * + yy_i)(1 + zz_i)/4. */
static void hex20_shapes(const double at[3], double *shape, double (*gradient)[3])
{
    for (size_t n = 0; n < 20; n++) {
        double factor[3], slope[3], sum = -2.0;
        for (int k = 0; k < 3; k++) {
            double sign = HEX_NODES[n][k];
            bool middle = HEX_NODES[n][k] == 0;
            factor[k] = middle ? 1.0 - at[k] * at[k] : 1.0 + sign * at[k];
            slope[k] = middle ? -2.0 * at[k] : sign;
            sum += sign * at[k];
        }
        double product = factor[0] * factor[1] * factor[2];
        for (int k = 0; k < 3; k++) {
            double others = factor[(k + 1) % 3] * factor[(k + 2) % 3];
            gradient[n][k] = n < 8 ? (slope[k] * sum + factor[k] * HEX_NODES[n][k]) * others / 8.0
                                   : slope[k] * others / 4.0;
        }
        shape[n] = n < 8 ? product * sum / 8.0 : product / 4.0;
    }
}

/* Products of Lagrange's parabolas. */
static void hex27_shapes(const double at[3], double *shape, double (*gradient)[3])
{
    double value[3][3], slope[3][3]; /* [direction][node at -1, 0, 1] */
    for (int k = 0; k < 3; k++) {
        double x = at[k];
        value[k][0] = 0.5 * x * (x - 1.0);
        value[k][1] = 1.0 - x * x;
        value[k][2] = 0.5 * x * (x + 1.0);
        slope[k][0] = x - 0.5;
        slope[k][1] = -2.0 * x;
        slope[k][2] = x + 0.5;
    }
    for (size_t n = 0; n < 27; n++) {
        int a = HEX_NODES[n][0] + 1, b = HEX_NODES[n][1] + 1, c = HEX_NODES[n][2] + 1;
        shape[n] = value[0][a] * value[1][b] * value[2][c];
        gradient[n][0] = slope[0][a] * value[1][b] * value[2][c];
        gradient[n][1] = value[0][a] * slope[1][b] * value[2][c];
        gradient[n][2] = value[0][a] * value[1][b] * slope[2][c];
    }
}

void element_shapes(enum element_type type, const double at[3], double *shape,
                    double (*gradient)[3])
{
    if (type == ELEMENT_TET10)
        tet_shapes(at, shape, gradient);
    else if (type == ELEMENT_WEDGE15)
        wedge_shapes(at, shape, gradient);
    else if (type == ELEMENT_HEX20)
        hex20_shapes(at, shape, gradient);
    else
        hex27_shapes(at, shape, gradient);
}

static void rule_add_point(struct element_rule *rule, double x, double y, double z, double weight)
{
    size_t p = rule->point_count++;
    rule->at[p][0] = x;
    rule->at[p][1] = y;
    rule->at[p][2] = z;
    rule->weight[p] = weight;
}

/* Degree 5, fourteen points (Walkington 2000, Quadrature on simplices of arbitrary dimension). */
static void tet_points(struct element_rule *rule)
{
    static const double near_corners[2] = {0.0927352503108912264, 0.310885919263300609797};
    static const double corner_weights[2] = {0.0122488405193936582573, 0.0187813209530026417999};
    static const double edge = 0.0455037041256496494918, edge_weight = 0.0070910034628469110730;
    for (int g = 0; g < 2; g++) {
        double a = near_corners[g], b = 1.0 - 3.0 * a, weight = corner_weights[g];
        rule_add_point(rule, a, a, a, weight);
        rule_add_point(rule, b, a, a, weight);
        rule_add_point(rule, a, b, a, weight);
        rule_add_point(rule, a, a, b, weight);
    }
    double a = edge, b = 0.5 - edge;
    rule_add_point(rule, b, a, a, edge_weight);
    rule_add_point(rule, a, b, a, edge_weight);
    rule_add_point(rule, a, a, b, edge_weight);
    rule_add_point(rule, a, b, b, edge_weight);
    rule_add_point(rule, b, a, b, edge_weight);
    rule_add_point(rule, b, b, a, edge_weight);
}

/* Degree 5: seven points of a triangle (Radon 1948) times three of Gauss. */
static void wedge_points(struct element_rule *rule)
{
    double root = sqrt(15.0), across[3] = {-sqrt(0.6), 0.0, sqrt(0.6)};
    double near[2] = {(6.0 - root) / 21.0, (6.0 + root) / 21.0};
    double weights[2] = {(155.0 - root) / 2400.0, (155.0 + root) / 2400.0};
    static const double gauss[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    for (int k = 0; k < 3; k++) {
        rule_add_point(rule, 1.0 / 3.0, 1.0 / 3.0, across[k], 9.0 / 80.0 * gauss[k]);
        for (int g = 0; g < 2; g++) {
            double a = near[g], b = 1.0 - 2.0 * a, weight = weights[g] * gauss[k];
            rule_add_point(rule, a, a, across[k], weight);
            rule_add_point(rule, b, a, across[k], weight);
            rule_add_point(rule, a, b, across[k], weight);
        }
    }
}

static void hex_points(struct element_rule *rule)
{
    double at[3] = {-sqrt(0.6), 0.0, sqrt(0.6)};
    static const double weight[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                rule_add_point(rule, at[i], at[j], at[k], weight[i] * weight[j] * weight[k]);
}

void element_rule_make(enum element_type type, struct element_rule *rule)
{
    rule->node_count = element_node_count(type);
    rule->point_count = 0;
    if (type == ELEMENT_TET10)
        tet_points(rule);
    else if (type == ELEMENT_WEDGE15)
        wedge_points(rule);
    else
        hex_points(rule);
    for (size_t p = 0; p < rule->point_count; p++)
        element_shapes(type, rule->at[p], rule->shape[p], rule->gradient[p]);
}

void element_points(const struct solid_mesh *mesh, size_t element,
                    double points[ELEMENT_MOST_NODES][3])
{
    const size_t *nodes = mesh->nodes + mesh->first[element];
    size_t count = mesh->first[element + 1] - mesh->first[element];
    for (size_t i = 0; i < count; i++)
        memcpy(points[i], mesh->points[nodes[i]], sizeof points[i]);
}

void element_map(size_t node_count, double (*points)[3], const double *shape, double (*gradient)[3],
                 struct element_point *result)
{
    /* the position, and columns of J: change of the position with a natural coordinate */
    double columns[3][3] = {{0.0}};
    memset(result->position, 0, sizeof result->position);
    for (size_t n = 0; n < node_count; n++) {
        add_scaled3(shape[n], points[n], result->position);
        for (int k = 0; k < 3; k++)
            add_scaled3(gradient[n][k], points[n], columns[k]);
    }
    /* rows of the inverse are cross products over the determinant */
    double rows[3][3];
    for (int k = 0; k < 3; k++)
        cross3(columns[(k + 1) % 3], columns[(k + 2) % 3], rows[k]);
    result->volume = dot3(columns[0], rows[0]);
    double inverse = result->volume == 0.0 ? 0.0 : 1.0 / result->volume;
    for (size_t n = 0; n < node_count; n++)
        for (int i = 0; i < 3; i++)
            result->gradient[n][i] =
                inverse * (gradient[n][0] * rows[0][i] + gradient[n][1] * rows[1][i] +
                           gradient[n][2] * rows[2][i]);
}

void element_at(const struct element_rule *rule, size_t point, double (*points)[3],
                struct element_point *result)
{
    /* the rule is only read */
    element_map(rule->node_count, points, rule->shape[point], (double(*)[3])rule->gradient[point],
                result);
    result->volume *= rule->weight[point];
}
