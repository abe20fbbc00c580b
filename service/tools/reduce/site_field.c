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

/* Integrals of ds / r^2 along the edges of a patch, of the sharp ones and of the hollow ones: of 1,
 * of the direction q to the edge in the surface, and of q q^T. */
struct edge_sums {
    double all[2], towards[2][3], across[2][6];
};

static const int ROW[6] = {0, 1, 2, 0, 1, 2}, COLUMN[6] = {0, 1, 2, 1, 2, 0};

static void sum_edges(const struct site_field *field, size_t patch, const double x[3],
                      const double normal[3], struct edge_sums *sums)
{
    const struct flexibility_edges *edges = field->edges;
    double blunt = BLUNT * field->size;
    memset(sums, 0, sizeof *sums);
    /* each edge as two straight lines through its middle */
    for (size_t i = 0; i < edges->count; i++) {
        if (edges->patches[i] != patch)
            continue;
        bool hollow = edges->hollow[i];
        for (int half = 0; half < 2; half++) {
            const double *from = edges->points[i][half], *to = edges->points[i][half + 1];
            /* along it and aside; no nearer than the edge is blunt */
            double along[3], offset[3];
            sub3(to, from, along);
            sub3(x, from, offset);
            double length = norm3(along), start = -dot3(offset, along) / length;
            double square = dot3(offset, offset) - start * start;
            double aside = sqrt(fmax(square, blunt * blunt));
            /* the angle that it is seen under */
            double sum = atan2(aside * length, aside * aside + start * (start + length)) / aside;
            sums->all[hollow] += sum;
            /* the direction aside, in the surface */
            add_scaled3(start / length, along, offset);
            add_scaled3(-dot3(offset, normal), normal, offset);
            scale3(-1.0 / aside, offset, offset);
            add_scaled3(sum, offset, sums->towards[hollow]);
            for (int k = 0; k < 6; k++)
                sums->across[hollow][k] += sum * offset[ROW[k]] * offset[COLUMN[k]];
        }
    }
}

/* Over pi: 1/distance from a long straight edge, and from two at a corner the sum of both. And its
 * logarithm, the next one for a quarter of space that is bent. The same of hollow edges. 0 without
 * an edge. */
static void normal_edge_terms(const struct site_field *field, const struct edge_sums *sums,
                              double terms[4])
{
    for (int k = 0; k < 2; k++) {
        terms[2 * k] = field->size * sums->all[k] / M_PI;
        terms[2 * k + 1] = sums->all[k] > 0.0 ? log(terms[2 * k]) : 0.0;
    }
}

/* The same two alike in all directions of the surface; of the direction to the edge alone; between
 * it and the normal. */
static void along_edge_terms(const struct site_field *field, const struct edge_sums *sums,
                             const double n[3], double terms[8][6])
{
    double scalars[4];
    normal_edge_terms(field, sums, scalars);
    for (int h = 0; h < 2; h++)
        for (int k = 0; k < 6; k++) {
            int i = ROW[k], j = COLUMN[k];
            double flat = (i == j) - n[i] * n[j], unit = field->size / M_PI;
            const double *q = sums->towards[h];
            terms[4 * h][k] = scalars[2 * h] * flat;
            terms[4 * h + 1][k] = scalars[2 * h + 1] * flat;
            terms[4 * h + 2][k] = unit * sums->across[h][k];
            terms[4 * h + 3][k] = unit * (q[i] * n[j] + n[i] * q[j]);
        }
}

/* Edge terms of a part: [terms][width]. */
static void edge_terms(const struct site_field *field, const struct site_field_part *part,
                       const struct edge_sums *sums, const double normal[3], double *terms)
{
    if (part->width == 1)
        normal_edge_terms(field, sums, terms);
    else
        along_edge_terms(field, sums, normal, (double(*)[6])terms);
}

void site_field_free(struct site_field *field)
{
    free(field->faces);
    free(field->points);
    free(field->normals);
    free(field->others);
    for (int p = 0; p < 2; p++) {
        free(field->parts[p].values);
        free(field->parts[p].edge_terms);
        free(field->parts[p].coefficients);
    }
    *field = (struct site_field){0};
}

bool site_field_known(const struct site_field *field, size_t place)
{
    return !isnan(field->parts[0].values[place]);
}

bool site_field_alike(const struct solid_mesh *mesh, size_t one, size_t other)
{
    const struct material *a = &mesh->part[one].material, *b = &mesh->part[other].material;
    return a->young == b->young && a->poisson == b->poisson;
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
    /* of the same patch and stiffness, known, and not across a thin wall */
    for (size_t i = 0; i < field->count; i++) {
        if (field->faces[i]->patch != face->patch ||
            !site_field_alike(field->mesh, field->faces[i]->part, face->part) || i == without ||
            !site_field_known(field, i) || dot3(field->normals[i], outward) < OTHER_SIDE)
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

/* A place's neighbours and their weights: none where its own value is not known, or no other. */
static void weigh_others(struct site_field *field, size_t place)
{
    struct site_others *others = &field->others[place];
    struct neighbours near_it;
    others->count = 0;
    if (!site_field_known(field, place))
        return;
    find_neighbours(field, field->faces[place], field->points[place], field->normals[place], place,
                    &near_it);
    if (!weigh_neighbours(field, field->points[place], &near_it, others->weights))
        return;
    others->count = near_it.count;
    memcpy(others->places, near_it.places, near_it.count * sizeof *others->places);
}

/* A number of rows [count][width] at a place, less that interpolated from its neighbours. */
static double left_out(const struct site_field *field, const double *rows, size_t width,
                       size_t place)
{
    const struct site_others *others = &field->others[place];
    double difference = rows[place * width];
    for (size_t n = 0; n < others->count; n++)
        difference -= others->weights[n] * rows[others->places[n] * width];
    return difference;
}

/* The same of a part's number, [0], and of its edge terms. */
static void part_left_out(const struct site_field *field, const struct site_field_part *part,
                          size_t number, size_t place,
                          double differences[1 + SITE_FIELD_EDGE_TERMS])
{
    size_t stride = part->terms * part->width;
    differences[0] = left_out(field, part->values + number, part->width, place);
    for (size_t t = 0; t < part->terms; t++)
        differences[1 + t] =
            left_out(field, part->edge_terms + t * part->width + number, stride, place);
}

/* least squares of these differences, by patches; all that is summed is linear in the coefficients
 */
static bool fit_edges(const struct site_field *field, struct site_field_part *part)
{
    enum { MOST = SITE_FIELD_EDGE_TERMS };
    size_t terms = part->terms, patch_count = field->patch_count;
    double(*matrix)[MOST * MOST] = calloc(patch_count, sizeof *matrix);
    double(*side)[MOST] = calloc(patch_count, sizeof *side);
    bool good = matrix && side;
    for (size_t i = 0; good && i < field->count; i++) {
        double d[1 + MOST];
        if (field->others[i].count == 0)
            continue;
        size_t patch = field->faces[i]->patch;
        for (size_t number = 0; number < part->width; number++) {
            part_left_out(field, part, number, i, d);
            for (size_t t = 0; t < terms; t++) {
                side[patch][t] += d[1 + t] * d[0];
                for (size_t u = 0; u < terms; u++)
                    matrix[patch][t * terms + u] += d[1 + t] * d[1 + u];
            }
        }
    }
    for (size_t p = 0; good && p < patch_count; p++) {
        /* equal terms share their coefficient */
        double ridge = 0.0;
        for (size_t t = 0; t < terms; t++)
            ridge += 1e-6 * matrix[p][t * terms + t];
        for (size_t t = 0; t < terms; t++)
            matrix[p][t * terms + t] += ridge;
        bool solved = ridge > 0.0 && linear_solve(terms, matrix[p], side[p]);
        for (size_t t = 0; t < terms; t++)
            part->coefficients[p][t] = solved ? side[p][t] : 0.0;
    }
    free(matrix);
    free(side);
    return good;
}

static bool make_room(struct site_field *field, size_t count, bool along)
{
    field->parts[0].width = 1;
    field->parts[0].terms = 4;
    field->parts[1].width = along ? 6 : 0;
    field->parts[1].terms = SITE_FIELD_EDGE_TERMS;
    field->faces = malloc((count + 1) * sizeof *field->faces);
    field->points = malloc((count + 1) * sizeof *field->points);
    field->normals = malloc((count + 1) * sizeof *field->normals);
    field->others = malloc((count + 1) * sizeof *field->others);
    bool good = field->faces && field->points && field->normals && field->others;
    for (int p = 0; p < 2; p++) {
        struct site_field_part *part = &field->parts[p];
        size_t numbers = count * part->width + 1;
        part->values = malloc(numbers * sizeof *part->values);
        part->edge_terms = malloc(numbers * part->terms * sizeof *part->edge_terms);
        part->coefficients = malloc((field->patch_count + 1) * sizeof *part->coefficients);
        good = good && part->values && part->edge_terms && part->coefficients;
    }
    return good;
}

/* A place with its value, and its tensor without the part along the normal (NULL: none). */
static void take_place(struct site_field *field, size_t i, const struct surface_face *face,
                       double value, const double *tensor)
{
    const struct flexibility_place *place = &field->places[i];
    struct edge_sums sums;
    field->faces[i] = face;
    memcpy(field->points[i], place->load.point, sizeof field->points[i]);
    scale3(-1.0, place->load.inward, field->normals[i]);
    field->parts[0].values[i] = value;
    if (tensor) {
        double *rest = field->parts[1].values + 6 * i;
        memcpy(rest, tensor, 6 * sizeof *rest);
        mesh_body_set_normal(field->normals[i], 0.0, rest);
    }
    sum_edges(field, face->patch, field->points[i], field->normals[i], &sums);
    for (int p = 0; p < (tensor ? 2 : 1); p++) {
        struct site_field_part *part = &field->parts[p];
        edge_terms(field, part, &sums, field->normals[i],
                   part->edge_terms + i * part->terms * part->width);
    }
}

bool site_field_make(struct site_field *field, const struct surface_rule *rule,
                     const struct flexibility_edges *edges, size_t count,
                     const struct flexibility_place *places, const double *values,
                     const double (*tensors)[6], double spacing)
{
    *field = (struct site_field){.mesh = rule->mesh,
                                 .edges = edges,
                                 .size = rule->surface->size,
                                 .spacing = spacing,
                                 .patch_count = rule->surface->patch_count,
                                 .places = places};
    bool good = make_room(field, count, tensors != NULL);
    field->count = count;
    for (size_t i = 0; good && i < count; i++)
        take_place(field, i, &rule->surface->faces[places[i].face], values[i],
                   tensors ? tensors[i] : NULL);
    for (size_t i = 0; good && i < count; i++)
        weigh_others(field, i);
    for (int p = 0; good && p < (tensors ? 2 : 1); p++)
        good = fit_edges(field, &field->parts[p]);
    if (!good)
        site_field_free(field);
    return good;
}

bool site_field_refit(struct site_field *field, const double *values)
{
    memcpy(field->parts[0].values, values, field->count * sizeof *values);
    return fit_edges(field, &field->parts[0]);
}

/* A part's numbers at x: the edge terms there, and the mean of what they leave at the neighbours.
 */
static void part_at(const struct site_field_part *part, size_t patch, const double *here,
                    const struct neighbours *near_it, const double *weights, double *numbers)
{
    const double *coefficients = part->coefficients[patch];
    for (size_t k = 0; k < part->width; k++) {
        double sum = 0.0;
        for (size_t t = 0; t < part->terms; t++)
            sum += coefficients[t] * here[t * part->width + k];
        for (size_t n = 0; n < near_it->count; n++) {
            size_t place = near_it->places[n];
            const double *terms = part->edge_terms + place * part->terms * part->width + k;
            double rest = part->values[place * part->width + k];
            for (size_t t = 0; t < part->terms; t++)
                rest -= coefficients[t] * terms[t * part->width];
            sum += weights[n] * rest;
        }
        numbers[k] = sum;
    }
}

void site_field_at(const struct site_field *field, const struct surface_face *face,
                   const double x[3], const double outward[3], double numbers[SITE_FIELD_NUMBERS])
{
    struct neighbours near_it;
    struct edge_sums sums;
    double weights[SITE_FIELD_NEIGHBOURS], here[6 * SITE_FIELD_EDGE_TERMS];
    for (int k = 0; k < SITE_FIELD_NUMBERS; k++)
        numbers[k] = NAN;
    find_neighbours(field, face, x, outward, SIZE_MAX, &near_it);
    if (!weigh_neighbours(field, x, &near_it, weights))
        return;
    sum_edges(field, face->patch, x, outward, &sums);
    for (int p = 0; p < 2; p++) {
        const struct site_field_part *part = &field->parts[p];
        edge_terms(field, part, &sums, outward, here);
        part_at(part, face->patch, here, &near_it, weights, numbers + p);
    }
}

double site_field_error(const struct site_field *field, size_t place)
{
    const struct site_field_part *part = &field->parts[0];
    double d[1 + SITE_FIELD_EDGE_TERMS];
    if (field->others[place].count == 0)
        return NAN;
    part_left_out(field, part, 0, place, d);
    for (size_t t = 0; t < part->terms; t++)
        d[0] -= part->coefficients[field->faces[place]->patch][t] * d[1 + t];
    return -d[0];
}
