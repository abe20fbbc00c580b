/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What solid_make.c, solid_step.c (Newton steps) and solid_energy.c share. */
#ifndef PERCUSS_FE_SOLID_PARTS_H
#define PERCUSS_FE_SOLID_PARTS_H

#include "fe/solid.h"
#include "numeric/band.h"

typedef struct plastic_state histories[QUAD_POINTS];

/* What a step starts from or may return to. */
struct snapshot {
    double *displacement; /* all nodes, r and z */
    histories *history;   /* by element */
    double force;         /* N, of all contact nodes: the far boundary moves with it */
    double *forces;       /* N, by contact node; of a solid that never yields */
    bool settled;         /* the displacement is that of the forces; else not found yet */
};

/* Forward solutions L^-1 e_j of unit contact forces, what any two of them have in common, and each
 * with the far boundary's. */
struct solid_loads {
    double *forward;      /* candidates x freedoms; row j from its own freedom on */
    double *common;       /* candidates x candidates, lower triangle: products of two rows */
    double *share;        /* products with `boundary` */
    size_t known, stride; /* rows that are there; candidates */
};

struct solid {
    bool linear; /* never yields: its displacement follows from the forces, when it is asked for */
    const struct mesh *mesh;
    const struct quad *quads;
    struct plastic_law law;
    size_t free_nodes; /* the far nodes come last */
    double *far;       /* displacement of the far nodes per newton, r and z */
    double *pull;      /* forces on the free freedoms per newton, from the far displacement */
    double *pulled;    /* elastic factor's forward solution of `pull` */
    double (*stiffness)[QUAD_FREEDOMS * QUAD_FREEDOMS]; /* elastic, by element */
    struct band elastic, tangent;
    struct snapshot committed, start, present;
    size_t zone;                  /* elements before this one may flow */
    bool yielding;                /* some point flows now: the tangent is not the elastic one */
    size_t first;                 /* first freedom that takes part in the present linearisation */
    double *balance;              /* internal forces on the free freedoms */
    double *residual;             /* forward solution of `balance` */
    double *boundary;             /* forward solution of `pull` */
    struct solid_loads unloading; /* by the elastic factor: found once */
    struct solid_loads flowing;   /* by the tangent's: anew in every linearisation */
};

static inline size_t freedoms(const struct solid *solid)
{
    return 2 * solid->free_nodes;
}

/* freedom of a free node's r; z is the next */
static inline size_t freedom(const struct solid *solid, size_t node)
{
    return 2 * (solid->free_nodes - 1 - node);
}

static inline bool is_fixed(const struct solid *solid, size_t node, size_t component)
{
    return component == 0 && solid->mesh->r[node] == 0.0;
}

/* displacements of an element's nodes */
void solid_gather(const struct solid *solid, size_t element, double local[QUAD_FREEDOMS]);

/* Forces of the elastic element at its present displacements. */
void solid_elastic_force(const struct solid *solid, size_t element, double force[QUAD_FREEDOMS]);

/* local forces of an element onto free freedoms; a fixed one stays in balance by its support */
void solid_scatter(const struct solid *solid, size_t element, const double *local, double *forces);

/* adds an element's stiffness to columns from `first` on; a fixed freedom keeps its diagonal alone
 */
void solid_assemble(const struct solid *solid, size_t element, const double *local, size_t first,
                    struct band *matrix);

/* The displacement of a linear solid's present forces. */
void solid_settle(struct solid *solid);

/* The far nodes move as under this contact force, N. */
void solid_move_far(struct solid *solid, double force);

#endif
