/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/flexibility.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/facet.h"
#include "model/vector.h"
#include "numeric/dense.h"
#include "reduce/flexibility_surface.h"
#include "reduce/flexibility_volume.h"

/* Nodal forces out of balance by more than this part of the force mean a surface that is not
 * closed or not the mesh's own; quadrature leaves less than 1e-7. */
static const double MOST_IMBALANCE = 1e-6;
/* Iterations end when a step does this part of the work: what is wrong then is of its square. */
static const double SMALLEST_STEP = 1e-6;
/* a step leaves shift / (shift + next eigenvalue), at most half with a shift at the first one */
enum { MOST_STEPS = 60 };

struct flexibility {
    struct flexibility_body body;
    size_t n, psi_count; /* degrees of freedom; rigid and removed modes */
    double *psi;         /* [psi_count][n] */
    double *mass_psi;    /* [psi_count][n]: M psi */
    struct surface_rule surface;
    struct volume_rule volume;
    struct flexibility_edges edges;
    /* of the block that is solved: [FLEXIBILITY_BLOCK][n] */
    double *force, *x, *work, *mass_x, *rest; /* w = x + rest */
    double *products;                         /* [2][FLEXIBILITY_BLOCK][psi_count] */
    struct flexibility_place places[FLEXIBILITY_BLOCK];
};

/* of one place: all of C but f.x, and how far its forces are from balance */
struct flexibility_terms {
    double value, imbalance;
};

static double dot(size_t n, const double *a, const double *b)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

struct flexibility *flexibility_make(const struct flexibility_body *body)
{
    struct flexibility *f = calloc(1, sizeof *f);
    if (!f)
        return NULL;
    /* room for a block of columns */
    size_t n = f->n = 3 * body->mesh->node_count, block = FLEXIBILITY_BLOCK * n;
    f->body = *body;
    f->psi_count = body->rigid_count + body->removed;
    f->psi = malloc((f->psi_count * n + 1) * sizeof *f->psi);
    f->mass_psi = malloc((f->psi_count * n + 1) * sizeof *f->mass_psi);
    f->force = malloc(block * sizeof *f->force);
    f->x = malloc(block * sizeof *f->x);
    f->work = malloc(block * sizeof *f->work);
    f->mass_x = malloc(block * sizeof *f->mass_x);
    f->rest = malloc(block * sizeof *f->rest);
    f->products = malloc((2 * FLEXIBILITY_BLOCK * f->psi_count + 1) * sizeof *f->products);
    /* rules of integration over surface and volume */
    if (!f->psi || !f->mass_psi || !f->force || !f->x || !f->work || !f->mass_x || !f->rest ||
        !f->products || !surface_rule_make(&f->surface, body->mesh, body->surface) ||
        !volume_rule_make(&f->volume, body->mesh) ||
        !flexibility_edges_make(&f->edges, &f->surface)) {
        flexibility_free(f);
        return NULL;
    }
    /* Psi: rigid motions, then modes that are taken out; M Psi */
    size_t rigid = body->rigid_count * n;
    if (body->rigid_count > 0)
        memcpy(f->psi, body->rigid, rigid * sizeof *f->psi);
    if (body->removed > 0)
        memcpy(f->psi + rigid, body->shapes, body->removed * n * sizeof *f->psi);
    sparse_multiply(&body->matrices->mass, f->psi_count, f->psi, f->mass_psi);
    return f;
}

void flexibility_free(struct flexibility *flexibility)
{
    if (!flexibility)
        return;
    surface_rule_free(&flexibility->surface);
    volume_rule_free(&flexibility->volume);
    flexibility_edges_free(&flexibility->edges);
    free(flexibility->psi);
    free(flexibility->mass_psi);
    free(flexibility->force);
    free(flexibility->x);
    free(flexibility->work);
    free(flexibility->mass_x);
    free(flexibility->rest);
    free(flexibility->products);
    free(flexibility);
}

const struct surface_rule *flexibility_rule(const struct flexibility *flexibility)
{
    return &flexibility->surface;
}

const struct flexibility_edges *flexibility_edges(const struct flexibility *flexibility)
{
    return &flexibility->edges;
}

/* displacement of a place along its inward normal in nodal displacements x */
static double displacement_at(const struct flexibility *f, const struct flexibility_place *place,
                              const double *x)
{
    const struct surface_face *face = &f->body.surface->faces[place->face];
    double shape[FACE_MOST_NODES], sum = 0.0;
    facet_shape(face->count, place->u, place->v, shape, NULL, NULL);
    for (int n = 0; n < face->count; n++)
        sum += shape[n] * dot3(place->load.inward, x + 3 * face->nodes[n]);
    return sum;
}

/* Held nodes: w1 = -u_B there (into shifts, zero elsewhere) turns f into f - K w1 and g into g +
 * Psi^T M w1, and adds 2 f.w1 - w1.K w1 to C. */
static double hold(const struct flexibility *f, const struct flexibility_place *place,
                   double *force, double *momentum, double *shifts)
{
    const bool *held = f->body.matrices->held;
    memset(shifts, 0, f->n * sizeof *shifts);
    if (!held)
        return 0.0;
    for (size_t i = 0; i < f->n; i += 3) {
        if (!held[i])
            continue;
        boussinesq3_field(&place->load, f->body.mesh->points[i / 3], shifts + i, NULL);
        scale3(-1.0, shifts + i, shifts + i);
    }
    double value = 2.0 * dot(f->n, force, shifts);
    value -= flexibility_volume_add_shifts(&f->volume, held, shifts, force, momentum);
    for (size_t i = 0; i < f->n; i++)
        force[i] = held[i] ? 0.0 : force[i];
    return value;
}

/* integrals of the half-space's field: nodal forces, what mass feels, w without x and Psi; returns
 * C without what those add */
static double integrate(const struct flexibility *f, const struct flexibility_place *place,
                        double *force, double *momentum, double *rest)
{
    memset(force, 0, f->n * sizeof *force);
    memset(momentum, 0, f->n * sizeof *momentum);
    double value = boussinesq3_added_displacement(&place->load) -
                   flexibility_surface_add(&f->surface, place, force);
    if (f->body.mesh->part_count > 1)
        value += flexibility_volume_add_parts(&f->volume, place, force);
    flexibility_volume_add_mass(&f->volume, place, momentum);
    return value + hold(f, place, force, momentum, rest);
}

/* Forces of all columns without Psi, and w without x. Rigid motions balance a free body: f has the
 * work p on them. */
static void prepare(struct flexibility *f, size_t count, struct flexibility_terms *terms)
{
    size_t n = f->n, psi_count = f->psi_count;
    struct dense psi = {n, psi_count, f->psi}, mass_psi = {n, psi_count, f->mass_psi};
    double *all_own = f->products, *all_g = all_own + FLEXIBILITY_BLOCK * psi_count;
    for (size_t c = 0; c < count; c++)
        terms[c].value =
            integrate(f, &f->places[c], f->force + c * n, f->work + c * n, f->rest + c * n);
    dense_products(psi, (struct dense){n, count, f->force}, all_own);
    dense_products(psi, (struct dense){n, count, f->work}, all_g);
    dense_combine(mass_psi, -1.0, all_own, 1.0, count, f->force);
    dense_combine(psi, -1.0, all_g, 1.0, count, f->rest);

    /* what the modes have to do with C */
    for (size_t c = 0; c < count; c++) {
        const double *own = all_own + c * psi_count, *g = all_g + c * psi_count;
        double load = 0.0, off = 0.0;
        for (size_t k = 0; k < psi_count; k++) {
            double p = displacement_at(f, &f->places[c], f->psi + k * n), square = 0.0;
            if (k < f->body.rigid_count) {
                load += p * p;
                off += (own[k] - p) * (own[k] - p);
            } else {
                double omega = f->body.omega[k - f->body.rigid_count];
                square = omega * omega;
            }
            terms[c].value -= 2.0 * p * g[k] - square * g[k] * g[k];
        }
        terms[c].imbalance = load > 0.0 ? sqrt(off / load) : 0.0;
    }
}

/* One step for all columns: (K + s M) y = f + s M x, y without Psi, then x = y. Adds s x.M (y - x)
 * to f.y, whose error is then of the square of y's; `work` and `step` are those two terms. */
static enum percuss_status advance(struct flexibility *f, size_t count, double *work, double *step,
                                   struct fault *fault)
{
    /* (K + s M)^-1 of loads and of the last step */
    size_t n = f->n;
    for (size_t i = 0; i < count * n; i++)
        f->work[i] = f->force[i] + f->body.shift * f->mass_x[i];
    enum percuss_status status = factor_solve(f->body.factor, count, f->work, fault);
    if (status != PERCUSS_OK)
        return status;
    /* without Psi */
    dense_products((struct dense){n, f->psi_count, f->mass_psi}, (struct dense){n, count, f->work},
                   f->products);
    dense_combine((struct dense){n, f->psi_count, f->psi}, -1.0, f->products, 1.0, count, f->work);
    /* both terms of the work: of the load, and of the step */
    for (size_t c = 0; c < count; c++) {
        const double *y = f->work + c * n;
        work[c] = dot(n, f->force + c * n, y);
        step[c] = -f->body.shift * dot(n, y, f->mass_x + c * n);
    }
    /* M y, which the next step takes too */
    sparse_multiply(&f->body.matrices->mass, count, f->work, f->mass_x);
    for (size_t c = 0; c < count; c++)
        step[c] += f->body.shift * dot(n, f->work + c * n, f->mass_x + c * n);
    /* y is the next x */
    double *swap = f->x;
    f->x = f->work;
    f->work = swap;
    return PERCUSS_OK;
}

/* the first `count` columns, prepared */
static enum percuss_status iterate(struct flexibility *f, size_t count, double *work,
                                   struct fault *fault)
{
    double step[FLEXIBILITY_BLOCK];
    memset(f->mass_x, 0, count * f->n * sizeof *f->mass_x);
    for (int i = 0; i < MOST_STEPS; i++) {
        enum percuss_status status = advance(f, count, work, step, fault);
        if (status != PERCUSS_OK)
            return status;
        bool done = true;
        for (size_t c = 0; c < count; c++) {
            done = done && fabs(step[c]) <= SMALLEST_STEP * fabs(work[c]);
            work[c] += step[c];
        }
        if (done)
            return PERCUSS_OK;
    }
    return fault_set(
        fault, PERCUSS_INTERNAL,
        "static flexibility: no convergence in %d steps; the shift %g 1/s^2 is too far "
        "above the first eigenvalue",
        MOST_STEPS, f->body.shift);
}

enum percuss_status flexibility_solve(struct flexibility *flexibility, size_t count,
                                      const struct flexibility_place *places,
                                      struct flexibility_answer *answers, struct fault *fault)
{
    struct flexibility *f = flexibility;
    struct flexibility_terms terms[FLEXIBILITY_BLOCK];
    double work[FLEXIBILITY_BLOCK];
    memcpy(f->places, places, count * sizeof *places);
    prepare(f, count, terms);
    enum percuss_status status = iterate(f, count, work, fault);
    if (status != PERCUSS_OK)
        return status;
    for (size_t c = 0; c < count; c++) {
        const struct flexibility_place *place = &places[c];
        answers[c].imbalance = terms[c].imbalance;
        answers[c].radius = place->rim;
        answers[c].value = terms[c].value + work[c];
        /* from the radius where the integral began */
        if (!place->flat)
            answers[c].value -=
                flexibility_slope(place->load.young, place->load.poisson, place->bend) *
                log(place->rim / place->cut);
        if (!(terms[c].imbalance <= MOST_IMBALANCE))
            answers[c].value = NAN;
    }
    return PERCUSS_OK;
}

double flexibility_slope(double young, double poisson, double mean_curvature)
{
    double side = 1.0 - 2.0 * poisson;
    return (1.0 + poisson) * side * side * mean_curvature / (2.0 * M_PI * young);
}

/* Mean of ln(a / r) over pairs of points of Hertz's pressure p: both radii r below s hold a part
 * M^2 of the pairs, M(s) = 1 - (1 - s^2)^(3/2), and the mean of ln r about a circle is the
 * logarithm of the larger radius: integral of M^2 ds / s = H(3/2) - H(3) / 2 in harmonic numbers.
 *
 * A tangential force t at y moves x along the normal by k t.(x - y) / |x - y|^2, k = (1 + nu)(1 -
 * 2 nu) / (2 pi E), a normal force tangentially by as much the other way. With normals that turn by
 * H (x - y) from y to x the sum is k H for every pair. */
double flexibility_of_contact(double young, double poisson, double mean_curvature)
{
    const double mean = 1.75 - 2.0 * M_LN2;
    double tilt = (1.0 + poisson) * (1.0 - 2.0 * poisson) / (2.0 * M_PI * young);
    return mean * flexibility_slope(young, poisson, mean_curvature) + tilt * mean_curvature;
}

double flexibility_mode(const struct flexibility *flexibility, size_t mode,
                        const struct flexibility_place *place)
{
    size_t k = flexibility->body.rigid_count + mode;
    return displacement_at(flexibility, place, flexibility->psi + k * flexibility->n);
}

double flexibility_response(const struct flexibility *flexibility, size_t solved,
                            const struct flexibility_place *other)
{
    size_t start = solved * flexibility->n;
    double u[3];
    boussinesq3_field(&flexibility->places[solved].load, other->load.point, u, NULL);
    return dot3(u, other->load.inward) +
           displacement_at(flexibility, other, flexibility->x + start) +
           displacement_at(flexibility, other, flexibility->rest + start);
}
