/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The scenes of the benchmarks, their bodies, and the fast scale's problem with a fixed number of
 * modes that every method gets to solve. */
#ifndef PERCUSS_BENCH_SCENES_H
#define PERCUSS_BENCH_SCENES_H

#include "impact/impact.h"
#include "solve/assemble.h"
#include "solve/solve.h"

/* One contact of two bodies. `modes` of each flexible body: with them rod and beam are converged to
 * about 1e-6 in e, the others to 1e-4 or better. */
struct bench_scene {
    const char *name, *title;
    const char *a, *b; /* ids of the striker and the struck body */
    double speed;
    double position_a[3], position_b[3];
    double orientation_a[4];
    double point[3], normal[3];
    unsigned modes; /* 0: rigid bodies */
    bool few;       /* a smaller copy of another scene, for the time integration only */
};

enum { BENCH_SCENES = 7 };
extern const struct bench_scene bench_scenes[BENCH_SCENES];

/* NULL: no such scene. */
const struct bench_scene *bench_scene_find(const char *name);

/* The bodies of the scenes, with `modes` of each flexible body (0: from the tolerance). False: a
 * body was refused. */
enum { BENCH_BODIES = 6 };
struct bench_catalogue {
    struct body bodies[BENCH_BODIES];
    struct body_set set;
};
bool bench_catalogue_make(struct bench_catalogue *catalogue, unsigned modes);

struct solve_request bench_request(const struct bench_scene *scene, double tolerance);
/* The same thrown at 30 degrees from the normal, with friction: along the first tangent, the first
 * of the world's axes across the normal, or between both tangents. */
struct solve_request bench_thrown(const struct bench_scene *scene, double tolerance, double mu,
                                  bool between);

/* The problem with a fixed number of modes. */
struct fixed_scene {
    struct bench_catalogue catalogue;
    struct solve_request request;
    struct assembly assembly;
    struct prepared_cache *cache;
    struct arena arena;
    double no_residual;
    struct scene *scene;
    double horizon;
};

/* With or without the residual flexibility of the modes left out. NULL: out of memory, or refused.
 */
struct fixed_scene *fixed_scene_create(const struct bench_scene *scene, unsigned modes,
                                       bool residual);
/* The same of a request of one's own, with the residual flexibility. */
struct fixed_scene *fixed_scene_of(const struct solve_request *request, unsigned modes);
void fixed_scene_free(struct fixed_scene *fixed);

#endif
