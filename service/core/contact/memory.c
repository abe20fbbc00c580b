/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/memory.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"

void contact_memory_begin(struct contact_memory *memory, const struct relaxation *relaxation,
                          const struct recovery_modes *modes)
{
    memset(memory, 0, sizeof *memory);
    memory->relaxation = relaxation;
    memory->modes = modes;
}

/* The terms of what was left beside those since the touch. */
static void add_left(struct contact_memory *memory, double width)
{
    double center[RELAXATION_MOST], total[RELAXATION_MOST], since[2][RELAXATION_MOST];
    double reach = larger(memory->left.reach, width);
    recovery_modes_join(memory->modes, memory->left.center, center);
    recovery_modes_join(memory->modes, memory->left.total, total);
    memcpy(since[0], memory->center, sizeof since[0]);
    memcpy(since[1], memory->total, sizeof since[1]);
    for (size_t i = 0; i < memory->relaxation->count; i++) {
        double before[3], after[3];
        recovery_parabola(center[i], total[i], reach, before);
        recovery_parabola(since[0][i], since[1][i], width, after);
        memory->center[i] = before[0] + after[0];
        memory->slope[i] = before[1] + after[1];
        memory->bend[i] = before[2] + after[2];
        memory->total[i] = total[i] + since[1][i];
    }
    memory->width = reach;
}

void contact_memory_shrink(struct contact_memory *memory, double width)
{
    if (memory->left.reach > 0.0) {
        add_left(memory, width);
    } else {
        memory->width = width;
        for (size_t i = 0; i < memory->relaxation->count; i++) {
            double shape[3];
            recovery_parabola(memory->center[i], memory->total[i], width, shape);
            memory->slope[i] = shape[1];
            memory->bend[i] = shape[2];
        }
    }
    memory->shrinks = true;
    memory->left.reach = memory->width;
    recovery_modes_split(memory->modes, memory->total, memory->left.total);
}

void contact_memory_renew(struct contact_memory *memory)
{
    recovery_modes_split(memory->modes, memory->center, memory->left.center);
    memory->shrinks = false;
    memset(memory->center, 0, sizeof memory->center);
    memset(memory->total, 0, sizeof memory->total);
    memset(memory->slope, 0, sizeof memory->slope);
    memset(memory->bend, 0, sizeof memory->bend);
}

double contact_memory_growing(double k, double raised, double remembered, double *stiffness)
{
    double left = raised > 0.0 ? raised - remembered : 0.0;
    *stiffness = left > 0.0 ? k : 0.0;
    return left > 0.0 ? k * left : 0.0;
}

/* The first root of f(y), at most the width: the edge. A parabola that is below 0 in the middle
 * presses nowhere, also where it rises. */
static double edge_of(const double f[3], double width)
{
    double square = f[1] * f[1] - 4.0 * f[0] * f[2];
    double falls = square >= 0.0 ? sqrt(square) - f[1] : 0.0;
    if (falls > 0.0)
        return smaller(2.0 * f[0] / falls, width);
    return f[0] > 0.0 ? width : f[0];
}

double contact_memory_edge(double indentation, const double pressed[3], double width)
{
    return indentation > width ? indentation : edge_of(pressed, width);
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
