/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a point of a bar's side gives way beyond its half-space and the bar's own compliance there:
 * the static solution on a mesh less what the beam's families hold (model/beam_statics.c). */
#ifndef PERCUSS_TEST_SIDE_LOCAL_H
#define PERCUSS_TEST_SIDE_LOCAL_H

#include "model/bar.h"
#include "physics/support.h"
#include "unit/reduce/flexed.h"

enum { SIDE_PLACES = 16 };

struct side_solution {
    struct body bar;
    double depth; /* of the section, m */
    size_t count;
    double along[SIDE_PLACES], aside[SIDE_PLACES]; /* x/length, y/(breadth/2) */
    double local[SIDE_PLACES];                     /* times E and the depth: found */
    double fitted[SIDE_PLACES];                    /* the same by beam_side_compliance */
};

/* ratio: breadth over depth; 0: a round section. */
static inline struct body side_bar(double ratio, double poisson, double slenderness)
{
    static const double DEPTH = 0.01;
    struct fault fault;
    struct body bar =
        make_body(&beam_kind, (struct material){"metal", 70e9, poisson, 2700.0, INFINITY, 0.0});
    bar.length = slenderness * DEPTH;
    bar.radius = ratio == 0.0 ? 0.5 * DEPTH : 0.0;
    bar.width = ratio * DEPTH;
    bar.height = ratio == 0.0 ? 0.0 : DEPTH;
    assert_int_equal(body_complete(&bar, &fault), PERCUSS_OK);
    return bar;
}

/* Elements along the bar, across it and on the depth; of a round one in the core and its rings. */
static inline void side_mesh(const struct body *bar, const size_t cells[3], struct solid_mesh *mesh)
{
    if (bar->radius > 0.0) {
        double wider = 1.0 + pow(M_PI / 8.0 / (double)cells[1], 4.0) / 60.0;
        solid_shape_cylinder(ELEMENT_HEX20, (double[2]){wider * bar->radius, bar->length},
                             (size_t[3]){cells[1], cells[2], cells[0]}, &bar->material, mesh);
    } else {
        solid_shape_block(ELEMENT_HEX20, (double[3]){bar->length, bar->width, bar->height}, cells,
                          &bar->material, mesh);
    }
}

/* All that the families of the bar give way at a site, m/N. */
static inline double side_families(const struct body *bar, const struct site *site,
                                   const double inward[3])
{
    struct site_load load = site_load_make(bar, site, inward, false);
    double sum = 0.0;
    for (size_t f = 0; f < bar->kind->family_count; f++)
        sum += modal_compliance(bar, f, &load.family[f], &load.family[f]);
    return sum;
}

static inline void side_solve(struct side_solution *side, const size_t cells[3])
{
    struct flexed flexed;
    struct solid_mesh mesh;
    const struct body *bar = &side->bar;
    const struct material *metal = &bar->material;
    bool is_round = bar->radius > 0.0;
    side->depth = is_round ? 2.0 * bar->radius : bar->height;
    side_mesh(bar, cells, &mesh);
    flexed_make(&flexed, &mesh, 1e8, false);
    /* in the middle of a face round about: the mesh's surface has kinks elsewhere */
    double turn = is_round ? M_PI / 8.0 / (double)cells[1] : 0.0;
    double unit = metal->young * side->depth;
    for (size_t i = 0; i < side->count; i++) {
        double y = is_round ? bar->radius * sin(turn) : 0.5 * side->aside[i] * bar->width;
        double z = is_round ? bar->radius * cos(turn) : 0.5 * bar->height;
        struct site site = {.face = SITE_BEAM_SIDE,
                            .point = {side->along[i] * bar->length, y, z},
                            .outward = {0.0, sin(turn), cos(turn)}};
        struct flexibility_place place =
            flexed_place(&flexed, site.point[0] + 0.5 * bar->length,
                         is_round ? y : y + 0.5 * bar->width, is_round ? z : bar->height);
        struct flexibility_answer answer = flexed_solve(&flexed, &place);
        double value = answer.value;
        /* of a contact of a tenth of the radius */
        if (is_round)
            value += flexibility_slope(metal->young, metal->poisson, 0.5 / bar->radius) *
                         log(answer.radius / (0.1 * bar->radius)) +
                     flexibility_of_contact(metal->young, metal->poisson, 0.5 / bar->radius);
        side->local[i] =
            unit * (value - side_families(bar, &site, (double[3]){0.0, -sin(turn), -cos(turn)}));
        side->fitted[i] = unit * beam_side_compliance(bar, site.point, site.outward);
    }
    flexed_free(&flexed);
}

#endif
