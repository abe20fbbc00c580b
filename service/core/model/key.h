/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The keys of a catalogue as tables: they drive the reading of mappings into structs and the checks
 * of the values, and messages list the allowed values from them. */
#ifndef PERCUSS_MODEL_KEY_H
#define PERCUSS_MODEL_KEY_H

#include <stdbool.h>
#include <stddef.h>

#include "model/limits.h"

enum key_type {
    KEY_NUMBER,  /* double within `limit` */
    KEY_TWICE,   /* twice the double, within `limit`: a diameter where the struct has the radius */
    KEY_NUMBERS, /* list of three of them */
    KEY_WHOLE,   /* unsigned, 1 .. limit->high; 0: absent */
    KEY_FLAG,    /* bool */
    KEY_WORD,    /* enum: the index in `words` */
    KEY_ENDS,    /* two enums: one word for both, a list or a word of two, or cantilever */
    KEY_SHEAR,   /* struct body's shear_rule and shear_number */
    KEY_DAMPING, /* struct body's damping, or a list: damping_shares too */
    KEY_YIELD,   /* struct stated_material's yield, or that there is none */
    KEY_KIND,    /* struct body's kind */
    KEY_NAME,    /* char[PERCUSS_ID_SIZE]; the caller looks it up */
    KEY_SECTION, /* a mapping of `nested` keys into the same struct */
    KEY_TEXT,    /* not empty; the caller reads it */
    KEY_LIST,    /* a list the caller reads */
    KEY_CALLER   /* a mapping the caller reads */
};

struct key {
    const char *name;
    enum key_type type;
    const struct limit *limit; /* the unit stands in its text */
    bool required;
    size_t offset; /* in the struct read into */
    const char *const *words;
    size_t word_count; /* NULL among the words: a number without a word */
    const struct key_table *nested;
    double absent;          /* KEY_NUMBER, not required: the value where the key is absent */
    const char *instead[2]; /* where the key is absent one of these must be present; NULL: none */
    const char *apart[2];   /* keys beside which it must be absent; NULL: none */
    const char *needs;      /* the key, other than `none`, without which it must be absent, or 0 */
    const char *allowed; /* of a value that the caller reads, in words that follow "must be"; NULL:
                            by type */
    const char *otherwise; /* the value where the key is absent; NULL: it is required */
    const char *meaning;   /* for the reference, docs/reference/catalogue.md */
};

struct key_table {
    const char *owner; /* "a material", "rod" */
    const struct key *keys;
    size_t count;
    const struct key_table *before; /* keys that come before these; NULL: none */
};

#define KEY_SAYS(default, text) .otherwise = default, .meaning = text
#define KEY_WORDS(array)        .words = array, .word_count = sizeof array / sizeof *array
#define KEY_OF(of, member)      .offset = offsetof(struct of, member)

/* The allowed values of a key, in words that follow "must be". */
struct key_text {
    char text[400];
};
struct key_text key_allowed(const struct key *key);

/* The names of a table's keys. */
struct key_text key_list(const struct key_table *table);

/* A table's key number `number`; NULL: there are no more. */
const struct key *key_at(const struct key_table *table, size_t number);

#endif
