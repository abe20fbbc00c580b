/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/oscillator.h"

#include <math.h>

double complex oscillator_lambda(double omega, double damping)
{
    return omega * CMPLX(-damping, sqrt((1.0 - damping) * (1.0 + damping)));
}

/* Damping run backward grows without bound: this keeps squares of it finite. */
static const double LARGEST_EXPONENT = 300.0;

/* |z c| from which on moments are found upward, see oscillator_moments. */
static const double LARGE = 3.0;

/* Terms of the series of small_moments to the last bit, by |z c|^2: |z c|^k 4!/(4 + k)! < 1e-17. */
static const struct {
    double below;
    int terms;
} SERIES[] = {{2.5e-5, 6}, {2.5e-3, 8}, {6.25e-2, 11}, {0.5625, 15}, {2.25, 19}, {INFINITY, 25}};

/* Products without the standard's care for infinite factors, of which there are none here. */
static inline double complex times(double complex a, double complex b)
{
    return CMPLX(creal(a) * creal(b) - cimag(a) * cimag(b),
                 creal(a) * cimag(b) + cimag(a) * creal(b));
}

static inline double square(double complex x)
{
    return creal(x) * creal(x) + cimag(x) * cimag(x);
}

/* Free motion: q(t) = Re(A e^(lambda t)) with A from q(0), v(0); in real numbers, with
 * lambda = -r + i w (r, w: `-decay`, `frequency`),
 *
 *   q(t) = e^(-r t) ((cos wt + (r/w) sin wt) q(0) + (1/w) sin wt v(0))
 *   v(t) = e^(-r t) (-((r^2 + w^2)/w) sin wt q(0) + (cos wt - (r/w) sin wt) v(0)) */
static void free_map(double complex lambda, double time, double to_q[2], double to_v[2])
{
    double decay = creal(lambda);
    double frequency = cimag(lambda);
    double scale = exp(fmin(decay * time, LARGEST_EXPONENT));
    double sine = scale * sin(frequency * time) / frequency;
    double cosine = scale * cos(frequency * time);
    to_q[0] = cosine - decay * sine;
    to_q[1] = sine;
    to_v[0] = -(decay * decay + frequency * frequency) * sine;
    to_v[1] = cosine + decay * sine;
}

void oscillator_advance(double omega, double damping, double time, double *q, double *v)
{
    double to_q[2];
    double to_v[2];
    free_map(oscillator_lambda(omega, damping), time, to_q, to_v);
    double moved = to_q[0] * *q + to_q[1] * *v;
    *v = to_v[0] * *q + to_v[1] * *v;
    *q = moved;
}

/* The damper takes 2 zeta omega int v^2 dt; with v = Re(V e^(lambda t)),
 * 2 v^2 = |V|^2 e^(2 Re(lambda) t) + Re(V^2 e^(2 lambda t)). */
double oscillator_free_loss(double omega, double damping, double time, double q, double v)
{
    if (damping == 0.0 || time == 0.0)
        return 0.0;
    /* V from v(0) and v'(0) = -2 zeta omega v - omega^2 q */
    double complex lambda = oscillator_lambda(omega, damping);
    double rate = -2.0 * damping * omega * v - omega * omega * q;
    double complex amplitude = CMPLX(v, (creal(lambda) * v - rate) / cimag(lambda));
    double twice = 2.0 * creal(lambda);
    double steady = expm1(twice * time) / twice;
    double complex swinging = (cexp(2.0 * lambda * time) - 1.0) / (2.0 * lambda);
    double square =
        creal(amplitude * conj(amplitude)) * steady + creal(amplitude * amplitude * swinging);
    return damping * omega * square;
}

/* For |z c| < LARGE. int exp(z(c-s)) s^m ds = c^(m+1) m! sum_k x^k / (m+1+k)!, without cancellation
 * for small x = z c, gives the highest moment; by parts, downward, the others, each with an error
 * of at most about |x|/m that of the one before. */
static void small_moments(double complex z, double c, double complex moments[NODES])
{
    /* the series by Horner's rule */
    double complex x = z * c;
    double complex sum = 1.0;
    int row = 0;
    while (!(square(x) < SERIES[row].below))
        row++;
    for (int k = SERIES[row].terms; k > 0; k--) {
        double share = 1.0 / (NODES + k);
        sum = 1.0 + times(CMPLX(creal(x) * share, cimag(x) * share), sum);
    }
    /* powers of c, and downward */
    double power[NODES + 1] = {1.0};
    for (int m = 1; m <= NODES; m++)
        power[m] = power[m - 1] * c;
    moments[NODES - 1] = power[NODES] / NODES * sum;
    for (int m = NODES - 1; m > 0; m--)
        moments[m - 1] = (times(z, moments[m]) + power[m]) * (1.0 / m);
}

/* For |z c| >= LARGE, with wave = exp(z c): by parts, upward, each step divides by |z c|. */
static void large_moments(double complex z, double c, double complex wave,
                          double complex moments[NODES])
{
    double part = 1.0 / square(z);
    double complex inverse = CMPLX(creal(z) * part, -cimag(z) * part);
    double power = 1.0;
    moments[0] = times(wave - 1.0, inverse);
    for (int m = 1; m < NODES; m++) {
        power *= c;
        moments[m] = times(m * moments[m - 1] - power, inverse);
    }
}

void oscillator_moments(double complex z, double c, double complex moments[NODES])
{
    if (square(z * c) < LARGE * LARGE)
        small_moments(z, c, moments);
    else
        large_moments(z, c, cexp(z * c), moments);
}

/* Duhamel: q(T) = free + Im int_0^T e^(lambda (T - t)) f(t) dt / Im(lambda), v with lambda times
 * the kernel; f = sum_j f_j sum_m monomial[j][m] (t/h)^m, T = c h, so that the integrals are h
 * sum_m monomial[j][m] moments[m] with z = lambda h. */
void oscillator_map(double omega, double damping, double h, double c, double to_q[NODES + 2],
                    double to_v[NODES + 2])
{
    double complex lambda = oscillator_lambda(omega, damping);
    double complex z = lambda * h;
    double complex moments[NODES];
    /* the motion before, whose wave the moments of fast ones need too */
    free_map(lambda, c * h, to_q, to_v);
    if (square(z * c) < LARGE * LARGE)
        small_moments(z, c, moments);
    else
        large_moments(z, c, CMPLX(to_q[0] + creal(lambda) * to_q[1], cimag(lambda) * to_q[1]),
                      moments);
    /* and the forces at the nodes */
    double share = h / cimag(lambda);
    for (int j = 0; j < NODES; j++) {
        double real = 0.0;
        double imaginary = 0.0;
        for (int m = 0; m < NODES; m++) {
            real += collocation.monomial[j][m] * creal(moments[m]);
            imaginary += collocation.monomial[j][m] * cimag(moments[m]);
        }
        to_q[j + 2] = share * imaginary;
        to_v[j + 2] = share * (creal(lambda) * imaginary + cimag(lambda) * real);
    }
}
