/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <stdlib.h>

#include "list.h"

static int by_time(const void *x, const void *y)
{
    const struct entry *a = x, *b = y;
    if (a->play != b->play)
        return a->play < b->play ? -1 : 1;
    return a->contact < b->contact ? -1 : a->contact > b->contact;
}

/* The sub-impacts of a contact; their sum is its impulse to the last bit that matters. */
static void list_contact(struct episode *episode, const struct percuss_contact_result *result,
                         size_t contact)
{
    double sum = 0.0;
    struct entry *first = &episode->entries[episode->entry_count];
    for (uint32_t i = 0; i < result->sub_impacts_listed; i++) {
        const struct percuss_sub_impact *sub = &result->sub_impacts[i];
        struct entry *entry = &episode->entries[episode->entry_count++];
        *entry = (struct entry){.time = episode->time + percuss_slow_force_centre(sub),
                                .start = sub->start,
                                .end = sub->end,
                                .contact = contact,
                                .impulse = sub->impulse};
        sum += sub->impulse;
    }
    /* rounding, or more sub-impacts than are listed */
    struct entry rest = {.time = episode->time + result->end_time,
                         .start = result->end_time,
                         .end = result->end_time,
                         .contact = contact,
                         .impulse = result->impulse - sum};
    if (result->sub_impact_count > result->sub_impacts_listed)
        episode->entries[episode->entry_count++] = rest;
    else if (result->sub_impacts_listed)
        first[result->sub_impacts_listed - 1].impulse += rest.impulse;
}

void list_make(struct episode *episode, const struct percuss_reply *reply, const double *impulse,
               bool total)
{
    for (size_t i = 0; i < episode->request.contact_count; i++)
        if (reply)
            list_contact(episode, &reply->contacts[i], i);
        else if (impulse[i] != 0.0)
            episode->entries[episode->entry_count++] =
                (struct entry){.time = episode->time, .contact = i, .impulse = impulse[i]};
    for (size_t i = 0; i < episode->entry_count; i++)
        episode->entries[i].play = total ? episode->time : episode->entries[i].time;
    qsort(episode->entries, episode->entry_count, sizeof *episode->entries, by_time);
}
