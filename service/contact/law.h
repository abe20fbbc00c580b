/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Force laws of a contact. A new law is one new .c file with its operations and its constructor. */
#ifndef PERCUSS_CONTACT_LAW_H
#define PERCUSS_CONTACT_LAW_H

#include <stddef.h>

#include "percuss/vocabulary.h"

enum { CONTACT_LAW_PARAMETERS = 6 };

/* What a contact remembers of its largest load; all zero: never beyond yield. Depths from the
 * surface as it was made. */
struct contact_history {
    double max_indentation; /* m */
    double max_force;       /* N */
    double dent;            /* depth that stays, m */
    double contact_radius;  /* at the largest force, m */
};

struct contact_law;
struct plastic_curve;

/* Indentations count from the bottom of the dent that the law's history holds. Between updates of
 * its history every law is elastic. */
struct contact_law_operations {
    enum percuss_contact_model model;
    /* Force (N) at an indentation (m), 0 where indentation <= 0; *stiffness becomes its slope. */
    double (*force)(const struct contact_law *law, double indentation, double *stiffness);
    /* Recoverable energy (J) stored at an indentation. */
    double (*stored)(const struct contact_law *law, double indentation);
    /* Indentation at which the loading branch has the force f > 0: a starting value and a scale. */
    double (*indentation)(const struct contact_law *law, double force);
    const struct plastic_curve *curve; /* of a law that yields, see plastic.h; NULL: elastic */
};

struct contact_law {
    const struct contact_law_operations *operations;
    double parameters[CONTACT_LAW_PARAMETERS];
    const void *table; /* of a tabulated law, borrowed */
    struct contact_history history;
};

/* F = stiffness d^(3/2), Hertz. stiffness in N/m^(3/2), see hertz.h. */
struct contact_law contact_law_hertz(double stiffness);

/* F = stiffness d, N/m: for verification against wave solutions. */
struct contact_law contact_law_linear(double stiffness);

static inline double contact_law_force(const struct contact_law *law, double indentation,
                                       double *stiffness)
{
    return law->operations->force(law, indentation, stiffness);
}

#endif
