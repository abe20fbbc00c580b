/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/kernel.h"

#include "base/vector_clones.h"

typedef double lanes __attribute__((vector_size(LANES * sizeof(double))));

#define AT(array, k) (*(const lanes *)((array) + (k)))
#define TOTAL(x)     (((x)[0] + (x)[1]) + ((x)[2] + (x)[3]))

VECTOR_CLONES void kernel_nodes(const struct step_table *table, size_t length, const double *phi,
                                const double *q, const double *v, double sums[NODES])
{
    lanes s0 = {0}, s1 = {0}, s2 = {0}, s3 = {0};
    for (size_t k = 0; k < length; k += LANES) {
        lanes pq = AT(phi, k) * AT(q, k);
        lanes pv = AT(phi, k) * AT(v, k);
        s0 += AT(table->node_q[0], k) * pq + AT(table->node_v[0], k) * pv;
        s1 += AT(table->node_q[1], k) * pq + AT(table->node_v[1], k) * pv;
        s2 += AT(table->node_q[2], k) * pq + AT(table->node_v[2], k) * pv;
        s3 += AT(table->node_q[3], k) * pq + AT(table->node_v[3], k) * pv;
    }
    sums[0] += TOTAL(s0);
    sums[1] += TOTAL(s1);
    sums[2] += TOTAL(s2);
    sums[3] += TOTAL(s3);
}

VECTOR_CLONES void kernel_advance(const struct step_table *table, size_t length, const double *q,
                                  const double *v, double *q_end, double *v_end)
{
    for (size_t k = 0; k < length; k += LANES) {
        lanes qk = AT(q, k);
        lanes vk = AT(v, k);
        *(lanes *)(q_end + k) = AT(table->end_qq, k) * qk + AT(table->end_qv, k) * vk;
        *(lanes *)(v_end + k) = AT(table->end_vq, k) * qk + AT(table->end_vv, k) * vk;
    }
}

VECTOR_CLONES void kernel_push(const struct step_table *table, size_t length, const double *phi,
                               const double force[NODES], double *q_end, double *v_end)
{
    for (size_t k = 0; k < length; k += LANES) {
        lanes p = AT(phi, k);
        lanes to_q = AT(table->force_q[0], k) * force[0] + AT(table->force_q[1], k) * force[1] +
                     AT(table->force_q[2], k) * force[2] + AT(table->force_q[3], k) * force[3];
        lanes to_v = AT(table->force_v[0], k) * force[0] + AT(table->force_v[1], k) * force[1] +
                     AT(table->force_v[2], k) * force[2] + AT(table->force_v[3], k) * force[3];
        *(lanes *)(q_end + k) += p * to_q;
        *(lanes *)(v_end + k) += p * to_v;
    }
}

VECTOR_CLONES void kernel_dot2(size_t length, const double *a, const double *x, const double *y,
                               double *ax, double *ay)
{
    lanes sx = {0}, sy = {0};
    for (size_t k = 0; k < length; k += LANES) {
        sx += AT(a, k) * AT(x, k);
        sy += AT(a, k) * AT(y, k);
    }
    *ax = TOTAL(sx);
    *ay = TOTAL(sy);
}

VECTOR_CLONES void kernel_derivatives(size_t length, const double *omega, const double *damping,
                                      const double *phi, const double *q, const double *v,
                                      double sums[DERIVATIVES])
{
    lanes total[DERIVATIVES] = {{0}};
    for (size_t k = 0; k < length; k += LANES) {
        lanes w = AT(omega, k);
        /* n-th derivative of its equation: q^(n+2) = -2 zeta omega q^(n+1) - omega^2 q^(n) */
        lanes brake = -2.0 * AT(damping, k) * w;
        lanes spring = -(w * w);
        lanes now = AT(phi, k) * AT(q, k);
        lanes next = AT(phi, k) * AT(v, k);
        for (int n = 0; n < DERIVATIVES; n++) {
            total[n] += now;
            lanes after = brake * next + spring * now;
            now = next;
            next = after;
        }
    }
    for (int n = 0; n < DERIVATIVES; n++)
        sums[n] += TOTAL(total[n]);
}

VECTOR_CLONES void kernel_response(const struct step_table *table, size_t length,
                                   const double *phi_a, const double *phi_b,
                                   double sums[NODES][NODES])
{
    for (int i = 0; i < NODES; i++) {
        lanes s0 = {0}, s1 = {0}, s2 = {0}, s3 = {0};
        for (size_t k = 0; k < length; k += LANES) {
            lanes p = AT(phi_a, k) * AT(phi_b, k);
            s0 += p * AT(table->response[i][0], k);
            s1 += p * AT(table->response[i][1], k);
            s2 += p * AT(table->response[i][2], k);
            s3 += p * AT(table->response[i][3], k);
        }
        sums[i][0] += TOTAL(s0);
        sums[i][1] += TOTAL(s1);
        sums[i][2] += TOTAL(s2);
        sums[i][3] += TOTAL(s3);
    }
}

VECTOR_CLONES double kernel_loss(const struct step_table *table, size_t length,
                                 const double *const state[2], const struct kernel_load *loads,
                                 size_t count)
{
    lanes sum = {0};
    for (size_t k = 0; k < length; k += LANES) {
        lanes x[NODES + 2] = {AT(state[0], k), AT(state[1], k)};
        for (size_t b = 0; b < count; b++)
            for (int j = 0; j < NODES; j++)
                x[j + 2] += AT(loads[b].phi, k) * loads[b].force[j];
        for (int r = 0, term = 0; r < NODES + 2; r++) {
            lanes row = {0};
            for (int s = 0; s < r; s++, term++)
                row += AT(table->loss[term], k) * x[s];
            sum += (2.0 * row + AT(table->loss[term++], k) * x[r]) * x[r];
        }
    }
    return TOTAL(sum);
}
