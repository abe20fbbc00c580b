/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/revision.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* FNV-1a, 128 bits (Fowler, Noll, Vo; RFC 9923): xor an octet, multiply by 2^88 + 0x13b. */
__extension__ typedef unsigned __int128 wide;

struct hash {
    wide state;
};

static void hash_octet(struct hash *hash, unsigned char octet)
{
    const wide prime = ((wide)1 << 88) + 0x13b;
    hash->state = (hash->state ^ octet) * prime;
}

static void hash_number(struct hash *hash, uint64_t number)
{
    for (int shift = 0; shift < 64; shift += 8)
        hash_octet(hash, (unsigned char)(number >> shift));
}

static void hash_double(struct hash *hash, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    hash_number(hash, bits);
}

/* The terminating zero keeps neighbours apart. */
static void hash_text(struct hash *hash, const char *text)
{
    size_t size = strlen(text) + 1;
    for (size_t i = 0; i < size; i++)
        hash_octet(hash, (unsigned char)text[i]);
}

static void hash_material(struct hash *hash, const struct material *material)
{
    hash_text(hash, material->name);
    hash_double(hash, material->young);
    hash_double(hash, material->poisson);
    hash_double(hash, material->density);
    hash_double(hash, material->yield);
    hash_double(hash, material->tangent);
}

static void hash_doubles(struct hash *hash, const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        hash_double(hash, values[i]);
}

/* A file by its origin, and the catalogue's keys of it. */
static void hash_mesh(struct hash *hash, const struct body *body)
{
    hash_text(hash, body->mesh->hash);
    hash_text(hash, body->mesh->source);
    hash_double(hash, body->scale);
    hash_number(hash, body->rigid);
    if (body->damping_count > 0)
        hash_number(hash, body->damping_count);
    hash_doubles(hash, body->damping_shares, body->damping_count);
    hash_number(hash, body->site_count);
    for (size_t i = 0; i < body->site_count; i++) {
        const struct body_site *site = &body->sites[i];
        hash_text(hash, site->name);
        hash_doubles(hash, site->point, 3);
        hash_doubles(hash, site->normal, 3);
        hash_doubles(hash, site->curvature, 9);
        hash_number(hash, site->has_normal);
        hash_number(hash, site->has_curvature);
    }
}

static void hash_body(struct hash *hash, const struct body *body)
{
    const double dimensions[] = {
        body->radius,  body->width,   body->height,  body->length,  body->tip_radius,
        body->size[0], body->size[1], body->size[2], body->damping,
    };
    hash_text(hash, body->id);
    hash_material(hash, &body->material);
    hash_number(hash, body_kind_number(body->kind));
    for (size_t i = 0; i < sizeof dimensions / sizeof *dimensions; i++)
        hash_double(hash, dimensions[i]);
    hash_number(hash, body->lateral_inertia);
    hash_number(hash, body->supports[0]);
    hash_number(hash, body->supports[1]);
    hash_number(hash, body->modes);
    hash_number(hash, body->theory);
    /* the factors themselves: they are NAN where the rule has no effect */
    for (int plane = 0; plane < 2 && !isnan(body->shear_factor[plane]); plane++)
        hash_double(hash, body->shear_factor[plane]);
    if (!isnan(body->loss_factor)) {
        hash_text(hash, "loss_factor");
        hash_double(hash, body->loss_factor);
    }
    if (body->loss_frequency > 0.0) {
        hash_text(hash, "loss_frequency");
        hash_double(hash, body->loss_frequency);
    }
    if (body->relaxation.count > 0) {
        hash_text(hash, "relaxation");
        hash_number(hash, body->relaxation.count);
        hash_doubles(hash, body->relaxation.share, body->relaxation.count);
        hash_doubles(hash, body->relaxation.time, body->relaxation.count);
        hash_double(hash, body->damping_peak);
    }
    if (yield_rate_is_stated(&body->yield_rate)) {
        hash_text(hash, "rate");
        hash_double(hash, body->yield_rate.reference);
        hash_double(hash, body->yield_rate.exponent);
        hash_double(hash, body->yield_rate.coefficient);
    }
    if (isinf(body->material.yield) && !body->yield_unstated)
        hash_text(hash, "yield: none");
    if (body->mesh)
        hash_mesh(hash, body);
    else if (body->rigid)
        hash_text(hash, "rigid");
}

static void hash_laws(struct hash *hash, const struct body_set *set)
{
    if (set->law_count == 0)
        return;
    hash_text(hash, "laws");
    hash_number(hash, set->law_count);
    for (size_t i = 0; i < set->law_count; i++) {
        const struct own_law *law = &set->laws[i];
        const double numbers[] = {law->stiffness, law->exponent, law->hysteresis, law->dissipation,
                                  law->deviation};
        const struct own_curve *const curves[] = {&law->points, &law->unloading};
        hash_text(hash, law->name);
        hash_text(hash, law->between[0]);
        hash_text(hash, law->between[1]);
        hash_doubles(hash, numbers, sizeof numbers / sizeof *numbers);
        for (int k = 0; k < 2; k++) {
            hash_number(hash, curves[k]->count);
            hash_doubles(hash, curves[k]->indentation, curves[k]->count);
            hash_doubles(hash, curves[k]->force, curves[k]->count);
        }
    }
}

static void hash_friction(struct hash *hash, const struct body_set *set)
{
    if (set->friction_count == 0)
        return;
    hash_text(hash, "friction");
    hash_number(hash, set->friction_count);
    for (size_t i = 0; i < set->friction_count; i++) {
        const struct friction_pair *pair = &set->friction[i];
        hash_text(hash, pair->between[0]);
        hash_text(hash, pair->between[1]);
        hash_double(hash, pair->coefficient);
        hash_double(hash, pair->deviation);
    }
}

static int by_id(const void *a, const void *b)
{
    const struct body *const *x = a, *const *y = b;
    return strcmp((*x)->id, (*y)->id);
}

enum percuss_status revision_write(struct body_set *set, struct fault *fault)
{
    /* by id, wherever in the file they stand */
    const struct body **order = malloc((set->count + 1) * sizeof *order);
    if (!order)
        return fault_set(fault, PERCUSS_INTERNAL, "catalogue revision: out of memory");
    for (size_t i = 0; i < set->count; i++)
        order[i] = &set->bodies[i];
    qsort(order, set->count, sizeof *order, by_id);

    /* from the offset basis over all that a result depends on */
    struct hash hash = {(wide)0x6c62272e07bb0142 << 64 | 0x62b821756295c58d};
    hash_text(&hash, "percuss catalogue 1"); /* of this list of fields */
    hash_number(&hash, set->compliance);
    hash_number(&hash, set->count);
    for (size_t i = 0; i < set->count; i++)
        hash_body(&hash, order[i]);
    hash_friction(&hash, set);
    hash_laws(&hash, set);
    free(order);
    snprintf(set->revision, sizeof set->revision, "%016" PRIx64 "%016" PRIx64,
             (uint64_t)(hash.state >> 64), (uint64_t)hash.state);
    return PERCUSS_OK;
}
