/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A command line that is being typed: the meaning of its words, and the word to complete. */
#ifndef PERCUSS_CLI_COMPLETE_LINE_H
#define PERCUSS_CLI_COMPLETE_LINE_H

#include "commands.h"

struct line {
    struct common *common;
    const struct command *command;    /* NULL: not given yet */
    bool help;                        /* the command is help */
    const struct argp_option *option; /* its value is next; NULL: none */
    const char *bodies[2];            /* --a, --b; NULL: not given */
    const char *before;               /* part of the last word that stays, for example "--a=" */
    int before_length;
    const char *word; /* its rest, to be completed */
    size_t split;     /* characters of the last word that its shell takes for words before it */
    char *text;       /* all words */
};

/* Reads the words behind the program's name, the last one unfinished. bash splits them at = : @
 * too. False: out of memory. Release with line_free. */
bool line_read(int count, char **words, struct common *common, struct line *line);
void line_free(struct line *line);

/* The argp of its options. */
const struct argp *line_argp(const struct line *line);

/* The option of that name, or, where it is not 0, of that letter, in an argp and those below it;
 * NULL: there is none. */
const struct argp_option *line_find_option(const struct argp *argp, const char *name, size_t length,
                                           int letter);

/* Whether an array of options ends here. */
bool line_options_end(const struct argp_option *option);

/* Prints a way to go on, if the word allows it, with its description (NULL: none). */
void line_offer(const struct line *line, const char *text, const char *what);

#endif
