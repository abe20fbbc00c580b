/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/describe.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/body_kind.h"
#include "percuss/plausible.h"

static void describe_sites(const struct body *body, percuss_v1_Body *wire,
                           percuss_v1_BodySite *sites)
{
    for (size_t i = 0; i < body->site_count; i++) {
        snprintf(sites[i].name, sizeof sites[i].name, "%s", body->sites[i].name);
        body_site_point(body, &body->sites[i], sites[i].point);
        memcpy(sites[i].normal, body->sites[i].normal, sizeof sites[i].normal);
    }
    wire->sites._buffer = sites;
    wire->sites._length = wire->sites._maximum = (uint32_t)body->site_count;
}

void describe_body(const struct body *body, percuss_v1_Body *wire,
                   percuss_v1_BodySite sites[BODY_MOST_SITES])
{
    struct body_description description = {.text = ""};
    *wire = (percuss_v1_Body){.mass = body->mass, .radius = body->radius};
    for (int i = 0; i < PERCUSS_PARAMETER_SCALE; i++)
        wire->parameters[i] = body_parameter(body, i);
    wire->scale = body_parameter(body, PERCUSS_PARAMETER_SCALE);
    memcpy(wire->inertia, body->inertia, sizeof wire->inertia);
    memcpy(wire->products, body->products, sizeof wire->products);
    describe_sites(body, wire, sites);
    for (int end = 0; end < 2; end++)
        wire->supports[end] = body->supports[end];
    snprintf(wire->id, sizeof wire->id, "%s", body->id);
    snprintf(wire->shape, sizeof wire->shape, "%s", body->kind->name);
    snprintf(wire->material, sizeof wire->material, "%s", body->material.name);
    body->kind->describe(body, &description);
    if (body->loss_factor > 0.0)
        describe_add(&description, "loss factor %g", body->loss_factor);
    if (body->relaxation.count > 0)
        describe_add(&description, "modulus relaxes to %.3g of young, by %zu of its times",
                     relaxation_storage(&body->relaxation, 0.0), body->relaxation.count);
    if (yield_rate_is_stated(&body->yield_rate))
        describe_add(&description, "yield by rate of strain, %g times at 1000 1/s",
                     yield_rate_factor(&body->yield_rate, 1000.0));
    if (isinf(body->material.yield) && !body->yield_unstated)
        describe_add(&description, PLAUSIBLE_ELASTIC);
    memcpy(wire->half_extents, description.half_extents, sizeof wire->half_extents);
    wire->tip_radius = description.tip_radius;
    snprintf(wire->description, sizeof wire->description, "%s", description.text);
}
