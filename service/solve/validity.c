/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/validity.h"

#include <math.h>

#include "solve/compliance.h"
#include "solve/report.h"

static double wave_speed(const struct body *body)
{
    return sqrt(body->material.young / body->material.density);
}

double validity_wave_loss(const struct geometry *geometry, const struct solve_request *request,
                          const struct solve_result *result)
{
    (void)request;
    (void)result;
    double worst = 0.0;
    for (size_t c = 0; c < geometry->contact_count; c++) {
        double speed = fabs(geometry->gap_rate[c]);
        double energy_share = 0.0;
        for (int which = 0; which < 2; which++) {
            const struct body *body = geometry->bodies[geometry->sides[c][which].body];
            double ratio = speed / wave_speed(body);
            if (body->shape == SHAPE_HALF_SPACE)
                /* share of the energy that goes into waves: 1.04 (v/c)^(3/5) (Hunter, J. Mech.
                 * Phys. Solids 5 (1957) 162; Johnson, Contact Mechanics, section 11.4) */
                energy_share += 1.04 * pow(ratio, 0.6);
            else if (!body_is_flexible(body))
                /* vibration of a sphere after a collision: about v/(50 c) (Rayleigh; Goldsmith) */
                energy_share += 0.02 * ratio;
        }
        /* e^2 = 1 - share */
        worst = fmax(worst, 0.5 * energy_share);
    }
    return worst;
}

static double largest_force(const struct solve_contact_result *contact)
{
    double largest = 0.0;
    for (size_t i = 0; i < contact->sub_impacts_listed; i++)
        largest = fmax(largest, contact->sub_impacts[i].peak_force);
    return largest;
}

static void warn_yield(const struct geometry *geometry, size_t c, double pressure,
                       struct solve_result *result)
{
    for (int which = 0; which < 2; which++) {
        const struct body *body = geometry->bodies[geometry->sides[c][which].body];
        /* first yield below the surface at 1.6 times the yield stress (Johnson, section 6.1) */
        if (pressure > 1.6 * body->material.yield)
            report_warn(
                result,
                "contacts[%zu]: the elastic peak pressure of %.3g MPa exceeds 1.6 times the "
                "yield stress of %s (%.3g MPa): Hertz's law leaves no dent, the true "
                "restitution is lower (contact_model auto or closed-form)",
                c, pressure / 1e6, body->id, body->material.yield / 1e6);
    }
}

static void warn_contact(const struct geometry *geometry, size_t c, struct solve_result *result)
{
    const struct hertz_contact *hertz = &geometry->hertz[c];
    double force = largest_force(&result->contacts[c]);
    double axes[2];
    hertz_ellipse(hertz, force, axes);
    if (result->contact_model == PERCUSS_CONTACT_HERTZ)
        warn_yield(geometry, c, hertz_peak_pressure(hertz, force), result);
    for (int which = 0; which < 2; which++) {
        const struct contact_side *side = &geometry->sides[c][which];
        const struct body *body = geometry->bodies[side->body];
        double size = body_smallest_radius(body);
        if (axes[0] > 0.3 * size)
            report_warn(
                result,
                "contacts[%zu]: the contact's half-axis of %.3g m is more than 30 %% of the "
                "smallest radius of %s (%.3g m): Hertz's law ends there",
                c, axes[0], body->id, size);
        if (side->site.at_edge)
            report_warn(
                result,
                "contacts[%zu]: within 10 %% of the radius of an edge of %s: the contact law "
                "assumes material on all sides",
                c, body->id);
        double ratio = fabs(geometry->gap_rate[c]) / wave_speed(body);
        if (ratio > 0.01)
            report_warn(
                result,
                "contacts[%zu]: the approach at %.3g m/s is more than 1 %% of the wave speed "
                "in %s (%.4g m/s): small strains end there",
                c, fabs(geometry->gap_rate[c]), body->id, wave_speed(body));
    }
}

static void warn_delassus(const struct geometry *geometry, struct solve_result *result)
{
    size_t n = geometry->contact_count;
    double worst = 0.0;
    for (size_t i = 0; i < n * n; i++) {
        double scale = sqrt(geometry->w[i / n * (n + 1)] * geometry->w[i % n * (n + 1)]);
        worst = fmax(worst, fabs(geometry->w[i] - geometry->service_w[i]) / scale);
    }
    if (worst > 0.01)
        report_warn(result,
                    "delassus: differs from that of the catalogue's bodies by up to %.3g %%: the "
                    "client's is used",
                    100.0 * worst);
}

void validity_warn(const struct geometry *geometry, const struct solve_request *request,
                   struct solve_result *result)
{
    for (size_t c = 0; c < geometry->contact_count; c++)
        warn_contact(geometry, c, result);
    if (geometry->from_client)
        warn_delassus(geometry, result);
    if (request->options.compliance == PERCUSS_COMPLIANCE_MATCHED &&
        geometry->compliance->used != PERCUSS_COMPLIANCE_MATCHED)
        report_warn(result, "options.compliance: matched: %s: half-space is used",
                    geometry->compliance->reason);
}
