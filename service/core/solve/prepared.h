/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Cache of prepared bodies: quantities that depend on the body and on the number of modes, but not
 * on the request. A hit and a miss give the same bits: every mode is computed independently of
 * their number. */
#ifndef PERCUSS_SOLVE_PREPARED_H
#define PERCUSS_SOLVE_PREPARED_H

#include "contact/hertz.h"
#include "contact/law_own.h"
#include "impact/step_table.h"
#include "model/modal_basis.h"

struct ritz_shape;
struct ritz_store;

/* Modes of a family that have one parity, or any (longitudinal ones of unlike supports). */
struct prepared_group {
    struct oscillators *set;
    size_t *mode; /* [set->count]: index within the family */
};

struct prepared_family {
    struct modal_family *modes;
    size_t group_count;
    struct prepared_group groups[2];
    struct participations *participations; /* at the last loads */
    struct prepared_family *next_retired;
};

/* Participations of a family's modes, cached for the loads that were asked for last: a solve asks
 * several times, an ensemble asks for one site thousands of times. A hit and a miss give the same
 * bits, since each mode is computed by itself. */
struct participations;
enum { PARTICIPATION_LOADS = 8 };                           /* cached per family */
struct participations *participations_create(size_t modes); /* NULL: out of memory */
void participations_free(struct participations *cached);    /* NULL is allowed */

/* As modal_participations, for modes below the number at its creation; `which` ascends. */
void participations_get(struct participations *cached, const struct body *body,
                        const struct modal_family *modes, const size_t *which, size_t count,
                        const struct family_load *load, double *shape);

struct prepared_cache;

struct prepared_cache *prepared_cache_create(void);
void prepared_cache_free(struct prepared_cache *cache);

/* Begins a solve: frees entries that no scene uses any more, and all entries unless the cache
 * already belongs to this revision. */
void prepared_cache_use(struct prepared_cache *cache, const char *revision);

/* Bytes of all entries, as they were at the last prepared_cache_use. */
size_t prepared_cache_bytes(const struct prepared_cache *cache);

/* Frees the entries of bodies with parameters of a request's own, or all. No scene may use any. */
void prepared_cache_drop(struct prepared_cache *cache, bool only_varied);

/* At least `count` modes of a family of a body (of the revision in use); families that are alike
 * (bending_axes.h) share theirs. The result stays valid
 * until the next prepared_cache_use. NULL: out of memory. */
const struct prepared_family *prepared_family_get(struct prepared_cache *cache,
                                                  const struct body *body, size_t family,
                                                  size_t count);

/* Of a family's group the modes with the indices which[0 .. count - 1], ascending, as a group of
 * their own; the last few are cached. It is valid as long as the family. NULL: out of memory. */
const struct prepared_group *prepared_part_get(struct prepared_cache *cache,
                                               const struct prepared_group *whole,
                                               const size_t *which, size_t count);

/* The oscillator of modal_remainder_frequency, with its step tables. NULL: out of memory. */
struct oscillators *prepared_remainder_get(struct prepared_cache *cache, const struct body *body,
                                           size_t family, size_t first);

/* Frequencies of prepared_radiation_get in an octave: fine enough to come within a tenth of the one
 * wanted, coarse enough that few are ever made. */
static const double PREPARED_STEPS = 4.0;

/* An oscillator of the frequency 2^(step/PREPARED_STEPS) rad/s and the damping 1/sqrt(2) for the
 * waves that leave through a half-space, with its step tables. NULL: out of memory. */
struct oscillators *prepared_radiation_get(struct prepared_cache *cache, const struct body *body,
                                           int step);

/* As hertz_contact_make; the ellipses of the last contacts are cached. */
struct hertz_contact prepared_contact_get(struct prepared_cache *cache, double effective_modulus,
                                          const double curvature[2]);

/* The vibration of a box or cylinder (ritz.h) from a store (NULL: one of the cache's own), made
 * when first asked for and valid until the next prepared_cache_use, and to be asked of one store
 * until then. NULL: out of memory, or stopped by the pace. */
const struct ritz *prepared_ritz_get(struct prepared_cache *cache, struct ritz_store *store,
                                     const struct ritz_shape *shape, double poisson,
                                     struct pace *pace);

/* As ritz_flexibility, of a vibration from prepared_ritz_get; that of the last places is cached. */
double prepared_ritz_flexibility(struct prepared_cache *cache, const struct ritz *ritz, int axis,
                                 int side, const double point[3]);
bool prepared_ritz_tensor(struct prepared_cache *cache, const struct ritz *ritz, int axis, int side,
                          const double point[3], double tensor[6]);

/* The curves of a law's points (contact/law_own.h), the cache's as long as its catalogue is in use;
 * NULL: it has none. PERCUSS_OK, BAD_REQUEST or INTERNAL. */
enum percuss_status prepared_curves_get(struct prepared_cache *cache, const struct own_law *own,
                                        const struct contact_curves **curves, struct fault *fault);

/* matched_compliance of a sphere, or of a rod's or cylinder's end, with the contact radius `patch`
 * (m). It takes milliseconds when first asked for. A sphere's is linear in the logarithm of the
 * patch but for terms of the order of (patch/radius)^2: taken from octaves. NAN: none is known.
 * False: out of memory. */
bool prepared_matched_get(struct prepared_cache *cache, const struct body *body, double patch,
                          double *compliance);

#endif
