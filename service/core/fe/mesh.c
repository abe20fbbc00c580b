/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/mesh.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { MESH_RINGS_MAX = 20000 };

/* Positions of the rings and heights of the rows. */

static double arc_of(double radius, double sphere)
{
    return isinf(sphere) ? radius : sphere * asin(radius / sphere);
}

/* q + q^2 + ... + q^n */
static double geometric(double q, size_t n)
{
    return fabs(q - 1.0) < 1e-9 ? (double)n : q * (pow(q, (double)n) - 1.0) / (q - 1.0);
}

/* ratio that lets n steps, the first of width * ratio, fill the rest: bisection of a monotone sum
 */
static double fitting_ratio(double rest, double width, size_t n)
{
    double low = 0.0;
    double high = 1.0 + rest / width;
    for (int i = 0; i < 200 && high - low > 1e-15 * high; i++) {
        double q = 0.5 * (low + high);
        if (width * geometric(q, n) < rest)
            low = q;
        else
            high = q;
    }
    return 0.5 * (low + high);
}

/* number of steps with the fitting ratio nearest to the wanted one */
static size_t fitting_count(double rest, double width, double growth)
{
    size_t n = 1;
    while (n < MESH_RINGS_MAX && width * geometric(growth, n) < rest)
        n++;
    if (n > 1 && rest - width * geometric(growth, n - 1) < width * geometric(growth, n) - rest)
        n--;
    return n;
}

/* Positions of the rings along a surface that ends at `end`, from the core's rim (position 0 of the
 * list) to the end; the arc that belongs to a radius is radius (flat) or sphere * asin(radius /
 * sphere); `sphere` is INFINITY on a flat. Exact geometric steps in radius as far as
 * grade->matched, then a ratio that fits. Returns their number less one (the rings), 0 where the
 * grade does not fit. The caller frees *positions. */
static size_t mesh_rings(const struct mesh_grade *grade, double sphere, double end,
                         double **positions)
{
    double *list = malloc((MESH_RINGS_MAX + 1) * sizeof *list);
    *positions = list;
    if (!list)
        return 0;
    /* exact geometric steps, alike in all bodies of the grade */
    double radius = (double)grade->core * grade->size;
    double width = grade->size;
    size_t rings = 0;
    list[0] = arc_of(radius, sphere);
    while (radius < grade->matched && rings < MESH_RINGS_MAX) {
        width *= grade->growth;
        radius += width;
        if (!(radius < (isinf(sphere) ? end : sphere)))
            return 0;
        list[++rings] = arc_of(radius, sphere);
    }
    /* the rest by a ratio that ends where the surface does */
    double reached = list[rings];
    double rest = end - reached;
    size_t more = fitting_count(rest, width, grade->growth);
    if (!(rest > 0.2 * width) || rings + more > MESH_RINGS_MAX)
        return 0;
    double ratio = fitting_ratio(rest, width, more);
    for (size_t i = 1; i <= more; i++)
        list[rings + i] = reached + width * geometric(ratio, i);
    list[rings + more] = end;
    return rings + more;
}

/* Heights of rows that fill `length`, from `first` growing to at most `coarse`. Returns their
 * number, 0 where there would be too many. The caller frees *heights. */
static size_t mesh_rows(double length, double first, const struct mesh_grade *grade,
                        double **heights)
{
    double *list = malloc(MESH_RINGS_MAX * sizeof *list);
    *heights = list;
    if (!list)
        return 0;
    /* each higher than the one before, up to the coarsest, until they reach the end */
    double coarse = fmax(grade->coarse, first);
    double sum = 0.0;
    size_t rows = 0;
    for (double height = first; sum < length * (1.0 - 1e-9); rows++) {
        if (rows == MESH_RINGS_MAX)
            return 0;
        height = fmin(height * grade->growth, coarse);
        list[rows] = height;
        sum += height;
    }
    /* all scaled alike, so that they end there */
    for (size_t i = 0; i < rows; i++)
        list[i] *= length / sum;
    return rows;
}

/* Nodes and elements. */

/* A mesh grows by chains of nodes from the axis to the surface, each joined to the one before:
 * shell k of a core has 2k + 1 nodes (k elements below, k beside it), a ring 2 core + 1. */
struct growing {
    struct mesh *mesh;
    const struct mesh_grade *grade;
    size_t last; /* first node of the chain before */
};

static bool list_make(struct mesh_nodes *list, size_t room)
{
    list->index = malloc(room * sizeof *list->index);
    return list->index != NULL;
}

static void list_add(struct mesh_nodes *list, size_t node)
{
    list->index[list->count++] = (uint32_t)node;
}

static void node_add(struct growing *growing, double r, double z)
{
    struct mesh *mesh = growing->mesh;
    mesh->r[mesh->nodes] = r;
    mesh->z[mesh->nodes] = z;
    if (r == 0.0)
        list_add(&mesh->axis, mesh->nodes);
    mesh->nodes++;
}

/* counter-clockwise for any order of growth */
static void quad_add(struct mesh *mesh, size_t a, size_t b, size_t c, size_t d)
{
    double area = (mesh->r[c] - mesh->r[a]) * (mesh->z[d] - mesh->z[b]) -
                  (mesh->r[d] - mesh->r[b]) * (mesh->z[c] - mesh->z[a]);
    uint32_t *quad = mesh->quads[mesh->elements++];
    quad[0] = (uint32_t)a;
    quad[1] = (uint32_t)(area > 0.0 ? b : d);
    quad[2] = (uint32_t)c;
    quad[3] = (uint32_t)(area > 0.0 ? d : b);
}

/* `count` elements between two chains of equal spacing */
static void join_strip(struct mesh *mesh, size_t inner, size_t outer, size_t count)
{
    for (size_t i = 0; i < count; i++)
        quad_add(mesh, inner + i, inner + i + 1, outer + i + 1, outer + i);
}

/* 2k - 1 elements between shells k - 1 and k of a core: below, in the corner, beside */
static void join_shell(struct mesh *mesh, size_t inner, size_t outer, size_t k)
{
    join_strip(mesh, inner, outer, k - 1);
    quad_add(mesh, inner + k - 1, outer + k - 1, outer + k, outer + k + 1);
    join_strip(mesh, inner + k - 1, outer + k + 1, k - 1);
}

/* node i of shell k in a core of unit elements: distance from the axis, depth */
static void shell_point(size_t k, size_t i, double *x, double *depth)
{
    *x = (double)(i < k ? i : k);
    *depth = (double)(i < k ? k : 2 * k - i);
}

/* depth of a sphere's surface below its pole; written without cancellation */
static double surface_drop(double r, double sphere)
{
    return isinf(sphere) ? 0.0 : r * r / (sphere + sqrt(sphere * sphere - r * r));
}

static void grow_core(struct growing *growing, double sphere)
{
    struct mesh *mesh = growing->mesh;
    double size = growing->grade->size;
    for (size_t k = 0; k <= growing->grade->core; k++) {
        size_t start = mesh->nodes;
        for (size_t i = 0; i <= 2 * k; i++) {
            double x, depth;
            shell_point(k, i, &x, &depth);
            node_add(growing, x * size, -depth * size - surface_drop(x * size, sphere));
        }
        list_add(&mesh->contact, mesh->nodes - 1);
        if (k > 0)
            join_shell(mesh, growing->last, start, k);
        growing->last = start;
    }
}

/* Shape of the outermost ring: point i of 2 core. */
struct outline {
    enum { OUTLINE_CIRCLE, OUTLINE_RECTANGLE, OUTLINE_EQUATOR } kind;
    double radius, depth;
    double angle; /* circle: from the axis to the surface */
};

static void outline_point(const struct outline *outline, size_t i, size_t core, double *r,
                          double *z)
{
    double part = (double)i / (2.0 * (double)core);
    switch (outline->kind) {
    case OUTLINE_CIRCLE:
        *r = outline->radius * sin(outline->angle * part);
        *z = -outline->radius * cos(outline->angle * part);
        break;
    case OUTLINE_RECTANGLE:
        *r = outline->radius * fmin(2.0 * part, 1.0);
        *z = -outline->depth * fmin(2.0 - 2.0 * part, 1.0);
        break;
    default:
        *r = outline->radius * part;
        *z = -outline->radius;
    }
}

/* point of the contact surface at a length along it */
static void surface_point(double sphere, double along, double *r, double *z)
{
    double half = isinf(sphere) ? 0.0 : sin(0.5 * along / sphere);
    *r = isinf(sphere) ? along : sphere * sin(along / sphere);
    *z = isinf(sphere) ? 0.0 : -2.0 * sphere * half * half;
}

/* Rings between the last chain and an outline, transfinite: straight lines, corrected where the
 * surface is an arc. positions: along the surface, rings + 1. */
static void grow_rings(struct growing *growing, double sphere, const struct outline *outline,
                       const double *positions, size_t rings)
{
    struct mesh *mesh = growing->mesh;
    size_t core = growing->grade->core;
    size_t first = growing->last;
    double span = positions[rings] - positions[0];
    for (size_t k = 1; k <= rings; k++) {
        size_t start = mesh->nodes;
        double eta = (positions[k] - positions[0]) / span;
        double rim_r, rim_z, bend_r, bend_z;
        /* how far the surface lies off the straight line there */
        outline_point(outline, 2 * core, core, &rim_r, &rim_z);
        surface_point(sphere, positions[k], &bend_r, &bend_z);
        bend_r -= (1.0 - eta) * mesh->r[first + 2 * core] + eta * rim_r;
        bend_z -= (1.0 - eta) * mesh->z[first + 2 * core] + eta * rim_z;
        /* nodes of the ring, all of the bend at its end, none at the axis */
        for (size_t i = 0; i <= 2 * core; i++) {
            double part = (double)i / (2.0 * (double)core);
            double r, z;
            outline_point(outline, i, core, &r, &z);
            node_add(growing, (1.0 - eta) * mesh->r[first + i] + eta * r + part * bend_r,
                     (1.0 - eta) * mesh->z[first + i] + eta * z + part * bend_z);
        }
        /* elements between it and the one inside */
        list_add(&mesh->contact, mesh->nodes - 1);
        join_strip(mesh, growing->last, start, 2 * core);
        growing->last = start;
    }
}

/* The lower half of a sphere: rings from the equator inward to a core around the opposite pole. */
static void grow_southern_half(struct growing *growing, double radius)
{
    struct mesh *mesh = growing->mesh;
    size_t core = growing->grade->core;
    double size = 0.4 * radius / (double)core;
    double rim = asin(0.4);
    for (size_t step = 1; step <= 2 * core; step++) {
        /* rings down to shell core of the southern core, then its shells */
        size_t k = step <= core ? core : 2 * core - step;
        /* as grow_rings does it, towards the core's rim */
        double eta = step < core ? (double)step / (double)core : 1.0;
        double angle = 0.5 * M_PI + eta * (rim - 0.5 * M_PI);
        double bend_r = radius * (sin(angle) - (1.0 + eta * (0.4 - 1.0)));
        double bend_z = radius * ((1.0 - cos(angle)) - (1.0 - eta) - eta * (1.0 - cos(rim)));
        size_t start = mesh->nodes;
        /* nodes of the ring or shell */
        for (size_t i = 0; i <= 2 * k; i++) {
            double part = (double)i / (2.0 * (double)core);
            double x, depth;
            shell_point(k, i, &x, &depth);
            x *= size;
            depth = depth * size + surface_drop(x, radius);
            if (step < core) {
                x = (1.0 - eta) * part * radius + eta * x + part * bend_r;
                depth = (1.0 - eta) * radius + eta * depth + part * bend_z;
            }
            node_add(growing, x, depth - 2.0 * radius);
        }
        /* elements between it and the one outside */
        if (step <= core)
            join_strip(mesh, growing->last, start, 2 * core);
        else
            join_shell(mesh, start, growing->last, k + 1);
        growing->last = start;
    }
    list_add(&mesh->far, mesh->nodes - 1);
}

/* The rest of a rod: rows as wide as the bottom of the last ring. */
static void grow_rows(struct growing *growing, const double *heights, size_t rows)
{
    struct mesh *mesh = growing->mesh;
    size_t core = growing->grade->core;
    for (size_t k = 0; k < rows; k++) {
        size_t start = mesh->nodes;
        for (size_t i = 0; i <= core; i++)
            node_add(growing, mesh->r[growing->last + i], mesh->z[growing->last + i] - heights[k]);
        join_strip(mesh, growing->last, start, core);
        growing->last = start;
    }
    for (size_t i = 0; i <= core; i++)
        list_add(&mesh->far, growing->last + i);
}

static bool mesh_make(struct mesh *mesh, size_t nodes, size_t elements)
{
    mesh->r = malloc(nodes * sizeof *mesh->r);
    mesh->z = malloc(nodes * sizeof *mesh->z);
    mesh->quads = malloc(elements * sizeof *mesh->quads);
    return mesh->r && mesh->z && mesh->quads && list_make(&mesh->axis, nodes) &&
           list_make(&mesh->contact, nodes) && list_make(&mesh->far, nodes);
}

static enum percuss_status check_grade(const struct mesh_grade *grade, double room,
                                       struct fault *fault)
{
    if (!(grade->size > 0.0 && isfinite(grade->size)))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "mesh size: %g: must be > 0", grade->size);
    if (grade->core < 2 || grade->core > 200)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "mesh core: %zu: must be 2 ... 200",
                         grade->core);
    if (!(grade->growth >= 1.0 && grade->growth <= 2.0))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "mesh growth: %g: must be 1 ... 2",
                         grade->growth);
    if (!((double)grade->core * grade->size <= 0.5 * room))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "mesh core of %zu elements of %g m: must not exceed half of %g m",
                         grade->core, grade->size, room);
    return PERCUSS_OK;
}

/* The reason for missing rings or rows: no memory where there is no list. */
static enum percuss_status misfit(struct fault *fault, const struct mesh_grade *grade, double end,
                                  const double *list)
{
    if (!list)
        return fault_set(fault, PERCUSS_INTERNAL, "mesh: no memory");
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "mesh size %g m, growth %g, matched %g m: do not fit into %g m with at most "
                     "%d rings",
                     grade->size, grade->growth, grade->matched, end, MESH_RINGS_MAX);
}

/* room for core, rings and (sphere) the southern half or (rod) the rows */
static enum percuss_status mesh_room(struct mesh *mesh, size_t core, size_t rings, size_t rows,
                                     bool mirrored, struct fault *fault)
{
    size_t nodes = (core + 1) * (core + 1) + rings * (2 * core + 1) + rows * (core + 1);
    size_t elements = core * core + rings * 2 * core + rows * core;
    if (mirrored) {
        nodes += core * (2 * core + 1) + core * core;
        elements += 3 * core * core;
    }
    if (nodes < 4000000 && mesh_make(mesh, nodes, elements))
        return PERCUSS_OK;
    mesh_free(mesh);
    return fault_set(fault, PERCUSS_INTERNAL, "mesh of %zu nodes: no memory", nodes);
}

enum percuss_status mesh_sphere(double radius, const struct mesh_grade *grade, struct mesh *mesh,
                                struct fault *fault)
{
    *mesh = (struct mesh){0};
    enum percuss_status status = check_grade(grade, radius, fault);
    if (status != PERCUSS_OK)
        return status;
    /* rings along the meridian to the equator */
    struct growing growing = {.mesh = mesh, .grade = grade};
    struct outline equator = {OUTLINE_EQUATOR, radius, radius, 0.0};
    double *positions;
    size_t rings = mesh_rings(grade, radius, 0.5 * M_PI * radius, &positions);
    status = rings ? mesh_room(mesh, grade->core, rings, 0, true, fault)
                   : misfit(fault, grade, radius, positions);
    if (status == PERCUSS_OK) {
        /* circles about the pole as far as half the radius, then towards the equator: straight to
         * the equator, the elements at the core's corner would be thin */
        size_t round = 1;
        while (round + 1 < rings && 2.0 * sin(0.5 * positions[round + 1] / radius) < 0.5)
            round++;
        double chord = 2.0 * radius * sin(0.5 * positions[round] / radius);
        struct outline circle = {OUTLINE_CIRCLE, chord, chord, acos(0.5 * chord / radius)};
        grow_core(&growing, radius);
        grow_rings(&growing, radius, &circle, positions, round);
        grow_rings(&growing, radius, &equator, positions + round, rings - round);
        grow_southern_half(&growing, radius);
    }
    /* on success and failure */
    free(positions);
    return status;
}

enum percuss_status mesh_cylinder(double radius, double length, const struct mesh_grade *grade,
                                  struct mesh *mesh, struct fault *fault)
{
    *mesh = (struct mesh){0};
    enum percuss_status status = check_grade(grade, fmin(radius, length), fault);
    if (status != PERCUSS_OK)
        return status;
    /* a rest shorter than half the end region would be a row of slivers */
    double region = length < 1.5 * radius ? length : radius;
    double rest = length - region;
    struct growing growing = {.mesh = mesh, .grade = grade};
    struct outline rectangle = {OUTLINE_RECTANGLE, radius, region, 0.0};
    /* rings of the end region, rows of the rest */
    double *positions;
    double *heights = NULL;
    size_t rows = 0;
    size_t rings = mesh_rings(grade, INFINITY, radius, &positions);
    if (rings && rest > 0.0) {
        double last = (positions[rings] - positions[rings - 1]) * region / radius;
        rows = mesh_rows(rest, last, grade, &heights);
    }
    /* all fits: grow */
    status = rings && (rows || !(rest > 0.0))
                 ? mesh_room(mesh, grade->core, rings, rows, false, fault)
                 : misfit(fault, grade, length, rings ? heights : positions);
    if (status == PERCUSS_OK) {
        grow_core(&growing, INFINITY);
        grow_rings(&growing, INFINITY, &rectangle, positions, rings);
        grow_rows(&growing, heights, rows);
    }
    free(positions);
    free(heights);
    return status;
}

enum percuss_status mesh_half_space(double extent, const struct mesh_grade *grade,
                                    struct mesh *mesh, struct fault *fault)
{
    *mesh = (struct mesh){0};
    enum percuss_status status = check_grade(grade, extent, fault);
    if (status != PERCUSS_OK)
        return status;
    /* rings along the surface, as far as the mesh reaches */
    struct growing growing = {.mesh = mesh, .grade = grade};
    struct outline circle = {OUTLINE_CIRCLE, extent, extent, 0.5 * M_PI};
    double *positions;
    size_t rings = mesh_rings(grade, INFINITY, extent, &positions);
    status = rings ? mesh_room(mesh, grade->core, rings, 0, false, fault)
                   : misfit(fault, grade, extent, positions);
    if (status == PERCUSS_OK) {
        /* grown as quarter circles, the last of which is far */
        grow_core(&growing, INFINITY);
        grow_rings(&growing, INFINITY, &circle, positions, rings);
        for (size_t i = 0; i <= 2 * grade->core; i++)
            list_add(&mesh->far, growing.last + i);
    }
    free(positions);
    return status;
}

void mesh_free(struct mesh *mesh)
{
    free(mesh->r);
    free(mesh->z);
    free(mesh->quads);
    free(mesh->axis.index);
    free(mesh->contact.index);
    free(mesh->far.index);
    *mesh = (struct mesh){0};
}
