/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "group.h"

struct group *group_create(const struct percuss_slow *slow, size_t count)
{
    size_t bodies = slow->config.body_count;
    size_t numbers = count * count + 6 * count;
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

void group_free(struct group *group)
{
    if (group)
        free(group->oblique);
    free(group);
}

/* Rounding must not make a matrix look asymmetric. */
static void mend_symmetry(size_t rows, double *matrix)
{
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < i; j++) {
            double mean = 0.5 * (matrix[i * rows + j] + matrix[j * rows + i]);
            matrix[i * rows + j] = matrix[j * rows + i] = mean;
        }
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
    if (everything)
        mend_symmetry(n, group->delassus);
    return PERCUSS_RESULT_OK;
}

/* Relative difference of a contact's inverse mass along its normal by both of the engine's
 * callbacks, from which on one of them is wrong. */
static const double SAME_MATRIX = 1e-6;

enum percuss_result group_probe_oblique(const struct percuss_slow *slow, struct group *group)
{
    const struct percuss_slow_engine *engine = &slow->config.engine;
    size_t n = group->count, rows = 3 * n;
    struct percuss_slow_contact *contacts = malloc(n * sizeof *contacts);
    group->oblique = calloc(rows * rows, sizeof *group->oblique);
    if (!contacts || !group->oblique) {
        free(contacts);
        return slow_no_memory();
    }
    double second[3];
    memcpy(contacts, group->contacts, n * sizeof *contacts);
    for (size_t i = 0; i < n; i++)
        percuss_slow_tangents(&group->contacts[i], contacts[i].tangent, second);
    bool good = engine->oblique(engine->context, n, contacts, group->oblique);
    free(contacts);
    if (!good)
        return slow_fail(PERCUSS_RESULT_INVALID_ARGUMENT, "the engine's oblique failed");
    mend_symmetry(rows, group->oblique);
    /* rows in another order, or another matrix than that of the normals */
    for (size_t i = 0; i < n; i++) {
        double normal = group->delassus[i * (n + 1)], own = group->oblique[3 * i * (rows + 1)];
        if (!(fabs(own - normal) <= SAME_MATRIX * fabs(normal)))
            return slow_fail(PERCUSS_RESULT_INVALID_ARGUMENT,
                             "oblique: [%zu][%zu]: %.9g: the engine's probe has %.9g 1/kg for the "
                             "normal of this contact",
                             3 * i, 3 * i, own, normal);
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
