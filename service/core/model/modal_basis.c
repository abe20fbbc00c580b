/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/modal_basis.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

void site_load_find(const struct body *body, const struct site *site, const double direction[3],
                    bool tangential, struct site_load *load)
{
    /* a family that the kind does not have does not act; the first is cleared of any kind */
    size_t count = body->kind->family_count > 0 ? body->kind->family_count : 1;
    memset(load->family, 0, count * sizeof *load->family);
    for (size_t f = count; f < BODY_MOST_FAMILIES; f++)
        load->family[f].acts = false;
    if (body->kind->load)
        body->kind->load(body, site, direction, tangential, load);
}

static struct modal_family *modal_family_allocate(const struct mode_family *kind, size_t family,
                                                  size_t count)
{
    struct modal_family *modes = calloc(1, sizeof *modes);
    if (!modes)
        return NULL;
    /* room for all of them */
    modes->family = family;
    modes->count = count;
    modes->bytes = sizeof *modes + kind->walk_size +
                   (count + 1) * (sizeof *modes->omega + sizeof *modes->odd + kind->shape_size);
    modes->omega = calloc(count + 1, sizeof *modes->omega);
    modes->odd = calloc(count + 1, sizeof *modes->odd);
    if (kind->shape_size)
        modes->shapes = calloc(count + 1, kind->shape_size);
    if (kind->walk_size)
        modes->walk = calloc(1, kind->walk_size);
    if (modes->omega && modes->odd && (!kind->shape_size || modes->shapes) &&
        (!kind->walk_size || modes->walk))
        return modes;
    modal_family_free(modes);
    return NULL;
}

struct modal_family *modal_family_create(const struct body *body, size_t family, size_t count)
{
    const struct mode_family *kind = body->kind->families[family];
    struct modal_family *modes = modal_family_allocate(kind, family, count);
    if (modes)
        kind->find(body, modes);
    return modes;
}

struct modal_family *modal_family_grow(const struct body *body, const struct modal_family *known,
                                       size_t count)
{
    const struct mode_family *kind = body->kind->families[known->family];
    struct modal_family *modes = modal_family_allocate(kind, known->family, count);
    if (!modes)
        return NULL;
    if (kind->walk_size) {
        modes->known = known->count < count ? known->count : count;
        memcpy(modes->shapes, known->shapes, modes->known * kind->shape_size);
        memcpy(modes->walk, known->walk, kind->walk_size);
    }
    kind->find(body, modes);
    return modes;
}

bool modal_family_alike(const struct body *a, const struct body *b, size_t family)
{
    const struct mode_family *kind = a->kind->families[family];
    return a->kind == b->kind && kind->alike && kind->alike(a, b, family);
}

void modal_family_free(struct modal_family *modes)
{
    if (!modes)
        return;
    free(modes->omega);
    free(modes->odd);
    free(modes->shapes);
    free(modes->walk);
    free(modes);
}

void modal_participations(const struct body *body, const struct modal_family *modes,
                          const size_t *which, size_t count, const struct family_load *load,
                          double *row)
{
    body->kind->families[modes->family]->participations(body, modes, which, count, load, row);
}

double modal_participation(const struct body *body, const struct modal_family *modes, size_t k,
                           const struct family_load *load)
{
    double shape;
    modal_participations(body, modes, &k, 1, load, &shape);
    return shape;
}

double modal_compliance(const struct body *body, size_t family, const struct family_load *i,
                        const struct family_load *j)
{
    if (!i->acts || !j->acts)
        return 0.0;
    return body->kind->families[family]->compliance(body, family, i, j);
}

size_t modal_family_most(const struct body *body, size_t family)
{
    const struct mode_family *kind = body->kind->families[family];
    return kind->most ? kind->most(body) : SIZE_MAX;
}

double modal_beyond(const struct body *body, const struct modal_family *modes, size_t first,
                    const struct family_load *load, double left)
{
    const struct mode_family *kind = body->kind->families[modes->family];
    return kind->beyond ? kind->beyond(body, modes, first, load) : left;
}

double modal_remainder_frequency(const struct body *body, const struct modal_family *modes,
                                 size_t first)
{
    const struct mode_family *kind = body->kind->families[modes->family];
    bool crowded = kind->crowds && kind->crowds(body);
    return (crowded ? 1.0 : sqrt(3.0)) * modes->omega[first];
}
