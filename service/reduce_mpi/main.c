/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss-reduce-mpi: percuss-reduce with the factors of big meshes spread over the processes of
 * mpirun. The first process does all else; the others follow it into MUMPS's jobs. */
#include <dmumps_c.h>
#include <mpi.h>
#include <stdint.h>
#include <stdlib.h>

#include "reduce/program.h"
#include "reduce/ranks.h"

/* Jobs of MUMPS are few numbers, of which this is none. */
enum { QUIT = 1000, INITIALISE = -1, FINISH = -2, ANY_PROCESS = -987654 };
enum { MOST_INSTANCES = 8 };

struct order {
    uint64_t key;
    int32_t symmetry, job;
};

void ranks_follow(const void *key, int symmetry, int job)
{
    struct order order = {(uint64_t)(uintptr_t)key, symmetry, job};
    MPI_Bcast(&order, sizeof order, MPI_BYTE, 0, MPI_COMM_WORLD);
}

/* However the first process ends, the others do. */
static void dismiss(void)
{
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0)
        ranks_follow(NULL, 0, QUIT);
    MPI_Finalize();
}

struct follower {
    uint64_t key; /* 0: free */
    DMUMPS_STRUC_C mumps;
};

static struct follower *find(struct follower *followers, uint64_t key)
{
    for (int i = 0; i < MOST_INSTANCES; i++)
        if (followers[i].key == key)
            return &followers[i];
    return NULL;
}

/* Does as the first process does until that ends. What MUMPS needs beside the job comes from there.
 */
static void follow(struct follower *followers)
{
    for (;;) {
        struct order order;
        MPI_Bcast(&order, sizeof order, MPI_BYTE, 0, MPI_COMM_WORLD);
        if (order.job == QUIT)
            return;
        struct follower *one = find(followers, order.job == INITIALISE ? 0 : order.key);
        if (!one)
            MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
        if (order.job == INITIALISE) {
            one->key = order.key;
            one->mumps = (DMUMPS_STRUC_C){0};
            one->mumps.sym = order.symmetry;
            one->mumps.par = 1;
            one->mumps.comm_fortran = ANY_PROCESS;
        }
        one->mumps.job = order.job;
        dmumps_c(&one->mumps);
        /* silent from its beginning on */
        if (order.job == INITIALISE)
            one->mumps.icntl[0] = one->mumps.icntl[1] = one->mumps.icntl[2] = -1;
        if (order.job == FINISH)
            one->key = 0;
    }
}

int main(int argc, char **argv)
{
    int rank;
    MPI_Init(&argc, &argv);
    atexit(dismiss);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0)
        return program_run(argc, argv);
    struct follower *followers = calloc(MOST_INSTANCES, sizeof *followers);
    if (!followers)
        MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    follow(followers);
    free(followers);
    return EXIT_SUCCESS;
}
