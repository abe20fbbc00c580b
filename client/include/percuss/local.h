/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* libpercuss-local: the answers of a percussd, to the same bits, without one.
 *
 * percuss_local_open makes a client of the solver in this process: no daemon, no network, no DDS.
 * The functions of percuss.h, ensemble.h, trace.h, specimen.h and slow_link.h serve it, here as in
 * libpercuss. It is connected from the beginning, to a server with the id "percuss in here".
 *
 * A question is solved in the thread that asks: within percuss_solve, or, after percuss_submit,
 * within percuss_wait or percuss_poll. When the timeout passes the solve is given up (TIMEOUT; a
 * submitted request stays outstanding); options.deadline counts from when the solve begins. Several
 * threads may ask one client at once: each has a workspace of its own, of which the client keeps as
 * many as were in use together. Only an ensemble starts threads, which end with it; its timeout
 * never passes, as this process says that it goes on. Replies are not kept: a question asked again
 * is solved again.
 *
 * There is no global state: several clients know nothing of each other, and a program that loaded
 * the library with dlopen may dlclose it when its clients are freed. Of the libraries that it uses,
 * HDF5 stays if a catalogue with meshes was read. */
#ifndef PERCUSS_LOCAL_H
#define PERCUSS_LOCAL_H

#include <percuss/percuss.h>

#ifdef __cplusplus
extern "C" {
#endif

struct percuss_local_config {
    /* A file as percussd reads it, of which count: catalogue, tables, tables_alone, bodies, store,
     * workers, tokens, limits.seconds and limits.samples. NULL: the one that is installed beside
     * the library, if there is one, and nothing is written to disk. Contact tables of the user's
     * own (PERCUSS_TABLES, ~/.local/share/percuss/tables) stand beside those of the settings. */
    const char *settings;
    const char *catalogue;   /* file; NULL: that of the settings */
    uint8_t id[16];          /* of the client; all zero is an id too */
    uint64_t first_sequence; /* of the first request, > 0 */
    unsigned threads;        /* of an ensemble; 0: as the settings say, or as many as there are
                                processors. No answer depends on it */
};

/* The installed settings with their catalogue and tables, first sequence 1. */
PERCUSS_API struct percuss_local_config percuss_local_config_default(void);

/* Reads the catalogue and makes a client; NULL config: the default. The caller frees it.
 * INVALID_ARGUMENT, with file, line and the allowed values, or NO_MEMORY leave *client NULL. */
PERCUSS_API enum percuss_result percuss_local_open(const struct percuss_local_config *config,
                                                   struct percuss_client **client);

#ifdef __cplusplus
}
#endif

#endif
