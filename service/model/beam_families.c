/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/beam_families.h"

#include "model/bar.h"
#include "model/beam.h"
#include "model/beam_roots.h"
#include "model/torsion.h"

static int plane_number(size_t family)
{
    return family == BAR_BENDING_Z;
}

static void find_bending(const struct body *body, struct modal_family *modes)
{
    struct beam_plane plane = beam_plane_of(body, plane_number(modes->family));
    struct beam_mode *shapes = modes->shapes;
    size_t known = modes->known;
    if (known == 0)
        beam_modes_start(&plane, modes->walk);
    beam_modes_next(&plane, modes->walk, modes->count - known, shapes + known);
    bool alike = plane.supports[0] == plane.supports[1];
    for (size_t k = known; k < modes->count; k++) {
        modes->omega[k] = shapes[k].omega;
        modes->odd[k] = alike && shapes[k].even[0] == 0.0 && shapes[k].even[1] == 0.0;
    }
}

static void bending_participations(const struct body *body, const struct modal_family *modes,
                                   const size_t *which, size_t count,
                                   const struct family_load *load, double *row)
{
    struct beam_plane plane = beam_plane_of(body, plane_number(modes->family));
    const struct beam_mode *shapes = modes->shapes;
    for (size_t i = 0; i < count; i++)
        row[i] = beam_mode_on(&plane, &shapes[which[i]], &load->bar);
}

static double bending_compliance(const struct body *body, size_t family,
                                 const struct family_load *i, const struct family_load *j)
{
    struct beam_plane plane = beam_plane_of(body, plane_number(family));
    return beam_compliance(&plane, &i->bar, &j->bar);
}

const struct mode_family beam_bending_family = {
    .bends = true,
    .shape_size = sizeof(struct beam_mode),
    .walk_size = sizeof(struct beam_root_walk),
    .find = find_bending,
    .participations = bending_participations,
    .compliance = bending_compliance,
};

static void find_twist(const struct body *body, struct modal_family *modes)
{
    for (size_t k = 0; k < modes->count; k++) {
        modes->omega[k] = torsion_frequency(body, k);
        modes->odd[k] = torsion_is_odd(body, k);
    }
}

static void twist_participations(const struct body *body, const struct modal_family *modes,
                                 const size_t *which, size_t count, const struct family_load *load,
                                 double *row)
{
    for (size_t i = 0; i < count; i++)
        row[i] =
            load->bar.moment * torsion_shape(body, which[i], modes->omega[which[i]], load->bar.x);
}

static double twist_compliance(const struct body *body, size_t family, const struct family_load *i,
                               const struct family_load *j)
{
    (void)family;
    return i->bar.moment * j->bar.moment * torsion_compliance(body, i->bar.x, j->bar.x);
}

const struct mode_family beam_twist_family = {
    .find = find_twist,
    .participations = twist_participations,
    .compliance = twist_compliance,
};
