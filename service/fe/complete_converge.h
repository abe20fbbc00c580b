/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a complete finite-element impact's restitution tends to as the elements become small, and
 * how far that is known.
 *
 * Nodes close one by one. As the nodes are moved by an element against the patch's rim
 * (complete_problem.phase) e swings once about its mean, nearly as a sine, where material flows by
 * +-0.02 on 4 elements across the patch and by +-0.006 on 8. A single mesh may lie anywhere on that
 * swing, and two or three may agree by chance. Evenly spread phases know the mean: n of them are
 * wrong only by the swing's harmonics n, 2n, ... */
#ifndef PERCUSS_FE_COMPLETE_CONVERGE_H
#define PERCUSS_FE_COMPLETE_CONVERGE_H

#include "fe/impact_complete.h"

enum { COMPLETE_PHASES = 6, COMPLETE_MESHES = 3 };

/* Restitution on meshes of one fineness, at even phases: three of them, or six. */
struct complete_swing {
    unsigned cells;
    unsigned phases;                     /* solved: 3 or 6; phase k / phases */
    double restitution[COMPLETE_PHASES]; /* by phase */
    double mean;
    double width;  /* between the phases' extremes */
    double jitter; /* estimated error of the mean, as that of the limit of many phases */
};

struct complete_convergence {
    struct complete_swing swing[COMPLETE_MESHES]; /* coarse to fine */
    unsigned meshes;
    double restitution; /* the limit */
    double order;       /* of three meshes, observed; between 1 and 2 it is used; else NAN */
    double error;       /* of the limit, estimated */
    struct complete_result result; /* on the finest mesh, at the phase nearest the limit */
    unsigned cells;                /* its mesh */
    double phase;
    double result_error; /* of its restitution: `error`, and how far it is from the limit */
};

/* Fills mean, width and jitter from the phases. */
void complete_swing_judge(struct complete_swing *swing);

/* Limit, order and error from the means of two or three meshes, each twice as fine as the one
 * before. */
void complete_converge_judge(struct complete_convergence *convergence);

/* Two phases, in order, and e less what is wanted there, of different signs. */
struct complete_bracket {
    double phase[2], off[2];
};

/* Phase, 0 ... 1, at which e goes through `wanted`, by the trigonometric polynomial through the
 * phases, and the two phases around it; NAN where `wanted` lies outside of them. */
double complete_swing_phase(const struct complete_swing *swing, double wanted,
                            struct complete_bracket *bracket);

/* Solves on meshes of a quarter, half and all of problem->cells (at least 16), with more phases or
 * another mesh until the estimated error is within `tolerance`; 0: all. If need be some more, at
 * phases where e is near the limit, so that one whole solution has it. `phase` and `sample` of
 * `problem` are not used; its `pace` is told the part done of all meshes. Status as
 * impact_complete_solve. Same input, same bits. */
enum percuss_status complete_converge(const struct complete_problem *problem, double tolerance,
                                      struct complete_convergence *convergence,
                                      struct fault *fault);

#endif
