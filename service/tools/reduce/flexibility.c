/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/flexibility.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/element.h"
#include "model/facet.h"
#include "model/vector.h"
#include "numeric/dense.h"
#include "reduce/piece.h"

/* ---- integrals over the surface ---- */

/* The rule of degree 6 is good to 1e-8 of a field that changes with the distance from the place,
 * where that is as many radii of a triangle; nearer ones are split. */
static const double SURFACE_FAR = 6.0;
/* Halvings of a triangle, each across its longest side, so that a slender one takes as many more as
 * the logarithm of its slenderness. Smaller ones are not split any more: where the place lies
 * within one the face is plane, t bounded and u like 1/r, and the error is the part of a part. */
enum { SURFACE_SPLITS = 20 };

/* sums for one place and face */
struct surface_sum {
    const struct flexibility_place *place;
    int count; /* nodes of the face */
    const double (*nodes)[3];
    bool in_plane;                     /* the half-space's own tractions are zero */
    double forces[FACE_MOST_NODES][3]; /* integral of N^T t */
    double energy;                     /* of t.u */
};

/* the field's traction on an area and its displacement */
static void surface_look(const struct flexibility_place *place, bool in_plane, const double x[3],
                         const double area[3], double traction[3], double displacement[3])
{
    double stress[6];
    boussinesq3_field(&place->load, x, displacement, in_plane ? NULL : stress);
    if (in_plane)
        boussinesq3_added_stress(&place->load, x, stress);
    boussinesq3_traction(stress, area, traction);
}

static void surface_add_point(struct surface_sum *sum, const double at[2], double weight,
                              bool with_force, bool with_energy)
{
    double x[3], area[3], traction[3], displacement[3], shape[FACE_MOST_NODES];
    facet_look(sum->count, sum->nodes, at[0], at[1], shape, x, area);
    surface_look(sum->place, sum->in_plane, x, area, traction, displacement);
    if (with_energy)
        sum->energy += weight * dot3(traction, displacement);
    if (!with_force)
        return;
    for (int n = 0; n < sum->count; n++)
        add_scaled3(weight * shape[n], traction, sum->forces[n]);
}

/* a triangle of a face, in local coordinates and in space */
struct surface_part {
    struct surface_triangle local;
    double points[3][3];
};

/* the two halves on both sides of the middle of its longest side */
static void surface_halve(const struct surface_sum *sum, const struct surface_part *part,
                          struct surface_part halves[2])
{
    double longest = -1.0, middle[2], between[3];
    int from = 0;
    for (int i = 0; i < 3; i++) {
        double side[3];
        sub3(part->points[(i + 1) % 3], part->points[i], side);
        if (dot3(side, side) > longest) {
            longest = dot3(side, side);
            from = i;
        }
    }
    int to = (from + 1) % 3;
    for (int k = 0; k < 2; k++)
        middle[k] = 0.5 * (part->local.corners[from][k] + part->local.corners[to][k]);
    facet_place(sum->count, sum->nodes, middle[0], middle[1], between, NULL);
    /* it takes the place of one end in each half */
    for (int half = 0; half < 2; half++) {
        int end = half == 0 ? to : from;
        halves[half] = *part;
        memcpy(halves[half].local.corners[end], middle, sizeof middle);
        memcpy(halves[half].points[end], between, sizeof between);
    }
}

/* a triangle that is split until it is small beside its distance */
static void surface_add_part(struct surface_sum *sum, const struct surface_part *part, int splits)
{
    /* near: by halves */
    double centre[3], offset[3];
    struct surface_part whole = *part;
    double radius = surface_rule_sphere(3, whole.points, centre);
    sub3(centre, sum->place->load.point, offset);
    if (norm3(offset) < SURFACE_FAR * radius && splits < SURFACE_SPLITS) {
        struct surface_part halves[2];
        surface_halve(sum, part, halves);
        for (int i = 0; i < 2; i++)
            surface_add_part(sum, &halves[i], splits + 1);
        return;
    }
    /* far: by the rule */
    double at[SURFACE_RULE_POINTS][2], weights[SURFACE_RULE_POINTS];
    surface_rule_place(&part->local, at, weights);
    for (int p = 0; p < SURFACE_RULE_POINTS; p++)
        surface_add_point(sum, at[p], weights[p], true, true);
}

static void surface_add_triangle(struct surface_sum *sum, const struct surface_triangle *triangle)
{
    struct surface_part part = {.local = *triangle};
    for (int i = 0; i < 3; i++)
        facet_place(sum->count, sum->nodes, triangle->corners[i][0], triangle->corners[i][1],
                    part.points[i], NULL);
    surface_add_part(sum, &part, 0);
}

/* Gauss' points and weights on 0 .. 1, by Newton's method on Legendre's polynomial */
static void gauss_points(int count, double *at, double *weights)
{
    for (int i = 0; i < count; i++) {
        double x = cos(M_PI * (i + 0.75) / (count + 0.5)), slope = 1.0;
        for (int step = 0; step < 20; step++) {
            double before = 1.0, value = x;
            for (int n = 2; n <= count; n++) {
                double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
                before = value;
                value = next;
            }
            slope = count * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        at[i] = 0.5 * (1.0 - x);
        weights[i] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
}

/* The curved face under the place itself, in triangles from the place to its edges, local
 * coordinates place + s (edge - place). Tractions are like 1/s: the force is integrated in s, the
 * energy, like 1/s^2, in ln s from the cut on. */
static void surface_add_fan(struct surface_sum *sum)
{
    /* points of Gauss around the place and along the radius */
    enum { AROUND = 40, ALONG = 12 };
    double around[AROUND], around_weights[AROUND], along[ALONG], along_weights[ALONG];
    gauss_points(AROUND, around, around_weights);
    gauss_points(ALONG, along, along_weights);
    /* tangents at the place */
    const double place[2] = {sum->place->u, sum->place->v};
    double du[3] = {0.0}, dv[3] = {0.0};
    double shape[FACE_MOST_NODES], shape_u[FACE_MOST_NODES], shape_v[FACE_MOST_NODES];
    facet_shape(sum->count, place[0], place[1], shape, shape_u, shape_v);
    for (int n = 0; n < sum->count; n++) {
        add_scaled3(shape_u[n], sum->nodes[n], du);
        add_scaled3(shape_v[n], sum->nodes[n], dv);
    }

    /* the triangle to each edge; twice its area in local coordinates */
    int corners = sum->count == FACE_TRIANGLE6 ? 3 : 4;
    for (int i = 0; i < corners; i++) {
        double from[2], to[2];
        facet_node(sum->count, i, &from[0], &from[1]);
        facet_node(sum->count, (i + 1) % corners, &to[0], &to[1]);
        double area =
            (from[0] - place[0]) * (to[1] - place[1]) - (to[0] - place[0]) * (from[1] - place[1]);
        /* a radius, and ln s where it leaves the cut */
        for (int a = 0; a < AROUND; a++) {
            double way[2], radius[3] = {0.0};
            for (int k = 0; k < 2; k++)
                way[k] = from[k] + around[a] * (to[k] - from[k]) - place[k];
            add_scaled3(way[0], du, radius);
            add_scaled3(way[1], dv, radius);
            double least = log(sum->place->cut / norm3(radius));
            /* the force evenly in s, then the energy evenly in ln s */
            for (int p = 0; p < ALONG; p++) {
                double s = along[p];
                const double even[2] = {place[0] + s * way[0], place[1] + s * way[1]};
                double weight = area * around_weights[a] * along_weights[p];
                surface_add_point(sum, even, weight * s, true, false);
                s = exp(least * along[p]);
                const double growing[2] = {place[0] + s * way[0], place[1] + s * way[1]};
                surface_add_point(sum, growing, -least * weight * s * s, false, true);
            }
        }
    }
}

/* a face in or near the place: nodes in the tangent plane have no tractions of the half-space */
static void surface_add_near(const struct surface_rule *rule, size_t face, struct surface_sum *sum)
{
    const struct flexibility_place *place = sum->place;
    double nodes[FACE_MOST_NODES][3];
    surface_rule_nodes(rule, face, nodes);
    sum->nodes = nodes;
    sum->in_plane = true;
    for (int n = 0; n < sum->count; n++) {
        double offset[3];
        sub3(nodes[n], place->load.point, offset);
        /* as plane as flexibility_place_make wants a face to be */
        if (fabs(dot3(offset, place->load.inward)) > 1e-5 * rule->radii[face])
            sum->in_plane = false;
    }
    if (sum->in_plane && isinf(place->load.reach)) {
        sum->nodes = NULL; /* free of tractions */
        return;
    }
    if (face == place->face && !place->flat) {
        surface_add_fan(sum);
    } else {
        struct surface_triangle triangles[2];
        size_t count = surface_rule_triangles((size_t)sum->count, triangles);
        for (size_t t = 0; t < count; t++)
            surface_add_triangle(sum, &triangles[t]);
    }
    sum->nodes = NULL;
}

static void surface_add_far(const struct surface_rule *rule, size_t face, struct surface_sum *sum)
{
    for (size_t i = rule->first[face]; i < rule->first[face + 1]; i++) {
        const double *shape = rule->shapes[sum->count][i - rule->first[face]];
        double traction[3], displacement[3];
        surface_look(sum->place, false, rule->points[i], rule->areas[i], traction, displacement);
        sum->energy += dot3(traction, displacement);
        for (int n = 0; n < sum->count; n++)
            add_scaled3(shape[n], traction, sum->forces[n]);
    }
}

/* With the field's tractions t and displacements u: subtracts the nodal forces that do t's work,
 * the integral of N^T t, from force ([3 node_count], N), and returns the integral of t.u (m/N),
 * outside the place's cut. */
static double flexibility_surface_add(const struct surface_rule *rule,
                                      const struct flexibility_place *place, double *force)
{
    double energy = 0.0;
    for (size_t f = 0; f < rule->surface->face_count; f++) {
        const struct surface_face *face = &rule->surface->faces[f];
        struct surface_sum sum = {.place = place, .count = face->count};
        double offset[3];
        sub3(rule->centres[f], place->load.point, offset);
        if (f == place->face || norm3(offset) < SURFACE_FAR * rule->radii[f])
            surface_add_near(rule, f, &sum);
        else
            surface_add_far(rule, f, &sum);
        for (int n = 0; n < sum.count; n++)
            add_scaled3(-1.0, sum.forces[n], force + 3 * face->nodes[n]);
        energy += sum.energy;
    }
    return energy;
}

/* ---- integrals over the volume: rule ---- */

/* An element nearer to the place than so many radii is split: its displacements,
 * like 1/r, matter by (h / body)^2 to the whole, and 1e-3 of that is left. */
static const double VOLUME_FAR = 2.0;
enum { VOLUME_SPLITS = 2 };
/* Beyond so many radii the displacements at the nodes stand for all in an element: its shape
 * functions leave (radius / distance)^3 of them and less. */
static const double VOLUME_NODES = 6.0;
static const int STRAIN_ROW[6] = {0, 1, 2, 0, 1, 2};
static const int STRAIN_COLUMN[6] = {0, 1, 2, 1, 2, 0};

/* Owns its arrays; the mesh is borrowed. */
struct volume_rule {
    const struct solid_mesh *mesh;
    struct element_rule *rules; /* [ELEMENT_TYPES] */
    size_t *first;       /* [element_count + 1]: an element's points are points[first[e]] .. */
    double (*points)[4]; /* place, volume: m, m^3 */
    double (*centres)[3], *radii; /* [element_count], m */
    size_t *first_mass; /* [element_count + 1]: an element's masses are masses[first_mass[e]] .. */
    double *masses;     /* integral of rho N_i N_j, by rows up to the diagonal, kg */
};

static void volume_rule_free(struct volume_rule *rule)
{
    free(rule->rules);
    free(rule->first);
    free(rule->points);
    free(rule->centres);
    free(rule->radii);
    free(rule->first_mass);
    free(rule->masses);
    *rule = (struct volume_rule){0};
}

static void volume_fill_element(struct volume_rule *rule, size_t element)
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

    /* masses between its nodes */
    double density = mesh->part[mesh->parts[element]].material.density;
    double *mass = rule->masses + rule->first_mass[element];
    for (size_t i = 0; i < points->node_count; i++)
        for (size_t j = 0; j <= i; j++, mass++) {
            *mass = 0.0;
            for (size_t p = 0; p < points->point_count; p++)
                *mass += density * rule->points[rule->first[element] + p][3] * points->shape[p][i] *
                         points->shape[p][j];
        }
}

static bool volume_rule_make(struct volume_rule *rule, const struct solid_mesh *mesh)
{
    /* arrays with one entry an element */
    size_t count = mesh->element_count, total = 0, masses = 0;
    *rule = (struct volume_rule){.mesh = mesh};
    rule->rules = malloc(ELEMENT_TYPES * sizeof *rule->rules);
    rule->first = malloc((count + 1) * sizeof *rule->first);
    rule->centres = malloc(count * sizeof *rule->centres);
    rule->radii = malloc(count * sizeof *rule->radii);
    rule->first_mass = malloc((count + 1) * sizeof *rule->first_mass);
    if (!rule->rules || !rule->first || !rule->centres || !rule->radii || !rule->first_mass)
        goto no_memory;
    /* where the points of each element begin, and its masses */
    for (int type = 0; type < ELEMENT_TYPES; type++)
        element_rule_make((enum element_type)type, &rule->rules[type]);
    for (size_t e = 0; e < count; e++) {
        rule->first[e] = total;
        total += rule->rules[mesh->types[e]].point_count;
        size_t nodes = rule->rules[mesh->types[e]].node_count;
        rule->first_mass[e] = masses;
        masses += nodes * (nodes + 1) / 2;
    }
    rule->first[count] = total;
    rule->first_mass[count] = masses;
    /* points and masses */
    rule->points = malloc(total * sizeof *rule->points);
    rule->masses = malloc(masses * sizeof *rule->masses);
    if (!rule->points || !rule->masses)
        goto no_memory;
    for (size_t e = 0; e < count; e++)
        volume_fill_element(rule, e);
    return true;

no_memory:
    volume_rule_free(rule);
    return false;
}

/* ---- integrals over the volume: mass ---- */

/* sums for one place and element */
struct mass_sum {
    const struct flexibility_place *place;
    const struct element_rule *rule;
    enum element_type type;
    double (*nodes)[3];
    double sums[ELEMENT_MOST_NODES][3];
};

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
        piece_point(sum->type, piece, rule->at[p], natural);
        element_shapes(sum->type, natural, shapes[p], gradient);
        element_map(rule->node_count, sum->nodes, shapes[p], gradient, &here[p]);
        sub3(here[p].position, sum->place->load.point, offset);
        nearest = fmin(nearest, norm3(offset));
        volume += scale * rule->weight[p] * here[p].volume;
    }
    /* near: by eighths */
    if (splits < VOLUME_SPLITS && nearest < VOLUME_FAR * cbrt(volume)) {
        struct piece parts[8];
        piece_split(sum->type, piece, parts);
        for (int i = 0; i < 8; i++)
            add_piece(sum, &parts[i], scale / 8.0, splits + 1);
        return;
    }
    /* far: by the rule */
    for (size_t p = 0; p < rule->point_count; p++)
        add_mass_point(sum, here[p].position, scale * rule->weight[p] * here[p].volume, shapes[p]);
}

/* momentum of an element by its own points, in pieces where it is near */
static void add_near_mass(const struct volume_rule *rule, const struct flexibility_place *place,
                          size_t element, double distance, double *momentum)
{
    const struct solid_mesh *mesh = rule->mesh;
    enum element_type type = mesh->types[element];
    double nodes[ELEMENT_MOST_NODES][3];
    struct mass_sum sum = {place, &rule->rules[type], type, nodes, {{0.0}}};
    if (distance < VOLUME_FAR * rule->radii[element]) {
        element_points(mesh, element, nodes);
        add_piece(&sum, &WHOLE_PIECE[type], 1.0, 0);
    } else {
        size_t first = rule->first[element], end = rule->first[element + 1];
        for (size_t i = first; i < end; i++)
            add_mass_point(&sum, rule->points[i], rule->points[i][3], sum.rule->shape[i - first]);
    }
    /* to the nodes, as momentum */
    double density = mesh->part[mesh->parts[element]].material.density;
    for (size_t n = 0; n < sum.rule->node_count; n++)
        add_scaled3(density, sum.sums[n], momentum + 3 * mesh->nodes[mesh->first[element] + n]);
}

/* momentum of an element by its nodes' displacements, [3 node_count] */
static void add_far_mass(const struct volume_rule *rule, size_t element,
                         const double *displacements, double *momentum)
{
    const size_t *nodes = rule->mesh->nodes + rule->mesh->first[element];
    const double *mass = rule->masses + rule->first_mass[element];
    size_t count = rule->rules[rule->mesh->types[element]].node_count;
    double u[ELEMENT_MOST_NODES][3], sums[ELEMENT_MOST_NODES][3] = {{0.0}};
    for (size_t i = 0; i < count; i++) {
        memcpy(u[i], displacements + 3 * nodes[i], sizeof u[i]);
        for (size_t j = 0; j < i; j++, mass++) {
            add_scaled3(*mass, u[j], sums[i]);
            add_scaled3(*mass, u[i], sums[j]);
        }
        add_scaled3(*mass++, u[i], sums[i]);
    }
    for (size_t i = 0; i < count; i++)
        add_scaled3(1.0, sums[i], momentum + 3 * nodes[i]);
}

/* Masses on nodes, by the nodes' displacements ([3 node_count]); not those so close to the place
 * (flexibility_place_massive) that the field has no displacement of a rigid mass there. */
static void add_nodes_mass(const struct volume_rule *rule, const struct flexibility_place *place,
                           const double *displacements, double *momentum)
{
    const struct solid_mesh *mesh = rule->mesh;
    for (size_t i = 0; i < mesh->mass_count; i++) {
        size_t at = 3 * mesh->masses[i].node;
        if (!flexibility_place_beside(place, mesh->points[mesh->masses[i].node]))
            add_scaled3(mesh->masses[i].mass, displacements + at, momentum + at);
    }
}

/* Adds the field's displacements u as mass feels them, the integral of rho N^T u, to momentum
 * ([3 node_count], kg m/N). `spare` is as large. */
static void flexibility_volume_add_mass(const struct volume_rule *rule,
                                        const struct flexibility_place *place, double *momentum,
                                        double *spare)
{
    const struct solid_mesh *mesh = rule->mesh;
    for (size_t n = 0; n < mesh->node_count; n++)
        boussinesq3_field(&place->load, mesh->points[n], spare + 3 * n, NULL);
    for (size_t e = 0; e < mesh->element_count; e++) {
        double offset[3];
        sub3(rule->centres[e], place->load.point, offset);
        double distance = norm3(offset);
        if (distance < VOLUME_NODES * rule->radii[e])
            add_near_mass(rule, place, e, distance, momentum);
        else
            add_far_mass(rule, e, spare, momentum);
    }
    add_nodes_mass(rule, place, spare, momentum);
}

/* ---- integrals over the volume: stiffness ---- */

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

static double tensor_product(const double a[6], const double b[6])
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

/* Where other materials than the place's lie, the field's stress there is not the half-space's: D'
 * the place's elasticity, D the part's, e the field's strain. Adds the nodal forces of (D' - D) e
 * to force and returns its work on e. 0 in a body of one material. */
static double flexibility_volume_add_parts(const struct volume_rule *rule,
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
            work += here.volume * tensor_product(stress, strain);
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
            strain[k] += 0.5 * (slope[STRAIN_ROW[k]] * u[STRAIN_COLUMN[k]] +
                                slope[STRAIN_COLUMN[k]] * u[STRAIN_ROW[k]]);
    }
    hooke(material, strain, stress);
    double work = here->volume * tensor_product(stress, strain);
    for (int k = 0; k < 6; k++)
        stress[k] = -stress[k];
    add_stress(mesh, element, here, stress, force);
    for (size_t n = 0; n < count; n++)
        add_scaled3(material->density * here->volume * shape[n], shift, momentum + 3 * nodes[n]);
    return work;
}

/* Held nodes are shifted (`shifts`, [3 node_count], zero at all others): subtracts the forces K
 * times shifts from force, adds the mass M times shifts to momentum, and returns the work of the
 * first on the shifts. */
static double flexibility_volume_add_shifts(const struct volume_rule *rule, const bool *held,
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

/* ---- the solution on the mesh ---- */

/* Nodal forces out of balance by more than this part of the force mean a surface that is not
 * closed or not the mesh's own; quadrature leaves less than 1e-7. */
static const double MOST_IMBALANCE = 1e-6;
/* Iterations end when a step does this part of the work: the error of the work then is of its
 * square, that of responses elsewhere of its order, both far below what interpolation leaves. */
static const double SMALLEST_STEP = 1e-4;
/* a step leaves shift / (shift + next eigenvalue), at most half with a shift at the first one */
enum { MOST_STEPS = 60 };

struct flexibility {
    struct flexibility_body body;
    size_t n, psi_count; /* degrees of freedom; rigid and removed modes */
    double *psi;         /* [psi_count][n] */
    double *mass_psi;    /* [psi_count][n]: M psi */
    struct surface_rule surface;
    struct volume_rule volume;
    struct flexibility_edges edges;
    /* of the block that is solved: [FLEXIBILITY_BLOCK][n] */
    double *force, *x, *work, *mass_x;
    double *shifts;   /* of held nodes: w1 */
    double *products; /* [2][FLEXIBILITY_BLOCK][psi_count] */
    double *momenta;  /* [FLEXIBILITY_BLOCK][psi_count]: g */
    struct flexibility_place places[FLEXIBILITY_BLOCK];
};

/* of one place: all of C but f.x, and how far its forces are from balance */
struct flexibility_terms {
    double value, imbalance;
};

static double column_dot(size_t n, const double *a, const double *b)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

struct flexibility *flexibility_make(const struct flexibility_body *body)
{
    struct flexibility *f = calloc(1, sizeof *f);
    if (!f)
        return NULL;
    /* room for a block of columns */
    size_t n = f->n = 3 * body->mesh->node_count, block = FLEXIBILITY_BLOCK * n;
    f->body = *body;
    f->psi_count = body->rigid_count + body->removed;
    f->psi = malloc((f->psi_count * n + 1) * sizeof *f->psi);
    f->mass_psi = malloc((f->psi_count * n + 1) * sizeof *f->mass_psi);
    f->force = malloc(block * sizeof *f->force);
    f->x = malloc(block * sizeof *f->x);
    f->work = malloc(block * sizeof *f->work);
    f->mass_x = malloc(block * sizeof *f->mass_x);
    f->shifts = malloc(block * sizeof *f->shifts);
    f->momenta = malloc((FLEXIBILITY_BLOCK * f->psi_count + 1) * sizeof *f->momenta);
    f->products = malloc((2 * FLEXIBILITY_BLOCK * f->psi_count + 1) * sizeof *f->products);
    /* rules of integration over surface and volume */
    if (!f->psi || !f->mass_psi || !f->force || !f->x || !f->work || !f->mass_x || !f->shifts ||
        !f->products || !f->momenta || !surface_rule_make(&f->surface, body->mesh, body->surface) ||
        !volume_rule_make(&f->volume, body->mesh) ||
        !flexibility_edges_make(&f->edges, &f->surface)) {
        flexibility_free(f);
        return NULL;
    }
    /* Psi: rigid motions, then modes that are taken out; M Psi */
    size_t rigid = body->rigid_count * n;
    if (body->rigid_count > 0)
        memcpy(f->psi, body->rigid, rigid * sizeof *f->psi);
    if (body->removed > 0)
        memcpy(f->psi + rigid, body->shapes, body->removed * n * sizeof *f->psi);
    sparse_multiply(&body->matrices->mass, f->psi_count, f->psi, f->mass_psi);
    return f;
}

void flexibility_free(struct flexibility *flexibility)
{
    if (!flexibility)
        return;
    surface_rule_free(&flexibility->surface);
    volume_rule_free(&flexibility->volume);
    flexibility_edges_free(&flexibility->edges);
    free(flexibility->psi);
    free(flexibility->mass_psi);
    free(flexibility->force);
    free(flexibility->x);
    free(flexibility->work);
    free(flexibility->mass_x);
    free(flexibility->shifts);
    free(flexibility->momenta);
    free(flexibility->products);
    free(flexibility);
}

const struct surface_rule *flexibility_rule(const struct flexibility *flexibility)
{
    return &flexibility->surface;
}

const struct flexibility_edges *flexibility_edges(const struct flexibility *flexibility)
{
    return &flexibility->edges;
}

/* displacement of a place along its inward normal in nodal displacements x */
static double displacement_at(const struct flexibility *f, const struct flexibility_place *place,
                              const double *x)
{
    const struct surface_face *face = &f->body.surface->faces[place->face];
    double shape[FACE_MOST_NODES], sum = 0.0;
    facet_shape(face->count, place->u, place->v, shape, NULL, NULL);
    for (int n = 0; n < face->count; n++)
        sum += shape[n] * dot3(place->load.inward, x + 3 * face->nodes[n]);
    return sum;
}

/* Held nodes: w1 = -u_B there (into shifts, zero elsewhere) turns f into f - K w1 and g into g +
 * Psi^T M w1, and adds 2 f.w1 - w1.K w1 to C. */
static double hold_nodes(const struct flexibility *f, const struct flexibility_place *place,
                         double *force, double *momentum, double *shifts)
{
    const bool *held = f->body.matrices->held;
    memset(shifts, 0, f->n * sizeof *shifts);
    if (!held)
        return 0.0;
    for (size_t i = 0; i < f->n; i += 3) {
        if (!held[i])
            continue;
        boussinesq3_field(&place->load, f->body.mesh->points[i / 3], shifts + i, NULL);
        scale3(-1.0, shifts + i, shifts + i);
    }
    double value = 2.0 * column_dot(f->n, force, shifts);
    value -= flexibility_volume_add_shifts(&f->volume, held, shifts, force, momentum);
    for (size_t i = 0; i < f->n; i++)
        force[i] = held[i] ? 0.0 : force[i];
    return value;
}

/* integrals of the half-space's field: nodal forces, the momenta of the mass, shifts of held nodes;
 * returns C without their parts */
static double integrate_field(const struct flexibility *f, const struct flexibility_place *place,
                              double *force, double *momentum, double *shifts)
{
    memset(force, 0, f->n * sizeof *force);
    memset(momentum, 0, f->n * sizeof *momentum);
    double value = boussinesq3_added_displacement(&place->load) -
                   flexibility_surface_add(&f->surface, place, force);
    if (f->body.mesh->part_count > 1)
        value += flexibility_volume_add_parts(&f->volume, place, force);
    flexibility_volume_add_mass(&f->volume, place, momentum, shifts);
    return value + hold_nodes(f, place, force, momentum, shifts);
}

void flexibility_integrate(struct flexibility *flexibility, const struct flexibility_place *place)
{
    integrate_field(flexibility, place, flexibility->force, flexibility->work, flexibility->shifts);
}

/* Forces of all columns without Psi, and g. Rigid motions balance a free body: f has the
 * work p on them. */
static void prepare_columns(struct flexibility *f, size_t count, struct flexibility_terms *terms)
{
    size_t n = f->n, psi_count = f->psi_count;
    struct dense psi = {n, psi_count, f->psi}, mass_psi = {n, psi_count, f->mass_psi};
    double *all_own = f->products, *all_g = all_own + FLEXIBILITY_BLOCK * psi_count;
    for (size_t c = 0; c < count; c++)
        terms[c].value =
            integrate_field(f, &f->places[c], f->force + c * n, f->work + c * n, f->shifts + c * n);
    dense_products(psi, (struct dense){n, count, f->force}, all_own);
    dense_products(psi, (struct dense){n, count, f->work}, all_g);
    dense_combine(mass_psi, -1.0, all_own, 1.0, count, f->force);
    memcpy(f->momenta, all_g, count * psi_count * sizeof *f->momenta);

    /* the modes' part of C */
    for (size_t c = 0; c < count; c++) {
        const double *own = all_own + c * psi_count, *g = all_g + c * psi_count;
        double load = 0.0, off = 0.0;
        for (size_t k = 0; k < psi_count; k++) {
            double p = displacement_at(f, &f->places[c], f->psi + k * n), square = 0.0;
            if (k < f->body.rigid_count) {
                load += p * p;
                off += (own[k] - p) * (own[k] - p);
            } else {
                double omega = f->body.omega[k - f->body.rigid_count];
                square = omega * omega;
            }
            terms[c].value -= 2.0 * p * g[k] - square * g[k] * g[k];
        }
        terms[c].imbalance = load > 0.0 ? sqrt(off / load) : 0.0;
    }
}

/* One step for all columns: (K + s M) y = f + s M x, then x = y. Adds s x.M (y - x) to f.y: its
 * error is then of the square of y's; `work` and `step` are those two terms. Rounding leaves some
 * of Psi in y, which does not grow and does no work, as f has none. */
static enum percuss_status advance_columns(struct flexibility *f, size_t count, double *work,
                                           double *step, struct fault *fault)
{
    /* (K + s M)^-1 of loads and of the last step */
    size_t n = f->n;
    for (size_t i = 0; i < count * n; i++)
        f->work[i] = f->force[i] + f->body.shift * f->mass_x[i];
    enum percuss_status status = factor_solve(f->body.factor, count, f->work, fault);
    if (status != PERCUSS_OK)
        return status;
    /* both terms of the work: of the load, and of the step */
    for (size_t c = 0; c < count; c++) {
        const double *y = f->work + c * n;
        work[c] = column_dot(n, f->force + c * n, y);
        step[c] = -f->body.shift * column_dot(n, y, f->mass_x + c * n);
    }
    /* M y, which the next step takes too */
    sparse_multiply(&f->body.matrices->mass, count, f->work, f->mass_x);
    for (size_t c = 0; c < count; c++)
        step[c] += f->body.shift * column_dot(n, f->work + c * n, f->mass_x + c * n);
    /* y is the next x */
    double *swap = f->x;
    f->x = f->work;
    f->work = swap;
    return PERCUSS_OK;
}

/* x becomes w = x - Psi g, with what rounding left of Psi taken out and held nodes shifted. */
static void complete_columns(struct flexibility *f, size_t count)
{
    size_t n = f->n;
    dense_products((struct dense){n, f->psi_count, f->mass_psi}, (struct dense){n, count, f->x},
                   f->products);
    for (size_t i = 0; i < count * f->psi_count; i++)
        f->products[i] += f->momenta[i];
    dense_combine((struct dense){n, f->psi_count, f->psi}, -1.0, f->products, 1.0, count, f->x);
    for (size_t i = 0; f->body.matrices->held && i < count * n; i++)
        f->x[i] += f->shifts[i];
}

/* the first `count` columns, prepared */
static enum percuss_status iterate_columns(struct flexibility *f, size_t count, double *work,
                                           struct fault *fault)
{
    double step[FLEXIBILITY_BLOCK];
    memset(f->mass_x, 0, count * f->n * sizeof *f->mass_x);
    for (int i = 0; i < MOST_STEPS; i++) {
        enum percuss_status status = advance_columns(f, count, work, step, fault);
        if (status != PERCUSS_OK)
            return status;
        bool done = true;
        for (size_t c = 0; c < count; c++) {
            done = done && fabs(step[c]) <= SMALLEST_STEP * fabs(work[c]);
            work[c] += step[c];
        }
        if (done)
            return PERCUSS_OK;
    }
    return fault_set(
        fault, PERCUSS_INTERNAL,
        "static flexibility: no convergence in %d steps; the shift %g 1/s^2 is too far "
        "above the first eigenvalue",
        MOST_STEPS, f->body.shift);
}

enum percuss_status flexibility_solve(struct flexibility *flexibility, size_t count,
                                      const struct flexibility_place *places,
                                      struct flexibility_answer *answers, struct fault *fault)
{
    struct flexibility *f = flexibility;
    struct flexibility_terms terms[FLEXIBILITY_BLOCK];
    double work[FLEXIBILITY_BLOCK];
    memcpy(f->places, places, count * sizeof *places);
    prepare_columns(f, count, terms);
    enum percuss_status status = iterate_columns(f, count, work, fault);
    if (status != PERCUSS_OK)
        return status;
    complete_columns(f, count);
    for (size_t c = 0; c < count; c++) {
        const struct flexibility_place *place = &places[c];
        answers[c].imbalance = terms[c].imbalance;
        answers[c].radius = place->rim;
        answers[c].value = terms[c].value + work[c];
        /* from the radius where the integral began */
        if (!place->flat)
            answers[c].value -=
                flexibility_slope(place->load.young, place->load.poisson, place->bend) *
                log(place->rim / place->cut);
        if (!(terms[c].imbalance <= MOST_IMBALANCE))
            answers[c].value = NAN;
    }
    return PERCUSS_OK;
}

double flexibility_slope(double young, double poisson, double mean_curvature)
{
    double side = 1.0 - 2.0 * poisson;
    return (1.0 + poisson) * side * side * mean_curvature / (2.0 * M_PI * young);
}

/* Mean of ln(a / r) over pairs of points of Hertz's pressure p: both radii r below s hold a part
 * M^2 of the pairs, M(s) = 1 - (1 - s^2)^(3/2), and the mean of ln r about a circle is the
 * logarithm of the larger radius: integral of M^2 ds / s = H(3/2) - H(3) / 2 in harmonic numbers.
 *
 * A tangential force t at y moves x along the normal by k t.(x - y) / |x - y|^2, k = (1 + nu)(1 -
 * 2 nu) / (2 pi E), a normal force tangentially by as much the other way. With normals that turn by
 * H (x - y) from y to x the sum is k H for every pair. */
double flexibility_of_contact(double young, double poisson, double mean_curvature)
{
    const double mean = 1.75 - 2.0 * M_LN2;
    double tilt = (1.0 + poisson) * (1.0 - 2.0 * poisson) / (2.0 * M_PI * young);
    return mean * flexibility_slope(young, poisson, mean_curvature) + tilt * mean_curvature;
}

double flexibility_mode(const struct flexibility *flexibility, size_t mode,
                        const struct flexibility_place *place)
{
    size_t k = flexibility->body.rigid_count + mode;
    return displacement_at(flexibility, place, flexibility->psi + k * flexibility->n);
}

double flexibility_response(const struct flexibility *flexibility, size_t solved,
                            const struct flexibility_place *other)
{
    size_t start = solved * flexibility->n;
    double u[3];
    boussinesq3_field(&flexibility->places[solved].load, other->load.point, u, NULL);
    return dot3(u, other->load.inward) +
           displacement_at(flexibility, other, flexibility->x + start);
}
