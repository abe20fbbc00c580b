/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "group.h"

struct group *group_create(const struct percuss_slow *slow, size_t count)
{
    size_t bodies = slow->config.body_count;
    size_t numbers = count * count + 4 * count;
    struct group *group = calloc(1, sizeof *group + bodies * sizeof *group->bodies +
                                        count * sizeof *group->contacts + numbers * sizeof(double));
    if (!group)
        return NULL;
    group->count = count;
    group->bodies = (struct percuss_body_motion *)(group + 1);
    group->contacts = (struct percuss_slow_contact *)(group->bodies + bodies);
    group->delassus = (double *)(group->contacts + count);
    group->gap_rate = group->delassus + count * count;
    group->impulse = group->gap_rate + count;
    group->restitution = group->impulse + count;
    group->moved = group->restitution + count;
    return group;
}

enum percuss_result group_probe(const struct percuss_slow *slow, struct group *group,
                                bool everything)
{
    size_t n = group->count;
    if (n == 0)
        return PERCUSS_RESULT_OK;
    /* names that the engine need not fill in */
    if (everything)
        for (size_t i = 0; i < slow->config.body_count; i++) {
            struct percuss_body_motion *body = &group->bodies[i];
            *body = (struct percuss_body_motion){.orientation = {1.0, 0.0, 0.0, 0.0}};
            memcpy(body->id, slow->ids[i], sizeof body->id);
        }
    struct percuss_slow_view view = {
        .count = n,
        .contacts = group->contacts,
        .gap_rate = group->gap_rate,
        .delassus = everything ? group->delassus : NULL,
        .bodies = everything ? group->bodies : NULL,
    };
    if (!slow->config.engine.probe(slow->config.engine.context, &view))
        return slow_fail(PERCUSS_RESULT_INVALID_ARGUMENT, "the engine's probe failed");
    /* rounding must not make the matrix look asymmetric */
    for (size_t i = 0; everything && i < n; i++)
        for (size_t j = 0; j < i; j++) {
            double mean = 0.5 * (group->delassus[i * n + j] + group->delassus[j * n + i]);
            group->delassus[i * n + j] = group->delassus[j * n + i] = mean;
        }
    return PERCUSS_RESULT_OK;
}

void group_note(struct group *group, const char *format, ...)
{
    size_t used = strlen(group->message);
    size_t room = sizeof group->message - used;
    int length = used ? snprintf(group->message + used, room, "; ") : 0;
    if (length < 0 || (size_t)length >= room)
        return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(group->message + used + length, room - (size_t)length, format, arguments);
    va_end(arguments);
}
