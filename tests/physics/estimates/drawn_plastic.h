/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Random blows that leave dents and that complete finite elements can answer: a sphere on the end
 * face of a free rod, one of them of a metal that yields, hardening or not. Scene `number` of a
 * class is the same on every machine. */
#ifndef PERCUSS_TEST_ESTIMATES_DRAWN_PLASTIC_H
#define PERCUSS_TEST_ESTIMATES_DRAWN_PLASTIC_H

#include "physics/estimates/drawn.h"

#define PLASTIC_CLASSES(X)                                                                         \
    X(SLENDER, "slender", "a sphere on a yielding rod of 0.6 to 1.2 times its radius")             \
    X(THICK, "thick", "a sphere on a yielding rod of 1.5 to 4 times its radius")                   \
    X(BALL, "ball", "a yielding sphere on an elastic rod")

enum plastic_class {
#define X(name, word, text) PLASTIC_##name,
    PLASTIC_CLASSES(X)
#undef X
        PLASTIC_COUNT
};

struct plastic_scene {
    struct solve_request request;
    double radius; /* of the sphere, m */
    char text[200];
};

/* Replaces the lab's bodies. A blow that took all of the energy would go beyond three times the
 * indentation of first yield, and not deeper than 0.02 of the sphere's radius, where strains are
 * small. */
void plastic_draw(struct lab *lab, enum plastic_class class, uint64_t number,
                  struct plastic_scene *scene);

/* The class's word on the command line; PLASTIC_COUNT: none. */
const char *plastic_class_word(enum plastic_class class);
const char *plastic_class_text(enum plastic_class class);
enum plastic_class plastic_class_find(const char *word);

#endif
