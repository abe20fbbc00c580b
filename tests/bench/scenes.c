/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "solve/contact_model.h"
#include "solve/formulation.h"

#define UPRIGHT                                                                                    \
    {                                                                                              \
        1.0, 0.0, 0.0, 0.0                                                                         \
    }
/* a rod's +x end points down */
#define TIP_DOWN                                                                                   \
    {                                                                                              \
        M_SQRT1_2, 0.0, M_SQRT1_2, 0.0                                                             \
    }
#define UP                                                                                         \
    {                                                                                              \
        0.0, 0.0, 1.0                                                                              \
    }

static const double SPHERE = 0.015, BAR = 0.010, TIP = 0.015, TIPPED_LENGTH = 0.4;

/* Sphere on a beam at x = 0, sphere on the end of a rod, and variations. */
const struct bench_scene bench_scenes[BENCH_SCENES] = {
    {"rod",
     "sphere on a rod's end, 0.3 m/s",
     "sphere",
     "rod",
     0.3,
     {0.515, 0.0, 0.0},
     {0.0},
     UPRIGHT,
     {0.5, 0.0, 0.0},
     {1.0, 0.0, 0.0},
     64,
     false},
    {"beam",
     "sphere on a free beam's centre, 0.276 m/s",
     "sphere",
     "beam",
     0.276,
     {0.0, 0.0, 0.025},
     {0.0},
     UPRIGHT,
     {0.0, 0.0, 0.010},
     UP,
     320,
     false},
    {"pinned",
     "sphere on a pinned beam at 0.31 of its length, 0.2 m/s",
     "sphere",
     "pinned",
     0.2,
     {-0.19, 0.0, 0.025},
     {0.0},
     UPRIGHT,
     {-0.19, 0.0, 0.010},
     UP,
     80,
     false},
    {"two-flexible",
     "round-tipped rod on a free beam's centre, 0.3 m/s",
     "tipped",
     "beam",
     0.3,
     {0.0, 0.0, 0.210},
     {0.0},
     TIP_DOWN,
     {0.0, 0.0, 0.010},
     UP,
     60,
     false},
    {"spheres",
     "sphere on sphere, 0.3 m/s",
     "sphere",
     "sphere",
     0.3,
     {0.0, 0.0, 0.030},
     {0.0},
     UPRIGHT,
     {0.0, 0.0, 0.015},
     UP,
     0,
     false},
    {"rod-few",
     "as rod, 16 modes",
     "sphere",
     "rod",
     0.3,
     {0.515, 0.0, 0.0},
     {0.0},
     UPRIGHT,
     {0.5, 0.0, 0.0},
     {1.0, 0.0, 0.0},
     16,
     true},
    {"beam-few",
     "as beam, 54 modes",
     "sphere",
     "beam",
     0.276,
     {0.0, 0.0, 0.025},
     {0.0},
     UPRIGHT,
     {0.0, 0.0, 0.010},
     UP,
     54,
     true},
};

const struct bench_scene *bench_scene_find(const char *name)
{
    for (int i = 0; i < BENCH_SCENES; i++)
        if (strcmp(bench_scenes[i].name, name) == 0)
            return &bench_scenes[i];
    return NULL;
}

static struct body make(const char *id, const struct body_kind *kind, struct material material,
                        double radius)
{
    struct body body = {.material = material, .kind = kind, .radius = radius, .length = 1.0};
    snprintf(body.id, sizeof body.id, "%s", id);
    body.tip_radius = INFINITY;
    if (kind == &sphere_kind)
        body.length = 0.0;
    return body;
}

bool bench_catalogue_make(struct bench_catalogue *catalogue, unsigned modes)
{
    struct material steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
    struct material aluminium = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0};
    struct body *bodies = catalogue->bodies;
    size_t count = 0;
    bodies[count++] = make("sphere", &sphere_kind, steel, SPHERE);
    bodies[count++] = make("rod", &rod_kind, aluminium, BAR);
    bodies[count++] = make("beam", &beam_kind, aluminium, BAR);
    bodies[count] = make("pinned", &beam_kind, aluminium, BAR);
    bodies[count].supports[0] = bodies[count].supports[1] = SUPPORT_PINNED;
    count++;
    bodies[count] = make("tipped", &rod_kind, aluminium, BAR);
    bodies[count].length = TIPPED_LENGTH;
    bodies[count].tip_radius = TIP;
    count++;
    for (size_t i = 0; i < count; i++) {
        struct fault fault = {0};
        if (bodies[i].kind != &sphere_kind)
            bodies[i].modes = modes;
        /* what figures were recorded with; Hutchinson's makes another scene of it, whose third
         * sub-impact is nearly a graze and takes three times the work */
        if (bodies[i].kind == &beam_kind)
            bodies[i].shear_rule = SHEAR_COWPER;
        if (body_complete(&bodies[i], &fault)) {
            fprintf(stderr, "bench: %s: %s\n", bodies[i].id, fault.text);
            return false;
        }
    }
    catalogue->set = (struct body_set){
        .bodies = bodies, .count = count, .compliance = PERCUSS_COMPLIANCE_HALF_SPACE};
    snprintf(catalogue->set.revision, sizeof catalogue->set.revision, "bench-%u", modes);
    return true;
}

struct solve_request bench_request(const struct bench_scene *scene, double tolerance)
{
    struct solve_request request = {.body_count = 2, .contact_count = 1};
    struct solve_body *a = &request.bodies[0];
    struct solve_body *b = &request.bodies[1];
    snprintf(a->id, sizeof a->id, "%s", scene->a);
    snprintf(b->id, sizeof b->id, "%s", scene->b);
    memcpy(a->position, scene->position_a, sizeof a->position);
    memcpy(b->position, scene->position_b, sizeof b->position);
    memcpy(a->orientation, scene->orientation_a, sizeof a->orientation);
    b->orientation[0] = 1.0;
    struct solve_contact *contact = &request.contacts[0];
    contact->b = 1;
    memcpy(contact->point, scene->point, sizeof contact->point);
    memcpy(contact->normal, scene->normal, sizeof contact->normal);
    for (int i = 0; i < 3; i++)
        a->velocity[i] = -scene->speed * scene->normal[i];
    request.options.tolerance = tolerance;
    return request;
}

struct solve_request bench_thrown(const struct bench_scene *scene, double tolerance, double mu,
                                  bool between)
{
    struct solve_request request = bench_request(scene, tolerance);
    int along = scene->normal[0] * scene->normal[0] < 0.5 ? 0 : 1;
    int across = scene->normal[2] * scene->normal[2] < 0.5 ? 2 : 1;
    request.bodies[0].velocity[along] += (between ? 0.5 : 0.577) * scene->speed;
    request.bodies[0].velocity[across] += (between ? 0.288 : 0.0) * scene->speed;
    request.contacts[0].tangent[along] = 1.0;
    request.contacts[0].friction = mu;
    return request;
}

static bool build(struct fixed_scene *fixed, bool residual)
{
    struct fault fault = {0};
    struct mode_choice choice = {.cut = 0.0, .most = MODE_CHOICE_MOST};
    fixed->cache = prepared_cache_create();
    if (!fixed->cache)
        return false;
    prepared_cache_use(fixed->cache, fixed->catalogue.set.revision);
    struct problem *problem = problem_create(&fixed->request, fixed->cache, &fixed->arena);
    if (!problem)
        return false;
    if (placement_find(problem, &fixed->catalogue.set, &fault)) {
        fprintf(stderr, "bench: %s\n", fault.text);
        return false;
    }
    if (contact_model_choose(problem, &fixed->catalogue.set, NULL, &fault) ||
        !assemble(&fixed->assembly, problem, &choice))
        return false;
    fixed->scene = &fixed->assembly.scene;
    if (!residual)
        fixed->scene->residual = &fixed->no_residual;
    fixed->horizon = fmax(SOLVE_HORIZON, 2.0 * scene_longest_period(fixed->scene));
    return true;
}

static struct fixed_scene *create(const struct solve_request *request, unsigned modes,
                                  bool residual)
{
    struct fixed_scene *fixed = calloc(1, sizeof *fixed);
    if (!fixed)
        return NULL;
    fixed->request = *request;
    if (!bench_catalogue_make(&fixed->catalogue, modes) || !build(fixed, residual)) {
        fixed_scene_free(fixed);
        return NULL;
    }
    return fixed;
}

struct fixed_scene *fixed_scene_create(const struct bench_scene *scene, unsigned modes,
                                       bool residual)
{
    struct solve_request request = bench_request(scene, 1e-6);
    return create(&request, modes, residual);
}

struct fixed_scene *fixed_scene_of(const struct solve_request *request, unsigned modes)
{
    return create(request, modes, true);
}

void fixed_scene_free(struct fixed_scene *fixed)
{
    if (!fixed)
        return;
    prepared_cache_free(fixed->cache);
    arena_release(&fixed->arena);
    free(fixed);
}
