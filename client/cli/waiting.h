/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* While a command waits for answers: an interrupt gives up the question, and a terminal shows the
 * time that it takes and, where known, its progress. One command, one thread. */
#ifndef PERCUSS_CLI_WAITING_H
#define PERCUSS_CLI_WAITING_H

#include "cli.h"

/* From now on, for calls on that client; again for the same one does nothing. `what` names the
 * things that waiting_count counts; NULL: none. A second interrupt (SIGINT, SIGTERM) ends the
 * program. */
void waiting_begin(const struct common *common, struct percuss_client *client, const char *what);

/* So many more are answered. False: it was interrupted. */
bool waiting_count(size_t answered);

/* All is answered: interrupts end the program again, and the terminal is as it was. */
void waiting_end(void);

/* Clears the progress from the terminal, before other output. */
void waiting_clear(void);

/* The exit code of an interrupted command, as a shell has it. */
int waiting_exit_code(void);

#endif
