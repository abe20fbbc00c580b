/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "physics/reduce/patch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/facet.h"
#include "model/vector.h"
#include "numeric/dense.h"

/* Of the radius: triangles that the pressure is integrated over, inside and where its rim cuts
 * them, whose root leaves 1e-5 of the force. */
static const double INNER = 0.1, RIM = 0.01;
/* a step leaves shift / (shift + first eigenvalue) of the error */
static const double SMALLEST_STEP = 1e-10;
enum { MOST_STEPS = 100 };

/* ---- the load ---- */

struct press {
    const struct flexibility_place *place;
    const struct surface_face *face;
    double nodes[FACE_MOST_NODES][3];
    double radius;
    double *force; /* [n], N */
    double load;   /* N */
};

/* Hertz's for 1 N */
static double pressure(const struct press *press, const double x[3])
{
    double r[3];
    sub3(x, press->place->load.point, r);
    double inside = 1.0 - dot3(r, r) / (press->radius * press->radius);
    return inside > 0.0 ? 1.5 * sqrt(inside) / (M_PI * press->radius * press->radius) : 0.0;
}

static void load_triangle(struct press *press, const struct surface_triangle *triangle)
{
    double at[SURFACE_RULE_POINTS][2], weights[SURFACE_RULE_POINTS];
    int count = press->face->count;
    surface_rule_place(triangle, at, weights);
    for (int p = 0; p < SURFACE_RULE_POINTS; p++) {
        double x[3], area[3], shape[FACE_MOST_NODES];
        facet_place(count, (const double(*)[3])press->nodes, at[p][0], at[p][1], x, area);
        facet_shape(count, at[p][0], at[p][1], shape, NULL, NULL);
        double part = weights[p] * norm3(area) * pressure(press, x);
        press->load += part;
        for (int i = 0; i < count; i++)
            add_scaled3(part * shape[i], press->place->load.inward,
                        press->force + 3 * press->face->nodes[i]);
    }
}

/* Smaller triangles about the rim, none beyond it. */
static void load_triangles(struct press *press, const struct surface_triangle *triangle)
{
    double corners[3][3], centre[3], offset[3];
    for (int i = 0; i < 3; i++)
        facet_place(press->face->count, (const double(*)[3])press->nodes, triangle->corners[i][0],
                    triangle->corners[i][1], corners[i], NULL);
    double size = surface_rule_sphere(3, corners, centre);
    sub3(centre, press->place->load.point, offset);
    double off_rim = norm3(offset) - press->radius;
    if (off_rim > size)
        return;
    if (size <= (off_rim > -size ? RIM : INNER) * press->radius) {
        load_triangle(press, triangle);
        return;
    }
    struct surface_triangle parts[4];
    surface_rule_split(triangle, parts);
    for (int i = 0; i < 4; i++)
        load_triangles(press, &parts[i]);
}

static double longest_edge(const struct press *press)
{
    double longest = 0.0;
    int corners = press->face->count == FACE_TRIANGLE6 ? 3 : 4;
    for (int i = 0; i < corners; i++) {
        double edge[3];
        sub3(press->nodes[(i + 1) % corners], press->nodes[i], edge);
        longest = fmax(longest, norm3(edge));
    }
    return longest;
}

/* nodal forces of 1 N; the mean of the longest edges under it */
static double load_all(const struct flexibility_body *body, struct press *press, size_t n)
{
    const struct surface *surface = body->surface;
    double sum = 0.0;
    for (size_t f = 0; f < surface->face_count; f++) {
        /* faces of the place's patch, each as its triangles */
        press->face = &surface->faces[f];
        if (press->face->patch != surface->faces[press->place->face].patch)
            continue;
        surface_face_points(body->mesh, press->face, press->nodes);
        struct surface_triangle triangles[2];
        size_t count = surface_rule_triangles(press->face->count, triangles);
        double before = press->load;
        for (size_t t = 0; t < count; t++)
            load_triangles(press, &triangles[t]);
        sum += (press->load - before) * longest_edge(press);
    }
    for (size_t i = 0; i < n; i++)
        press->force[i] /= press->load;
    return sum / press->load;
}

/* ---- the solution ---- */

static double dot(size_t n, const double *a, const double *b)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

/* y without rigid motion: y -= R R^T M y, or of forces y -= M R R^T y */
static void take_off(const double *take, const double *measure, size_t count, size_t n, double *y)
{
    double products[6];
    dense_products((struct dense){n, count, measure}, (struct dense){n, 1, y}, products);
    dense_combine((struct dense){n, count, take}, -1.0, products, 1.0, 1, y);
}

/* Work of the force on what it does, accelerations of the body as a whole balancing it: (K + s M) x
 * = f + s M x again and again. `spare` [3][n]. */
static enum percuss_status solve(const struct flexibility_body *body, const double *mass_rigid,
                                 const double *force, double *spare, double *work,
                                 struct fault *fault)
{
    /* the force in balance, and nothing moved yet */
    size_t n = body->matrices->stiffness.n, count = body->rigid_count;
    double *balanced = spare, *x = spare + n, *mass_x = spare + 2 * n;
    memcpy(balanced, force, n * sizeof *force);
    take_off(mass_rigid, body->rigid, count, n, balanced);
    memset(mass_x, 0, n * sizeof *mass_x);
    *work = 0.0;
    /* until the work stands */
    for (int step = 0; step < MOST_STEPS; step++) {
        double before = *work;
        for (size_t i = 0; i < n; i++)
            x[i] = balanced[i] + body->shift * mass_x[i];
        enum percuss_status status = factor_solve(body->factor, 1, x, fault);
        if (status != PERCUSS_OK)
            return status;
        take_off(body->rigid, mass_rigid, count, n, x);
        sparse_multiply(&body->matrices->mass, 1, x, mass_x);
        *work = dot(n, force, x);
        if (fabs(*work - before) <= SMALLEST_STEP * fabs(*work))
            return PERCUSS_OK;
    }
    return fault_set(fault, PERCUSS_INTERNAL, "patch: no convergence in %d steps", MOST_STEPS);
}

enum percuss_status patch_press(const struct flexibility_body *body,
                                const struct flexibility_place *place, double radius,
                                struct patch_answer *answer, struct fault *fault)
{
    size_t n = body->matrices->stiffness.n;
    double *mass_rigid = malloc((body->rigid_count + 1) * n * sizeof *mass_rigid);
    double *force = calloc(4 * n, sizeof *force), work;
    enum percuss_status status = PERCUSS_INTERNAL;
    if (!mass_rigid || !force) {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        goto done;
    }
    struct press press = {.place = place, .radius = radius, .force = force};
    answer->element = load_all(body, &press, n);
    answer->load = press.load;
    /* what the body does, less the half-space */
    sparse_multiply(&body->matrices->mass, body->rigid_count, body->rigid, mass_rigid);
    status = solve(body, mass_rigid, force, force + n, &work, fault);
    double poisson = place->load.poisson;
    answer->flexibility = work - 0.6 * (1.0 - poisson * poisson) / (place->load.young * radius);

done:
    free(mass_rigid);
    free(force);
    return status;
}

/* ---- by point forces ---- */

enum { RINGS = 2, ANGLES = 6, POINTS = RINGS * ANGLES };

/* Points on two rings: Gauss's nodes t = (r / rho)^2 with the weight 3/2 sqrt(1 - t) are the roots
 * of t^2 - 8/9 t + 8/63. */
static void spread(const struct flexibility_body *body, struct flexibility *flexibility,
                   const struct flexibility_place *place, double radius,
                   struct flexibility_place places[POINTS], double weights[POINTS])
{
    /* two directions across the normal */
    const double *inward = place->load.inward;
    int axis = fabs(inward[0]) < 0.6 ? 0 : 1;
    double along[3] = {axis == 0, axis == 1, 0.0}, across[3];
    add_scaled3(-inward[axis], inward, along);
    scale3(1.0 / norm3(along), along, along);
    cross3(inward, along, across);
    /* the points, the second ring turned by half a step */
    double root = sqrt(16.0 / 81.0 - 8.0 / 63.0);
    for (int p = 0; p < POINTS; p++) {
        int ring = p / ANGLES;
        double t = 4.0 / 9.0 + (ring ? root : -root), other = 8.0 / 9.0 - t;
        double angle = 2.0 * M_PI / ANGLES * (p % ANGLES + 0.5 * ring + 0.2);
        double x[3] = {0.0};
        weights[p] = (0.4 - other) / (t - other) / ANGLES;
        add_scaled3(1.0, place->load.point, x);
        add_scaled3(radius * sqrt(t) * cos(angle), along, x);
        add_scaled3(radius * sqrt(t) * sin(angle), across, x);
        struct surface_place at = surface_near(body->mesh, body->surface, x);
        places[p] =
            flexibility_place_make(flexibility_rule(flexibility), flexibility_edges(flexibility),
                                   at.face, at.foot.u, at.foot.v);
    }
}

enum percuss_status patch_of_points(const struct flexibility_body *body,
                                    struct flexibility *flexibility,
                                    const struct flexibility_place *place, double radius,
                                    double *mean, struct fault *fault)
{
    struct flexibility_place places[POINTS];
    struct flexibility_answer answers[POINTS];
    double weights[POINTS], poisson = place->load.poisson;
    double far = (1.0 - poisson * poisson) / (M_PI * place->load.young);
    spread(body, flexibility, place, radius, places, weights);
    enum percuss_status status = flexibility_solve(flexibility, POINTS, places, answers, fault);
    if (status != PERCUSS_OK)
        return status;
    /* over pairs: what one force does at the other's place beyond the half-space */
    *mean = 0.0;
    for (size_t i = 0; i < POINTS; i++)
        for (size_t j = 0; j < POINTS; j++) {
            double r[3], value = answers[i].value;
            if (i != j) {
                sub3(places[i].load.point, places[j].load.point, r);
                value = flexibility_response(flexibility, i, &places[j]) - far / norm3(r);
            }
            *mean += weights[i] * weights[j] * value;
        }
    return PERCUSS_OK;
}
