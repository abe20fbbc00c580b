/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A kind of body: the operations that the solver needs of a body of any shape. Each kind is one
 * constant in a file of its own, kind_*.c, and a line in the list at the end. */
#ifndef PERCUSS_MODEL_BODY_KIND_H
#define PERCUSS_MODEL_BODY_KIND_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"
#include "model/material.h"

struct body;
struct face;
struct family_load;
struct key;
struct ritz_shape;
struct site;
struct site_load;

/* Most pieces that the surface of a body has near a point. */
enum { BODY_MOST_FACES = 6 };

/* Most families of modes of a body. */
enum { BODY_MOST_FAMILIES = 4 };

/* The shape that stands for a body in closed forms and axisymmetric meshes. */
enum solid_form { SOLID_NONE, SOLID_BALL, SOLID_CYLINDER, SOLID_HALF_SPACE };
struct solid {
    enum solid_form form;
    int axis;              /* of a cylinder: 0, 1, 2 for x, y, z */
    double radius, length; /* m */
    double across;         /* smallest radius of the real section, m */
    double tip_radius;     /* of a cylinder's ends, m; INFINITY: flat */
    bool approximate;      /* of the same section, but not round */
};

/* A family of modes: waves of one type of a body, numbered from the lowest mode up. Here the modes
 * of one body. */
struct modal_family {
    size_t family; /* index in its kind's list */
    size_t count;
    double *omega;      /* [count], ascending, rad/s */
    unsigned char *odd; /* [count]: shape odd about the middle; all 0 unless supports are alike */
    void *shapes;       /* [count], further data of the family; NULL: none */
    size_t known;       /* modes that `find` has already; it may continue after them */
    void *walk;         /* state from which the search continues; NULL: none */
    size_t bytes;       /* of all this */
};

/* The operations of a family. */
struct mode_family {
    /* Slow transverse waves: the body comes back to the contact, and sub-impacts follow. */
    bool bends;

    /* Sub-impacts may follow at some places: where slow modes take enough of the impact. */
    bool returns;

    size_t shape_size; /* bytes of a mode in modal_family's shapes */
    size_t walk_size;  /* and of its walk */

    /* Fills in the modes; shapes of the first `known` ones are there already. */
    void (*find)(const struct body *body, struct modal_family *modes);

    /* Whether two bodies of the kind have the same shapes in modal_family, to the last bit. NULL:
     * only if they are the same. */
    bool (*alike)(const struct body *a, const struct body *b, size_t family);

    /* Displacement of the modes which[0 .. count - 1] at a load, along it, for unit modal
     * coordinates, 1/sqrt(kg). */
    void (*participations)(const struct body *body, const struct modal_family *modes,
                           const size_t *which, size_t count, const struct family_load *load,
                           double *row);

    /* Exact static compliance between two loads that act, see modal_compliance. */
    double (*compliance)(const struct body *body, size_t family, const struct family_load *i,
                         const struct family_load *j);

    /* Number of modes; NULL: any. `find` sets modes->omega[modes->count] to a lower bound of the
     * omitted modes' frequencies. */
    size_t (*most)(const struct body *body);

    /* Compliance (m/N) that stands for the modes from `first` on: at the frequency of that mode it
     * has their inertia, omega^2 sum participation^2 / omega_k^4. NULL: the static compliance less
     * that of the modes before. */
    double (*beyond)(const struct body *body, const struct modal_family *modes, size_t first,
                     const struct family_load *load);

    /* Whether frequencies crowd below a limit; NULL: evenly spaced. */
    bool (*crowds)(const struct body *body);
};

/* A body described for people and for programs that place it. */
struct body_description {
    double half_extents[3]; /* along x, y, z, m; 0: without bounds */
    double tip_radius; /* rod, beam with caps: of its ends, INFINITY where a rod's are flat; others:
                          0 */
    char text[256];
};

/* Adds a phrase after a comma; text beyond the buffer is cut. */
void describe_add(struct body_description *description, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

void describe_extents(struct body_description *description, double x, double y, double z);

struct body_kind {
    const char *name; /* in the catalogue, on the wire, in messages */

    /* Its keys in a catalogue besides shape and material. */
    const struct key *keys;
    size_t key_count;

    bool own_material; /* a file brings it: the catalogue need not name one */

    /* Checks several keys together; NULL: no such check. PERCUSS_OK or PERCUSS_BAD_REQUEST. */
    enum percuss_status (*check)(const struct body *body, struct fault *fault);

    /* Computes mass, inertia and all else that follows from the dimensions, which are checked. */
    enum percuss_status (*complete)(struct body *body, struct fault *fault);

    /* See body_smallest_radius. */
    double (*smallest_radius)(const struct body *body);

    /* Writes the pieces of the surface near a point (body frame, see site.h); returns their number.
     */
    int (*faces)(const struct body *body, const double point[3], struct face *faces);

    /* Returns why no model covers a site of the surface, or NULL. The operation is NULL where
     * models cover all sites. */
    const char *(*why_not)(const struct body *body, const struct site *site);

    /* The box or cylinder of its vibration by Ritz's method (ritz.h), which is computed when a
     * scene asks for it; false: beyond the reach of that. NULL: no such body. */
    bool (*box)(const struct body *body, struct ritz_shape *shape);

    /* Its families of modes; none: it is rigid. */
    const struct mode_family *const *families;
    size_t family_count;

    /* The load on each family of one newton along `direction` (body frame) at a site, normal to the
     * surface or tangential to it, see modal_basis.h; NULL: no family. */
    void (*load)(const struct body *body, const struct site *site, const double direction[3],
                 bool tangential, struct site_load *load);

    /* Whether two families, *first and the next, are alike, so that they may be turned about the
     * body's axis into the plane of a load (bending_axes.h); NULL: none are. */
    bool (*alike)(const struct body *body, size_t *first);

    /* The material at a site; NULL: the body's. */
    struct material (*material_at)(const struct body *body, const struct site *site);

    /* NULL: none. */
    struct solid (*solid)(const struct body *body);

    /* The theory of its vibration; NULL: "rigid". */
    const char *(*theory)(const struct body *body);

    /* Its size, and its dimensions, theory and ends in words. */
    void (*describe)(const struct body *body, struct body_description *description);
};

/* All kinds, in an order that catalogue revisions depend on: new ones go to the end. */
#define BODY_KINDS(KIND)                                                                           \
    KIND(sphere) KIND(rod) KIND(beam) KIND(cylinder) KIND(block) KIND(half_space) KIND(mesh)

#define BODY_KIND_DECLARE(kind) extern const struct body_kind kind##_kind;
BODY_KINDS(BODY_KIND_DECLARE)

/* The kind number `number`; NULL: there are no more. */
const struct body_kind *body_kind_at(size_t number);

/* Its place in the list. */
size_t body_kind_number(const struct body_kind *kind);

#endif
