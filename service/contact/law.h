/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Force laws of a contact. A new law is one new .c file with its operations and its constructor. */
#ifndef PERCUSS_CONTACT_LAW_H
#define PERCUSS_CONTACT_LAW_H

#include <stddef.h>

#include "percuss/vocabulary.h"

enum { CONTACT_LAW_PARAMETERS = 4 };

struct contact_law;

/* `history` is what the contact remembers between sub-impacts: history_size bytes, zero when new;
 * NULL where history_size is 0. */
struct contact_law_operations {
    enum percuss_contact_model model;
    size_t history_size;
    /* Force (N) at an indentation (m), 0 where indentation <= 0; *stiffness becomes its slope. */
    double (*force)(const struct contact_law *law, const void *history, double indentation,
                    double *stiffness);
    /* Recoverable energy (J) stored at an indentation. */
    double (*stored)(const struct contact_law *law, const void *history, double indentation);
    /* Indentation at which the loading branch has the force f > 0: a starting value and a scale. */
    double (*indentation)(const struct contact_law *law, double force);
};

struct contact_law {
    const struct contact_law_operations *operations;
    double parameters[CONTACT_LAW_PARAMETERS];
};

/* F = stiffness d^(3/2), Hertz. stiffness in N/m^(3/2), see hertz.h. */
struct contact_law contact_law_hertz(double stiffness);

/* F = stiffness d, N/m: for verification against wave solutions. */
struct contact_law contact_law_linear(double stiffness);

static inline double contact_law_force(const struct contact_law *law, const void *history,
                                       double indentation, double *stiffness)
{
    return law->operations->force(law, history, indentation, stiffness);
}

#endif
