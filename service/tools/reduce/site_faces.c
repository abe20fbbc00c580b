/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/site_faces.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/watch.h"
#include "model/facet.h"
#include "model/vector.h"
#include "reduce/flexibility.h"

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

double site_faces_curvature(const struct surface_point *point)
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

/* the first part that is as stiff as this one */
static size_t first_alike(const struct solid_mesh *mesh, size_t part)
{
    size_t first = 0;
    while (!site_field_alike(mesh, first, part))
        first++;
    return first;
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
    return f->patch == group->patch && site_field_alike(group->rule->mesh, f->part, group->part);
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
        if (!site_field_known(field, i) || !is_in_group(group, place->face) ||
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
        double curvature = site_faces_curvature(point), *known = group->known[f->nodes[n]];
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

enum percuss_status site_faces_fill(const struct site_field *field, const struct surface_rule *rule,
                                    struct mesh_body *body, struct fault *fault)
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

size_t site_faces_points(const struct site_field *field, const struct surface_rule *rule)
{
    const struct surface *surface = rule->surface;
    double at[FACE_GRID * FACE_GRID][2];
    size_t points = rule->mesh->node_count;
    for (size_t f = 0; f < surface->face_count; f++) {
        double edge =
            flexibility_edges_distance(field->edges, surface->faces[f].patch, rule->centres[f]);
        bool fitted = edge < FITTED_TO * surface->size + rule->radii[f];
        points += fitted ? grid_points(surface->faces[f].count, at) : 0;
    }
    return points;
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
        else if (field->parts[1].width > 0 && site_field_known(field, i) &&
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

size_t site_faces_check(const struct site_field *field, const struct surface_rule *rule,
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
