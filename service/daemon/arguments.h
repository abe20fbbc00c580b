/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The daemon's command line. */
#ifndef PERCUSS_DAEMON_ARGUMENTS_H
#define PERCUSS_DAEMON_ARGUMENTS_H

#include <stdbool.h>

struct arguments {
    const char *config, *catalogue; /* NULL: not given */
    char *shipped;                  /* settings to go by where none are, for free(); NULL: none */
    int domain;                     /* -1: not given */
    const char *partition;          /* NULL: not given; empty: none */
    int log_format;                 /* enum log_format; -1: not given */
    bool check_config;
    const char *check_store; /* file; NULL: not asked for */
};

/* Ends the program for --help, --version and, with exit code 2, wrong usage. */
struct arguments arguments_read(int argc, char **argv);

#endif
