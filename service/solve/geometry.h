/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A request in the terms of mechanics: bodies found, contacts placed on their surfaces, W, gap
 * rates, contact laws. */
#ifndef PERCUSS_SOLVE_GEOMETRY_H
#define PERCUSS_SOLVE_GEOMETRY_H

#include "base/arena.h"
#include "contact/hertz.h"
#include "model/modal_basis.h"
#include "solve/request.h"
#include "solve/roll.h"

struct contact_model;
struct compliance;

/* One side of a contact. */
struct contact_side {
    size_t body; /* index into the request's bodies */
    struct site site;
    double direction[3]; /* of the force on the body per newton, body frame */
    struct site_load load;
};

struct geometry {
    size_t body_count, contact_count;
    const struct body *bodies[PERCUSS_MAX_BODIES];
    struct pose poses[PERCUSS_MAX_BODIES];
    struct roll rolls[PERCUSS_MAX_BODIES];               /* of their planes of bending */
    const struct body_state *states[PERCUSS_MAX_BODIES]; /* initial, in those planes; NULL: none */
    struct contact_side (*sides)[2];                     /* [contact]: a, b */
    struct hertz_contact *hertz;                         /* [contact] */
    double *gap_rate;                                    /* [contact], rigid, m/s */
    double (*sliding)[3];        /* [contact]: velocity of a's point against b's along the
                                    surface, world, m/s; nothing but a warning follows from it */
    double *service_w;           /* contacts^2, from the bodies */
    double *w;                   /* the one in use */
    double *impulse_compression; /* [contact], Eq. (4) or its complementarity problem, N s */
    bool from_client;
    struct contact_model *contact_model; /* the contacts' laws, see contact_model.h */
    struct compliance *compliance;       /* in series with them, see compliance.h; NULL: none */
};

/* PERCUSS_OK, or the refusal with its message: UNKNOWN_BODY, BAD_REQUEST, UNSUPPORTED_GEOMETRY,
 * NOT_APPROACHING. Arrays come from the arena. */
enum percuss_status geometry_find(struct geometry *geometry, const struct body_set *catalogue,
                                  const struct solve_request *request, struct arena *arena,
                                  struct fault *fault);

/* The part that velocities decide, of a geometry whose request differs in them only. OK,
 * NOT_APPROACHING or BAD_REQUEST. */
enum percuss_status geometry_find_rates(struct geometry *geometry,
                                        const struct solve_request *request, struct fault *fault);

/* The load of contact `contact` on a body (an index) if it acts on the family, or NULL. */
const struct site_load *geometry_load(const struct geometry *geometry, size_t contact, size_t body,
                                      enum mode_family family);

#endif
