/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/complete_setup.h"

#include <math.h>

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
    /* every field with what is allowed */
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

enum percuss_status complete_check(const struct complete_problem *problem, struct fault *fault)
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

/* Energy into Hertz's spring, (2/5) k d^2.5; or into a constant mean pressure of 2.8 yield stresses
 * (Johnson, Contact Mechanics, section 6.3) over a spherical cap, pi p a^4 / (4 R). */
double complete_patch(const struct complete_problem *problem)
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

double complete_indentation(const struct complete_run *run)
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

enum percuss_status complete_begin(const struct complete_problem *problem, double patch,
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

void complete_end(struct complete_run *run)
{
    for (size_t b = 0; b < DYNAMICS_BODIES; b++)
        mesh_free(&run->mesh[b]);
}
