/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Lists the bodies of a server that reads its catalogue again and again. All bodies of a catalogue
 * have one radius, which is the coefficient of its only pair of materials, too.
 *
 * usage: whole_lists DOMAIN SECONDS    exit code 1: a list was of two catalogues, or all of one */
#include <math.h>
#include <percuss/percuss.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* The number that all of a list have; NAN: they have several. */
static double number_of(const struct percuss_body_list *list)
{
    double number = list->bodies[0].radius;
    for (size_t i = 0; i < list->count; i++)
        if (list->bodies[i].radius != number)
            return NAN;
    return list->pair_count == 1 && list->pairs[0].friction == number ? number : NAN;
}

int main(int argc, char **argv)
{
    struct percuss_client *client;
    struct percuss_client_config config = percuss_client_config_default();
    unsigned lists = 0, changes = 0, mixed = 0;
    double last = 0.0;
    if (argc != 3)
        return 2;
    config.domain = (uint32_t)strtoul(argv[1], NULL, 10);
    const double end = now() + strtod(argv[2], NULL);
    if (percuss_client_create(&config, &client) || percuss_client_connect(client, 20.0)) {
        puts(percuss_error_text());
        return EXIT_FAILURE;
    }
    while (now() < end) {
        struct percuss_body_list list;
        if (percuss_bodies(client, 20.0, &list) || list.count == 0) {
            puts(percuss_error_text());
            return EXIT_FAILURE;
        }
        double number = number_of(&list);
        lists++;
        mixed += isnan(number);
        changes += number != last;
        last = number;
        percuss_body_list_free(&list);
    }
    percuss_client_free(client);
    printf("%u lists, %u changes, %u of two catalogues\n", lists, changes, mixed);
    return changes > 3 && mixed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
