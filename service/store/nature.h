/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_STORE_NATURE_H
#define PERCUSS_STORE_NATURE_H

#include "model/body.h"

enum { NATURE_SIZE = 768 };

/* What a body's dents depend on, in words and 17 digits: shape, sizes, elastic and plastic numbers
 * of the material. Not how it vibrates or what it is called. */
void nature_describe(const struct body *body, char nature[NATURE_SIZE]);

#endif
