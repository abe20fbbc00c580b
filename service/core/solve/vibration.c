/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/vibration.h"

#include <math.h>
#include <string.h>

#include "model/mesh_family.h"
#include "model/ritz.h"
#include "solve/contact_model.h"
#include "solve/error/deviation.h"

/* Share of the restitution that a body may keep and stay rigid, in tolerances. */
static const double KEPT = 0.1;
/* And whatever the tolerance: the unknown compliance of a compact body does as much. */
static const double LEAST_KEPT = 2e-5;

/* Whether a body vibrates, or would. One that is held moves in no other way. */
static bool matters(const struct problem *problem, size_t body)
{
    const struct body_state *state = problem->states[body];
    const struct body *of = problem->bodies[body];
    if ((state && state->count[0] > 0) || of->modes > 0 || of->supports[0] || of->supports[1])
        return true;
    double kept = fmax(KEPT * problem->tolerance, LEAST_KEPT);
    for (size_t c = 0; c < problem->contact_count; c++)
        for (int which = 0; which < 2; which++) {
            if (problem->sides[c][which].body != body)
                continue;
            struct model_impact blow = model_impact_fastest(problem, c);
            if (deviation_of_rigid(problem, c, which, &blow) > kept)
                return true;
        }
    return false;
}

/* At an edge the flexibility is infinite, and no polynomials have it: a place counts as no nearer
 * than so many shortest sides, where its error is as large as the answer. */
static const double NEAREST_EDGE = 0.05;

static void keep_off_edges(const struct body *body, struct mesh_load *load)
{
    struct ritz_shape shape;
    body->kind->box(body, &shape);
    double longest = fmax(shape.side[0], fmax(shape.side[1], shape.side[2]));
    double shortest = fmin(shape.side[0], fmin(shape.side[1], shape.side[2]));
    double off = NEAREST_EDGE * shortest / longest;
    for (int d = 0; d < 3; d++) {
        double most = 0.5 * shape.side[d] / longest - off;
        /* of a cylinder's side only the ends are edges */
        if (d != load->axis && !(shape.round && d > 0))
            load->point[d] = fmax(-most, fmin(load->point[d], most));
    }
    double out = hypot(load->point[1], load->point[2]);
    double most = 0.5 * shape.side[1] / longest - off;
    for (int d = 1; shape.round && load->axis == 0 && out > most && d < 3; d++)
        load->point[d] *= most / out;
}

/* Of a plate hit in its middle the tangential flexibility lacks 0.15 to 0.22 times as much as the
 * normal one, with 0.3 to 0.8 polynomials for each thickness (the rest follows a logarithm of the
 * thickness to 1e-3/(E h)); the share's own error is within the doubt of the normal one. */
static const double LACKS_ALONG = 0.2;

/* Its flexibility in all directions, for the three loads of a contact with friction. */
static bool lend_tangents(struct problem *problem, struct contact_friction *friction, int which,
                          const struct ritz_unresolved *unresolved)
{
    struct contact_side *side = &problem->sides[friction->contact][which];
    const struct body *body = problem->bodies[side->body];
    struct mesh_load *normal = &side->load.family[0].mesh;
    double unit = mesh_ratio_flexibility(body), *tensor = normal->tensor;
    if (!prepared_ritz_tensor(problem->cache, body->ritz, normal->axis, normal->side, normal->point,
                              tensor))
        return false;
    if (normal->axis == RITZ_ROUND)
        ritz_tensor_narrow(body->ritz, normal->point,
                           log(normal->cut / contact_patch_radius(problem, friction->contact)),
                           tensor);
    for (int k = 0; k < 6; k++)
        tensor[k] = unit * (tensor[k] + (k < 3 ? LACKS_ALONG * unresolved->lacks : 0.0));
    normal->all_ways = true;
    for (int t = 0; t < 2; t++) {
        struct contact_tangent *tangent = &friction->sides[t][which];
        tangent->load = side->load;
        struct mesh_load *along = &tangent->load.family[0].mesh;
        memcpy(along->direction, tangent->direction, sizeof along->direction);
        along->flexibility = mesh_load_between(along, along);
        along->slope = along->cut = 0.0;
    }
    return true;
}

/* Its static flexibility at a contact: without the half-space's. */
static bool lend_load(struct problem *problem, size_t c, int which)
{
    struct contact_side *side = &problem->sides[c][which];
    const struct body *body = problem->bodies[side->body];
    site_load_find(body, &side->site, side->direction, false, &side->load);
    struct mesh_load *load = &side->load.family[0].mesh;
    double unit = mesh_ratio_flexibility(body);
    keep_off_edges(body, load);
    struct ritz_unresolved unresolved =
        ritz_unresolved_at(body->ritz, load->axis, load->side, load->point);
    double flexibility =
        prepared_ritz_flexibility(problem->cache, body->ritz, load->axis, load->side, load->point);
    load->flexibility = unit * (flexibility + unresolved.lacks);
    load->unknown = unit * unresolved.doubt;
    if (load->axis == RITZ_ROUND) {
        load->slope = unit * ritz_slope(body->ritz);
        load->cut = RITZ_CUT * 2.0 * body->radius;
    }
    bool good = isfinite(flexibility);
    for (size_t i = 0; good && i < problem->friction_count; i++)
        if (problem->friction[i].contact == c)
            good = lend_tangents(problem, &problem->friction[i], which, &unresolved);
    return good;
}

/* The tensors of meshes are known for one radius; their contacts with friction have another. */
static void narrow_meshes(struct problem *problem)
{
    for (size_t i = 0; i < problem->friction_count; i++) {
        struct contact_friction *friction = &problem->friction[i];
        double patch = contact_patch_radius(problem, friction->contact);
        for (int which = 0; which < 2; which++) {
            struct contact_side *side = &problem->sides[friction->contact][which];
            const struct body *body = problem->bodies[side->body];
            if (!body->mesh || !side->load.family[0].acts)
                continue;
            mesh_family_narrow(body, &side->site, patch, &side->load.family[0].mesh);
            for (int t = 0; t < 2; t++)
                mesh_family_narrow(body, &side->site, patch,
                                   &friction->sides[t][which].load.family[0].mesh);
        }
    }
}

enum percuss_status vibration_lend(struct problem *problem, struct ritz_store *boxes,
                                   struct pace *pace, struct fault *fault)
{
    bool good = true;
    narrow_meshes(problem);
    for (size_t b = 0; good && b < problem->body_count; b++) {
        const struct body *body = problem->bodies[b];
        struct ritz_shape shape;
        if (!body->kind->box || body->rigid || !body->kind->box(body, &shape) ||
            !matters(problem, b))
            continue;
        /* a copy that has it */
        struct body *lent = arena_take(problem->arena, 1, sizeof *lent);
        if (lent) {
            *lent = *body;
            lent->ritz =
                prepared_ritz_get(problem->cache, boxes, &shape, body->material.poisson, pace);
        }
        good = lent && lent->ritz;
        if (!good)
            break;
        problem->bodies[b] = lent;
        for (size_t i = 0; good && i < 2 * problem->contact_count; i++)
            if (problem->sides[i / 2][i % 2].body == b)
                good = lend_load(problem, i / 2, (int)(i % 2));
    }
    if (good)
        return PERCUSS_OK;
    return pace_fault(fault, pace && pace->stopped ? PERCUSS_TIMEOUT : PERCUSS_INTERNAL);
}
