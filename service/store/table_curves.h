/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A computed table made ready for the contact law. */
#ifndef PERCUSS_STORE_TABLE_CURVES_H
#define PERCUSS_STORE_TABLE_CURVES_H

#include "contact/family.h"
#include "fe/indentation.h"

/* Beyond the table's last indentation its curves go on in proportion to those of the family, if
 * there is one (NULL: none). OK; BAD_REQUEST: the table's curves do not rise as they must;
 * INTERNAL: out of memory. *curves is NULL then; otherwise free it with contact_curves_free. */
enum percuss_status table_curves_make(const struct indentation_table *table,
                                      const struct contact_family *family,
                                      struct contact_curves **curves, struct fault *fault);

#endif
