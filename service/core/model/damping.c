/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/damping.h"

#include <math.h>

double damping_of(const struct body *body, size_t mode, double omega)
{
    if (body->damping_peak > 0.0)
        return body->damping * relaxation_loss_factor(&body->relaxation, omega) /
               body->damping_peak;
    if (body->damping_count == 0)
        return body->damping;
    size_t last = body->damping_count - 1;
    return body->damping * body->damping_shares[mode < last ? mode : last];
}

double damping_from(const struct body *body, size_t first, double omega)
{
    if (body->damping_peak > 0.0)
        return body->damping * relaxation_peak_loss(&body->relaxation, omega) / body->damping_peak;
    double most = damping_of(body, first, omega);
    for (size_t k = first + 1; k < body->damping_count; k++)
        most = fmax(most, damping_of(body, k, omega));
    return most;
}

void damping_describe(const struct body *body, struct body_description *description)
{
    size_t count = body->damping_count;
    double least = body->damping;
    if (body->damping_peak > 0.0) {
        describe_add(description, "modal damping ratios by its relaxation, %.3g at most",
                     body->damping);
        return;
    }
    for (size_t k = 0; k < count; k++)
        least = fmin(least, damping_of(body, k, 0.0));
    if (count > 1 && body->damping > 0.0)
        describe_add(description,
                     "modal damping ratios %g to %g of the lowest %zu modes, %g of the others",
                     least, body->damping, count, damping_of(body, count, 0.0));
    else if (body->damping > 0.0)
        describe_add(description, "modal damping ratio %g", body->damping);
}
