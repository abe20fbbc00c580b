/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/site_field.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "model/vector.h"
#include "numeric/linear.h"

enum { POLYNOMIALS = 20 }; /* cubic ones of three coordinates */
/* terms of degree 1 (4), 2 (10) and 3 (20): used from so many places on, on a plane the half of
 * them being no more than rounding */
static const size_t FEWEST[4] = {1, 5, 12, 20};
static const size_t OF_DEGREE[4] = {1, 4, 10, 20};
/* Beside the sum of the weights. On a surface not all polynomials of space differ: of those that
 * say the same this takes the smallest; what it costs is its part of the value. */
static const double RIDGE = 1e-7;
/* of the distance to the farthest neighbour: a place within it has its own value */
static const double OWN = 0.02;
/* of the spacing: beyond, nothing is known */
static const double KNOWN = 2.5;
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

static void find(const struct site_field *field, const struct surface_face *face, const double x[3],
                 const double outward[3], size_t without, struct neighbours *found)
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
static void polynomials(const double y[3], double terms[POLYNOMIALS])
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
static bool weigh(const struct site_field *field, const double x[3],
                  const struct neighbours *near_it, double weights[SITE_FIELD_NEIGHBOURS])
{
    if (near_it->count == 0 || near_it->distances[0] > KNOWN * field->spacing)
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
        polynomials(y, terms[n]);
        weights[n] = pow(1.0 - q, 4.0) * (4.0 * q + 1.0) / (q * q + OWN * OWN);
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

/* what a place's value and edge terms are beyond those of its neighbours */
static bool left_out(const struct site_field *field, size_t place,
                     double differences[1 + SITE_FIELD_EDGE_TERMS])
{
    struct neighbours near_it;
    double weights[SITE_FIELD_NEIGHBOURS];
    find(field, field->faces[place], field->points[place], field->normals[place], place, &near_it);
    if (isnan(field->values[place]) || !weigh(field, field->points[place], &near_it, weights))
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

/* least squares of what is left out, by patches; all that is summed is linear in the coefficients
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
        /* two terms that say the same share what they say */
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
    find(field, face, x, outward, SIZE_MAX, &near_it);
    if (!weigh(field, x, &near_it, weights))
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
