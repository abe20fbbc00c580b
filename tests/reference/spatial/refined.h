/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The mesh of one body: a shape of blocks of bricks, halved in all three directions again and again
 * near the contact. */
#ifndef PERCUSS_SPATIAL_REFINED_H
#define PERCUSS_SPATIAL_REFINED_H

#include "base/fault.h"
#include "mesh/element.h"

/* Quarters of bodies as blocks of bricks, by a map from unit cubes: the contact is at the origin on
 * the body's surface, n = +z points out of the beam and into the sphere, x = 0 and y = 0 are planes
 * of symmetry. */
enum { SHAPE_BLOCKS = 5 };

struct shape {
    size_t blocks;
    size_t count[SHAPE_BLOCKS][3]; /* bricks along each block's sides */
    /* place in space (m) of a place in a block, 0 ... 1; block 0 holds the contact in its corner
     * (0, 0, 1), and its third side leads out through the surface */
    void (*map)(const struct shape *shape, size_t block, const double at[3], double place[3]);
    double brick[3];       /* m, sides of the brick at the contact */
    double core[3];        /* m, how far from the contact bricks are to be finest */
    double edge;           /* m: nodes as far along any axis are held; 0: none */
    double length, radius; /* m; length: of a beam */
    double half[2];        /* m, of block 0's outer face along x, y */
    double inner[3];       /* m, corner of the block in the middle */
};

/* A round beam along x hit in its middle; `bricks` along half its length, `across` on block 0's
 * width. */
struct shape shape_beam(double radius, double length, size_t bricks, size_t across);

/* A sphere with bricks of these sides along x and y at the contact, the first two counts of them on
 * block 0's: each together less than two thirds of the radius. The third is that of the layers
 * around the block in the middle. */
struct shape shape_sphere(double radius, const double brick[2], const size_t count[3]);

/* A cube below a half-space's surface, held where it ends but for that and the planes of symmetry.
 */
struct shape shape_ground(double side);

/* The bricks of a shape, halved near the contact. Where halves meet a brick that is whole, their
 * nodes hang on its face: their displacement is the one that its own nodes give there, so that the
 * field stays continuous. */
enum { BRICK_NODES = 27 };

struct refined_brick {
    unsigned level; /* how often halved */
    size_t block;
    size_t nodes[BRICK_NODES];
};

/* Owns its arrays. */
struct refined {
    size_t brick_count, node_count;
    struct refined_brick *bricks;
    double (*points)[3]; /* [node_count], m */
    /* node n hangs on masters[first[n]] ... masters[first[n + 1] - 1], which do not hang; none: it
     * is free */
    size_t *first, *masters;
    double *weights;
    double edge;     /* m: nodes as far along any axis are held; 0: none */
    size_t touching; /* nodes of the face that holds the contact, as far as halved most */
    size_t *surface;
};

/* Halves a shape's bricks up to `levels` times around its core. OK, or INTERNAL: no memory. */
enum percuss_status refined_create(const struct shape *shape, unsigned levels, struct refined *mesh,
                                   struct fault *fault);
void refined_free(struct refined *mesh);

#endif
