/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Finds how a file of columns is laid out. */
#ifndef PERCUSS_MEASURED_SURVEY_H
#define PERCUSS_MEASURED_SURVEY_H

#include "layout.h"

/* The headings stand in the line that names most columns; a comment, a line that blanks divide and
 * a single word count only where what is below them fits. Without such a line columns are
 * chosen by their numbers. A line of units may follow. False with all that is wrong. Release with
 * layout_free. */
bool survey_layout(const struct table_source *source, const struct text_lines *lines,
                   struct layout *layout, struct measured_remarks *remarks);

#endif
