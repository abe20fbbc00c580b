/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Modes and static compliance of a body for the contacts on it. */
#ifndef PERCUSS_MODEL_MODAL_BASIS_H
#define PERCUSS_MODEL_MODAL_BASIS_H

#include "model/beam.h"
#include "model/body.h"
#include "model/body_kind.h"
#include "model/site.h"

/* A force on a face of a mesh, or of a box (ritz.h). */
struct mesh_load {
    int axis, side; /* box: of the face, see ritz_flexibility */
    unsigned face;
    int count;                          /* nodes of the face */
    double share[MESH_BODY_FACE_NODES]; /* shape functions */
    double direction[3];                /* unit */
    double point[3];                    /* mesh's frame and size, m */
    double flexibility;                 /* regular, of the body's own size and material, m/N */
    double unknown;                     /* uncertainty of the flexibility, m/N */
    bool along;                         /* mesh: the force is along the surface */
    bool all_ways;                      /* `tensor` is known: with friction */
    double tensor[6];  /* regular flexibility of the place for forces in all directions: xx yy zz xy
                        * yz zx of the body's frame, m/N */
    double slope, cut; /* box: its change with the logarithm of the contact's radius from `cut` (m)
                        * down, m/N; 0: none */
};

/* Load of one newton at a contact on one family of a body: `bar` of bars, `mesh` of all other
 * kinds. */
struct family_load {
    bool acts;
    struct beam_load bar;
    struct mesh_load mesh;
};

struct site_load {
    struct family_load family[BODY_MOST_FAMILIES]; /* of the first, and of those that the
                                                      body's kind has, all is defined, of others
                                                      that they do not act */
};

/* The load of a unit force along `direction` (body frame) at a site: the surface's normal, or for
 * friction (`tangential`) a direction in the surface. That drives on the side of a bar the
 * longitudinal waves, bends by its lever arm about the axis, and twists; a normal load there leaves
 * these out, as they come from the angle that is allowed between the stated and the true normal.
 * Parts below 1e-9 of the force do not act (rounding of the pose). */
void site_load_find(const struct body *body, const struct site *site, const double direction[3],
                    bool tangential, struct site_load *load);

static inline struct site_load site_load_make(const struct body *body, const struct site *site,
                                              const double direction[3], bool tangential)
{
    struct site_load load;
    site_load_find(body, site, direction, tangential, &load);
    return load;
}

/* The first `count` modes of a family; NULL: out of memory. */
struct modal_family *modal_family_create(const struct body *body, size_t family, size_t count);

/* The same, to the same bits, from a family of that body, or of one alike, whose modes are not
 * searched for again. */
struct modal_family *modal_family_grow(const struct body *body, const struct modal_family *known,
                                       size_t count);
void modal_family_free(struct modal_family *modes);

/* Whether the modes of one body's family serve another body's: only units differ. */
bool modal_family_alike(const struct body *a, const struct body *b, size_t family);

/* The largest number of modes of a family; SIZE_MAX: any number. */
size_t modal_family_most(const struct body *body, size_t family);

/* Displacement of mode k at the load, along it, for unit modal coordinate, 1/sqrt(kg). */
double modal_participation(const struct body *body, const struct modal_family *modes, size_t k,
                           const struct family_load *load);

/* The same of the modes which[0 .. count - 1]. */
void modal_participations(const struct body *body, const struct modal_family *modes,
                          const size_t *which, size_t count, const struct family_load *load,
                          double *row);

/* Exact static compliance between two loads within one family, m/N (inertia relief where the body
 * is free): the sum of participation_i participation_j / omega^2 over all modes. */
double modal_compliance(const struct body *body, size_t family, const struct family_load *i,
                        const struct family_load *j);

/* Compliance of the modes from `first` on at a load: by `beyond` of struct mode_family, else
 * `left`, the static compliance less that of the modes before. */
double modal_beyond(const struct body *body, const struct modal_family *modes, size_t first,
                    const struct family_load *load, double left);

/* Frequency (rad/s) of one oscillator that stands for all modes from index `first` on (below
 * modes->count): with their compliance C it has their inertia sum phi^2/omega^4 = C/omega^2. Evenly
 * spaced frequencies and equal shapes give sqrt(3) times the first one's; where they crowd below a
 * limit the first one's itself is a bound. */
double modal_remainder_frequency(const struct body *body, const struct modal_family *modes,
                                 size_t first);

#endif
