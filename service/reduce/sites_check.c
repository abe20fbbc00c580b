/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/sites_check.h"

#include <math.h>

#include "model/facet.h"
#include "model/vector.h"

/* What a face may be off, times E and the distance from the edge, or the mesh's size where that is
 * less: as much as the error of answers holds near an edge (NEAR_EDGE in solve/model_deviation.c).
 */
static const double MOST_OFF = 0.5;
/* A contact's own compliance, Hertz's pressure on a half-space, is 3/5 (1 - nu^2) / (E radius), and
 * its radius at most half the distance from an edge: below the negative of that the body would have
 * less than no compliance. */
static const double HERTZ_MEAN = 0.6;

enum { GRID = 6 };

/* What a face of so many nodes says. */
static double told(size_t count, const struct mesh_body_face *face, double u, double v)
{
    double shape[FACE_MOST_NODES], sum = 0.0;
    facet_shape((int)count, u, v, shape, NULL, NULL);
    for (size_t n = 0; n < count; n++)
        sum += shape[n] * face->flexibility[n];
    return sum;
}

static void withdraw(struct mesh_body_face *face)
{
    for (int n = 0; n < FACE_MOST_NODES; n++)
        face->flexibility[n] = NAN;
}

/* Faces against what was solved for on them. */
static void check_places(const struct site_field *field, struct mesh_body *body)
{
    for (size_t i = 0; i < field->count; i++) {
        const struct flexibility_place *place = &field->places[i];
        struct mesh_body_face *face = &body->faces[place->face];
        double length = fmin(place->edge, field->size);
        double off = told(field->faces[i]->count, face, place->u, place->v) - field->values[i];
        if (fabs(off) * place->load.young * length > MOST_OFF)
            withdraw(face);
    }
}

/* Whether nowhere on a face it says less than a contact there can bear. */
static bool is_possible(const struct site_field *field, const struct surface_rule *rule,
                        size_t index, const struct mesh_body_face *face)
{
    const struct surface_face *f = &rule->surface->faces[index];
    const struct material *material = &rule->mesh->part[f->part].material;
    double own = 2.0 * HERTZ_MEAN * (1.0 - material->poisson * material->poisson) / material->young;
    double nodes[FACE_MOST_NODES][3];
    surface_rule_nodes(rule, index, nodes);
    for (int i = 0; i < GRID; i++)
        for (int j = 0; j < GRID; j++) {
            double a = (i + 0.5) / GRID, b = (j + 0.5) / GRID, x[3];
            if (f->count == FACE_TRIANGLE6 && a + b > 1.0)
                continue;
            double u = f->count == FACE_TRIANGLE6 ? a : 2.0 * a - 1.0;
            double v = f->count == FACE_TRIANGLE6 ? b : 2.0 * b - 1.0;
            facet_place((int)f->count, (const double(*)[3])nodes, u, v, x, NULL);
            double edge = flexibility_edges_distance(field->edges, f->patch, x);
            if (edge < field->size && told(f->count, face, u, v) * edge < -own)
                return false;
        }
    return true;
}

/* Whether the place nearest to a face's middle is on a wall that is too thin. */
static bool is_thin(const struct site_field *field, const struct surface_rule *rule, size_t index)
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

size_t sites_check(const struct site_field *field, const struct surface_rule *rule,
                   struct mesh_body *body)
{
    size_t unknown = 0;
    check_places(field, body);
    for (size_t f = 0; f < rule->surface->face_count; f++) {
        struct mesh_body_face *face = &body->faces[f];
        if (is_thin(field, rule, f) || !is_possible(field, rule, f, face))
            withdraw(face);
        bool known = true;
        for (size_t n = 0; n < rule->surface->faces[f].count; n++)
            known = known && !isnan(face->flexibility[n]);
        unknown += !known;
    }
    return unknown;
}
