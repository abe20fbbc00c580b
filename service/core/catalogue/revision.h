/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The revision of a catalogue: a hash of what can change an answer. */
#ifndef PERCUSS_CATALOGUE_REVISION_H
#define PERCUSS_CATALOGUE_REVISION_H

#include "base/fault.h"
#include "model/body.h"

/* Writes set->revision: 32 hexadecimal digits, a hash of the bodies (ids, shapes, all numbers'
 * bits, materials in use), of the contact's settings and of the friction, independent of the order
 * of bodies and pairs and the layout of the file. PERCUSS_OK or PERCUSS_INTERNAL without memory. */
enum percuss_status revision_write(struct body_set *set, struct fault *fault);

#endif
