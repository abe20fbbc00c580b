/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss-ensemble: percuss ensemble in the processes of mpirun, each with the solver in it. The
 * first one reads, asks and writes; the others read the same command line when there is something
 * to do. */
#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>

#include "output_file.h"
#include "team.h"

const char *argp_program_version = "percuss-ensemble " PERCUSS_VERSION;

static bool begun; /* the others have been told */

/* However the first process ends, the others do. */
static void dismiss(void)
{
    int over;
    MPI_Finalized(&over);
    if (over)
        return;
    if (!begun)
        team_begin(false);
    MPI_Finalize();
}

static enum percuss_result solve(struct percuss_client *client,
                                 const struct percuss_ensemble_request *request, double timeout,
                                 percuss_progress_function *progress, void *context,
                                 struct percuss_ensemble_reply *reply)
{
    return team_solve(client, request, timeout, progress, context, reply, &begun);
}

int main(int argc, char **argv)
{
    int rank;
    struct common common = {.timeout = NAN, .local = true, .solve_ensemble = solve};
    if (MPI_Init(&argc, &argv) != MPI_SUCCESS)
        return EXIT_FAILURE;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    argp_err_exit_status = EXIT_USAGE;
    argv[0] = "percuss-ensemble";
    if (rank == 0) {
        atexit(dismiss);
        int code = command_ensemble(argc, argv, &common);
        if (fflush(stdout) != 0 || ferror(stdout)) {
            complain("writing the output failed");
            return EXIT_FAILURE;
        }
        return code;
    }
    /* does not come back where there is work; nor does it write */
    if (team_waits()) {
        output_file_trust();
        command_ensemble(argc, argv, &common);
        MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    }
    MPI_Finalize();
    return EXIT_SUCCESS;
}
