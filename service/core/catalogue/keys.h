/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Reads mappings into structs by tables of keys, and the tables of a catalogue. */
#ifndef PERCUSS_CATALOGUE_KEYS_H
#define PERCUSS_CATALOGUE_KEYS_H

#include "catalogue/reader.h"
#include "model/key.h"
#include "model/material.h"
#include "model/relaxation.h"
#include "model/yield_rate.h"

/* A material as the catalogue states it. */
struct stated_material {
    struct material material;
    double loss_factor;           /* as struct body's */
    double loss_frequency;        /* the same */
    struct relaxation relaxation; /* the same */
    struct yield_rate yield_rate; /* the same */
    bool yield_unstated;          /* the same */
};

/* A term of its relaxation. */
struct stated_term {
    double share, time;
};

extern const struct key_table keys_top;      /* into struct body_set */
extern const struct key_table keys_contact;  /* into struct body_set */
extern const struct key_table keys_friction; /* into struct friction_pair, but for its names */
extern const struct key_table keys_law;      /* into struct own_law, but for names and files */
extern const struct key_table
    keys_material; /* into struct stated_material, but for its relaxation */
extern const struct key_table keys_relaxation; /* into struct stated_term */
extern const struct key_table keys_body; /* into struct body: those of every kind, shape first */

extern const struct key_table keys_site; /* of a mesh, see mesh_entry.c */
extern const struct key_table keys_own;  /* the same of kinds with a material in their file */

/* Reads a whole mapping (entry.value) into `object`: every entry must be a key of the table and
 * stand once, every required key must be there; absent ones leave their field as it is. PERCUSS_OK
 * or PERCUSS_BAD_REQUEST. */
enum percuss_status keys_read(struct reader *reader, struct entry entry,
                              const struct key_table *table, void *object);

/* Reads the value of one key into `object`. */
enum percuss_status keys_read_value(struct reader *reader, const yaml_node_t *value,
                                    const struct key *key, void *object);

#endif
