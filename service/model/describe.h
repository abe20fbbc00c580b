/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A body described for people and for programs that place it. */
#ifndef PERCUSS_MODEL_DESCRIBE_H
#define PERCUSS_MODEL_DESCRIBE_H

struct body_description {
    double half_extents[3]; /* along x, y, z, m; 0: without bounds */
    double tip_radius; /* rod, beam with caps: of its ends, INFINITY where a rod's are flat; others:
                          0 */
    char text[256];
};

/* One more thing to say, after a comma; what does not fit is cut. */
void describe_add(struct body_description *description, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

void describe_extents(struct body_description *description, double x, double y, double z);

#endif
