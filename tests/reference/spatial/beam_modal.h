/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The same impact by the beam's modes and a local contact: the region solved in every step, the
 * paper's model B, or a law that was tabulated from it, model C. The sphere is rigid but for the
 * contact; modes left out act by their compliance. */
#ifndef PERCUSS_SPATIAL_BEAM_MODAL_H
#define PERCUSS_SPATIAL_BEAM_MODAL_H

#include "contact/law.h"
#include "model/beam.h"
#include "spatial/collision.h"
#include "spatial/patch.h"

struct beam_modal {
    double mass[2];    /* kg: of the beam, the sphere */
    size_t modes;      /* even ones: those that bend where the sphere strikes */
    double *omega;     /* [modes], rad/s */
    double *share;     /* [modes], displacement of the beam's middle, 1/sqrt(kg) */
    double compliance; /* m/N, of the middle, all modes */
    double residual;   /* m/N, of those left out */
};

/* A free beam in one plane of bending, and the sphere's mass; the first `modes` even modes. False:
 * no memory. */
bool beam_modal_create(const struct beam_plane *plane, double sphere, size_t modes,
                       struct beam_modal *modal);
void beam_modal_free(struct beam_modal *modal);

struct beam_modal_contact {
    /* force (N) where the bodies would overlap by `overlap` > 0 (m) and give way by `series` (m/N)
     * times the force besides; NAN: none was found */
    double (*press)(void *context, double overlap, double series);
    void *context;
};

struct beam_modal_contact beam_modal_patch(struct patch *patch);
struct beam_modal_contact beam_modal_law(const struct contact_law *law);

struct beam_modal_settings {
    double approach, step, horizon;                                                 /* m/s, s, s */
    void (*record)(void *context, size_t which, const struct collision *collision); /* or NULL */
    void *context;
};

/* As collider_run. OK, or INTERNAL where no force was found, or without memory. */
enum percuss_status beam_modal_run(const struct beam_modal *modal,
                                   const struct beam_modal_contact *contact,
                                   const struct beam_modal_settings *settings,
                                   struct collision *collision, struct fault *fault);

#endif
