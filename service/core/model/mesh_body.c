/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/mesh_body.h"

#include <math.h>
#include <stdlib.h>

#include "model/limits.h"
#include "model/vector.h"

/* Rounding of a tensor's symmetry, and of a unit vector's length in float. */
static const double ASYMMETRY = 1e-6;
static const double UNIT_LENGTH = 1e-4;
/* And of a tensor and a normal in float. */
static const double SAME_FLEXIBILITY = 1e-5;
/* Of half a thickness, volume over surface, and of the distance from an edge; the least part of it
 * in any case. */
static const double SITE_REACH = 0.1, LEAST_REACH = 0.01;

static enum percuss_status check_inertia(const struct mesh_body *body, struct fault *fault)
{
    const double *j = body->inertia;
    double trace = j[0] + j[4] + j[8];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < i; k++)
            if (!(fabs(j[3 * i + k] - j[3 * k + i]) <= ASYMMETRY * trace))
                return fault_set(fault, PERCUSS_BAD_REQUEST, "inertia: must be symmetric");
    /* leading minors (Sylvester); no moment exceeds the sum of the others */
    double two = j[0] * j[4] - j[1] * j[3];
    double three = j[0] * (j[4] * j[8] - j[5] * j[7]) - j[1] * (j[3] * j[8] - j[5] * j[6]) +
                   j[2] * (j[3] * j[7] - j[4] * j[6]);
    if (!(j[0] > 0.0 && two > 0.0 && three > 0.0))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "inertia: must be positive definite");
    return PERCUSS_OK;
}

static enum percuss_status check_materials(const struct mesh_body *body, struct fault *fault)
{
    struct fault inner = {{0}};
    if (body->material_count == 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "materials: none: must be one at least");
    for (size_t i = 0; i < body->material_count; i++)
        if (material_check(&body->materials[i], &inner))
            return fault_set(fault, PERCUSS_BAD_REQUEST, "materials[%zu].%s", i, inner.text);
    return PERCUSS_OK;
}

static enum percuss_status check_modes(const struct mesh_body *body, struct fault *fault)
{
    if (body->mode_count > LIMIT_MODES)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "modes: %zu: must be at most %d",
                         body->mode_count, LIMIT_MODES);
    if (body->removed > body->mode_count)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "modes/removed: %zu: must be at most the number of modes, %zu",
                         body->removed, body->mode_count);
    for (size_t k = 1; k < body->mode_count; k++)
        if (!(body->omega[k] >= body->omega[k - 1]))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "modes/omega: number %zu is below the one before it: must ascend",
                             k + 1);
    return PERCUSS_OK;
}

static enum percuss_status check_face(const struct mesh_body *body, size_t f, struct fault *fault)
{
    /* number of nodes, indices of material and patch */
    const struct mesh_body_face *face = &body->faces[f];
    if (face->count != 6 && face->count != 8 && face->count != 9)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "faces/count: %u at face %zu: must be 6, 8 or 9", face->count, f);
    if (face->material >= body->material_count)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "faces/material: %u at face %zu: must be below the number of materials, "
                         "%zu",
                         face->material, f, body->material_count);
    if (face->patch >= body->face_count)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "faces/patch: %u at face %zu: must be below the number of faces, %zu",
                         face->patch, f, body->face_count);
    /* its nodes, and a normal at each */
    for (int i = 0; i < face->count; i++) {
        const float *n = face->normal[i];
        double length = sqrt((double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2]);
        if (face->nodes[i] >= body->node_count)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "faces/nodes: %u at face %zu: must be below the number of nodes, %zu",
                             face->nodes[i], f, body->node_count);
        if (!(fabs(length - 1.0) <= UNIT_LENGTH))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "faces/normal: of length %g at face %zu: must be a unit vector",
                             length, f);
    }
    return PERCUSS_OK;
}

/* A contact's own compliance, Hertz's pressure on a half-space, is 3/5 (1 - nu^2)/(E radius). */
static const double HERTZ_MEAN = 0.6;

bool mesh_body_tensor_possible(const struct mesh_body *body, const struct mesh_body_face *face,
                               int node)
{
    const float *t = face->tensor[node];
    const struct material *material = &body->materials[face->material];
    double own =
        HERTZ_MEAN * (1.0 - material->poisson * material->poisson) / (material->young * body->cut);
    double x = t[0] + own, y = t[1] + own, z = t[2] + own, xy = t[3], yz = t[4], zx = t[5];
    /* Sylvester */
    return !(body->cut > 0.0) ||
           (x > 0.0 && x * y > xy * xy &&
            x * (y * z - yz * yz) - xy * (xy * z - yz * zx) + zx * (xy * yz - y * zx) > 0.0);
}

/* The tensors of a face against its flexibilities. */
static enum percuss_status check_tensors(const struct mesh_body *body, size_t f,
                                         struct fault *fault)
{
    const struct mesh_body_face *face = &body->faces[f];
    for (int i = 0; i < face->count; i++) {
        double n[3], tensor[6], size = 0.0, moved = 0.0;
        for (int k = 0; k < 3; k++)
            n[k] = face->normal[i][k];
        for (int k = 0; k < 6; k++) {
            tensor[k] = face->tensor[i][k];
            size += fabs(tensor[k]);
        }
        if (isnan(size))
            continue;
        mesh_body_set_normal(n, face->flexibility[i], tensor);
        for (int k = 0; k < 6; k++)
            moved += fabs(tensor[k] - (double)face->tensor[i][k]);
        if (!(moved <= SAME_FLEXIBILITY * size))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "faces/tensor: at node %d of face %zu: along the normal it must be "
                             "faces/flexibility, %g m/N",
                             i, f, face->flexibility[i]);
        if (!mesh_body_tensor_possible(body, face, i))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "faces/tensor: at node %d of face %zu: with a contact of the radius "
                             "`cut` it must be positive definite",
                             i, f);
    }
    return PERCUSS_OK;
}

enum percuss_status mesh_body_check(const struct mesh_body *body, struct fault *fault)
{
    enum percuss_status status = check_inertia(body, fault);
    if (!status)
        status = check_materials(body, fault);
    if (!status)
        status = check_modes(body, fault);
    if (!status && body->face_count == 0)
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "faces: none: must be one at least");
    for (size_t f = 0; !status && f < body->face_count; f++)
        status = check_face(body, f, fault);
    for (size_t f = 0; !status && body->all_ways && f < body->face_count; f++)
        status = check_tensors(body, f, fault);
    for (size_t s = 0; !status && s < body->site_count; s++)
        if (body->site_face[s] >= body->face_count)
            status = fault_set(fault, PERCUSS_BAD_REQUEST,
                               "sites/face: %u: must be below the number of faces, %zu",
                               body->site_face[s], body->face_count);
    return status;
}

void mesh_body_set_normal(const double n[3], double value, double tensor[6])
{
    static const int ROW[6] = {0, 1, 2, 0, 1, 2}, COLUMN[6] = {0, 1, 2, 1, 2, 0};
    double more = value;
    for (int k = 0; k < 6; k++)
        more -= (k < 3 ? 1.0 : 2.0) * tensor[k] * n[ROW[k]] * n[COLUMN[k]];
    for (int k = 0; k < 6; k++)
        tensor[k] += more * n[ROW[k]] * n[COLUMN[k]];
}

static double rim_distance2(const struct mesh_rim *rim, const double p[3])
{
    double along[3];
    double from[3];
    for (int k = 0; k < 3; k++) {
        along[k] = (double)rim->to[k] - (double)rim->from[k];
        from[k] = p[k] - (double)rim->from[k];
    }
    double length2 = dot3(along, along);
    double t = length2 > 0.0 ? fmin(fmax(dot3(from, along) / length2, 0.0), 1.0) : 0.0;
    add_scaled3(-t, along, from);
    return dot3(from, from);
}

double mesh_body_rim_distance(const struct mesh_body *body, unsigned patch, const double p[3])
{
    double nearest2 = INFINITY;
    for (size_t i = body->rim_first[patch]; i < body->rim_first[patch + 1]; i++)
        nearest2 = fmin(nearest2, rim_distance2(&body->rims[i], p));
    return sqrt(nearest2);
}

/* Flexibilities grow like 1/distance from an edge: those of two places a tenth of it apart differ
 * by a tenth. Of a place that the mesh cannot say nothing but itself is known. Points of a file, in
 * single precision, are found again within the least reach. */
static double reach_of(const struct mesh_body *body, const struct mesh_body_site *site)
{
    double most = SITE_REACH * body->volume / body->area;
    double edge = body->rim_first
                      ? mesh_body_rim_distance(body, body->faces[site->face].patch, site->point)
                      : INFINITY;
    double reach = isnan(site->flexibility) ? 0.0 : SITE_REACH * edge;
    return fmax(LEAST_REACH * most, fmin(reach, most));
}

const struct mesh_body_site *mesh_body_added_at(const struct mesh_body *body, unsigned face,
                                                const double point[3])
{
    const struct mesh_body_site *unknown = NULL;
    for (size_t i = 0; i < body->added_count; i++) {
        const struct mesh_body_site *site = &body->added[i];
        double apart[3];
        sub3(site->point, point, apart);
        if (!(norm3(apart) <= reach_of(body, site)))
            continue;
        if (!isnan(site->flexibility) && body->faces[site->face].patch == body->faces[face].patch)
            return site;
        if (!unknown && isnan(site->flexibility))
            unknown = site;
    }
    return unknown;
}

void mesh_body_free(struct mesh_body *body)
{
    if (!body)
        return;
    free(body->materials);
    free(body->omega);
    free(body->points);
    free(body->shapes);
    free(body->faces);
    free(body->site_face);
    free(body->site_point);
    free(body->site_normal);
    free(body->between);
    free(body->path);
    free(body->origin.mesh);
    free(body->origin.options);
    free(body->added);
    free(body->boxes);
    free(body->order);
    free(body->rim_first);
    free(body->rims);
    free(body);
}
