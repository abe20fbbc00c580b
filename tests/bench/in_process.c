/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a question costs through DDS and in this process, in turns in one run: medians and their
 * ratio, CSV. Needs a percussd with the shipped catalogue. usage: in_process DOMAIN QUESTIONS */
#include <percuss/local.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { MOST = 10000 };
static const double TOLERANCE = 1e-3;

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void check(enum percuss_result result)
{
    if (result == PERCUSS_RESULT_OK)
        return;
    fprintf(stderr, "%s: %s\n", percuss_result_text(result), percuss_error_text());
    exit(EXIT_FAILURE);
}

static double ask(struct percuss_client *client, const struct percuss_request *request,
                  double *restitution)
{
    struct percuss_reply reply;
    double begun = now();
    check(percuss_solve(client, request, 60.0, &reply));
    double seconds = now() - begun;
    *restitution = reply.contact_count ? reply.contacts[0].restitution : -1.0;
    percuss_reply_free(&reply);
    return seconds;
}

static int compare(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

static double median(double *values, size_t count)
{
    qsort(values, count, sizeof *values, compare);
    return values[count / 2];
}

/* Speeds differ, so that nothing is answered twice. */
static void measure(struct percuss_client *clients[2], const struct percuss_body_list *bodies,
                    const char *b, size_t count)
{
    static double seconds[2][MOST];
    struct percuss_request request;
    struct percuss_pair pair = percuss_pair_default(percuss_body_find(bodies, "steel-sphere"),
                                                    percuss_body_find(bodies, b));
    for (size_t i = 0; i < count; i++) {
        double restitution[2];
        pair.speed = 0.2 + 1e-7 * (double)i;
        check(percuss_contact_pair(&pair, &request));
        request.options.tolerance = TOLERANCE;
        for (int k = 0; k < 2; k++)
            seconds[k][i] = ask(clients[k], &request, &restitution[k]);
        if (restitution[0] != restitution[1]) {
            fprintf(stderr, "%s: the answers differ\n", b);
            exit(EXIT_FAILURE);
        }
    }
    double service = median(seconds[0], count), here = median(seconds[1], count);
    printf("%s,%.3g,%.3g,%.2f\n", b, service, here, service / here);
}

int main(int argc, char **argv)
{
    static const char *const STRUCK[] = {"steel-wall", "al-rod", "al-beam"};
    struct percuss_client *clients[2];
    struct percuss_body_list bodies;
    struct percuss_client_config config = percuss_client_config_default();
    size_t count = argc == 3 ? strtoul(argv[2], NULL, 10) : 0;
    if (count < 1 || count > MOST) {
        fprintf(stderr, "usage: in_process DOMAIN QUESTIONS (1 to %d)\n", MOST);
        return 2;
    }
    config.domain = (uint32_t)strtoul(argv[1], NULL, 10);
    check(percuss_client_create(&config, &clients[0]));
    check(percuss_client_connect(clients[0], 10.0));
    check(percuss_local_open(NULL, &clients[1]));
    check(percuss_bodies(clients[1], 1.0, &bodies));
    puts("struck,service,in_process,ratio");
    for (size_t i = 0; i < sizeof STRUCK / sizeof *STRUCK; i++)
        measure(clients, &bodies, STRUCK[i], count);
    percuss_body_list_free(&bodies);
    for (int k = 0; k < 2; k++)
        percuss_client_free(clients[k]);
    return EXIT_SUCCESS;
}
