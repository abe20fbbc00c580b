/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/mesh_between.h"

#include <math.h>
#include <string.h>

#include "model/mesh_surface.h"
#include "model/vector.h"

/* Parts of an element, the longer one of both sites. */
static const double ONE_PLACE = 0.5;
/* Sites that a place is interpolated from: enough for a plane through them. */
enum { NEIGHBOURS = 6 };

/* A place as a weighted mean of sites. */
struct mean {
    int count;
    size_t site[NEIGHBOURS];
    double weight[NEIGHBOURS];
};

/* The nearest sites of the place's own patch, by distance; their distances. */
static void find_neighbours(const struct mesh_body *mesh, const struct mesh_push *push,
                            struct mean *mean, double distances[NEIGHBOURS])
{
    unsigned patch = mesh->faces[push->face].patch;
    mean->count = 0;
    for (size_t s = 0; s < mesh->site_count; s++) {
        double apart[3];
        if (mesh->faces[mesh->site_face[s]].patch != patch)
            continue;
        sub3(mesh->site_point[s], push->point, apart);
        double distance = norm3(apart);
        int at = mean->count < NEIGHBOURS ? mean->count++ : NEIGHBOURS;
        if (at == NEIGHBOURS && !(distance < distances[--at]))
            continue;
        for (; at > 0 && distance < distances[at - 1]; at--) {
            distances[at] = distances[at - 1];
            mean->site[at] = mean->site[at - 1];
        }
        distances[at] = distance;
        mean->site[at] = s;
    }
}

/* Tangents of the surface at a place. */
static void find_tangents(const double n[3], double t[2][3])
{
    int smallest = fabs(n[0]) < 0.6 ? 0 : 1;
    double axis[3] = {0.0, 0.0, 0.0};
    axis[smallest] = 1.0;
    cross3(n, axis, t[0]);
    scale3(1.0 / norm3(t[0]), t[0], t[0]);
    cross3(n, t[0], t[1]);
}

/* Weights that are those of the plane fitted to the neighbours, the nearer the more (moving least
 * squares): with p = (1, x, y) of each, w_a = g_a p_a . A^-1 e_1, A = sum g p p^T. False: they lie
 * on a line. */
static bool fit_plane(const struct mesh_body *mesh, const struct mesh_push *push, struct mean *mean,
                      const double distances[NEIGHBOURS])
{
    double t[2][3], p[NEIGHBOURS][3], g[NEIGHBOURS], a[3][3] = {{0.0}};
    double reach = distances[mean->count - 1];
    find_tangents(push->direction, t);
    for (int i = 0; i < mean->count; i++) {
        double apart[3];
        sub3(mesh->site_point[mean->site[i]], push->point, apart);
        p[i][0] = 1.0;
        p[i][1] = dot3(apart, t[0]) / reach;
        p[i][2] = dot3(apart, t[1]) / reach;
        /* much more for the nearest, so that the mean is its own where it lies on a site */
        double near = distances[i] / reach;
        g[i] = 1.0 / (near * near + 1e-6) - 1.0 / (1.0 + 1e-6) + 1e-3;
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++)
                a[r][c] += g[i] * p[i][r] * p[i][c];
    }
    /* the first column of the inverse, by cofactors */
    double cofactor[3] = {a[1][1] * a[2][2] - a[1][2] * a[2][1],
                          a[1][2] * a[2][0] - a[1][0] * a[2][2],
                          a[1][0] * a[2][1] - a[1][1] * a[2][0]};
    double determinant = a[0][0] * cofactor[0] + a[0][1] * cofactor[1] + a[0][2] * cofactor[2];
    if (!(determinant > 1e-9 * a[0][0] * a[1][1] * a[2][2]))
        return false;
    for (int i = 0; i < mean->count; i++)
        mean->weight[i] = g[i] *
                          (p[i][0] * cofactor[0] + p[i][1] * cofactor[1] + p[i][2] * cofactor[2]) /
                          determinant;
    return true;
}

static struct mean find_mean(const struct mesh_body *mesh, const struct mesh_push *push)
{
    struct mean mean;
    double distances[NEIGHBOURS];
    find_neighbours(mesh, push, &mean, distances);
    if (mean.count > 3 && distances[mean.count - 1] > 0.0 &&
        fit_plane(mesh, push, &mean, distances))
        return mean;
    /* the nearest alone */
    mean.count = mean.count > 0 ? 1 : 0;
    mean.weight[0] = 1.0;
    return mean;
}

/* The half-space's part, of forces on one patch: (1 - nu^2)/(pi E r), as far as their normals are
 * one. It is singular where all else is smooth. */
static double half_space_field(const struct mesh_body *mesh, unsigned face, double distance,
                               double alike)
{
    const struct material *material = &mesh->materials[mesh->faces[face].material];
    double nu = material->poisson;
    return fmax(alike, 0.0) * (1.0 - nu * nu) / (M_PI * material->young * distance);
}

/* What two sites have beside it; of those that are one place, but for a part of an element, the
 * mean of their own. That the whole between neighbours is no smooth function (mesh->near) does not
 * matter here. */
static double regular_part(const struct mesh_body *mesh, size_t a, size_t b, bool one_patch)
{
    double apart[3];
    sub3(mesh->site_point[a], mesh->site_point[b], apart);
    double distance = norm3(apart);
    size_t n = mesh->site_count;
    double element = fmax(mesh_surface_face_size(mesh, mesh->site_face[a]),
                          mesh_surface_face_size(mesh, mesh->site_face[b]));
    if (one_patch && distance < ONE_PLACE * element)
        return 0.5 * ((double)mesh->between[a * n + a] + (double)mesh->between[b * n + b]);
    double all = (double)mesh->between[a * n + b];
    return one_patch ? all - half_space_field(mesh, mesh->site_face[a], distance,
                                              dot3(mesh->site_normal[a], mesh->site_normal[b]))
                     : all;
}

double mesh_between(const struct mesh_body *mesh, const struct mesh_push *i,
                    const struct mesh_push *j)
{
    if (!mesh->between)
        return NAN;
    struct mean at_i = find_mean(mesh, i), at_j = find_mean(mesh, j);
    if (at_i.count == 0 || at_j.count == 0)
        return NAN;
    /* the smooth part between all pairs */
    bool one_patch = mesh->faces[i->face].patch == mesh->faces[j->face].patch;
    double sum = 0.0;
    for (int a = 0; a < at_i.count; a++)
        for (int b = 0; b < at_j.count; b++)
            sum += at_i.weight[a] * at_j.weight[b] *
                   regular_part(mesh, at_i.site[a], at_j.site[b], one_patch);
    /* and the other one, no nearer than a contact is wide */
    double apart[3];
    sub3(i->point, j->point, apart);
    double distance = fmax(norm3(apart), mesh->cut);
    if (one_patch && distance > 0.0)
        sum += half_space_field(mesh, i->face, distance, dot3(i->direction, j->direction));
    return sum;
}
