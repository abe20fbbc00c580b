/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss-reduce-mpi: percuss-reduce with matrices, factors and modes of big meshes spread over the
 * processes of mpirun, by PETSc and SLEPc. The first process reads, checks and writes. */
#include <argp.h>
#include <slepceps.h>
#include <stdlib.h>

#include "reduce/program.h"
#include "reduce_mpi/team.h"

const char *argp_program_version = "percuss-reduce-mpi " PERCUSS_VERSION;

/* However the first process ends, the others do. */
static void dismiss(void)
{
    int rank;
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    if (rank == 0)
        team_order((struct team_order){.job = TEAM_END});
    SlepcFinalize();
}

int main(int argc, char **argv)
{
    int rank;
    /* options of PETSc come by PETSC_OPTIONS: the command line is percuss-reduce's */
    if (SlepcInitializeNoArguments())
        return EXIT_FAILURE;
    atexit(dismiss);
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    if (rank == 0)
        return program_run(argc, argv);
    team_follow();
    return EXIT_SUCCESS;
}
