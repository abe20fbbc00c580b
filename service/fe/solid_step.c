/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <string.h>

#include "fe/solid_parts.h"

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
    /* a hair below, so that what lies on the yield surface counts as flowing */
    struct plastic_law law = solid->law;
    if (loading)
        law.yield *= 1.0 - 1e-8;
    /* only what lies within `outermost` is softer than what is factored */
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

/* forward solution whose part before `first` is elastic */
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

/* Those of contact nodes that are not known yet. */
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
        /* what it has in common with those farther in, and with the boundary */
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

void solid_settle(struct solid *solid)
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
