/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/body_kind.h"

#define ADDRESS(kind) &kind##_kind,
static const struct body_kind *const kinds[] = {BODY_KINDS(ADDRESS) NULL};

const struct body_kind *body_kind_at(size_t number)
{
    return number < sizeof kinds / sizeof *kinds ? kinds[number] : NULL;
}

size_t body_kind_number(const struct body_kind *kind)
{
    size_t number = 0;
    while (kinds[number] && kinds[number] != kind)
        number++;
    return number;
}
