/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/solid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fe/boussinesq.h"
#include "numeric/band.h"

typedef struct plastic_state histories[QUAD_POINTS];

/* State that a step starts from or may return to. */
struct snapshot {
    double *displacement; /* all nodes, r and z */
    histories *history;   /* by element */
    double force;         /* N, of all contact nodes: the far boundary moves with it */
    double *forces;       /* N, by contact node; of a solid that never yields */
    bool settled;         /* the displacement is that of the forces; else not found yet */
};

/* Forward solutions L^-1 e_j of unit contact forces, the products of any two of them, and of each
 * with the far boundary's. */
struct solid_loads {
    double *forward;      /* candidates x freedoms; row j from its own freedom on */
    double *common;       /* candidates x candidates, lower triangle: products of two rows */
    double *share;        /* products with `boundary` */
    size_t known, stride; /* rows that are there; candidates */
};

struct solid {
    bool linear; /* never yields: its displacement follows from the forces, when it is asked for */
    const struct mesh *mesh;
    const struct quad *quads;
    struct plastic_law law;
    size_t free_nodes; /* the far nodes come last */
    double *far;       /* displacement of the far nodes per newton, r and z */
    double *pull;      /* forces on the free freedoms per newton, from the far displacement */
    double *pulled;    /* elastic factor's forward solution of `pull` */
    double (*stiffness)[QUAD_FREEDOMS * QUAD_FREEDOMS]; /* elastic, by element */
    struct band elastic, tangent;
    struct snapshot committed, start, present;
    size_t zone;                  /* elements before this one may flow */
    bool yielding;                /* some point flows now: the tangent is not the elastic one */
    size_t first;                 /* first freedom that takes part in the present linearisation */
    double *balance;              /* internal forces on the free freedoms */
    double *residual;             /* forward solution of `balance` */
    double *boundary;             /* forward solution of `pull` */
    struct solid_loads unloading; /* by the elastic factor: found once */
    struct solid_loads flowing;   /* by the tangent's: anew in every linearisation */
};

static inline size_t freedoms(const struct solid *solid)
{
    return 2 * solid->free_nodes;
}

/* freedom of a free node's r; z is the next */
static inline size_t freedom(const struct solid *solid, size_t node)
{
    return 2 * (solid->free_nodes - 1 - node);
}

static inline bool is_fixed(const struct solid *solid, size_t node, size_t component)
{
    return component == 0 && solid->mesh->r[node] == 0.0;
}

/* displacements of an element's nodes */
static void solid_gather(const struct solid *solid, size_t element, double local[QUAD_FREEDOMS])
{
    const uint32_t *nodes = solid->mesh->quads[element];
    for (size_t i = 0; i < QUAD_FREEDOMS; i++)
        local[i] = solid->present.displacement[2 * nodes[i / 2] + i % 2];
}

/* Forces of the elastic element at its present displacements. */
static void solid_elastic_force(const struct solid *solid, size_t element,
                                double force[QUAD_FREEDOMS])
{
    double local[QUAD_FREEDOMS];
    solid_gather(solid, element, local);
    for (size_t i = 0; i < QUAD_FREEDOMS; i++) {
        force[i] = 0.0;
        for (size_t k = 0; k < QUAD_FREEDOMS; k++)
            force[i] += solid->stiffness[element][QUAD_FREEDOMS * i + k] * local[k];
    }
}

/* local forces of an element onto free freedoms; a fixed one stays in balance by its support */
static void solid_scatter(const struct solid *solid, size_t element, const double *local,
                          double *forces)
{
    const uint32_t *nodes = solid->mesh->quads[element];
    for (size_t i = 0; i < QUAD_FREEDOMS; i++)
        if (nodes[i / 2] < solid->free_nodes && !is_fixed(solid, nodes[i / 2], i % 2))
            forces[freedom(solid, nodes[i / 2]) + i % 2] += local[i];
}

/* adds an element's stiffness to columns from `first` on; a fixed freedom keeps its diagonal alone
 */
static void solid_assemble(const struct solid *solid, size_t element, const double *local,
                           size_t first, struct band *matrix)
{
    const uint32_t *nodes = solid->mesh->quads[element];
    for (size_t i = 0; i < QUAD_FREEDOMS; i++) {
        size_t a = nodes[i / 2];
        if (a >= solid->free_nodes)
            continue;
        for (size_t k = 0; k < QUAD_FREEDOMS; k++) {
            size_t b = nodes[k / 2];
            if (b >= solid->free_nodes)
                continue;
            /* lower triangle from `first` on; a fixed freedom keeps its diagonal alone */
            size_t row = freedom(solid, a) + i % 2;
            size_t column = freedom(solid, b) + k % 2;
            bool fixed = is_fixed(solid, a, i % 2) || is_fixed(solid, b, k % 2);
            if (row >= column && column >= first && (row == column || !fixed))
                *band_entry(matrix, row, column) += local[QUAD_FREEDOMS * i + k];
        }
    }
}

static bool snapshot_make(const struct mesh *mesh, size_t candidates, struct snapshot *snapshot)
{
    snapshot->settled = true;
    snapshot->forces = calloc(candidates, sizeof *snapshot->forces);
    snapshot->displacement = calloc(2 * mesh->nodes, sizeof *snapshot->displacement);
    snapshot->history = calloc(mesh->elements, sizeof *snapshot->history);
    return snapshot->displacement && snapshot->history && snapshot->forces;
}

static void snapshot_free(struct snapshot *snapshot)
{
    free(snapshot->displacement);
    free(snapshot->history);
    free(snapshot->forces);
}

static size_t half_width(const struct mesh *mesh)
{
    size_t width = 0;
    for (size_t e = 0; e < mesh->elements; e++)
        for (size_t i = 0; i < 4; i++)
            for (size_t k = 0; k < 4; k++)
                if (mesh->quads[e][i] > mesh->quads[e][k] + width)
                    width = mesh->quads[e][i] - mesh->quads[e][k];
    return 2 * width + 1;
}

static bool loads_make(struct solid_loads *loads, size_t candidates, size_t n)
{
    loads->stride = candidates;
    loads->forward = calloc(candidates * n, sizeof(double));
    loads->common = calloc(candidates * candidates, sizeof(double));
    loads->share = calloc(candidates, sizeof(double));
    return loads->forward && loads->common && loads->share;
}

static void loads_free(struct solid_loads *loads)
{
    free(loads->forward);
    free(loads->common);
    free(loads->share);
}

static bool allocate(struct solid *solid, size_t candidates)
{
    const struct mesh *mesh = solid->mesh;
    size_t n = freedoms(solid);
    size_t width = half_width(mesh);
    solid->elastic = (struct band){n, width, calloc(n * (width + 1), sizeof(double))};
    solid->tangent = (struct band){n, width, calloc(n * (width + 1), sizeof(double))};
    solid->far = calloc(2 * mesh->far.count, sizeof(double));
    solid->pull = calloc(n, sizeof(double));
    solid->pulled = calloc(n, sizeof(double));
    solid->stiffness = calloc(mesh->elements, sizeof *solid->stiffness);
    solid->balance = calloc(n, sizeof(double));
    solid->residual = calloc(n, sizeof(double));
    solid->boundary = calloc(n, sizeof(double));
    return solid->elastic.values && solid->tangent.values && solid->far && solid->pull &&
           solid->pulled && solid->stiffness && solid->balance && solid->residual &&
           solid->boundary && loads_make(&solid->unloading, candidates, n) &&
           loads_make(&solid->flowing, candidates, n) &&
           snapshot_make(mesh, candidates, &solid->committed) &&
           snapshot_make(mesh, candidates, &solid->start) &&
           snapshot_make(mesh, candidates, &solid->present);
}

/* the elastic matrix and its factor */
static bool prepare_elastic(struct solid *solid)
{
    double moduli[STRESS_COMPONENTS * STRESS_COMPONENTS];
    plastic_law_moduli(&solid->law, moduli);
    for (size_t e = 0; e < solid->mesh->elements; e++) {
        for (int p = 0; p < QUAD_POINTS; p++)
            quad_add_stiffness(&solid->quads[e], p, moduli, solid->stiffness[e]);
        solid_assemble(solid, e, solid->stiffness[e], 0, &solid->elastic);
    }
    return band_factor(&solid->elastic);
}

/* The far nodes move as under this contact force, N. */
static void solid_move_far(struct solid *solid, double force)
{
    for (size_t i = 0; i < solid->mesh->far.count; i++)
        for (size_t c = 0; c < 2; c++)
            solid->present.displacement[2 * solid->mesh->far.index[i] + c] =
                force * solid->far[2 * i + c];
    solid->present.force = force;
}

/* The far nodes follow the field of the contact force taken as a point load: the effects of its
 * spread and of the plastic strains fall off with the square of the distance. */
static void prepare_far(struct solid *solid, const struct material *material)
{
    const struct mesh *mesh = solid->mesh;
    for (size_t i = 0; i < mesh->far.count; i++) {
        size_t node = mesh->far.index[i];
        boussinesq_displacement(material->young, material->poisson, mesh->r[node], mesh->z[node],
                                &solid->far[2 * i]);
    }
    solid_move_far(solid, 1.0);
    for (size_t e = 0; e < mesh->elements; e++) {
        double forces[QUAD_FREEDOMS];
        solid_elastic_force(solid, e, forces);
        solid_scatter(solid, e, forces, solid->pull);
    }
    solid_move_far(solid, 0.0);
    memcpy(solid->pulled, solid->pull, freedoms(solid) * sizeof *solid->pull);
    band_forward(&solid->elastic, 0, freedoms(solid), solid->pulled);
}

struct solid *solid_create(const struct mesh *mesh, const struct quad *quads,
                           const struct material *material, size_t candidates)
{
    struct solid *solid = calloc(1, sizeof *solid);
    if (!solid)
        return NULL;
    solid->mesh = mesh;
    solid->quads = quads;
    solid->law = plastic_law_make(material);
    solid->linear = isinf(solid->law.yield);
    solid->free_nodes = mesh->nodes - mesh->far.count;
    if (!allocate(solid, candidates) || !prepare_elastic(solid)) {
        solid_destroy(solid);
        return NULL;
    }
    prepare_far(solid, material);
    return solid;
}

void solid_destroy(struct solid *solid)
{
    if (!solid)
        return;
    free(solid->elastic.values);
    free(solid->tangent.values);
    free(solid->far);
    free(solid->pull);
    free(solid->pulled);
    free(solid->stiffness);
    free(solid->balance);
    free(solid->residual);
    free(solid->boundary);
    loads_free(&solid->unloading);
    loads_free(&solid->flowing);
    snapshot_free(&solid->committed);
    snapshot_free(&solid->start);
    snapshot_free(&solid->present);
    free(solid);
}

/* Newton steps. */

static size_t contact_freedom(const struct solid *solid, size_t i)
{
    return freedom(solid, solid->mesh->contact.index[i]) + 1;
}

static void snapshot_copy(const struct solid *solid, struct snapshot *to,
                          const struct snapshot *from)
{
    memcpy(to->displacement, from->displacement, 2 * solid->mesh->nodes * sizeof(double));
    memcpy(to->history, from->history, solid->zone * sizeof *to->history);
    memcpy(to->forces, from->forces, solid->unloading.stride * sizeof *to->forces);
    to->force = from->force;
    to->settled = from->settled;
}

/* two rings beyond the last flowing element are followed closely */
static size_t margin(const struct solid *solid)
{
    return 2 * solid->mesh->far.count;
}

static void widen(struct solid *solid, size_t elements)
{
    if (elements > solid->zone)
        solid->zone = elements < solid->mesh->elements ? elements : solid->mesh->elements;
}

/* forces of an element that may flow; its histories follow */
static bool flow_element(struct solid *solid, size_t element, double force[QUAD_FREEDOMS])
{
    double local[QUAD_FREEDOMS];
    bool flows = false;
    solid_gather(solid, element, local);
    memset(force, 0, QUAD_FREEDOMS * sizeof *force);
    for (int p = 0; p < QUAD_POINTS; p++) {
        double strain[STRESS_COMPONENTS], stress[STRESS_COMPONENTS];
        quad_strain(&solid->quads[element], p, local, strain);
        flows |= plasticity_return(&solid->law, &solid->start.history[element][p], strain,
                                   &solid->present.history[element][p], stress, NULL);
        quad_add_force(&solid->quads[element], p, stress, force);
    }
    return flows;
}

double solid_balance(struct solid *solid, size_t count, const double *forces)
{
    size_t n = freedoms(solid);
    solid->yielding = false;
    if (solid->linear)
        return 0.0;
    memset(solid->balance, 0, n * sizeof *solid->balance);
    /* internal forces: elements of the zone may flow, the others are elastic */
    for (size_t e = 0; e < solid->mesh->elements; e++) {
        double local[QUAD_FREEDOMS];
        if (e >= solid->zone)
            solid_elastic_force(solid, e, local);
        else if (flow_element(solid, e, local))
            solid->yielding = true;
        solid_scatter(solid, e, local, solid->balance);
    }
    /* the largest sum with the contact's forces, which are not kept in it */
    double worst = 0.0;
    for (size_t i = 0; i < count; i++)
        solid->balance[contact_freedom(solid, i)] += forces[i];
    for (size_t i = 0; i < n; i++)
        worst = fmax(worst, fabs(solid->balance[i]));
    for (size_t i = 0; i < count; i++)
        solid->balance[contact_freedom(solid, i)] -= forces[i];
    return worst;
}

bool solid_zone_grew(struct solid *solid)
{
    size_t flowing = 0;
    if (isinf(solid->law.yield))
        return false;
    /* the outermost element beyond the zone that would flow */
    for (size_t e = solid->zone; e < solid->mesh->elements; e++) {
        double local[QUAD_FREEDOMS];
        solid_gather(solid, e, local);
        for (int p = 0; p < QUAD_POINTS; p++) {
            double strain[STRESS_COMPONENTS], stress[STRESS_COMPONENTS];
            struct plastic_state after;
            quad_strain(&solid->quads[e], p, local, strain);
            if (plasticity_return(&solid->law, &solid->start.history[e][p], strain, &after, stress,
                                  NULL))
                flowing = e + 1;
        }
    }
    /* takes the zone with it */
    if (flowing)
        widen(solid, flowing + margin(solid));
    return flowing > 0;
}

bool solid_fits(const struct solid *solid)
{
    return solid->zone + margin(solid) <= solid->mesh->elements;
}

/* last node of the zone and of the contact candidates: everything farther out stays as factored */
static size_t outermost_node(const struct solid *solid, size_t count)
{
    size_t outermost = count ? solid->mesh->contact.index[count - 1] : 0;
    for (size_t e = 0; e < solid->zone; e++)
        for (size_t i = 0; i < 4; i++)
            if (solid->mesh->quads[e][i] > outermost)
                outermost = solid->mesh->quads[e][i];
    return outermost;
}

/* An element's tangent stiffness; false: it is the elastic one, and not filled. */
static bool tangent_element(const struct solid *solid, const struct plastic_law *law,
                            size_t element, double stiffness[QUAD_FREEDOMS * QUAD_FREEDOMS])
{
    double local[QUAD_FREEDOMS];
    double moduli[QUAD_POINTS][STRESS_COMPONENTS * STRESS_COMPONENTS];
    bool flows = false;
    solid_gather(solid, element, local);
    for (int p = 0; p < QUAD_POINTS; p++) {
        double strain[STRESS_COMPONENTS], stress[STRESS_COMPONENTS];
        struct plastic_state after;
        quad_strain(&solid->quads[element], p, local, strain);
        flows |= plasticity_return(law, &solid->start.history[element][p], strain, &after, stress,
                                   moduli[p]);
    }
    if (!flows)
        return false;
    memset(stiffness, 0, QUAD_FREEDOMS * QUAD_FREEDOMS * sizeof *stiffness);
    for (int p = 0; p < QUAD_POINTS; p++)
        quad_add_stiffness(&solid->quads[element], p, moduli[p], stiffness);
    return true;
}

static bool factor_tangent(struct solid *solid, size_t outermost, bool loading)
{
    /* yield stress slightly lower: points on the yield surface count as flowing */
    struct plastic_law law = solid->law;
    if (loading)
        law.yield *= 1.0 - 1e-8;
    /* only elements within `outermost` are softer than the factored ones */
    size_t n = freedoms(solid);
    memset(band_entry(&solid->tangent, solid->first, solid->first), 0,
           (n - solid->first) * (solid->tangent.width + 1) * sizeof(double));
    /* elements of the zone by their tangent moduli, the rest elastic */
    for (size_t e = 0; e < solid->mesh->elements; e++) {
        double stiffness[QUAD_FREEDOMS * QUAD_FREEDOMS];
        const uint32_t *nodes = solid->mesh->quads[e];
        if (nodes[0] > outermost && nodes[1] > outermost && nodes[2] > outermost &&
            nodes[3] > outermost)
            continue;
        bool flows = e < solid->zone && tangent_element(solid, &law, e, stiffness);
        solid_assemble(solid, e, flows ? stiffness : solid->stiffness[e], solid->first,
                       &solid->tangent);
    }
    return band_factor_trailing(&solid->tangent, &solid->elastic, solid->first);
}

static const struct band *inner_factor(const struct solid *solid)
{
    return solid->yielding ? &solid->tangent : &solid->elastic;
}

/* forward solution, elastic before `first` */
static void forward(const struct solid *solid, double *b)
{
    band_carry_forward(&solid->elastic, solid->first, b, b);
    band_forward(inner_factor(solid), solid->first, freedoms(solid), b);
}

/* Four sums at once, which a compiler may not make of one. */
static double dot(const double *a, const double *b, size_t from, size_t to)
{
    double sum[4] = {0.0};
    size_t i = from;
    for (; i + 4 <= to; i += 4)
        for (size_t k = 0; k < 4; k++)
            sum[k] += a[i + k] * b[i + k];
    for (; i < to; i++)
        sum[0] += a[i] * b[i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

static struct solid_loads *present_loads(struct solid *solid)
{
    return solid->yielding ? &solid->flowing : &solid->unloading;
}

/* Finds the loads of contact nodes that are not known yet. */
static void find_loads(const struct solid *solid, size_t count, struct solid_loads *loads)
{
    size_t n = freedoms(solid);
    for (; loads->known < count; loads->known++) {
        /* contact nodes count outward, freedoms inward: those of j <= i lie beyond row `from` */
        size_t i = loads->known;
        size_t from = contact_freedom(solid, i);
        double *load = loads->forward + i * n;
        memset(load + from, 0, (n - from) * sizeof *load);
        load[from] = 1.0;
        band_forward(inner_factor(solid), from, n, load);
        /* its products with those farther in, and with the boundary */
        loads->share[i] = dot(load, solid->boundary, from, n);
        for (size_t j = 0; j <= i; j++)
            loads->common[i * loads->stride + j] =
                dot(load, loads->forward + j * n, contact_freedom(solid, j), n);
    }
}

/* Compliance of the contact nodes by their loads. */
static void fill_compliance(const struct solid_loads *loads, size_t count, double *compliance)
{
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < count; j++)
            compliance[i * count + j] =
                loads->common[(j < i ? i : j) * loads->stride + (j < i ? j : i)] + loads->share[i];
}

/* The same as solid_linearise of a solid that never yields: no forces, no offsets. */
static void linearise_linear(struct solid *solid, size_t count, double *offset, double *compliance)
{
    memcpy(solid->boundary, solid->pulled, freedoms(solid) * sizeof *solid->boundary);
    find_loads(solid, count, &solid->unloading);
    memset(offset, 0, count * sizeof *offset);
    fill_compliance(&solid->unloading, count, compliance);
}

/* Internal forces r on the free freedoms, contact forces f_j inward at e_j, their sum F, which
 * moves the far nodes and so pulls by p per newton: equilibrium about the present state, of the
 * force F0, is
 *
 *   r + K du + (F - F0) p + sum_j f_j e_j = 0,    K = L L^T,
 *   du = -L^-T (L^-1 r + (F - F0) L^-1 p + sum_j f_j L^-1 e_j).
 *
 * `residual`, `boundary` and the loads are L^-1 r, L^-1 p and L^-1 e_j. The surface at contact node
 * i then lies at u_i + e_i . du = offset_i - sum_j c_ij f_j with
 *
 *   offset_i = u_i - loads_i . residual + F0 loads_i . boundary,
 *   c_ij = loads_i . loads_j + loads_i . boundary. */
bool solid_linearise(struct solid *solid, size_t count, bool loading, double *offset,
                     double *compliance)
{
    if (solid->linear) {
        linearise_linear(solid, count, offset, compliance);
        return true;
    }
    size_t n = freedoms(solid);
    size_t outermost = outermost_node(solid, count);
    /* K from the zone inward; outside, its factor stands */
    solid->first = outermost < solid->free_nodes ? freedom(solid, outermost) : 0;
    if (loading && solid->zone > 0)
        solid->yielding = true;
    if (solid->yielding && !factor_tangent(solid, outermost, loading))
        return false;
    /* L^-1 r and L^-1 p */
    memcpy(solid->residual, solid->balance, n * sizeof *solid->residual);
    band_forward(&solid->elastic, 0, solid->first, solid->residual);
    forward(solid, solid->residual);
    memcpy(solid->boundary, solid->pulled, n * sizeof *solid->boundary);
    if (solid->yielding) {
        memcpy(solid->boundary + solid->first, solid->pull + solid->first,
               (n - solid->first) * sizeof *solid->boundary);
        forward(solid, solid->boundary);
        solid->flowing.known = 0;
    }
    /* L^-1 e_j */
    struct solid_loads *loads = present_loads(solid);
    find_loads(solid, count, loads);
    for (size_t i = 0; i < count; i++) {
        size_t from = contact_freedom(solid, i);
        offset[i] = solid_surface(solid, i) -
                    dot(loads->forward + i * n, solid->residual, from, n) +
                    solid->present.force * loads->share[i];
    }
    fill_compliance(loads, count, compliance);
    return true;
}

/* step += sum_j forces[j] loads_j; returns the sum of the forces. */
static double add_loads(const struct solid *solid, const struct solid_loads *loads, size_t count,
                        const double *forces, double *step)
{
    size_t n = freedoms(solid);
    double force = 0.0;
    for (size_t j = 0; j < count; j++) {
        const double *load = loads->forward + j * n;
        force += forces[j];
        if (forces[j] != 0.0)
            for (size_t i = contact_freedom(solid, j); i < n; i++)
                step[i] += forces[j] * load[i];
    }
    return force;
}

/* Displacements of free nodes rise by `step`, those of the far ones follow the force. */
static void add_displacement(struct solid *solid, const double *step, double force)
{
    for (size_t node = 0; node < solid->free_nodes; node++)
        for (size_t c = 0; c < 2; c++)
            solid->present.displacement[2 * node + c] += step[freedom(solid, node) + c];
    solid_move_far(solid, force);
}

/* The displacement of a linear solid's present forces. */
static void solid_settle(struct solid *solid)
{
    if (solid->present.settled)
        return;
    /* from none: u = -L^-T (F L^-1 p + sum_j f_j L^-1 e_j) */
    size_t n = freedoms(solid);
    double *step = solid->residual;
    memset(step, 0, n * sizeof *step);
    memset(solid->present.displacement, 0, 2 * solid->mesh->nodes * sizeof(double));
    double force =
        add_loads(solid, &solid->unloading, solid->unloading.known, solid->present.forces, step);
    for (size_t i = 0; i < n; i++)
        step[i] = -(step[i] + force * solid->pulled[i]);
    band_backward(&solid->elastic, 0, n, step);
    add_displacement(solid, step, force);
    solid->present.settled = true;
}

void solid_move(struct solid *solid, size_t count, const double *forces)
{
    size_t n = freedoms(solid);
    double *step = solid->residual;
    if (solid->linear) {
        memset(solid->present.forces, 0, solid->unloading.stride * sizeof(double));
        memcpy(solid->present.forces, forces, count * sizeof(double));
        solid->present.settled = false;
        return;
    }
    double force = add_loads(solid, present_loads(solid), count, forces, step);
    /* du = -L^-T (...), the outer freedoms by the elastic factor */
    double change = force - solid->present.force;
    for (size_t i = 0; i < n; i++)
        step[i] = -(step[i] + change * solid->boundary[i]);
    band_backward(inner_factor(solid), solid->first, n, step);
    band_carry_backward(&solid->elastic, solid->first, step, step);
    band_backward(&solid->elastic, 0, solid->first, step);
    add_displacement(solid, step, force);
}

void solid_begin(struct solid *solid)
{
    snapshot_copy(solid, &solid->start, &solid->committed);
    snapshot_copy(solid, &solid->present, &solid->committed);
}

void solid_advance(struct solid *solid)
{
    snapshot_copy(solid, &solid->start, &solid->present);
}

void solid_retreat(struct solid *solid)
{
    snapshot_copy(solid, &solid->present, &solid->start);
}

void solid_commit(struct solid *solid)
{
    snapshot_copy(solid, &solid->committed, &solid->present);
}

double solid_surface(struct solid *solid, size_t i)
{
    solid_settle(solid);
    return solid->present.displacement[2 * solid->mesh->contact.index[i] + 1];
}

/* Flow and energies. */

double solid_flow(const struct solid *solid)
{
    double most = 0.0;
    for (size_t e = 0; e < solid->zone; e++)
        for (int p = 0; p < QUAD_POINTS; p++)
            most = fmax(most, solid->present.history[e][p].accumulated);
    return most;
}

double solid_plastic_work(const struct solid *solid)
{
    /* while a point flows its equivalent stress is yield + hardening p: the integral over p */
    double work = 0.0;
    for (size_t e = 0; e < solid->zone; e++)
        for (int p = 0; p < QUAD_POINTS; p++) {
            double flow = solid->present.history[e][p].accumulated;
            if (flow > 0.0)
                work += solid->quads[e].volume[p] * flow *
                        (solid->law.yield + 0.5 * solid->law.hardening * flow);
        }
    return work;
}

double solid_elastic_energy(struct solid *solid)
{
    double energy = 0.0;
    double moduli[STRESS_COMPONENTS * STRESS_COMPONENTS];
    solid_settle(solid);
    plastic_law_moduli(&solid->law, moduli);
    for (size_t e = 0; e < solid->mesh->elements; e++) {
        double local[QUAD_FREEDOMS];
        solid_gather(solid, e, local);
        for (int p = 0; p < QUAD_POINTS; p++) {
            /* half of the elastic strain times its stress */
            double strain[STRESS_COMPONENTS];
            double density = 0.0;
            quad_strain(&solid->quads[e], p, local, strain);
            for (int i = 0; i < STRESS_COMPONENTS; i++)
                strain[i] -= solid->present.history[e][p].strain[i];
            for (int i = 0; i < STRESS_COMPONENTS; i++)
                for (int j = 0; j < STRESS_COMPONENTS; j++)
                    density += 0.5 * strain[i] * moduli[4 * i + j] * strain[j];
            energy += solid->quads[e].volume[p] * density;
        }
    }
    return energy;
}
