/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What friction costs: warm solves at the default tolerance without it, with micro-slip and with
 * plain friction, in turns, of two balls, and of a ball on the beam's middle, thrown along the
 * first tangent and between both. */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "scenes.h"

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* The smallest of some rounds' means, s; negative: a solve failed. */
static double cost(struct solve_workspace *workspace, const struct solve_context *context,
                   const struct solve_request *request, int times)
{
    static struct solve_result result;
    double best = 1.0;
    for (int round = 0; round < 5; round++) {
        double start = now();
        for (int i = 0; i < times; i++)
            if (solve(workspace, context, request, &result) != PERCUSS_OK)
                return -1.0;
        double mean = (now() - start) / times;
        best = mean < best ? mean : best;
    }
    return best;
}

int main(int argc, char **argv)
{
    static const char *const scenes[] = {"spheres", "beam"};
    static const double coefficients[] = {0.1, 0.3};
    int times = argc > 1 && !strcmp(argv[1], "--quick") ? 2 : 200;
    struct bench_catalogue catalogue;
    struct solve_workspace *workspace = solve_workspace_create();
    struct solve_context context = {.catalogue = &catalogue.set};
    if (!workspace || !bench_catalogue_make(&catalogue, 0))
        return EXIT_FAILURE;
    puts("| scene, mu, slip | without, us | micro-slip, us | ratio | plain, us | ratio |\n"
         "|---|---|---|---|---|---|");
    for (size_t i = 0; i < 8; i++) {
        const struct bench_scene *scene = bench_scene_find(scenes[i / 4]);
        if (!scene)
            return EXIT_FAILURE;
        double mu = coefficients[i % 2];
        bool between = i / 2 % 2;
        struct solve_request request = bench_thrown(scene, 1e-3, mu, between), bare = request;
        struct solve_request plain = request;
        bare.contacts[0].friction = 0.0;
        plain.options.friction = PERCUSS_FRICTION_PLAIN;
        double without = cost(workspace, &context, &bare, times);
        double with = cost(workspace, &context, &request, times);
        double plainly = cost(workspace, &context, &plain, times);
        if (without < 0.0 || with < 0.0 || plainly < 0.0)
            return EXIT_FAILURE;
        printf("| %s, %g, %s | %.1f | %.1f | %.1f | %.1f | %.1f |\n", scene->title, mu,
               between ? "between the tangents" : "along a tangent", 1e6 * without, 1e6 * with,
               with / without, 1e6 * plainly, plainly / without);
    }
    solve_workspace_free(workspace);
    return EXIT_SUCCESS;
}
