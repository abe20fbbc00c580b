/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "queries.h"

#include <math.h>
#include <string.h>

static const double sphere_radius = 0.015; /* m */

const struct query queries[QUERY_COUNT] = {
    {"ping", NULL, {0}, 0, 0},
    {"sphere-sphere", "steel-sphere", {0.0, 0.0, 0.015}, 0.3, 1e-4},
    {"rod-1e-4", "al-rod", {0.5, 0.0, 0.0}, 0.3, 1e-4},
    {"beam-1e-3", "al-beam", {0.0, 0.0, 0.010}, 0.2, 1e-3},
    {"beam-1e-4", "al-beam", {0.0, 0.0, 0.010}, 0.2, 1e-4},
};

const struct query *query_find(const char *name)
{
    for (int i = 0; i < QUERY_COUNT; i++) {
        if (strcmp(queries[i].name, name) == 0)
            return &queries[i];
    }
    return NULL;
}

void query_fill(const struct query *query, unsigned long variation, struct percuss_request *request)
{
    percuss_request_init(request);
    struct percuss_body_motion *sphere = percuss_request_add_body(request, "steel-sphere");
    percuss_request_add_body(request, query->b);
    struct percuss_contact *contact = percuss_request_add_contact(request, 0, 1);
    double distance = hypot(query->point[0], query->point[2]);
    for (int i = 0; i < 3; i++) {
        contact->point[i] = query->point[i];
        contact->normal[i] = query->point[i] / distance;
        sphere->position[i] = contact->point[i] + sphere_radius * contact->normal[i];
        sphere->velocity[i] = -query->speed * (1.0 + 1e-7 * (double)variation) * contact->normal[i];
    }
    request->options.tolerance = query->tolerance;
}
