/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "waiting.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "fold.h"

/* s: before that nothing is shown; between two drawings, and two looks at the server's status,
 * which comes once a second */
static const double UNSHOWN = 1.0, REDRAW = 0.1, LOOK = 0.5;

static volatile sig_atomic_t interrupted; /* by that signal */

static struct {
    struct percuss_client *client; /* NULL: no call waits */
    const char *what;
    size_t count;
    bool is_seen, asks_server;
    double begun, drawn, looked; /* monotonic, s */
    struct percuss_task task;    /* ours, as the server told last; age NAN: none */
    bool shown;                  /* there is something on the terminal */
} waiting;

static void interrupt(int signal_number)
{
    interrupted = signal_number;
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Finds our task that the server computes, or else one in its queue. */
static void look(void)
{
    uint8_t id[16];
    struct percuss_server_list list;
    waiting.looked = now();
    waiting.task.age = NAN;
    if (percuss_servers(waiting.client, 0.0, &list) != PERCUSS_RESULT_OK)
        return;
    percuss_client_id(waiting.client, id);
    for (size_t i = 0; i < list.count; i++) {
        const struct percuss_server *server = &list.servers[i];
        for (size_t k = 0; isnan(waiting.task.age) && k < server->task_count; k++)
            if (memcmp(server->tasks[k].client, id, sizeof id) == 0)
                waiting.task = server->tasks[k];
    }
    percuss_server_list_free(&list);
}

static void draw(void)
{
    const struct percuss_task *task = &waiting.task;
    bool known = !isnan(task->age);
    waiting.drawn = now();
    waiting.shown = true;
    fputs("\r\033[K", stderr);
    char text[128] = "";
    const bool shared = known && task->running && !isnan(task->done);
    int length = shared ? snprintf(text, sizeof text, " %3.0f %%  ", 100.0 * task->done) : 0;
    if (waiting.what)
        length += snprintf(text + length, sizeof text - (size_t)length, "%zu %s  ", waiting.count,
                           waiting.what);
    snprintf(text + length, sizeof text - (size_t)length, "%.1f s", waiting.drawn - waiting.begun);
    if (shared)
        fold_bar(task->done, text);
    else
        fprintf(stderr, "%s%s", known && !task->running ? "waits for its turn  " : "", text);
}

static bool goes_on(void *context)
{
    double time = now();
    (void)context;
    if (interrupted || !waiting.is_seen || time < waiting.begun + UNSHOWN)
        return !interrupted;
    if (waiting.asks_server && time >= waiting.looked + LOOK)
        look();
    if (time >= waiting.drawn + REDRAW)
        draw();
    return true;
}

void waiting_begin(const struct common *common, struct percuss_client *client, const char *what)
{
    const struct sigaction once = {.sa_handler = interrupt, .sa_flags = (int)SA_RESETHAND};
    if (waiting.client == client)
        return;
    waiting.client = client;
    waiting.what = what;
    waiting.is_seen = isatty(STDERR_FILENO);
    waiting.asks_server = !common->local;
    waiting.begun = now();
    waiting.task.age = NAN;
    sigaction(SIGINT, &once, NULL);
    sigaction(SIGTERM, &once, NULL);
    percuss_client_watch(client, goes_on, NULL);
}

bool waiting_count(size_t answered)
{
    waiting.count += answered;
    return goes_on(NULL);
}

void waiting_clear(void)
{
    if (waiting.shown)
        fputs("\r\033[K", stderr);
    waiting.shown = false;
}

void waiting_end(void)
{
    if (!waiting.client)
        return;
    waiting_clear();
    percuss_client_watch(waiting.client, NULL, NULL);
    waiting.client = NULL;
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
}

int waiting_exit_code(void)
{
    return 128 + (interrupted ? interrupted : SIGINT);
}
