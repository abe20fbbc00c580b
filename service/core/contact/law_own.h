/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Laws that a catalogue states (model/own_law.h). */
#ifndef PERCUSS_CONTACT_LAW_OWN_H
#define PERCUSS_CONTACT_LAW_OWN_H

#include "contact/law_table.h"
#include "model/own_law.h"

/* Curves of its points for contact_law_own, for contact_curves_free; NULL: it has none. From other
 * largest indentations than the measured one a contact unloads by the same curve, with indentation
 * and force in the same proportion. PERCUSS_OK, BAD_REQUEST or INTERNAL. */
enum percuss_status own_curves_create(const struct own_law *own, struct contact_curves **curves,
                                      struct fault *fault);

/* The law; `curves` are those of its points, and must outlive it. */
struct contact_law contact_law_own(const struct own_law *own, const struct contact_curves *curves);

#endif
