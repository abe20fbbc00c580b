/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/material.h"

#include <math.h>
#include <stddef.h>

#include "model/limits.h"

enum percuss_status material_check(const struct material *material, struct fault *fault)
{
    /* each by its limit; an elastic one never yields */
    bool elastic = material->yield == INFINITY;
    const struct {
        const char *field;
        double value;
        const struct limit *limit;
    } quantities[] = {
        {"young", material->young, &limit_young},
        {"poisson", material->poisson, &limit_poisson},
        {"density", material->density, &limit_density},
        {"tangent", material->tangent, &limit_tangent},
        {"yield", elastic ? limit_yield.high : material->yield, &limit_yield},
    };
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; !status && i < sizeof quantities / sizeof *quantities; i++)
        status = limit_check(quantities[i].limit, quantities[i].field, quantities[i].value, fault);
    if (status)
        return status;
    /* together: yield and hardening stay below young, and none hardens that does not yield */
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
