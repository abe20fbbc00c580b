/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Keywords of decks that describe no node, element or set, and what they mean for a body. Names are
 * in capitals, without blanks. */
#ifndef PERCUSS_MESH_INP_KEYWORDS_H
#define PERCUSS_MESH_INP_KEYWORDS_H

#include <stdbool.h>
#include <stddef.h>

enum keyword_kind {
    KEYWORD_UNKNOWN,
    KEYWORD_HARMLESS, /* says nothing of a free elastic body's vibration */
    KEYWORD_TOLD,     /* left out, with a line that says so */
    KEYWORD_LAW,      /* of a material */
    KEYWORD_REFUSED
};

/* *meaning: of what is told or refused. */
enum keyword_kind keyword_find(const char *name, const char **meaning);

enum keyword_parameter_kind {
    PARAMETER_FREE,    /* parameters of the keyword do not matter here */
    PARAMETER_UNKNOWN, /* the keyword has none of that name */
    PARAMETER_VALUE,   /* KEY=VALUE */
    PARAMETER_FLAG     /* KEY alone, or with a value */
};

/* The parameter `key` of a keyword, as the manuals of Abaqus and CalculiX list them. */
enum keyword_parameter_kind keyword_parameter(const char *name, const char *key);

/* Whether a keyword after *STEP is to be told. */
bool keyword_find_in_step(const char *name, const char **meaning);

/* Whether a law stands in place of *ELASTIC, rather than beside it. */
bool keyword_replaces_elastic(const char *name);

/* The nodes of an element whose type ends with 3D and a number of at least ten (DC3D20, AC3D10),
 * which may take several lines; 0: another type. */
size_t keyword_solid_nodes(const char *type);

/* Whether a type of element is a shell, a plane one or a line, which meshers write for surfaces and
 * edges. */
bool keyword_is_surface(const char *type);

#endif
