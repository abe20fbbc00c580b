/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/node_contact.h"

#include <math.h>

static bool allocate(struct node_contact *contact, struct arena *arena)
{
    contact->gap = arena_take(arena, contact->pairs, sizeof(double));
    contact->mass = arena_take(arena, contact->pairs, sizeof(double));
    contact->closing = arena_take(arena, contact->pairs, sizeof(double));
    bool ok = contact->gap && contact->mass && contact->closing;
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        contact->at[b] = arena_take(arena, contact->pairs, sizeof(size_t));
        contact->scale[b] = arena_take(arena, contact->pairs, sizeof(double));
        ok = ok && contact->at[b] && contact->scale[b];
    }
    return ok;
}

enum percuss_status node_contact_create(const struct dynamics *dynamics, struct arena *arena,
                                        struct node_contact *contact, struct fault *fault)
{
    *contact = (struct node_contact){.pairs = dynamics->body[0].fine};
    if (!allocate(contact, arena))
        return fault_set(fault, PERCUSS_INTERNAL, "no memory for %zu contact pairs",
                         contact->pairs);
    /* each pair's places, gap, and mass against an impulse */
    for (size_t i = 0; i < contact->pairs; i++) {
        double compliance = 0.0;
        double radius[DYNAMICS_BODIES];
        for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
            uint32_t node = dynamics->number[b][dynamics->body[b].mesh->contact.index[i]];
            contact->at[b][i] = 2 * (size_t)node + 1;
            contact->scale[b][i] = 1.0 / dynamics->root_mass[node];
            contact->gap[i] -= dynamics->at[node][1];
            compliance += contact->scale[b][i] * contact->scale[b][i];
            radius[b] = dynamics->at[node][0];
        }
        contact->mass[i] = 1.0 / compliance;
        /* pairs face each other */
        if (fabs(radius[0] - radius[1]) > 1e-9 * radius[1])
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "contact node %zu: radii %g and %g m: must be the same", i, radius[0],
                             radius[1]);
    }
    return PERCUSS_OK;
}

double node_contact_close(struct node_contact *contact, struct dynamics *dynamics)
{
    const double *y = dynamics->y;
    double *v = dynamics->v;
    double step = dynamics->step;
    double sum = 0.0;
    for (size_t i = 0; i < contact->pairs; i++) {
        size_t a = contact->at[0][i];
        size_t b = contact->at[1][i];
        double scale_a = contact->scale[0][i];
        double scale_b = contact->scale[1][i];
        /* where the pair is, and the impulse that closes its gap by the end of the step */
        double gap = contact->gap[i] - y[a] * scale_a - y[b] * scale_b;
        double closing = v[a] * scale_a + v[b] * scale_b;
        double impulse = (closing - gap / step) * contact->mass[i];
        double before = contact->closing[i];
        /* an open one bears nothing */
        contact->closing[i] = closing;
        if (!(impulse > 0.0))
            continue;
        /* a closed one takes it, equal and opposite */
        contact->closing[i] = gap / step;
        v[a] -= impulse * scale_a;
        v[b] -= impulse * scale_b;
        contact->loss += 0.5 * impulse * (before + contact->closing[i]);
        sum += impulse;
        contact->outgrown |= i + 1 == contact->pairs;
    }
    contact->impulse += sum;
    return sum;
}
