/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/node_linear.h"

#include "base/vector_clones.h"

/* Pivots are near 1 on short steps: below this, elimination in order loses digits. */
static const double LEAST_PIVOT = 0.1;

/* Four numbers of a row, wherever they lie. */
typedef double quad __attribute__((vector_size(NODES * sizeof(double)), aligned(8)));
#define QUAD(at)       (*(quad *)(at))
#define CONST_QUAD(at) (*(const quad *)(at))
_Static_assert((int)NODE_LINEAR_RIGHT == (int)NODES, "a row's right sides are one of them");

void node_linear_fill(struct node_linear *linear, const struct coupling *coupling, int level,
                      double (*const stiffness)[NODES])
{
    for (size_t p = 0; p < linear->count; p++)
        for (size_t q = 0; q < linear->count; q++) {
            size_t b = linear->contact[q];
            const struct coupling_block *block =
                coupling_between_two(coupling, level, linear->contact[p], b);
            struct node_linear_row *row = linear->row + p * NODES;
            for (size_t i = 0; i < NODES; i++) {
                double *at = row[i].matrix + q * NODES;
                QUAD(at) = block ? CONST_QUAD(block->by[i]) * CONST_QUAD(stiffness[b]) : (quad){0};
                at[i] += p == q ? 1.0 : 0.0;
            }
        }
}

/* Takes row k out of those below it. */
static inline void take_out(struct node_linear *linear, size_t k, size_t rows)
{
    const struct node_linear_row *top = &linear->row[k];
    double inverse = 1.0 / top->matrix[k];
    for (size_t i = k + 1; i < rows; i++) {
        struct node_linear_row *row = &linear->row[i];
        double factor = row->matrix[k] * inverse;
        for (size_t j = k / NODES * NODES; j < rows; j += NODES)
            QUAD(row->matrix + j) -= factor * CONST_QUAD(top->matrix + j);
        QUAD(row->right) -= factor * CONST_QUAD(top->right);
    }
}

VECTOR_CLONES bool node_linear_solve(struct node_linear *linear)
{
    size_t rows = linear->count * NODES;
    for (size_t k = 0; k < rows; k++) {
        if (!(linear->row[k].matrix[k] > LEAST_PIVOT))
            return false;
        take_out(linear, k, rows);
    }
    /* and back substitution */
    for (size_t i = rows; i-- > 0;) {
        struct node_linear_row *row = &linear->row[i];
        quad sum = CONST_QUAD(row->right);
        for (size_t j = i + 1; j < rows; j++)
            sum -= row->matrix[j] * CONST_QUAD(linear->row[j].right);
        QUAD(row->right) = sum / row->matrix[i];
    }
    return true;
}
