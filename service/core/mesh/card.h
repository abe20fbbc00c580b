/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Lines of an input deck: keyword lines "*NAME, KEY=VALUE, KEY" and data "1, 2.5, text". As Abaqus
 * and CalculiX read them: any case, blanks anywhere in names but within quotes. */
#ifndef PERCUSS_MESH_CARD_H
#define PERCUSS_MESH_CARD_H

#include "mesh/scan.h"

enum { CARD_LINE_SIZE = 1024, CARD_MOST_PARAMETERS = 16, CARD_TEXT_SIZE = CARD_LINE_SIZE };

struct card {
    char name[CARD_TEXT_SIZE]; /* in capitals, without the star and without blanks */
    int parameter_count;
    struct card_parameter {
        char key[CARD_TEXT_SIZE], value[CARD_TEXT_SIZE]; /* the key as the name above */
    } parameters[CARD_MOST_PARAMETERS];
};

/* The next line that is neither empty nor a comment; joins a keyword line that ends with a comma
 * and the next one where that has parameters, KEY=VALUE or one of the keyword's. False: the file
 * ends, or (with a message) the line is too long. */
bool card_line(struct scan *scan, char line[CARD_LINE_SIZE], enum percuss_status *status);

/* Splits a keyword line into the card and overwrites it; false: it has too many parameters. */
bool card_parse(char *line, struct card *card);

/* A parameter's value without its quotes, "" without one; NULL: there is no such parameter. */
const char *card_value(const struct card *card, const char *key);

/* The next field of a line of data without white space around it, quotes kept; NULL: there is
 * none. */
char *card_field(char **cursor);

/* Makes a name of a field, in place: without its quotes, without blanks outside them. */
void card_name(char *text);

/* Numbers in fields; false with a message that begins with `subject`. An empty or missing field is
 * refused. Labels are less than SIZE_MAX, which stands for none. */
bool card_label(const struct scan *scan, const char *subject, const char *field, size_t *value);
bool card_real(const struct scan *scan, const char *subject, const char *field, double *value);

#endif
