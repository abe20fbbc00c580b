/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A server's announcements of itself and its catalogue, and the placing of two of its bodies. */
#ifndef PERCUSS_SERVER_H
#define PERCUSS_SERVER_H

#include <percuss/request.h>
#include <percuss/task.h>

enum percuss_support { PERCUSS_SUPPORT_FREE, PERCUSS_SUPPORT_PINNED, PERCUSS_SUPPORT_CLAMPED };

/* A place on a body that has a name. */
struct percuss_site {
    char name[PERCUSS_ID_SIZE];
    double point[3];  /* body frame, m */
    double normal[3]; /* outward, unit, body frame */
};

struct percuss_relaxation_term {
    double share; /* of the instantaneous modulus, that a sudden strain loses */
    double time;  /* s, in which it falls to 1/e of that */
};
enum { PERCUSS_MAX_RELAXATION = 8 };

/* A body of the catalogue. */
struct percuss_body {
    char id[PERCUSS_ID_SIZE];
    char shape[32]; /* sphere, rod, beam, cylinder, block, half-space, mesh */
    char material[PERCUSS_ID_SIZE];
    double mass;                      /* kg; INFINITY: half-space */
    char description[256];            /* dimensions, theory and ends in words */
    double half_extents[3];           /* half the size along the body's x, y, z, m; half-space: 0 */
    double radius;                    /* sphere, rod, round beam, cylinder, m; 0: none */
    double tip_radius;                /* of a rod's ends, m; INFINITY: flat; other shapes: 0 */
    enum percuss_support supports[2]; /* rod, beam, block: at its ends at -x and +x */
    double parameters[PERCUSS_PARAMETER_COUNT]; /* values that a request may override; NAN: it has
                                                   none; infinite yield: stays elastic */
    double inertia[3];  /* diagonal of the tensor about the centre of mass, kg m^2 */
    double products[3]; /* its elements yz, zx, xy; 0: the axes are principal */
    size_t site_count;  /* places with names: mesh */
    struct percuss_site sites[PERCUSS_MAX_SITES];
    /* What the catalogue states of its material beside the parameters. NAN and no terms: nothing,
     * or the server's version does not say. */
    double loss_factor;
    double loss_frequency; /* Hz, at which that was measured */
    size_t relaxation_count;
    struct percuss_relaxation_term relaxation[PERCUSS_MAX_RELAXATION];
    double rate_reference;   /* 1/s, of the yield stress by the rate of strain */
    double rate_exponent;    /* of Cowper and Symonds; NAN: by the coefficient */
    double rate_coefficient; /* of Johnson and Cook; NAN: by the exponent */
};

/* A force law that the catalogue states for the contacts of two materials. */
struct percuss_contact_law {
    char name[PERCUSS_ID_SIZE]; /* empty: none is stated, and the rest is NAN, 0 or empty */
    char kind[32];              /* power, hysteresis, hunt-crossley, points */
    double stiffness;           /* N/m^exponent; NAN: of points, as the next three */
    double exponent, hysteresis;
    double dissipation;          /* s/m */
    double deviation;            /* of the force, one standard deviation over it */
    char points[256];            /* file of loading, as the catalogue names it; empty: none */
    uint32_t point_count;        /* of loading */
    double max_indentation;      /* m, of the last point; NAN: of no points, as the numbers below */
    double max_force;            /* N */
    char unloading[256];         /* file; empty: the way of loading */
    double residual_indentation; /* m, where unloading from the last point ends */
};

/* What the catalogue states of the contacts of two materials. */
struct percuss_material_pair {
    char material_a[PERCUSS_ID_SIZE], material_b[PERCUSS_ID_SIZE]; /* in the order of names */
    double friction;           /* coefficient; NAN: not stated */
    double friction_deviation; /* standard deviation of it */
    struct percuss_contact_law law;
};

struct percuss_body_list {
    size_t count;
    struct percuss_body *bodies; /* sorted by id */
    size_t pair_count;           /* each once, with a body's material; 0 of an older server, too */
    struct percuss_material_pair *pairs; /* sorted by both names */
    char catalogue_revision[64];         /* empty of an older server */
};

/* A server's id in hexadecimal digits, with the terminating zero. */
enum { PERCUSS_SERVER_ID_SIZE = 33 };

struct percuss_server {
    uint8_t server[16];
    char version[32], catalogue_revision[64];
    char catalogue[256]; /* file */
    char host[64];
    uint32_t process;
    char state[32]; /* ready, draining */
    uint32_t workers, bodies;
    uint32_t queue_length, queue_capacity;
    uint64_t answered, refused;
    double uptime;              /* s */
    char activity[256];         /* step of a long computation */
    double progress;            /* 0..1; NAN: nothing is running */
    uint32_t specimens;         /* that it keeps */
    size_t task_count;          /* listed, up to PERCUSS_MAX_TASKS */
    struct percuss_task *tasks; /* those that run before those that wait, the oldest first */
    uint32_t all_tasks;         /* how many there are; requests answered at once are in none */
};

struct percuss_server_list {
    size_t count;
    struct percuss_server *servers;
};

/* Two bodies at their default sites; A moves with `speed` (m/s, > 0) straight at B, or askew, else
 * at rest. Its flight leans towards the first tangent of the contact: the world axis that is least
 * parallel to B's normal (x before y before z), made normal to it. */
struct percuss_pair {
    const struct percuss_body *a, *b;
    double speed;
    double at_a, at_b; /* beams: where along the length the site is, 0 (end at -x) .. 1 (at +x) */
    const char *site_a, *site_b; /* the name of a site; NULL: the default one */
    double angle; /* of A's flight from the normal, rad, -pi/2..pi/2; the speed is that along it */
    double spin;  /* of A about tangent x normal, rad/s: at the contact that faces B, it adds to
                     the slip along the tangent */
    double friction; /* coefficient; 0: the catalogue's for the two materials, if any */
};

#ifdef __cplusplus
extern "C" {
#endif

/* The pair at speed 0 with beams hit half-way. A body may be NULL, as percuss_body_find returns it:
 * percuss_contact_pair refuses it. */
PERCUSS_API struct percuss_pair percuss_pair_default(const struct percuss_body *a,
                                                     const struct percuss_body *b);

/* Fills `request` with default options, bodies A and B and one contact in which they touch.
 *
 * Default sites: sphere and block: top (+z); half-space: origin; cylinder: end at +x; rod: end at
 * +x if that is free, else at -x; beam: +z side. B stands unrotated at the origin, n is the outward
 * normal of its site; a mesh: its first site with a name. A is turned by the smallest rotation that
 * makes the outward normal of its site -n (half a turn: about its x axis, or y for rods and
 * cylinders); a beam on a beam is also turned about n so that they cross at a right angle.
 * INVALID_ARGUMENT for a body that is NULL, a shape that it cannot place, a speed that is not
 * positive and finite, an angle at which A does not approach, a spin that is not finite or a
 * fraction outside 0..1. Needs no client. */
PERCUSS_API enum percuss_result percuss_contact_pair(const struct percuss_pair *pair,
                                                     struct percuss_request *request);

/* The body of that id; NULL: there is none, and percuss_error_text says which one is similar. */
PERCUSS_API const struct percuss_body *percuss_body_find(const struct percuss_body_list *list,
                                                         const char *id);

/* Release the lists of percuss_bodies and percuss_servers; NULL and empty lists are allowed. */
PERCUSS_API void percuss_body_list_free(struct percuss_body_list *list);
PERCUSS_API void percuss_server_list_free(struct percuss_server_list *list);

#ifdef __cplusplus
}
#endif

#endif
