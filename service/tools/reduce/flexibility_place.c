/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/flexibility_place.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "model/facet.h"
#include "model/vector.h"

/* ---- quadrature over the surface ---- */

/* Degree 6, twelve points (Dunavant 1985): volume coordinates and the part of the area. */
static const double TRIANGLE_RULE[SURFACE_RULE_POINTS][4] = {
    {0.501426509658179, 0.249286745170910, 0.249286745170910, 0.116786275726379},
    {0.249286745170910, 0.501426509658179, 0.249286745170910, 0.116786275726379},
    {0.249286745170910, 0.249286745170910, 0.501426509658179, 0.116786275726379},
    {0.873821971016996, 0.063089014491502, 0.063089014491502, 0.050844906370207},
    {0.063089014491502, 0.873821971016996, 0.063089014491502, 0.050844906370207},
    {0.063089014491502, 0.063089014491502, 0.873821971016996, 0.050844906370207},
    {0.053145049844817, 0.310352451033784, 0.636502499121399, 0.082851075618374},
    {0.053145049844817, 0.636502499121399, 0.310352451033784, 0.082851075618374},
    {0.310352451033784, 0.053145049844817, 0.636502499121399, 0.082851075618374},
    {0.310352451033784, 0.636502499121399, 0.053145049844817, 0.082851075618374},
    {0.636502499121399, 0.053145049844817, 0.310352451033784, 0.082851075618374},
    {0.636502499121399, 0.310352451033784, 0.053145049844817, 0.082851075618374}};

size_t surface_rule_triangles(size_t count, struct surface_triangle triangles[2])
{
    static const struct surface_triangle WHOLE = {{{0, 0}, {1, 0}, {0, 1}}};
    static const struct surface_triangle HALVES[2] = {{{{-1, -1}, {1, -1}, {1, 1}}},
                                                      {{{-1, -1}, {1, 1}, {-1, 1}}}};
    if (count == FACE_TRIANGLE6) {
        triangles[0] = WHOLE;
        return 1;
    }
    memcpy(triangles, HALVES, sizeof HALVES);
    return 2;
}

void surface_rule_place(const struct surface_triangle *triangle, double at[][2], double weights[])
{
    const double(*c)[2] = triangle->corners;
    double area = 0.5 * ((c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) -
                         (c[2][0] - c[0][0]) * (c[1][1] - c[0][1]));
    for (int p = 0; p < SURFACE_RULE_POINTS; p++) {
        for (int k = 0; k < 2; k++)
            at[p][k] = TRIANGLE_RULE[p][0] * c[0][k] + TRIANGLE_RULE[p][1] * c[1][k] +
                       TRIANGLE_RULE[p][2] * c[2][k];
        weights[p] = TRIANGLE_RULE[p][3] * area;
    }
}

void surface_rule_split(const struct surface_triangle *triangle, struct surface_triangle parts[4])
{
    const double(*c)[2] = triangle->corners;
    double middle[3][2];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++)
            middle[i][k] = 0.5 * (c[i][k] + c[(i + 1) % 3][k]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++) {
            parts[i].corners[0][k] = c[i][k];
            parts[i].corners[1][k] = middle[i][k];
            parts[i].corners[2][k] = middle[(i + 2) % 3][k];
            parts[3].corners[i][k] = middle[i][k];
        }
}

void surface_rule_nodes(const struct surface_rule *rule, size_t face,
                        double nodes[FACE_MOST_NODES][3])
{
    const struct surface_face *f = &rule->surface->faces[face];
    for (size_t i = 0; i < f->count; i++)
        memcpy(nodes[i], rule->mesh->points[f->nodes[i]], sizeof nodes[i]);
}

static size_t face_point_count(size_t count)
{
    return count == FACE_TRIANGLE6 ? SURFACE_RULE_POINTS : 2 * SURFACE_RULE_POINTS;
}

/* local coordinates and weights of all points of a face */
static void place_face_points(size_t count, double at[SURFACE_RULE_MOST][2],
                              double weights[SURFACE_RULE_MOST])
{
    struct surface_triangle triangles[2];
    size_t triangle_count = surface_rule_triangles(count, triangles);
    for (size_t t = 0; t < triangle_count; t++)
        surface_rule_place(&triangles[t], at + t * SURFACE_RULE_POINTS,
                           weights + t * SURFACE_RULE_POINTS);
}

double surface_rule_sphere(size_t count, double points[][3], double centre[3])
{
    double radius = 0.0;
    memset(centre, 0, 3 * sizeof *centre);
    for (size_t n = 0; n < count; n++)
        add_scaled3(1.0 / (double)count, points[n], centre);
    for (size_t n = 0; n < count; n++) {
        double offset[3];
        sub3(points[n], centre, offset);
        radius = fmax(radius, norm3(offset));
    }
    return radius;
}

static void surface_rule_fill_face(struct surface_rule *rule, size_t face)
{
    size_t count = rule->surface->faces[face].count;
    double nodes[FACE_MOST_NODES][3], at[SURFACE_RULE_MOST][2], weights[SURFACE_RULE_MOST];
    surface_rule_nodes(rule, face, nodes);
    /* points of integration, each with its area as a vector */
    place_face_points(count, at, weights);
    for (size_t p = 0; p < face_point_count(count); p++) {
        size_t i = rule->first[face] + p;
        double area[3];
        facet_place((int)count, nodes, at[p][0], at[p][1], rule->points[i], area);
        scale3(weights[p], area, rule->areas[i]);
    }
    rule->radii[face] = surface_rule_sphere(count, nodes, rule->centres[face]);
}

bool surface_rule_make(struct surface_rule *rule, const struct solid_mesh *mesh,
                       const struct surface *surface)
{
    /* arrays with one entry a face */
    size_t faces = surface->face_count, total = 0;
    *rule = (struct surface_rule){.mesh = mesh, .surface = surface};
    rule->first = malloc((faces + 1) * sizeof *rule->first);
    rule->centres = malloc(faces * sizeof *rule->centres);
    rule->radii = malloc(faces * sizeof *rule->radii);
    if (!rule->first || !rule->centres || !rule->radii)
        goto no_memory;
    /* where the points of each face begin */
    for (size_t f = 0; f < faces; f++) {
        rule->first[f] = total;
        total += face_point_count(surface->faces[f].count);
    }
    rule->first[faces] = total;
    /* the points */
    rule->points = malloc(total * sizeof *rule->points);
    rule->areas = malloc(total * sizeof *rule->areas);
    if (!rule->points || !rule->areas)
        goto no_memory;

    /* shapes at the points, for each type of face */
    static const int COUNTS[3] = {FACE_TRIANGLE6, FACE_QUAD8, FACE_QUAD9};
    for (int kind = 0; kind < 3; kind++) {
        double at[SURFACE_RULE_MOST][2], weights[SURFACE_RULE_MOST];
        place_face_points((size_t)COUNTS[kind], at, weights);
        for (size_t p = 0; p < face_point_count((size_t)COUNTS[kind]); p++)
            facet_shape(COUNTS[kind], at[p][0], at[p][1], rule->shapes[COUNTS[kind]][p], NULL,
                        NULL);
    }
    for (size_t f = 0; f < faces; f++)
        surface_rule_fill_face(rule, f);
    return true;

no_memory:
    surface_rule_free(rule);
    return false;
}

void surface_rule_free(struct surface_rule *rule)
{
    free(rule->first);
    free(rule->points);
    free(rule->areas);
    free(rule->centres);
    free(rule->radii);
    *rule = (struct surface_rule){0};
}

/* ---- sharp edges and places ---- */

/* A face is plane if its nodes lie in a plane to this part of its size: tilts of this order change
 * the flexibility by as much over E h. */
static const double PLANE = 1e-5;
/* least distance from the rim of a curved face, in local coordinates (0 to 1): the kink there is
 * felt as its angle over E times the distance */
static const double OFF_RIM = 0.15;
/* of a curved face's radius: within it the surface's bend is its curvature alone */
static const double CUT = 0.02;

/* Of a face's reach: at a third of an element from a right edge the solution on it is good to
 * .02/(E distance), at an eighth to .05, and a quadratic face follows 1/distance from about there
 * on. */
static const double KNOWN_FROM = 0.3;

/* Walls thinner than this part of an element (flexibility_place_thin), and the cosine from which on
 * a surface is the far side of one. */
static const double THIN = 0.4;
static const double OPPOSITE = 0.7;

struct half_edge {
    size_t ends[2], middle; /* nodes, ends[0] < ends[1] */
    size_t patch, face;
    bool hollow;
};

static int half_edge_compare(const void *a, const void *b)
{
    const struct half_edge *p = a, *q = b;
    for (int i = 0; i < 2; i++)
        if (p->ends[i] != q->ends[i])
            return p->ends[i] < q->ends[i] ? -1 : 1;
    return p->patch < q->patch ? -1 : p->patch > q->patch;
}

static size_t collect_edges(const struct surface *surface, struct half_edge *all)
{
    size_t count = 0;
    for (size_t f = 0; f < surface->face_count; f++) {
        const struct surface_face *face = &surface->faces[f];
        size_t corners = face->count == FACE_TRIANGLE6 ? 3 : 4;
        for (size_t i = 0; i < corners; i++) {
            size_t a = face->nodes[i], b = face->nodes[(i + 1) % corners];
            all[count++] = (struct half_edge){
                {a < b ? a : b, a < b ? b : a}, face->nodes[corners + i], face->patch, f, false};
        }
    }
    return count;
}

/* all nodes in the plane of the first three corners */
static bool is_flat_face(int count, const double (*nodes)[3], double radius)
{
    double a[3], b[3], normal[3];
    sub3(nodes[1], nodes[0], a);
    sub3(nodes[2], nodes[0], b);
    cross3(a, b, normal);
    scale3(1.0 / norm3(normal), normal, normal);
    for (int i = 3; i < count; i++) {
        sub3(nodes[i], nodes[0], a);
        if (fabs(dot3(a, normal)) > PLANE * radius)
            return false;
    }
    return true;
}

/* patches with all points in the tangent plane of the first */
static void find_plane_patches(const struct surface_rule *rule, bool *plane)
{
    const struct surface *surface = rule->surface;
    for (size_t patch = 0; patch < surface->patch_count; patch++) {
        const double *origin = NULL, *area = NULL;
        plane[patch] = true;
        for (size_t f = 0; f < surface->face_count && plane[patch]; f++) {
            if (surface->faces[f].patch != patch)
                continue;
            size_t first = rule->first[f];
            origin = origin ? origin : rule->points[first];
            area = area ? area : rule->areas[first];
            for (size_t i = first; i < rule->first[f + 1]; i++) {
                double offset[3];
                sub3(rule->points[i], origin, offset);
                if (fabs(dot3(offset, area)) > PLANE * surface->size * norm3(area))
                    plane[patch] = false;
            }
        }
    }
}

/* whether the neighbour across the edge rises above the own face's plane */
static bool is_hollow(const struct surface_rule *rule, const struct half_edge *own,
                      const struct half_edge *other)
{
    if (!other || own->ends[0] != other->ends[0] || own->ends[1] != other->ends[1])
        return false;
    double across[3];
    sub3(rule->centres[other->face], rule->mesh->points[own->middle], across);
    return dot3(across, rule->areas[rule->first[own->face]]) > 0.0;
}

/* How far the face reaches from the edge, at most the mesh's size. */
static double find_edge_reach(const struct flexibility_edges *edges,
                              const struct surface_rule *rule, size_t face)
{
    const struct surface_face *f = &rule->surface->faces[face];
    double size = rule->surface->size;
    double reach = flexibility_edges_distance(edges, f->patch, rule->centres[face]);
    for (size_t n = 0; n < f->count && reach < size; n++)
        reach = fmax(reach,
                     flexibility_edges_distance(edges, f->patch, rule->mesh->points[f->nodes[n]]));
    return fmin(reach, size);
}

bool flexibility_edges_make(struct flexibility_edges *edges, const struct surface_rule *rule)
{
    *edges = (struct flexibility_edges){0};
    struct half_edge *all = malloc(4 * rule->surface->face_count * sizeof *all);
    if (!all)
        return false;
    size_t count = collect_edges(rule->surface, all);
    qsort(all, count, sizeof *all, half_edge_compare);

    /* an edge of two faces of one patch is none; the others move to the front */
    size_t kept = 0;
    for (size_t i = 0; i < count;) {
        size_t next = i + 1;
        while (next < count && half_edge_compare(&all[i], &all[next]) == 0)
            next++;
        if (next == i + 1) {
            all[i].hollow = is_hollow(rule, &all[i], i > 0 ? &all[i - 1] : NULL) ||
                            is_hollow(rule, &all[i], next < count ? &all[next] : NULL);
            all[kept++] = all[i];
        }
        i = next;
    }
    edges->points = malloc((kept ? kept : 1) * sizeof *edges->points);
    edges->patches = malloc((kept ? kept : 1) * sizeof *edges->patches);
    edges->hollow = malloc((kept ? kept : 1) * sizeof *edges->hollow);
    edges->plane = malloc(rule->surface->patch_count * sizeof *edges->plane);
    edges->reach = malloc(rule->surface->face_count * sizeof *edges->reach);
    if (!edges->points || !edges->patches || !edges->hollow || !edges->plane || !edges->reach) {
        free(all);
        flexibility_edges_free(edges);
        return false;
    }
    find_plane_patches(rule, edges->plane);
    edges->count = kept;
    for (size_t i = 0; i < kept; i++) {
        const size_t nodes[3] = {all[i].ends[0], all[i].middle, all[i].ends[1]};
        for (int n = 0; n < 3; n++)
            memcpy(edges->points[i][n], rule->mesh->points[nodes[n]], sizeof edges->points[i][n]);
        edges->patches[i] = all[i].patch;
        edges->hollow[i] = all[i].hollow;
    }
    free(all);
    for (size_t face = 0; face < rule->surface->face_count; face++)
        edges->reach[face] = find_edge_reach(edges, rule, face);
    return true;
}

void flexibility_edges_free(struct flexibility_edges *edges)
{
    free(edges->points);
    free(edges->patches);
    free(edges->hollow);
    free(edges->plane);
    free(edges->reach);
    *edges = (struct flexibility_edges){0};
}

static double segment_distance(const double a[3], const double b[3], const double x[3])
{
    double along[3], offset[3];
    sub3(b, a, along);
    sub3(x, a, offset);
    double square = dot3(along, along);
    double t = square > 0.0 ? dot3(offset, along) / square : 0.0;
    add_scaled3(-fmin(fmax(t, 0.0), 1.0), along, offset);
    return norm3(offset);
}

double flexibility_edges_distance(const struct flexibility_edges *edges, size_t patch,
                                  const double x[3])
{
    double nearest = INFINITY;
    for (size_t i = 0; i < edges->count; i++) {
        if (edges->patches[i] != patch)
            continue;
        const double(*p)[3] = edges->points[i];
        nearest =
            fmin(nearest, fmin(segment_distance(p[0], p[1], x), segment_distance(p[1], p[2], x)));
    }
    return nearest;
}

/* ---- one place ---- */

static void unit_normal_at(int count, const double (*nodes)[3], double u, double v,
                           double normal[3])
{
    double area[3];
    facet_place(count, nodes, u, v, NULL, area);
    scale3(1.0 / norm3(area), area, normal);
}

static void move_off_rim(int count, double *u, double *v)
{
    if (count == FACE_TRIANGLE6) {
        /* towards the middle until the least of the three coordinates is far enough */
        double least = fmin(fmin(*u, *v), 1.0 - *u - *v);
        double way = least < OFF_RIM ? (OFF_RIM - least) / (1.0 / 3.0 - least) : 0.0;
        *u += way * (1.0 / 3.0 - *u);
        *v += way * (1.0 / 3.0 - *v);
        return;
    }
    double most = 1.0 - 2.0 * OFF_RIM;
    *u = fmin(fmax(*u, -most), most);
    *v = fmin(fmax(*v, -most), most);
}

/* derivatives of the position by differences, exact for these faces: u, v, uu, uv, vv */
static void differentiate_face(int count, const double (*nodes)[3], double u, double v,
                               double derivative[5][3])
{
    double at[3][3][3];
    for (int i = -1; i <= 1; i++)
        for (int j = -1; j <= 1; j++)
            facet_place(count, nodes, u + 0.1 * i, v + 0.1 * j, at[i + 1][j + 1], NULL);
    for (int k = 0; k < 3; k++) {
        derivative[0][k] = 5.0 * (at[2][1][k] - at[0][1][k]);
        derivative[1][k] = 5.0 * (at[1][2][k] - at[1][0][k]);
        derivative[2][k] = 100.0 * (at[2][1][k] - 2.0 * at[1][1][k] + at[0][1][k]);
        derivative[3][k] = 25.0 * (at[2][2][k] - at[2][0][k] - at[0][2][k] + at[0][0][k]);
        derivative[4][k] = 100.0 * (at[1][2][k] - 2.0 * at[1][1][k] + at[1][0][k]);
    }
}

/* The second fundamental form as a tensor: by the dual base of the tangents. */
static void curvature_of(double derivative[5][3], const double normal[3], double curvature[9])
{
    const double *a = derivative[0], *b = derivative[1];
    double e = dot3(a, a), f = dot3(a, b), g = dot3(b, b), det = e * g - f * f, dual[2][3];
    double l = dot3(derivative[2], normal), m = dot3(derivative[3], normal);
    double n = dot3(derivative[4], normal);
    for (int k = 0; k < 3; k++) {
        dual[0][k] = (g * a[k] - f * b[k]) / det;
        dual[1][k] = (e * b[k] - f * a[k]) / det;
    }
    for (int k = 0; k < 9; k++) {
        int i = k / 3, j = k % 3;
        curvature[k] = -(l * dual[0][i] * dual[0][j] + n * dual[1][i] * dual[1][j] +
                         m * (dual[0][i] * dual[1][j] + dual[1][i] * dual[0][j]));
    }
}

/* Least radius, and the mean of the radius' logarithm over the angle, of the face's rim as seen
 * from the point, its edges being straight in local coordinates. */
static void measure_rim(int count, double derivative[5][3], double u, double v, double *least,
                        double *mean)
{
    enum { STEPS = 64 };
    int corners = count == FACE_TRIANGLE6 ? 3 : 4;
    double angle = 0.0, sum = 0.0;
    *least = INFINITY;
    /* the edge in local coordinates */
    for (int i = 0; i < corners; i++) {
        double from[2], to[2];
        facet_node(count, i, &from[0], &from[1]);
        facet_node(count, (i + 1) % corners, &to[0], &to[1]);
        /* in short steps: the radius, and the angle that each turns by */
        for (int s = 0; s < STEPS; s++) {
            double t = (s + 0.5) / STEPS, radius[3] = {0.0}, step[3] = {0.0}, across[3];
            add_scaled3(from[0] + t * (to[0] - from[0]) - u, derivative[0], radius);
            add_scaled3(from[1] + t * (to[1] - from[1]) - v, derivative[1], radius);
            add_scaled3((to[0] - from[0]) / STEPS, derivative[0], step);
            add_scaled3((to[1] - from[1]) / STEPS, derivative[1], step);
            cross3(radius, step, across);
            double turn = norm3(across) / dot3(radius, radius);
            angle += turn;
            sum += turn * log(norm3(radius));
            *least = fmin(*least, norm3(radius));
        }
    }
    /* its logarithm, weighed by angle */
    *mean = exp(sum / angle);
}

/* Half the height above the tangent plane of the lowest surface that is seen from the point within
 * 45 degrees of its normal. Nodes may miss a surface nearer than their distance from each other:
 * within it the cone is a cylinder, which starts above the waves of a coarse mesh. */
static double find_reach(const struct surface_rule *rule, const struct boussinesq3 *load)
{
    double size = rule->surface->size, lowest = INFINITY;
    for (size_t i = 0; i < rule->first[rule->surface->face_count]; i++) {
        double r[3];
        sub3(rule->points[i], load->point, r);
        double height = -dot3(r, load->inward);
        if (height <= 0.3 * size || height >= lowest)
            continue;
        double aside = sqrt(fmax(dot3(r, r) - height * height, 0.0));
        if (aside < fmax(height, 0.6 * size))
            lowest = height;
    }
    return 0.5 * lowest;
}

/* Depth of the nearest surface that faces the other way, seen within some 17 degrees of the inward
 * normal: surfaces that rise beside an edge do not count. */
static double find_wall(const struct surface_rule *rule, const struct boussinesq3 *load)
{
    double size = rule->surface->size, nearest = INFINITY;
    for (size_t i = 0; i < rule->first[rule->surface->face_count]; i++) {
        double r[3];
        sub3(rule->points[i], load->point, r);
        double depth = dot3(r, load->inward);
        if (depth <= 0.0 || depth >= nearest ||
            dot3(rule->areas[i], load->inward) < OPPOSITE * norm3(rule->areas[i]))
            continue;
        double aside = sqrt(fmax(dot3(r, r) - depth * depth, 0.0));
        if (aside < fmax(0.3 * depth, 0.5 * size))
            nearest = depth;
    }
    return nearest;
}

static double mean_edge(int count, const double (*nodes)[3])
{
    int corners = count == FACE_TRIANGLE6 ? 3 : 4;
    double sum = 0.0;
    for (int i = 0; i < corners; i++) {
        double edge[3];
        sub3(nodes[(i + 1) % corners], nodes[i], edge);
        sum += norm3(edge);
    }
    return sum / corners;
}

bool flexibility_place_thin(const struct flexibility_place *place)
{
    return place->wall < THIN * place->element;
}

bool flexibility_place_beside(const struct flexibility_place *place, const double node[3])
{
    double offset[3];
    sub3(node, place->load.point, offset);
    return norm3(offset) < place->element;
}

bool flexibility_place_massive(const struct flexibility_place *place, const struct solid_mesh *mesh)
{
    for (size_t i = 0; i < mesh->mass_count; i++)
        if (flexibility_place_beside(place, mesh->points[mesh->masses[i].node]))
            return true;
    return false;
}

double flexibility_edges_known(const struct flexibility_edges *edges, size_t face)
{
    return KNOWN_FROM * edges->reach[face];
}

static void place_tangents(struct flexibility_place *place)
{
    const double *n = place->load.inward;
    double axis[3] = {0.0};
    axis[fabs(n[0]) < 0.6 ? 0 : 1] = 1.0;
    cross3(n, axis, place->along[0]);
    scale3(1.0 / norm3(place->along[0]), place->along[0], place->along[0]);
    cross3(n, place->along[0], place->along[1]);
}

const double *flexibility_place_direction(const struct flexibility_place *place, int load)
{
    return load == 0 ? place->load.inward : place->along[load - 1];
}

void flexibility_place_field(const struct flexibility_place *place, int load, const double x[3],
                             double displacement[3], double stress[6])
{
    if (load == 0)
        boussinesq3_field(&place->load, x, displacement, stress);
    else
        cerruti3_field(&place->load, place->along[load - 1], x, displacement, stress);
}

void flexibility_place_added_stress(const struct flexibility_place *place, int load,
                                    const double x[3], double stress[6])
{
    if (load == 0)
        boussinesq3_added_stress(&place->load, x, stress);
    else
        cerruti3_added_stress(&place->load, place->along[load - 1], x, stress);
}

double flexibility_place_added(const struct flexibility_place *place, int load)
{
    return load == 0 ? boussinesq3_added_displacement(&place->load)
                     : cerruti3_added_displacement(&place->load);
}

struct flexibility_place flexibility_place_make(const struct surface_rule *rule,
                                                const struct flexibility_edges *edges, size_t face,
                                                double u, double v)
{
    const struct surface_face *f = &rule->surface->faces[face];
    double nodes[FACE_MOST_NODES][3], derivative[5][3], normal[3], least;
    surface_rule_nodes(rule, face, nodes);
    struct flexibility_place place = {.face = face, .part = f->part};
    place.flat = is_flat_face(f->count, nodes, rule->radii[face]);
    if (!edges->plane[f->patch])
        move_off_rim(f->count, &u, &v);
    place.u = u;
    place.v = v;

    /* the load */
    const struct material *material = &rule->mesh->part[f->part].material;
    facet_place(f->count, nodes, u, v, place.load.point, NULL);
    unit_normal_at(f->count, nodes, u, v, normal);
    scale3(-1.0, normal, place.load.inward);
    place.load.young = material->young;
    place.load.poisson = material->poisson;
    place.load.reach = find_reach(rule, &place.load);
    place.loads = 1;
    place_tangents(&place);

    /* the face about it */
    differentiate_face(f->count, nodes, u, v, derivative);
    if (!place.flat)
        curvature_of(derivative, normal, place.curvature);
    measure_rim(f->count, derivative, u, v, &least, &place.rim);
    place.cut = place.flat ? 0.0 : CUT * least;
    place.edge = flexibility_edges_distance(edges, f->patch, place.load.point);
    place.wall = find_wall(rule, &place.load);
    place.element = mean_edge(f->count, nodes);
    return place;
}
