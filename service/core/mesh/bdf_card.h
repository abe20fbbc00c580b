/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Cards of Nastran's bulk data: lines in fields of 8 or 16 columns or between commas, each line
 * with those that continue it (MSC Nastran Quick Reference Guide, "Format of bulk data entries").
 */
#ifndef PERCUSS_MESH_BDF_CARD_H
#define PERCUSS_MESH_BDF_CARD_H

#include "mesh/scan.h"

enum { BDF_FIELD_SIZE = 24, BDF_LINE_SIZE = 512, BDF_PATH_SIZE = 1024 };

/* A card. Its fields are numbered as in Nastran's manuals: 2 is the first one behind the name, 9
 * the last one of the first line, 10 the first one of the next line (marks of continuation, which
 * the manuals count too, are left out). Zero it before use; free it with bdf_card_free. */
struct bdf_card {
    const struct scan *scan;   /* for messages */
    size_t line;               /* where it begins */
    char name[BDF_FIELD_SIZE]; /* in capitals, without a star */
    size_t count, room;
    char (*fields)[BDF_FIELD_SIZE];
};

/* Reading of one file. */
struct bdf_lines {
    struct scan scan;
    bool bulk;  /* past BEGIN BULK, or `alone` */
    bool alone; /* a mesh alone: the file has neither control nor BEGIN BULK */
    bool held;  /* `text` is read already */
    size_t line;
    char text[BDF_LINE_SIZE]; /* without comment, tabs as spaces */
};

/* How a file begins: a whole one with statements of control, unless it has neither CEND nor BEGIN
 * BULK, an included one with what stands where it is named. */
enum bdf_start { BDF_WHOLE, BDF_CONTROL, BDF_BULK };

/* Opens a file. PERCUSS_BAD_REQUEST: it cannot be read. Close lines->scan. */
enum percuss_status bdf_open(struct bdf_lines *lines, const char *path, enum bdf_start start,
                             struct fault *fault);

/* The next card of bulk data; false: the file or its data (ENDDATA) end, or, with a message in
 * *status, a line cannot be understood. A line INCLUDE is a card of this name, whose path
 * bdf_include gives. PARAM is a card above BEGIN BULK, too. */
bool bdf_next(struct bdf_lines *lines, struct bdf_card *card, enum percuss_status *status);

/* The path on the line INCLUDE that has just been read, beside the file that names it. */
enum percuss_status bdf_include(struct bdf_lines *lines, char path[BDF_PATH_SIZE]);

void bdf_card_free(struct bdf_card *card);

/* "FILE:LINE: NAME: message". */
enum percuss_status bdf_refuse(const struct bdf_card *card, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The text of a field, "" where the card is shorter. */
const char *bdf_field(const struct bdf_card *card, size_t field);
bool bdf_is_blank(const struct bdf_card *card, size_t field);

/* Numbers; a blank field leaves *value as it is. False with a message: it is none. Nastran's reals
 * may lack the E of an exponent: 1.5-3. */
bool bdf_size(const struct bdf_card *card, size_t field, size_t *value);
bool bdf_real(const struct bdf_card *card, size_t field, double *value);

/* A number > 0 that must be there. */
bool bdf_label(const struct bdf_card *card, size_t field, size_t *value);

#endif
