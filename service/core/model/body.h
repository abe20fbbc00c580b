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
#include "model/own_law.h"
#include "model/relaxation.h"
#include "model/yield_rate.h"
#include "percuss/vocabulary.h"

struct ritz_store; /* ritz_store.h */

enum support { SUPPORT_FREE, SUPPORT_PINNED, SUPPORT_CLAMPED }; /* a rod's `fixed` is CLAMPED */
enum beam_theory { THEORY_TIMOSHENKO, THEORY_EULER_BERNOULLI };
/* Absent: Hutchinson's, or Cowper's where that is not in (0, 1] (a wide section, kind_beam.c). */
enum shear_rule { SHEAR_ABSENT, SHEAR_COWPER, SHEAR_HUTCHINSON, SHEAR_NUMBER };

/* Most places of a body that have names. */
enum { BODY_MOST_SITES = PERCUSS_MAX_SITES };

/* A place on a mesh's surface that has a name. */
struct body_site {
    char name[PERCUSS_ID_SIZE];
    double point[3];     /* in the mesh's frame and unit; on the surface once placed */
    double normal[3];    /* outward, unit */
    double curvature[9]; /* symmetric tensor, 1/m at the mesh's own size */
    bool has_normal;     /* declared; else body_complete sets the surface's own */
    bool has_curvature;
    bool placed;   /* the members below are set, by the first body_complete */
    unsigned face; /* of the mesh */
    double moved;  /* distance from the surface at which it was declared, if more than a contact's
                      point may have, m at the mesh's own size; else 0 */
    char remark[128]; /* difference between the declared and the surface's own, or empty */
};

struct body {
    char id[PERCUSS_ID_SIZE];
    struct material material;
    const struct body_kind *kind; /* operations of its shape */
    double radius;                /* sphere, rod, round beam, cylinder; 0 otherwise */
    double width, height;         /* rectangular beam: along y, along z; 0 otherwise */
    double length;                /* rod, beam, cylinder */
    double tip_radius;            /* rod; INFINITY: flat ends */
    double size[3]; /* block, strip: along x, y, z; lengths of any other kind as its keys say */
    bool lateral_inertia; /* rod: Rayleigh-Love */
    enum beam_theory theory;
    enum shear_rule shear_rule;
    double shear_number;      /* SHEAR_NUMBER: the factor */
    enum support supports[2]; /* rod, beam, block: its ends at -x, +x */
    double damping;           /* modal damping ratio, [0, 1); of several the largest */
    double loss_factor; /* of its material: loss of a cycle over 2 pi times its stored energy; NAN:
                           not stated */
    double loss_frequency;        /* at which that was measured, Hz; 0: not stated */
    struct relaxation relaxation; /* of its material, in place of a loss factor */
    double relaxed_from; /* the instantaneous modulus (Pa), where `young` is the storage modulus of
                            an impact's frequency (solve/relaxed.h); 0: `young` is it */
    double damping_peak; /* the largest loss factor of the relaxation, where modes are damped by
                            half of theirs; 0: the damping is stated */
    bool yield_unstated; /* its material states neither a yield nor its absence: elastic by
                            assumption */
    /* how the yield stress of its material grows with the rate of strain */
    struct yield_rate yield_rate;
    double *damping_shares;       /* mesh: [damping_count], see damping.h; borrowed from the set */
    unsigned modes;               /* fixed number of modes a family; 0: from the tolerance */
    bool varied;                  /* by body_vary, or a sample of an ensemble */
    const struct mesh_body *mesh; /* mesh: borrowed from the set */
    double scale;                 /* mesh: its size over the file's; 0: not stated, 1 */
    bool rigid;                   /* mesh, block: its vibration is left out */
    const struct ritz *ritz;      /* block: its vibration, lent by the solver; NULL: none */
    struct body_site *sites;      /* mesh: [site_count], borrowed from the set */
    size_t site_count, damping_count;

    /* Set by body_complete. */
    double mass;        /* kg; INFINITY: half-space */
    double inertia[3];  /* about the centre of mass; a Timoshenko beam's M(L^2/12 + r^2/4) */
    double products[3]; /* mesh: yz, zx, xy of the same tensor */
    double area;        /* rod, beam: of the section */
    double span; /* rod, beam: length of the uniform bar with the waves and the mass of the body,
                    caps included */
    double second_moment[2]; /* beam: of the section for bending along y, along z */
    double torsion_constant, warping_constant; /* beam: of the section, m^4, m^6 */
    double shear_factor[2]; /* beam: for bending along y, along z; NAN for Euler-Bernoulli */
};

/* Computes the members that follow from the dimensions and the material. PERCUSS_OK, or
 * PERCUSS_BAD_REQUEST with the field, its value and the allowed values. */
enum percuss_status body_complete(struct body *body, struct fault *fault);

/* A parameter that a request changes. */
struct body_variation {
    enum percuss_parameter parameter;
    double value;
};

/* A copy of `body` with these parameters instead of its own, each at most once, completed.
 * PERCUSS_BAD_REQUEST with the parameter, its value and the allowed values: out of range, given
 * twice, or not a parameter of such a body. */
enum percuss_status body_vary(const struct body *body, const struct body_variation *variations,
                              size_t count, struct body *varied, struct fault *fault);

/* The body's value; NAN: a body of this shape has no such parameter. */
double body_parameter(const struct body *body, enum percuss_parameter parameter);

/* Whether two variants of one body of the catalogue have the same modes. */
bool body_same_modes(const struct body *a, const struct body *b);

/* Whether it vibrates now: it has families of modes and, if its kind has a `box` (body_kind.h), the
 * modes of that. */
bool body_is_flexible(const struct body *body);

/* Whether it vibrates once the modes of its box are made. */
bool body_can_vibrate(const struct body *body);

/* Whether it can be hit on its side anywhere along x and bends then: a beam. */
bool body_bends(const struct body *body);

/* Whether it vibrates in three dimensions, its static flexibility included: a mesh or a box. */
bool body_is_solid(const struct body *body);

/* The material of its surface at a site: of a mesh of several, one of them. */
struct material body_material_at(const struct body *body, const struct site *site);

/* The site of that name, NULL: none; and the point of a site, body frame, m. */
const struct body_site *body_find_site(const struct body *body, const char *name);
void body_site_point(const struct body *body, const struct body_site *site, double point[3]);

/* The smallest dimension that curves or bounds its surface: radius, half the thickness, tip;
 * INFINITY for a half-space. */
double body_smallest_radius(const struct body *body);

/* The shape that stands for it in closed forms and axisymmetric meshes. */
struct solid body_solid(const struct body *body);

/* Whether it is a sphere or has a spherical end: a flat body meets it in a circular contact. */
bool body_has_sphere(const struct body *body);

/* The theory of its vibration, or "rigid". */
const char *body_theory(const struct body *body);

/* A body of the catalogue that is given as a mesh, or by a file that is missing, and the news of
 * its reduction. */
enum { BODY_ORDER_SETS = 32, BODY_ORDER_ARGUMENTS = BODY_ORDER_SETS + 7, BODY_NEWS_SIZE = 480 };

/* Places of one order that wait at a time for their flexibility. */
enum { BODY_ORDER_PLACES = 32 };

/* The reply to a request for the body. */
struct body_news {
    enum percuss_status status; /* PERCUSS_BUSY: it is being made; else the reason why it is not */
    char text[BODY_NEWS_SIZE];
};

struct body_board; /* the news, shared by threads */

struct body_order {
    char id[PERCUSS_ID_SIZE];
    char name[65]; /* name of the body's file: a hash of all that it is made from */
    bool made;     /* that file exists: the set has the body itself */
    bool later;    /* its flexibility is solved for at places that requests hit */
    bool missing;  /* the catalogue names a reduced body's file, which does not exist: there is no
                      mesh */
    char *mesh;    /* path of the mesh */
    char *arguments[BODY_ORDER_ARGUMENTS]; /* options of percuss-reduce, but for files */
    size_t argument_count;
    char material[400]; /* its material as a catalogue of its own; empty: the mesh states it */
    struct body_board *board;
};

/* Begins a zeroed order: its mesh waits. False: out of memory. */
bool body_order_begin(struct body_order *order);

/* Any thread may call these while the order exists. */
void body_order_tell(const struct body_order *order, enum percuss_status status, const char *format,
                     ...) __attribute__((format(printf, 3, 4)));
struct body_news body_order_news(const struct body_order *order);

/* Asks for the flexibility at a place of a made body, in the mesh's frame and unit; beyond
 * BODY_ORDER_PLACES it is left for later. */
void body_order_want(const struct body_order *order, const double place[3]);

/* Asks for the flexibility at all named sites of the order's body that lack it. */
void body_order_want_sites(const struct body_order *order, const struct body *body);

/* Takes the places that are wanted, which are none afterwards; returns how many. */
size_t body_order_take(const struct body_order *order, double places[BODY_ORDER_PLACES][3]);

/* Frees its members and leaves it empty. */
void body_order_clear(struct body_order *order);

/* An immutable catalogue. Owns its arrays; loaders fill it, see catalogue/. */
struct body_set {
    struct body *bodies;
    size_t count;
    struct mesh_body **meshes; /* of the bodies, each once */
    size_t mesh_count;
    struct body_order *orders; /* of bodies that are given as meshes or without their file */
    size_t order_count;
    struct ritz_store *boxes; /* vibration of its blocks and cylinders; NULL: each worker's own */
    enum percuss_compliance compliance; /* HALF_SPACE; MATCHED: where it is known */
    struct friction_pair *friction;     /* [friction_count], by the order of their names */
    size_t friction_count;
    struct own_law *laws; /* [law_count] */
    size_t law_count;
    bool begin, end; /* marks of the text it came from: one without the other was cut off */
    char revision[PERCUSS_ID_SIZE]; /* hash of everything that can change an answer */
};

/* The body or the order of that id, or NULL. */
const struct body *body_set_find(const struct body_set *set, const char *id);
const struct body_order *body_set_order(const struct body_set *set, const char *id);

/* The friction that the catalogue states between two materials, known by their names, in either
 * order; NULL: none. */
const struct friction_pair *body_set_friction(const struct body_set *set, const struct material *a,
                                              const struct material *b);

/* The law that it states for them; NULL: none. */
const struct own_law *body_set_law(const struct body_set *set, const struct material *a,
                                   const struct material *b);

/* The order of pairs, for qsort and bsearch. */
int friction_pair_order(const void *a, const void *b);

/* Frees the members of a set, which came from malloc, and leaves it empty; body_set_free frees the
 * set too (NULL is allowed). */
void body_set_clear(struct body_set *set);
void body_set_free(struct body_set *set);

#endif
