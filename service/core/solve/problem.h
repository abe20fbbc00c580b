/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A request in the terms of mechanics: bodies found, contacts placed on their surfaces, W, gap
 * rates, contact laws and the compliance in series with them. formulation.h makes and revises it;
 * all others only read it. */
#ifndef PERCUSS_SOLVE_PROBLEM_H
#define PERCUSS_SOLVE_PROBLEM_H

#include "base/arena.h"
#include "contact/hertz.h"
#include "contact/law.h"
#include "model/bending_axes.h"
#include "model/modal_basis.h"
#include "model/site.h"
#include "solve/prepared.h"
#include "solve/request.h"

struct contact_choice; /* contact_model.h */

/* One side of a contact. */
struct contact_side {
    size_t body; /* index into the request's bodies */
    struct site site;
    struct material material; /* of the surface there */
    double direction[3];      /* of the force on the body per newton, body frame */
    struct site_load load;
};

/* Friction of a contact. */
struct contact_friction {
    size_t contact;
    double coefficient;
    double deviation; /* of the coefficient, one standard deviation */
    double ratio[3];  /* tangential over normal stiffness, a tensor xx, xy, yy of its tangents */
    double tangent[2][3]; /* world, unit */
    struct contact_tangent {
        double direction[3]; /* of the force on the body per newton, body frame */
        struct site_load load;
    } sides[2][2]; /* [tangent][a, b] */
};

/* The rate of strain at a contact, see rate.h. */
struct contact_rate {
    double rate[2];    /* that counts for a and b, 1/s; 0: their yield does not depend on it */
    double raised[2];  /* yield stress of a and b over the stated one */
    double slow, fast; /* that of the body that yields at the least and the largest likely rate,
                          over the one in use; 1: it does not depend on it */
    double by_speed;   /* by how much its logarithm grows with that of all speeds */
};

/* The contacts' laws, see contact_model.h. */
struct contact_model {
    bool yielding;                             /* plastic laws are in use; false: none is */
    bool decided;                              /* by the request, or by a solution */
    double *depth;                             /* [contact]: of the dents under it, m */
    struct contact_law *laws;                  /* [contact]: in use */
    struct contact_choice *choices;            /* [contact] */
    struct contact_rate *rates;                /* [contact] */
    const struct contact_table_remedy *remedy; /* of tables that are missing; NULL: none is known */
};

/* The compliance in series with them, see contact_model.h. */
struct compliance {
    enum percuss_compliance used; /* HALF_SPACE or MATCHED, of all contacts */
    double *series;               /* [contact], m/N; 0: half-space; NULL: the same, none chosen */
    double (*sides)[2];           /* [contact]: the parts of either body in it */
    bool by_speed;                /* a part depends on the speed of approach: a sphere's */
    bool still;                   /* without waves that leave through half-spaces (radiation.h): a
                                     contact is too stiff for them, or too many share them */
    bool bare;                    /* without that of beams' sides: a contact is too stiff for it */
    size_t most;                  /* modes of a mesh that may take part: fewer leave more of its
                                     flexibility in series; 0: all */
    char reason[128];             /* why half-space although matched was asked for, or empty */
};

struct problem {
    const struct solve_request *request; /* borrowed as the next two */
    struct prepared_cache *cache;        /* prepared bodies */
    struct arena *arena;                 /* of all arrays, and of the scenes made of it */
    double tolerance;                    /* on the restitution */
    size_t body_count, contact_count;
    const struct body **bodies;
    struct pose *poses;
    struct bending_axes *axes;        /* of their planes of bending */
    const struct body_state **states; /* initial, in those planes; NULL: none */
    struct contact_side (*sides)[2];  /* [contact]: a, b */
    struct hertz_contact *hertz;      /* [contact] */
    double *gap_rate;                 /* [row], rigid, m/s: of a tangent the slip */
    double (*sliding)[3];             /* [contact]: velocity of a's point against b's along the
                                         surface, world, m/s; without friction only a warning
                                         follows from it */
    size_t friction_count;
    struct contact_friction *friction; /* [friction_count], ascending contacts */
    double *w;                         /* contacts^2, from the bodies or the request, 1/kg */
    double *row_w;                     /* the same of all rows (impact/scene.h), rows^2 */
    double *impulse_compression;       /* [contact], Eq. (4) or its complementarity problem, N s */
    bool from_client;                  /* that W: the request's */
    struct contact_model contact_model;
    struct compliance compliance;
    double *shift; /* [contact], m/N: in series besides, of a shifted model; NULL: none */
};

/* An empty one in the arena, for the request. NULL: out of memory. */
struct problem *problem_create(const struct solve_request *request, struct prepared_cache *cache,
                               struct arena *arena);

/* The body on side 0 (a) or 1 (b) of a contact. */
static inline const struct body *problem_body(const struct problem *problem, size_t contact,
                                              int side)
{
    return problem->bodies[problem->sides[contact][side].body];
}

/* Its material there. */
static inline const struct material *problem_material(const struct problem *problem, size_t contact,
                                                      int side)
{
    return &problem->sides[contact][side].material;
}

/* Speed of the contact that closes fastest, m/s; 0: none does. */
double problem_approach(const struct problem *problem);

/* Hertz indentation (m) of a contact if all the energy of the rigid approach at that speed (m/s)
 * went into it. */
double problem_indentation(const struct problem *problem, size_t contact, double speed);

/* Speed of the rigid approach of a contact when it touches, m/s: a gap that is open is closed with
 * the acceleration of the gap. NAN: it does not touch. */
double problem_touching_speed(const struct problem *problem, size_t contact);

/* Angular frequency of an elastic contact of the rigid masses at that speed, rad/s: pi over its
 * duration. NAN: it does not touch. */
double problem_frequency(const struct problem *problem, size_t contact);

/* The same, of a contact that does not approach the fastest of those with a body of its own, or of
 * all; 0: none approaches. */
double problem_frequency_near(const struct problem *problem, size_t contact);

/* Of the contacts' compression impulses, N s. */
double problem_largest_compression(const struct problem *problem);

/* The rows of its scenes (impact/scene.h): the contacts' normals, then two tangents of each
 * friction. */
static inline size_t problem_rows(const struct problem *problem)
{
    return problem->contact_count + 2 * problem->friction_count;
}

/* The contact of a row. */
static inline size_t problem_row_contact(const struct problem *problem, size_t row)
{
    size_t n = problem->contact_count;
    return row < n ? row : problem->friction[(row - n) / 2].contact;
}

/* One side of a row. */
struct row_side {
    size_t body;
    const double *point;     /* body frame, m */
    const double *direction; /* of the force on the body per newton, body frame */
    const struct site_load *load;
};
static inline struct row_side problem_row_side(const struct problem *problem, size_t row, int which)
{
    size_t n = problem->contact_count;
    if (row < n) {
        const struct contact_side *side = &problem->sides[row][which];
        return (struct row_side){side->body, side->site.point, side->direction, &side->load};
    }
    const struct contact_friction *friction = &problem->friction[(row - n) / 2];
    const struct contact_side *side = &problem->sides[friction->contact][which];
    const struct contact_tangent *tangent = &friction->sides[(row - n) % 2][which];
    return (struct row_side){side->body, side->site.point, tangent->direction, &tangent->load};
}

/* The load of a row on a body (an index) if it acts on the family, or NULL. */
const struct family_load *problem_load(const struct problem *problem, size_t row, size_t body,
                                       size_t family);

/* Velocity along row i due to a unit impulse along row j, 1/kg: the bodies that both share. */
double problem_inverse_mass(const struct problem *problem, size_t i, size_t j);

/* Whether friction is plain. */
bool problem_is_plain(const struct problem *problem);

/* Where the request's delassus has that of rows i and j. */
size_t problem_stated_place(const struct problem *problem, size_t i, size_t j);

/* The largest inverse mass in use of a row's contact, of its normal or a tangent, 1/kg: what
 * differences of inverse masses are measured by, as a mechanism may not move along a tangent. */
double problem_row_scale(const struct problem *problem, size_t row);

#endif
