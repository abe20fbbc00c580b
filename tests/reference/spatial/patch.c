/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/patch.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "spatial/moving.h"

/* Bodies symmetric about two planes have four quarters. */
static const double QUARTERS = 4.0;
/* The mesh ends at least so many longer semi-axes away, held: an approach of 0.4 to 0.6 of the
 * inverse of that is lost. */
static const double FAR = 2000.0;
/* Nodes somewhat beyond the ellipse may touch too, for meshes that are coarse. */
static const double ROOM = 1.1;
/* Of a table's smallest contact over its largest. */
static const double SMALLEST = 0.25;

static enum percuss_status check(const struct patch_input *input, struct fault *fault)
{
    if (input->resolution < 2 || input->resolution > 16)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "resolution: %zu: must be 2 ... 16",
                         input->resolution);
    if (!(input->force > 0.0 && isfinite(input->force)))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "force: %g N: must be > 0", input->force);
    if (!(input->curvature[0] > 0.0 && input->curvature[1] >= input->curvature[0]))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "curvature: %g, %g: must be > 0 and the smaller one first",
                         input->curvature[0], input->curvature[1]);
    return PERCUSS_OK;
}

/* a mesh with `resolution` bricks on the shorter axis, finest where bodies touch */
static enum percuss_status make_mesh(const struct patch *patch, size_t resolution,
                                     struct refined *mesh, struct fault *fault)
{
    double brick = patch->axes[1] / (double)resolution;
    unsigned levels = 0;
    while (brick * (double)(2u << levels) < FAR * patch->axes[0])
        levels++;
    struct shape shape = shape_ground(brick * (double)(2u << levels));
    shape.core[0] = patch->axes[0];
    shape.core[1] = patch->axes[1];
    shape.core[2] = 0.5 * patch->axes[1];
    return refined_create(&shape, levels, mesh, fault);
}

/* which nodes of a quarter may touch */
static bool list_nodes(const struct refined *mesh, const struct system3 *system,
                       struct pressed *pressed, double (*points)[2], const double axes[2])
{
    for (size_t i = 0; i < mesh->touching; i++) {
        size_t node = mesh->surface[i];
        const double *p = mesh->points[node];
        if (pow(p[0] / axes[0], 2.0) + pow(p[1] / axes[1], 2.0) > 1.0)
            continue;
        if (system->index[node] == SIZE_MAX)
            return false;
        points[pressed->count][0] = p[0];
        points[pressed->count][1] = p[1];
        pressed->nodes[pressed->count] = system->index[node];
        pressed->directions[pressed->count][0] = pressed->directions[pressed->count][1] = 0.0;
        pressed->directions[pressed->count++][2] = -1.0;
    }
    return pressed->count > 0;
}

static bool take_room(struct patch *patch, size_t n)
{
    patch->compliance = calloc(n * n, sizeof(double));
    patch->coupled = calloc(n * n, sizeof(double));
    patch->series = NAN;
    patch->initial = calloc(n, sizeof(double));
    patch->gaps = calloc(n, sizeof(double));
    patch->set = (struct active_set){.kind = ACTIVE_SET_BY_INDENTATION,
                                     .count = n,
                                     .compliance = patch->coupled,
                                     .initial = patch->gaps,
                                     .force = calloc(n, sizeof(double)),
                                     .active = calloc(n, sizeof(bool)),
                                     .scratch = malloc((n + 1) * (n + 3) * sizeof(double))};
    return patch->compliance && patch->coupled && patch->initial && patch->gaps &&
           patch->set.force && patch->set.active && patch->set.scratch;
}

/* adds one half-space's part of the compliance: statics are a step without inertia */
static enum percuss_status add_body(struct patch *patch, const struct refined *mesh,
                                    const struct material *material, struct fault *fault)
{
    struct system3 system;
    struct pressed pressed = {.nodes = malloc(mesh->touching * sizeof *pressed.nodes),
                              .directions = malloc(mesh->touching * sizeof *pressed.directions)};
    struct pace3 statics = {.rule = {.end = 1.0, .weight = 0.5}};
    enum percuss_status status = system3_create(mesh, material, &system, fault);
    if (status == PERCUSS_OK) {
        patch->freedoms += system.freedoms;
        if (!pressed.nodes || !pressed.directions ||
            !list_nodes(mesh, &system, &pressed, patch->points, patch->axes))
            status = fault_set(fault, PERCUSS_INTERNAL, "no memory, or no node that may touch");
        if (status == PERCUSS_OK)
            status = kept_factor_create(&system, 0.0, &statics.factor, fault);
        /* once it is known how many there are */
        patch->count = pressed.count;
        if (status == PERCUSS_OK &&
            ((!patch->compliance && !take_room(patch, pressed.count)) ||
             !pressed_add_compliance(&system, &pressed, &statics, patch->compliance)))
            status = fault_set(fault, PERCUSS_INTERNAL, "compliance of the contact nodes: failed");
        pace3_free(&statics);
        system3_free(&system);
    }
    free(pressed.nodes);
    free(pressed.directions);
    return status;
}

enum percuss_status patch_create(const struct patch_input *input, struct patch *patch,
                                 struct fault *fault)
{
    memset(patch, 0, sizeof *patch);
    enum percuss_status status = check(input, fault);
    if (status != PERCUSS_OK)
        return status;
    patch->hertz =
        hertz_contact_make(hertz_effective_modulus(&input->materials[0], &input->materials[1]),
                           input->curvature[0], input->curvature[1]);
    hertz_ellipse(&patch->hertz, input->force, patch->axes);
    patch->axes[0] *= ROOM;
    patch->axes[1] *= ROOM;
    /* one mesh for both bodies */
    struct refined mesh;
    status = make_mesh(patch, input->resolution, &mesh, fault);
    if (status != PERCUSS_OK)
        return status;
    patch->points = malloc(mesh.touching * sizeof *patch->points);
    if (!patch->points)
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    for (int b = 0; b < 2 && status == PERCUSS_OK; b++)
        status = add_body(patch, &mesh, &input->materials[b], fault);
    refined_free(&mesh);
    for (size_t i = 0; i < patch->count && status == PERCUSS_OK; i++)
        patch->initial[i] = input->curvature[0] * pow(patch->points[i][0], 2.0) +
                            input->curvature[1] * pow(patch->points[i][1], 2.0);
    if (status != PERCUSS_OK)
        patch_free(patch);
    return status;
}

void patch_free(struct patch *patch)
{
    free(patch->points);
    free(patch->compliance);
    free(patch->coupled);
    free(patch->initial);
    free(patch->gaps);
    free(patch->set.force);
    free(patch->set.active);
    free(patch->set.scratch);
    memset(patch, 0, sizeof *patch);
}

/* The bodies' giving way is the same for all nodes: 4 series on each of a quarter's forces. */
static void set_series(struct patch *patch, double series)
{
    patch->series = series;
    for (size_t i = 0; i < patch->count * patch->count; i++)
        patch->coupled[i] = patch->compliance[i] + QUARTERS * series;
}

double patch_press(struct patch *patch, double approach, double series)
{
    if (series != patch->series)
        set_series(patch, series);
    for (size_t i = 0; i < patch->count; i++)
        patch->gaps[i] = patch->initial[i] - approach;
    return active_set_solve(&patch->set) ? QUARTERS * patch->set.total : NAN;
}

bool patch_tabulate(struct patch *patch, double force, struct patch_table *table)
{
    *table = (struct patch_table){.error = 0.0};
    double largest = pow(force / patch->hertz.stiffness, 2.0 / 3.0);
    for (int i = 1; i <= PATCH_SAMPLES; i++) {
        /* evenly in the contact's size, which is the indentation's root */
        double size = SMALLEST + (1.0 - SMALLEST) * (i - 1) / (PATCH_SAMPLES - 1);
        double d = largest * size * size, axes[2];
        table->indentation[i] = d;
        table->force[i] = patch_press(patch, d, 0.0);
        if (!(table->force[i] > 0.0))
            return false;
        hertz_ellipse(&patch->hertz, table->force[i], axes);
        table->radius[i] = sqrt(axes[0] * axes[1]);
        double exact = patch->hertz.stiffness * pow(d, 1.5);
        table->error = fmax(table->error, fabs(table->force[i] / exact - 1.0));
    }
    return true;
}
