/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/body_layout.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const size_t ONE = 1;
static const size_t THREE = 3;
static const size_t SIX = 6;
static const size_t TENSOR = 9;
static const size_t CORNERS = MESH_BODY_FACE_NODES;

static struct layout number(const char *name, const char *unit, enum layout_range range,
                            double *value)
{
    return (struct layout){.name = name, .unit = unit, .range = range, .value = value};
}

static struct layout vector(const char *name, const char *unit, const size_t *length, double *value)
{
    return (struct layout){
        .name = name, .unit = unit, .rank = 1, .extent = {length}, .value = value};
}

static struct layout whole(const char *name, unsigned *value)
{
    return (struct layout){.name = name, .unit = "1", .type = LAYOUT_WHOLE32, .value = value};
}

/* An array of one number for each of something. */
static struct layout list_of(const char *name, const char *unit, enum layout_range range,
                             const size_t *count, double **array)
{
    return (struct layout){.name = name,
                           .unit = unit,
                           .range = range,
                           .rank = 1,
                           .extent = {count},
                           .array = (void **)array};
}

static struct layout table_of(const char *name, const char *unit, const size_t *count,
                              const size_t *width, void *array)
{
    return (struct layout){
        .name = name, .unit = unit, .rank = 2, .extent = {count, width}, .array = array};
}

static struct layout *list_body(struct layout *next, struct mesh_body *body,
                                struct layout_flat *flat)
{
    *next++ = number("unit", "m", LAYOUT_POSITIVE, &body->unit);
    *next++ = vector("centre", "m", &THREE, body->centre);
    *next++ = number("volume", "m^3", LAYOUT_POSITIVE, &body->volume);
    *next++ = number("mass", "kg", LAYOUT_POSITIVE, &body->mass);
    *next++ = vector("inertia", "kg m^2", &TENSOR, body->inertia);
    *next++ = whole("supported", &flat->supported);
    *next++ = number("element_size", "m", LAYOUT_POSITIVE, &body->element_size);
    *next++ = number("cut", "m", LAYOUT_NOT_NEGATIVE, &body->cut);
    *next++ = number("near", "m", LAYOUT_NOT_NEGATIVE, &body->near);
    return next;
}

static struct layout *list_materials(struct layout *next, struct mesh_body *body,
                                     struct layout_flat *flat)
{
    const size_t *count = &body->material_count;
    *next++ = (struct layout){.name = "materials/name",
                              .type = LAYOUT_NAME,
                              .unit = "1",
                              .rank = 1,
                              .extent = {count},
                              .counts = true,
                              .array = (void **)&flat->names};
    *next++ = list_of("materials/young", "Pa", LAYOUT_POSITIVE, count, &flat->young);
    *next++ = list_of("materials/poisson", "1", LAYOUT_FINITE, count, &flat->poisson);
    *next++ = list_of("materials/density", "kg/m^3", LAYOUT_POSITIVE, count, &flat->density);
    *next++ = list_of("materials/yield", "Pa", LAYOUT_OR_INFINITE, count, &flat->yield);
    *next++ = list_of("materials/tangent", "Pa", LAYOUT_NOT_NEGATIVE, count, &flat->tangent);
    return next;
}

static struct layout *list_vibration(struct layout *next, struct mesh_body *body,
                                     struct layout_flat *flat)
{
    *next = list_of("modes/omega", "rad/s", LAYOUT_POSITIVE, &body->mode_count, &body->omega);
    next++->counts = true;
    *next++ = whole("modes/removed", &flat->removed);
    *next = table_of("surface/points", "m", &body->node_count, &THREE, &body->points);
    next++->counts = true;
    *next++ = (struct layout){.name = "surface/shapes",
                              .unit = "1/sqrt(kg)",
                              .type = LAYOUT_REAL32,
                              .rank = 3,
                              .extent = {&body->node_count, &THREE, &body->mode_count},
                              .packed = true,
                              .array = (void **)&body->shapes};
    return next;
}

static struct layout *list_faces(struct layout *next, struct mesh_body *body,
                                 struct layout_flat *flat)
{
    const size_t *count = &body->face_count;
    const struct layout small = {.type = LAYOUT_WHOLE8, .unit = "1", .rank = 1, .extent = {count}};
    /* what a face is */
    *next = small;
    next->name = "faces/count";
    next->counts = true;
    next++->array = (void **)&flat->face_count;
    *next = small;
    next->name = "faces/material";
    next++->array = (void **)&flat->face_material;
    *next = small;
    next->name = "faces/patch";
    next->type = LAYOUT_WHOLE32;
    next++->array = (void **)&flat->face_patch;
    *next = table_of("faces/nodes", "1", count, &CORNERS, &flat->face_nodes);
    next++->type = LAYOUT_WHOLE32;
    /* and what the surface is like at its nodes */
    const size_t *widths[] = {&THREE, &SIX, &ONE};
    const char *names[] = {"faces/normal", "faces/curvature", "faces/doubt"};
    const char *units[] = {"1", "1/m", "rad"};
    float **arrays[] = {&flat->normal, &flat->curvature, &flat->doubt};
    for (int i = 0; i < 3; i++)
        *next++ = (struct layout){.name = names[i],
                                  .unit = units[i],
                                  .type = LAYOUT_REAL32,
                                  .rank = widths[i] == &ONE ? 2 : 3,
                                  .extent = {count, &CORNERS, widths[i]},
                                  .packed = true,
                                  .array = (void **)arrays[i]};
    *next = table_of("faces/flexibility", "m/N", count, &CORNERS, &flat->flexibility);
    next++->range = LAYOUT_OR_UNKNOWN;
    *next = table_of("faces/flexibility_slope", "m/N", count, &CORNERS, &flat->slope);
    next++->range = LAYOUT_OR_UNKNOWN;
    return next;
}

static struct layout *list_sites(struct layout *next, struct mesh_body *body)
{
    const size_t *count = &body->site_count;
    *next++ = (struct layout){.name = "sites/face",
                              .unit = "1",
                              .type = LAYOUT_WHOLE32,
                              .rank = 1,
                              .extent = {count},
                              .counts = true,
                              .optional = true,
                              .array = (void **)&body->site_face};
    *next = table_of("sites/point", "m", count, &THREE, &body->site_point);
    next++->optional = true;
    *next = table_of("sites/normal", "1", count, &THREE, &body->site_normal);
    next++->optional = true;
    *next = table_of("sites/between", "m/N", count, count, &body->between);
    next->type = LAYOUT_REAL32;
    next->packed = true;
    next++->optional = true;
    return next;
}

size_t layout_list(struct mesh_body *body, struct layout_flat *flat,
                   struct layout list[LAYOUT_MOST])
{
    struct layout *next = list_body(list, body, flat);
    next = list_materials(next, body, flat);
    next = list_vibration(next, body, flat);
    next = list_faces(next, body, flat);
    return (size_t)(list_sites(next, body) - list);
}

bool layout_flat_allocate(struct layout_flat *flat, const struct mesh_body *body)
{
    struct layout list[LAYOUT_MOST];
    struct mesh_body shadow = *body;
    size_t count = layout_list(&shadow, flat, list);
    bool good = true;
    for (size_t i = 0; i < count; i++) {
        bool faces = list[i].extent[0] == &shadow.face_count;
        if (!list[i].array || !(faces || list[i].extent[0] == &shadow.material_count))
            continue;
        size_t numbers = 1;
        for (int d = 0; d < list[i].rank; d++)
            numbers *= *list[i].extent[d];
        *list[i].array = calloc(numbers + 1, layout_size(list[i].type));
        good = good && *list[i].array;
    }
    return good;
}

void layout_flat_free(struct layout_flat *flat)
{
    void *arrays[] = {flat->face_count, flat->face_material, flat->face_patch, flat->face_nodes,
                      flat->normal,     flat->curvature,     flat->doubt,      flat->flexibility,
                      flat->slope,      flat->names,         flat->young,      flat->poisson,
                      flat->density,    flat->yield,         flat->tangent};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        free(arrays[i]);
}

/* Copies one way or the other. */
static void pass(void *flat, void *member, size_t size, bool back)
{
    if (back)
        memcpy(member, flat, size);
    else
        memcpy(flat, member, size);
}

static void pass_face(const struct layout_flat *flat, struct mesh_body_face *face, size_t f,
                      bool back)
{
    enum { NODES = MESH_BODY_FACE_NODES };
    pass(flat->face_count + f, &face->count, sizeof face->count, back);
    pass(flat->face_material + f, &face->material, sizeof face->material, back);
    pass(flat->face_patch + f, &face->patch, sizeof face->patch, back);
    pass(flat->face_nodes + f * NODES, face->nodes, sizeof face->nodes, back);
    pass(flat->normal + f * NODES * 3, face->normal, sizeof face->normal, back);
    pass(flat->curvature + f * NODES * 6, face->curvature, sizeof face->curvature, back);
    pass(flat->doubt + f * NODES, face->doubt, sizeof face->doubt, back);
    pass(flat->flexibility + f * NODES, face->flexibility, sizeof face->flexibility, back);
    pass(flat->slope + f * NODES, face->flexibility_slope, sizeof face->flexibility_slope, back);
}

static void pass_material(const struct layout_flat *flat, struct material *material, size_t i,
                          bool back)
{
    pass(flat->names[i], material->name, sizeof material->name, back);
    pass(flat->young + i, &material->young, sizeof material->young, back);
    pass(flat->poisson + i, &material->poisson, sizeof material->poisson, back);
    pass(flat->density + i, &material->density, sizeof material->density, back);
    pass(flat->yield + i, &material->yield, sizeof material->yield, back);
    pass(flat->tangent + i, &material->tangent, sizeof material->tangent, back);
    material->name[sizeof material->name - 1] = '\0';
}

void layout_flatten(const struct mesh_body *body, struct layout_flat *flat)
{
    flat->supported = body->supported;
    flat->removed = (unsigned)body->removed;
    for (size_t f = 0; f < body->face_count; f++)
        pass_face(flat, &body->faces[f], f, false);
    for (size_t i = 0; i < body->material_count; i++)
        pass_material(flat, &body->materials[i], i, false);
}

void layout_unflatten(const struct layout_flat *flat, struct mesh_body *body)
{
    body->supported = flat->supported != 0;
    body->removed = flat->removed;
    for (size_t f = 0; f < body->face_count; f++)
        pass_face(flat, &body->faces[f], f, true);
    for (size_t i = 0; i < body->material_count; i++)
        pass_material(flat, &body->materials[i], i, true);
}

size_t layout_size(enum layout_type type)
{
    static const size_t sizes[] = {[LAYOUT_REAL64] = sizeof(double),
                                   [LAYOUT_REAL32] = sizeof(float),
                                   [LAYOUT_WHOLE32] = sizeof(unsigned),
                                   [LAYOUT_WHOLE8] = 1,
                                   [LAYOUT_NAME] = PERCUSS_ID_SIZE};
    return sizes[type];
}

static bool is_allowed(enum layout_range range, double value)
{
    switch (range) {
    case LAYOUT_POSITIVE:
        return value > 0.0 && isfinite(value);
    case LAYOUT_NOT_NEGATIVE:
        return value >= 0.0 && isfinite(value);
    case LAYOUT_OR_UNKNOWN:
        return !isinf(value);
    case LAYOUT_OR_INFINITE:
        return value > 0.0;
    default:
        return isfinite(value);
    }
}

bool layout_holds(const struct layout *layout, const void *data, size_t count, size_t *at)
{
    const double *wide = data;
    const float *narrow = data;
    bool real = layout->type == LAYOUT_REAL64 || layout->type == LAYOUT_REAL32;
    for (size_t i = 0; real && i < count; i++) {
        double value = layout->type == LAYOUT_REAL64 ? wide[i] : (double)narrow[i];
        *at = i;
        if (!is_allowed(layout->range, value))
            return false;
    }
    return true;
}

const char *layout_allowed(enum layout_range range)
{
    static const char *const texts[] = {
        [LAYOUT_FINITE] = "finite numbers",
        [LAYOUT_POSITIVE] = "finite and > 0",
        [LAYOUT_NOT_NEGATIVE] = "finite and >= 0",
        [LAYOUT_OR_UNKNOWN] = "finite numbers, or nan where it is not known",
        [LAYOUT_OR_INFINITE] = "> 0",
    };
    return texts[range];
}
