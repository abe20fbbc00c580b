/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One body of the catalogue. Body frame: origin in the centre of mass; rods and beams along x, from
 * x = -length/2 to +length/2; a compact cylinder's axis is x as well; a half-space fills z <= 0. */
#ifndef PERCUSS_MODEL_BODY_H
#define PERCUSS_MODEL_BODY_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"
#include "model/body_kind.h"
#include "model/material.h"
#include "model/mesh_body.h"
#include "percuss/vocabulary.h"

struct ritz_store; /* ritz_store.h */

enum support { SUPPORT_FREE, SUPPORT_PINNED, SUPPORT_CLAMPED }; /* a rod's `fixed` is CLAMPED */
enum beam_theory { THEORY_TIMOSHENKO, THEORY_EULER_BERNOULLI };
/* Absent: Hutchinson's, and Cowper's where that is no fraction (a wide section, kind_beam.c). */
enum shear_rule { SHEAR_ABSENT, SHEAR_COWPER, SHEAR_HUTCHINSON, SHEAR_NUMBER };

/* Most places of a body that have names. */
enum { BODY_MOST_SITES = PERCUSS_MAX_SITES };

/* A place on a mesh's surface that has a name. */
struct body_site {
    char name[PERCUSS_ID_SIZE];
    double point[3];     /* in the mesh's frame and unit; on the surface once placed */
    double normal[3];    /* outward, unit */
    double curvature[9]; /* symmetric tensor, 1/m at the mesh's own size */
    bool has_normal;     /* declared: else the surface's own is set by body_complete */
    bool has_curvature;
    bool placed;      /* what follows is set: by the first body_complete */
    unsigned face;    /* of the mesh */
    double moved;     /* how far off the surface it was declared, if farther than is usual for a
                       * point, m at the mesh's own size; else 0 */
    char remark[128]; /* how far what is declared differs from the surface's own, or empty */
};

struct body {
    char id[PERCUSS_ID_SIZE];
    struct material material;
    const struct body_kind *kind; /* what its shape is, and all that follows from that */
    double radius;                /* sphere, rod, round beam, cylinder; 0 otherwise */
    double width, height;         /* rectangular beam: along y, along z; 0 otherwise */
    double length;                /* rod, beam, cylinder */
    double tip_radius;            /* rod; INFINITY: flat ends */
    double size[3]; /* block, strip: along x, y, z; lengths of any other kind as its keys say */
    bool lateral_inertia; /* rod: Rayleigh-Love */
    enum beam_theory theory;
    enum shear_rule shear_rule;
    double shear_number;          /* SHEAR_NUMBER: the factor */
    enum support supports[2];     /* rod, beam, block: its ends at -x, +x */
    double damping;               /* modal damping ratio, [0, 1); of several the largest */
    double loss_factor;           /* of its material: what a cycle loses over 2 pi of what it
                                   * stores; NAN: not stated */
    bool yield_unstated;          /* its material states neither a yield nor that it has none: that
                                   * it stays elastic is taken, not known */
    double *damping_shares;       /* mesh: [damping_count], see damping.h; borrowed from the set */
    unsigned modes;               /* fixed number of modes a family; 0: from the tolerance */
    bool varied;                  /* by body_vary */
    const struct mesh_body *mesh; /* mesh: borrowed from the set */
    double scale;                 /* mesh: its size over the file's; 0: not stated, 1 */
    bool rigid;                   /* mesh, block: its vibration is left out */
    const struct ritz *ritz;      /* block: its vibration, lent by what solves; NULL: none */
    struct body_site *sites;      /* mesh: [site_count], borrowed from the set */
    size_t site_count, damping_count;

    /* Set by body_complete. */
    double mass;             /* kg; INFINITY: half-space */
    double inertia[3];       /* about the centre of mass; a Timoshenko beam's M(L^2/12 + r^2/4) */
    double products[3];      /* mesh: yz, zx, xy of the same tensor */
    double area;             /* rod, beam: of the section */
    double span;             /* rod, beam: length of the uniform bar whose waves are the body's:
                              * one with caps has their mass */
    double second_moment[2]; /* beam: of the section for bending along y, along z */
    double torsion_constant, warping_constant; /* beam: of the section, m^4, m^6 */
    double shear_factor[2]; /* beam: for bending along y, along z; NAN for Euler-Bernoulli */
};

/* Computes what follows from the dimensions and the material. PERCUSS_OK, or PERCUSS_BAD_REQUEST
 * with the field, its value and what is allowed. */
enum percuss_status body_complete(struct body *body, struct fault *fault);

/* A parameter that a request changes. */
struct body_variation {
    enum percuss_parameter parameter;
    double value;
};

/* A copy of `body` with these parameters instead of its own, each at most once, completed.
 * PERCUSS_BAD_REQUEST with the parameter, its value and what is allowed: out of range, given twice,
 * or not a parameter of such a body. */
enum percuss_status body_vary(const struct body *body, const struct body_variation *variations,
                              size_t count, struct body *varied, struct fault *fault);

/* The body's value; NAN: a body of this shape has no such parameter. */
double body_parameter(const struct body *body, enum percuss_parameter parameter);

/* Whether two variants of one body of the catalogue have the same modes. */
bool body_same_modes(const struct body *a, const struct body *b);

/* Whether it vibrates: its kind has families of modes, and they are there. Whether it can, once
 * they are made for it (body_kind.h, `box`). And whether it can be hit on its side
 * anywhere along x and bends then: a beam. */
bool body_is_flexible(const struct body *body);
bool body_can_vibrate(const struct body *body);
bool body_bends(const struct body *body);

/* Whether it vibrates in three dimensions, its static flexibility included: a mesh or a box. */
bool body_is_solid(const struct body *body);

/* The material of its surface at a site: of a mesh of several, one of them. */
struct material body_material_at(const struct body *body, const struct site *site);

/* The place of that name, NULL: it has none; and a place's point, body frame, m. */
const struct body_site *body_find_site(const struct body *body, const char *name);
void body_site_point(const struct body *body, const struct body_site *site, double point[3]);

/* The smallest dimension that curves or bounds its surface: radius, half the thickness, tip;
 * INFINITY for a half-space. */
double body_smallest_radius(const struct body *body);

/* What closed forms and axisymmetric meshes can take it for, and the theory of its vibration. */
struct solid body_solid(const struct body *body);

/* Whether it is a sphere or ends in one, so that whatever is flat meets it in a circular contact.
 */
bool body_has_sphere(const struct body *body);
const char *body_theory(const struct body *body);

/* A body of the catalogue that is given as a mesh or whose file is missing, and the news of it. */
enum { BODY_ORDER_SETS = 32, BODY_ORDER_ARGUMENTS = BODY_ORDER_SETS + 4, BODY_NEWS_SIZE = 480 };

/* What who asks for the body is told. */
struct body_news {
    enum percuss_status status; /* PERCUSS_BUSY: it is to come; else why it is not */
    char text[BODY_NEWS_SIZE];
};

struct body_board; /* where the news stand */

struct body_order {
    char id[PERCUSS_ID_SIZE];
    char name[65]; /* of the body's file: hash of all that it is made from */
    bool made;     /* that file is there: the set has the body itself */
    bool missing;  /* there is no mesh to reduce: the catalogue names a body's file, which lacks */
    char *mesh;    /* path of the mesh */
    char *arguments[BODY_ORDER_ARGUMENTS]; /* options of percuss-reduce, but for files */
    size_t argument_count;
    char material[400]; /* its material as a catalogue of its own; empty: the mesh states it */
    struct body_board *board;
};

/* Begins what is zeroed: the mesh waits. False: no memory. */
bool body_order_begin(struct body_order *order);

/* Any thread, as long as the order stands. */
void body_order_tell(const struct body_order *order, enum percuss_status status, const char *format,
                     ...) __attribute__((format(printf, 3, 4)));
struct body_news body_order_news(const struct body_order *order);

/* Frees what it holds and leaves it empty. */
void body_order_clear(struct body_order *order);

/* An immutable catalogue. Owns its arrays; loaders fill it, see catalogue/. */
struct body_set {
    struct body *bodies;
    size_t count;
    struct mesh_body **meshes; /* of the bodies, each once */
    size_t mesh_count;
    struct body_order *orders; /* of bodies that are given as meshes, or lack */
    size_t order_count;
    struct ritz_store *boxes; /* vibration of its blocks and cylinders; NULL: each worker's own */
    enum percuss_compliance compliance; /* HALF_SPACE; MATCHED: where it is known */
    bool begin, end; /* marks of the text it came from: one without the other was cut off */
    char revision[PERCUSS_ID_SIZE]; /* hash of everything that can change an answer */
};

/* The body or the order of that id, or NULL. */
const struct body *body_set_find(const struct body_set *set, const char *id);
const struct body_order *body_set_order(const struct body_set *set, const char *id);

/* Frees what a set holds, which came from malloc, and leaves it empty; the set too (or NULL). */
void body_set_clear(struct body_set *set);
void body_set_free(struct body_set *set);

#endif
