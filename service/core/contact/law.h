/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Force laws of a contact. A new law is one new .c file with its operations and its constructor,
 * and a line in PERCUSS_CONTACT_MODEL_LIST, which gives it its number and its name on the wire. */
#ifndef PERCUSS_CONTACT_LAW_H
#define PERCUSS_CONTACT_LAW_H

#include <stdbool.h>
#include <stddef.h>

#include "percuss/vocabulary.h"

enum { CONTACT_LAW_PARAMETERS = 6, CONTACT_LAW_AT_ONCE = 4 };

/* History of a contact: the largest load that it had; all zero: never beyond yield. Depths from the
 * undeformed surface. */
struct contact_history {
    double max_indentation; /* m */
    double max_force;       /* N */
    double dent;            /* permanent depth, m */
    double contact_radius;  /* at the largest force, m */
};

struct contact_law;
struct hertz_contact;
struct material;
struct plastic_curve;
struct relaxation;

/* Time that an impact takes, which selects its thread: any thread, even the one that reads
 * requests; a worker; the thread of computations that take seconds. */
enum contact_effort { CONTACT_EFFORT_LEAST, CONTACT_EFFORT_SHORT, CONTACT_EFFORT_LONG };

/* The solver of the motion: the march of impact/ with the law's force, the same with a contact
 * region solved in every step (impact/concurrent.h), or meshes of both bodies
 * (fe/impact_complete.h). */
enum contact_method { CONTACT_BY_LAW, CONTACT_CONCURRENT, CONTACT_COMPLETE };

/* Tables of computed contacts: not used; used if there is one; required. */
enum contact_tables { CONTACT_TABLES_NONE, CONTACT_TABLES_IF_ANY, CONTACT_TABLES_ONLY };

/* Everything that depends on the law. The members up to `make` describe a model that can be
 * requested, the others a force law (AUTO and the models by finite elements have none: `make` gives
 * the law that they begin with).
 *
 * Indentations count from the bottom of the dent in the law's history. Between updates of
 * its history every law is elastic.
 *
 * A law that remembers (viscoelastic bodies) has a force of the whole way since the touch: `force`
 * and `stored` are those of a sudden indentation and of what comes back of one that is held, and
 * its own force is contact/memory.h, which impact/memory_step.h follows along a contact's steps.
 *
 * A law with `moving` has a force of the indentation and its rate, for which impact/way_contact.h
 * takes that of the bodies' approach; `force` is that at rest, `stored` what it gives back at rest.
 */
struct contact_law_operations {
    enum percuss_contact_model model;
    enum contact_effort effort;
    enum contact_method method;
    enum contact_tables tables;
    bool yields_if_needed; /* Hertz's law where no contact exceeds its yield */
    /* The law of a contact of two materials without a table; Hertz's where the law yields but
     * neither material can. */
    struct contact_law (*make)(const struct hertz_contact *hertz, const struct material *a,
                               const struct material *b);

    const char *title; /* for messages */
    bool three_halves; /* force = d^(3/2) times a function that is smooth at d = 0 */
    bool elliptic;     /* exact for elliptic contacts; else by the sphere that is as stiff */
    bool lossy;        /* its force depends on more than the indentation: on the way, */
    bool remembers;    /* as memory.h has it; else on the rate: `moving` */
    /* Force (N) at an indentation (m), 0 where indentation <= 0; *stiffness becomes its slope. */
    double (*force)(const struct contact_law *law, double indentation, double *stiffness);
    /* The same at several indentations at once; NULL: one by one. */
    void (*forces)(const struct contact_law *law, const double indentation[CONTACT_LAW_AT_ONCE],
                   double force[CONTACT_LAW_AT_ONCE], double stiffness[CONTACT_LAW_AT_ONCE]);
    /* Force (N), never negative, at an indentation that grows at a rate (m/s); *stiffness and
     * *viscosity (N s/m) become its slopes by both. NULL: the force does not depend on the rate. */
    double (*moving)(const struct contact_law *law, double indentation, double rate,
                     double *stiffness, double *viscosity);
    /* Recoverable energy (J) stored at an indentation. */
    double (*stored)(const struct contact_law *law, double indentation);
    /* Indentation at which the loading branch has a force > 0: a starting value and a scale. */
    double (*indentation)(const struct contact_law *law, double force);
    const struct plastic_curve *curve; /* of a law that yields, see plastic.h; NULL: elastic */
    /* Scales its forces by `force` and its yield stress by `yield`. */
    void (*rescale)(struct contact_law *law, double force, double yield);
};

struct contact_law {
    const struct contact_law_operations *operations;
    double parameters[CONTACT_LAW_PARAMETERS];
    const void *table; /* of a tabulated law, or the relaxation of one that remembers; borrowed */
    struct contact_history history;
};

/* F = stiffness d^(3/2), Hertz. stiffness in N/m^(3/2), see hertz.h. */
struct contact_law contact_law_hertz(double stiffness);

/* F = stiffness d, N/m: for verification against wave solutions. */
struct contact_law contact_law_linear(double stiffness);

/* Hertz's contact of viscoelastic bodies: `stiffness` (N/m^(3/2)) of a sudden indentation, and the
 * relaxation of both bodies together, borrowed. */
struct contact_law contact_law_viscoelastic(double stiffness, const struct relaxation *relaxation);

/* F = stiffness d^exponent (1 + dissipation d'), but at least 0: Hunt and Crossley, J. Appl. Mech.
 * 42 (1975) 440. stiffness > 0 in N/m^exponent; exponent >= 1, 1.5 of Hertz's contact; dissipation
 * >= 0 in s/m. */
struct contact_law contact_law_dissipative(double stiffness, double exponent, double dissipation);

/* F = stiffness d^exponent while it grows, N/m^exponent, exponent >= 1; of its work unloading gives
 * back 1 - hysteresis (0 <= hysteresis < 1), see law_power.c. */
struct contact_law contact_law_power(double stiffness, double exponent, double hysteresis);

/* Why a law is not followed in a scene with so many contacts with friction by CVODE, as the end of
 * a message. NULL: it is. */
const char *contact_law_refuses(const struct contact_law *law, size_t rubbing);

/* The operations of each model that can be requested, with its name in capitals. */
#define CONTACT_LAW_DECLARATION(name, text)                                                        \
    extern const struct contact_law_operations contact_law_##name;
PERCUSS_CONTACT_MODEL_LIST(CONTACT_LAW_DECLARATION)

/* The operations of a model by its number; AUTO's for a number out of range. */
const struct contact_law_operations *contact_law_asked(unsigned model);

static inline double contact_law_force(const struct contact_law *law, double indentation,
                                       double *stiffness)
{
    return law->operations->force(law, indentation, stiffness);
}

static inline void contact_law_forces(const struct contact_law *law,
                                      const double indentation[CONTACT_LAW_AT_ONCE],
                                      double force[CONTACT_LAW_AT_ONCE],
                                      double stiffness[CONTACT_LAW_AT_ONCE])
{
    if (law->operations->forces) {
        law->operations->forces(law, indentation, force, stiffness);
        return;
    }
    for (int i = 0; i < CONTACT_LAW_AT_ONCE; i++)
        force[i] = law->operations->force(law, indentation[i], &stiffness[i]);
}

#endif
