/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/step_ends.h"

#include <math.h>

/* ---- Polynomial through both ends and the four nodes of a step, degree five ---- */

/* The product of (s - node_j) at both ends of the step. */
static const double QUINTIC_PRODUCT = 1.0 / 70.0;

struct quintic {
    const double *nodes; /* [NODES] */
    double low, high;
};

/* Lagrange's polynomials of the nodes at s, and the product. */
struct quintic_basis {
    double s, product;
    double by[NODES];
};

static struct quintic quintic_through(double start, const double nodes[NODES], double end)
{
    double at_start = 0.0;
    double at_end = 0.0;
    for (int j = 0; j < NODES; j++) {
        at_start += nodes[j] * collocation.monomial[j][0];
        at_end += nodes[j] * collocation.end[0][j];
    }
    return (struct quintic){nodes, (start - at_start) / QUINTIC_PRODUCT,
                            (end - at_end) / QUINTIC_PRODUCT};
}

static struct quintic_basis quintic_basis_at(double s)
{
    struct quintic_basis basis = {.s = s, .product = 1.0};
    for (int j = 0; j < NODES; j++) {
        const double *c = collocation.monomial[j];
        basis.by[j] = ((c[3] * s + c[2]) * s + c[1]) * s + c[0];
        basis.product *= s - collocation.node[j];
    }
    return basis;
}

static double quintic_value(const struct quintic *quintic, const struct quintic_basis *basis)
{
    double sum = (quintic->low + (quintic->high - quintic->low) * basis->s) * basis->product;
    for (int j = 0; j < NODES; j++)
        sum += quintic->nodes[j] * basis->by[j];
    return sum;
}

/* ---- Projection of the forces ---- */

/* Gauss-Jacobi quadrature of x^(3/2) times polynomials up to the seventh degree on 0..1, the
 * weights over x^(3/2); all numbers to 20 digits from the moments. */
enum { POINTS = 4 };
static const double PLACE[POINTS] = {0.1728253493870498751, 0.45170067797074107415,
                                     0.74371463856681432048, 0.94754880775960525659};
static const double WEIGHT[POINTS] = {0.23787837491065878419, 0.30319276806623797758,
                                      0.26331982728830153484, 0.13224647234779446794};

/* The secant rule starts from the straight line between two nodes, which is within 1e-2 of the
 * step. After a change this small its error is rounding, or a billionth of the step. */
enum { ZERO_ROUNDS = 4 };
static const double SMALL_CHANGE = 1e-6;

/* The slope of the straight line between the nodes, or the ends of the step, around s. */
static double slope_around(const struct step_values *values, double s)
{
    int j = 0;
    while (j < NODES && collocation.node[j] < s)
        j++;
    double from = j > 0 ? collocation.node[j - 1] : 0.0;
    double to = j < NODES ? collocation.node[j] : 1.0;
    return ((j < NODES ? values->nodes[j] : values->end) -
            (j > 0 ? values->nodes[j - 1] : values->start)) /
           (to - from);
}

/* The zero of the polynomial near `straight`, that of straight lines; `sense`: 1 where it rises
 * there, -1 where it falls. */
static double find_zero(const struct step_values *values, double straight, double sense)
{
    const struct quintic quintic = quintic_through(values->start, values->nodes, values->end);
    double slope = slope_around(values, straight);
    double s = straight;
    double change = 0.0;
    double before = 0.0;
    for (int round = 0; round < ZERO_ROUNDS && sense * slope > 0.0; round++) {
        const struct quintic_basis basis = quintic_basis_at(s);
        double value = quintic_value(&quintic, &basis);
        if (round > 0)
            slope = (value - before) / change;
        before = value;
        change = -value / slope;
        s += change;
        if (fabs(change) < SMALL_CHANGE)
            break;
    }
    return s > 0.0 && s < 1.0 ? s : straight;
}

double step_ends_release(const struct step_values *values)
{
    return find_zero(values, step_values_release(values), -1.0);
}

double step_ends_touch(const struct step_values *values)
{
    return values->start < 0.0 ? find_zero(values, step_values_closing(values), 1.0) : 0.0;
}

/* With the force F at the places s_q, their weights w_q and the nodes' Gauss weights W_j and
 * orthogonal Lagrange polynomials L_j: force_j = sum_q w_q F_q L_j(s_q)/W_j. The indentation d
 * comes from the approach d + c F, which is as smooth as a motion; d itself is not where c is
 * large. */
static void project(const struct step_end *step, double from, double length, double force[NODES])
{
    const double *nodes = step->values.nodes;
    double c = step->compliance;
    double stiffness;
    double approach[NODES];
    double moment[NODES] = {0.0};
    for (int j = 0; j < NODES; j++)
        approach[j] = nodes[j] + c * force[j];
    const double start = step->values.start;
    const double end = step->values.end;
    const struct quintic local = quintic_through(start, nodes, end);
    const struct quintic whole =
        quintic_through(start + c * contact_law_force(step->law, start, &stiffness), approach,
                        end + c * contact_law_force(step->law, end, &stiffness));
    for (int q = 0; q < POINTS; q++) {
        const struct quintic_basis basis = quintic_basis_at(from + length * PLACE[q]);
        double d = quintic_value(&local, &basis);
        double f = contact_law_force(step->law, d, &stiffness);
        /* one round of Newton's method for d + c F */
        f -= stiffness * (d + c * f - quintic_value(&whole, &basis)) / (1.0 + c * stiffness);
        f *= fabs(length) * WEIGHT[q];
        for (int j = 0; j < NODES; j++)
            moment[j] += f * basis.by[j];
    }
    for (int j = 0; j < NODES; j++)
        force[j] = moment[j] / collocation.weight[j];
}

/* Whether the contact is closed at the nodes between two shares of the step. */
static bool closed_within(const double nodes[NODES], double from, double to)
{
    for (int j = 0; j < NODES; j++)
        if (collocation.node[j] > from && collocation.node[j] < to && !(nodes[j] > 0.0))
            return false;
    return true;
}

bool step_ends_project(const struct step_end *step, double force[NODES])
{
    const struct step_values *values = &step->values;
    double touch = values->start <= 0.0 && values->end > 0.0 ? step_ends_touch(values) : 1.0;
    if (touch < 1.0 && closed_within(values->nodes, touch, 1.0)) {
        project(step, touch, 1.0 - touch, force);
        return true;
    }
    double release = values->start > 0.0 && !(values->end > 0.0) ? step_ends_release(values) : 0.0;
    if (!(release > 0.0) || !closed_within(values->nodes, 0.0, release))
        return false;
    project(step, release, -release, force);
    return true;
}

bool step_ends_project_all(const struct scene *scene, const struct contact_start *now,
                           struct contact_step *step)
{
    bool any = false;
    for (size_t c = 0; c < scene->contacts; c++) {
        /* most steps neither begin nor end a contact */
        if ((now[c].indentation > 0.0) == (step->end_indentation[c] > 0.0))
            continue;
        const struct step_end end = {
            &scene->laws[c],
            scene->residual[c * (scene->rows + 1)],
            {now[c].indentation, step->end_indentation[c], step->indentation[c]}};
        any = step_ends_project(&end, step->force[c]) || any;
    }
    return any;
}

/* ---- Values of a step ---- */

double step_values_closing(const struct step_values *values)
{
    double before = values->start;
    double at = 0.0;
    for (int j = 0; j <= NODES; j++) {
        double s = j < NODES ? collocation.node[j] : 1.0;
        double d = j < NODES ? values->nodes[j] : values->end;
        double missing = before < 0.0 ? -before : 0.0;
        if (d > 0.0)
            return at + (s - at) * missing / (d + missing);
        before = d;
        at = s;
    }
    return 1.0;
}

double step_values_release(const struct step_values *values)
{
    double after = values->end;
    double at = 1.0;
    for (int j = NODES - 1; j >= -1; j--) {
        double s = j < 0 ? 0.0 : collocation.node[j];
        double d = j < 0 ? values->start : values->nodes[j];
        if (d > 0.0)
            return s + (at - s) * d / (d - after);
        after = d;
        at = s;
    }
    return 0.0;
}

struct contact_start step_values_after(const struct step_values *values, double h)
{
    const double *d = values->nodes;
    double r = 1.0 / h;
    double slope[NODES];
    for (int m = 1; m < NODES; m++) {
        const double *by = collocation.end[m];
        slope[m] = (by[0] * d[0] + by[1] * d[1]) + (by[2] * d[2] + by[3] * d[3]);
    }
    return (struct contact_start){values->end, slope[1] * r, 2.0 * slope[2] * (r * r),
                                  6.0 * slope[3] * (r * r * r)};
}

double step_values_opens(const struct contact_start *now)
{
    double square = now->rate * now->rate - 2.0 * now->curvature * now->indentation;
    double fall = square >= 0.0 ? sqrt(square) - now->rate : 0.0;
    return fall > 0.0 && now->indentation > 0.0 ? 2.0 * now->indentation / fall : INFINITY;
}
