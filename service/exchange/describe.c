/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/describe.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exchange/text.h"
#include "model/body_kind.h"
#include "percuss/plausible.h"

/* Pairs of materials. */

static void describe_law(const struct own_law *law, percuss_v1_ContactLaw *wire)
{
    const struct own_curve *points = &law->points, *back = &law->unloading;
    *wire = (percuss_v1_ContactLaw){
        .stiffness = NAN,
        .exponent = NAN,
        .hysteresis = NAN,
        .dissipation = NAN,
        .deviation = law->deviation,
        .point_count = (uint32_t)points->count,
        .max_indentation = NAN,
        .max_force = NAN,
        .residual_indentation = NAN,
    };
    COPY_TEXT(wire->name, law->name);
    COPY_TEXT(wire->points, points->file);
    COPY_TEXT(wire->unloading, back->file);
    if (points->count > 0) {
        COPY_TEXT(wire->kind, "points");
        wire->max_indentation = points->indentation[points->count - 1];
        wire->max_force = points->force[points->count - 1];
        wire->residual_indentation = back->count > 0 ? back->indentation[0] : 0.0;
        return;
    }
    COPY_TEXT(wire->kind, law->dissipation > 0.0  ? "hunt-crossley"
                          : law->hysteresis > 0.0 ? "hysteresis"
                                                  : "power");
    wire->stiffness = law->stiffness;
    wire->exponent = law->exponent;
    wire->hysteresis = law->hysteresis;
    wire->dissipation = law->dissipation;
}

/* The pair of two materials, which is begun where it is not there yet. */
static percuss_v1_MaterialPair *pair_of(struct describer *describer,
                                        const char between[2][PERCUSS_ID_SIZE])
{
    percuss_v1_MaterialPair *pair = describer->pairs;
    percuss_v1_MaterialPair *end = pair + describer->pair_count;
    while (pair < end &&
           (strcmp(pair->material_a, between[0]) != 0 || strcmp(pair->material_b, between[1]) != 0))
        pair++;
    if (pair == end) {
        *pair = (percuss_v1_MaterialPair){.friction = NAN, .friction_deviation = NAN};
        COPY_TEXT(pair->material_a, between[0]);
        COPY_TEXT(pair->material_b, between[1]);
        describer->pair_count++;
    }
    return pair;
}

bool describe_begin(struct describer *describer, const struct body_set *set)
{
    size_t most = set->friction_count + set->law_count + 1;
    describer->pair_count = 0;
    describer->pairs = calloc(2 * most, sizeof *describer->pairs);
    describer->laws = calloc(most, sizeof *describer->laws);
    if (!describer->pairs || !describer->laws) {
        describe_end(describer);
        return false;
    }
    describer->of_body = describer->pairs + most;
    for (size_t i = 0; i < set->friction_count; i++) {
        percuss_v1_MaterialPair *pair = pair_of(describer, set->friction[i].between);
        pair->friction = set->friction[i].coefficient;
        pair->friction_deviation = set->friction[i].deviation;
    }
    for (size_t i = 0; i < set->law_count; i++) {
        percuss_v1_MaterialPair *pair = pair_of(describer, set->laws[i].between);
        describe_law(&set->laws[i], &describer->laws[i]);
        pair->law._buffer = &describer->laws[i];
        pair->law._length = pair->law._maximum = 1;
    }
    return true;
}

void describe_end(struct describer *describer)
{
    free(describer->pairs);
    free(describer->laws);
}

/* A mesh may be of several materials; the catalogue's stands for that of a file with one. */
static bool is_of(const struct body *body, const char *material)
{
    bool found = strcmp(body->material.name, material) == 0;
    size_t several = body->mesh && body->mesh->material_count > 1 ? body->mesh->material_count : 0;
    for (size_t i = 0; i < several; i++)
        found = found || strcmp(body->mesh->materials[i].name, material) == 0;
    return found;
}

static void describe_pairs(struct describer *describer, const struct body *body,
                           percuss_v1_Body *wire)
{
    uint32_t count = 0;
    for (size_t i = 0; i < describer->pair_count; i++) {
        const percuss_v1_MaterialPair *pair = &describer->pairs[i];
        if (is_of(body, pair->material_a) || is_of(body, pair->material_b))
            describer->of_body[count++] = *pair;
    }
    wire->pairs._buffer = describer->of_body;
    wire->pairs._length = wire->pairs._maximum = count;
}

/* Bodies. */

static void describe_losses(struct describer *describer, const struct body *body,
                            percuss_v1_Body *wire)
{
    const struct yield_rate *rate = &body->yield_rate;
    describer->losses = (percuss_v1_MaterialLosses){
        .loss_factor = body->loss_factor,
        .rate_reference = yield_rate_is_stated(rate) ? rate->reference : NAN,
        .rate_exponent = rate->exponent > 0.0 ? rate->exponent : NAN,
        .rate_coefficient = rate->coefficient > 0.0 ? rate->coefficient : NAN,
        .loss_frequency = body->loss_frequency > 0.0 ? body->loss_frequency : NAN,
    };
    for (size_t i = 0; i < body->relaxation.count; i++)
        describer->terms[i] =
            (percuss_v1_RelaxationTerm){body->relaxation.share[i], body->relaxation.time[i]};
    describer->losses.relaxation._buffer = describer->terms;
    describer->losses.relaxation._length = describer->losses.relaxation._maximum =
        (uint32_t)body->relaxation.count;
    wire->losses._buffer = &describer->losses;
    wire->losses._length = wire->losses._maximum = 1;
}

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

void describe_body(struct describer *describer, const struct body *body, percuss_v1_Body *wire)
{
    struct body_description description = {.text = ""};
    *wire = (percuss_v1_Body){.mass = body->mass, .radius = body->radius};
    for (int i = 0; i < PERCUSS_PARAMETER_SCALE; i++)
        wire->parameters[i] = body_parameter(body, i);
    wire->scale = body_parameter(body, PERCUSS_PARAMETER_SCALE);
    memcpy(wire->inertia, body->inertia, sizeof wire->inertia);
    memcpy(wire->products, body->products, sizeof wire->products);
    describe_sites(body, wire, describer->sites);
    describe_losses(describer, body, wire);
    describe_pairs(describer, body, wire);
    for (int end = 0; end < 2; end++)
        wire->supports[end] = body->supports[end];
    snprintf(wire->id, sizeof wire->id, "%s", body->id);
    snprintf(wire->shape, sizeof wire->shape, "%s", body->kind->name);
    snprintf(wire->material, sizeof wire->material, "%s", body->material.name);
    body->kind->describe(body, &description);
    if (body->loss_factor > 0.0 && body->loss_frequency > 0.0)
        describe_add(&description, "loss factor %g at %g Hz", body->loss_factor,
                     body->loss_frequency);
    else if (body->loss_factor > 0.0)
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
