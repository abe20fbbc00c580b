/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Requests that finite elements answer: complete ones mesh both bodies (fe/impact_complete.h), for
 * one central impact of two bodies at rest but for their approach; concurrent ones mesh the contact
 * region and solve it in each time step, beside the bodies' modes (impact/concurrent.h). */
#ifndef PERCUSS_SOLVE_FINITE_ELEMENT_H
#define PERCUSS_SOLVE_FINITE_ELEMENT_H

#include "base/watch.h"
#include "fe/swing.h"
#include "solve/result.h"
#include "solve/solution.h"

/* Solves on meshes of 4, 8 and 16 elements across the contact radius, with three or six places of
 * the nodes each, until the estimated error of the restitution fits the tolerance
 * (fe/complete_converge.h); answers with the mean of the finest mesh's phases. `pace` is told the
 * part done, and stops it with TIMEOUT. Fills `result`, status and message too, and returns the
 * status: BAD_REQUEST and UNSUPPORTED_GEOMETRY name the member that is not axisymmetric. */
enum percuss_status complete_answer(const struct problem *problem, struct pace *pace,
                                    struct solve_result *result);

/* The part of the tolerance that modes and steps of the closed form's solution may take: modes are
 * cheap beside the region. */
static const double CONCURRENT_MODES_SHARE = 0.25;

/* Effort of a concurrent solution, for the reply. */
struct concurrent_effort {
    size_t resolution;              /* of the finest mesh */
    unsigned long steps;            /* of the solution that answers */
    size_t solutions, newton_steps; /* in all */
    double extrapolated;            /* restitution: the limit of steps and meshes */
};

/* Takes a solution with the closed form within that share of the tolerance, its modes and its error
 * in them, and solves it anew with contact regions of more steps and finer meshes until one is
 * within the tolerance of their limit. An elliptic contact's region is that of the sphere of equal
 * stiffness. BAD_REQUEST: the region does not support the request; TIMEOUT: the pace stopped it. */
enum percuss_status concurrent_refine(struct solution *solution, const struct problem *problem,
                                      struct pace *pace, struct concurrent_effort *effort,
                                      struct fault *fault);

/* Fills the contact model and the reason of `result`. */
void concurrent_report(const struct concurrent_effort *effort, const struct problem *problem,
                       const struct solution *solution, struct solve_result *result);

enum { CONCURRENT_MESHES = 3, CONCURRENT_DOUBLINGS = 6 };

/* The effect of steps, found on one coarse mesh: their error does not depend on the mesh, to a
 * twentieth. */
struct concurrent_steps {
    double restitution[CONCURRENT_DOUBLINGS]; /* with as many steps as the coarsest, twice, ... */
    unsigned count;                           /* of them solved */
    unsigned chosen;                          /* that of all other solutions */
    double left;                              /* change of e still to come from there */
    double error;                             /* of that */
};

struct concurrent_search {
    const struct problem *problem;
    const struct scene *scene;
    struct pace *pace;
    struct fault *fault;
    double horizon;  /* s */
    double expected; /* m, largest indentation */
    struct concurrent_steps steps;
    struct swing swing[CONCURRENT_MESHES]; /* coarse to fine; restitution with the chosen steps */
    unsigned meshes;
    double restitution, error; /* the limit of steps and meshes, and its error */
    /* The solution nearest the limit, on the finest mesh; its error is how far it is from it, and
     * the limit's own. */
    struct impact_outcome answer;
    double answer_error;
    size_t solutions, newton_steps;                 /* solved in all */
    struct impact_outcome latest[SWING_PHASES / 2]; /* of the finest mesh, by phase */
};

/* The rest of e beyond the last of the solutions with doubled steps: `left` and `error`. */
void concurrent_judge_steps(struct concurrent_steps *steps);

/* Limit and error from the means of two meshes or three, each twice as fine as the one before. */
void concurrent_judge_meshes(struct concurrent_search *search);

/* Solves with more steps and on finer meshes, of three phases each, until a solution is expected to
 * lie within `allowed` of the limit, and finds it. OK, or the status of the region or the pace. */
enum percuss_status concurrent_search(struct concurrent_search *search, double allowed);

/* Elements along the core of a mesh's region. */
size_t concurrent_resolution(unsigned mesh);

#endif
