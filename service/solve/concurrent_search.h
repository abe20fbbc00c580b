/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Which steps and meshes a contact region needs, and what its restitution tends to. */
#ifndef PERCUSS_SOLVE_CONCURRENT_SEARCH_H
#define PERCUSS_SOLVE_CONCURRENT_SEARCH_H

#include "fe/swing.h"
#include "solve/solution.h"

enum { CONCURRENT_MESHES = 3, CONCURRENT_DOUBLINGS = 6 };

/* What steps do, found on one coarse mesh: what they leave does not depend on the mesh, to a
 * twentieth. */
struct concurrent_steps {
    double restitution[CONCURRENT_DOUBLINGS]; /* with as many steps as the coarsest, twice, ... */
    unsigned count;                           /* of them solved */
    unsigned chosen;                          /* that of all other solutions */
    double left;                              /* what e would still change from there */
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
    double restitution, error; /* the limit of steps and meshes, and what it may be wrong by */
    /* The solution nearest the limit, on the finest mesh; its error is how far it is from it, and
     * the limit's own. */
    struct impact_outcome answer;
    double answer_error;
    size_t solutions, newton_steps;                 /* solved in all */
    struct impact_outcome latest[SWING_PHASES / 2]; /* of the finest mesh, by phase */
};

/* What is left of e beyond the last of the solutions with doubled steps: `left` and `error`. */
void concurrent_judge_steps(struct concurrent_steps *steps);

/* Limit and error from the means of two meshes or three, each twice as fine as the one before. */
void concurrent_judge_meshes(struct concurrent_search *search);

/* Solves with more steps and on finer meshes, of three phases each, until a solution is expected to
 * lie within `allowed` of the limit, and finds it. OK, or what the region or the pace says. */
enum percuss_status concurrent_search(struct concurrent_search *search, double allowed);

/* Elements along the core of a mesh's region. */
size_t concurrent_resolution(unsigned mesh);

#endif
