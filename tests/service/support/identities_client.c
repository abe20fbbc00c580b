/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Several secured clients of one process. Each line on stdin is an act: "open N FOLDER SECONDS"
 * makes client N (0 to 3) with that identity and prints what its connection comes to within that
 * time, "free N" frees it.
 *
 * usage: identities_client DOMAIN */
#include <percuss/percuss.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CLIENTS = 4 };

static enum percuss_result open_client(uint32_t domain, const char *folder, double seconds,
                                       struct percuss_client **client)
{
    struct percuss_client_config config = percuss_client_config_default();
    config.domain = domain;
    enum percuss_result result = percuss_client_create_secured(&config, folder, client);
    return result ? result : percuss_client_connect(*client, seconds);
}

int main(int argc, char **argv)
{
    struct percuss_client *clients[CLIENTS] = {NULL};
    char line[4096], act[16], folder[4096];
    unsigned n;
    double seconds;
    if (argc != 2)
        return 2;
    while (fgets(line, sizeof line, stdin)) {
        const int read = sscanf(line, "%15s %u %4095s %lf", act, &n, folder, &seconds);
        if (read < 2 || n >= CLIENTS)
            return 2;
        if (strcmp(act, "open") == 0 && read == 4) {
            const enum percuss_result result =
                open_client((uint32_t)strtoul(argv[1], NULL, 10), folder, seconds, &clients[n]);
            printf("%u: %s\n", n, percuss_result_text(result));
        } else {
            percuss_client_free(clients[n]);
            clients[n] = NULL;
            printf("%u: freed\n", n);
        }
        fflush(stdout);
    }
    for (n = 0; n < CLIENTS; n++)
        percuss_client_free(clients[n]);
    return 0;
}
