/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/shape.h"

#include <math.h>

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
