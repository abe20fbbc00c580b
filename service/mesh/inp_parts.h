/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Parts of inp.c: keywords (inp.c) set what the lines of data after them are (inp_data.c). */
#ifndef PERCUSS_MESH_INP_PARTS_H
#define PERCUSS_MESH_INP_PARTS_H

#include "mesh/card.h"
#include "mesh/deck.h"

enum { INP_MOST_DEPTH = 8, INP_PATH_SIZE = 1024 };

struct inp;
typedef enum percuss_status inp_line_reader(struct inp *inp, char *line);

/* Where reading is in the deck. */
struct inp {
    struct scan *scan;
    struct deck deck;
    inp_line_reader *read; /* lines of data after the last keyword; NULL: they do not matter */
    int depth, parts, instances;
    bool assembly, instance; /* within */
    bool begun, done;        /* a keyword has come, a *STEP has */
    size_t set, material, part;
    bool generate, solid;
    enum element_type type;
    size_t label, nodes[ELEMENT_MOST_NODES], filled; /* the element that is being read */
};

/* The path of a file that another one names by *INCLUDE. */
void inp_beside(const char *file, const char *name, char path[INP_PATH_SIZE]);

enum percuss_status inp_out_of_memory(const struct inp *inp);

inp_line_reader inp_read_node, inp_read_element, inp_read_node_set, inp_read_element_set,
    inp_read_surface, inp_read_elastic, inp_read_density, inp_read_plastic, inp_read_instance;

#endif
