/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Warm solves of the rod and the beam, their first ones, groups of contacts, and an ensemble's
 * samples, for counting instructions: instructions.sh, performance.sh. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scenes.h"
#include "solve/repeat.h"

/* What is counted: everything this function does and calls. */
__attribute__((noinline)) enum percuss_status counted_solve(struct solve_workspace *workspace,
                                                            const struct solve_context *means,
                                                            const struct solve_request *request,
                                                            struct solve_result *result);

enum percuss_status counted_solve(struct solve_workspace *workspace,
                                  const struct solve_context *means,
                                  const struct solve_request *request, struct solve_result *result)
{
    return solve(workspace, means, request, result);
}

/* The same for one sample. */
__attribute__((noinline)) enum percuss_status counted_sample(struct repeat *repeat,
                                                             const struct solve_context *means,
                                                             const struct solve_request *request,
                                                             const struct solution_model *model,
                                                             struct repeat_outcome *outcome);

enum percuss_status counted_sample(struct repeat *repeat, const struct solve_context *means,
                                   const struct solve_request *request,
                                   const struct solution_model *model,
                                   struct repeat_outcome *outcome)
{
    struct fault fault;
    return repeat_solve(repeat, means, request, 0, model, true, outcome, &fault);
}

enum { STRIKERS = 3, GROUPS = 30, SAMPLES = 100, SITES = 100 };

/* Repeatable numbers in [0, 1). */
static double next_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

/* The same striker several times on the same beam, side by side, each with a speed of its own. */
static void make_group(struct solve_request *request, uint64_t *seed)
{
    struct solve_body struck = request->bodies[1];
    struct solve_body striker = request->bodies[0];
    struct solve_contact contact = request->contacts[0];
    for (unsigned i = 0; i < STRIKERS; i++) {
        double place = -0.45 + 0.3 * i + 0.25 * next_number(seed);
        striker.velocity[2] = -0.1 - 0.3 * next_number(seed);
        striker.position[0] = contact.point[0] = place;
        contact.a = i;
        contact.b = STRIKERS;
        request->bodies[i] = striker;
        request->contacts[i] = contact;
    }
    request->bodies[STRIKERS] = struck;
    request->body_count = STRIKERS + 1;
    request->contact_count = STRIKERS;
}

/* One contact of a group by itself. */
static struct solve_request one_of(const struct solve_request *group, size_t contact)
{
    struct solve_request single = *group;
    single.bodies[0] = group->bodies[contact];
    single.bodies[1] = group->bodies[STRIKERS];
    single.contacts[0] = group->contacts[contact];
    single.contacts[0].a = 0;
    single.contacts[0].b = 1;
    single.body_count = 2;
    single.contact_count = 1;
    return single;
}

/* Solves to fill the caches, then once more, counted. */
static enum percuss_status solve_warm(struct solve_workspace *workspace,
                                      const struct solve_context *means,
                                      const struct solve_request *request,
                                      struct solve_result *result)
{
    enum percuss_status status = solve(workspace, means, request, result);
    if (!status)
        status = solve(workspace, means, request, result);
    return status ? status : counted_solve(workspace, means, request, result);
}

/* Impacts between 0.05 and 0.5 m/s by the model of the request's own. */
static enum percuss_status solve_samples(const struct solve_context *means,
                                         const struct solve_request *request,
                                         struct solve_result *result)
{
    struct solution_model model;
    struct repeat_outcome outcome = {.restitution = NAN};
    struct fault fault;
    struct repeat *repeat = repeat_create();
    enum percuss_status status = PERCUSS_INTERNAL;
    if (repeat)
        status = repeat_search(repeat, means, request, 0, &model, &outcome, &fault);
    for (int i = 0; !status && i < SAMPLES; i++) {
        struct solve_request sample = *request;
        sample.bodies[0].velocity[2] = -0.05 - 0.45 * i / SAMPLES;
        if (i == 0) /* makes what all share */
            status = repeat_solve(repeat, means, &sample, 0, &model, false, &outcome, &fault);
        if (!status)
            status = counted_sample(repeat, means, &sample, &model, &outcome);
    }
    result->contacts[0].restitution = outcome.restitution;
    repeat_free(repeat);
    return status;
}

/* Blows at sites that were never asked before, on a body that is warm: counted, or asked once more
 * and then counted. */
static enum percuss_status solve_sites(struct solve_workspace *workspace,
                                       const struct solve_context *means,
                                       const struct solve_request *request, bool again,
                                       struct solve_result *result)
{
    enum percuss_status status = PERCUSS_OK;
    uint64_t seed = 5;
    for (int i = 0; !status && i < 2 * SITES; i++) {
        struct solve_request site = *request;
        site.bodies[0].position[0] = site.contacts[0].point[0] = 0.9 * next_number(&seed) - 0.45;
        /* the first half makes the tables */
        if (i < SITES || again)
            status = solve(workspace, means, &site, result);
        if (!status && i >= SITES)
            status = counted_solve(workspace, means, &site, result);
    }
    return status;
}

/* solve_once rod|beam TOLERANCE [first|thrown|groups|singles|samples|sites|sites-again]: the scene,
 * warm; or when nothing is known of its bodies; or with friction, between the tangents; or thirty
 * groups of three strikers on its body; or each of their contacts by itself; or a hundred samples
 * of an ensemble; or a hundred sites along it that are new, or asked of again. */
int main(int argc, char **argv)
{
    static struct bench_catalogue catalogue;
    static struct solve_result result;
    const struct bench_scene *scene = argc >= 3 ? bench_scene_find(argv[1]) : NULL;
    double tolerance = argc >= 3 ? strtod(argv[2], NULL) : 0.0;
    bool first = argc == 4 && strcmp(argv[3], "first") == 0;
    bool thrown = argc == 4 && strcmp(argv[3], "thrown") == 0;
    bool groups = argc == 4 && strcmp(argv[3], "groups") == 0;
    bool singles = argc == 4 && strcmp(argv[3], "singles") == 0;
    bool samples = argc == 4 && strcmp(argv[3], "samples") == 0;
    bool again = argc == 4 && strcmp(argv[3], "sites-again") == 0;
    bool sites = again || (argc == 4 && strcmp(argv[3], "sites") == 0);
    bool known = first || thrown || groups || singles || samples || sites;
    if (!scene || !(tolerance > 0.0) || (argc != 3 && !known)) {
        fprintf(stderr, "usage: solve_once SCENE TOLERANCE "
                        "[first|thrown|groups|singles|samples|sites|sites-again]\n");
        return 2;
    }
    const struct solve_context means = {.catalogue = &catalogue.set};
    struct solve_workspace *workspace = solve_workspace_create();
    struct solve_request request =
        thrown ? bench_thrown(scene, tolerance, 0.3, true) : bench_request(scene, tolerance);
    enum percuss_status status = PERCUSS_INTERNAL;
    uint64_t seed = 3;
    if (workspace && bench_catalogue_make(&catalogue, 0) && (argc == 3 || thrown))
        status = solve_warm(workspace, &means, &request, &result);
    else if (first && catalogue.set.count)
        status = counted_solve(workspace, &means, &request, &result);
    else if (samples && catalogue.set.count) {
        /* the answer has the model's modes */
        status = solve(workspace, &means, &request, &result);
        if (!status)
            status = solve_samples(&means, &request, &result);
    } else if (sites && catalogue.set.count)
        status = solve_sites(workspace, &means, &request, again, &result);
    for (int i = 0; (groups || singles) && catalogue.set.count && i < GROUPS; i++) {
        struct solve_request group = request;
        make_group(&group, &seed);
        status = groups ? solve_warm(workspace, &means, &group, &result) : PERCUSS_OK;
        for (size_t c = 0; singles && !status && c < STRIKERS; c++) {
            struct solve_request single = one_of(&group, c);
            status = solve_warm(workspace, &means, &single, &result);
        }
        if (status)
            break;
    }
    unsigned modes = 0;
    for (size_t b = 0; b < result.body_count; b++)
        modes += result.bodies[b].modes;
    printf("%s %s: e = %.9f, %u modes\n", argv[1], argv[2], result.contacts[0].restitution, modes);
    solve_workspace_free(workspace);
    return status ? EXIT_FAILURE : EXIT_SUCCESS;
}
