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
            double sum = (atan((start + length) / aside) - atan(start / aside)) / aside;
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
    for (int p = 0; p < 2; p++) {
        free(field->parts[p].values);
        free(field->parts[p].edge_terms);
        free(field->parts[p].coefficients);
    }
    *field = (struct site_field){0};
}

/* Whether a place has a value. */
static bool is_known(const struct site_field *field, size_t place)
{
    return !isnan(field->parts[0].values[place]);
}

/* Whether two parts of the mesh are equally stiff: a flexibility goes on from one to the other. */
static bool is_alike(const struct solid_mesh *mesh, size_t one, size_t other)
{
    const struct material *a = &mesh->part[one].material, *b = &mesh->part[other].material;
    return a->young == b->young && a->poisson == b->poisson;
}

/* the first part that is as stiff as this one */
static size_t first_alike(const struct solid_mesh *mesh, size_t part)
{
    size_t first = 0;
    while (!is_alike(mesh, first, part))
        first++;
    return first;
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
            !is_alike(field->mesh, field->faces[i]->part, face->part) || i == without ||
            !is_known(field, i) || dot3(field->normals[i], outward) < OTHER_SIDE)
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

/* A place's neighbours and their weights. False: its own value is not known, or no other. */
static bool weigh_others(const struct site_field *field, size_t place, struct neighbours *near_it,
                         double weights[SITE_FIELD_NEIGHBOURS])
{
    find_neighbours(field, field->faces[place], field->points[place], field->normals[place], place,
                    near_it);
    return is_known(field, place) &&
           weigh_neighbours(field, field->points[place], near_it, weights);
}

/* A number of rows [count][width] at a place, less that interpolated from its neighbours. */
static double left_out(const double *rows, size_t width, size_t place,
                       const struct neighbours *near_it, const double *weights)
{
    double difference = rows[place * width];
    for (size_t n = 0; n < near_it->count; n++)
        difference -= weights[n] * rows[near_it->places[n] * width];
    return difference;
}

/* The same of a part's number, [0], and of its edge terms. */
static void part_left_out(const struct site_field_part *part, size_t number, size_t place,
                          const struct neighbours *near_it, const double *weights,
                          double differences[1 + SITE_FIELD_EDGE_TERMS])
{
    size_t stride = part->terms * part->width;
    differences[0] = left_out(part->values + number, part->width, place, near_it, weights);
    for (size_t t = 0; t < part->terms; t++)
        differences[1 + t] =
            left_out(part->edge_terms + t * part->width + number, stride, place, near_it, weights);
}

/* least squares of these differences, by patches; all that is summed is linear in the coefficients
 */
static bool fit_edges(const struct site_field *field, struct site_field_part *part,
                      size_t patch_count)
{
    enum { MOST = SITE_FIELD_EDGE_TERMS };
    size_t terms = part->terms;
    double(*matrix)[MOST * MOST] = calloc(patch_count, sizeof *matrix);
    double(*side)[MOST] = calloc(patch_count, sizeof *side);
    bool good = matrix && side;
    for (size_t i = 0; good && i < field->count; i++) {
        struct neighbours near_it;
        double weights[SITE_FIELD_NEIGHBOURS], d[1 + MOST];
        if (!weigh_others(field, i, &near_it, weights))
            continue;
        size_t patch = field->faces[i]->patch;
        for (size_t number = 0; number < part->width; number++) {
            part_left_out(part, number, i, &near_it, weights, d);
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

static bool make_room(struct site_field *field, size_t count, size_t patch_count, bool along)
{
    field->parts[0].width = 1;
    field->parts[0].terms = 4;
    field->parts[1].width = along ? 6 : 0;
    field->parts[1].terms = SITE_FIELD_EDGE_TERMS;
    field->faces = malloc((count + 1) * sizeof *field->faces);
    field->points = malloc((count + 1) * sizeof *field->points);
    field->normals = malloc((count + 1) * sizeof *field->normals);
    bool good = field->faces && field->points && field->normals;
    for (int p = 0; p < 2; p++) {
        struct site_field_part *part = &field->parts[p];
        size_t numbers = count * part->width + 1;
        part->values = malloc(numbers * sizeof *part->values);
        part->edge_terms = malloc(numbers * part->terms * sizeof *part->edge_terms);
        part->coefficients = malloc((patch_count + 1) * sizeof *part->coefficients);
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
                                 .places = places};
    size_t patch_count = rule->surface->patch_count;
    bool good = make_room(field, count, patch_count, tensors != NULL);
    field->count = count;
    for (size_t i = 0; good && i < count; i++)
        take_place(field, i, &rule->surface->faces[places[i].face], values[i],
                   tensors ? tensors[i] : NULL);
    for (int p = 0; good && p < (tensors ? 2 : 1); p++)
        good = fit_edges(field, &field->parts[p], patch_count);
    if (!good)
        site_field_free(field);
    return good;
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
    struct neighbours near_it;
    double weights[SITE_FIELD_NEIGHBOURS], d[1 + SITE_FIELD_EDGE_TERMS];
    if (!weigh_others(field, place, &near_it, weights))
        return NAN;
    part_left_out(part, 0, place, &near_it, weights, d);
    for (size_t t = 0; t < part->terms; t++)
        d[0] -= part->coefficients[field->faces[place]->patch][t] * d[1 + t];
    return -d[0];
}

/* ---- values at nodes that many faces share, by least squares ---- */

/* sum of shape[i] value[index[i]] = rest for each of the numbers, so much weighed. */
struct edge_row {
    size_t count;
    size_t index[FACE_MOST_NODES];
    double shape[FACE_MOST_NODES];
    double rest[SITE_FIELD_NUMBERS], weight;
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

/* The `count` values of a number that fit best, from those there are, each of which weighs `own`
 * itself: it decides where the rows say nothing. By conjugate gradients; false: out of memory. */
static bool edge_fit_solve(const struct edge_fit *fit, size_t number, size_t count, double own,
                           double *values)
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
                fit->rows[r].weight * fit->rows[r].shape[i] * fit->rows[r].rest[number];
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

/* Faces of one patch and one stiffness, which have one value at a node that they share. */
struct group {
    const struct site_field *field;
    const struct surface_rule *rule;
    size_t patch, part;
    size_t numbers;                      /* that are wanted */
    double (*known)[SITE_FIELD_NUMBERS]; /* [nodes], of those of the group's faces */
    size_t *index; /* [nodes]: which unknown a node is; NODE_KNOWN, NODE_ELSEWHERE */
    size_t unknowns;
    double *values, *weights; /* [numbers][unknowns], [unknowns]: means of the values about them */
    struct edge_fit fit;
};
static const size_t NODE_KNOWN = (size_t)-1, NODE_ELSEWHERE = (size_t)-2;

static bool is_in_group(const struct group *group, size_t face)
{
    const struct surface_face *f = &group->rule->surface->faces[face];
    return f->patch == group->patch && is_alike(group->rule->mesh, f->part, group->part);
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
        memset(group->known[node], 0, sizeof group->known[node]);
        if (!unknown)
            site_field_at(group->field, f, point, surface->points[face][n].normal,
                          group->known[node]);
    }
}

/* An error matters the more the less a flexibility is in doubt for other reasons. */
static double edge_weight(const struct group *group, double edge)
{
    double part = fmin(edge / group->rule->surface->size, 1.0);
    return part * part * part;
}

/* The field at a point of a face; returns how much it weighs there: 0 where it is not known. Nearer
 * to an edge than any place it goes on as its edge terms do, and weighs little. */
static double field_at_point(const struct group *group, size_t face, const double at[2],
                             double numbers[SITE_FIELD_NUMBERS])
{
    const struct surface_rule *rule = group->rule;
    const struct surface_face *f = &rule->surface->faces[face];
    double nodes[FACE_MOST_NODES][3], x[3], outward[3];
    surface_rule_nodes(rule, face, nodes);
    facet_place(f->count, (const double(*)[3])nodes, at[0], at[1], x, outward);
    scale3(1.0 / norm3(outward), outward, outward);
    double edge = flexibility_edges_distance(group->field->edges, f->patch, x);
    site_field_at(group->field, f, x, outward, numbers);
    return isnan(numbers[0]) ? 0.0 : edge_weight(group, edge);
}

/* Adds a row: the shape functions' sum of the nodes' numbers at a point of a face equals these.
 * False: out of memory. */
static bool add_row(struct group *group, size_t face, const double at[2],
                    const double numbers[SITE_FIELD_NUMBERS], double weight)
{
    const struct surface_face *f = &group->rule->surface->faces[face];
    struct edge_row row = {.weight = weight};
    memcpy(row.rest, numbers, sizeof row.rest);
    double shape[FACE_MOST_NODES];
    facet_shape(f->count, at[0], at[1], shape, NULL, NULL);
    /* known nodes' parts go to the other side; unknowns get a mean */
    for (size_t n = 0; n < f->count; n++) {
        size_t node = f->nodes[n], index = group->index[node];
        for (size_t k = 0; index == NODE_KNOWN && k < group->numbers; k++)
            row.rest[k] -= shape[n] * group->known[node][k];
        if (index == NODE_KNOWN)
            continue;
        row.index[row.count] = index;
        row.shape[row.count++] = shape[n];
        for (size_t k = 0; k < group->numbers; k++)
            group->values[k * group->unknowns + index] += weight * numbers[k];
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
        whole = whole && !isnan(group->known[f->nodes[n]][0]);
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
        double numbers[SITE_FIELD_NUMBERS], weight = field_at_point(group, face, at[p], numbers);
        good = weight == 0.0 || add_row(group, face, at[p], numbers, weight);
    }
    return good;
}

/* What was solved for at a place. */
static void site_numbers(const struct site_field *field, size_t place,
                         double numbers[SITE_FIELD_NUMBERS])
{
    const struct site_field_part *rest = &field->parts[1];
    for (size_t k = 0; k < SITE_FIELD_NUMBERS; k++)
        numbers[k] = NAN;
    numbers[0] = field->parts[0].values[place];
    for (size_t k = 0; k < rest->width; k++)
        numbers[1 + k] = rest->values[place * rest->width + k];
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
        double numbers[SITE_FIELD_NUMBERS];
        if (!is_known(field, i) || !is_in_group(group, place->face) ||
            !is_fitted(group, place->face))
            continue;
        site_numbers(field, i, numbers);
        double weight = place->edge < flexibility_edges_known(field->edges, place->face)
                            ? 1.0
                            : edge_weight(group, place->edge);
        good = add_row(group, place->face, at, numbers, SITE_WEIGHT * weight);
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
    for (size_t k = 0; good && k < group->numbers; k++) {
        double *values = group->values + k * group->unknowns;
        for (size_t i = 0; i < group->unknowns; i++)
            values[i] = group->weights[i] > 0.0 ? values[i] / group->weights[i] : 0.0;
        good = edge_fit_solve(&group->fit, k, group->unknowns, MEAN_WEIGHT, values);
        for (size_t node = 0; good && node < group->rule->mesh->node_count; node++) {
            size_t index = group->index[node];
            if (index < group->unknowns)
                group->known[node][k] = group->weights[index] > 0.0 ? values[index] : NAN;
        }
    }
    return good;
}

/* The fit of all nodes near edges. False: out of memory. */
static bool fit_unknowns(struct group *group)
{
    if (group->unknowns == 0)
        return true;
    group->values = calloc((group->numbers + 1) * group->unknowns, sizeof *group->values);
    if (!group->values)
        return false;
    group->weights = group->values + group->numbers * group->unknowns;
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
        const struct surface_point *point = &group->rule->surface->points[face][n];
        double curvature = site_field_curvature(point), *known = group->known[f->nodes[n]];
        double *tensor = known + 1;
        result->flexibility[n] = known[0];
        mesh_body_set_normal(point->normal, known[0], tensor);
        for (int k = 0; k < 6; k++)
            result->tensor[n][k] = (float)tensor[k];
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
                          .numbers = 1 + field->parts[1].width,
                          .known = malloc(nodes * sizeof *group.known),
                          .index = malloc(nodes * sizeof *group.index)};
    bool good = group.known && group.index;
    for (group.patch = 0; good && group.patch < rule->surface->patch_count; group.patch++)
        for (group.part = 0; good && group.part < rule->mesh->part_count; group.part++)
            good = first_alike(rule->mesh, group.part) != group.part || spread_group(&group, body);
    body->all_ways = field->parts[1].width > 0;
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

/* The largest difference of a face's interpolated tensor from that solved for at a place, but for
 * the part along the normal. */
static double tensor_off(const struct site_field *field, size_t place,
                         const struct mesh_body_face *face)
{
    const struct flexibility_place *at = &field->places[place];
    double shape[FACE_MOST_NODES], tensor[6], largest = 0.0;
    facet_shape((int)field->faces[place]->count, at->u, at->v, shape, NULL, NULL);
    for (int k = 0; k < 6; k++) {
        tensor[k] = 0.0;
        for (size_t n = 0; n < field->faces[place]->count; n++)
            tensor[k] += shape[n] * (double)face->tensor[n][k];
    }
    mesh_body_set_normal(field->normals[place], 0.0, tensor);
    for (int k = 0; k < 6; k++)
        largest = fmax(largest, fabs(tensor[k] - field->parts[1].values[6 * place + (size_t)k]));
    return largest;
}

static void withdraw_tensor(struct mesh_body_face *face)
{
    for (int n = 0; n < FACE_MOST_NODES; n++)
        for (int k = 0; k < 6; k++)
            face->tensor[n][k] = NAN;
}

static void withdraw_face(struct mesh_body_face *face)
{
    for (int n = 0; n < FACE_MOST_NODES; n++)
        face->flexibility[n] = NAN;
    withdraw_tensor(face);
}

/* Compares faces with the values solved for on them. */
static void check_face_places(const struct site_field *field, struct mesh_body *body)
{
    for (size_t i = 0; i < field->count; i++) {
        const struct flexibility_place *place = &field->places[i];
        struct mesh_body_face *face = &body->faces[place->face];
        double most = MOST_OFF / (place->load.young * fmin(place->edge, field->size));
        double off = interpolated(field->faces[i]->count, face, place->u, place->v) -
                     field->parts[0].values[i];
        if (fabs(off) > most)
            withdraw_face(face);
        else if (field->parts[1].width > 0 && is_known(field, i) &&
                 !(tensor_off(field, i, face) <= most))
            withdraw_tensor(face);
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
        bool known = true, possible = true;
        for (size_t n = 0; n < rule->surface->faces[f].count; n++) {
            known = known && !isnan(face->flexibility[n]);
            possible =
                possible && (!body->all_ways || mesh_body_tensor_possible(body, face, (int)n));
        }
        if (!possible)
            withdraw_tensor(face);
        unknown += !known;
    }
    return unknown;
}
