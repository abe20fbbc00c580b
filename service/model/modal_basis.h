/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Modes and static compliance of a flexible body as a contact on it sees them. */
#ifndef PERCUSS_MODEL_MODAL_BASIS_H
#define PERCUSS_MODEL_MODAL_BASIS_H

#include <stdbool.h>
#include <stddef.h>

#include "model/beam.h"
#include "model/body.h"
#include "model/site.h"

/* Longitudinal along x; transverse along y; transverse along z; twist about x. */
enum mode_family { FAMILY_AXIAL, FAMILY_BENDING_Y, FAMILY_BENDING_Z, FAMILY_TORSION, FAMILY_COUNT };

/* What one newton at a contact does to the families of a body. */
struct site_load {
    bool acts[FAMILY_COUNT];
    double axial;                /* force along x, at the end `end` */
    int end;                     /* 0: x = -length/2, 1: +length/2 */
    struct beam_load bending[2]; /* along y, along z */
    double torque;               /* about x, at x = bending[].x, N m */
};

/* The load of a unit force along `direction` (body frame) at a site. Parts below 1e-9 of the force
 * count as zero (rounding of the pose). A hit on the side drives no longitudinal waves here: within
 * the angle allowed between stated and true normal that part is not the contact's. A hit on the
 * side of a rectangular section twists it about the axis; without friction one on a round section
 * or on an end face does not. */
struct site_load site_load_make(const struct body *body, const struct site *site,
                                const double direction[3]);

/* Whether a beam bends alike in all planes through its axis: round and square sections. */
bool modal_planes_alike(const struct body *body);

/* Turns the planes of bending of a load about the body's axis: y becomes cosine y - sine z, z
 * becomes cosine z + sine y. */
void site_load_turn(const struct body *body, double cosine, double sine, struct site_load *load);

/* Modes of one family of one body. */
struct modal_family {
    enum mode_family family;
    size_t count;
    double *omega;      /* [count], ascending */
    unsigned char *odd; /* [count]: shape odd about the middle; all 0 unless supports are alike */
    struct beam_mode *beam; /* [count]; NULL for families of other waves */
};

/* The first `count` modes; NULL: out of memory. Rods: omega_k = k pi c/L (free-free),
 * (k - 1/2) pi c/L (fixed-free), with Rayleigh-Love omega/sqrt(1 + (nu k r_p)^2). */
struct modal_family *modal_family_create(const struct body *body, enum mode_family family,
                                         size_t count);
void modal_family_free(struct modal_family *modes);

/* Displacement of mode k at the load, along it, for unit modal coordinate, 1/sqrt(kg). */
double modal_participation(const struct body *body, const struct modal_family *modes, size_t k,
                           const struct site_load *load);

/* Exact static compliance between two loads within one family, m/N (inertia relief where the body
 * is free): the sum of participation_i participation_j / omega^2 over all modes. */
double modal_compliance(const struct body *body, enum mode_family family, const struct site_load *i,
                        const struct site_load *j);

/* Frequency (rad/s) of one oscillator that stands for all modes from index `first` on (below
 * modes->count): with their compliance C it has their inertia sum phi^2/omega^4 = C/omega^2. Evenly
 * spaced frequencies and equal shapes give sqrt(3) times the first one's; those of Rayleigh-Love
 * crowd below a limit, so that the first one's itself is a bound. */
double modal_remainder_frequency(const struct body *body, const struct modal_family *modes,
                                 size_t first);

/* One plane of bending of a beam. */
struct beam_plane modal_beam_plane(const struct body *body, enum mode_family family);

#endif
