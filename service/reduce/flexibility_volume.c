/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/flexibility_volume.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/vector.h"

/* An element whose distance from the place is less than so many radii is split: its displacements,
 * like 1/r, matter by (h / body)^2 to the whole, and 1e-3 of that is left. */
static const double FAR = 2.0;
enum { MOST_SPLITS = 2 };
static const int ROW[6] = {0, 1, 2, 0, 1, 2};
static const int COLUMN[6] = {0, 1, 2, 1, 2, 0};

static void fill_element(struct volume_rule *rule, size_t element)
{
    const struct solid_mesh *mesh = rule->mesh;
    const struct element_rule *points = &rule->rules[mesh->types[element]];
    double nodes[ELEMENT_MOST_NODES][3];
    element_points(mesh, element, nodes);
    /* points of integration, each with its volume */
    for (size_t p = 0; p < points->point_count; p++) {
        struct element_point here;
        element_at(points, p, nodes, &here);
        double *point = rule->points[rule->first[element] + p];
        memcpy(point, here.position, sizeof here.position);
        point[3] = here.volume;
    }
    rule->radii[element] = surface_rule_sphere(points->node_count, nodes, rule->centres[element]);
}

bool volume_rule_make(struct volume_rule *rule, const struct solid_mesh *mesh)
{
    /* room for what there is one of an element */
    size_t count = mesh->element_count, total = 0;
    *rule = (struct volume_rule){.mesh = mesh};
    rule->rules = malloc(VOLUME_RULE_TYPES * sizeof *rule->rules);
    rule->first = malloc((count + 1) * sizeof *rule->first);
    rule->centres = malloc(count * sizeof *rule->centres);
    rule->radii = malloc(count * sizeof *rule->radii);
    if (!rule->rules || !rule->first || !rule->centres || !rule->radii)
        goto no_memory;
    /* where the points of each element begin */
    for (int type = 0; type < VOLUME_RULE_TYPES; type++)
        element_rule_make((enum element_type)type, &rule->rules[type]);
    for (size_t e = 0; e < count; e++) {
        rule->first[e] = total;
        total += rule->rules[mesh->types[e]].point_count;
    }
    rule->first[count] = total;
    /* the points */
    rule->points = malloc(total * sizeof *rule->points);
    if (!rule->points)
        goto no_memory;
    for (size_t e = 0; e < count; e++)
        fill_element(rule, e);
    return true;

no_memory:
    volume_rule_free(rule);
    return false;
}

void volume_rule_free(struct volume_rule *rule)
{
    free(rule->rules);
    free(rule->first);
    free(rule->points);
    free(rule->centres);
    free(rule->radii);
    *rule = (struct volume_rule){0};
}

/* ---- mass ---- */

/* A part of an element in natural coordinates: a tetrahedron by its corners, or a box by two. */
struct piece {
    double corners[4][3];
};

/* what is summed for one place and element */
struct mass_sum {
    const struct flexibility_place *place;
    const struct element_rule *rule;
    enum element_type type;
    double (*nodes)[3];
    double sums[ELEMENT_MOST_NODES][3];
};

/* a point of the piece: of a tetrahedron with volume coordinates 1 - a - b - c, a, b, c; of a box
 * from the first corner to the second as the natural coordinates go from -1 to 1 */
static void in_piece(enum element_type type, const struct piece *piece, const double at[3],
                     double natural[3])
{
    for (int k = 0; k < 3; k++) {
        double from = piece->corners[0][k], to = piece->corners[1][k];
        natural[k] = from;
        if (type == ELEMENT_TET10)
            for (int i = 0; i < 3; i++)
                natural[k] += at[i] * (piece->corners[i + 1][k] - from);
        else
            natural[k] += 0.5 * (1.0 + at[k]) * (to - from);
    }
}

/* eight pieces of an eighth of the volume */
static void split(enum element_type type, const struct piece *piece, struct piece parts[8])
{
    if (type != ELEMENT_TET10) {
        for (int i = 0; i < 8; i++)
            for (int k = 0; k < 3; k++) {
                double from = piece->corners[0][k], half = 0.5 * (piece->corners[1][k] - from);
                parts[i].corners[0][k] = from + (i >> k & 1) * half;
                parts[i].corners[1][k] = parts[i].corners[0][k] + half;
            }
        return;
    }
    /* corners 0 to 3, middles 01 02 03 12 13 23; four at the corners, four about the line 03-12 */
    static const int PARTS[8][4] = {{0, 4, 5, 6}, {4, 1, 7, 8}, {5, 7, 2, 9}, {6, 8, 9, 3},
                                    {6, 7, 4, 5}, {6, 7, 5, 9}, {6, 7, 9, 8}, {6, 7, 8, 4}};
    static const int MIDDLES[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    double points[10][3];
    memcpy(points, piece->corners, sizeof piece->corners);
    for (int m = 0; m < 6; m++)
        for (int k = 0; k < 3; k++)
            points[4 + m][k] = 0.5 * (points[MIDDLES[m][0]][k] + points[MIDDLES[m][1]][k]);
    for (int i = 0; i < 8; i++)
        for (int c = 0; c < 4; c++)
            memcpy(parts[i].corners[c], points[PARTS[i][c]], sizeof points[0]);
}

static void add_mass_point(struct mass_sum *sum, const double x[3], double volume,
                           const double *shape)
{
    double u[3];
    boussinesq3_field(&sum->place->load, x, u, NULL);
    for (size_t n = 0; n < sum->rule->node_count; n++)
        add_scaled3(volume * shape[n], u, sum->sums[n]);
}

/* pieces are split while they are near the place; `scale`: their volume over the element's */
static void add_piece(struct mass_sum *sum, const struct piece *piece, double scale, int splits)
{
    const struct element_rule *rule = sum->rule;
    struct element_point here[ELEMENT_MOST_POINTS];
    double shapes[ELEMENT_MOST_POINTS][ELEMENT_MOST_NODES], nearest = INFINITY, volume = 0.0;
    /* points of the piece, its volume, and the nearest to the place */
    for (size_t p = 0; p < rule->point_count; p++) {
        double natural[3], gradient[ELEMENT_MOST_NODES][3], offset[3];
        in_piece(sum->type, piece, rule->at[p], natural);
        element_shapes(sum->type, natural, shapes[p], gradient);
        element_map(rule->node_count, sum->nodes, shapes[p], gradient, &here[p]);
        sub3(here[p].position, sum->place->load.point, offset);
        nearest = fmin(nearest, norm3(offset));
        volume += scale * rule->weight[p] * here[p].volume;
    }
    /* near: by eighths */
    if (splits < MOST_SPLITS && nearest < FAR * cbrt(volume)) {
        struct piece parts[8];
        split(sum->type, piece, parts);
        for (int i = 0; i < 8; i++)
            add_piece(sum, &parts[i], scale / 8.0, splits + 1);
        return;
    }
    /* far: by the rule */
    for (size_t p = 0; p < rule->point_count; p++)
        add_mass_point(sum, here[p].position, scale * rule->weight[p] * here[p].volume, shapes[p]);
}

void flexibility_volume_add_mass(const struct volume_rule *rule,
                                 const struct flexibility_place *place, double *momentum)
{
    static const struct piece WHOLE[2] = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                          {{{-1, -1, -1}, {1, 1, 1}}}};
    const struct solid_mesh *mesh = rule->mesh;
    for (size_t e = 0; e < mesh->element_count; e++) {
        enum element_type type = mesh->types[e];
        double nodes[ELEMENT_MOST_NODES][3], offset[3];
        struct mass_sum sum = {place, &rule->rules[type], type, nodes, {{0.0}}};
        /* near elements in pieces, far ones by their own points */
        sub3(rule->centres[e], place->load.point, offset);
        if (norm3(offset) < FAR * rule->radii[e]) {
            element_points(mesh, e, nodes);
            add_piece(&sum, &WHOLE[type != ELEMENT_TET10], 1.0, 0);
        } else {
            for (size_t i = rule->first[e]; i < rule->first[e + 1]; i++)
                add_mass_point(&sum, rule->points[i], rule->points[i][3],
                               sum.rule->shape[i - rule->first[e]]);
        }
        /* to the nodes, as momentum */
        double density = mesh->part[mesh->parts[e]].material.density;
        for (size_t n = 0; n < sum.rule->node_count; n++)
            add_scaled3(density, sum.sums[n], momentum + 3 * mesh->nodes[mesh->first[e] + n]);
    }
}

/* ---- stiffness ---- */

/* stress of a strain (xx yy zz xy yz zx, shears as half the angle), and the strain of a stress */
static void hooke(const struct material *material, const double strain[6], double stress[6])
{
    double twice = material->young / (1.0 + material->poisson);
    double lame = twice * material->poisson / (1.0 - 2.0 * material->poisson);
    double dilatation = strain[0] + strain[1] + strain[2];
    for (int k = 0; k < 6; k++)
        stress[k] = twice * strain[k] + (k < 3 ? lame * dilatation : 0.0);
}

static void hooke_inverse(const struct material *material, const double stress[6], double strain[6])
{
    double sum = stress[0] + stress[1] + stress[2];
    for (int k = 0; k < 6; k++)
        strain[k] =
            ((1.0 + material->poisson) * stress[k] - (k < 3 ? material->poisson * sum : 0.0)) /
            material->young;
}

static double product(const double a[6], const double b[6])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] +
           2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/* B^T stress in one point */
static void add_stress(const struct solid_mesh *mesh, size_t element,
                       const struct element_point *here, const double stress[6], double *force)
{
    size_t first = mesh->first[element], count = mesh->first[element + 1] - first;
    for (size_t n = 0; n < count; n++) {
        double part[3];
        boussinesq3_traction(stress, here->gradient[n], part);
        add_scaled3(here->volume, part, force + 3 * mesh->nodes[first + n]);
    }
}

double flexibility_volume_add_parts(const struct volume_rule *rule,
                                    const struct flexibility_place *place, double *force)
{
    const struct solid_mesh *mesh = rule->mesh;
    const struct material *own = &mesh->part[place->part].material;
    double work = 0.0;
    /* elements of the place's own stiffness balance already */
    for (size_t e = 0; e < mesh->element_count; e++) {
        const struct material *other = &mesh->part[mesh->parts[e]].material;
        if (other->young == own->young && other->poisson == own->poisson)
            continue;
        const struct element_rule *points = &rule->rules[mesh->types[e]];
        double nodes[ELEMENT_MOST_NODES][3];
        element_points(mesh, e, nodes);
        /* the stress of the place's material, less that of this one, at one strain */
        for (size_t p = 0; p < points->point_count; p++) {
            struct element_point here;
            double stress[6], strain[6], there[6];
            element_at(points, p, nodes, &here);
            boussinesq3_field(&place->load, here.position, NULL, stress);
            hooke_inverse(own, stress, strain);
            hooke(other, strain, there);
            for (int k = 0; k < 6; k++)
                stress[k] -= there[k];
            add_stress(mesh, e, &here, stress, force);
            work += here.volume * product(stress, strain);
        }
    }
    return work;
}

static bool has_held(const struct solid_mesh *mesh, size_t element, const bool *held)
{
    for (size_t i = mesh->first[element]; i < mesh->first[element + 1]; i++)
        if (held[3 * mesh->nodes[i]])
            return true;
    return false;
}

/* forces and mass of one point of a shifted element; returns the work */
static double add_shift(const struct solid_mesh *mesh, size_t element, const double *shape,
                        const struct element_point *here, const double *shifts, double *force,
                        double *momentum)
{
    const struct material *material = &mesh->part[mesh->parts[element]].material;
    const size_t *nodes = mesh->nodes + mesh->first[element];
    size_t count = mesh->first[element + 1] - mesh->first[element];
    double strain[6] = {0.0}, stress[6], shift[3] = {0.0};
    for (size_t n = 0; n < count; n++) {
        const double *u = shifts + 3 * nodes[n], *slope = here->gradient[n];
        add_scaled3(shape[n], u, shift);
        for (int k = 0; k < 6; k++)
            strain[k] += 0.5 * (slope[ROW[k]] * u[COLUMN[k]] + slope[COLUMN[k]] * u[ROW[k]]);
    }
    hooke(material, strain, stress);
    double work = here->volume * product(stress, strain);
    for (int k = 0; k < 6; k++)
        stress[k] = -stress[k];
    add_stress(mesh, element, here, stress, force);
    for (size_t n = 0; n < count; n++)
        add_scaled3(material->density * here->volume * shape[n], shift, momentum + 3 * nodes[n]);
    return work;
}

double flexibility_volume_add_shifts(const struct volume_rule *rule, const bool *held,
                                     const double *shifts, double *force, double *momentum)
{
    const struct solid_mesh *mesh = rule->mesh;
    double work = 0.0;
    for (size_t e = 0; e < mesh->element_count; e++) {
        if (!has_held(mesh, e, held))
            continue;
        const struct element_rule *points = &rule->rules[mesh->types[e]];
        double nodes[ELEMENT_MOST_NODES][3];
        element_points(mesh, e, nodes);
        for (size_t p = 0; p < points->point_count; p++) {
            struct element_point here;
            element_at(points, p, nodes, &here);
            work += add_shift(mesh, e, points->shape[p], &here, shifts, force, momentum);
        }
    }
    return work;
}
