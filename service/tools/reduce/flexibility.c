/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/flexibility.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "model/facet.h"
#include "model/vector.h"
#include "numeric/dense.h"
#include "reduce/field_integrals.h"

/* Nodal forces out of balance by more than this part of the force mean a surface that is not
 * closed or not the mesh's own; quadrature leaves less than 1e-7. */
static const double MOST_IMBALANCE = 1e-6;
/* Along the surface it leaves up to 1e-6, on curved faces of half a bar's radius. */
static const double MOST_IMBALANCE_ALONG = 1e-5;
/* Iterations end when a step does this part of the work: the error of the work then is of its
 * square, that of responses elsewhere of its order, both far below what interpolation leaves. */
static const double SMALLEST_STEP = 1e-4;
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
    double *force, *x, *work, *mass_x;
    double *shifts;   /* of held nodes: w1 */
    double *products; /* [FLEXIBILITY_BLOCK][psi_count] */
    double *momenta;  /* [FLEXIBILITY_BLOCK][psi_count]: g */
    struct flexibility_place places[FLEXIBILITY_BLOCK];
};

/* What is integrated of a place, a column for each load: nodal forces, displacements and momenta
 * beyond theirs (field_integrals_mass), shifts of held nodes. */
struct columns {
    double *forces, *nodal, *beyond, *shifts;
};

/* of one place: C, without f.x at first, and how far its forces are from balance */
struct flexibility_terms {
    load_pairs values;
    double imbalance[FLEXIBILITY_LOADS];
};

static double column_dot(size_t n, const double *a, const double *b)
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
    f->shifts = malloc(block * sizeof *f->shifts);
    f->momenta = malloc((FLEXIBILITY_BLOCK * f->psi_count + 1) * sizeof *f->momenta);
    f->products = malloc((FLEXIBILITY_BLOCK * f->psi_count + 1) * sizeof *f->products);
    /* rules of integration over surface and volume */
    if (!f->psi || !f->mass_psi || !f->force || !f->x || !f->work || !f->mass_x || !f->shifts ||
        !f->products || !f->momenta || !surface_rule_make(&f->surface, body->mesh, body->surface) ||
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
    free(flexibility->shifts);
    free(flexibility->momenta);
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

/* displacement of a place along one of its loads in nodal displacements x */
static double displacement_at(const struct flexibility *f, const struct flexibility_place *place,
                              int load, const double *x)
{
    const struct surface_face *face = &f->body.surface->faces[place->face];
    const double *direction = flexibility_place_direction(place, load);
    double shape[FACE_MOST_NODES], sum = 0.0;
    facet_shape(face->count, place->u, place->v, shape, NULL, NULL);
    for (int n = 0; n < face->count; n++)
        sum += shape[n] * dot3(direction, x + 3 * face->nodes[n]);
    return sum;
}

/* Held nodes: w1 = -u_B there (into shifts, zero elsewhere) turns f into f - K w1, leaves nothing
 * of u_B at these nodes, and adds 2 f.w1 - w1.K w1 to C. One column for each load. */
static void hold_nodes(const struct flexibility *f, const struct flexibility_place *place,
                       const struct columns *columns, load_pairs values)
{
    const bool *held = f->body.matrices->held;
    size_t loads = (size_t)place->loads;
    double *forces = columns->forces, *shifts = columns->shifts;
    memset(shifts, 0, loads * f->n * sizeof *shifts);
    if (!held)
        return;
    for (size_t i = 0; i < loads * f->n; i++)
        if (held[i % f->n]) {
            shifts[i] = -columns->nodal[i];
            columns->nodal[i] = 0.0;
        }
    for (size_t i = 0; i < loads; i++)
        for (size_t j = 0; j < loads; j++)
            values[i][j] += 2.0 * column_dot(f->n, forces + i * f->n, shifts + j * f->n);
    field_integrals_shifts(&f->volume, held, place->loads, shifts, forces, values);
    for (size_t i = 0; i < loads * f->n; i++)
        forces[i] = held[i % f->n] ? 0.0 : forces[i];
}

/* integrals of the half-space's fields; C without the columns' parts */
static void integrate_field(const struct flexibility *f, const struct flexibility_place *place,
                            const struct columns *columns, load_pairs values)
{
    memset(columns->forces, 0, (size_t)place->loads * f->n * sizeof *columns->forces);
    memset(values, 0, sizeof(load_pairs));
    for (int i = 0; i < place->loads; i++)
        values[i][i] = flexibility_place_added(place, i);
    field_integrals_surface(&f->surface, place, f->n, columns->forces, values);
    if (f->body.mesh->part_count > 1)
        field_integrals_parts(&f->volume, place, columns->forces, values);
    field_integrals_mass(&f->volume, place, f->body.matrices->held, columns->nodal,
                         columns->beyond);
    hold_nodes(f, place, columns, values);
}

/* Room for a place's columns, the first of which is the block's `first`. The solution comes later
 * than what is integrated. */
static struct columns columns_at(const struct flexibility *f, size_t first)
{
    size_t at = first * f->n;
    return (struct columns){f->force + at, f->x + at, f->work + at, f->shifts + at};
}

void flexibility_integrate(struct flexibility *flexibility, const struct flexibility_place *place)
{
    load_pairs values;
    const struct columns columns = columns_at(flexibility, 0);
    integrate_field(flexibility, place, &columns, values);
}

double flexibility_column_seconds(const struct rates *rates, const struct factor_cost *cost,
                                  const struct sparse *mass, size_t removed)
{
    /* four products with the modes, and two more of the normal loads; blocks are as wide as takes
     * them half way from the thin rate to the square one */
    double modes = 4.0 + 2.0 / FLEXIBILITY_LOADS;
    double products = 2.0 * modes * (double)mass->n * (double)removed;
    return rates_solution(rates, cost, FLEXIBILITY_BLOCK) +
           rates_product(rates, mass->start[mass->n]) +
           products / sqrt(rates->thin * rates->square);
}

/* The modes' part of C of one place, whose columns have the works `own` and the momenta g on them.
 * Rigid motions balance a free body: f has the work p on them. */
static void take_modes(const struct flexibility *f, const struct flexibility_place *place,
                       const double *own, const double *g, struct flexibility_terms *terms)
{
    size_t count = f->psi_count, rigid = f->body.rigid_count;
    double load[FLEXIBILITY_LOADS] = {0.0}, off[FLEXIBILITY_LOADS] = {0.0};
    for (size_t k = 0; k < count; k++) {
        double omega = k < rigid ? 0.0 : f->body.omega[k - rigid];
        for (int i = 0; i < place->loads; i++) {
            double p = displacement_at(f, place, i, f->psi + k * f->n);
            double balance = own[(size_t)i * count + k] - p, own_g = g[(size_t)i * count + k];
            load[i] += k < rigid ? p * p : 0.0;
            off[i] += k < rigid ? balance * balance : 0.0;
            for (int j = 0; j < place->loads; j++)
                terms->values[i][j] -= (2.0 * p - omega * omega * own_g) * g[(size_t)j * count + k];
        }
    }
    for (int i = 0; i < place->loads; i++)
        terms->imbalance[i] = load[i] > 0.0 ? sqrt(off[i] / load[i]) : 0.0;
}

/* Forces of all columns without Psi, and g. */
static void prepare_columns(struct flexibility *f, size_t count, struct flexibility_terms *terms)
{
    size_t n = f->n, psi_count = f->psi_count, loads = (size_t)f->places[0].loads;
    size_t columns = count * loads;
    struct dense psi = {n, psi_count, f->psi}, mass_psi = {n, psi_count, f->mass_psi};
    double *own = f->products, *g = f->momenta;
    for (size_t c = 0; c < count; c++) {
        const struct columns at = columns_at(f, c * loads);
        integrate_field(f, &f->places[c], &at, terms[c].values);
    }
    /* g = (M Psi)^T u at the nodes, and Psi^T of what is beyond that */
    dense_products(mass_psi, (struct dense){n, columns, f->x}, g);
    dense_products(psi, (struct dense){n, columns, f->work}, own);
    for (size_t i = 0; i < columns * psi_count; i++)
        g[i] += own[i];
    dense_products(psi, (struct dense){n, columns, f->force}, own);
    dense_combine(mass_psi, -1.0, own, 1.0, columns, f->force);
    for (size_t c = 0; c < count; c++) {
        size_t first = c * loads * psi_count;
        take_modes(f, &f->places[c], own + first, g + first, &terms[c]);
    }
}

/* Adds `factor` a_i.b_j of one place's columns, for each pair of its loads. */
static void add_pairs(const struct flexibility *f, size_t place, double factor, const double *a,
                      const double *b, load_pairs pairs)
{
    size_t loads = (size_t)f->places[0].loads, first = place * loads * f->n;
    double products[FLEXIBILITY_LOADS * FLEXIBILITY_LOADS];
    dense_products((struct dense){f->n, loads, a + first}, (struct dense){f->n, loads, b + first},
                   products);
    for (size_t i = 0; i < loads; i++)
        for (size_t j = 0; j < loads; j++)
            pairs[i][j] += factor * products[j * loads + i];
}

/* One step for all columns: (K + s M) y = f + s M x, then x = y. Adds s x.M (y - x) to f.y: its
 * error is then of the square of y's; `works` and `steps` are those two terms, of each pair of a
 * place's loads. Rounding leaves some of Psi in y, which does not grow and does no work, as f has
 * none. */
static enum percuss_status advance_columns(struct flexibility *f, size_t count, load_pairs *works,
                                           load_pairs *steps, struct fault *fault)
{
    /* (K + s M)^-1 of loads and of the last step */
    size_t n = f->n, columns = count * (size_t)f->places[0].loads;
    double shift = f->body.shift;
    for (size_t i = 0; i < columns * n; i++)
        f->work[i] = f->force[i] + shift * f->mass_x[i];
    enum percuss_status status = factor_solve(f->body.factor, columns, f->work, fault);
    if (status != PERCUSS_OK)
        return status;
    /* both terms of the work: of the load, and of the step */
    memset(works, 0, count * sizeof *works);
    memset(steps, 0, count * sizeof *steps);
    for (size_t c = 0; c < count; c++) {
        add_pairs(f, c, 1.0, f->force, f->work, works[c]);
        add_pairs(f, c, -shift, f->mass_x, f->work, steps[c]);
    }
    /* M y, which the next step takes too */
    sparse_multiply(&f->body.matrices->mass, columns, f->work, f->mass_x);
    for (size_t c = 0; c < count; c++)
        add_pairs(f, c, shift, f->mass_x, f->work, steps[c]);
    /* y is the next x */
    double *swap = f->x;
    f->x = f->work;
    f->work = swap;
    return PERCUSS_OK;
}

/* x of the normal loads, one after the other at the front, becomes w = x - Psi g, with what
 * rounding left of Psi taken out and held nodes shifted. */
static void complete_normals(struct flexibility *f, size_t count)
{
    size_t n = f->n, loads = (size_t)f->places[0].loads;
    for (size_t c = 1; loads > 1 && c < count; c++) {
        memcpy(f->x + c * n, f->x + c * loads * n, n * sizeof *f->x);
        memcpy(f->shifts + c * n, f->shifts + c * loads * n, n * sizeof *f->shifts);
        memcpy(f->momenta + c * f->psi_count, f->momenta + c * loads * f->psi_count,
               f->psi_count * sizeof *f->momenta);
    }
    dense_products((struct dense){n, f->psi_count, f->mass_psi}, (struct dense){n, count, f->x},
                   f->products);
    for (size_t i = 0; i < count * f->psi_count; i++)
        f->products[i] += f->momenta[i];
    dense_combine((struct dense){n, f->psi_count, f->psi}, -1.0, f->products, 1.0, count, f->x);
    for (size_t i = 0; f->body.matrices->held && i < count * n; i++)
        f->x[i] += f->shifts[i];
}

/* the columns of the first `count` places, prepared; adds f.x to C */
static enum percuss_status iterate_columns(struct flexibility *f, size_t count,
                                           struct flexibility_terms *terms, struct fault *fault)
{
    load_pairs works[FLEXIBILITY_BLOCK], steps[FLEXIBILITY_BLOCK];
    int loads = f->places[0].loads;
    memset(f->mass_x, 0, count * (size_t)loads * f->n * sizeof *f->mass_x);
    for (int turn = 0; turn < MOST_STEPS; turn++) {
        enum percuss_status status = advance_columns(f, count, works, steps, fault);
        if (status != PERCUSS_OK)
            return status;
        bool done = true;
        for (size_t c = 0; c < count; c++)
            for (int i = 0; i < loads; i++)
                done = done && fabs(steps[c][i][i]) <= SMALLEST_STEP * fabs(works[c][i][i]);
        if (!done)
            continue;
        for (size_t c = 0; c < count; c++)
            for (int i = 0; i < loads; i++)
                for (int j = 0; j < loads; j++)
                    terms[c].values[i][j] += works[c][i][j] + steps[c][i][j];
        return PERCUSS_OK;
    }
    return fault_set(
        fault, PERCUSS_INTERNAL,
        "static flexibility: no convergence in %d steps; the shift %g 1/s^2 is too far "
        "above the first eigenvalue",
        MOST_STEPS, f->body.shift);
}

/* C between all directions of the body's frame; along the surface narrower by a logarithm. */
static void find_tensor(const struct flexibility_place *place,
                        const struct flexibility_terms *terms, double narrower, double tensor[6])
{
    static const int ROW[6] = {0, 1, 2, 0, 1, 2}, COLUMN[6] = {0, 1, 2, 1, 2, 0};
    bool known = place->loads == FLEXIBILITY_LOADS;
    for (int i = 0; i < place->loads; i++)
        known = known && terms->imbalance[i] <= (i == 0 ? MOST_IMBALANCE : MOST_IMBALANCE_ALONG);
    for (int k = 0; k < 6; k++) {
        tensor[k] = known ? 0.0 : NAN;
        for (int i = 0; known && i < FLEXIBILITY_LOADS; i++)
            for (int j = 0; j < FLEXIBILITY_LOADS; j++)
                tensor[k] += terms->values[i][j] * flexibility_place_direction(place, i)[ROW[k]] *
                             flexibility_place_direction(place, j)[COLUMN[k]];
    }
    cerruti3_add_slope(place->load.young, place->load.poisson, place->load.inward, place->curvature,
                       narrower, tensor);
}

static void find_answer(const struct flexibility_place *place, struct flexibility_terms *terms,
                        struct flexibility_answer *answer)
{
    const double *k = place->curvature;
    /* from the radius where the integral began to the rim's */
    double narrower = place->flat ? 0.0 : log(place->cut / place->rim);
    terms->values[0][0] += narrower * flexibility_slope(place->load.young, place->load.poisson,
                                                        0.5 * (k[0] + k[4] + k[8]));
    for (int i = 0; i < place->loads; i++)
        for (int j = 0; j < i; j++)
            terms->values[i][j] = terms->values[j][i] =
                0.5 * (terms->values[i][j] + terms->values[j][i]);
    answer->radius = place->rim;
    answer->imbalance = 0.0;
    for (int i = 0; i < place->loads; i++)
        answer->imbalance = fmax(answer->imbalance, terms->imbalance[i]);
    answer->value = terms->imbalance[0] <= MOST_IMBALANCE ? terms->values[0][0] : NAN;
    find_tensor(place, terms, narrower, answer->tensor);
}

enum percuss_status flexibility_solve(struct flexibility *flexibility, size_t count,
                                      const struct flexibility_place *places,
                                      struct flexibility_answer *answers, struct fault *fault)
{
    struct flexibility *f = flexibility;
    struct flexibility_terms terms[FLEXIBILITY_BLOCK];
    memcpy(f->places, places, count * sizeof *places);
    prepare_columns(f, count, terms);
    enum percuss_status status = iterate_columns(f, count, terms, fault);
    if (status != PERCUSS_OK)
        return status;
    complete_normals(f, count);
    for (size_t c = 0; c < count; c++)
        find_answer(&places[c], &terms[c], &answers[c]);
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
                        const struct flexibility_place *place, int load)
{
    size_t k = flexibility->body.rigid_count + mode;
    return displacement_at(flexibility, place, load, flexibility->psi + k * flexibility->n);
}

double flexibility_response(const struct flexibility *flexibility, size_t solved,
                            const struct flexibility_place *other)
{
    const struct flexibility_place *own = &flexibility->places[solved];
    double u[3];
    boussinesq3_field(&own->load, other->load.point, u, NULL);
    return dot3(u, other->load.inward) +
           displacement_at(flexibility, other, 0, flexibility->x + solved * flexibility->n);
}
