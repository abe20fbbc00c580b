/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/reduced_body.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/sha256.h"
#include "model/facet.h"
#include "model/vector.h"

/* The face's share of the integral: polynomials of degree 6 in each direction, which four Gauss
 * points take exactly; a triangle is a square with one side shrunk to a corner (Duffy). */
static double enclosed_by(const struct surface_face *face, const double (*points)[3])
{
    static const double at[4] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                 0.9305681557970263};
    static const double weight[4] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                     0.1739274225687269};
    bool triangle = face->count == FACE_TRIANGLE6;
    double sum = 0.0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            double u = triangle ? at[i] : 2.0 * at[i] - 1.0;
            double v = triangle ? (1.0 - at[i]) * at[j] : 2.0 * at[j] - 1.0;
            double point[3], area[3];
            facet_place(face->count, points, u, v, point, area);
            sum += weight[i] * weight[j] * (triangle ? 1.0 - at[i] : 4.0) * dot3(point, area) / 3.0;
        }
    return sum;
}

double reduced_body_enclosed(const struct solid_mesh *mesh, const struct surface *surface)
{
    double volume = 0.0;
    for (size_t f = 0; f < surface->face_count; f++) {
        double points[FACE_MOST_NODES][3];
        surface_face_points(mesh, &surface->faces[f], points);
        volume += enclosed_by(&surface->faces[f], (const double(*)[3])points);
    }
    return volume;
}

static void name_matrix(const struct sparse *matrix, struct sha256 *hash)
{
    sha256_add(hash, matrix->column, matrix->start[matrix->n] * sizeof *matrix->column);
    sha256_add(hash, matrix->value, matrix->start[matrix->n] * sizeof *matrix->value);
}

/* Of the mesh, its materials and supports, or the matrices that stand for them. */
static struct sha256 begin_name(const struct solid_mesh *mesh, const bool *held,
                                const struct matrices *foreign)
{
    /* the mesh */
    struct sha256 hash = sha256_begin();
    sha256_add(&hash, mesh->points, mesh->node_count * sizeof *mesh->points);
    sha256_add(&hash, mesh->types, mesh->element_count);
    sha256_add(&hash, mesh->nodes, mesh->first[mesh->element_count] * sizeof *mesh->nodes);
    sha256_add(&hash, mesh->parts, mesh->element_count * sizeof *mesh->parts);
    /* its materials */
    for (size_t i = 0; i < mesh->part_count; i++) {
        const struct material *material = &mesh->part[i].material;
        sha256_add(&hash, material->name, strlen(material->name) + 1);
        sha256_add(&hash, &material->young, sizeof material->young);
        sha256_add(&hash, &material->poisson, sizeof material->poisson);
        sha256_add(&hash, &material->density, sizeof material->density);
        sha256_add(&hash, &material->yield, sizeof material->yield);
        sha256_add(&hash, &material->tangent, sizeof material->tangent);
    }
    if (mesh->mass_count)
        sha256_add(&hash, mesh->masses, mesh->mass_count * sizeof *mesh->masses);
    /* supports, and matrices from elsewhere */
    if (held)
        sha256_add(&hash, held, 3 * mesh->node_count * sizeof *held);
    if (foreign) {
        name_matrix(&foreign->stiffness, &hash);
        name_matrix(&foreign->mass, &hash);
    }
    return hash;
}

void reduced_body_hash_mesh(const struct solid_mesh *mesh, const bool *held, char text[SHA256_TEXT])
{
    struct sha256 hash = begin_name(mesh, held, NULL);
    sha256_end(&hash, text);
}

/* Hash of all input that determines the file. */
static void name(const struct reduced_parts *parts, char text[SHA256_TEXT])
{
    struct sha256 hash = begin_name(parts->mesh, parts->held, parts->foreign);
    if (parts->mesh_path)
        sha256_add(&hash, "later", sizeof "later");
    /* the requested sites and modes */
    sha256_add(&hash, parts->sites, parts->site_count * sizeof *parts->sites);
    sha256_add(&hash, &parts->modes->count, sizeof parts->modes->count);
    sha256_end(&hash, text);
}

static bool copy_materials(const struct solid_mesh *mesh, struct mesh_body *body)
{
    body->material_count = mesh->part_count;
    body->materials = malloc(mesh->part_count * sizeof *body->materials);
    for (size_t i = 0; body->materials && i < mesh->part_count; i++)
        body->materials[i] = mesh->part[i].material;
    return body->materials != NULL;
}

/* Numbers nodes of the surface in the order of the mesh's; 0 stands for none, else one more. */
static size_t number_nodes(const struct surface *surface, size_t node_count, unsigned *number)
{
    size_t count = 0;
    for (size_t f = 0; f < surface->face_count; f++)
        for (size_t i = 0; i < surface->faces[f].count; i++)
            number[surface->faces[f].nodes[i]] = 1;
    for (size_t i = 0; i < node_count; i++)
        if (number[i])
            number[i] = (unsigned)++count;
    return count;
}

/* Points from the centre of mass, and shapes, of the surface's nodes. */
static bool copy_nodes(const struct reduced_parts *parts, const unsigned *number,
                       struct mesh_body *body)
{
    const struct modes *modes = parts->modes;
    size_t count = modes->count;
    body->points = malloc(body->node_count * sizeof *body->points);
    body->shapes = malloc(body->node_count * 3 * count * sizeof *body->shapes + 1);
    if (!body->points || !body->shapes)
        return false;
    for (size_t i = 0; i < parts->mesh->node_count; i++) {
        if (!number[i])
            continue;
        size_t at = number[i] - 1;
        sub3(parts->mesh->points[i], parts->bulk->centre, body->points[at]);
        for (size_t k = 0; k < 3; k++)
            for (size_t m = 0; m < count; m++)
                body->shapes[(3 * at + k) * count + m] =
                    (float)modes->shapes[m * modes->n + 3 * i + k];
    }
    return true;
}

static void copy_face(const struct surface *surface, size_t f, const unsigned *number,
                      struct mesh_body_face *copy)
{
    static const int tensor[6] = {0, 4, 8, 1, 5, 2}; /* xx yy zz xy yz zx */
    const struct surface_face *face = &surface->faces[f];
    memset(copy, 0, sizeof *copy);
    copy->count = face->count;
    copy->material = (unsigned char)face->part;
    copy->patch = (unsigned)face->patch;
    for (size_t i = 0; i < face->count; i++) {
        const struct surface_point *point = &surface->points[f][i];
        copy->nodes[i] = number[face->nodes[i]] - 1;
        for (int k = 0; k < 3; k++)
            copy->normal[i][k] = (float)point->normal[k];
        for (int k = 0; k < 6; k++)
            copy->curvature[i][k] = (float)point->curvature[tensor[k]];
        copy->doubt[i] = (float)point->doubt;
        copy->flexibility[i] = NAN;
    }
}

static bool fill(const struct reduced_parts *parts, struct mesh_body *body)
{
    const struct surface *surface = parts->surface;
    const struct modes *modes = parts->modes;
    unsigned *number = calloc(parts->mesh->node_count + 1, sizeof *number);
    body->omega = malloc((modes->count + 1) * sizeof *body->omega);
    body->faces = malloc(surface->face_count * sizeof *body->faces);
    bool fine = number && body->omega && body->faces && copy_materials(parts->mesh, body);
    if (fine) {
        body->mode_count = modes->count;
        memcpy(body->omega, modes->omega, modes->count * sizeof *body->omega);
        body->node_count = number_nodes(surface, parts->mesh->node_count, number);
        fine = copy_nodes(parts, number, body);
    }
    for (size_t f = 0; fine && f < surface->face_count; f++)
        copy_face(surface, f, number, &body->faces[f]);
    body->face_count = fine ? surface->face_count : 0;
    free(number);
    return fine;
}

enum percuss_status reduced_body_make(const struct reduced_parts *parts, struct mesh_body **body,
                                      struct fault *fault)
{
    /* a face keeps its material in one byte */
    const struct bulk *bulk = parts->bulk;
    *body = NULL;
    if (parts->mesh->part_count > 256)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%zu parts: must be at most 256",
                         parts->mesh->part_count);
    /* arrays */
    struct mesh_body *made = calloc(1, sizeof *made);
    if (!made || !fill(parts, made)) {
        mesh_body_free(made);
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    }
    /* where it comes from */
    name(parts, made->hash);
    snprintf(made->source, sizeof made->source, "%s", parts->source);
    snprintf(made->supports, sizeof made->supports, "%s", parts->supports);
    made->supported = parts->held != NULL;
    if (parts->mesh_path) {
        made->origin.mesh = strdup(parts->mesh_path);
        made->origin.options = strdup(parts->mesh_options);
        reduced_body_hash_mesh(parts->mesh, parts->held, made->origin.hash);
    }
    if (parts->mesh_path && (!made->origin.mesh || !made->origin.options)) {
        mesh_body_free(made);
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    }
    made->unit = parts->mesh->unit;
    /* the whole body's figures */
    made->volume = bulk->volume;
    made->mass = bulk->mass;
    memcpy(made->centre, bulk->centre, sizeof made->centre);
    memcpy(made->inertia, bulk->inertia, sizeof made->inertia);
    made->element_size = parts->surface->size;
    made->cut = 0.1 * parts->surface->size;
    *body = made;
    return PERCUSS_OK;
}
