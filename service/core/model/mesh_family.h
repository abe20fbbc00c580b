/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The elastic modes of a body that was reduced from a mesh, or of a box (ritz.h), and the static
 * compliance beyond them: one family with a finite number of modes. */
#ifndef PERCUSS_MODEL_MESH_FAMILY_H
#define PERCUSS_MODEL_MESH_FAMILY_H

#include "model/body_kind.h"
#include "model/mesh_body.h"

struct mesh_load;
struct ritz_shape;
struct site;
struct site_load;

extern const struct mode_family mesh_family;

/* Kinds with a box: the load without its flexibility, which the lender of the modes sets
 * (solve/vibration.c); the name of the theory. */
void mesh_family_load(const struct body *body, const struct site *site, const double direction[3],
                      bool tangential, struct site_load *load);
const char *mesh_family_theory(const struct body *body);

/* Completes the load of a force along a mesh's surface at a site: its regular flexibility, and the
 * uncertainty of that; without a tensor it is taken for that of the normal. */
void mesh_family_along(const struct body *body, const struct site *site, struct mesh_load *load);

/* Makes the tensor of a load at a site of a mesh that of a contact of the radius `patch` (m), and a
 * tangential load's flexibility that of it; nothing without a tensor. */
void mesh_family_narrow(const struct body *body, const struct site *site, double patch,
                        struct mesh_load *load);

/* The regular flexibility between two loads at one place of a body whose tensor is known. */
double mesh_load_between(const struct mesh_load *i, const struct mesh_load *j);

/* Members of a kind that vibrates as its `box`, and the keys for that. */
extern const struct mode_family *const mesh_family_alone[1];
#define BOX_VIBRATION                                                                              \
    .families = mesh_family_alone, .family_count = 1, .load = mesh_family_load,                    \
    .theory = mesh_family_theory
#define BOX_VIBRATION_KEYS                                                                         \
    {"damping", KEY_NUMBER, &limit_damping, KEY_OF(body, damping),                                 \
     KEY_SAYS("half of its material's loss factor (of its relaxation at each mode's frequency); "  \
              "0 where that states none",                                                          \
              "damping ratio of every elastic mode")},                                             \
        {"modes", KEY_WHOLE, &limit_modes, KEY_OF(body, modes),                                    \
         KEY_SAYS("as many as the tolerance asks for",                                             \
                  "fixed number of modes, of those that are computed")},                           \
    {                                                                                              \
        "rigid", KEY_FLAG, KEY_OF(body, rigid),                                                    \
            KEY_SAYS("false",                                                                      \
                     "mass, inertia and surface only: the error states what its vibration takes")  \
    }

/* The box of a body with three sides; its supports hold its ends. False: beyond the reach of Ritz's
 * method. */
bool mesh_family_box(const struct body *body, struct ritz_shape *shape);

/* Modulus, density and size of a body over those of its file (mesh) or over 1 (box). */
struct mesh_ratio {
    double young, density, size;
};
struct mesh_ratio mesh_ratio_of(const struct body *body);

/* Its flexibilities over those of the file: 1/(E L). */
double mesh_ratio_flexibility(const struct body *body);

/* The static response of a meshed body at one place of its surface to a force at another, from the
 * sites of its file. */
/* A unit force normal to the surface, in the file's frame and size. */
struct mesh_push {
    unsigned face;
    double point[3], direction[3];
};

/* Displacement (m/N) along the one per newton of the other, without the first mesh->removed modes,
 * of the file's own size and materials; NAN: the file has no data for it. */
double mesh_between(const struct mesh_body *mesh, const struct mesh_push *i,
                    const struct mesh_push *j);

#endif
