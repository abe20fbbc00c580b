/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The solution of a problem: as many modes and as short time steps as the tolerance on
 * the restitution asks for (error/refinement.h), or a model of both that is given. */
#ifndef PERCUSS_SOLVE_SOLUTION_H
#define PERCUSS_SOLVE_SOLUTION_H

#include "base/watch.h"
#include "solve/error/neighbours.h"
#include "solve/error/refinement.h"

/* Modes and steps that a search settles on: enough to solve the same problem again, or similar
 * ones. */
struct solution_model {
    double cut;      /* modes up to this angular frequency take part, rad/s */
    double accuracy; /* of the time steps, see impact_settings */
};

/* By a model only `scene`, `assembly`, `outcome` and `revised` are filled. */
struct solution {
    const struct scene *scene;      /* of the answer, in the problem's arena */
    struct impact_outcome outcome;  /* the answer */
    bool revised;                   /* the problem was formulated anew on the way */
    struct assembly *assembly;      /* of the scene */
    const struct force_log *log;    /* of the answer where first order says something of it; NULL */
    struct sensitivity_path *path;  /* along it, if it was asked for on the way; NULL */
    double step_accuracy;           /* that it was solved with, see impact_settings */
    enum step_profile step_profile; /* the same */
    struct error_budget error;      /* of modes and steps; those of models and states come later */
    double restitution_by_speed;    /* NAN unless asked for */
    double tangential_by_speed[2];  /* kg; NAN unless asked for, or without friction */
    bool tolerance_met;
    bool spent;     /* the effort allowed ended the search */
    double work;    /* that it left of it (impact.h) */
    double farther; /* times its distance from those beside it an answer may be wrong by */
    struct neighbours *neighbours; /* the answer, and those that it was compared with; in the
                                      outcome's arena */
};

/* Solves until the estimated error fits `tolerance` or the effort allowed is spent, or once by a
 * model (NULL: none). Where the solution contradicts the choices of the formulation it revises the
 * problem, but not its tolerance, and solves again. With a model it takes solution->scene as it is
 * if it is there. The arena is the outcome's; `pace` (NULL: none) may stop it. PERCUSS_OK,
 * PERCUSS_INTERNAL or PERCUSS_TIMEOUT; BAD_REQUEST: an overlap that contradicts itself. */
enum percuss_status solution_find(struct solution *solution, struct problem *problem,
                                  double tolerance, const struct solution_model *model,
                                  struct arena *arena, struct pace *pace, struct fault *fault);

/* The modes and steps that a search settled on. */
struct solution_model solution_model_of(const struct solution *solution);

#endif
