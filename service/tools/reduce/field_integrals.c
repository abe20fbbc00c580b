/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/field_integrals.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/facet.h"
#include "model/vector.h"
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
    bool in_plane; /* the half-space's own tractions are zero */
    double forces[FACE_MOST_NODES][FLEXIBILITY_LOADS][3]; /* integral of N^T t */
    double energy[FLEXIBILITY_LOADS][FLEXIBILITY_LOADS];  /* of t.u */
};

/* Points of a face with their areas. */
struct surface_points {
    size_t count;
    const double (*x)[3], (*areas)[3];
    const double (*shapes)[FACE_MOST_NODES];
};

/* Fields' displacements and tractions at points of a face. */
static void surface_fields(const struct surface_sum *sum, const struct surface_points *points,
                           double (*u)[FLEXIBILITY_LOADS][3], double (*t)[FLEXIBILITY_LOADS][3])
{
    const struct flexibility_place *place = sum->place;
    boussinesq3_fields(&place->load, place->along, points->count, points->x, points->areas, u,
                       sum->in_plane ? NULL : t);
    for (size_t p = 0; sum->in_plane && p < points->count; p++)
        for (int i = 0; i < FLEXIBILITY_LOADS; i++) {
            double stress[6];
            flexibility_place_added_stress(place, i, points->x[p], stress);
            boussinesq3_traction(stress, points->areas[p], t[p][i]);
        }
}

/* Adds so many points, at most SURFACE_RULE_MOST: the fields' tractions t, and their work on the
 * displacements u. */
static void surface_add(struct surface_sum *sum, const struct surface_points *points,
                        bool with_force, bool with_energy)
{
    double t[SURFACE_RULE_MOST][FLEXIBILITY_LOADS][3], u[SURFACE_RULE_MOST][FLEXIBILITY_LOADS][3];
    surface_fields(sum, points, u, t);
    for (size_t p = 0; with_force && p < points->count; p++)
        for (int n = 0; n < sum->count; n++)
            for (int i = 0; i < FLEXIBILITY_LOADS; i++)
                add_scaled3(points->shapes[p][n], t[p][i], sum->forces[n][i]);
    for (size_t p = 0; with_energy && p < points->count; p++)
        for (int i = 0; i < FLEXIBILITY_LOADS; i++)
            for (int j = 0; j < FLEXIBILITY_LOADS; j++)
                sum->energy[i][j] += dot3(t[p][i], u[p][j]);
}

/* The same of points at local coordinates of the face. */
static void surface_add_at(struct surface_sum *sum, size_t count, const double (*at)[2],
                           const double *weights, bool with_force, bool with_energy)
{
    double x[SURFACE_RULE_POINTS][3], areas[SURFACE_RULE_POINTS][3];
    double shapes[SURFACE_RULE_POINTS][FACE_MOST_NODES];
    for (size_t p = 0; p < count; p++) {
        facet_look(sum->count, sum->nodes, at[p][0], at[p][1], shapes[p], x[p], areas[p]);
        scale3(weights[p], areas[p], areas[p]);
    }
    const struct surface_points points = {count, (const double(*)[3])x, (const double(*)[3])areas,
                                          (const double(*)[FACE_MOST_NODES])shapes};
    surface_add(sum, &points, with_force, with_energy);
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
    surface_add_at(sum, SURFACE_RULE_POINTS, (const double(*)[2])at, weights, true, true);
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
    enum { AROUND = 40, ALONG = SURFACE_RULE_POINTS };
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
            double even[ALONG][2], growing[ALONG][2], even_weights[ALONG], growing_weights[ALONG];
            for (int p = 0; p < ALONG; p++) {
                double s = along[p], grown = exp(least * along[p]);
                double weight = area * around_weights[a] * along_weights[p];
                for (int k = 0; k < 2; k++) {
                    even[p][k] = place[k] + s * way[k];
                    growing[p][k] = place[k] + grown * way[k];
                }
                even_weights[p] = weight * s;
                growing_weights[p] = -least * weight * grown * grown;
            }
            surface_add_at(sum, ALONG, (const double(*)[2])even, even_weights, true, false);
            surface_add_at(sum, ALONG, (const double(*)[2])growing, growing_weights, false, true);
        }
    }
}

/* Whether a face lies in the place's tangent plane, as plane as flexibility_place_make wants one to
 * be. */
static bool is_in_plane(const struct surface_rule *rule, size_t face,
                        const struct flexibility_place *place)
{
    const struct surface_face *f = &rule->surface->faces[face];
    for (size_t n = 0; n < f->count; n++) {
        double offset[3];
        sub3(rule->mesh->points[f->nodes[n]], place->load.point, offset);
        if (fabs(dot3(offset, place->load.inward)) > 1e-5 * rule->radii[face])
            return false;
    }
    return true;
}

/* a face in or near the place */
static void surface_add_near(const struct surface_rule *rule, size_t face, struct surface_sum *sum)
{
    double nodes[FACE_MOST_NODES][3];
    surface_rule_nodes(rule, face, nodes);
    sum->nodes = nodes;
    if (face == sum->place->face && !sum->place->flat) {
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
    size_t first = rule->first[face];
    const struct surface_points points = {rule->first[face + 1] - first, rule->points + first,
                                          rule->areas + first, rule->shapes[sum->count]};
    surface_add(sum, &points, true, true);
}

void field_integrals_surface(const struct surface_rule *rule, const struct flexibility_place *place,
                             size_t n, double *forces, load_pairs values)
{
    for (size_t f = 0; f < rule->surface->face_count; f++) {
        const struct surface_face *face = &rule->surface->faces[f];
        struct surface_sum sum = {.place = place, .count = face->count};
        double offset[3];
        sub3(rule->centres[f], place->load.point, offset);
        bool near_it = f == place->face || norm3(offset) < SURFACE_FAR * rule->radii[f];
        bool in_plane = is_in_plane(rule, f, place);
        if (in_plane && isinf(place->load.reach))
            continue; /* free of tractions */
        sum.in_plane = in_plane && near_it;
        if (near_it)
            surface_add_near(rule, f, &sum);
        else
            surface_add_far(rule, f, &sum);
        for (int i = 0; i < place->loads; i++) {
            for (int k = 0; k < sum.count; k++)
                add_scaled3(-1.0, sum.forces[k][i], forces + (size_t)i * n + 3 * face->nodes[k]);
            for (int j = 0; j < place->loads; j++)
                values[i][j] -= sum.energy[i][j];
        }
    }
}

/* ---- integrals over the volume: rule ---- */

/* An element nearer to the place than so many radii is split: its displacements,
 * like 1/r, matter by (h / body)^2 to the whole, and 1e-3 of that is left. */
static const double VOLUME_FAR = 2.0;
enum { VOLUME_SPLITS = 2 };
/* Beyond so many radii the displacements at the nodes stand for all in an element: its shape
 * functions leave (radius / distance)^3 of them and less. */
static const double VOLUME_NODES = 6.0;
/* Of the place's face: nodes so near to the place, where the field is steep and infinite in the
 * end, stay at rest, and the integrals of the elements about them make up for that. M may be
 * another program's and differ from the masses of these elements, which a steep field would show.
 */
static const double UNDER = 0.2;
static const int STRAIN_ROW[6] = {0, 1, 2, 0, 1, 2};
static const int STRAIN_COLUMN[6] = {0, 1, 2, 1, 2, 0};

void volume_rule_free(struct volume_rule *rule)
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

bool volume_rule_make(struct volume_rule *rule, const struct solid_mesh *mesh)
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

/* sums for one place and element: the integral of N^T u */
struct mass_sum {
    const struct flexibility_place *place;
    const struct element_rule *rule;
    enum element_type type;
    double (*nodes)[3];
    double sums[ELEMENT_MOST_NODES][FLEXIBILITY_LOADS][3];
};

/* Adds all points of an element's rule, or of a piece's, each with its volume. */
static void add_mass_points(struct mass_sum *sum, const double (*x)[3], const double *volumes,
                            const double (*shapes)[ELEMENT_MOST_NODES])
{
    double u[ELEMENT_MOST_POINTS][FLEXIBILITY_LOADS][3];
    boussinesq3_fields(&sum->place->load, sum->place->along, sum->rule->point_count, x, NULL, u,
                       NULL);
    for (size_t p = 0; p < sum->rule->point_count; p++)
        for (size_t n = 0; n < sum->rule->node_count; n++)
            for (int i = 0; i < FLEXIBILITY_LOADS; i++)
                add_scaled3(volumes[p] * shapes[p][n], u[p][i], sum->sums[n][i]);
}

/* pieces are split while they are near the place; `scale`: their volume over the element's */
static void add_piece(struct mass_sum *sum, const struct piece *piece, double scale, int splits)
{
    const struct element_rule *rule = sum->rule;
    double x[ELEMENT_MOST_POINTS][3], volumes[ELEMENT_MOST_POINTS];
    double shapes[ELEMENT_MOST_POINTS][ELEMENT_MOST_NODES], nearest = INFINITY, volume = 0.0;
    /* points of the piece, its volume, and the nearest to the place */
    for (size_t p = 0; p < rule->point_count; p++) {
        double natural[3], gradient[ELEMENT_MOST_NODES][3], offset[3];
        struct element_point here;
        piece_point(sum->type, piece, rule->at[p], natural);
        element_shapes(sum->type, natural, shapes[p], gradient);
        element_map(rule->node_count, sum->nodes, shapes[p], gradient, &here);
        memcpy(x[p], here.position, sizeof x[p]);
        sub3(x[p], sum->place->load.point, offset);
        nearest = fmin(nearest, norm3(offset));
        volumes[p] = scale * rule->weight[p] * here.volume;
        volume += volumes[p];
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
    add_mass_points(sum, (const double(*)[3])x, volumes,
                    (const double(*)[ELEMENT_MOST_NODES])shapes);
}

/* the integral of an element by its own points, in pieces where it is near */
static void integrate_element(const struct volume_rule *rule, size_t element, double distance,
                              struct mass_sum *sum)
{
    double x[ELEMENT_MOST_POINTS][3], volumes[ELEMENT_MOST_POINTS];
    size_t first = rule->first[element];
    if (distance < VOLUME_FAR * rule->radii[element]) {
        element_points(rule->mesh, element, sum->nodes);
        add_piece(sum, &WHOLE_PIECE[sum->type], 1.0, 0);
        return;
    }
    for (size_t p = 0; p < sum->rule->point_count; p++) {
        memcpy(x[p], rule->points[first + p], sizeof x[p]);
        volumes[p] = rule->points[first + p][3];
    }
    add_mass_points(sum, (const double(*)[3])x, volumes, sum->rule->shape);
}

/* Takes off an element's masses times its nodes' displacements of one load, [3 node_count]. */
static void take_off_masses(const struct volume_rule *rule, size_t element,
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
        add_scaled3(-1.0, sums[i], momentum + 3 * nodes[i]);
}

/* What an element near the place has beyond its masses times its nodes' displacements. */
static void add_near_mass(const struct volume_rule *rule, const struct flexibility_place *place,
                          size_t element, double distance, const double *nodal, double *beyond)
{
    const struct solid_mesh *mesh = rule->mesh;
    enum element_type type = mesh->types[element];
    double nodes[ELEMENT_MOST_NODES][3];
    double density = mesh->part[mesh->parts[element]].material.density;
    struct mass_sum sum = {place, &rule->rules[type], type, nodes, {{{0.0}}}};
    integrate_element(rule, element, distance, &sum);
    for (size_t i = 0; i < (size_t)place->loads; i++) {
        double *momentum = beyond + 3 * i * mesh->node_count;
        take_off_masses(rule, element, nodal + 3 * i * mesh->node_count, momentum);
        for (size_t n = 0; n < sum.rule->node_count; n++)
            add_scaled3(density, sum.sums[n][i],
                        momentum + 3 * mesh->nodes[mesh->first[element] + n]);
    }
}

/* Masses on nodes so close to the place (flexibility_place_massive) that the field has no
 * displacement of a rigid mass there are left out. */
static void leave_out_masses(const struct solid_mesh *mesh, const struct flexibility_place *place,
                             const double *nodal, double *beyond)
{
    for (size_t i = 0; i < mesh->mass_count; i++)
        for (size_t c = 0; c < (size_t)place->loads; c++) {
            size_t at = 3 * (c * mesh->node_count + mesh->masses[i].node);
            if (flexibility_place_beside(place, mesh->points[mesh->masses[i].node]))
                add_scaled3(-mesh->masses[i].mass, nodal + at, beyond + at);
        }
}

/* Displacements of all nodes; held freedoms, which the body's own solution shifts back by as much,
 * have theirs however near to the place they are. */
static void move_nodes(const struct solid_mesh *mesh, const struct flexibility_place *place,
                       const bool *held, double *nodal)
{
    enum { TOGETHER = 64 };
    double u[TOGETHER][FLEXIBILITY_LOADS][3];
    for (size_t first = 0; first < mesh->node_count; first += TOGETHER) {
        size_t left = mesh->node_count - first, count = left < TOGETHER ? left : TOGETHER;
        const double(*x)[3] = (const double(*)[3])mesh->points + first;
        boussinesq3_fields(&place->load, place->along, count, x, NULL, u, NULL);
        for (size_t p = 0; p < count; p++) {
            double offset[3];
            sub3(x[p], place->load.point, offset);
            bool under = norm3(offset) < UNDER * place->element;
            for (size_t k = 0; k < 3; k++) {
                size_t at = 3 * (first + p) + k;
                bool rests = under && !(held && held[at]);
                for (size_t i = 0; i < (size_t)place->loads; i++)
                    nodal[3 * i * mesh->node_count + at] = rests ? 0.0 : u[p][i][k];
            }
        }
    }
}

void field_integrals_mass(const struct volume_rule *rule, const struct flexibility_place *place,
                          const bool *held, double *nodal, double *beyond)
{
    const struct solid_mesh *mesh = rule->mesh;
    memset(beyond, 0, 3 * (size_t)place->loads * mesh->node_count * sizeof *beyond);
    move_nodes(mesh, place, held, nodal);
    for (size_t e = 0; e < mesh->element_count; e++) {
        double offset[3];
        sub3(rule->centres[e], place->load.point, offset);
        double distance = norm3(offset);
        if (distance < VOLUME_NODES * rule->radii[e])
            add_near_mass(rule, place, e, distance, nodal, beyond);
    }
    leave_out_masses(mesh, place, nodal, beyond);
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

void field_integrals_parts(const struct volume_rule *rule, const struct flexibility_place *place,
                           double *forces, load_pairs values)
{
    const struct solid_mesh *mesh = rule->mesh;
    const struct material *own = &mesh->part[place->part].material;
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
            double stress[FLEXIBILITY_LOADS][6], strain[FLEXIBILITY_LOADS][6], there[6];
            element_at(points, p, nodes, &here);
            for (int i = 0; i < place->loads; i++) {
                flexibility_place_field(place, i, here.position, NULL, stress[i]);
                hooke_inverse(own, stress[i], strain[i]);
                hooke(other, strain[i], there);
                for (int k = 0; k < 6; k++)
                    stress[i][k] -= there[k];
                add_stress(mesh, e, &here, stress[i], forces + 3 * mesh->node_count * (size_t)i);
            }
            for (int i = 0; i < place->loads; i++)
                for (int j = 0; j < place->loads; j++)
                    values[i][j] += here.volume * tensor_product(stress[i], strain[j]);
        }
    }
}

static bool has_held(const struct solid_mesh *mesh, size_t element, const bool *held)
{
    for (size_t i = mesh->first[element]; i < mesh->first[element + 1]; i++)
        for (size_t k = 0; k < 3; k++)
            if (held[3 * mesh->nodes[i] + k])
                return true;
    return false;
}

/* Forces of one point of an element that a load shifts; its strain and stress there. */
static void add_shift(const struct solid_mesh *mesh, size_t element,
                      const struct element_point *here, const double *shifts, double *force,
                      double strain[6], double stress[6])
{
    const struct material *material = &mesh->part[mesh->parts[element]].material;
    const size_t *nodes = mesh->nodes + mesh->first[element];
    size_t count = mesh->first[element + 1] - mesh->first[element];
    double against[6];
    memset(strain, 0, 6 * sizeof *strain);
    for (size_t n = 0; n < count; n++) {
        const double *u = shifts + 3 * nodes[n], *slope = here->gradient[n];
        for (int k = 0; k < 6; k++)
            strain[k] += 0.5 * (slope[STRAIN_ROW[k]] * u[STRAIN_COLUMN[k]] +
                                slope[STRAIN_COLUMN[k]] * u[STRAIN_ROW[k]]);
    }
    hooke(material, strain, stress);
    for (int k = 0; k < 6; k++)
        against[k] = -stress[k];
    add_stress(mesh, element, here, against, force);
}

void field_integrals_shifts(const struct volume_rule *rule, const bool *held, int loads,
                            const double *shifts, double *forces, load_pairs values)
{
    const struct solid_mesh *mesh = rule->mesh;
    size_t all = 3 * mesh->node_count;
    for (size_t e = 0; e < mesh->element_count; e++) {
        if (!has_held(mesh, e, held))
            continue;
        const struct element_rule *points = &rule->rules[mesh->types[e]];
        double nodes[ELEMENT_MOST_NODES][3];
        element_points(mesh, e, nodes);
        for (size_t p = 0; p < points->point_count; p++) {
            struct element_point here;
            double strain[FLEXIBILITY_LOADS][6], stress[FLEXIBILITY_LOADS][6];
            element_at(points, p, nodes, &here);
            for (int i = 0; i < loads; i++) {
                size_t first = all * (size_t)i;
                add_shift(mesh, e, &here, shifts + first, forces + first, strain[i], stress[i]);
            }
            for (int i = 0; i < loads; i++)
                for (int j = 0; j < loads; j++)
                    values[i][j] -= here.volume * tensor_product(stress[i], strain[j]);
        }
    }
}
