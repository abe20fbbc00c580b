/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Binds UDP ports, as that many participants of DDS would, says so, and waits for the end of its
 * input. usage: take_ports FIRST COUNT */
#include <arpa/inet.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

int main(int argc, char **argv)
{
    enum { ATTEMPTS = 100, PAUSE = 100000 }; /* us */
    char end;
    if (argc != 3)
        return 2;
    const int first = atoi(argv[1]), count = atoi(argv[2]);
    for (int port = first; port < first + count; port++) {
        struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
        int file = socket(AF_INET, SOCK_DGRAM, 0), left = ATTEMPTS;
        /* a client of another story may have it for a moment */
        while (file >= 0 && bind(file, (struct sockaddr *)&address, sizeof address) != 0 &&
               left-- > 0)
            usleep(PAUSE);
        if (file < 0 || left < 0) {
            fprintf(stderr, "port %d cannot be bound\n", port);
            return 1;
        }
    }
    puts("bound");
    fflush(stdout);
    while (read(STDIN_FILENO, &end, 1) > 0)
        ;
    return 0;
}
