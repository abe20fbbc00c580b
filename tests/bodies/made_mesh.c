/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "bodies/made_mesh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/bar.h"
#include "model/modal_basis.h"

/* A mode of the bar, and which of its family it is. */
struct one {
    double omega;
    size_t family, number;
};

struct making {
    const struct made_mesh *wanted;
    struct mesh_body *body;
    struct one *ones;
    struct modal_family *families[BODY_MOST_FAMILIES];
};

static int by_omega(const void *a, const void *b)
{
    const struct one *x = a, *y = b;
    if (x->omega != y->omega)
        return x->omega < y->omega ? -1 : 1;
    return (x->family > y->family) - (x->family < y->family);
}

/* All modes but twist, which nothing on a round bar excites. */
static void list_modes(struct making *making)
{
    const struct body *bar = making->wanted->bar;
    size_t modes = making->wanted->modes, count = 0;
    for (size_t f = 0; f < bar->kind->family_count && f != BAR_TWIST; f++) {
        making->families[f] = modal_family_create(bar, f, modes);
        for (size_t k = 0; k < modes; k++)
            making->ones[count++] = (struct one){making->families[f]->omega[k], f, k};
    }
    qsort(making->ones, count, sizeof *making->ones, by_omega);
    making->body->mode_count = count;
    for (size_t k = 0; k < count; k++)
        making->body->omega[k] = making->ones[k].omega;
}

/* A unit force along `n` at a point: bending moves ends as plane figures, and sides as
 * beam_side_load says. Families come as x, y, z. */
static struct family_load load_at(const struct body *bar, size_t family, const double point[3],
                                  const double n[3], bool end)
{
    struct family_load load = {.acts = true};
    if (!end && family != BAR_LONGITUDINAL)
        load.bar = beam_side_load(bar, (int)(family - BAR_BENDING_Y), point, n);
    load.bar.x = point[0];
    load.bar.force = n[family];
    return load;
}

/* Displacement at a point, along `n`. */
static double shape_of(const struct making *making, const struct one *one, const double point[3],
                       const double n[3], bool end)
{
    const struct body *bar = making->wanted->bar;
    struct family_load load = load_at(bar, one->family, point, n, end);
    /* along: cosines, free at both ends, or sines */
    double phase = (double)(one->number + 1) * M_PI * (point[0] / bar->length + 0.5);
    if (one->family == BAR_LONGITUDINAL)
        return sqrt(2.0 / bar->mass) * (bar->supports[0] ? sin(phase) : cos(phase)) * n[0];
    return modal_participation(bar, making->families[one->family], one->number, &load);
}

static unsigned add_node(struct making *making, double x, double y, double z, bool end)
{
    static const double axes[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    struct mesh_body *body = making->body;
    unsigned node = (unsigned)body->node_count++;
    const double point[3] = {x, y, z};
    memcpy(body->points[node], point, sizeof point);
    for (size_t axis = 0; axis < 3; axis++)
        for (size_t k = 0; k < body->mode_count; k++)
            if (axis == making->ones[k].family || (axis > 0 && making->ones[k].family > 0))
                body->shapes[(3 * node + axis) * body->mode_count + k] =
                    (float)shape_of(making, &making->ones[k], point, axes[axis], end);
    return node;
}

/* Static compliance along a normal, less that of the first modes. */
static double flexibility_at(const struct making *making, const double point[3], const double n[3],
                             bool end)
{
    const struct body *bar = making->wanted->bar;
    double sum = end ? making->wanted->end_flexibility : beam_side_compliance(bar, point, n);
    for (size_t f = 0; f < bar->kind->family_count && f != BAR_TWIST; f++) {
        struct family_load load = load_at(bar, f, point, n, end);
        if (end == (f == BAR_LONGITUDINAL) && n[f] != 0.0)
            sum += modal_compliance(bar, f, &load, &load);
    }
    for (size_t k = 0; k < making->wanted->removed; k++) {
        double shape = shape_of(making, &making->ones[k], point, n, end);
        sum -= shape * shape / (making->ones[k].omega * making->ones[k].omega);
    }
    return sum;
}

/* A face of nine nodes, given as a grid of three by three. */
static void add_face(struct making *making, const unsigned grid[3][3], unsigned patch)
{
    static const int PLACES[9][2] = {{0, 0}, {0, 2}, {2, 2}, {2, 0}, {0, 1},
                                     {1, 2}, {2, 1}, {1, 0}, {1, 1}};
    struct mesh_body *body = making->body;
    struct mesh_body_face *face = &body->faces[body->face_count++];
    *face = (struct mesh_body_face){.count = 9, .patch = patch};
    for (int i = 0; i < 9; i++) {
        unsigned node = grid[PLACES[i][0]][PLACES[i][1]];
        const double *p = body->points[node];
        double r = making->wanted->bar->radius;
        double n[3] = {patch == 1 ? -1.0 : patch == 2 ? 1.0 : 0.0, 0.0, 0.0};
        if (patch == 0) {
            n[1] = p[1] / r;
            n[2] = p[2] / r;
            face->curvature[i][1] = (float)((1.0 - n[1] * n[1]) / r);
            face->curvature[i][2] = (float)((1.0 - n[2] * n[2]) / r);
            face->curvature[i][4] = (float)(-n[1] * n[2] / r);
        }
        for (int k = 0; k < 3; k++)
            face->normal[i][k] = (float)n[k];
        face->nodes[i] = node;
        face->flexibility[i] = flexibility_at(making, p, n, patch != 0);
    }
}

/* Nodes at half steps: round the side, and along it. */
static void add_side(struct making *making)
{
    size_t around = 2 * making->wanted->around, along = 2 * making->wanted->along;
    double length = making->wanted->bar->length, r = making->wanted->bar->radius;
    unsigned first = (unsigned)making->body->node_count;
    for (size_t i = 0; i <= along; i++)
        for (size_t j = 0; j < around; j++) {
            double turn = 2.0 * M_PI * (double)j / (double)around;
            add_node(making, length * ((double)i / (double)along - 0.5), r * cos(turn),
                     r * sin(turn), false);
        }
    for (size_t i = 0; i < along; i += 2)
        for (size_t j = 0; j < around; j += 2) {
            unsigned grid[3][3];
            for (size_t a = 0; a < 3; a++)
                for (size_t b = 0; b < 3; b++) /* anticlockwise seen from outside */
                    grid[a][b] = first + (unsigned)((i + b) * around + (j + a) % around);
            /* x along b, turn along a: their normal x cross turn points inwards: swap */
            for (size_t a = 0; a < 3; a++)
                for (size_t b = 0; b < a; b++) {
                    unsigned swap = grid[a][b];
                    grid[a][b] = grid[b][a];
                    grid[b][a] = swap;
                }
            add_face(making, (const unsigned(*)[3])grid, 0);
        }
}

/* A square grid over the disc: (s, t) in [-1, 1]^2 on circles of max(|s|, |t|). */
static void add_end(struct making *making, unsigned patch)
{
    size_t cells = making->wanted->around / 4, nodes = 2 * cells + 1;
    double x = (patch == 1 ? -0.5 : 0.5) * making->wanted->bar->length;
    double r = making->wanted->bar->radius;
    unsigned first = (unsigned)making->body->node_count;
    for (size_t i = 0; i < nodes; i++)
        for (size_t j = 0; j < nodes; j++) {
            double s = 2.0 * (double)i / (double)(nodes - 1) - 1.0;
            double t = 2.0 * (double)j / (double)(nodes - 1) - 1.0;
            double size = fmax(fabs(s), fabs(t)), norm = hypot(s, t);
            double scale = norm > 0.0 ? r * size / norm : 0.0;
            add_node(making, x, scale * s, scale * t, true);
        }
    for (size_t i = 0; i + 2 < nodes; i += 2)
        for (size_t j = 0; j + 2 < nodes; j += 2) {
            unsigned grid[3][3];
            for (size_t a = 0; a < 3; a++)
                for (size_t b = 0; b < 3; b++) {
                    /* y cross z is x: turned round on the other end */
                    size_t p = patch == 2 ? b : a, q = patch == 2 ? a : b;
                    grid[a][b] = first + (unsigned)((i + p) * nodes + j + q);
                }
            add_face(making, (const unsigned(*)[3])grid, patch);
        }
}

static bool allocate(struct making *making)
{
    struct mesh_body *body = making->body;
    size_t around = making->wanted->around, along = making->wanted->along, cells = around / 4;
    size_t modes = 3 * making->wanted->modes;
    size_t nodes = 2 * around * (2 * along + 1) + 2 * (2 * cells + 1) * (2 * cells + 1);
    making->ones = calloc(modes, sizeof *making->ones);
    body->omega = calloc(modes, sizeof *body->omega);
    body->materials = calloc(1, sizeof *body->materials);
    body->points = calloc(nodes, sizeof *body->points);
    body->shapes = calloc(nodes * 3 * modes, sizeof *body->shapes);
    body->faces = calloc(around * along + 2 * cells * cells, sizeof *body->faces);
    return making->ones && body->omega && body->materials && body->points && body->shapes &&
           body->faces;
}

static void describe(const struct making *making)
{
    struct mesh_body *body = making->body;
    const struct body *bar = making->wanted->bar;
    snprintf(body->hash, sizeof body->hash, "%064zx", making->wanted->modes);
    snprintf(body->source, sizeof body->source, "made of the %s %s", bar->kind->name, bar->id);
    body->unit = 1.0;
    body->mass = bar->mass;
    body->volume = bar->mass / bar->material.density;
    for (int k = 0; k < 3; k++)
        body->inertia[4 * k] = bar->inertia[k];
    body->supported = bar->supports[0] != SUPPORT_FREE;
    body->element_size = bar->length / (double)making->wanted->along;
    body->material_count = 1;
    body->materials[0] = bar->material;
    body->removed = making->wanted->removed;
}

struct mesh_body *made_mesh_bar(const struct made_mesh *wanted)
{
    struct making making = {.wanted = wanted, .body = calloc(1, sizeof *making.body)};
    bool good = making.body && allocate(&making);
    if (good) {
        describe(&making);
        list_modes(&making);
        add_side(&making);
        add_end(&making, 1);
        add_end(&making, 2);
    }
    free(making.ones);
    for (size_t f = 0; f < BODY_MOST_FAMILIES; f++)
        modal_family_free(making.families[f]);
    if (good)
        return making.body;
    mesh_body_free(making.body);
    return NULL;
}
