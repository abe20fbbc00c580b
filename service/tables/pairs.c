/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "tables/pairs.h"

#include <stdlib.h>

#include "contact/law_closed_form.h"
#include "store/table_key.h"

bool table_pair_is_round(const struct body *a, const struct body *b)
{
    return body_has_sphere(a) || body_has_sphere(b);
}

bool table_pair_yields(const struct body *a, const struct body *b)
{
    return closed_form_softer(&a->material, &b->material) >= 0;
}

/* One body for each material, with a sphere's surface if any of that material has one. */
static size_t find_materials(const struct body_set *set, const struct body **bodies)
{
    size_t count = 0;
    for (size_t i = 0; i < set->count; i++) {
        const struct body *body = &set->bodies[i];
        size_t k = 0;
        while (k < count && !table_same_material(&bodies[k]->material, &body->material))
            k++;
        if (k == count)
            bodies[count++] = body;
        else if (body_has_sphere(body) && !body_has_sphere(bodies[k]))
            bodies[k] = body;
    }
    return count;
}

bool table_pairs_find(const struct body_set *set, struct table_pair **pairs, size_t *count)
{
    *count = 0;
    *pairs = NULL;
    const struct body **bodies = malloc((set->count + 1) * sizeof *bodies);
    if (!bodies)
        return false;
    /* one body stands for its material */
    size_t materials = find_materials(set, bodies);
    size_t room = 0;
    bool good = true;
    for (size_t i = 0; i < materials && good; i++) {
        for (size_t k = i; k < materials && good; k++) {
            /* the one with a sphere first */
            const struct body *a = bodies[body_has_sphere(bodies[i]) ? i : k];
            const struct body *b = a == bodies[i] ? bodies[k] : bodies[i];
            if (!table_pair_is_round(a, b) || !table_pair_yields(a, b))
                continue;
            if (*count == room) {
                room = 2 * room + 8;
                void *more = realloc(*pairs, room * sizeof **pairs);
                good = more != NULL;
                *pairs = good ? more : *pairs;
            }
            if (good)
                (*pairs)[(*count)++] = (struct table_pair){a, b};
        }
    }
    free(bodies);
    return good;
}
