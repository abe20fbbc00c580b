/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Remarks on files of measurements: all faults, and how the files were understood. */
#ifndef PERCUSS_MEASURED_REMARKS_H
#define PERCUSS_MEASURED_REMARKS_H

#include <stdbool.h>
#include <stddef.h>

/* Text of one line. */
struct measured_fault {
    char text[512];
};

/* Writes a message; returns false. */
bool measured_fail(struct measured_fault *fault, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

enum { REMARKS_KEPT = 20 };

/* Counts go on where the texts end. */
struct measured_remarks {
    size_t errors, notes;
    struct measured_fault error[REMARKS_KEPT], note[REMARKS_KEPT];
};

/* One more error; returns false. */
bool remarks_wrong(struct measured_remarks *remarks, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* One more note. */
void remarks_note(struct measured_remarks *remarks, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
