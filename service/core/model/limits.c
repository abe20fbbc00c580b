/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/limits.h"

/* The bounds keep every derived quantity (mass, L^4, frequencies) far from overflow and underflow
 * and catch GPa written for Pa; they lie decades outside any body that is tested for impact. */
const struct limit limit_length = {
    1e-9, 1e3, false, false, "a finite length > 0 m (1e-9 to 1e3 m)", QUANTITY_LENGTH};
const struct limit limit_diameter = {
    2e-9, 2e3, false, false, "a finite length > 0 m (2e-9 to 2e3 m)", QUANTITY_LENGTH};
const struct limit limit_young = {
    1e3, 1e13, false, false, "a finite modulus > 0 Pa (1e3 to 1e13 Pa)", QUANTITY_STRESS};
const struct limit limit_poisson = {-1.0,           0.5, true, true, "a number > -1 and < 0.5",
                                    QUANTITY_NUMBER};
const struct limit limit_density = {
    1e-3, 1e5, false, false, "a finite density > 0 kg/m^3 (1e-3 to 1e5 kg/m^3)", QUANTITY_DENSITY};
const struct limit limit_yield = {1.0,
                                  1e12,
                                  false,
                                  false,
                                  "a finite stress > 0 Pa (1 to 1e12 Pa); absent: elastic",
                                  QUANTITY_STRESS};
const struct limit limit_tangent = {
    0.0, 1e13, false, false, "a finite modulus >= 0 Pa and below young", QUANTITY_STRESS};
const struct limit limit_damping = {0.0, 1.0, false, true, "a ratio >= 0 and < 1", QUANTITY_NUMBER};
const struct limit limit_loss_factor = {
    0.0, 2.0, false, true, "a ratio >= 0 and < 2", QUANTITY_NUMBER};
const struct limit limit_loss_frequency = {
    1e-12, 1e12, false, false, "a finite frequency > 0 Hz (1e-12 to 1e12 Hz)", QUANTITY_FREQUENCY};
const struct limit limit_share = {0.0, 1.0, true, true, "a share > 0 and < 1", QUANTITY_NUMBER};
const struct limit limit_time = {
    1e-12, 1e12, false, false, "a finite time > 0 s (1e-12 to 1e12 s)", QUANTITY_TIME};
/* Published exponents are 2 to 10, coefficients 0.001 to 0.2: neither passes as the other. */
const struct limit limit_rate = {
    1e-9, 1e12, false, false, "a finite rate > 0 1/s (1e-9 to 1e12 1/s)", QUANTITY_NUMBER};
const struct limit limit_rate_exponent = {
    1.0, 100.0, false, false, "a number, 1 to 100", QUANTITY_NUMBER};
const struct limit limit_rate_coefficient = {
    0.0, 1.0, true, true, "a number > 0 and < 1", QUANTITY_NUMBER};
const struct limit limit_shear_factor = {
    1e-3, 2.0, false, false, "a number > 0 (1e-3 to 2)", QUANTITY_NUMBER};
const struct limit limit_scale = {1e-6,           1e6, false, false, "a number > 0 (1e-6 to 1e6)",
                                  QUANTITY_NUMBER};
const struct limit limit_friction = {
    0.0, 10.0, false, false, "a coefficient >= 0 and <= 10", QUANTITY_NUMBER};
const struct limit limit_deviation = {
    0.0, 10.0, false, false, "a standard deviation >= 0 and <= 10", QUANTITY_NUMBER};
const struct limit limit_law_stiffness = {
    1e-3, 1e30, false, false, "a plain number of N/m^exponent (1e-3 to 1e30)", QUANTITY_NUMBER};
const struct limit limit_law_exponent = {
    1.0, 4.0, false, false, "a number >= 1 and <= 4", QUANTITY_NUMBER};
const struct limit limit_hysteresis = {
    0.0, 1.0, false, true, "a share >= 0 and < 1", QUANTITY_NUMBER};
const struct limit limit_dissipation = {
    0.0, 1e6, false, false, "a number >= 0 s/m (to 1e6)", QUANTITY_NUMBER};
const struct limit limit_law_deviation = {
    0.0, 1.0, false, false, "a share >= 0 and <= 1", QUANTITY_NUMBER};
const struct limit limit_modes = {1.0,
                                  LIMIT_MODES,
                                  false,
                                  false,
                                  "a whole number, 1 to 5000; absent: from the tolerance",
                                  QUANTITY_NUMBER};

bool limit_holds(const struct limit *limit, double value)
{
    bool above = limit->low_open ? value > limit->low : value >= limit->low;
    bool below = limit->high_open ? value < limit->high : value <= limit->high;
    return above && below;
}

enum percuss_status limit_check(const struct limit *limit, const char *field, double value,
                                struct fault *fault)
{
    if (limit_holds(limit, value))
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %.9g: must be %s", field, value, limit->text);
}
