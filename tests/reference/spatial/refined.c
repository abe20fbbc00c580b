/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/refined.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "spatial/places.h"

/* Sides of the beam's square in the middle and of the face above it over the radius: bricks of
 * about equal size, with angles between 45 and 135 degrees. */
static const double BEAM_INNER = 0.45, BEAM_FACE = M_SQRT1_2;
/* Half the height of the sphere's block in the middle over the radius. */
static const double SPHERE_INNER = 0.55;
/* The same along x and y over its upper face's half sides. */
static const double SPHERE_NARROWER = 0.9;

/* the blocks of a section: 0 above the square in the middle, 1 the square, 2 at its side, 3 below
 */
enum { ABOVE, MIDDLE, BESIDE, BELOW, BESIDE_Y };

static void between(const double a[3], const double b[3], double share, double place[3])
{
    for (int c = 0; c < 3; c++)
        place[c] = (1.0 - share) * a[c] + share * b[c];
}

static void beam_map(const struct shape *shape, size_t block, const double at[3], double place[3])
{
    double r = shape->radius, s = shape->inner[1], x = 0.5 * shape->length * at[0];
    double angle = asin(BEAM_FACE);
    /* on the square and on the circle, from the axis */
    double on_square[3] = {x, s * at[1], s}, on_circle[3] = {x, 0.0, 0.0};
    double share = at[2];
    switch (block) {
    case ABOVE:
    case BELOW:
        on_circle[1] = shape->half[1] * at[1];
        on_circle[2] = sqrt(r * r - on_circle[1] * on_circle[1]);
        if (block == BELOW) {
            on_square[2] = -on_square[2];
            on_circle[2] = -on_circle[2];
            share = 1.0 - at[2];
        }
        break;
    case MIDDLE:
        on_square[2] = (2.0 * at[2] - 1.0) * s;
        share = 0.0;
        break;
    default: { /* the second side leads out, the third upwards */
        double up = 2.0 * at[2] - 1.0;
        double elevation = up * (0.5 * M_PI - angle);
        on_square[1] = s;
        on_square[2] = up * s;
        on_circle[1] = r * cos(elevation);
        on_circle[2] = r * sin(elevation);
        share = at[1];
    }
    }
    between(on_square, on_circle, share, place);
    place[2] -= r;
}

struct shape shape_beam(double radius, double length, size_t bricks, size_t across)
{
    double s = BEAM_INNER * radius;
    return (struct shape){
        .blocks = 4,
        .count = {{bricks, across, across},
                  {bricks, across, 2 * across},
                  {bricks, across, 2 * across},
                  {bricks, across, across}},
        .map = beam_map,
        .brick = {0.5 * length / (double)bricks, BEAM_FACE * radius / (double)across,
                  (radius - s) / (double)across},
        .length = length,
        .radius = radius,
        .half = {0.5 * length, BEAM_FACE * radius},
        .inner = {0.0, s, s},
    };
}

/* a place on the sphere by longitude from x and latitude from the equator */
static void on_sphere(double radius, double longitude, double latitude, double place[3])
{
    place[0] = radius * cos(latitude) * cos(longitude);
    place[1] = radius * cos(latitude) * sin(longitude);
    place[2] = radius * sin(latitude);
}

/* z up from the centre, the contact at the top: turned over at the end */
static void sphere_map(const struct shape *shape, size_t block, const double at[3], double place[3])
{
    double r = shape->radius, share = at[2];
    const double *half = shape->half, *s = shape->inner;
    double up = 2.0 * at[2] - 1.0;
    /* between the inner block and the sphere */
    double inside[3] = {s[0] * at[0], s[1] * at[1], s[2]}, outside[3] = {0.0};
    switch (block) {
    /* above and below it, one the other's mirror */
    case ABOVE:
    case BELOW:
        outside[0] = half[0] * at[0];
        outside[1] = half[1] * at[1];
        outside[2] = sqrt(r * r - outside[0] * outside[0] - outside[1] * outside[1]);
        if (block == BELOW) {
            inside[2] = -inside[2];
            outside[2] = -outside[2];
            share = 1.0 - at[2];
        }
        break;
    /* the inner block itself */
    case MIDDLE:
        inside[2] = up * s[2];
        share = 0.0;
        break;
    default: { /* beyond x = half[0] or y = half[1]; that side leads out, the third upwards */
        bool along_x = block == BESIDE;
        double x = along_x ? half[0] : half[0] * at[0], y = along_x ? half[1] * at[1] : half[1];
        double latitude = asin(sqrt(r * r - x * x - y * y) / r);
        on_sphere(r, atan2(y, x), up * latitude, outside);
        inside[along_x ? 0 : 1] = s[along_x ? 0 : 1];
        inside[2] = up * s[2];
        share = at[along_x ? 0 : 1];
    }
    }
    /* turned over: the contact is the origin */
    between(inside, outside, share, place);
    place[2] = r - place[2];
}

struct shape shape_sphere(double radius, const double brick[2], const size_t count[3])
{
    double half[2] = {(double)count[0] * brick[0], (double)count[1] * brick[1]};
    size_t out = count[2], up = 2 * count[2];
    return (struct shape){
        .blocks = 5,
        .count = {{count[0], count[1], out},
                  {count[0], count[1], up},
                  {out, count[1], up},
                  {count[0], count[1], out},
                  {count[0], out, up}},
        .map = sphere_map,
        .brick = {brick[0], brick[1], radius * (1.0 - SPHERE_INNER) / (double)out},
        .radius = radius,
        .half = {half[0], half[1]},
        .inner = {SPHERE_NARROWER * half[0], SPHERE_NARROWER * half[1], SPHERE_INNER * radius},
    };
}

static void ground_map(const struct shape *shape, size_t block, const double at[3], double place[3])
{
    (void)block;
    place[0] = shape->edge * at[0];
    place[1] = shape->edge * at[1];
    place[2] = shape->edge * (at[2] - 1.0);
}

struct shape shape_ground(double side)
{
    return (struct shape){
        .blocks = 1,
        .count = {{2, 2, 2}},
        .map = ground_map,
        .brick = {0.5 * side, 0.5 * side, 0.5 * side},
        .edge = side,
    };
}

/* Nodes that hang on the faces of larger bricks, and the free nodes that these depend on. */

struct hanging {
    size_t nodes;
    struct hanging_on {
        unsigned char count; /* 0: free */
        unsigned char level; /* of the brick that it hangs on */
        size_t masters[BRICK_NODES];
        double weights[BRICK_NODES];
    } * on; /* [nodes] */
};

/* Points of a brick's surface where halves of its neighbours have nodes that it has not. */
enum { HANGING_POINTS = 72 };

/* Weights below this are nodes that the place does not depend on. */
static const double NO_WEIGHT = 1e-14;

/* A place of the surface's 5 x 5 x 5 lattice, in quarters, that is not a node of the brick. */
static bool is_hanging_place(const int quarter[3])
{
    bool outside = false, between = false;
    for (int c = 0; c < 3; c++) {
        outside |= quarter[c] == 0 || quarter[c] == 4;
        between |= quarter[c] % 2 == 1;
    }
    return outside && between;
}

/* The p-th of them in shares 0 ... 1 of the brick. */
static void hanging_point(int p, double at[3])
{
    int found = 0;
    for (int i = 0; i < 125; i++) {
        int quarter[3] = {i % 5, i / 5 % 5, i / 25};
        if (is_hanging_place(quarter) && found++ == p) {
            for (int c = 0; c < 3; c++)
                at[c] = 0.25 * quarter[c];
            return;
        }
    }
}

/* False: no memory. */
static bool hanging_create(size_t nodes, struct hanging *hanging)
{
    hanging->nodes = nodes;
    hanging->on = calloc(nodes, sizeof *hanging->on);
    return hanging->on != NULL;
}

static void hanging_free(struct hanging *hanging)
{
    free(hanging->on);
}

/* A node that lies at `at` on the surface of a brick of that level; the coarsest brick counts. */
static void hanging_add(struct hanging *hanging, size_t node, unsigned level,
                        const size_t nodes[BRICK_NODES], const double at[3])
{
    struct hanging_on *on = &hanging->on[node];
    if (on->count && on->level <= level)
        return;
    double natural[3] = {2.0 * at[0] - 1.0, 2.0 * at[1] - 1.0, 2.0 * at[2] - 1.0};
    double shape[ELEMENT_MOST_NODES], gradient[ELEMENT_MOST_NODES][3];
    element_shapes(ELEMENT_HEX27, natural, shape, gradient);
    on->count = 0;
    on->level = (unsigned char)level;
    for (int n = 0; n < BRICK_NODES; n++) {
        if (fabs(shape[n]) > NO_WEIGHT) {
            on->masters[on->count] = nodes[n];
            on->weights[on->count++] = shape[n];
        }
    }
}

/* free nodes that a node hangs on (itself if it is free), times `share` */
struct gathering {
    const struct hanging *hanging;
    size_t count, room, *masters;
    double *weights;
    bool lacks; /* out of memory, or a node hangs on one of the same or a finer level */
};

static void gather_one(struct gathering *gathering, size_t from, size_t node, double share)
{
    /* a master that is there takes more */
    for (size_t i = from; i < gathering->count; i++)
        if (gathering->masters[i] == node) {
            gathering->weights[i] += share;
            return;
        }
    /* room for another; the lists stay valid if there is none */
    if (gathering->count == gathering->room) {
        size_t room = gathering->room ? 2 * gathering->room : 1024;
        size_t *masters = realloc(gathering->masters, room * sizeof *masters);
        if (masters)
            gathering->masters = masters;
        double *weights = realloc(gathering->weights, room * sizeof *weights);
        if (weights)
            gathering->weights = weights;
        gathering->lacks |= !masters || !weights;
        if (gathering->lacks)
            return;
        gathering->room = room;
    }
    gathering->masters[gathering->count] = node;
    gathering->weights[gathering->count++] = share;
}

/* a brick's own node hangs on coarser bricks only: the recursion ends with the levels */
static void gather(struct gathering *gathering, size_t from, size_t node, double share)
{
    const struct hanging_on *on = &gathering->hanging->on[node];
    if (on->count == 0)
        gather_one(gathering, from, node, share);
    for (int i = 0; i < on->count; i++) {
        const struct hanging_on *master = &gathering->hanging->on[on->masters[i]];
        gathering->lacks |= master->count && master->level >= on->level;
        if (!gathering->lacks)
            gather(gathering, from, on->masters[i], share * on->weights[i]);
    }
}

/* Lists for each node the free ones that it hangs on: first[nodes + 1] and its targets, for the
 * caller to free. False: no memory. */
static bool hanging_resolve(const struct hanging *hanging, size_t **first, size_t **masters,
                            double **weights)
{
    struct gathering gathering = {.hanging = hanging};
    *first = calloc(hanging->nodes + 1, sizeof **first);
    if (!*first)
        return false;
    for (size_t n = 0; n < hanging->nodes; n++) {
        size_t from = gathering.count;
        if (hanging->on[n].count)
            gather(&gathering, from, n, 1.0);
        (*first)[n + 1] = gathering.count;
    }
    *masters = gathering.masters;
    *weights = gathering.weights;
    return !gathering.lacks;
}

/* Nodes of one mesh are farther apart than this: m. */
static const double SAME_NODE = 1e-9;
/* Bricks within so much of their own size from the core are halved: two layers of each size are
 * left around it, which keeps neighbours within one level; just below two, where curved bricks'
 * distances are not whole numbers. */
static const double REACH = 1.9;

/* Bricks while they are halved: where they lie in their blocks, in steps of their level. */
struct cutting {
    const struct shape *shape;
    unsigned levels;
    size_t count, room;
    struct cut {
        unsigned level;
        size_t block, at[3];
    } * cuts;
};

static void place_in(const struct shape *shape, const struct cut *cut, const double at[3],
                     double place[3])
{
    /* shares 0 ... 1 of the brick into shares of the block */
    double in_block[3];
    for (int c = 0; c < 3; c++)
        in_block[c] =
            ((double)cut->at[c] + at[c]) / (double)(shape->count[cut->block][c] << cut->level);
    shape->map(shape, cut->block, in_block, place);
}

/* where a brick's own node lies in it, 0 ... 1 */
static void node_share(int node, double at[3])
{
    element_node(ELEMENT_HEX27, (size_t)node, at);
    for (int c = 0; c < 3; c++)
        at[c] = 0.5 * (1.0 + at[c]);
}

/* how far a brick is from the core: its nearest node, in bricks of its own size */
static double distance(const struct shape *shape, const struct cut *cut)
{
    double nearest = INFINITY;
    for (int n = 0; n < BRICK_NODES; n++) {
        double at[3], place[3], farthest = 0.0;
        node_share(n, at);
        place_in(shape, cut, at, place);
        for (int c = 0; c < 3; c++)
            farthest = fmax(farthest, (fabs(place[c]) - shape->core[c]) / shape->brick[c]);
        nearest = fmin(nearest, farthest);
    }
    return nearest * (double)(1u << cut->level);
}

static bool keep(struct cutting *cutting, const struct cut *cut)
{
    if (cutting->count == cutting->room) {
        size_t room = cutting->room ? 2 * cutting->room : 1024;
        struct cut *cuts = realloc(cutting->cuts, room * sizeof *cuts);
        if (!cuts)
            return false;
        cutting->cuts = cuts;
        cutting->room = room;
    }
    cutting->cuts[cutting->count++] = *cut;
    return true;
}

/* keeps a brick, or its eighths */
static bool halve(struct cutting *cutting, const struct cut *cut)
{
    if (cut->level == cutting->levels || distance(cutting->shape, cut) > REACH)
        return keep(cutting, cut);
    for (size_t part = 0; part < 8; part++) {
        struct cut eighth = {.level = cut->level + 1, .block = cut->block};
        for (int c = 0; c < 3; c++)
            eighth.at[c] = 2 * cut->at[c] + (part >> c & 1);
        if (!halve(cutting, &eighth))
            return false;
    }
    return true;
}

static bool cut_all(struct cutting *cutting)
{
    const struct shape *shape = cutting->shape;
    for (size_t block = 0; block < shape->blocks; block++) {
        const size_t *count = shape->count[block];
        for (size_t i = 0; i < count[0] * count[1] * count[2]; i++) {
            struct cut cut = {
                .block = block,
                .at = {i % count[0], i / count[0] % count[1], i / count[0] / count[1]}};
            if (!halve(cutting, &cut))
                return false;
        }
    }
    return true;
}

/* numbers the nodes of all bricks */
static bool number_nodes(const struct cutting *cutting, struct places *places, struct refined *mesh)
{
    for (size_t b = 0; b < cutting->count; b++) {
        const struct cut *cut = &cutting->cuts[b];
        mesh->bricks[b].level = cut->level;
        mesh->bricks[b].block = cut->block;
        for (int n = 0; n < BRICK_NODES; n++) {
            double at[3], place[3];
            node_share(n, at);
            place_in(cutting->shape, cut, at, place);
            size_t node = places_add(places, place);
            if (node == SIZE_MAX)
                return false;
            mesh->bricks[b].nodes[n] = node;
        }
    }
    return true;
}

/* lists the nodes that may touch: on block 0's outer face, of the bricks halved most */
static bool list_surface(const struct cutting *cutting, struct refined *mesh)
{
    bool *listed = calloc(mesh->node_count, sizeof *listed);
    mesh->surface = malloc(mesh->node_count * sizeof *mesh->surface);
    if (!listed || !mesh->surface) {
        free(listed);
        return false;
    }
    /* bricks of the finest level on the outer face */
    for (size_t b = 0; b < cutting->count; b++) {
        const struct cut *cut = &cutting->cuts[b];
        bool outside = cut->at[2] + 1 == cutting->shape->count[0][2] << cut->level;
        if (cut->block != 0 || cut->level != cutting->levels || !outside)
            continue;
        /* their nodes on that face, once each */
        for (int n = 0; n < BRICK_NODES; n++) {
            double at[3];
            size_t node = mesh->bricks[b].nodes[n];
            node_share(n, at);
            if (at[2] < 1.0 || listed[node])
                continue;
            mesh->surface[mesh->touching++] = node;
            listed[node] = true;
        }
    }
    free(listed);
    return true;
}

/* the points of a brick's faces where nodes of its neighbours' halves lie */
static bool hang_nodes(const struct cutting *cutting, const struct places *places,
                       struct refined *mesh)
{
    struct hanging hanging;
    if (!hanging_create(mesh->node_count, &hanging))
        return false;
    for (size_t b = 0; b < cutting->count; b++)
        for (int p = 0; p < HANGING_POINTS; p++) {
            double at[3], place[3];
            hanging_point(p, at);
            place_in(cutting->shape, &cutting->cuts[b], at, place);
            size_t node = places_find(places, place);
            if (node != SIZE_MAX)
                hanging_add(&hanging, node, cutting->cuts[b].level, mesh->bricks[b].nodes, at);
        }
    bool made = hanging_resolve(&hanging, &mesh->first, &mesh->masters, &mesh->weights);
    hanging_free(&hanging);
    return made;
}

enum percuss_status refined_create(const struct shape *shape, unsigned levels, struct refined *mesh,
                                   struct fault *fault)
{
    *mesh = (struct refined){.edge = shape->edge};
    struct cutting cutting = {.shape = shape, .levels = levels};
    struct places places = {.same = SAME_NODE};
    bool made = cut_all(&cutting);
    /* bricks and their nodes */
    if (made) {
        mesh->brick_count = cutting.count;
        mesh->bricks = calloc(cutting.count, sizeof *mesh->bricks);
        made = mesh->bricks && number_nodes(&cutting, &places, mesh);
    }
    /* nodes that hang, nodes that may touch */
    if (made) {
        mesh->node_count = places.count;
        made = hang_nodes(&cutting, &places, mesh) && list_surface(&cutting, mesh);
    }
    /* the points are the mesh's now */
    mesh->points = places.points;
    places.points = NULL;
    places_free(&places);
    free(cutting.cuts);
    if (made)
        return PERCUSS_OK;
    refined_free(mesh);
    return fault_set(fault, PERCUSS_INTERNAL,
                     "a mesh of %zu bricks: out of memory, or neighbours differ by more than one "
                     "level of halving",
                     cutting.count);
}

void refined_free(struct refined *mesh)
{
    free(mesh->bricks);
    free(mesh->points);
    free(mesh->first);
    free(mesh->masters);
    free(mesh->weights);
    free(mesh->surface);
    memset(mesh, 0, sizeof *mesh);
}
