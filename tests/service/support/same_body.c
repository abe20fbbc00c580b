/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* same_body ONE.h5 OTHER.h5 FREQUENCY FLEXIBILITY: whether two files hold the same body,
 * frequencies within the one part and flexibilities within the other of the largest. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "mesh/body_file.h"

struct difference {
    double frequency, flexibility;
};

/* How far apart two numbers of 32 bits are, beyond the place where each was rounded; NAN like NAN.
 */
static double beyond_rounding(float one, float other)
{
    if (isnan(one) != isnan(other))
        return INFINITY;
    return isnan(one) ? 0.0
                      : fmax(0.0, fabs((double)one - (double)other) - FLT_EPSILON * fabs(one));
}

static void compare_face(const struct mesh_body_face *one, const struct mesh_body_face *other,
                         double *largest, double *apart)
{
    for (int i = 0; i < one->count; i++) {
        double value = one->flexibility[i], change = fabs(value - other->flexibility[i]);
        if (isnan(value) != isnan(other->flexibility[i]))
            *apart = INFINITY;
        if (isnan(value))
            continue;
        *largest = fmax(*largest, fabs(value));
        *apart = fmax(*apart, change);
        for (int k = 0; k < 6; k++)
            *apart = fmax(*apart, beyond_rounding(one->tensor[i][k], other->tensor[i][k]));
    }
}

static struct difference compare(const struct mesh_body *one, const struct mesh_body *other)
{
    struct difference difference = {0.0, 0.0};
    double largest = 0.0;
    if (one->mode_count != other->mode_count || one->face_count != other->face_count)
        return (struct difference){INFINITY, INFINITY};
    for (size_t i = 0; i < one->mode_count; i++)
        difference.frequency =
            fmax(difference.frequency, fabs(other->omega[i] / one->omega[i] - 1.0));
    for (size_t f = 0; f < one->face_count; f++)
        compare_face(&one->faces[f], &other->faces[f], &largest, &difference.flexibility);
    /* without any number nothing is compared */
    difference.flexibility = largest > 0.0 ? difference.flexibility / largest : INFINITY;
    return difference;
}

int main(int argc, char **argv)
{
    struct mesh_body *bodies[2] = {NULL, NULL};
    struct fault fault = {""};
    if (argc != 5)
        return 2;
    for (int i = 0; i < 2; i++)
        if (body_file_read(argv[1 + i], &bodies[i], &fault)) {
            fprintf(stderr, "same_body: %s\n", fault.text);
            mesh_body_free(bodies[0]);
            return 2;
        }
    struct difference difference = compare(bodies[0], bodies[1]);
    printf("frequencies %.1e flexibilities %.1e\n", difference.frequency, difference.flexibility);
    mesh_body_free(bodies[0]);
    mesh_body_free(bodies[1]);
    return difference.frequency <= atof(argv[3]) && difference.flexibility <= atof(argv[4]) ? 0 : 1;
}
