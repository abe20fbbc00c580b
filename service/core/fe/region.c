/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/region.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "fe/active_set.h"
#include "fe/mesh.h"
#include "fe/solid.h"

/* Of the contact radius at the largest load, the least that elements are made for. */
static const double REGION_FINEST = 1e-3;

/* Start of a step. */
struct contact_state {
    double indentation, force;
    double *forces; /* by contact node */
    bool *active;
};

struct region {
    struct mesh mesh;
    struct quad *quads;
    struct solid *solids[2];
    size_t candidates; /* contact nodes that may ever touch */
    size_t count;      /* of them, those looked at now */
    double *gaps;      /* of the virgin surfaces, m */
    struct contact_state committed, start, present;
    double stiffness;
    double peak;        /* N */
    double top;         /* m, contact radius at the largest load */
    double first_yield; /* m, contact radius at which a body first flows */
    double *offsets, *compliance, *more, *initial, *scratch;
    struct region_effort effort;
    struct pace *pace; /* NULL: none */
    double done;       /* reported to it */
};

/* The point load's field at the boundary leaves out terms that fall off with the square and cube of
 * the distance: at 30 contact radii a thousandth of the indentation. */
static const double EXTENT = 30.0;

static double plane_modulus(const struct material *material)
{
    return material->young / (1.0 - material->poisson * material->poisson);
}

/* Contact radius at which the weaker body first yields: p0 = 1.6 yield (Johnson, section 6.1), a =
 * pi p0 R / (2 E*). */
static double first_yield_radius(const struct region_input *input)
{
    double modulus = 1.0 / (1.0 / plane_modulus(&input->materials[0]) +
                            1.0 / plane_modulus(&input->materials[1]));
    double yield = fmin(input->materials[0].yield, input->materials[1].yield);
    return 0.5 * M_PI * 1.6 * yield * input->radius / modulus;
}

static enum percuss_status check_input(const struct region_input *input, struct fault *fault)
{
    if (!(input->radius > 0.0 && isfinite(input->radius)))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "contact radius: %g m: must be > 0",
                         input->radius);
    /* small strains, flat surfaces: the contact radius stays below a fifth of the bodies' */
    if (!(input->indentation > 0.0 && input->indentation <= 0.02 * input->radius))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "indentation: %g m: must be > 0 and at most 0.02 of the radius %g m",
                         input->indentation, input->radius);
    if (input->resolution < 4 || input->resolution > 60)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "resolution: %zu: must be 4 ... 60",
                         input->resolution);
    if (!(input->phase >= 0.0 && input->phase < 1.0))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "phase: %g: must be 0 <= phase < 1",
                         input->phase);
    /* elastic constants, and a yield with hardening below the modulus */
    for (int i = 0; i < 2; i++) {
        const struct material *m = &input->materials[i];
        if (!(m->young > 0.0 && m->poisson > -1.0 && m->poisson < 0.5 && m->yield > 0.0 &&
              m->tangent >= 0.0 && m->tangent < m->young))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "material %s: young %g, poisson %g, yield %g, tangent %g: must be "
                             "> 0, in (-1, 0.5), > 0, in [0, young)",
                             m->name, m->young, m->poisson, m->yield, m->tangent);
    }
    return PERCUSS_OK;
}

/* Elements about 1/resolution of the contact radius at every load from first yield to the largest:
 * the core lies within the smallest, rings grow with their radius. */
static enum percuss_status make_mesh(struct region *region, const struct region_input *input,
                                     struct fault *fault)
{
    /* contact radii at the largest load and at first yield */
    double top = region->top = sqrt(2.0 * input->radius * input->indentation);
    region->first_yield = first_yield_radius(input);
    double low = fmax(fmin(region->first_yield, 0.4 * top), REGION_FINEST * top);
    double core = (double)input->resolution;
    struct mesh_grade grade = {
        .size = 0.7 * low / core, .core = input->resolution, .growth = 1.0 + 0.25 * M_PI / core};
    /* the whole mesh larger by the phase's part of a ring */
    double scale = pow(grade.growth, input->phase);
    grade.size *= scale;
    enum percuss_status status =
        mesh_half_space(EXTENT * top * scale, &grade, &region->mesh, fault);
    if (status != PERCUSS_OK)
        return status;
    /* nodes that may come to touch */
    const struct mesh_nodes *contact = &region->mesh.contact;
    while (region->candidates < contact->count &&
           region->mesh.r[contact->index[region->candidates]] < 1.5 * top)
        region->candidates++;
    region->candidates += 4; /* beyond the last that is to carry force */
    /* elements */
    region->quads = malloc(region->mesh.elements * sizeof *region->quads);
    if (!region->quads)
        return fault_set(fault, PERCUSS_INTERNAL, "contact region: no memory");
    for (size_t e = 0; e < region->mesh.elements; e++) {
        double r[4], z[4];
        for (int i = 0; i < 4; i++) {
            r[i] = region->mesh.r[region->mesh.quads[e][i]];
            z[i] = region->mesh.z[region->mesh.quads[e][i]];
        }
        if (!quad_make(r, z, &region->quads[e]))
            return fault_set(fault, PERCUSS_INTERNAL, "contact region: element %zu is not convex",
                             e);
    }
    return PERCUSS_OK;
}

static bool state_make(struct contact_state *state, size_t n)
{
    state->forces = calloc(n, sizeof *state->forces);
    state->active = calloc(n, sizeof *state->active);
    return state->forces && state->active;
}

static void state_free(struct contact_state *state)
{
    free(state->forces);
    free(state->active);
}

static bool make_work(struct region *region, const struct region_input *input)
{
    size_t n = region->candidates;
    /* arrays */
    region->gaps = calloc(n, sizeof(double));
    region->offsets = calloc(n, sizeof(double));
    region->initial = calloc(n, sizeof(double));
    region->compliance = calloc(n * n, sizeof(double));
    region->more = calloc(n * n, sizeof(double));
    region->scratch = calloc((n + 1) * (n + 3), sizeof(double));
    if (!region->gaps || !region->offsets || !region->initial || !region->compliance ||
        !region->more || !region->scratch || !state_make(&region->committed, n) ||
        !state_make(&region->start, n) || !state_make(&region->present, n))
        return false;
    /* gap of the virgin surfaces: a parabola */
    for (size_t i = 0; i < n; i++) {
        double r = region->mesh.r[region->mesh.contact.index[i]];
        region->gaps[i] = 0.5 * r * r / input->radius;
    }
    /* both half-spaces */
    for (int i = 0; i < 2; i++) {
        region->solids[i] = solid_create(&region->mesh, region->quads, &input->materials[i], n);
        if (!region->solids[i])
            return false;
    }
    return true;
}

enum percuss_status region_create(const struct region_input *input, struct region **region,
                                  struct fault *fault)
{
    *region = NULL;
    enum percuss_status status = check_input(input, fault);
    if (status != PERCUSS_OK)
        return status;
    /* all of it, or nothing */
    struct region *made = calloc(1, sizeof *made);
    if (!made)
        return fault_set(fault, PERCUSS_INTERNAL, "contact region: no memory");
    status = make_mesh(made, input, fault);
    if (status == PERCUSS_OK && !make_work(made, input))
        status = fault_set(fault, PERCUSS_INTERNAL, "contact region: no memory");
    if (status != PERCUSS_OK) {
        region_destroy(made);
        return status;
    }
    made->effort.nodes = 2 * made->mesh.nodes;
    *region = made;
    return PERCUSS_OK;
}

void region_destroy(struct region *region)
{
    if (!region)
        return;
    solid_destroy(region->solids[0]);
    solid_destroy(region->solids[1]);
    mesh_free(&region->mesh);
    free(region->quads);
    free(region->gaps);
    free(region->offsets);
    free(region->initial);
    free(region->compliance);
    free(region->more);
    free(region->scratch);
    state_free(&region->committed);
    state_free(&region->start);
    state_free(&region->present);
    free(region);
}

enum { NEWTON_MAX = 25, HALVINGS_MAX = 8 };

/* Allowed imbalance over the largest force so far: where curves are drawn from the states, and in
 * series with bodies, where steps are much coarser. */
static const double BALANCED = 1e-9;
static const double BALANCED_IN_SERIES = 1e-6;

static void state_copy(size_t n, struct contact_state *to, const struct contact_state *from)
{
    memcpy(to->forces, from->forces, n * sizeof *to->forces);
    memcpy(to->active, from->active, n * sizeof *to->active);
    to->indentation = from->indentation;
    to->force = from->force;
}

/* Prescribed quantity of an equilibrium. */
struct target {
    enum { BY_APPROACH, BY_FORCE, BY_EDGE, WITHOUT_CONTACT } kind;
    double value;
    double softness; /* m/N, of a spring in series, BY_APPROACH; 0: none */
    size_t node;
    bool loading; /* the step is expected to press further */
};

/* linearised surfaces of both bodies, added; the spring gives way under every node's force */
static bool linearise(struct region *region, double softness, bool loading)
{
    size_t n = region->count;
    if (!solid_linearise(region->solids[0], n, loading, region->offsets, region->compliance) ||
        !solid_linearise(region->solids[1], n, loading, region->initial, region->more))
        return false;
    for (size_t i = 0; i < n; i++)
        region->initial[i] = region->gaps[i] - region->offsets[i] - region->initial[i];
    for (size_t i = 0; i < n * n; i++)
        region->compliance[i] += region->more[i] + softness;
    return true;
}

/* the linearised contact, on more nodes should it reach the last ones */
static bool solve_contact(struct region *region, const struct target *target, bool loading)
{
    struct contact_state *state = &region->present;
    /* surfaces apart: nothing to be found but their places */
    if (target->kind == WITHOUT_CONTACT) {
        memset(state->forces, 0, region->candidates * sizeof *state->forces);
        memset(state->active, 0, region->candidates * sizeof *state->active);
        state->force = 0.0;
        return linearise(region, 0.0, false);
    }
    for (;;) {
        /* which nodes touch, and their forces */
        static const enum active_set_kind kinds[] = {ACTIVE_SET_BY_INDENTATION, ACTIVE_SET_BY_TOTAL,
                                                     ACTIVE_SET_BY_EDGE};
        struct active_set set = {.kind = kinds[target->kind],
                                 .edge = target->node,
                                 .count = region->count,
                                 .compliance = region->compliance,
                                 .initial = region->initial,
                                 .indentation = target->value,
                                 .total = target->value,
                                 .force = state->forces,
                                 .active = state->active,
                                 .scratch = region->scratch};
        if (!linearise(region, target->softness, loading) || !active_set_solve(&set))
            return false;
        /* done where two more nodes beyond the rim stay open */
        state->indentation = set.indentation - target->softness * set.total;
        state->force = set.total;
        region->stiffness = set.stiffness / (1.0 - target->softness * set.stiffness);
        size_t last = region->count;
        while (last > 0 && !state->active[last - 1])
            last--;
        if (last + 2 <= region->count)
            return true;
        /* then on more of them */
        if (region->count == region->candidates)
            return false;
        region->count += 4 + region->count / 8;
        if (region->count > region->candidates)
            region->count = region->candidates;
    }
}

/* Newton's method from the present state; the histories' step starts at `start`. */
static bool equilibrate(struct region *region, const struct target *target)
{
    /* a few nodes to begin with */
    if (region->count == 0)
        region->count = region->candidates < 6 ? region->candidates : 6;
    if (target->kind == BY_EDGE && region->count < target->node + 3)
        region->count = target->node + 3;
    double balanced = target->softness != 0.0 ? BALANCED_IN_SERIES : BALANCED;
    for (int i = 0; i < NEWTON_MAX && pace_ask(region->pace, region->done); i++) {
        /* out of balance */
        double worst = 0.0;
        for (int k = 0; k < 2; k++)
            worst = fmax(worst,
                         solid_balance(region->solids[k], region->count, region->present.forces));
        double scale = fmax(region->peak, region->present.force);
        /* in balance, and nothing flows that was taken for elastic: an equilibrium */
        if (i > 0 && worst <= balanced * scale) {
            bool grew = solid_zone_grew(region->solids[0]);
            grew |= solid_zone_grew(region->solids[1]);
            if (!grew)
                return true;
        }
        /* a Newton step: contact forces of the linearised bodies, then displacements */
        if (!isfinite(worst) || !solve_contact(region, target, target->loading && i == 0))
            return false;
        region->effort.newton_steps++;
        for (int k = 0; k < 2; k++)
            solid_move(region->solids[k], region->count, region->present.forces);
    }
    return false;
}

void region_watch(struct region *region, struct pace *pace, double done)
{
    region->pace = pace;
    region->done = done;
}

static void begin(struct region *region)
{
    state_copy(region->candidates, &region->start, &region->committed);
    state_copy(region->candidates, &region->present, &region->committed);
    for (int k = 0; k < 2; k++)
        solid_begin(region->solids[k]);
}

static void retreat(struct region *region)
{
    state_copy(region->candidates, &region->present, &region->start);
    for (int k = 0; k < 2; k++)
        solid_retreat(region->solids[k]);
}

static void advance(struct region *region)
{
    state_copy(region->candidates, &region->start, &region->present);
    for (int k = 0; k < 2; k++)
        solid_advance(region->solids[k]);
}

static bool is_loading(const struct region *region, const struct target *target)
{
    switch (target->kind) {
    case BY_APPROACH:
        return target->value > region->start.indentation + target->softness * region->start.force;
    case BY_FORCE:
        return target->value > region->start.force;
    case BY_EDGE:
        return !region->start.active[target->node];
    default:
        return false;
    }
}

/* Newton's method failed in steps however short. Where bodies flow long before the finest element
 * is in contact, it does. */
static enum percuss_status region_refuse(const struct region *region, const struct target *target,
                                         double value, struct fault *fault)
{
    if (region->first_yield < REGION_FINEST * region->top)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "material: yield: a body flows from a contact radius of %.3g m on, %.2g "
                         "of the %.3g m to come: a contact region of finite elements bears %g: "
                         "another contact_model, or a higher yield",
                         region->first_yield, region->first_yield / region->top, region->top,
                         REGION_FINEST);
    return fault_set(fault, PERCUSS_INTERNAL, "contact region: no equilibrium at %s %g",
                     target->kind == BY_FORCE ? "the force" : "the indentation", value);
}

/* From the committed state to the target, in halves of halves where Newton's method fails. */
static enum percuss_status reach(struct region *region, const struct target *target,
                                 struct fault *fault)
{
    begin(region);
    double from = target->kind == BY_FORCE
                      ? region->committed.force
                      : region->committed.indentation + target->softness * region->committed.force;
    double part = 1.0;
    for (double done = 0.0; done < 1.0;) {
        /* as far as this part of the way goes */
        struct target next = *target;
        next.loading = is_loading(region, target);
        double until = fmin(done + part, 1.0);
        if (target->kind == BY_APPROACH || target->kind == BY_FORCE)
            next.value = until < 1.0 ? from + until * (target->value - from) : target->value;
        /* there: on from here */
        if (equilibrate(region, &next)) {
            done = until;
            region->peak = fmax(region->peak, region->present.force);
            if (done < 1.0)
                advance(region);
            continue;
        }
        /* not there: half as far, from where it was */
        retreat(region);
        if (pace_status(region->pace))
            return fault_set(fault, PERCUSS_TIMEOUT, "contact region: stopped");
        part *= 0.5;
        if (part < ldexp(1.0, -HALVINGS_MAX) || target->kind == BY_EDGE)
            return region_refuse(region, target, next.value, fault);
    }
    /* far from the boundary of the mesh still */
    for (int k = 0; k < 2; k++)
        if (!solid_fits(region->solids[k]))
            return fault_set(fault, PERCUSS_INTERNAL,
                             "contact region: the plastic zone outgrows the mesh");
    return PERCUSS_OK;
}

static void answer_fill(const struct region *region, struct region_answer *answer)
{
    *answer = (struct region_answer){.indentation = region->present.indentation,
                                     .force = region->present.force,
                                     .stiffness = region->stiffness};
    for (size_t i = region->count; i-- > 0;)
        if (region->present.active[i]) {
            answer->radius = region->mesh.r[region->mesh.contact.index[i]];
            break;
        }
}

enum percuss_status region_press(struct region *region, double indentation,
                                 struct region_answer *answer, struct fault *fault)
{
    return region_approach(region, indentation, 0.0, answer, fault);
}

enum percuss_status region_approach(struct region *region, double approach, double softness,
                                    struct region_answer *answer, struct fault *fault)
{
    struct target target = {.kind = BY_APPROACH, .value = approach, .softness = softness};
    enum percuss_status status = reach(region, &target, fault);
    answer_fill(region, answer);
    return status;
}

enum percuss_status region_load(struct region *region, double force, struct region_answer *answer,
                                struct fault *fault)
{
    struct target target = {.kind = BY_FORCE, .value = force};
    enum percuss_status status = reach(region, &target, fault);
    answer_fill(region, answer);
    return status;
}

double region_edge_radius(const struct region *region, size_t node)
{
    return node + 3 > region->candidates ? INFINITY
                                         : region->mesh.r[region->mesh.contact.index[node]];
}

enum percuss_status region_edge(struct region *region, size_t node, struct region_answer *answer,
                                struct fault *fault)
{
    struct target target = {.kind = BY_EDGE, .node = node};
    *answer = (struct region_answer){0};
    if (node == 0 || isinf(region_edge_radius(region, node)))
        return fault_set(fault, PERCUSS_INTERNAL, "contact region: no contact node %zu", node);
    enum percuss_status status = reach(region, &target, fault);
    if (status != PERCUSS_OK)
        return status;
    answer_fill(region, answer);
    answer->radius =
        0.5 * (region_edge_radius(region, node) + region_edge_radius(region, node - 1));
    for (size_t i = 0; i < node; i++)
        if (!(region->present.forces[i] >= 0.0))
            return fault_set(fault, PERCUSS_INTERNAL,
                             "contact region: node %zu pulls with the edge at %zu", i, node);
    return PERCUSS_OK;
}

void region_commit(struct region *region)
{
    state_copy(region->candidates, &region->committed, &region->present);
    for (int k = 0; k < 2; k++)
        solid_commit(region->solids[k]);
}

enum percuss_status region_touch(struct region *region, double *indentation, struct fault *fault)
{
    struct target target = {.kind = WITHOUT_CONTACT};
    enum percuss_status status = reach(region, &target, fault);
    *indentation = INFINITY;
    for (size_t i = 0; i < region->candidates; i++)
        *indentation = fmin(*indentation, region->gaps[i] - solid_surface(region->solids[0], i) -
                                              solid_surface(region->solids[1], i));
    region->present.indentation = *indentation;
    return status;
}

void region_ledger(const struct region *region, struct region_ledger *ledger)
{
    for (int k = 0; k < 2; k++) {
        ledger->flow[k] = solid_flow(region->solids[k]);
        ledger->plastic[k] = solid_plastic_work(region->solids[k]);
        ledger->elastic[k] = solid_elastic_energy(region->solids[k]);
    }
}

struct region_effort region_effort(const struct region *region)
{
    return region->effort;
}
