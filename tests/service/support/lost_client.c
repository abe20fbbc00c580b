/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A client of libpercuss whose server goes: each line on stdin begins the next act. Prints what the
 * calls say.
 *
 * usage: lost_client DOMAIN */
#include <percuss/percuss.h>
#include <stdio.h>
#include <stdlib.h>

/* Long, so that only a hang meets it. */
static const double patience = 100.0; /* s */

static void next_act(void)
{
    fflush(stdout);
    if (getchar() == EOF)
        exit(EXIT_FAILURE);
}

static void tell(const char *call, enum percuss_result result)
{
    printf("%s: %s%s%s\n", call, percuss_result_text(result), result ? ": " : "",
           result ? percuss_error_text() : "");
}

static void ask_all(struct percuss_client *client)
{
    static struct percuss_request request; /* empty: to be refused, which is an answer */
    struct percuss_reply reply;
    struct percuss_body_list bodies;
    double seconds;
    percuss_request_init(&request);
    tell("solve", percuss_solve(client, &request, patience, &reply));
    percuss_reply_free(&reply);
    tell("batch", percuss_solve_batch(client, &request, 1, patience, &reply));
    percuss_reply_free(&reply);
    tell("ping", percuss_ping(client, patience, &seconds));
    tell("bodies", percuss_bodies(client, patience, &bodies));
    percuss_body_list_free(&bodies);
}

int main(int argc, char **argv)
{
    struct percuss_client *client;
    struct percuss_server_list servers;
    struct percuss_client_config config = percuss_client_config_default();
    if (argc != 2)
        return 2;
    config.domain = (uint32_t)strtoul(argv[1], NULL, 10);
    if (percuss_client_create(&config, &client))
        return EXIT_FAILURE;
    tell("connect", percuss_client_connect(client, patience));
    ask_all(client);
    puts("act 1 is over");
    next_act();
    ask_all(client);
    tell("servers", percuss_servers(client, 0.0, &servers));
    percuss_server_list_free(&servers);
    puts("act 2 is over");
    next_act();
    /* another server is there: not asked before the program says so */
    ask_all(client);
    tell("connect", percuss_client_connect(client, patience));
    ask_all(client);
    puts("act 3 is over");
    percuss_client_free(client);
    return EXIT_SUCCESS;
}
