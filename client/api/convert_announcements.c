/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "percuss/fields.h"

#define SAME_KIND(name, text)                                                                      \
    _Static_assert((unsigned)PERCUSS_TASK_##name == percuss_v1_TASK_##name, text);
PERCUSS_TASK_KIND_LIST(SAME_KIND)

static void convert_task(const percuss_v1_Task *from, struct percuss_task *to)
{
    PERCUSS_TASK_FIELDS(PERCUSS_COPY)
}

bool convert_announced_server(const percuss_v1_ServerStatus *from, struct percuss_server *to)
{
    size_t count = from->tasks._length;
    PERCUSS_SERVER_FIELDS(PERCUSS_COPY, PERCUSS_NONE)
    to->task_count = 0;
    to->tasks = NULL;
    if (count == 0)
        return true;
    to->tasks = calloc(count, sizeof *to->tasks);
    for (size_t i = 0; to->tasks && i < count; i++)
        convert_task(&from->tasks._buffer[i], &to->tasks[to->task_count++]);
    return to->tasks;
}

void convert_announced_body(const percuss_v1_Body *wire, struct percuss_body *body)
{
    *body = (struct percuss_body){
        .mass = wire->mass,
        .radius = wire->radius,
        .tip_radius = wire->tip_radius,
        .supports = {wire->supports[0], wire->supports[1]},
    };
    memcpy(body->id, wire->id, sizeof body->id);
    memcpy(body->shape, wire->shape, sizeof body->shape);
    memcpy(body->material, wire->material, sizeof body->material);
    memcpy(body->description, wire->description, sizeof body->description);
    _Static_assert(sizeof body->parameters == sizeof wire->parameters + sizeof wire->scale,
                   "as many as on the wire");
    memcpy(body->parameters, wire->parameters, sizeof wire->parameters);
    body->parameters[PERCUSS_PARAMETER_SCALE] = wire->scale;
    memcpy(body->inertia, wire->inertia, sizeof body->inertia);
    memcpy(body->products, wire->products, sizeof body->products);
    for (uint32_t i = 0; i < wire->sites._length && i < PERCUSS_MAX_SITES; i++) {
        struct percuss_site *site = &body->sites[body->site_count++];
        memcpy(site->name, wire->sites._buffer[i].name, sizeof site->name);
        memcpy(site->point, wire->sites._buffer[i].point, sizeof site->point);
        memcpy(site->normal, wire->sites._buffer[i].normal, sizeof site->normal);
    }
    memcpy(body->half_extents, wire->half_extents, sizeof body->half_extents);
}

static void convert_dent(const percuss_v1_Dent *from, struct percuss_dent *to)
{
    PERCUSS_DENT_FIELDS(PERCUSS_COPY)
}

bool convert_announced_specimen(const percuss_v1_Dents *wire, struct percuss_specimen *specimen)
{
    *specimen = (struct percuss_specimen){
        .impacts = wire->impacts,
        .dent_count = wire->patches._length,
    };
    memcpy(specimen->name, wire->specimen, sizeof specimen->name);
    memcpy(specimen->body, wire->body, sizeof specimen->body);
    specimen->dents = calloc(specimen->dent_count + 1, sizeof *specimen->dents);
    for (size_t i = 0; specimen->dents && i < specimen->dent_count; i++)
        convert_dent(&wire->patches._buffer[i], &specimen->dents[i]);
    return specimen->dents;
}
