/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/pair.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "spatial/places.h"

/* Nodes that face each other are nearer than this across the normal: m. */
static const double FACING = 1e-9;
/* What is symmetric about two planes has four quarters. */
static const double QUARTERS = 4.0;
/* Sides of the sphere's face with the contact over its radius, at most, and layers below it. */
static const double SPHERE_FACE = 0.6;
static const size_t SPHERE_LAYERS = 2;

static enum percuss_status check(const struct pair_input *input, struct fault *fault)
{
    if (input->bricks < 4 || input->bricks > 1000)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "bricks: %zu: must be 4 ... 1000",
                         input->bricks);
    if (0.25 * input->beam_length / (double)input->bricks > SPHERE_FACE * input->sphere_radius)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "bricks: %zu: half of one must be shorter than %g of the sphere's radius",
                         input->bricks, SPHERE_FACE);
    if (input->across < 1 || input->across > 4)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "across: %zu: must be 1 ... 4", input->across);
    if (input->levels < 1 || input->levels > 10)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "levels: %u: must be 1 ... 10", input->levels);
    return PERCUSS_OK;
}

static void masses(const struct pair_input *input, double mass[2])
{
    mass[PAIR_BEAM] = input->materials[PAIR_BEAM].density * M_PI * pow(input->beam_radius, 2.0) *
                      input->beam_length;
    mass[PAIR_SPHERE] =
        input->materials[PAIR_SPHERE].density * 4.0 / 3.0 * M_PI * pow(input->sphere_radius, 3.0);
}

/* Hertz's contact, and the ellipse of the hardest blow: both bodies as if they were rigid but for
 * it, where 2/5 k d^(5/2) is the energy of the approach. */
static void size_contact(struct pair *pair)
{
    const struct pair_input *input = &pair->input;
    double along = 0.5 / input->sphere_radius, across = along + 0.5 / input->beam_radius;
    pair->hertz = hertz_contact_make(
        hertz_effective_modulus(&input->materials[0], &input->materials[1]), along, across);
    double mass[2];
    masses(input, mass);
    double energy = 0.5 * pow(input->velocity, 2.0) / (1.0 / mass[0] + 1.0 / mass[1]);
    double approach = pow(energy / (HERTZ_WORK * pair->hertz.stiffness), 0.4);
    hertz_ellipse(&pair->hertz, pair->hertz.stiffness * pow(approach, 1.5), pair->axes);
}

static enum percuss_status make_body(struct pair *pair, int which, const struct shape *shape,
                                     unsigned levels, struct fault *fault)
{
    enum percuss_status status = refined_create(shape, levels, &pair->meshes[which], fault);
    if (status == PERCUSS_OK)
        status = system3_create(&pair->meshes[which], &pair->input.materials[which],
                                &pair->systems[which], fault);
    pair->mass[which] = QUARTERS * pair->systems[which].whole;
    return status;
}

/* The pair's shapes, radii times `swell`, finest where they may touch and as deep as the pressure
 * varies most. The sphere, which is rounder, has bricks of half the size before they are halved. */
static void make_shapes(const struct pair *pair, const double swell[2], struct shape shapes[2])
{
    const struct pair_input *input = &pair->input;
    shapes[PAIR_BEAM] = shape_beam(swell[PAIR_BEAM] * input->beam_radius, input->beam_length,
                                   input->bricks, input->across);
    const double *brick = shapes[PAIR_BEAM].brick;
    double radius = swell[PAIR_SPHERE] * input->sphere_radius;
    double half[2] = {0.5 * brick[0], 0.5 * brick[1]};
    size_t count[3] = {(size_t)(SPHERE_FACE * radius / half[0]),
                       (size_t)(SPHERE_FACE * radius / half[1]), SPHERE_LAYERS};
    shapes[PAIR_SPHERE] = shape_sphere(radius, half, count);
    for (int b = 0; b < 2; b++) {
        shapes[b].core[0] = pair->axes[0];
        shapes[b].core[1] = pair->axes[1];
        shapes[b].core[2] = 0.5 * pair->axes[1];
    }
}

/* Both bodies. Quadratic bricks cut corners off circles: radii a little larger make up for the
 * mass, by which a beam has its stiffness too. */
static enum percuss_status make_bodies(struct pair *pair, struct fault *fault)
{
    const struct pair_input *input = &pair->input;
    enum percuss_status status = PERCUSS_OK;
    struct shape shapes[2];
    double swell[2] = {1.0, 1.0}, exact[2];
    masses(input, exact);
    /* what is missing, before bricks are halved */
    make_shapes(pair, swell, shapes);
    for (int b = 0; b < 2 && status == PERCUSS_OK; b++) {
        status = make_body(pair, b, &shapes[b], 0, fault);
        swell[b] = pow(exact[b] / pair->mass[b], b == PAIR_BEAM ? 1.0 / 2.0 : 1.0 / 3.0);
        refined_free(&pair->meshes[b]);
        system3_free(&pair->systems[b]);
    }
    make_shapes(pair, swell, shapes);
    for (int b = 0; b < 2 && status == PERCUSS_OK; b++)
        status = make_body(pair, b, &shapes[b], input->levels - (b == PAIR_SPHERE), fault);
    return status;
}

/* Direction of the pressure at (x, y): across the surface on which both bodies meet under load, of
 * which each has given way by its share of the compliance. */
static void direction_at(const struct pair *pair, double x, double y, double normal[3])
{
    const struct pair_input *input = &pair->input;
    double soft[2];
    for (int b = 0; b < 2; b++)
        soft[b] = (1.0 - pow(input->materials[b].poisson, 2.0)) / input->materials[b].young;
    double share = soft[PAIR_BEAM] / (soft[PAIR_BEAM] + soft[PAIR_SPHERE]);
    double sphere = 1.0 / input->sphere_radius, beam = 1.0 / input->beam_radius;
    normal[0] = -x * share * sphere;
    normal[1] = -y * (share * (sphere + beam) - beam);
    double length = sqrt(1.0 + normal[0] * normal[0] + normal[1] * normal[1]);
    normal[0] /= length;
    normal[1] /= length;
    normal[2] = 1.0 / length;
}

static double gap_at(const struct pair *pair, double x, double y)
{
    double sphere = pair->input.sphere_radius, beam = pair->input.beam_radius;
    return sphere - sqrt(sphere * sphere - x * x - y * y) + beam - sqrt(beam * beam - y * y);
}

static bool take_room(struct pair *pair, size_t count)
{
    pair->initial = malloc(count * sizeof *pair->initial);
    bool taken = pair->initial != NULL;
    for (int b = 0; b < 2; b++) {
        struct pressed *pressed = &pair->pressed[b];
        pressed->nodes = malloc(count * sizeof *pressed->nodes);
        pressed->directions = malloc(count * sizeof *pressed->directions);
        taken = taken && pressed->nodes && pressed->directions;
    }
    return taken;
}

static void add_facing(struct pair *pair, size_t beam_node, size_t sphere_node)
{
    const double *point = pair->meshes[PAIR_BEAM].points[beam_node];
    size_t nodes[2] = {beam_node, sphere_node}, i = pair->pressed[0].count;
    for (int b = 0; b < 2; b++) {
        struct pressed *pressed = &pair->pressed[b];
        pressed->nodes[i] = pair->systems[b].index[nodes[b]];
        direction_at(pair, point[0], point[1], pressed->directions[i]);
        for (int c = 0; c < 3 && b == PAIR_BEAM; c++)
            pressed->directions[i][c] = -pressed->directions[i][c];
        pressed->count++;
    }
    pair->initial[i] = gap_at(pair, point[0], point[1]);
}

/* finds the sphere's node above each of the beam's within the ellipse */
static bool face_nodes(struct pair *pair)
{
    const struct refined *beam = &pair->meshes[PAIR_BEAM], *sphere = &pair->meshes[PAIR_SPHERE];
    struct places above = {.same = FACING};
    size_t *of_place = malloc(sphere->touching * sizeof *of_place);
    bool faced = of_place && take_room(pair, beam->touching);
    /* the sphere's nodes by what they stand above, each alone */
    for (size_t i = 0; faced && i < sphere->touching; i++) {
        const double *point = sphere->points[sphere->surface[i]];
        size_t place = places_add(&above, (const double[3]){point[0], point[1], 0.0});
        faced = place == i;
        of_place[i] = sphere->surface[i];
    }
    /* the beam's within the ellipse */
    for (size_t i = 0; faced && i < beam->touching; i++) {
        size_t node = beam->surface[i];
        const double *point = beam->points[node];
        if (pow(point[0] / pair->axes[0], 2.0) + pow(point[1] / pair->axes[1], 2.0) > 1.0)
            continue;
        /* one above each, both with freedoms of their own */
        size_t place = places_find(&above, (const double[3]){point[0], point[1], 0.0});
        faced = place != SIZE_MAX && pair->systems[PAIR_BEAM].index[node] != SIZE_MAX &&
                pair->systems[PAIR_SPHERE].index[of_place[place]] != SIZE_MAX;
        if (faced)
            add_facing(pair, node, of_place[place]);
    }
    free(of_place);
    places_free(&above);
    return faced && pair->pressed[0].count > 0;
}

/* the beam's node on its axis, within its brick in the middle */
static size_t find_axis(const struct pair *pair)
{
    const struct system3 *beam = &pair->systems[PAIR_BEAM];
    size_t nearest = 0;
    double least = INFINITY;
    for (size_t i = 0; i < beam->nodes; i++) {
        const double *p = beam->points[i];
        double away = hypot(hypot(p[0], p[1]), p[2] + pair->input.beam_radius);
        if (away < least)
            nearest = i;
        least = fmin(least, away);
    }
    return nearest;
}

enum percuss_status pair_create(const struct pair_input *input, struct pair *pair,
                                struct fault *fault)
{
    memset(pair, 0, sizeof *pair);
    pair->input = *input;
    enum percuss_status status = check(input, fault);
    if (status != PERCUSS_OK)
        return status;
    size_contact(pair);
    status = make_bodies(pair, fault);
    if (status == PERCUSS_OK && !face_nodes(pair))
        status = fault_set(fault, PERCUSS_INTERNAL,
                           "out of memory, or surfaces whose nodes do not face each other");
    if (status != PERCUSS_OK)
        pair_free(pair);
    else
        pair->axis = find_axis(pair);
    return status;
}

void pair_free(struct pair *pair)
{
    for (int b = 0; b < 2; b++) {
        refined_free(&pair->meshes[b]);
        system3_free(&pair->systems[b]);
        free(pair->pressed[b].nodes);
        free(pair->pressed[b].directions);
    }
    free(pair->initial);
    memset(pair, 0, sizeof *pair);
}
