/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The keys a catalogue may hold, as tables: they drive the reading of mappings into structs and say
 * in messages what is allowed. */
#ifndef PERCUSS_CATALOGUE_KEYS_H
#define PERCUSS_CATALOGUE_KEYS_H

#include <stdbool.h>
#include <stddef.h>

#include "catalogue/reader.h"
#include "model/limits.h"

enum key_type {
    KEY_NUMBER,  /* double within `limit` */
    KEY_NUMBERS, /* list of three of them */
    KEY_WHOLE,   /* unsigned, 1 .. limit->high */
    KEY_FLAG,    /* bool */
    KEY_WORD,    /* enum: the index in `words` */
    KEY_ENDS,    /* two enums: one word for both, or a list of two */
    KEY_SHEAR,   /* struct body's shear_rule and shear_number */
    KEY_NAME,    /* char[PERCUSS_ID_SIZE]; the caller looks it up */
    KEY_SECTION, /* a mapping of `nested` keys into the same struct */
    KEY_CALLER   /* a mapping the caller reads */
};

struct key_table;

struct key {
    const char *name;
    enum key_type type;
    const struct limit *limit; /* the unit stands in its text */
    bool required;
    unsigned shapes; /* KEYS_OF(shape), or several; KEYS_ANY */
    size_t offset;   /* in the struct read into */
    const char *const *words;
    size_t word_count; /* NULL among the words: a number without a word */
    const struct key_table *nested;
};

struct key_table {
    const char *owner; /* "a material"; NULL: named by its shape */
    const struct key *keys;
    size_t count;
};

#define KEYS_OF(shape) (1u << (shape))
#define KEYS_ANY       (~0u)

extern const struct key_table keys_top;      /* into struct body_set */
extern const struct key_table keys_contact;  /* into struct body_set */
extern const struct key_table keys_material; /* into struct material */
extern const struct key_table keys_body;     /* into struct body */

/* The key of that name that is allowed for the shape; NULL if there is none. */
const struct key *keys_find(const struct key_table *table, const char *name, unsigned shapes);

/* Reads a whole mapping (entry.value) into `object`: every entry must be a key of the table allowed
 * for the shape and stand once, every required key must be there; absent ones leave their field as
 * it is. PERCUSS_OK or PERCUSS_BAD_REQUEST. */
enum percuss_status keys_read(struct reader *reader, struct entry entry,
                              const struct key_table *table, unsigned shapes, void *object);

/* Reads the value of one key into `object`. */
enum percuss_status keys_read_value(struct reader *reader, const yaml_node_t *value,
                                    const struct key *key, void *object);

/* What a key's value may be, in words that follow "must be". */
struct key_text {
    char text[320];
};
struct key_text keys_allowed(const struct key *key);

/* The names of the keys allowed for these shapes. */
struct key_text keys_list(const struct key_table *table, unsigned shapes);

#endif
