/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce_mpi/team.h"

#include "reduce_mpi/spread_modes.h"

/* One set of matrices that the first process has. */
struct member {
    uint64_t key;
    struct spread spread;
    struct member *next;
};

void team_order(struct team_order order)
{
    MPI_Bcast(&order, sizeof order, MPI_BYTE, 0, PETSC_COMM_WORLD);
}

static struct member *begin(struct member **members, uint64_t key)
{
    struct member *member;
    SPREAD_CALL(PetscNew(&member));
    member->key = key;
    member->next = *members;
    *members = member;
    return member;
}

/* The pointer to a member, which the first process has made. */
static struct member **team_find(struct member **members, uint64_t key)
{
    while ((*members)->key != key)
        members = &(*members)->next;
    return members;
}

static void seek_modes(struct spread *spread, const struct team_order *order)
{
    double *squares;
    struct spread_modes_task task = {.count = order->count,
                                     .rigid_count = order->rigid_count,
                                     .shift = order->shift,
                                     .seed = order->seed};
    SPREAD_CALL(PetscMalloc1(task.count, &squares));
    spread_modes(spread, &task, squares, NULL);
    SPREAD_CALL(PetscFree(squares));
}

static void finish(struct member **place)
{
    struct member *member = *place;
    *place = member->next;
    spread_free(&member->spread);
    SPREAD_CALL(PetscFree(member));
}

void team_follow(void)
{
    struct member *members = NULL;
    struct spread_outcome outcome;
    for (;;) {
        /* the leader's next order; the work itself is collective */
        struct team_order order;
        MPI_Bcast(&order, sizeof order, MPI_BYTE, 0, PETSC_COMM_WORLD);
        /* each with the factor that the key names */
        switch (order.job) {
        case TEAM_MAKE:
            spread_make(&begin(&members, order.key)->spread, NULL, order.positive, &outcome);
            break;
        case TEAM_COMPUTE:
            spread_compute(&(*team_find(&members, order.key))->spread, order.shift, &outcome);
            break;
        case TEAM_SOLVE:
            spread_solve(&(*team_find(&members, order.key))->spread, order.count, NULL, &outcome);
            break;
        case TEAM_MODES:
            seek_modes(&(*team_find(&members, order.key))->spread, &order);
            break;
        case TEAM_FREE:
            finish(team_find(&members, order.key));
            break;
        case TEAM_END:
            /* the remaining ones */
            while (members)
                finish(&members);
            return;
        }
    }
}
