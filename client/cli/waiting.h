/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* While a command waits for answers: an interrupt gives up what it waits for, and whoever sits at a
 * terminal sees how long it takes and, where it is known, how far it is. One command, one thread.
 */
#ifndef PERCUSS_CLI_WAITING_H
#define PERCUSS_CLI_WAITING_H

#include "cli.h"

/* From now on, for calls on that client; again for the same one does nothing. `what` is counted, by
 * waiting_count; NULL: nothing is. A second interrupt (SIGINT, SIGTERM) ends the program. */
void waiting_begin(const struct common *common, struct percuss_client *client, const char *what);

/* So many more are answered. False: it was interrupted. */
bool waiting_count(size_t answered);

/* All is answered: interrupts end the program again, and the terminal is as it was. */
void waiting_end(void);

/* Takes what is shown off the terminal, before something else is told there. */
void waiting_clear(void);

/* The exit code of what was interrupted, as a shell has it. */
int waiting_exit_code(void);

#endif
