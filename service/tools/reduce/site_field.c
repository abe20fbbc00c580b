/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/site_field.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/watch.h"
#include "model/facet.h"
#include "model/vector.h"
#include "numeric/linear.h"
#include "reduce/flexibility.h"

enum { POLYNOMIALS = 20 }; /* cubic ones of three coordinates */
/* terms of degree 1 (4), 2 (10) and 3 (20): used from so many places on, on a plane the half of
 * them being no more than rounding */
static const size_t FEWEST[4] = {1, 5, 12, 20};
static const size_t OF_DEGREE[4] = {1, 4, 10, 20};
/* Beside the sum of the weights. On a surface not all polynomials of space differ: of those that
 * say the same this takes the smallest; its cost is its part of the value. */
static const double RIDGE = 1e-7;
/* of the distance to the farthest neighbour: a place within it has its own value */
static const double OWN_VALUE = 0.02;
/* of the spacing: beyond, nothing is known */
static const double KNOWN_WITHIN = 2.5;
/* of the mesh's size: nearer to an edge the field stays as it is there; it is asked about farther
 * ones, but places may lie anywhere */
static const double BLUNT = 0.02;
/* cosine beyond which a place lies on another side of the body */
static const double OTHER_SIDE = -0.2;

/* Integral of ds / r^2 along the edges of the patch, over pi: 1/distance from a long straight edge,
 * and from two at a corner the sum of both. And its logarithm, the next one for a quarter of space
 * that is bent. The same of hollow edges. 0 without an edge. */
static void edge_terms(const struct site_field *field, size_t patch, const double x[3],
                       double terms[SITE_FIELD_EDGE_TERMS])
{
    const struct flexibility_edges *edges = field->edges;
    double sums[2] = {0.0}, blunt = BLUNT * field->size; /* sharp, hollow */
    /* each edge as two straight lines through its middle */
    for (size_t i = 0; i < edges->count; i++) {
        if (edges->patches[i] != patch)
            continue;
        for (int half = 0; half < 2; half++) {
            const double *from = edges->points[i][half], *to = edges->points[i][half + 1];
            /* along it and aside; no nearer than the edge is blunt */
            double along[3], offset[3];
            sub3(to, from, along);
            sub3(x, from, offset);
            double length = norm3(along), start = -dot3(offset, along) / length;
            double square = dot3(offset, offset) - start * start;
            double aside = sqrt(fmax(square, blunt * blunt));
            sums[edges->hollow[i]] +=
                (atan((start + length) / aside) - atan(start / aside)) / aside;
        }
    }
    /* by the mesh's size, and the logarithm */
    for (int k = 0; k < 2; k++) {
        terms[2 * k] = field->size * sums[k] / M_PI;
        terms[2 * k + 1] = sums[k] > 0.0 ? log(terms[2 * k]) : 0.0;
    }
}

void site_field_free(struct site_field *field)
{
    free(field->faces);
    free(field->points);
    free(field->normals);
    free(field->edge_terms);
    free(field->coefficients);
    free(field->values);
    *field = (struct site_field){0};
}

/* the nearest places, ascending in distance */
struct neighbours {
    size_t count, places[SITE_FIELD_NEIGHBOURS];
    double distances[SITE_FIELD_NEIGHBOURS];
};

static void find_neighbours(const struct site_field *field, const struct surface_face *face,
                            const double x[3], const double outward[3], size_t without,
                            struct neighbours *found)
{
    found->count = 0;
    /* of the same patch and material, known, and not across a thin wall */
    for (size_t i = 0; i < field->count; i++) {
        if (field->faces[i]->patch != face->patch || field->faces[i]->part != face->part ||
            i == without || isnan(field->values[i]) ||
            dot3(field->normals[i], outward) < OTHER_SIDE)
            continue;
        /* nearer than the farthest that is kept */
        double offset[3];
        sub3(field->points[i], x, offset);
        double distance = norm3(offset);
        size_t at = found->count;
        if (at == SITE_FIELD_NEIGHBOURS) {
            if (distance >= found->distances[at - 1])
                continue;
            at--;
        } else {
            found->count++;
        }
        /* in its place by distance */
        for (; at > 0 && found->distances[at - 1] > distance; at--) {
            found->distances[at] = found->distances[at - 1];
            found->places[at] = found->places[at - 1];
        }
        found->distances[at] = distance;
        found->places[at] = i;
    }
}

/* all products of up to three coordinates */
static void cubic_terms(const double y[3], double terms[POLYNOMIALS])
{
    size_t count = 0;
    terms[count++] = 1.0;
    for (int i = 0; i < 3; i++)
        terms[count++] = y[i];
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++)
            terms[count++] = y[i] * y[j];
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++)
            for (int k = j; k < 3; k++)
                terms[count++] = y[i] * y[j] * y[k];
}

/* Weights of the neighbours' values in the value at x: those of the first coefficient of the
 * weighted least squares. False: no value is near enough. */
static bool weigh_neighbours(const struct site_field *field, const double x[3],
                             const struct neighbours *near_it,
                             double weights[SITE_FIELD_NEIGHBOURS])
{
    if (near_it->count == 0 || near_it->distances[0] > KNOWN_WITHIN * field->spacing)
        return false;
    size_t degree = 3;
    while (near_it->count < FEWEST[degree])
        degree--;
    size_t size = OF_DEGREE[degree];

    /* normal equations about x, in units of the neighbours' distance */
    double matrix[POLYNOMIALS * POLYNOMIALS] = {0.0}, first[POLYNOMIALS] = {1.0};
    double terms[SITE_FIELD_NEIGHBOURS][POLYNOMIALS], total = 0.0;
    double scale = 1.1 * near_it->distances[near_it->count - 1] + 1e-300;
    for (size_t n = 0; n < near_it->count; n++) {
        double y[3], q = near_it->distances[n] / scale;
        sub3(field->points[near_it->places[n]], x, y);
        scale3(1.0 / scale, y, y);
        cubic_terms(y, terms[n]);
        weights[n] = pow(1.0 - q, 4.0) * (4.0 * q + 1.0) / (q * q + OWN_VALUE * OWN_VALUE);
        total += weights[n];
        for (size_t i = 0; i < size; i++)
            for (size_t j = 0; j < size; j++)
                matrix[i * size + j] += weights[n] * terms[n][i] * terms[n][j];
    }
    for (size_t i = 1; i < size; i++)
        matrix[i * size + i] += RIDGE * total;
    if (!linear_solve(size, matrix, first))
        return false;
    for (size_t n = 0; n < near_it->count; n++) {
        double sum = 0.0;
        for (size_t i = 0; i < size; i++)
            sum += first[i] * terms[n][i];
        weights[n] *= sum;
    }
    return true;
}

/* a place's value and edge terms less those interpolated from its neighbours */
static bool left_out(const struct site_field *field, size_t place,
                     double differences[1 + SITE_FIELD_EDGE_TERMS])
{
    struct neighbours near_it;
    double weights[SITE_FIELD_NEIGHBOURS];
    find_neighbours(field, field->faces[place], field->points[place], field->normals[place], place,
                    &near_it);
    if (isnan(field->values[place]) ||
        !weigh_neighbours(field, field->points[place], &near_it, weights))
        return false;
    differences[0] = field->values[place];
    for (int t = 0; t < SITE_FIELD_EDGE_TERMS; t++)
        differences[1 + t] = field->edge_terms[place][t];
    for (size_t n = 0; n < near_it.count; n++) {
        size_t other = near_it.places[n];
        differences[0] -= weights[n] * field->values[other];
        for (int t = 0; t < SITE_FIELD_EDGE_TERMS; t++)
            differences[1 + t] -= weights[n] * field->edge_terms[other][t];
    }
    return true;
}

/* least squares of these differences, by patches; all that is summed is linear in the coefficients
 */
static bool fit_edges(struct site_field *field, size_t patch_count)
{
    enum { N = SITE_FIELD_EDGE_TERMS };
    double(*matrix)[N * N] = calloc(patch_count, sizeof *matrix);
    double(*side)[N] = calloc(patch_count, sizeof *side);
    if (!matrix || !side) {
        free(matrix);
        free(side);
        return false;
    }
    for (size_t i = 0; i < field->count; i++) {
        double d[1 + N];
        if (!left_out(field, i, d))
            continue;
        size_t patch = field->faces[i]->patch;
        for (int t = 0; t < N; t++) {
            side[patch][t] += d[1 + t] * d[0];
            for (int u = 0; u < N; u++)
                matrix[patch][t * N + u] += d[1 + t] * d[1 + u];
        }
    }
    for (size_t p = 0; p < patch_count; p++) {
        /* equal terms share their coefficient */
        double ridge = 0.0;
        for (int t = 0; t < N; t++)
            ridge += 1e-6 * matrix[p][t * N + t];
        for (int t = 0; t < N; t++)
            matrix[p][t * N + t] += ridge;
        bool solved = ridge > 0.0 && linear_solve(N, matrix[p], side[p]);
        for (int t = 0; t < N; t++)
            field->coefficients[p][t] = solved ? side[p][t] : 0.0;
    }
    free(matrix);
    free(side);
    return true;
}

bool site_field_make(struct site_field *field, const struct surface_rule *rule,
                     const struct flexibility_edges *edges, size_t count,
                     const struct flexibility_place *places, const double *values, double spacing)
{
    *field = (struct site_field){
        .edges = edges, .size = rule->surface->size, .spacing = spacing, .places = places};
    size_t patch_count = rule->surface->patch_count;
    field->faces = malloc((count + 1) * sizeof *field->faces);
    field->points = malloc((count + 1) * sizeof *field->points);
    field->normals = malloc((count + 1) * sizeof *field->normals);
    field->edge_terms = malloc((count + 1) * sizeof *field->edge_terms);
    field->coefficients = malloc((patch_count + 1) * sizeof *field->coefficients);
    field->values = malloc((count + 1) * sizeof *field->values);
    if (!field->faces || !field->points || !field->normals || !field->edge_terms ||
        !field->coefficients || !field->values) {
        site_field_free(field);
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        field->faces[i] = &rule->surface->faces[places[i].face];
        memcpy(field->points[i], places[i].load.point, sizeof field->points[i]);
        scale3(-1.0, places[i].load.inward, field->normals[i]);
        edge_terms(field, field->faces[i]->patch, field->points[i], field->edge_terms[i]);
        field->values[i] = values[i];
    }
    field->count = count;
    if (fit_edges(field, patch_count))
        return true;
    site_field_free(field);
    return false;
}

double site_field_at(const struct site_field *field, const struct surface_face *face,
                     const double x[3], const double outward[3])
{
    struct neighbours near_it;
    double weights[SITE_FIELD_NEIGHBOURS], here[SITE_FIELD_EDGE_TERMS], sum = 0.0;
    find_neighbours(field, face, x, outward, SIZE_MAX, &near_it);
    if (!weigh_neighbours(field, x, &near_it, weights))
        return NAN;
    const double *coefficients = field->coefficients[face->patch];
    edge_terms(field, face->patch, x, here);
    for (int t = 0; t < SITE_FIELD_EDGE_TERMS; t++)
        sum += coefficients[t] * here[t];
    for (size_t n = 0; n < near_it.count; n++) {
        size_t place = near_it.places[n];
        double rest = field->values[place];
        for (int t = 0; t < SITE_FIELD_EDGE_TERMS; t++)
            rest -= coefficients[t] * field->edge_terms[place][t];
        sum += weights[n] * rest;
    }
    return sum;
}

double site_field_error(const struct site_field *field, size_t place)
{
    double d[1 + SITE_FIELD_EDGE_TERMS];
    if (!left_out(field, place, d))
        return NAN;
    for (int t = 0; t < SITE_FIELD_EDGE_TERMS; t++)
        d[0] -= field->coefficients[field->faces[place]->patch][t] * d[1 + t];
    return -d[0];
}

/* ---- values at nodes that many faces share, by least squares ---- */

/* sum of shape[i] value[index[i]] = rest, so much weighed. */
struct edge_row {
    size_t count;
    size_t index[FACE_MOST_NODES];
    double shape[FACE_MOST_NODES];
    double rest, weight;
};

/* Starts empty, all 0; owns its rows. */
struct edge_fit {
    size_t count, room;
    struct edge_row *rows;
};

/* Of the first gradient, squared: far below the accuracy of a flexibility. */
static const double SETTLED = 1e-20;
/* Neighbours alone are coupled, so that far fewer steps settle it. */
enum { FIT_STEPS = 500 };

/* False: out of memory. */
static bool edge_fit_add(struct edge_fit *fit, const struct edge_row *row)
{
    if (fit->count == fit->room) {
        size_t room = 2 * fit->room + 64;
        struct edge_row *rows = realloc(fit->rows, room * sizeof *rows);
        if (!rows)
            return false;
        fit->rows = rows;
        fit->room = room;
    }
    fit->rows[fit->count++] = *row;
    return true;
}

static void edge_fit_free(struct edge_fit *fit)
{
    free(fit->rows);
    *fit = (struct edge_fit){0};
}

/* product += A^T W A values */
static void fit_multiply(const struct edge_fit *fit, const double *values, double *product)
{
    for (size_t r = 0; r < fit->count; r++) {
        const struct edge_row *row = &fit->rows[r];
        double sum = 0.0;
        for (size_t i = 0; i < row->count; i++)
            sum += row->shape[i] * values[row->index[i]];
        for (size_t i = 0; i < row->count; i++)
            product[row->index[i]] += row->weight * row->shape[i] * sum;
    }
}

static double fit_dot(size_t count, const double *a, const double *b)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++)
        sum += a[i] * b[i];
    return sum;
}

/* The `count` values that fit best, from those there are, each of which weighs `own` itself: it
 * decides where the rows say nothing. By conjugate gradients; false: out of memory. */
static bool edge_fit_solve(const struct edge_fit *fit, size_t count, double own, double *values)
{
    double *memory = calloc(3 * count + 1, sizeof *memory);
    double *residual = memory, *along = memory + count, *product = memory + 2 * count;
    if (!memory)
        return false;
    /* residual of the rows at the given values: own weights add nothing yet */
    fit_multiply(fit, values, product);
    for (size_t r = 0; r < fit->count; r++)
        for (size_t i = 0; i < fit->rows[r].count; i++)
            residual[fit->rows[r].index[i]] +=
                fit->rows[r].weight * fit->rows[r].shape[i] * fit->rows[r].rest;
    for (size_t i = 0; i < count; i++)
        along[i] = residual[i] -= product[i];
    double square = fit_dot(count, residual, residual), enough = SETTLED * square;
    /* conjugate gradients on A^T W A + own I */
    for (int step = 0; step < FIT_STEPS && square > enough; step++) {
        for (size_t i = 0; i < count; i++)
            product[i] = own * along[i];
        fit_multiply(fit, along, product);
        double length = square / fit_dot(count, along, product), before = square;
        for (size_t i = 0; i < count; i++) {
            values[i] += length * along[i];
            residual[i] -= length * product[i];
        }
        square = fit_dot(count, residual, residual);
        for (size_t i = 0; i < count; i++)
            along[i] = residual[i] + square / before * along[i];
    }
    free(memory);
    return true;
}

/* ---- values at the nodes of the faces ---- */

/* of the mesh's edges: nodes nearer to a sharp edge than this get values by fit: on the edge and in
 * the middle of a face at it */
static const double FITTED_TO = 0.6;
/* how much the mean of the values about a node weighs beside one point of its face, where shape
 * functions of the order of 0.1 are fitted: it decides only where the points say nothing */
static const double MEAN_WEIGHT = 1e-4;

/* and a place that was solved for */
static const double SITE_WEIGHT = 10.0;

/* Points each way at which a face is looked at. */
enum { FACE_GRID = 6 };

double site_field_curvature(const struct surface_point *point)
{
    return 0.5 * (point->curvature[0] + point->curvature[4] + point->curvature[8]);
}

/* points inside a face, in local coordinates */
static size_t grid_points(size_t count, double at[FACE_GRID * FACE_GRID][2])
{
    size_t filled = 0;
    for (size_t i = 0; i < FACE_GRID; i++)
        for (size_t j = 0; j < FACE_GRID; j++) {
            double a = ((double)i + 0.5) / FACE_GRID, b = ((double)j + 0.5) / FACE_GRID;
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
    size_t *index; /* [nodes]: which unknown a node is; NODE_KNOWN, NODE_ELSEWHERE */
    size_t unknowns;
    double *values, *weights; /* [unknowns]: means of the values about them */
    struct edge_fit fit;
};
static const size_t NODE_KNOWN = (size_t)-1, NODE_ELSEWHERE = (size_t)-2;

static bool is_in_group(const struct group *group, size_t face)
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
        if (group->index[node] != NODE_ELSEWHERE)
            continue;
        const double *point = group->rule->mesh->points[node];
        double edge = flexibility_edges_distance(group->field->edges, f->patch, point);
        bool unknown = edge < FITTED_TO * surface->size;
        group->index[node] = unknown ? group->unknowns++ : NODE_KNOWN;
        group->known[node] =
            unknown ? 0.0 : site_field_at(group->field, f, point, surface->points[face][n].normal);
    }
}

/* An error matters the more the less a flexibility is in doubt for other reasons. */
static double edge_weight(const struct group *group, double edge)
{
    double part = fmin(edge / group->rule->surface->size, 1.0);
    return part * part * part;
}

/* The field at a point of a face, and how much it weighs there: 0 where it is not known. Nearer to
 * an edge than any place it goes on as its edge terms do, and weighs little. */
static double field_at_point(const struct group *group, size_t face, const double at[2],
                             double *weight)
{
    const struct surface_rule *rule = group->rule;
    const struct surface_face *f = &rule->surface->faces[face];
    double nodes[FACE_MOST_NODES][3], x[3], outward[3];
    surface_rule_nodes(rule, face, nodes);
    facet_place(f->count, (const double(*)[3])nodes, at[0], at[1], x, outward);
    scale3(1.0 / norm3(outward), outward, outward);
    double edge = flexibility_edges_distance(group->field->edges, f->patch, x);
    double value = site_field_at(group->field, f, x, outward);
    *weight = isnan(value) ? 0.0 : edge_weight(group, edge);
    return value;
}

/* Adds a row: the shape functions' sum of the nodes' values at a point of a face equals the value.
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
        if (index == NODE_KNOWN) {
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
        any = any || group->index[f->nodes[n]] != NODE_KNOWN;
        whole = whole && !isnan(group->known[f->nodes[n]]);
    }
    return any && whole;
}

/* The field all over the face. False: out of memory. */
static bool add_rows(struct group *group, size_t face)
{
    double at[FACE_GRID * FACE_GRID][2];
    bool good = true;
    size_t points =
        is_fitted(group, face) ? grid_points(group->rule->surface->faces[face].count, at) : 0;
    for (size_t p = 0; p < points && good; p++) {
        double weight, value = field_at_point(group, face, at[p], &weight);
        good = weight == 0.0 || add_row(group, face, at[p], value, weight);
    }
    return good;
}

/* The solved values at their own places: also nearer to the edge than the field is known, at
 * requested sites. False: out of memory. */
static bool add_sites(struct group *group)
{
    const struct site_field *field = group->field;
    bool good = true;
    for (size_t i = 0; i < field->count && good; i++) {
        const struct flexibility_place *place = &field->places[i];
        const double at[2] = {place->u, place->v};
        if (isnan(field->values[i]) || !is_in_group(group, place->face) ||
            !is_fitted(group, place->face))
            continue;
        double weight = place->edge < flexibility_edges_known(field->edges, place->face)
                            ? 1.0
                            : edge_weight(group, place->edge);
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
        good = !is_in_group(group, f) || add_rows(group, f);
    good = good && add_sites(group);
    /* from the mean of the values about each */
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
static void fill_body_face(const struct group *group, size_t face, struct mesh_body_face *result)
{
    const struct surface_face *f = &group->rule->surface->faces[face];
    const struct material *material = &group->rule->mesh->part[f->part].material;
    for (size_t n = 0; n < f->count; n++) {
        double curvature = site_field_curvature(&group->rule->surface->points[face][n]);
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
    /* values known at its nodes */
    for (size_t node = 0; node < group->rule->mesh->node_count; node++)
        group->index[node] = NODE_ELSEWHERE;
    group->unknowns = group->fit.count = 0;
    for (size_t f = 0; f < surface->face_count; f++)
        if (is_in_group(group, f)) {
            take_nodes(group, f);
            members++;
        }
    if (members == 0)
        return true;
    /* fitted nodes; then all values to the faces */
    bool good = fit_unknowns(group);
    for (size_t f = 0; good && f < surface->face_count; f++)
        if (is_in_group(group, f))
            fill_body_face(group, f, &body->faces[f]);
    return good;
}

enum percuss_status site_field_spread(const struct site_field *field,
                                      const struct surface_rule *rule, struct mesh_body *body,
                                      struct fault *fault)
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

/* ---- faces that cannot be trusted ---- */

/* Allowed error of a face, times E and the distance from the edge, or the mesh's size where that is
 * less: as much as the error of answers holds near an edge (NEAR_EDGE in solve/model_deviation.c).
 */
static const double MOST_OFF = 0.5;
/* A contact's own compliance, Hertz's pressure on a half-space, is 3/5 (1 - nu^2) / (E radius), and
 * its radius at most half the distance from an edge: below the negative of that the body would have
 * less than no compliance. */
static const double HERTZ_MEAN = 0.6;

/* Interpolated flexibility of a face with so many nodes. */
static double interpolated(size_t count, const struct mesh_body_face *face, double u, double v)
{
    double shape[FACE_MOST_NODES], sum = 0.0;
    facet_shape((int)count, u, v, shape, NULL, NULL);
    for (size_t n = 0; n < count; n++)
        sum += shape[n] * face->flexibility[n];
    return sum;
}

static void withdraw_face(struct mesh_body_face *face)
{
    for (int n = 0; n < FACE_MOST_NODES; n++)
        face->flexibility[n] = NAN;
}

/* Compares faces with the values solved for on them. */
static void check_face_places(const struct site_field *field, struct mesh_body *body)
{
    for (size_t i = 0; i < field->count; i++) {
        const struct flexibility_place *place = &field->places[i];
        struct mesh_body_face *face = &body->faces[place->face];
        double length = fmin(place->edge, field->size);
        double off =
            interpolated(field->faces[i]->count, face, place->u, place->v) - field->values[i];
        if (fabs(off) * place->load.young * length > MOST_OFF)
            withdraw_face(face);
    }
}

/* Whether nowhere on a face it says less than a contact there can bear. */
static bool is_face_possible(const struct site_field *field, const struct surface_rule *rule,
                             size_t index, const struct mesh_body_face *face)
{
    const struct surface_face *f = &rule->surface->faces[index];
    const struct material *material = &rule->mesh->part[f->part].material;
    double own = 2.0 * HERTZ_MEAN * (1.0 - material->poisson * material->poisson) / material->young;
    double nodes[FACE_MOST_NODES][3], at[FACE_GRID * FACE_GRID][2];
    surface_rule_nodes(rule, index, nodes);
    size_t points = grid_points(f->count, at);
    for (size_t p = 0; p < points; p++) {
        double x[3];
        facet_place((int)f->count, (const double(*)[3])nodes, at[p][0], at[p][1], x, NULL);
        double edge = flexibility_edges_distance(field->edges, f->patch, x);
        if (edge < field->size && interpolated(f->count, face, at[p][0], at[p][1]) * edge < -own)
            return false;
    }
    return true;
}

/* Whether the place nearest to a face's middle is on a wall that is too thin. */
static bool is_face_thin(const struct site_field *field, const struct surface_rule *rule,
                         size_t index)
{
    const struct surface_face *f = &rule->surface->faces[index];
    const struct flexibility_place *nearest = NULL;
    double least = INFINITY;
    for (size_t i = 0; i < field->count; i++) {
        double offset[3];
        if (field->faces[i]->patch != f->patch)
            continue;
        sub3(field->points[i], rule->centres[index], offset);
        if (norm3(offset) < least) {
            least = norm3(offset);
            nearest = &field->places[i];
        }
    }
    return nearest && flexibility_place_thin(nearest);
}

size_t site_field_check(const struct site_field *field, const struct surface_rule *rule,
                        struct mesh_body *body)
{
    size_t unknown = 0;
    check_face_places(field, body);
    for (size_t f = 0; f < rule->surface->face_count; f++) {
        struct mesh_body_face *face = &body->faces[f];
        if (is_face_thin(field, rule, f) || !is_face_possible(field, rule, f, face))
            withdraw_face(face);
        bool known = true;
        for (size_t n = 0; n < rule->surface->faces[f].count; n++)
            known = known && !isnan(face->flexibility[n]);
        unknown += !known;
    }
    return unknown;
}
