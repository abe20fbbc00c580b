/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A family of modes: waves of one sort of a body, whose modes are told apart by a number from the
 * lowest up. What a kind of body (body_kind.h) says of each of its families. */
#ifndef PERCUSS_MODEL_MODE_FAMILY_H
#define PERCUSS_MODEL_MODE_FAMILY_H

#include <stdbool.h>
#include <stddef.h>

struct body;
struct family_load;

/* Modes of one family of one body. */
struct modal_family {
    size_t family; /* the body's, of its kind's list */
    size_t count;
    double *omega;      /* [count], ascending, rad/s */
    unsigned char *odd; /* [count]: shape odd about the middle; all 0 unless supports are alike */
    void *shapes;       /* [count], what else the family keeps of them; NULL: nothing */
    size_t known;       /* so many are there before the search, which may begin behind them */
    void *walk;         /* where it got to, then; NULL: nothing is kept of that */
};

struct mode_family {
    /* Slow transverse waves: a body hit so comes back, and sub-impacts follow each other. */
    bool bends;

    /* It may do so in some places: where slow modes take enough of a blow. */
    bool returns;

    size_t shape_size; /* bytes of modal_family's shapes, each */
    size_t walk_size;  /* and of its walk */

    /* Fills in the modes; those that are known are there already. */
    void (*find)(const struct body *body, struct modal_family *modes);

    /* Displacement of the modes which[0 .. count - 1] at a load, along it, for unit modal
     * coordinates, 1/sqrt(kg). */
    void (*participations)(const struct body *body, const struct modal_family *modes,
                           const size_t *which, size_t count, const struct family_load *load,
                           double *row);

    /* Exact static compliance between two loads that act, see modal_compliance. */
    double (*compliance)(const struct body *body, size_t family, const struct family_load *i,
                         const struct family_load *j);

    /* How many modes there are; NULL: any number. `find` leaves in modes->omega[modes->count] a
     * frequency that those which are left out do not go below. */
    size_t (*most)(const struct body *body);

    /* What the modes from `first` on do to a load, as a compliance at the frequency of that one
     * with their inertia, m/N: omega^2 sum participation^2 / omega_k^4. NULL: what the modes before
     * leave of the static compliance. */
    double (*beyond)(const struct body *body, const struct modal_family *modes, size_t first,
                     const struct family_load *load);

    /* Whether frequencies crowd below a limit; NULL: evenly spaced. */
    bool (*crowds)(const struct body *body);
};

#endif
