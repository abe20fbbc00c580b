/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tangential force of a contact with friction and its own tangential compliance, from the normal
 * law alone: the superposition of Jaeger (Arch. Appl. Mech. 65 (1995) 478), which gives the annuli
 * of Maw, Barber and Fawcett (Wear 38 (1976) 101) for Hertz's law.
 *
 * The contact is cut into cells by the indentation at which they begin to touch, y_i <= d < y_i+1,
 * y_i = depth (i/n)^2. A cell bears of the normal force F(d)
 *
 *   share_i(d) = F(m) - F(y_i) - (m - y_i) F'(y_i) + (d - m) (F'(m) - F'(y_i)),  m = min(d, y_i+1)
 *
 * (their sum is F), and resists the tangential displacement u of body a's surface against b's by
 * kappa (F'(m) - F'(y_i)) per metre, kappa a symmetric tensor, as long as its own force is below
 * the coefficient of friction mu times its share: Coulomb's law, cell by cell, a cell slips along
 * its force. The last cell has no upper end. Between updates of its history a normal law must be
 * elastic and convex. */
#ifndef PERCUSS_CONTACT_FRICTION_H
#define PERCUSS_CONTACT_FRICTION_H

#include "base/arena.h"
#include "contact/hertz.h"
#include "contact/law.h"

/* The unloading branch of a law that yields: its slope is linear between equal steps of the root
 * of the way back, as Hertz's is throughout. */
enum { FRICTION_BRANCH = 16 };

struct friction_branch {
    double largest, dent;              /* depths from the undeformed surface, m; 0: none yet */
    double span;                       /* way back, m */
    double slope[FRICTION_BRANCH + 1]; /* N/m */
    double force[FRICTION_BRANCH + 1]; /* N */
};

/* The normal law at an indentation, which counts from the bottom of the branch's dent; 0: open. */
struct friction_normal {
    double indentation, force, slope;
    size_t last; /* cell closed in part */
};

struct friction {
    const struct contact_law *law; /* borrowed */
    double coefficient;            /* mu > 0 */
    double ratio[3];               /* kappa: tangential over normal stiffness, xx, xy, yy */
    double over_ratio[3];          /* its inverse, since the touch */
    size_t parts, count;           /* cells up to the depth, and all: deeper ones are as fine */
    size_t reached;                /* of them, since the touch */
    /* the cells, [count]: y_i (m), the law's force and slope there (N, N/m), and share and slope of
     * a cell that is closed throughout: share = base + stiffness d; 1/stiffness */
    double *edge, *force, *slope, *base, *stiffness, *compliance;
    double depth;                  /* m, of the cells */
    double spacing;                /* N/m, of the cells' slopes where the law yields; 0: elastic */
    struct friction_branch branch; /* of a law that yields, */
    size_t placed;                 /* and the cells whose edges lie on it */
    /* the history: at the indentation (m; <= 0: open), the share (N) and the tangential force over
     * mu (N) of each cell by direction; displacement since the touch, m */
    double *share, *traction[2]; /* the force along the axis and across it */
    double axis[2];       /* along the tangents, unit: the first where kappa has directions */
    bool isotropic, line; /* kappa is a number; all along the axis */
    double indentation;
    double displacement[2];
    struct friction_normal at; /* that indentation */
    double stuck;      /* sum of the stiffnesses of cells that stick, N/m, not times kappa */
    double resists[3]; /* slope of the force by the displacement along each tangent, N/m: of cells
                          that stick, and across the force of those that slip; and between both */
    double lost;       /* by slip since friction_create, J */
};

/* Ratios of tangential to normal stiffness of two elastic half-spaces along the contact ellipse's
 * major and minor axis: with K and E of m = 1 - (b/a)^2, D = (K - E)/m and B = K - D
 *
 *   kappa_major = sum[(1 - nu)/G] K / sum[((1 - nu) K + nu D)/G],    kappa_minor: B for D,
 *
 * sums over both bodies; of a circle sum[(1 - nu)/G] / sum[(2 - nu)/(2 G)] (Johnson, Contact
 * Mechanics, section 7.2 for the circle; Vermeulen and Johnson, J. Appl. Mech. 31 (1964) 338). */
void friction_ratios(const struct hertz_contact *hertz, const struct material *a,
                     const struct material *b, double ratio[2]);

/* A contact without friction's history, with `parts` > 0 cells up to its depth, from the arena.
 * False: no memory. */
bool friction_create(struct friction *friction, double coefficient, const double ratio[3],
                     size_t parts, struct arena *arena);

/* The contact touches: its cells, all open, divide the indentations by `depth` (m), about the
 * largest one (sixteen times as much is as fine), and a law whose history changes only by yielding
 * until the contact opens. */
void friction_touch(struct friction *friction, const struct contact_law *law, double depth);

/* A second history of the same cells, at their first touch: for ways that are tried. False: no
 * memory. */
bool friction_second(struct friction *second, const struct friction *friction, struct arena *arena);

/* Copies cells and history. */
void friction_copy(struct friction *to, const struct friction *from);

/* The law has yielded at this instant, and its dent has deepened (m). */
void friction_deepen(struct friction *friction, double deeper);

/* Goes on to an indentation (<= 0: open) and a displacement, both in proportion; force[j] becomes
 * the tangential force of a on b, N. */
void friction_walk(struct friction *friction, double indentation, const double displacement[2],
                   double force[2]);

/* The same by a way that curves evenly. `rate`, [3]: how far indentation and displacement would go
 * in the time of the way at the rates of its end, m; NULL: straight. */
void friction_walk_curved(struct friction *friction, double indentation,
                          const double displacement[2], const double *rate, double force[2]);

/* The present tangential force, N. */
void friction_force(const struct friction *friction, double force[2]);

/* Recoverable energy of the cells that are closed, J. */
double friction_stored(const struct friction *friction);

#endif
