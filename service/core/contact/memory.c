/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/memory.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"

void contact_memory_begin(struct contact_memory *memory, const struct relaxation *relaxation)
{
    memset(memory, 0, sizeof *memory);
    memory->relaxation = relaxation;
}

/* M = 3/4 int m(y) y^(-1/2) dy = 3/2 sqrt(y_m) (center + slope y_m/3 + bend y_m^2/5), and with the
 * form above center sqrt(y_m) (1 - t/5). */

void contact_memory_shrink(struct contact_memory *memory, double indentation)
{
    double root = sqrt(indentation);
    memory->shrinks = true;
    memory->width = indentation;
    for (size_t i = 0; i < memory->relaxation->count; i++) {
        double center = memory->center[i];
        double curved = 5.0 * (center - memory->total[i] / root); /* center t */
        memory->slope[i] = -(center + curved) / indentation;
        memory->bend[i] = curved / (indentation * indentation);
    }
}

void contact_memory_grow(struct contact_memory *memory)
{
    double width = memory->width;
    memory->shrinks = false;
    for (size_t i = 0; i < memory->relaxation->count; i++)
        memory->total[i] =
            1.5 * sqrt(width) *
            (memory->center[i] + width * (memory->slope[i] / 3.0 + width * memory->bend[i] / 5.0));
}

double contact_memory_growing(double k, double indentation, double remembered, double *stiffness)
{
    double left = indentation > 0.0 ? indentation * sqrt(indentation) - remembered : 0.0;
    *stiffness = left > 0.0 ? k : 0.0;
    return left > 0.0 ? k * left : 0.0;
}

/* The first root of f(y), at most the width: the edge. */
static double edge_of(const double f[3], double width)
{
    double square = f[1] * f[1] - 4.0 * f[0] * f[2];
    double falls = square >= 0.0 ? sqrt(square) - f[1] : 0.0;
    return falls > 0.0 ? smaller(2.0 * f[0] / falls, width) : width;
}

double contact_memory_shrinking(double k, double indentation, const double pressed[3], double width,
                                double *stiffness)
{
    *stiffness = 0.0;
    if (!(pressed[0] > 0.0))
        return 0.0;
    double edge = edge_of(pressed, width), root = sqrt(edge);
    double force = 1.5 * root * (pressed[0] + edge * (pressed[1] / 3.0 + edge * pressed[2] / 5.0));
    *stiffness = 1.5 * k * root;
    if (indentation > width) {
        double beyond = sqrt(indentation), within = sqrt(width);
        force += indentation * beyond - 1.5 * indentation * within + 0.5 * width * within;
        *stiffness += 1.5 * k * (beyond - within);
    }
    return k * larger(force, 0.0);
}
