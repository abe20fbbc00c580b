/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/rigid_modes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/vector.h"
#include "numeric/dense.h"
#include "numeric/linear.h"

double rigid_modes_scale(const struct solid_mesh *mesh, const struct bulk *bulk)
{
    /* squares of the radii of gyration along the principal axes, from the inertia */
    double inertia[9], principal[3], speed = 0.0;
    memcpy(inertia, bulk->inertia, sizeof inertia);
    linear_symmetric_eigen(3, inertia, principal);
    double thin = 0.5 * (principal[0] + principal[1] - principal[2]) / bulk->mass;
    double longest = 0.5 * (principal[1] + principal[2] - principal[0]) / bulk->mass;
    for (size_t i = 0; i < mesh->part_count; i++)
        speed = fmax(speed, mesh->part[i].material.young / mesh->part[i].material.density);
    /* a slender beam's w = 22.4 sqrt(E/rho) k/L^2 with its radius of gyration k; L^2 = 12 of its
     * greatest radius of gyration squared. Thinner than a thousandth is taken for that */
    thin = fmax(thin, 1e-6 * longest);
    return 22.4 * 22.4 * speed * thin / (144.0 * longest * longest);
}

/* Six candidates: shifts along the axes, turns about the nodes' middle; nothing moves what is held.
 */
static void fill(const struct solid_mesh *mesh, const bool *held, double *vectors)
{
    size_t n = 3 * mesh->node_count;
    double middle[3] = {0.0};
    for (size_t i = 0; i < mesh->node_count; i++)
        add_scaled3(1.0 / (double)mesh->node_count, mesh->points[i], middle);
    for (size_t i = 0; i < mesh->node_count; i++) {
        double arm[3];
        sub3(mesh->points[i], middle, arm);
        for (size_t m = 0; m < 3; m++) {
            double axis[3] = {m == 0, m == 1, m == 2};
            memcpy(vectors + m * n + 3 * i, axis, sizeof axis);
            cross3(axis, arm, vectors + (3 + m) * n + 3 * i);
        }
    }
    for (size_t i = 0; held && i < RIGID_MOST * n; i++)
        if (held[i % n])
            vectors[i] = 0.0;
}

/* Turns `count` vectors into those combinations of them that make the symmetric matrix
 * x^T `matrix` x diagonal; returns the diagonal, ascending. `spare` is as large as the vectors. */
static bool diagonalise(const struct sparse *matrix, size_t count, double *vectors, double *spare,
                        double *diagonal)
{
    size_t n = matrix->n;
    double products[RIGID_MOST * RIGID_MOST];
    sparse_multiply(matrix, count, vectors, spare);
    dense_products((struct dense){n, count, vectors}, (struct dense){n, count, spare}, products);
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++)
            products[i * count + j] = products[j * count + i];
    if (!linear_symmetric_eigen(count, products, diagonal))
        return false;
    memcpy(spare, vectors, count * n * sizeof *spare);
    dense_combine((struct dense){n, count, spare}, 1.0, products, 0.0, count, vectors);
    return true;
}

/* Makes what is left M-orthonormal, of the largest first; returns how many have mass. */
static size_t normalise(const struct sparse *mass, double *vectors, double *spare)
{
    double diagonal[RIGID_MOST];
    size_t n = mass->n, kept = 0;
    /* turns are as heavy as shifts once each has its own mass taken out */
    for (size_t m = 0; m < RIGID_MOST; m++) {
        double own = sparse_product(mass, vectors + m * n, vectors + m * n);
        for (size_t i = 0; i < n && own > 0.0; i++)
            vectors[m * n + i] /= sqrt(own);
    }
    if (!diagonalise(mass, RIGID_MOST, vectors, spare, diagonal))
        return 0;
    for (size_t m = 0; m < RIGID_MOST; m++) {
        if (!(diagonal[m] > 1e-12))
            continue;
        for (size_t i = 0; i < n; i++)
            vectors[kept * n + i] = vectors[m * n + i] / sqrt(diagonal[m]);
        kept++;
    }
    return kept;
}

enum percuss_status rigid_modes_make(const struct solid_mesh *mesh, const struct matrices *matrices,
                                     double scale, size_t *count, double **vectors,
                                     struct fault *fault)
{
    size_t n = 3 * mesh->node_count;
    double resisted[RIGID_MOST] = {0.0}, *spare = calloc(RIGID_MOST * n, sizeof *spare);
    *vectors = calloc(RIGID_MOST * n, sizeof **vectors);
    *count = 0;
    if (*vectors && spare) {
        fill(mesh, matrices->held, *vectors);
        size_t kept = normalise(&matrices->mass, *vectors, spare);
        /* rounding leaves some 1e-9 of the first mode's, a support that holds far more than all */
        if (kept && diagonalise(&matrices->stiffness, kept, *vectors, spare, resisted))
            while (*count < kept && resisted[*count] < 1e-4 * scale)
                (*count)++;
    }
    bool fine = *vectors && spare;
    free(spare);
    if (fine)
        return PERCUSS_OK;
    free(*vectors);
    *vectors = NULL;
    return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
}
