/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss status: the announcements of the domain's servers. */

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli.h"
#include "json_writer.h"
#include "quantity.h"

enum { KEY_WATCH = OPTION_OWN, MOST_RATES = 16 };
static const double SHORTEST_PERIOD = 0.1, LONGEST_PERIOD = 86400.0; /* s */

JSON_TABLE(task, PERCUSS_TASK_FIELDS)
JSON_TABLE(server, PERCUSS_SERVER_FIELDS)

static void print_json(const struct percuss_server_list *list)
{
    json_t *root = json_object(), *array = json_array();
    json_object_set_new(root, "servers", array);
    for (size_t i = 0; i < list->count; i++)
        json_array_append_new(array, json_object_of(server_members(), &list->servers[i]));
    json_print(root);
}

/* The state at the last look, for the rate of progress. */
struct last_look {
    uint8_t server[16];
    uint64_t answered;
    double uptime;
};

struct look {
    struct common *common;
    double period; /* s; 0: one look is enough */
    struct last_look last[MOST_RATES];
};

static void print_task(const struct percuss_task *task)
{
    char client[33];
    format_hex(task->client, client);
    printf("            %s  %-8s  ", task->running ? "running" : "waiting",
           percuss_task_kind_name(task->kind));
    /* the client that waits for it, if any */
    if (task->kind == PERCUSS_TASK_MESH)
        printf("%-20s", "");
    else
        printf("%8llu of %.8s ", (unsigned long long)task->sequence, client);
    printf("%8.1f s", task->age);
    if (!isnan(task->done))
        printf("  %3.0f %%", 100.0 * task->done);
    putchar('\n');
}

static void print_tasks(const struct percuss_server *server)
{
    if (server->all_tasks > 0)
        printf("tasks       %u: number, client, age, share done\n", server->all_tasks);
    for (size_t i = 0; i < server->task_count; i++)
        print_task(&server->tasks[i]);
    if (server->all_tasks > server->task_count)
        printf("            and %zu more\n", server->all_tasks - server->task_count);
}

static void print_server(const struct look *look, const struct percuss_server *server)
{
    char id[33];
    format_hex(server->server, id);
    /* with --local it is this one */
    if (look->common->local)
        printf("server      none: percuss %s solves in this process, with %u threads\n",
               server->version, server->workers);
    else
        printf("server      %s, percussd %s, %s\nprocess     %u on %s, up %.0f s, %u workers\n", id,
               server->version, server->state, server->process, server->host, server->uptime,
               server->workers);
    printf("catalogue   %s, %u bodies, revision %s\n", server->catalogue, server->bodies,
           server->catalogue_revision);
    if (look->common->local)
        return;
    printf("requests    %llu answered, %llu refused, %u of %u places in the queue taken\n",
           (unsigned long long)server->answered, (unsigned long long)server->refused,
           server->queue_length, server->queue_capacity);
    if (server->activity[0])
        printf("activity    %s, %.0f %%\n", server->activity, 100.0 * server->progress);
    print_tasks(server);
}

static void print_rate(const struct percuss_server *server, struct last_look *last)
{
    bool same = memcmp(last->server, server->server, sizeof last->server) == 0;
    double seconds = server->uptime - last->uptime;
    if (same && seconds > 0.0 && server->answered >= last->answered)
        printf("rate        %.4g answers a second\n",
               (double)(server->answered - last->answered) / seconds);
    memcpy(last->server, server->server, sizeof last->server);
    last->answered = server->answered;
    last->uptime = server->uptime;
}

static enum percuss_result look(struct percuss_client *client, struct look *look)
{
    struct percuss_server_list list;
    enum percuss_result result = percuss_servers(client, common_timeout(look->common), &list);
    if (result != PERCUSS_RESULT_OK)
        return result;
    if (look->common->json)
        print_json(&list);
    else if (look->period > 0.0 && isatty(STDOUT_FILENO))
        fputs("\033[H\033[J", stdout); /* from the top of an empty screen */
    for (size_t i = 0; !look->common->json && i < list.count; i++) {
        print_server(look, &list.servers[i]);
        if (look->period > 0.0 && i < MOST_RATES)
            print_rate(&list.servers[i], &look->last[i]);
    }
    if (!look->common->json && list.count == 0)
        puts("no percussd announces itself");
    percuss_server_list_free(&list);
    return fflush(stdout) == 0 ? PERCUSS_RESULT_OK : PERCUSS_RESULT_TRANSPORT;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct look *look = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = look->common;
        return 0;
    case KEY_WATCH:
        look->period = text ? parse_quantity("watch", text, QUANTITY_TIME, state) : 1.0;
        if (!(look->period >= SHORTEST_PERIOD && look->period <= LONGEST_PERIOD))
            argp_error(state, "--watch: '%s': 0.1 to 86400 s are allowed", text);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&common_argp, 0, NULL, 0}, {0}};
static const struct argp_option options[] = {
    {"watch", KEY_WATCH, "SECONDS", OPTION_ARG_OPTIONAL,
     "look again every so many seconds (default 1), or as often as a time with a unit says, until "
     "it is interrupted",
     10},
    {0},
};
const struct argp status_argp = {
    .options = options,
    .parser = parse,
    .doc = "Shows what the servers are doing.",
    .children = children,
};

int command_status(int argc, char **argv, struct common *common)
{
    struct percuss_client *client;
    struct look looks = {.common = common};
    argp_parse(&status_argp, argc, argv, 0, NULL, &looks);
    int code = make_client(common, NULL, &client);
    if (code != EXIT_ANSWERED)
        return code;
    if (!percuss_client_observes(client))
        code = connect_client(common, client);
    /* announcements of a server that does not answer count, too; --watch may wait for a server */
    if (code != EXIT_ANSWERED && code != EXIT_TIMEOUT && looks.period == 0.0) {
        percuss_client_free(client);
        return code;
    }
    enum percuss_result result = look(client, &looks);
    while (result == PERCUSS_RESULT_OK && looks.period > 0.0) {
        nanosleep(&(struct timespec){(time_t)looks.period,
                                     (long)(1e9 * (looks.period - floor(looks.period)))},
                  NULL);
        result = look(client, &looks);
    }
    if (result != PERCUSS_RESULT_OK)
        code = complain_result(result);
    percuss_client_free(client);
    return code;
}
