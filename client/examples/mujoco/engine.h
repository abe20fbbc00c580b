/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* MuJoCo as an engine of the slow scale: contacts, the callbacks, steps that stop at a touch.
 * Contacts are recorded by MuJoCo (margin) but carry no force (gap > margin). */
#ifndef MUJOCO_ENGINE_H
#define MUJOCO_ENGINE_H

#include <mujoco/mujoco.h>
#include <percuss/slowscale.h>

enum { ENGINE_BODIES = 8, ENGINE_CONTACTS = 16 };

/* A body of the model that impacts are asked for. */
struct engine_body {
    const char *name; /* in the MuJoCo model */
    const char *id;   /* in percussd's catalogue */
    bool along_y;     /* the catalogue's beam lies along x, the model's along y */
};

struct engine {
    mjModel *model;
    mjData *data, *start, *trial; /* now; at the start of a step; for looking ahead */
    size_t body_count;
    int bodies[ENGINE_BODIES]; /* MuJoCo's numbers */
    struct engine_body names[ENGINE_BODIES];
    size_t constraint_count; /* equality constraints as directions M^-1 j, orthonormal in M */
    double *constraints;     /* [constraint_count x nv] */
    double friction;         /* coefficient of all contacts; 0: the catalogue's, if any */
    bool fixed;              /* steps of the model's own size, never back to a touch */
    double
        taken; /* J, that the impulses took from all bodies, with MuJoCo's own masses and joints */
    double applied[ENGINE_BODIES][ENGINE_BODIES]; /* N s, by the contact's a and b */
};

/* Loads a model. False: the reason is printed. */
bool engine_open(struct engine *engine, const char *file, size_t body_count,
                 const struct engine_body *bodies);
void engine_close(struct engine *engine);

/* Enters the callbacks, with the engine as their context, and how its velocities lag. */
void engine_configure(struct engine *engine, struct percuss_slow_config *config);

/* All contacts near touching; with their accelerations if `accelerations`. Returns how many. */
size_t engine_contacts(struct engine *engine, bool accelerations,
                       struct percuss_slow_contact contacts[ENGINE_CONTACTS]);

/* One step of at most `step` s: to the next sub-impact or touch if that comes before, or with
 * `fixed` one of `step` s. Then lets the slow scale act. */
enum percuss_result engine_step(struct engine *engine, struct percuss_slow *slow, double step);

/* Rigid gap rate of a contact now. */
double engine_gap_rate(struct engine *engine, const struct percuss_slow_contact *contact);

/* J, of all bodies with MuJoCo's own masses and joints. */
double engine_kinetic_energy(const struct engine *engine);

#endif
