/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Random scenes by class, for the campaigns of docs/lab/accuracy.md. Scene `number` of a class is
 * the same on every machine. */
#ifndef PERCUSS_TEST_ESTIMATES_DRAWN_H
#define PERCUSS_TEST_ESTIMATES_DRAWN_H

#include "physics/support.h"

#define SCENE_CLASSES(X)                                                                           \
    X(SINGLE, "single", "a sphere on a rod or a beam")                                             \
    X(HEAVY, "heavy", "a heavy sphere on a light beam, any ends, any place")                       \
    X(GROUP, "group", "two to five spheres on a beam")                                             \
    X(ROW, "row", "two to twenty spheres in a row")                                                \
    X(RINGING, "ringing", "a second blow on bodies that ring from the first")                      \
    X(ECCENTRIC, "eccentric", "a sphere beside the axis of a rectangular bar")                     \
    X(ROLLED, "rolled", "two flexible bars, rolled about their axes")                              \
    X(CHAIN, "chain", "two to five blows by token, damped or not")                                 \
    X(OBLIQUE, "oblique", "contacts with friction, at any angle")                                  \
    X(LOSSY, "lossy", "a sphere on a wall, a rod or a beam, of plastics and rubber")               \
    X(LOSSY_GROUP, "lossy-group", "two to five spheres in a row or on a beam, of the same")        \
    X(RUBBED, "rubbed", "one sphere as of lossy with friction, at any angle")

enum scene_class {
#define X(name, word, text) CLASS_##name,
    SCENE_CLASSES(X)
#undef X
        CLASS_COUNT
};

enum { SCENE_MOST_EARLIER = 4 };

struct scene_drawn {
    /* blows before the request, each from the states that the one before it left, of the answer's
     * own chain and of the reference's; `elapsed` of all of them is from the stated instant of the
     * one before */
    size_t earlier_count;
    struct solve_request earlier[SCENE_MOST_EARLIER];
    struct solve_request request; /* options.tolerance is the judge's */
    struct solve_request plain;   /* the same impact, for the reference: where a roll must not
                                     matter, the one without it */
    struct body_state *states[PERCUSS_MAX_BODIES]; /* owned */
    char text[320];
};

/* Replaces the lab's catalogue and draws a scene. False: no scene of that number (the first blow
 * of a ringing one was refused). */
bool scene_draw(struct lab *lab, enum scene_class class, uint64_t number,
                struct scene_drawn *scene);

void scene_release(struct scene_drawn *scene);

/* Copies the states that a blow left, in place of those that are there. */
void scene_take_state(const struct body_state *state, struct body_state **place);

/* The class's word on the command line; CLASS_COUNT: none. */
const char *scene_class_word(enum scene_class class);
const char *scene_class_text(enum scene_class class);
enum scene_class scene_class_find(const char *word);

/* What the files that draw share. */
struct material scene_material(uint64_t *r);
double scene_log(uint64_t *r, double low, double high);
int scene_pick(uint64_t *r, int count);

/* The classes of several files. */
void scene_draw_group(struct lab *lab, uint64_t *r, struct scene_drawn *scene);
void scene_draw_row(struct lab *lab, uint64_t *r, struct scene_drawn *scene);
bool scene_draw_ringing(struct lab *lab, uint64_t *r, struct scene_drawn *scene);
void scene_draw_chain(struct lab *lab, uint64_t *r, uint64_t number, struct scene_drawn *scene);
void scene_draw_eccentric(struct lab *lab, uint64_t *r, struct scene_drawn *scene);
void scene_draw_rolled(struct lab *lab, uint64_t *r, struct scene_drawn *scene);
void scene_draw_oblique(struct lab *lab, uint64_t *r, struct scene_drawn *scene);
void scene_draw_lossy(struct lab *lab, uint64_t *r, struct scene_drawn *scene);
void scene_draw_lossy_group(struct lab *lab, uint64_t *r, struct scene_drawn *scene);
void scene_draw_rubbed(struct lab *lab, uint64_t *r, struct scene_drawn *scene);

/* A beam of any ends in the lab under that id; returns it. */
const struct body *scene_beam(struct lab *lab, uint64_t *r, const char *id);

/* A place along a bar: its middle, anywhere, near an end. */
double scene_place(uint64_t *r, double length);

/* Appends to the scene's text. */
__attribute__((format(printf, 2, 3))) void scene_say(struct scene_drawn *scene, const char *format,
                                                     ...);

#endif
