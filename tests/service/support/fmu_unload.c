/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Loads an FMU, makes and frees many instances, some of them at once, and unloads it.
 * usage: fmu_unload FILE.so RESOURCES TOKEN */
#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#include "fmi3.h"

enum { LOADS = 5, INSTANCES = 20 };

static void *find(void *library, const char *name)
{
    void *function = dlsym(library, name);
    if (!function) {
        fprintf(stderr, "%s\n", dlerror());
        exit(EXIT_FAILURE);
    }
    return function;
}

struct job {
    void *library;
    const char *resources, *token;
    double energy; /* after the steps */
};

/* An instance of Co-Simulation without a logger, stepped for half a second. */
static void *run(void *context)
{
    struct job *job = context;
    __typeof__(&fmi3InstantiateCoSimulation) create =
        find(job->library, "fmi3InstantiateCoSimulation");
    __typeof__(&fmi3EnterInitializationMode) enter =
        find(job->library, "fmi3EnterInitializationMode");
    __typeof__(&fmi3ExitInitializationMode) leave =
        find(job->library, "fmi3ExitInitializationMode");
    __typeof__(&fmi3DoStep) step = find(job->library, "fmi3DoStep");
    __typeof__(&fmi3GetFloat64) get = find(job->library, "fmi3GetFloat64");
    __typeof__(&fmi3FreeInstance) destroy = find(job->library, "fmi3FreeInstance");
    fmi3Instance fmu = create("one", job->token, job->resources, false, false, false, false, NULL,
                              0, NULL, NULL, NULL);
    bool going = fmu && enter(fmu, false, 0.0, 0.0, false, 0.0) == fmi3OK && leave(fmu) == fmi3OK;
    for (int i = 0; going && i < 5; i++) {
        fmi3Boolean event, terminate, early;
        fmi3Float64 reached;
        going = step(fmu, 0.1 * i, 0.1, true, &event, &terminate, &early, &reached) == fmi3OK;
    }
    fmi3ValueReference energy_lost = 28;
    if (!going || get(fmu, &energy_lost, 1, &job->energy, 1) != fmi3OK) {
        fprintf(stderr, "an instance does not run\n");
        exit(EXIT_FAILURE);
    }
    destroy(fmu);
    return NULL;
}

/* Two threads with instances of their own. */
static void run_both(struct job jobs[2])
{
    pthread_t other;
    if (pthread_create(&other, NULL, run, &jobs[1]) != 0)
        exit(EXIT_FAILURE);
    run(&jobs[0]);
    pthread_join(other, NULL);
}

int main(int argc, char **argv)
{
    if (argc != 4)
        return EXIT_FAILURE;
    double energy = 0.0;
    for (int i = 0; i < LOADS; i++) {
        void *library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
        if (!library) {
            fprintf(stderr, "%s\n", dlerror());
            return EXIT_FAILURE;
        }
        __typeof__(&fmi3InstantiateModelExchange) create =
            find(library, "fmi3InstantiateModelExchange");
        if (create("one", "another token", argv[2], false, false, NULL, NULL))
            return EXIT_FAILURE;
        for (int j = 0; j < INSTANCES / 2; j++) {
            struct job jobs[] = {{library, argv[2], argv[3], 0.0},
                                 {library, argv[2], argv[3], 0.0}};
            run_both(jobs);
            if (energy == 0.0)
                energy = jobs[0].energy;
            if (!(energy > 0.0) || jobs[0].energy != energy || jobs[1].energy != energy)
                return EXIT_FAILURE;
        }
        dlclose(library);
        if (dlopen(argv[1], RTLD_NOW | RTLD_NOLOAD)) {
            fprintf(stderr, "it is still loaded\n");
            return EXIT_FAILURE;
        }
    }
    printf("%d instances, %d times unloaded\n", LOADS * INSTANCES, LOADS);
    return EXIT_SUCCESS;
}
