/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss-ensemble: percuss ensemble in the processes of mpirun, each with the solver in it. The
 * first one reads, asks and writes; the others read the same command line when there is something
 * to do. */

#include <math.h>
#include <mpi.h>
#include <percuss/ensemble_share.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "output_file.h"

/* The processes of mpirun: the first one asks, the others solve. */

/* Messages to a worker, and from one. */
enum { TAG_RANGE, TAG_PART };

/* Ranges that a worker has at once: the next one is there when one is solved. */
enum { AHEAD = 2 };

/* The first process solves for so long, s, between two looks at the others. */
static const double TURN = 2e-3;

/* A range's parts: small enough to be spread evenly, large enough for the messages not to count. */
enum { PARTS_EACH = 16, LARGEST_PART = 1024 };

/* As it travels; count 0: go home. */
struct order {
    uint64_t first, count, extras, done;
};

static int ranks(void)
{
    int count;
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    return count;
}

static int rank(void)
{
    int number;
    MPI_Comm_rank(MPI_COMM_WORLD, &number);
    return number;
}

/* Of the first process: the others begin, or go home. Once. */
static void team_begin(bool work)
{
    int there_is = work;
    MPI_Bcast(&there_is, 1, MPI_INT, 0, MPI_COMM_WORLD);
}

/* Of the others: whether there is work. */
static bool team_waits(void)
{
    int there_is = 0;
    MPI_Bcast(&there_is, 1, MPI_INT, 0, MPI_COMM_WORLD);
    return there_is;
}

/* The first process at work on a range. */
struct deal {
    struct percuss_ensemble_sharing *sharing;
    struct percuss_ensemble_range left; /* not dealt yet */
    uint64_t largest;                   /* part */
    uint64_t own;                       /* items that it solves in a turn */
    unsigned outstanding;               /* parts that others solve */
    bool stopped;                       /* no more are wanted, or something is wrong */
    enum percuss_result result;
};

/* Shared by all ranges of an ensemble. */
struct team {
    struct percuss_ensemble_worker *worker; /* of this process */
    percuss_progress_function *progress;
    void *context;
    enum percuss_result result;
    char message[512];
};

static struct percuss_ensemble_range cut(struct deal *deal, uint64_t most)
{
    struct percuss_ensemble_range piece = deal->left;
    piece.count = piece.count < most ? piece.count : most;
    deal->left.first += piece.count;
    deal->left.count -= piece.count;
    return piece;
}

static void send_order(struct deal *deal, int to)
{
    if (deal->left.count == 0 || deal->stopped)
        return;
    struct percuss_ensemble_range piece = cut(deal, deal->largest);
    struct order order = {piece.first, piece.count, piece.extras, piece.done};
    MPI_Send(&order, sizeof order, MPI_BYTE, to, TAG_RANGE, MPI_COMM_WORLD);
    deal->outstanding++;
}

/* Hands a part over; any fault in it ends the deal. */
static void take(struct team *team, struct deal *deal, const void *part, size_t size)
{
    enum percuss_result result = percuss_ensemble_take(deal->sharing, part, size);
    deal->stopped = deal->stopped || result != PERCUSS_RESULT_OK;
    if (result == PERCUSS_RESULT_OK || result == PERCUSS_RESULT_PENDING ||
        team->result != PERCUSS_RESULT_OK)
        return;
    team->result = result;
    snprintf(team->message, sizeof team->message, "%s", percuss_error_text());
}

/* Takes a part of another process and gives it more. */
static void receive(struct team *team, struct deal *deal)
{
    MPI_Status status;
    int size;
    MPI_Probe(MPI_ANY_SOURCE, TAG_PART, MPI_COMM_WORLD, &status);
    MPI_Get_count(&status, MPI_BYTE, &size);
    void *part = malloc((size_t)size + 1);
    if (!part)
        MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    MPI_Recv(part, size, MPI_BYTE, status.MPI_SOURCE, TAG_PART, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    deal->outstanding--;
    send_order(deal, status.MPI_SOURCE);
    take(team, deal, part, (size_t)size);
    free(part);
}

static bool has_come(void)
{
    int there = 0;
    MPI_Iprobe(MPI_ANY_SOURCE, TAG_PART, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
    return there;
}

static void *solve_piece(struct team *team, const struct percuss_ensemble_range *piece)
{
    void *part = malloc(percuss_ensemble_part_size(piece));
    if (!part || percuss_ensemble_worker_solve(team->worker, piece, part) != PERCUSS_RESULT_OK) {
        complain("%s", part ? percuss_error_text() : "out of memory");
        MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    }
    return part;
}

/* The first process solves some of it itself: as much as leaves the others waiting for a moment. */
static void solve_some(struct team *team, struct deal *deal)
{
    struct percuss_ensemble_range piece = cut(deal, deal->own);
    double begun = MPI_Wtime();
    void *part = solve_piece(team, &piece);
    double each = (MPI_Wtime() - begun) / (double)piece.count;
    deal->own = each * LARGEST_PART < TURN ? LARGEST_PART : 1 + (uint64_t)(TURN / each);
    take(team, deal, part, percuss_ensemble_part_size(&piece));
    free(part);
}

static void share(void *context, struct percuss_ensemble_sharing *sharing,
                  const struct percuss_ensemble_range *range)
{
    struct team *team = context;
    struct deal deal = {.sharing = sharing, .left = *range, .own = 1};
    deal.largest = 1 + range->count / (uint64_t)(PARTS_EACH * ranks());
    deal.largest = deal.largest < LARGEST_PART ? deal.largest : LARGEST_PART;
    /* each process has some, and gets more when it is done */
    for (int i = 0; i < AHEAD; i++)
        for (int to = 1; to < ranks(); to++)
            send_order(&deal, to);
    while (deal.outstanding > 0 || (deal.left.count > 0 && !deal.stopped)) {
        bool others = deal.outstanding > 0 && (deal.left.count == 0 || deal.stopped || has_come());
        if (others)
            receive(team, &deal);
        else
            solve_some(team, &deal);
    }
}

static bool tell(void *context, const struct percuss_ensemble_progress *progress)
{
    const struct team *team = context;
    return !team->progress || team->progress(team->context, progress);
}

static void create_worker(struct team *team, struct percuss_client *client,
                          const struct percuss_ensemble_request *request)
{
    if (percuss_ensemble_worker_create(client, request, &team->worker) == PERCUSS_RESULT_OK)
        return;
    complain("process %d: %s", rank(), percuss_error_text());
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
}

/* Solves the first process's orders until the last. */
static void follow(struct team *team)
{
    for (;;) {
        struct order order;
        MPI_Recv(&order, sizeof order, MPI_BYTE, 0, TAG_RANGE, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        if (order.count == 0)
            return;
        struct percuss_ensemble_range piece = {order.first, order.count, order.extras != 0,
                                               order.done};
        void *part = solve_piece(team, &piece);
        MPI_Send(part, (int)percuss_ensemble_part_size(&piece), MPI_BYTE, 0, TAG_PART,
                 MPI_COMM_WORLD);
        free(part);
    }
}

static enum percuss_result lead(struct team *team, struct percuss_client *client,
                                const struct percuss_ensemble_request *request,
                                struct percuss_ensemble_reply *reply)
{
    const struct order home = {0};
    enum percuss_result result =
        percuss_solve_ensemble_shared(client, request, share, tell, team, reply);
    for (int to = 1; to < ranks(); to++)
        MPI_Send(&home, sizeof home, MPI_BYTE, to, TAG_RANGE, MPI_COMM_WORLD);
    /* why samples were lost says more than that they were */
    if (team->result != PERCUSS_RESULT_OK)
        complain("a process has solved something else: %s", team->message);
    return result;
}

/* As percuss_solve_ensemble, with the samples solved by all processes, which *begun says have been
 * told. Does not return in any but the first: they end when it has the ensemble. */
static enum percuss_result team_solve(struct percuss_client *client,
                                      const struct percuss_ensemble_request *request,
                                      double timeout, percuss_progress_function *progress,
                                      void *context, struct percuss_ensemble_reply *reply,
                                      bool *begun)
{
    struct team team = {.progress = progress, .context = context};
    /* progress is not waited for: it is in this very process */
    (void)timeout;
    if (rank() == 0) {
        /* a refusal happens here alone, in the answer */
        if (percuss_ensemble_worker_create(client, request, &team.worker) != PERCUSS_RESULT_OK)
            return percuss_solve_ensemble(client, request, timeout, progress, context, reply);
        team_begin(*begun = true);
        enum percuss_result result = lead(&team, client, request, reply);
        percuss_ensemble_worker_free(team.worker);
        return result;
    }
    create_worker(&team, client, request);
    follow(&team);
    percuss_ensemble_worker_free(team.worker);
    percuss_client_free(client);
    MPI_Finalize();
    exit(EXIT_SUCCESS);
}

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
