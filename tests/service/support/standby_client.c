/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A program that knows nothing of standbys: it asks one request after the other until FILE is
 * there, and takes anything but an answer for the end. With a SPECIMEN each of them is an impact on
 * it; "-": none. Prints the restitution of each, what took longer than a tenth of a second, and
 * how many there were. With "submit" it sends one request when FILE is there, and again, with its
 * number, whenever it is told that whoever was asked has gone.
 *
 * usage: standby_client DOMAIN SPECIMEN FILE [COUNT | submit] */
#include <percuss/percuss.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static const double patience = 30.0, long_wait = 0.1; /* s */

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int give_up(const char *call, unsigned asked, double since)
{
    fprintf(stderr, "%s, after %u answers and %.3f s: %s\n", call, asked, now() - since,
            percuss_error_text());
    return EXIT_FAILURE;
}

/* The sphere falls on the end of the rod. */
static void fill(struct percuss_request *request, const char *specimen)
{
    static const double place[3] = {0.515, 0, 0}, velocity[3] = {-0.3, 0, 0};
    static const double point[3] = {0.5, 0, 0}, normal[3] = {1, 0, 0};
    percuss_request_init(request);
    struct percuss_body_motion *sphere = percuss_request_add_body(request, "steel-sphere");
    memcpy(sphere->position, place, sizeof place);
    memcpy(sphere->velocity, velocity, sizeof velocity);
    struct percuss_body_motion *rod = percuss_request_add_body(request, "al-rod-1");
    if (strcmp(specimen, "-") != 0)
        snprintf(rod->specimen, sizeof rod->specimen, "%s", specimen);
    struct percuss_contact *contact = percuss_request_add_contact(request, 0, 1);
    memcpy(contact->point, point, sizeof point);
    memcpy(contact->normal, normal, sizeof normal);
    request->options.contact_model = PERCUSS_CONTACT_CLOSED_FORM;
    request->options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
}

/* One request, submitted until it is answered. */
static int submit(struct percuss_client *client, struct percuss_request *request, const char *file)
{
    struct percuss_reply reply;
    double begun = now();
    unsigned lost = 0;
    puts("connected");
    while (access(file, F_OK) != 0)
        usleep(10000);
    enum percuss_result result = percuss_submit(client, request, &request->sequence);
    printf("submitted %llu\n", (unsigned long long)request->sequence);
    while (result == PERCUSS_RESULT_OK &&
           (result = percuss_wait(client, 0, patience, &reply)) == PERCUSS_RESULT_NO_SERVER) {
        printf("lost: %s\n", percuss_error_text());
        lost++;
        result = percuss_client_connect(client, patience);
        if (result == PERCUSS_RESULT_OK)
            result = percuss_submit(client, request, NULL);
    }
    if (result)
        return give_up("submit", 0, begun);
    printf("lost %u, status %d\n", lost, (int)reply.status);
    percuss_reply_free(&reply);
    return EXIT_SUCCESS;
}

int main(int argc, char **argv)
{
    static struct percuss_request request;
    struct percuss_client *client;
    struct percuss_client_config config = percuss_client_config_default();
    if (argc < 4)
        return 2;
    config.domain = (uint32_t)strtoul(argv[1], NULL, 10);
    unsigned most = argc > 4 ? (unsigned)strtoul(argv[4], NULL, 10) : 1u << 30, asked = 0;
    double begun = now();
    setlinebuf(stdout);
    if (percuss_client_create(&config, &client) || percuss_client_connect(client, patience))
        return give_up("connect", 0, begun);
    fill(&request, argv[2]);
    if (argc > 4 && strcmp(argv[4], "submit") == 0)
        return submit(client, &request, argv[3]);
    for (; asked < most && access(argv[3], F_OK) != 0; asked++) {
        struct percuss_reply reply;
        begun = now();
        if (percuss_solve(client, &request, patience, &reply))
            return give_up("solve", asked, begun);
        if (reply.status != PERCUSS_OK) {
            fprintf(stderr, "reply: %s\n", reply.message);
            return EXIT_FAILURE;
        }
        printf("e %.17g\n", reply.contacts[0].restitution);
        if (now() - begun > long_wait)
            printf("waited %.3f\n", now() - begun);
        percuss_reply_free(&reply);
        /* some work of its own */
        usleep(2000);
    }
    printf("answered %u\n", asked);
    percuss_client_free(client);
    return EXIT_SUCCESS;
}
