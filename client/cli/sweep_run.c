/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "sweep_run.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

/* Enough to keep a server's workers busy, few enough for its queue. */
enum { OUTSTANDING = 16 };

/* Between two looks whether it was interrupted, and two drawings of the progress, s. */
static const double LOOK = 0.1;

static volatile sig_atomic_t interrupted;

static void interrupt(int signal_number)
{
    (void)signal_number;
    interrupted = 1;
}

void sweep_run_catch_interrupts(void)
{
    const struct sigaction once = {.sa_handler = interrupt, .sa_flags = (int)SA_RESETHAND};
    sigaction(SIGINT, &once, NULL);
    sigaction(SIGTERM, &once, NULL);
}

bool sweep_run_interrupted(void)
{
    return interrupted;
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int send_point(struct sweep_run *run, unsigned i)
{
    struct percuss_request request;
    int code = scene_request(&run->scene, &run->bodies, run->speeds[i], &request);
    if (code != EXIT_ANSWERED)
        return code;
    enum percuss_result result = percuss_submit(run->client, &request, &run->sequences[i]);
    return result == PERCUSS_RESULT_OK ? EXIT_ANSWERED : complain_result(result);
}

/* Which point a reply answers: one of the last OUTSTANDING sent, or one sent again since. */
static unsigned point_of(const struct sweep_run *run, uint64_t sequence)
{
    unsigned i = run->sent;
    while (i > 0 && run->sequences[i - 1] != sequence)
        i--;
    return i - 1;
}

static void show_progress(const struct sweep_run *run, double *shown)
{
    enum { WIDTH = 40 };
    unsigned done = run->first + run->answered, filled = WIDTH * done / run->count;
    bool ends = done == run->count;
    if (!isatty(STDERR_FILENO) || (!ends && now() < *shown + LOOK))
        return;
    *shown = now();
    fprintf(stderr, "\r[%-*.*s] %u/%u", WIDTH, (int)filled,
            "########################################", done, run->count);
    if (ends)
        fputc('\n', stderr);
}

/* Waits for any reply, as long as nobody interrupts. PENDING: he has. In this process waiting is
 * solving, which must not begin anew at every look. */
static enum percuss_result await(struct sweep_run *run, struct percuss_reply *reply)
{
    const double look = run->common->local ? INFINITY : LOOK;
    double end = now() + common_timeout(run->common);
    for (;;) {
        double left = end - now();
        enum percuss_result result = percuss_wait(run->client, 0, fmax(fmin(left, look), 0), reply);
        if (interrupted && result == PERCUSS_RESULT_TIMEOUT)
            return PERCUSS_RESULT_PENDING;
        if (result != PERCUSS_RESULT_TIMEOUT || left <= look)
            return result;
    }
}

/* Tells of all that are there in order. */
static bool tell(struct sweep_run *run)
{
    bool wanted = true;
    while (wanted && run->told < run->count && run->there[run->told])
        wanted = run->ready(run->context, run->told++);
    return wanted;
}

/* Takes one reply; a busy server is asked again. */
static int take_point(struct sweep_run *run)
{
    struct percuss_reply reply;
    enum percuss_result result = await(run, &reply);
    if (result == PERCUSS_RESULT_PENDING)
        return EXIT_ANSWERED_WITH_WARNING;
    if (result != PERCUSS_RESULT_OK)
        return complain_result(result);
    unsigned i = point_of(run, reply.sequence);
    if (reply.status == PERCUSS_BUSY) {
        percuss_reply_free(&reply);
        usleep(1000);
        return send_point(run, i);
    }
    run->replies[i] = reply;
    run->there[i] = true;
    run->answered++;
    return tell(run) ? EXIT_ANSWERED : EXIT_FAILURE;
}

int sweep_run_ask(struct sweep_run *run)
{
    double shown = 0.0;
    run->replies = calloc(run->count, sizeof *run->replies);
    run->there = calloc(run->count, sizeof *run->there);
    run->sequences = calloc(run->count, sizeof *run->sequences);
    run->sent = run->told = run->first;
    if (!run->replies || !run->there || !run->sequences)
        return complain_memory();
    int code = scene_find_bodies(&run->scene, run->common, run->client, &run->bodies);
    while (code == EXIT_ANSWERED && run->told < run->count && !interrupted) {
        unsigned outstanding = run->sent - run->first - run->answered;
        if (run->sent < run->count && outstanding < OUTSTANDING) {
            code = send_point(run, run->sent++);
        } else {
            code = take_point(run);
            show_progress(run, &shown);
        }
    }
    return code == EXIT_ANSWERED && run->told < run->count ? EXIT_ANSWERED_WITH_WARNING : code;
}

int sweep_run_again(struct sweep_run *run, unsigned i, struct percuss_reply *reply)
{
    struct percuss_request request;
    int code = scene_find_bodies(&run->scene, run->common, run->client, &run->bodies);
    if (code == EXIT_ANSWERED)
        code = scene_request(&run->scene, &run->bodies, run->speeds[i], &request);
    percuss_body_list_free(&run->bodies.list);
    if (code != EXIT_ANSWERED)
        return code;
    return complain_result(
        percuss_solve(run->client, &request, common_timeout(run->common), reply));
}

void sweep_run_release(struct sweep_run *run)
{
    for (unsigned i = 0; run->replies && i < run->count; i++)
        percuss_reply_free(&run->replies[i]);
    free(run->replies);
    free(run->there);
    free(run->sequences);
    percuss_body_list_free(&run->bodies.list);
}
