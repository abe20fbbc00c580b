/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The settings of the daemon's configuration file; config/percussd.yaml explains each key. A solver
 * in a program uses those that its answers depend on. */
#ifndef PERCUSS_RESPOND_SETTINGS_H
#define PERCUSS_RESPOND_SETTINGS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"
#include "wire_partition.h"

enum { SETTINGS_PATH_SIZE = 4096, SETTINGS_FOLDERS_MOST = 8 };

/* The level and the form of a log. */
enum log_level { LEVEL_ERROR, LEVEL_WARNING, LEVEL_INFO, LEVEL_DEBUG, LEVEL_COUNT };

/* For people, for the journal of systemd (which has its own clock, and takes the level as "<N>"),
 * and one JSON object a line. */
enum log_format { LOG_TEXT, LOG_JOURNAL, LOG_JSON, LOG_FORMAT_COUNT };

/* "error", "warning", ... */
const char *log_level_name(enum log_level level);

/* "text", "journal", "json" */
const char *log_format_name(enum log_format format);

struct settings {
    char catalogue[SETTINGS_PATH_SIZE];                     /* empty: not given */
    char tables[SETTINGS_FOLDERS_MOST][SETTINGS_PATH_SIZE]; /* folders of contact tables, up to the
                                                               first empty one; none: no tables */
    bool tables_alone; /* neither the shipped tables nor those of one's own beside them */
    bool shipped;      /* no file of settings was named: these are the shipped ones */
    char bodies[SETTINGS_PATH_SIZE];   /* folder of reduced bodies; empty: none */
    double bodies_days;                /* that one stays there unused */
    char security[SETTINGS_PATH_SIZE]; /* folder of its identity; empty: without DDS Security */
    unsigned domain;
    char partition[WIRE_PARTITION_SIZE]; /* empty: none */
    unsigned workers;
    unsigned queue_capacity;
    bool inline_solves;
    double limit_seconds;                  /* of one request */
    unsigned limit_samples, limit_clients; /* of one ensemble; that read replies */
    unsigned limit_megabytes;              /* of all that is kept; 0: as its parts have it */
    unsigned token_count, token_megabytes;
    double token_minutes;
    unsigned replies_per_client, reply_megabytes;
    unsigned box_megabytes, body_megabytes; /* of vibrations, and of prepared bodies; 0: no limit.
                                               No keys of their own: limits_fit has them fit */
    char store[SETTINGS_PATH_SIZE];         /* empty: no specimens */
    char backup[SETTINGS_PATH_SIZE];        /* of the store; empty: none */
    unsigned stored_replies;
    char standby[SETTINGS_PATH_SIZE]; /* the daemon with its lock answers; empty: this one */
    char metrics[SETTINGS_PATH_SIZE]; /* file for a monitoring system; empty: none */
    double session_minutes;
    double drain_seconds;
    enum log_level log_level;
    enum log_format log_format;
};

/* The defaults; as many workers as processors. */
struct settings settings_default(void);

/* Reads a file over the values of `settings`: PERCUSS_OK, or PERCUSS_BAD_REQUEST with "FILE:LINE:
 * KEY: VALUE: must be ...". A relative path in it starts from the file's folder. */
enum percuss_status settings_load(const char *path, struct settings *settings, struct fault *fault);

/* What the value of a key is. */
enum settings_kind {
    SETTINGS_WHOLE,
    SETTINGS_NUMBER,
    SETTINGS_SWITCH,
    SETTINGS_PATH,
    SETTINGS_FOLDERS, /* a path, or a list of them */
    SETTINGS_PARTITION,
    SETTINGS_LEVEL,
    SETTINGS_FORMAT
};

/* A key for the reference, docs/reference/settings.md, and for the schema. */
struct settings_row {
    const char *path, *meaning; /* a dot in the path separates a section from its keys */
    enum settings_kind kind;
    double low, high; /* of a number */
    char allowed[96], otherwise[64];
};

/* The key number `number`, in the order of the table; false: there are no more. */
bool settings_describe(size_t number, struct settings_row *row);

/* Range of `domain`, for the command line too. */
enum { SETTINGS_MAX_DOMAIN = 230 };

#endif
