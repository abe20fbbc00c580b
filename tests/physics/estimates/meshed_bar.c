/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "physics/estimates/meshed_bar.h"

#include <stdlib.h>

#include "mesh/bulk.h"
#include "model/mesh_surface.h"
#include "reduce/flexibility.h"
#include "reduce/modes.h"
#include "reduce/reduced_body.h"
#include "shapes/solid_shapes.h"

enum { MOST_MODES = 300 };

static double depth_of(const struct body *bar)
{
    return bar->radius > 0.0 ? 2.0 * bar->radius : bar->height;
}

/* Elements along the bar, three quarters as many on a length as on the depth. */
static size_t layers(const struct body *bar, size_t fine)
{
    return (size_t)ceil(0.75 * (double)fine * bar->length / depth_of(bar));
}

void meshed_bar_snap(const struct body *bar, size_t fine, double point[3], double outward[3])
{
    double cell = bar->length / (double)layers(bar, fine);
    double place = floor((point[0] + 0.5 * bar->length) / cell) + 0.5;
    point[0] = place * cell - 0.5 * bar->length;
    if (bar->radius == 0.0)
        return;
    double turn = M_PI / 8.0 / (double)(fine / 2);
    outward[0] = 0.0;
    outward[1] = sin(turn);
    outward[2] = cos(turn);
    point[1] = bar->radius * outward[1];
    point[2] = bar->radius * outward[2];
}

/* Parabolas through a rim's nodes spaced by an angle a enclose a^4/30 less than the circle. */
static void make_mesh(const struct meshed_bar *wanted, struct solid_mesh *mesh)
{
    const struct body *bar = wanted->bar;
    size_t fine = wanted->fine, along = layers(bar, fine);
    if (bar->radius > 0.0) {
        double wider = 1.0 + pow(M_PI / 8.0 / (double)(fine / 2), 4.0) / 60.0;
        solid_shape_cylinder(ELEMENT_HEX20, (double[2]){wider * bar->radius, bar->length},
                             (size_t[3]){fine / 2, fine / 2, along}, &bar->material, mesh);
        return;
    }
    size_t across = (size_t)ceil((double)fine * sqrt(bar->width / bar->height));
    solid_shape_block(ELEMENT_HEX20, (double[3]){bar->length, bar->width, bar->height},
                      (size_t[3]){along, across < 3 ? 3 : across, fine}, &bar->material, mesh);
}

/* All that is made of the mesh on the way. */
struct making {
    const struct meshed_bar *wanted;
    struct solid_mesh mesh;
    struct surface surface;
    struct bulk bulk;
    struct matrices matrices;
    double *rigid;
    size_t rigid_count;
    struct modes modes;
    struct factor *factor;
};

static void release(struct making *making)
{
    factor_free(making->factor);
    modes_free(&making->modes);
    free(making->rigid);
    matrices_free(&making->matrices);
    surface_free(&making->surface);
    solid_mesh_free(&making->mesh);
}

static enum percuss_status vibrate(struct making *making, struct fault *fault)
{
    enum percuss_status status = surface_make(&making->mesh, &making->surface, fault);
    if (!status)
        status = surface_fit(&making->mesh, &making->surface, fault);
    if (!status)
        status = matrices_make(&making->mesh, &making->matrices, fault);
    if (status)
        return status;
    bulk_of(&making->mesh, &making->bulk);
    double scale = rigid_modes_scale(&making->mesh, &making->bulk);
    status = rigid_modes_make(&making->mesh, &making->matrices, scale, &making->rigid_count,
                              &making->rigid, fault);
    struct modes_task task = {
        .matrices = &making->matrices,
        .rigid = {making->matrices.stiffness.n, making->rigid_count, making->rigid},
        .scale = scale,
        .below = making->wanted->below,
        .most = MOST_MODES,
        .known = SIZE_MAX};
    return status ? status : modes_find(&task, &making->modes, &making->factor, fault);
}

/* The same flexibility everywhere: that of the place. */
static enum percuss_status flex(struct making *making, struct mesh_body *body, struct fault *fault)
{
    struct flexibility_body task = {.mesh = &making->mesh,
                                    .surface = &making->surface,
                                    .matrices = &making->matrices,
                                    .factor = making->factor,
                                    .shift = making->modes.shift,
                                    .rigid_count = making->rigid_count,
                                    .rigid = making->rigid};
    struct flexibility *flexibility = flexibility_make(&task);
    struct flexibility_answer answer;
    double point[3];
    if (!flexibility)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    memcpy(point, making->bulk.centre, sizeof point);
    add_scaled3(1.0, making->wanted->point, point);
    struct surface_place near_it = surface_near(&making->mesh, &making->surface, point);
    struct flexibility_place place =
        flexibility_place_make(flexibility_rule(flexibility), flexibility_edges(flexibility),
                               near_it.face, near_it.foot.u, near_it.foot.v);
    enum percuss_status status = flexibility_solve(flexibility, 1, &place, &answer, fault);
    flexibility_free(flexibility);
    /* stated for a contact of the radius `cut` */
    const struct body *bar = making->wanted->bar;
    const struct material *metal = &bar->material;
    double curvature = bar->radius > 0.0 ? 0.5 / bar->radius : 0.0;
    double slope = flexibility_slope(metal->young, metal->poisson, curvature);
    double value = answer.value + flexibility_of_contact(metal->young, metal->poisson, curvature);
    if (curvature > 0.0)
        value += slope * log(answer.radius / body->cut);
    for (size_t f = 0; f < body->face_count; f++)
        for (int n = 0; n < body->faces[f].count; n++) {
            body->faces[f].flexibility[n] = value;
            body->faces[f].flexibility_slope[n] = slope;
        }
    return status;
}

struct mesh_body *meshed_bar_make(const struct meshed_bar *wanted, struct fault *fault)
{
    struct making making = {.wanted = wanted};
    struct mesh_body *body = NULL;
    make_mesh(wanted, &making.mesh);
    enum percuss_status status = vibrate(&making, fault);
    if (!status) {
        struct reduced_parts parts = {.mesh = &making.mesh,
                                      .surface = &making.surface,
                                      .bulk = &making.bulk,
                                      .modes = &making.modes,
                                      .source = "meshed_bar",
                                      .supports = ""};
        status = reduced_body_make(&parts, &body, fault);
    }
    if (!status)
        status = flex(&making, body, fault);
    if (!status && !mesh_surface_prepare(body))
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    release(&making);
    if (!status)
        return body;
    mesh_body_free(body);
    return NULL;
}
