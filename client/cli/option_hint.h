/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Which option was probably meant by one that there is not. */
#ifndef PERCUSS_CLI_OPTION_HINT_H
#define PERCUSS_CLI_OPTION_HINT_H

#include <argp.h>
#include <percuss/percuss.h>
#include <stdbool.h>

struct option_hint {
    char name[PERCUSS_ID_SIZE]; /* as it was typed, without a value */
    const char *meant;          /* the one that is nearest; NULL: none is near */
};

/* Looks for the first long option of a command line that the argp does not know; false: it knows
 * all of them. */
bool option_hint_find(const struct argp *argp, int argc, char **argv, struct option_hint *hint);

/* Says which was meant, before argp refuses the other. */
void option_hint_say(const struct argp *argp, int argc, char **argv);

#endif
