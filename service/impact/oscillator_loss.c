/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/oscillator_loss.h"

#include <math.h>
#include <string.h>

#include "impact/oscillator.h"

/* omega h below which the loss is found by quadrature. */
static const double SLOW_ANGLE = 2.0;

/* Velocity on the step for one unit input: Re(wave e^(z s)) + sum_m slope[m] s^m, s = t/h. */
struct velocity {
    double complex wave;
    double slope[NODES];
};

/* Slow or moderate: Gauss quadrature of v^2 on panels that resolve it (order 8 each). */
static void form_by_quadrature(double omega, double damping, double h,
                               double form[LOSS_INPUTS][LOSS_INPUTS])
{
    enum { PANELS = 16 };
    for (int p = 0; p < PANELS; p++) {
        for (int g = 0; g < NODES; g++) {
            double to_q[LOSS_INPUTS];
            double to_v[LOSS_INPUTS];
            oscillator_map(omega, damping, h, (p + collocation.node[g]) / PANELS, to_q, to_v);
            double weight = 2.0 * damping * omega * h * collocation.weight[g] / PANELS;
            for (int r = 0; r < LOSS_INPUTS; r++)
                for (int s = 0; s <= r; s++)
                    form[r][s] += weight * to_v[r] * to_v[s];
        }
    }
}

/* Splits the response to input r into the wave and the particular solution, a cubic in s whose
 * coefficients the equation gives from the highest down: with s = t/h
 *
 *   omega^2 q_m = f_m - (2 zeta omega/h) (m + 1) q_(m+1) - (1/h^2) (m + 2) (m + 1) q_(m+2)
 *
 * The wave has what then lacks of the initial values. */
static struct velocity split(double omega, double damping, double h, int r)
{
    double q[NODES + 2] = {0};
    double coupling = 2.0 * damping * omega / h;
    double inertia = 1.0 / (h * h);
    /* the cubic, from its highest power down */
    if (r >= 2) {
        for (int m = NODES - 1; m >= 0; m--)
            q[m] = (collocation.monomial[r - 2][m] - coupling * (m + 1) * q[m + 1] -
                    inertia * (m + 2) * (m + 1) * q[m + 2]) /
                   (omega * omega);
    }
    /* the wave A e^(lambda t): Re A is its velocity v0, Re(lambda A) its acceleration */
    double q0 = (r == 0) - q[0];
    double v0 = (r == 1) - q[1] / h;
    double complex lambda = oscillator_lambda(omega, damping);
    double rate = -2.0 * damping * omega * v0 - omega * omega * q0;
    struct velocity velocity = {.wave = CMPLX(v0, (creal(lambda) * v0 - rate) / cimag(lambda))};
    /* and the cubic's velocity */
    for (int m = 0; m + 1 < NODES; m++)
        velocity.slope[m] = (m + 1) * q[m + 1] / h;
    return velocity;
}

/* int_0^1 v_a v_b ds of two such velocities: 2 Re(A e^(zs)) Re(B e^(zs)) = Re(A B e^(2zs)) +
 * Re(A conj(B)) e^(2 Re(z) s); `swinging`, `steady` and `moment` are the integrals of e^(2zs),
 * e^(2 Re(z) s) and s^m e^(zs). */
static double product_integral(const struct velocity *a, const struct velocity *b,
                               double complex swinging, double steady,
                               const double complex moment[NODES])
{
    double sum =
        0.5 * creal(a->wave * b->wave * swinging) + 0.5 * creal(a->wave * conj(b->wave)) * steady;
    for (int m = 0; m < NODES; m++) {
        sum += creal(a->wave * moment[m]) * b->slope[m] + creal(b->wave * moment[m]) * a->slope[m];
        for (int n = 0; n < NODES; n++)
            sum += a->slope[m] * b->slope[n] / (m + n + 1);
    }
    return sum;
}

/* Fast: waves and polynomial integrated in closed form. */
static void form_closed(double omega, double damping, double h,
                        double form[LOSS_INPUTS][LOSS_INPUTS])
{
    double complex z = oscillator_lambda(omega, damping) * h;
    double complex swinging = (cexp(2.0 * z) - 1.0) / (2.0 * z);
    double steady = expm1(2.0 * creal(z)) / (2.0 * creal(z));
    double complex moment[NODES]; /* int_0^1 s^m e^(z s) ds */
    moment[0] = (cexp(z) - 1.0) / z;
    for (int m = 1; m < NODES; m++)
        moment[m] = (cexp(z) - m * moment[m - 1]) / z;
    struct velocity velocity[LOSS_INPUTS];
    for (int r = 0; r < LOSS_INPUTS; r++)
        velocity[r] = split(omega, damping, h, r);
    for (int r = 0; r < LOSS_INPUTS; r++)
        for (int s = 0; s <= r; s++)
            form[r][s] = 2.0 * damping * omega * h *
                         product_integral(&velocity[r], &velocity[s], swinging, steady, moment);
}

void oscillator_loss_form(double omega, double damping, double h,
                          double form[LOSS_INPUTS][LOSS_INPUTS])
{
    memset(form, 0, sizeof(double[LOSS_INPUTS][LOSS_INPUTS]));
    /* the particular solution cancels against the wave like (omega h)^-4 for slow oscillators */
    if (omega * h < SLOW_ANGLE)
        form_by_quadrature(omega, damping, h, form);
    else
        form_closed(omega, damping, h, form);
    for (int r = 0; r < LOSS_INPUTS; r++)
        for (int s = r + 1; s < LOSS_INPUTS; s++)
            form[r][s] = form[s][r];
}
