/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Laws of a contact that yields: one loading curve, and one unloading branch for each largest
 * indentation. Unloading and reloading follow the branch of the largest indentation so far, loading
 * beyond it the virgin curve. The law's history changes only by contact_law_yield, at an accepted
 * largest indentation; in between the law is elastic, so that a step may be tried and discarded. */
#ifndef PERCUSS_CONTACT_PLASTIC_H
#define PERCUSS_CONTACT_PLASTIC_H

#include "contact/law.h"

enum { CONTACT_KNOTS = 16 };

/* A point of an interpolated law where its third derivative jumps. */
struct contact_knot {
    double indentation;
    double cube; /* change of the force by the jump, over the cube of the way beyond the knot, to
                    first order; N/m^3 */
};

/* Operations of a law that yields; depths d from the virgin surface. */
struct plastic_curve {
    /* Force of the virgin loading curve at d > 0, and its slope. */
    double (*force)(const struct contact_law *law, double d, double *slope);
    /* Its work from 0 to d, J. */
    double (*work)(const struct contact_law *law, double d);
    /* The first depth beyond d where it has no third derivative; INFINITY: none. Steps of several
     * contacts, or of a law without knots, end there. */
    double (*joint)(const struct contact_law *law, double d);
    /* Of an interpolated law, NULL for others: the first knots on the way from one indentation to
     * another, on the curve or the branch where it begins. Returns how many there are. */
    size_t (*knots)(const struct contact_law *law, double from, double to,
                    struct contact_knot knots[CONTACT_KNOTS]);
    /* Largest elastic depth. */
    double (*yield)(const struct contact_law *law);
    /* Permanent depth after a largest depth d; < d. */
    double (*residual)(const struct contact_law *law, double d);
    /* Contact radius at d on the virgin curve, m. */
    double (*radius)(const struct contact_law *law, double d);
    /* Share of the largest force at the share 0 < x <= 1 of the way back to it, and its slope; 1 at
     * x = 1. */
    double (*branch)(const struct contact_law *law, double x, double *slope);
    /* Integral of that share from 0 to x. */
    double (*branch_work)(const struct contact_law *law, double x);
};

/* Operations that such a law has in common (struct contact_law_operations). */
double plastic_force(const struct contact_law *law, double indentation, double *stiffness);
double plastic_stored(const struct contact_law *law, double indentation);
double plastic_indentation(const struct contact_law *law, double force);

/* Indentation beyond which loading cannot be undone; INFINITY for an elastic law. */
double contact_law_limit(const struct contact_law *law);

/* Stiffness (N/m) at the top of the unloading branch; 0: the law has no branch yet. */
double contact_law_unloading(const struct contact_law *law);

/* Depth at which a law has taken up a work (J), of one that yields from its virgin curve, m. */
double contact_law_depth(const struct contact_law *law, double work);

/* The law after a largest depth (m, from the undeformed surface) of at least its history's and its
 * yield. */
struct contact_law contact_law_after(const struct contact_law *law, double depth);

/* Makes an indentation beyond the limit the largest so far. Returns the dissipated energy (J, the
 * area of the loop), by the law's own integrals. The dent deepens: indentations then count from its
 * new bottom, lower by the increase of history.dent. */
double contact_law_yield(struct contact_law *law, double indentation);

/* Gives a law the history of an earlier contact at the same place. If the largest load was by
 * another partner (its force is not this law's at that depth) it is transferred by its force: the
 * law gets the branch that it would have after the same force. Elastic laws ignore it. */
void contact_law_remember(struct contact_law *law, const struct contact_history *history);

/* Any law with forces scaled by `force` and yield stress by `yield`: a law with errors of that
 * size. Its history is that of a force scaled alike. */
struct contact_law contact_law_rescaled(const struct contact_law *law, double force, double yield);

#endif
