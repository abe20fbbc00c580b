/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/nature.h"

#include <stdio.h>

void nature_describe(const struct body *body, char nature[NATURE_SIZE])
{
    const struct material *material = &body->material;
    snprintf(nature, NATURE_SIZE,
             "%s radius %.17g length %.17g width %.17g height %.17g tip_radius %.17g size %.17g "
             "%.17g %.17g young %.17g poisson %.17g density %.17g yield %.17g tangent %.17g",
             body->kind->name, body->radius, body->length, body->width, body->height,
             body->tip_radius, body->size[0], body->size[1], body->size[2], material->young,
             material->poisson, material->density, material->yield, material->tangent);
}
