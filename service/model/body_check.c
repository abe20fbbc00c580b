/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/body_check.h"

#include <math.h>

#include "model/limits.h"

struct quantity {
    const char *field;
    double value;
    const struct limit *limit;
};

static enum percuss_status check_quantities(const struct quantity *quantities, size_t count,
                                            struct fault *fault)
{
    for (size_t i = 0; i < count; i++) {
        const struct quantity *q = &quantities[i];
        if (!limit_holds(q->limit, q->value))
            return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %.9g: must be %s", q->field, q->value,
                             q->limit->text);
    }
    return PERCUSS_OK;
}

enum percuss_status material_check(const struct material *material, struct fault *fault)
{
    bool elastic = material->yield == INFINITY;
    const struct quantity quantities[] = {
        {"young", material->young, &limit_young},
        {"poisson", material->poisson, &limit_poisson},
        {"density", material->density, &limit_density},
        {"tangent", material->tangent, &limit_tangent},
        {"yield", material->yield, &limit_yield},
    };
    size_t count = sizeof quantities / sizeof *quantities;
    enum percuss_status status = check_quantities(quantities, elastic ? count - 1 : count, fault);
    if (status)
        return status;
    if (material->tangent >= material->young)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "tangent: %.9g: must be below young (%.9g Pa)",
                         material->tangent, material->young);
    if (!elastic && material->yield >= material->young)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "yield: %.9g: must be below young (%.9g Pa)",
                         material->yield, material->young);
    if (elastic && material->tangent > 0.0)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "tangent: %.9g: must be 0 or absent without yield", material->tangent);
    return PERCUSS_OK;
}

static enum percuss_status check_material(const struct body *body, struct fault *fault)
{
    struct fault inner = {0};
    enum percuss_status status = material_check(&body->material, &inner);
    return status ? fault_set(fault, status, "material.%s", inner.text) : PERCUSS_OK;
}

static enum percuss_status check_ends(const struct body *body, struct fault *fault)
{
    for (int end = 0; end < 2; end++) {
        unsigned support = body->supports[end];
        if (body->shape == SHAPE_ROD && support == SUPPORT_PINNED)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "ends: pinned: must be free or fixed for a rod");
        if (support > SUPPORT_CLAMPED)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "ends: %u: must be free, pinned or clamped (0, 1, 2)", support);
        if (!body_is_flexible(body) && support != SUPPORT_FREE)
            return fault_set(fault, PERCUSS_BAD_REQUEST, "ends: %u: must be free for a %s", support,
                             shape_name(body->shape));
    }
    return PERCUSS_OK;
}

/* What rods and beams have in common. */
static enum percuss_status check_flexible(const struct body *body, struct fault *fault)
{
    const struct quantity quantities[] = {
        {"length", body->length, &limit_length},
        {"damping", body->damping, &limit_damping},
    };
    enum percuss_status status = check_quantities(quantities, 2, fault);
    if (!status && body->modes > LIMIT_MODES)
        status =
            fault_set(fault, PERCUSS_BAD_REQUEST, "modes: %u: must be a whole number, at most %d",
                      body->modes, LIMIT_MODES);
    return status;
}

static enum percuss_status check_rod(const struct body *body, struct fault *fault)
{
    struct quantity quantities[] = {
        {"radius", body->radius, &limit_length},
        {"tip_radius", body->tip_radius, &limit_length},
    };
    bool flat = body->tip_radius == INFINITY;
    enum percuss_status status = check_quantities(quantities, flat ? 1 : 2, fault);
    /* a smaller tip would not cover the face: its rim would stand beside the cap */
    if (!status && body->tip_radius < body->radius)
        status = fault_set(fault, PERCUSS_BAD_REQUEST,
                           "tip_radius: %.9g: must be at least radius (%.9g m); absent: flat ends",
                           body->tip_radius, body->radius);
    return status ? status : check_flexible(body, fault);
}

static enum percuss_status check_beam(const struct body *body, struct fault *fault)
{
    bool round = body->radius != 0.0;
    const struct quantity circle[] = {{"radius", body->radius, &limit_length}};
    const struct quantity rectangle[] = {
        {"section.width", body->width, &limit_length},
        {"section.height", body->height, &limit_length},
    };
    if (round && (body->width != 0.0 || body->height != 0.0))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "section: %.9g x %.9g: must be absent beside radius (%.9g m)", body->width,
                         body->height, body->radius);
    if (body->theory > THEORY_EULER_BERNOULLI)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "theory: %u: must be timoshenko or euler-bernoulli (0, 1)",
                         (unsigned)body->theory);
    if (body->shear_rule > SHEAR_NUMBER)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "shear_factor: %u: must be cowper, hutchinson or a number (0, 1, 2)",
                         (unsigned)body->shear_rule);
    enum percuss_status status =
        round ? check_quantities(circle, 1, fault) : check_quantities(rectangle, 2, fault);
    return status ? status : check_flexible(body, fault);
}

static enum percuss_status check_compact(const struct body *body, struct fault *fault)
{
    const struct quantity cylinder[] = {
        {"radius", body->radius, &limit_length},
        {"length", body->length, &limit_length},
    };
    const struct quantity block[] = {
        {"size[0]", body->size[0], &limit_length},
        {"size[1]", body->size[1], &limit_length},
        {"size[2]", body->size[2], &limit_length},
    };
    switch (body->shape) {
    case SHAPE_SPHERE:
        return check_quantities(cylinder, 1, fault);
    case SHAPE_CYLINDER:
        return check_quantities(cylinder, 2, fault);
    case SHAPE_BLOCK:
        return check_quantities(block, 3, fault);
    default: /* a half-space has no dimensions */
        return PERCUSS_OK;
    }
}

enum percuss_status body_check(const struct body *body, struct fault *fault)
{
    if (body->shape > SHAPE_HALF_SPACE)
        return fault_set(
            fault, PERCUSS_BAD_REQUEST,
            "shape: %u: must be sphere, rod, beam, cylinder, block or half-space (0 to 5)",
            (unsigned)body->shape);
    enum percuss_status status = check_material(body, fault);
    if (!status)
        status = check_ends(body, fault);
    if (status)
        return status;
    if (body->shape == SHAPE_ROD)
        return check_rod(body, fault);
    if (body->shape == SHAPE_BEAM)
        return check_beam(body, fault);
    return check_compact(body, fault);
}
