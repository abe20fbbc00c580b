/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/impact_complete.h"

#include <math.h>
#include <string.h>

/* Frictionless contact of two bodies with contact nodes at the same radii: each pair of nodes may
 * not interpenetrate. Impulses that close a pair exactly at the end of a step (Carpenter, Taylor
 * and Katona 1991): no penalty stiffness, no influence on the stable step, momentum exact. The
 * normal is the axis and nodes keep their partner: exact to (contact radius / radius of
 * curvature)^2, as small strains are. */

struct node_contact {
    size_t pairs;
    size_t *at[DYNAMICS_BODIES];    /* index into y and v of the axial coordinate, by pair */
    double *scale[DYNAMICS_BODIES]; /* 1 / sqrt(m) */
    double *gap;                    /* undeformed, m */
    double *mass;                   /* reduced mass of the pair, kg */
    double *closing;                /* rate after the last step, m/s */
    double impulse;                 /* sum so far, N s */
    double loss;   /* work of the impulses at the mean rate of a step: of closing pairs, J */
    bool outgrown; /* the outermost pair has closed: the patch was too small */
};

static bool allocate(struct node_contact *contact, struct arena *arena)
{
    contact->gap = arena_take(arena, contact->pairs, sizeof(double));
    contact->mass = arena_take(arena, contact->pairs, sizeof(double));
    contact->closing = arena_take(arena, contact->pairs, sizeof(double));
    bool ok = contact->gap && contact->mass && contact->closing;
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        contact->at[b] = arena_take(arena, contact->pairs, sizeof(size_t));
        contact->scale[b] = arena_take(arena, contact->pairs, sizeof(double));
        ok = ok && contact->at[b] && contact->scale[b];
    }
    return ok;
}

/* Pairs the first `fine` contact nodes of both bodies. OK, INTERNAL without memory, BAD_REQUEST for
 * meshes with contact nodes at different radii. */
static enum percuss_status node_contact_create(const struct dynamics *dynamics, struct arena *arena,
                                               struct node_contact *contact, struct fault *fault)
{
    *contact = (struct node_contact){.pairs = dynamics->body[0].fine};
    if (!allocate(contact, arena))
        return fault_set(fault, PERCUSS_INTERNAL, "no memory for %zu contact pairs",
                         contact->pairs);
    /* each pair's places, gap, and mass against an impulse */
    for (size_t i = 0; i < contact->pairs; i++) {
        double compliance = 0.0;
        double radius[DYNAMICS_BODIES];
        for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
            uint32_t node = dynamics->number[b][dynamics->body[b].mesh->contact.index[i]];
            contact->at[b][i] = 2 * (size_t)node + 1;
            contact->scale[b][i] = 1.0 / dynamics->root_mass[node];
            contact->gap[i] -= dynamics->at[node][1];
            compliance += contact->scale[b][i] * contact->scale[b][i];
            radius[b] = dynamics->at[node][0];
        }
        contact->mass[i] = 1.0 / compliance;
        /* pairs face each other */
        if (fabs(radius[0] - radius[1]) > 1e-9 * radius[1])
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "contact node %zu: radii %g and %g m: must be the same", i, radius[0],
                             radius[1]);
    }
    return PERCUSS_OK;
}

/* After a kick: impulses on all pairs that would otherwise overlap at the end of the smallest step.
 * Returns their sum, N s. */
static double node_contact_close(struct node_contact *contact, struct dynamics *dynamics)
{
    const double *y = dynamics->y;
    double *v = dynamics->v;
    double step = dynamics->step;
    double sum = 0.0;
    for (size_t i = 0; i < contact->pairs; i++) {
        size_t a = contact->at[0][i];
        size_t b = contact->at[1][i];
        double scale_a = contact->scale[0][i];
        double scale_b = contact->scale[1][i];
        /* gap of the pair, and the impulse that closes it by the end of the step */
        double gap = contact->gap[i] - y[a] * scale_a - y[b] * scale_b;
        double closing = v[a] * scale_a + v[b] * scale_b;
        double impulse = (closing - gap / step) * contact->mass[i];
        double before = contact->closing[i];
        /* an open pair carries no force */
        contact->closing[i] = closing;
        if (!(impulse > 0.0))
            continue;
        /* a closed one takes it, equal and opposite */
        contact->closing[i] = gap / step;
        v[a] -= impulse * scale_a;
        v[b] -= impulse * scale_b;
        contact->loss += 0.5 * impulse * (before + contact->closing[i]);
        sum += impulse;
        contact->outgrown |= i + 1 == contact->pairs;
    }
    contact->impulse += sum;
    return sum;
}

struct complete_run {
    const struct complete_problem *problem;
    struct mesh mesh[DYNAMICS_BODIES];
    struct dynamics dynamics;
    struct node_contact contact;
    double patch;                         /* contact radius meshed for, m */
    double mass[DYNAMICS_BODIES];         /* of the true bodies, kg */
    double compliance[DYNAMICS_BODIES];   /* static, of the patch, m/N */
    double duration;                      /* of the contact, expected, s */
    uint32_t *reference[DYNAMICS_BODIES]; /* the indentation is taken from their mean motion */
    size_t references[DYNAMICS_BODIES];
    double *v_before; /* as dynamics.v */
};

/* Check, meshes and start of an impact. */

/* The core reaches a little beyond the expected patch; nodes on both surfaces pair up beyond it. */
static const double CORE_REACH = 1.5;
static const double PAIR_REACH = 1.15;
static const double MATCHED_REACH = 1.2;
/* Steps over the stability limit of an element alone. Below pi/4 no wave that an element can hold
 * is in resonance with the impulses of the next level's elements. */
static const double SAFETY = 0.75;
/* growth of the rings' widths x elements along the core */
static const double GROWTH = 1.2;
/* longest element of a rod in radii x elements across the patch */
static const double ROD_ELEMENT = 4.0;
/* cylinders longer than this many radii are rods */
static const double ROD_LENGTH = 4.0;

static enum percuss_status check_body(const struct complete_body *body, const char *name,
                                      struct fault *fault)
{
    const struct material *m = &body->material;
    /* each field with its allowed range */
    const struct {
        const char *field;
        double value;
        bool fits;
        const char *allowed;
    } checks[] = {
        {"radius", body->radius, body->radius > 0.0 && isfinite(body->radius), "> 0"},
        {"length", body->length,
         body->shape == COMPLETE_SPHERE || (body->length > 0.0 && isfinite(body->length)), "> 0"},
        {"young", m->young, m->young > 0.0 && isfinite(m->young), "> 0"},
        {"poisson", m->poisson, m->poisson > -1.0 && m->poisson < 0.5, "> -1 and < 0.5"},
        {"density", m->density, m->density > 0.0 && isfinite(m->density), "> 0"},
        {"yield", m->yield, m->yield > 0.0, "> 0"},
        {"tangent", m->tangent, m->tangent >= 0.0 && m->tangent < m->young, ">= 0 and < young"},
    };
    /* the first that does not fit */
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++)
        if (!checks[i].fits)
            return fault_set(fault, PERCUSS_BAD_REQUEST, "%s.%s: %g: must be %s", name,
                             checks[i].field, checks[i].value, checks[i].allowed);
    return PERCUSS_OK;
}

/* OK, or BAD_REQUEST with the field, its value and its allowed range. */
static enum percuss_status complete_check(const struct complete_problem *problem,
                                          struct fault *fault)
{
    /* the bodies, one of them a sphere */
    enum percuss_status status = check_body(&problem->a, "a", fault);
    if (status == PERCUSS_OK)
        status = check_body(&problem->b, "b", fault);
    if (status != PERCUSS_OK)
        return status;
    if (problem->a.shape != COMPLETE_SPHERE && problem->b.shape != COMPLETE_SPHERE)
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "complete finite elements: one of the bodies must be a sphere");
    /* numbers of the impact and of its solution */
    if (!(problem->speed > 0.0 && isfinite(problem->speed)))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "speed: %g: must be > 0", problem->speed);
    if (problem->cells < 4 || problem->cells > 96)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "cells: %u: must be 4 ... 96", problem->cells);
    if (!(problem->phase >= 0.0 && problem->phase < 1.0))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "phase: %g: must be >= 0 and < 1",
                         problem->phase);
    if (!(problem->horizon > 0.0 && isfinite(problem->horizon)))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "horizon: %g: must be > 0", problem->horizon);
    return PERCUSS_OK;
}

static double mass_of(const struct complete_body *body)
{
    double volume = body->shape == COMPLETE_SPHERE
                        ? 4.0 / 3.0 * M_PI * pow(body->radius, 3)
                        : M_PI * body->radius * body->radius * body->length;
    return volume * body->material.density;
}

static double smallest_size(const struct complete_body *body)
{
    return body->shape == COMPLETE_SPHERE ? body->radius : fmin(body->radius, body->length);
}

static double curvature(const struct complete_body *body)
{
    return body->shape == COMPLETE_SPHERE ? 1.0 / body->radius : 0.0;
}

/* (1 - nu^2) / E */
static double plane_compliance(const struct material *material)
{
    return (1.0 - material->poisson * material->poisson) / material->young;
}

/* Hertz's relation of force, F = k d^1.5. */
static double hertz_stiffness(const struct complete_problem *problem, double radius)
{
    return 4.0 / 3.0 * sqrt(radius) /
           (plane_compliance(&problem->a.material) + plane_compliance(&problem->b.material));
}

static double reduced_mass(const struct complete_problem *problem)
{
    return 1.0 / (1.0 / mass_of(&problem->a) + 1.0 / mass_of(&problem->b));
}

/* Contact radius to be expected at most, m. The energy goes into Hertz's spring, (2/5) k d^2.5; or
 * into a constant mean pressure of 2.8 yield stresses (Johnson, Contact Mechanics, section 6.3)
 * over a spherical cap, pi p a^4 / (4 R). */
static double complete_patch(const struct complete_problem *problem)
{
    double radius = 1.0 / (curvature(&problem->a) + curvature(&problem->b));
    double energy = 0.5 * reduced_mass(problem) * problem->speed * problem->speed;
    double depth = pow(2.5 * energy / hertz_stiffness(problem, radius), 0.4);
    double pressure = 2.8 * fmin(problem->a.material.yield, problem->b.material.yield);
    return fmax(sqrt(radius * depth), pow(4.0 * energy * radius / (M_PI * pressure), 0.25));
}

/* Hertz's duration for rigid bodies, 2.9432 d/v. */
static double hertz_duration(const struct complete_problem *problem)
{
    double radius = 1.0 / (curvature(&problem->a) + curvature(&problem->b));
    double energy = 0.5 * reduced_mass(problem) * problem->speed * problem->speed;
    double depth = pow(2.5 * energy / hertz_stiffness(problem, radius), 0.4);
    return 2.9432 * depth / problem->speed;
}

/* Static compliance of the patch of a free body without its rigid motion, from above: that of a
 * rigid punch on the patch; L/(3EA) along a cylinder; the bending of a disc held at its rim, P r^2
 * (3 + nu) / (16 pi D (1 + nu)), which is more than that of a free one. By it, no vibration of
 * energy U moves the patch by more than sqrt(2 U c). */
static double vibration_compliance(const struct complete_body *body, double patch)
{
    double near = 0.5 * plane_compliance(&body->material) / patch;
    if (body->shape == COMPLETE_SPHERE)
        return near;
    double nu = body->material.poisson;
    double square = body->radius * body->radius;
    double rigidity = pow(body->length, 3) / (12.0 * plane_compliance(&body->material));
    double along = body->length / (3.0 * body->material.young * M_PI * square);
    double bending = square * (3.0 + nu) / (16.0 * M_PI * rigidity * (1.0 + nu));
    return near + along + bending;
}

static enum percuss_status make_mesh(const struct complete_body *body,
                                     const struct mesh_grade *grade, struct mesh *mesh,
                                     struct fault *fault)
{
    if (body->shape == COMPLETE_SPHERE)
        return mesh_sphere(body->radius, grade, mesh, fault);
    return mesh_cylinder(body->radius, body->length, grade, mesh, fault);
}

/* The nodes of a rod's section one radius below the face; of other bodies all. */
static bool find_reference(struct complete_run *run, size_t b, struct arena *arena)
{
    const struct complete_body *body = b ? &run->problem->b : &run->problem->a;
    const struct mesh *mesh = &run->mesh[b];
    bool rod = body->shape == COMPLETE_CYLINDER && body->length > ROD_LENGTH * body->radius;
    run->reference[b] = arena_take(arena, mesh->nodes, sizeof **run->reference);
    for (size_t i = 0; run->reference[b] && i < mesh->nodes; i++)
        if (!rod || fabs(mesh->z[i] + body->radius) < 1e-9 * body->radius)
            run->reference[b][run->references[b]++] = run->dynamics.number[b][i];
    return run->references[b] > 0;
}

/* Approach of the two references, m. */
static double complete_indentation(const struct complete_run *run)
{
    double sum = 0.0;
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        double mass = 0.0;
        double moment = 0.0;
        for (size_t i = 0; i < run->references[b]; i++) {
            uint32_t node = run->reference[b][i];
            double root = run->dynamics.root_mass[node];
            mass += root * root;
            moment += root * run->dynamics.y[2 * node + 1];
        }
        sum += moment / mass;
    }
    return sum;
}

static size_t nodes_within(const struct mesh *mesh, double radius)
{
    size_t count = 0;
    while (count < mesh->contact.count && mesh->r[mesh->contact.index[count]] <= radius)
        count++;
    return count;
}

/* Meshes both bodies around a patch and launches A. complete_end frees the meshes in any case; all
 * other memory is the arena's. */
static enum percuss_status complete_begin(const struct complete_problem *problem, double patch,
                                          struct arena *arena, struct complete_run *run,
                                          struct fault *fault)
{
    const struct complete_body *bodies[DYNAMICS_BODIES] = {&problem->a, &problem->b};
    struct dynamics_body parts[DYNAMICS_BODIES];
    /* elements around the patch, alike in both bodies */
    size_t core = (size_t)ceil(CORE_REACH * problem->cells);
    double side = CORE_REACH * patch;
    struct mesh_grade grade = {.size = side / (double)core,
                               .core = core,
                               .growth = 1.0 + GROWTH / (double)core,
                               .matched = MATCHED_REACH * side};
    *run = (struct complete_run){.problem = problem, .patch = patch};
    run->duration = hertz_duration(problem);
    /* a mesh of each body, no smaller than the patch allows */
    enum percuss_status status = PERCUSS_OK;
    for (size_t b = 0; b < DYNAMICS_BODIES && status == PERCUSS_OK; b++) {
        double size = smallest_size(bodies[b]);
        if (!(side <= 0.4 * size))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "speed: %g: gives a contact radius of some %.3g m in a body of %g m: "
                             "must stay below a quarter of it",
                             problem->speed, patch, size);
        grade.coarse = ROD_ELEMENT * bodies[b]->radius / problem->cells;
        status = make_mesh(bodies[b], &grade, &run->mesh[b], fault);
        run->mass[b] = mass_of(bodies[b]);
        run->compliance[b] = vibration_compliance(bodies[b], patch);
        parts[b] = (struct dynamics_body){.mesh = &run->mesh[b],
                                          .material = bodies[b]->material,
                                          .rate = bodies[b]->rate,
                                          .mass = run->mass[b],
                                          .fine = nodes_within(&run->mesh[b], PAIR_REACH * side)};
    }
    /* equations of motion and pairs of nodes */
    if (status == PERCUSS_OK && !pace_ask(problem->pace, problem->done))
        status = fault_set(fault, PERCUSS_TIMEOUT, "stopped before the impact");
    if (status == PERCUSS_OK)
        status = dynamics_create(parts, SAFETY, arena, &run->dynamics, fault);
    if (status == PERCUSS_OK)
        status = node_contact_create(&run->dynamics, arena, &run->contact, fault);
    if (status != PERCUSS_OK)
        return status;
    /* a flies, b rests */
    run->v_before = arena_take(arena, 2 * run->dynamics.nodes, sizeof(double));
    if (!run->v_before || !find_reference(run, 0, arena) || !find_reference(run, 1, arena))
        return fault_set(fault, PERCUSS_INTERNAL, "no memory for %zu nodes", run->dynamics.nodes);
    dynamics_launch(&run->dynamics, 0, problem->speed);
    return PERCUSS_OK;
}

static void complete_end(struct complete_run *run)
{
    for (size_t b = 0; b < DYNAMICS_BODIES; b++)
        mesh_free(&run->mesh[b]);
}

/* The run and its result. */

/* Part of the available energy that the balance may miss. Steps leave up to 1.5e-3 on coarse
 * meshes, falling with their square; more is a mistake. */
static const double ENERGY_KEPT = 1e-2;

/* Part told as done once twice the duration expected has passed: the end may come at any time. */
static const double NEARLY_DONE = 0.99;

/* State of a run, beyond its setup. */
struct progress {
    struct complete_run run;
    size_t n;            /* smallest steps done */
    double quiet;        /* s: shorter openings do not divide a contact */
    bool open;           /* a sub-impact is under way */
    double last_touch;   /* s */
    double window_start; /* s, of the mean of the force */
    double window_impulse;
    struct complete_result *result;
};

static double now(const struct progress *progress)
{
    return (double)progress->n * progress->run.dynamics.step;
}

static struct complete_sub_impact *current(struct progress *progress)
{
    size_t count = progress->result->sub_impacts;
    size_t last = count < COMPLETE_SUB_IMPACTS ? count : COMPLETE_SUB_IMPACTS;
    return &progress->result->sub_impact[last - 1];
}

static void close_sub_impact(struct progress *progress)
{
    if (progress->open)
        current(progress)->end = progress->last_touch;
    progress->open = false;
}

/* An impulse between now and the end of the step. */
static void note_touch(struct progress *progress, double impulse)
{
    struct complete_result *result = progress->result;
    double time = now(progress);
    if (!progress->open) {
        progress->open = true;
        if (result->sub_impacts++ < COMPLETE_SUB_IMPACTS)
            current(progress)->start = time;
    }
    current(progress)->impulse += impulse;
    progress->last_touch = time + progress->run.dynamics.step;
    progress->window_impulse += impulse;
}

/* One step of the coarsest level: all nodes meet before and after it. */
static void advance(struct progress *progress)
{
    struct dynamics *dynamics = &progress->run.dynamics;
    size_t period = dynamics_period(dynamics);
    for (size_t i = 0; i < period; i++) {
        dynamics_kick(dynamics, progress->n);
        double impulse = node_contact_close(&progress->run.contact, dynamics);
        if (impulse > 0.0)
            note_touch(progress, impulse);
        dynamics_drift(dynamics, progress->n);
        progress->n++;
    }
}

/* Radius of the outermost pair that has no gap. */
static double touching_radius(const struct complete_run *run)
{
    const struct node_contact *contact = &run->contact;
    const double *y = run->dynamics.y;
    double radius = 0.0;
    for (size_t i = 0; i < contact->pairs; i++) {
        double gap = contact->gap[i] - y[contact->at[0][i]] * contact->scale[0][i] -
                     y[contact->at[1][i]] * contact->scale[1][i];
        if (gap <= 1e-9 * run->patch)
            radius = run->dynamics.at[contact->at[0][i] / 2][0];
    }
    return radius;
}

/* Mean force since the last look: long enough for the closing of single nodes to vanish in it. */
static void look(struct progress *progress)
{
    struct complete_result *result = progress->result;
    const struct complete_problem *problem = progress->run.problem;
    double time = now(progress);
    double span = time - progress->window_start;
    /* open for long enough: the sub-impact is over */
    if (progress->open && time - progress->last_touch > progress->quiet)
        close_sub_impact(progress);
    /* means since the last look */
    struct complete_sample sample = {.time = time,
                                     .force = progress->window_impulse / span,
                                     .indentation = complete_indentation(&progress->run),
                                     .radius = touching_radius(&progress->run)};
    progress->window_start = time;
    progress->window_impulse = 0.0;
    /* the largest of each, of all and of the sub-impact under way */
    result->peak_force = fmax(result->peak_force, sample.force);
    if (sample.force > 0.0) {
        struct complete_sub_impact *here = current(progress);
        here->peak_force = fmax(here->peak_force, sample.force);
        if (sample.indentation > here->max_indentation) {
            here->max_indentation = sample.indentation;
            here->compression_end = time;
            here->compression_impulse = here->impulse;
        }
        result->contact_radius = fmax(result->contact_radius, sample.radius);
        result->max_indentation = fmax(result->max_indentation, sample.indentation);
    }
    /* the caller's record */
    if (problem->sample)
        problem->sample(problem->context, &sample);
}

/* Rate at which the bodies' mean motions part, m/s, when all nodes meet. */
static double parting(const struct complete_run *run)
{
    double sum = 0.0;
    for (size_t b = 0; b < DYNAMICS_BODIES; b++)
        sum -= dynamics_mean(&run->dynamics, b, run->dynamics.v);
    return sum;
}

/* Whether the gap of the mean motions exceeds all that vibration can bridge: a displacement u of a
 * patch costs at least u^2/(2c). */
static bool is_over(const struct progress *progress)
{
    const struct complete_run *run = &progress->run;
    if (progress->open || progress->result->sub_impacts == 0 || !(parting(run) > 0.0))
        return false;
    struct dynamics_energy energy = dynamics_energy(&run->dynamics, run->dynamics.v);
    double gap = 0.0;
    double reach = 0.0;
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        gap -= dynamics_mean(&run->dynamics, b, run->dynamics.y);
        reach += sqrt(2.0 * (energy.vibration[b] + energy.strain[b]) * run->compliance[b]);
    }
    return gap > reach;
}

/* Energies now: velocities half a step either side, so one more kick is given and not flown. */
static void audit(struct progress *progress)
{
    struct complete_run *run = &progress->run;
    struct dynamics *dynamics = &run->dynamics;
    struct complete_energy *total = &progress->result->energy;
    /* one more kick, so that velocities on both sides of this instant are known */
    memcpy(run->v_before, dynamics->v, 2 * dynamics->nodes * sizeof(double));
    double rate = parting(run);
    dynamics_kick(dynamics, progress->n);
    node_contact_close(&run->contact, dynamics);
    struct dynamics_energy energy = dynamics_energy(dynamics, run->v_before);
    /* of the relative motion, by the mean of both rates */
    double reduced = 1.0 / (1.0 / run->mass[0] + 1.0 / run->mass[1]);
    double speed = run->problem->speed;
    rate = 0.5 * (rate + parting(run));
    total->available = 0.5 * reduced * speed * speed;
    total->rebound = 0.5 * reduced * rate * rate;
    total->contact = run->contact.loss;
    /* energy held by each body */
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        total->vibration_of[b] = energy.vibration[b] + energy.strain[b];
        total->vibration += total->vibration_of[b];
        total->plastic += energy.plastic[b];
    }
    /* and the missing rest */
    total->closure =
        total->available - total->rebound - total->vibration - total->plastic - total->contact;
}

/* Fills the result; an answer that does not keep the energy is refused. */
static enum percuss_status summarize(struct progress *progress, struct fault *fault)
{
    const struct complete_run *run = &progress->run;
    const struct dynamics *dynamics = &run->dynamics;
    struct complete_result *result = progress->result;
    close_sub_impact(progress);
    /* impulse, restitution by it, and its difference from the change of momentum */
    result->impulse = run->contact.impulse;
    result->restitution =
        result->impulse * (1.0 / run->mass[0] + 1.0 / run->mass[1]) / run->problem->speed - 1.0;
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        double start = b == 0 ? run->problem->speed : 0.0;
        double change = run->mass[b] * (dynamics_mean(dynamics, b, dynamics->v) - start);
        result->mass[b] = run->mass[b];
        result->momentum_error =
            fmax(result->momentum_error, fabs(change + result->impulse) / result->impulse);
    }
    /* time in contact, of the listed sub-impacts */
    size_t listed =
        result->sub_impacts < COMPLETE_SUB_IMPACTS ? result->sub_impacts : COMPLETE_SUB_IMPACTS;
    for (size_t i = 0; i < listed; i++)
        result->contact_time += result->sub_impact[i].end - result->sub_impact[i].start;
    /* effort */
    result->end_time = now(progress);
    result->elements = dynamics->elements;
    result->levels = dynamics->levels;
    result->step = dynamics->step;
    result->steps = progress->n;
    for (size_t e = 0; e < dynamics->elements; e++)
        result->plastic_elements += dynamics->plastic[e];
    /* the balance */
    audit(progress);
    double lost = result->energy.closure / result->energy.available;
    if (!(fabs(lost) <= ENERGY_KEPT))
        return fault_set(fault, PERCUSS_INTERNAL,
                         "complete finite elements: %.2g of the energy is unaccounted for", lost);
    return PERCUSS_OK;
}

/* Runs to its end, or until the patch turns out too small. */
static enum percuss_status march(struct progress *progress, struct fault *fault)
{
    struct complete_run *run = &progress->run;
    const struct complete_problem *problem = run->problem;
    while (!run->contact.outgrown) {
        advance(progress);
        double time = now(progress);
        double part = fmin(time / (2.0 * run->duration), NEARLY_DONE);
        if (!pace_ask(problem->pace, problem->done + problem->share * part))
            return fault_set(fault, PERCUSS_TIMEOUT, "stopped at %g s of the impact", time);
        /* stresses grow with the root of time at first, slowly later: no element can pass from
         * well below yield to beyond it between two looks */
        if (time - progress->window_start < fmin(progress->quiet, 0.1 * time) &&
            time < problem->horizon)
            continue;
        /* elements that come near yield, and the contact */
        dynamics_watch_yield(&run->dynamics);
        look(progress);
        /* the end of the impact, if vibration cannot bridge the gap */
        if (is_over(progress)) {
            progress->result->end = PERCUSS_END_SEPARATED;
            return PERCUSS_OK;
        }
        if (time >= problem->horizon) {
            progress->result->end = progress->open ? PERCUSS_END_IN_CONTACT : PERCUSS_END_HORIZON;
            return PERCUSS_OK;
        }
    }
    return PERCUSS_OK;
}

/* time that shear waves need across the patch */
static double quiet_time(const struct complete_run *run)
{
    double longest = 0.0;
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        const struct material *material = &run->dynamics.body[b].material;
        longest = fmax(longest, 2.0 * run->patch *
                                    sqrt(material->density / material_shear_modulus(material)));
    }
    return longest;
}

static enum percuss_status solve_with_patch(const struct complete_problem *problem, double patch,
                                            struct complete_result *result, bool *outgrown,
                                            struct fault *fault)
{
    struct arena arena = {0};
    struct progress progress = {.result = result};
    *result = (struct complete_result){0};
    enum percuss_status status = complete_begin(problem, patch, &arena, &progress.run, fault);
    if (status == PERCUSS_OK) {
        progress.quiet = quiet_time(&progress.run);
        status = march(&progress, fault);
        *outgrown = progress.run.contact.outgrown;
    }
    if (status == PERCUSS_OK && !*outgrown)
        status = summarize(&progress, fault);
    complete_end(&progress.run);
    arena_release(&arena);
    return status;
}

enum percuss_status impact_complete_solve(const struct complete_problem *problem,
                                          struct complete_result *result, struct fault *fault)
{
    enum percuss_status status = complete_check(problem, fault);
    if (status != PERCUSS_OK)
        return status;
    bool outgrown = true;
    double shift = (problem->phase < 0.5 ? problem->phase : problem->phase - 1.0) / problem->cells;
    for (double patch = complete_patch(problem) / (1.0 - shift); outgrown; patch *= 1.5) {
        status = solve_with_patch(problem, patch, result, &outgrown, fault);
        if (status != PERCUSS_OK)
            return status;
    }
    return PERCUSS_OK;
}
