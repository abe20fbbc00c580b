/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/flexibility_surface.h"

#include <math.h>
#include <string.h>

#include "model/facet.h"
#include "model/vector.h"

/* The rule of degree 6 is good to 1e-8 of a field that changes with the distance from the place,
 * where that is as many radii of a triangle; nearer ones are split. */
static const double FAR = 6.0;
/* Triangles of this part of a face or smaller are not split any more: where the place lies within
 * one the face is plane, t bounded and u like 1/r, and what is wrong is the part of a part. */
enum { MOST_SPLITS = 7 };

/* what is summed for one place and face */
struct surface_sum {
    const struct flexibility_place *place;
    int count; /* nodes of the face */
    const double (*nodes)[3];
    bool in_plane;                     /* the half-space's own tractions are zero */
    double forces[FACE_MOST_NODES][3]; /* integral of N^T t */
    double energy;                     /* of t.u */
};

/* the field's traction on an area and its displacement */
static void look(const struct flexibility_place *place, bool in_plane, const double x[3],
                 const double area[3], double traction[3], double displacement[3])
{
    double stress[6];
    boussinesq3_field(&place->load, x, displacement, in_plane ? NULL : stress);
    if (in_plane)
        boussinesq3_added_stress(&place->load, x, stress);
    boussinesq3_traction(stress, area, traction);
}

static void add_point(struct surface_sum *sum, const double at[2], double weight, bool with_force,
                      bool with_energy)
{
    double x[3], area[3], traction[3], displacement[3], shape[FACE_MOST_NODES];
    facet_place(sum->count, sum->nodes, at[0], at[1], x, area);
    look(sum->place, sum->in_plane, x, area, traction, displacement);
    if (with_energy)
        sum->energy += weight * dot3(traction, displacement);
    if (!with_force)
        return;
    facet_shape(sum->count, at[0], at[1], shape, NULL, NULL);
    for (int n = 0; n < sum->count; n++)
        add_scaled3(weight * shape[n], traction, sum->forces[n]);
}

/* a triangle that is split until it is small beside its distance */
static void add_triangle(struct surface_sum *sum, const struct surface_triangle *triangle,
                         int splits)
{
    /* its centre, and a radius that holds it */
    double middle[2] = {0.0, 0.0}, centre[3], radius = 0.0, offset[3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++)
            middle[k] += triangle->corners[i][k] / 3.0;
    facet_place(sum->count, sum->nodes, middle[0], middle[1], centre, NULL);
    for (int i = 0; i < 3; i++) {
        double corner[3];
        facet_place(sum->count, sum->nodes, triangle->corners[i][0], triangle->corners[i][1],
                    corner, NULL);
        sub3(corner, centre, corner);
        radius = fmax(radius, norm3(corner));
    }
    sub3(centre, sum->place->load.point, offset);

    /* near: by quarters */
    if (norm3(offset) < FAR * radius && splits < MOST_SPLITS) {
        struct surface_triangle parts[4];
        surface_rule_split(triangle, parts);
        for (int i = 0; i < 4; i++)
            add_triangle(sum, &parts[i], splits + 1);
        return;
    }
    /* far: by the rule */
    double at[SURFACE_RULE_POINTS][2], weights[SURFACE_RULE_POINTS];
    surface_rule_place(triangle, at, weights);
    for (int p = 0; p < SURFACE_RULE_POINTS; p++)
        add_point(sum, at[p], weights[p], true, true);
}

/* Gauss' points and weights on 0 .. 1, by Newton's method on Legendre's polynomial */
static void gauss(int count, double *at, double *weights)
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
static void add_fan(struct surface_sum *sum)
{
    /* points of Gauss around the place and along the radius */
    enum { AROUND = 40, ALONG = 12 };
    double around[AROUND], around_weights[AROUND], along[ALONG], along_weights[ALONG];
    gauss(AROUND, around, around_weights);
    gauss(ALONG, along, along_weights);
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
                add_point(sum, even, weight * s, true, false);
                s = exp(least * along[p]);
                const double growing[2] = {place[0] + s * way[0], place[1] + s * way[1]};
                add_point(sum, growing, -least * weight * s * s, false, true);
            }
        }
    }
}

/* a face in or near the place: nodes in the tangent plane have no tractions of the half-space */
static void add_near(const struct surface_rule *rule, size_t face, struct surface_sum *sum)
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
        add_fan(sum);
    } else {
        struct surface_triangle triangles[2];
        size_t count = surface_rule_triangles((size_t)sum->count, triangles);
        for (size_t t = 0; t < count; t++)
            add_triangle(sum, &triangles[t], 0);
    }
    sum->nodes = NULL;
}

static void add_far(const struct surface_rule *rule, size_t face, struct surface_sum *sum)
{
    for (size_t i = rule->first[face]; i < rule->first[face + 1]; i++) {
        const double *shape = rule->shapes[sum->count][i - rule->first[face]];
        double traction[3], displacement[3];
        look(sum->place, false, rule->points[i], rule->areas[i], traction, displacement);
        sum->energy += dot3(traction, displacement);
        for (int n = 0; n < sum->count; n++)
            add_scaled3(shape[n], traction, sum->forces[n]);
    }
}

double flexibility_surface_add(const struct surface_rule *rule,
                               const struct flexibility_place *place, double *force)
{
    double energy = 0.0;
    for (size_t f = 0; f < rule->surface->face_count; f++) {
        const struct surface_face *face = &rule->surface->faces[f];
        struct surface_sum sum = {.place = place, .count = face->count};
        double offset[3];
        sub3(rule->centres[f], place->load.point, offset);
        if (f == place->face || norm3(offset) < FAR * rule->radii[f])
            add_near(rule, f, &sum);
        else
            add_far(rule, f, &sum);
        for (int n = 0; n < sum.count; n++)
            add_scaled3(-1.0, sum.forces[n], force + 3 * face->nodes[n]);
        energy += sum.energy;
    }
    return energy;
}
