/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Random central impacts that complete finite elements can answer, whatever makes the models differ
 * from them: contacts that yield or not, rods of any slenderness, bodies that are taken as rigid.
 * Scene `number` of a class is the same on every machine. */
#ifndef PERCUSS_TEST_ESTIMATES_DRAWN_MODEL_H
#define PERCUSS_TEST_ESTIMATES_DRAWN_MODEL_H

#include "physics/estimates/drawn.h"

#define MODEL_CLASSES(X)                                                                           \
    X(ELASTIC, "elastic", "a sphere on a rod, both elastic")                                       \
    X(ROD, "rod", "a sphere on a rod that yields")                                                 \
    X(BALL, "ball", "a sphere that yields on a rod")                                               \
    X(CYLINDER, "cylinder", "a sphere on a compact cylinder that may yield")                       \
    X(BLOCK, "block", "a sphere on a block that may yield")                                        \
    X(PAIR, "pair", "two spheres, one of which may yield")

enum model_class {
#define X(name, word, text) MODEL_##name,
    MODEL_CLASSES(X)
#undef X
        MODEL_COUNT
};

struct model_scene {
    struct solve_request request;
    char text[240];
};

/* Replaces the lab's bodies. Contacts are small: less than a fifth of the radii, as far as a blow
 * that took all of the energy would tell. */
void model_draw(struct lab *lab, enum model_class class, uint64_t number,
                struct model_scene *scene);

/* The class's word on the command line; MODEL_COUNT: none. */
const char *model_class_word(enum model_class class);
const char *model_class_text(enum model_class class);
enum model_class model_class_find(const char *word);

#endif
