/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/prepared_part.h"

#include <stdlib.h>
#include <string.h>

struct prepared_part {
    struct prepared_part *next;
    const struct prepared_group *whole;
    struct prepared_group group;
};

static void free_part(struct prepared_part *part)
{
    oscillators_free(part->group.set);
    free(part->group.mode);
    free(part);
}

void prepared_parts_clear(struct prepared_parts *parts)
{
    while (parts->first) {
        struct prepared_part *next = parts->first->next;
        free_part(parts->first);
        parts->first = next;
    }
    parts->count = 0;
}

const struct prepared_group *prepared_parts_get(struct prepared_parts *parts,
                                                const struct prepared_group *whole,
                                                const size_t *which, size_t count)
{
    for (struct prepared_part *known = parts->first; known; known = known->next)
        if (known->whole == whole && known->group.set->count == count &&
            memcmp(known->group.set->which, which, count * sizeof *which) == 0)
            return &known->group;
    struct prepared_part *made = calloc(1, sizeof *made);
    if (!made)
        return NULL;
    made->whole = whole;
    made->group.set = oscillators_part(whole->set, which, count);
    made->group.mode = calloc(count + 1, sizeof *made->group.mode);
    if (!made->group.set || !made->group.mode) {
        free_part(made);
        return NULL;
    }
    for (size_t i = 0; i < count; i++)
        made->group.mode[i] = whole->mode[which[i]];
    made->next = parts->first;
    parts->first = made;
    parts->count++;
    return &made->group;
}
