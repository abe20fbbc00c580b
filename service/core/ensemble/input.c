/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/input.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "model/limits.h"
#include "numeric/special.h"

/* Less than this share of a distribution inside its truncation is a mistake. */
static const double LEAST_SHARE = 1e-6;

/* Limits of the quantities that the catalogue does not limit. No impact is measured below a
 * micrometre a second or at more than 80 degrees. */
static const struct limit limit_speed = {1e-6,           1e4, false, false, "1e-6 to 1e4 m/s",
                                         QUANTITY_NUMBER};
static const struct limit limit_direction = {
    -1.396, 1.396, false, false, "an angle of -1.396 to 1.396 rad (80 degrees)", QUANTITY_NUMBER};
static const struct limit limit_model = {
    -6.0, 6.0, false, false, "-6 to 6 standard deviations", QUANTITY_NUMBER};
static const struct limit limit_site = {
    0.0, 1.0, false, false, "a fraction of the length, 0 to 1", QUANTITY_NUMBER};

#define QUANTITY_TEXT(name, text) [INPUT_##name] = (text),
static const char *const quantity_names[] = {INPUT_QUANTITY_LIST(QUANTITY_TEXT)};

static const char *const distribution_names[] = {"constant", "uniform", "normal", "log-normal",
                                                 "list"};

static const struct limit *limit_of(enum input_quantity quantity)
{
    static const struct limit *const limits[INPUT_QUANTITY_COUNT] = {
        [INPUT_SPEED] = &limit_speed,       [INPUT_DIRECTION] = &limit_direction,
        [INPUT_MODEL_FORCE] = &limit_model, [INPUT_MODEL_COMPLIANCE] = &limit_model,
        [INPUT_MODEL_YIELD] = &limit_model, [INPUT_SITE] = &limit_site,
        [INPUT_YOUNG] = &limit_young,       [INPUT_POISSON] = &limit_poisson,
        [INPUT_DENSITY] = &limit_density,   [INPUT_RADIUS] = &limit_length,
        [INPUT_YIELD] = &limit_yield,       [INPUT_DAMPING] = &limit_damping,
        [INPUT_SCALE] = &limit_scale,
    };
    return limits[quantity];
}

const char *input_quantity_name(unsigned quantity)
{
    return quantity < INPUT_QUANTITY_COUNT ? quantity_names[quantity] : "?";
}

const char *distribution_name(unsigned distribution)
{
    return distribution < DISTRIBUTION_KINDS ? distribution_names[distribution] : "?";
}

enum input_quantity input_quantity_find(const char *name)
{
    unsigned i = 0;
    /* as the command line calls it */
    if (strcmp(name, "at") == 0)
        return INPUT_SITE;
    while (i < INPUT_QUANTITY_COUNT && strcmp(quantity_names[i], name) != 0)
        i++;
    return i;
}

bool input_is_of_body(enum input_quantity quantity)
{
    return quantity != INPUT_SPEED && quantity != INPUT_DIRECTION && !input_is_of_model(quantity);
}

/* Where values may lie: the stated truncation within the quantity's own limits. */
static void bounds(const struct ensemble_input *input, double *low, double *high)
{
    const struct limit *limit = limit_of(input->quantity);
    *low = limit->low_open ? nextafter(limit->low, INFINITY) : limit->low;
    *high = limit->high_open ? nextafter(limit->high, -INFINITY) : limit->high;
    bool spreads = input->distribution == DISTRIBUTION_IS_NORMAL ||
                   input->distribution == DISTRIBUTION_IS_LOG_NORMAL;
    if (spreads && !isnan(input->lower))
        *low = fmax(*low, input->lower);
    if (spreads && !isnan(input->upper))
        *high = fmin(*high, input->upper);
}

/* Mean and deviation of the normal variable behind: the value itself or its logarithm. */
static void normal_behind(const struct ensemble_input *input, double *mean, double *deviation)
{
    *mean = input->first;
    *deviation = input->second;
    if (input->distribution == DISTRIBUTION_IS_NORMAL)
        return;
    double variation = input->second / input->first;
    double variance = log1p(variation * variation);
    *mean = log(input->first) - 0.5 * variance;
    *deviation = sqrt(variance);
}

/* The truncation in standard deviations of the normal variable. */
static void normal_bounds(const struct ensemble_input *input, double *a, double *b)
{
    double low, high, mean, deviation;
    bounds(input, &low, &high);
    normal_behind(input, &mean, &deviation);
    if (input->distribution == DISTRIBUTION_IS_LOG_NORMAL) {
        low = low > 0.0 ? log(low) : -INFINITY;
        high = high > 0.0 ? log(high) : -INFINITY;
    }
    *a = (low - mean) / deviation;
    *b = (high - mean) / deviation;
}

/* P(a < Z < b) with all digits in either tail. */
static double normal_between(double a, double b)
{
    return a > 0.0 ? special_normal_cdf(-a) - special_normal_cdf(-b)
                   : special_normal_cdf(b) - special_normal_cdf(a);
}

static double normal_value(const struct ensemble_input *input, double u)
{
    double a, b, mean, deviation, low, high;
    normal_bounds(input, &a, &b);
    normal_behind(input, &mean, &deviation);
    double share = normal_between(a, b);
    /* counted from the nearer tail */
    double z = a > 0.0 ? -special_normal_quantile(special_normal_cdf(-a) - u * share)
                       : special_normal_quantile(special_normal_cdf(a) + u * share);
    double value = mean + deviation * z;
    if (input->distribution == DISTRIBUTION_IS_LOG_NORMAL)
        value = exp(value);
    bounds(input, &low, &high);
    return fmax(low, fmin(value, high));
}

double input_value(const struct ensemble_input *input, double u)
{
    switch (input->distribution) {
    case DISTRIBUTION_IS_UNIFORM:
        return input->first + u * (input->second - input->first);
    case DISTRIBUTION_IS_NORMAL:
    case DISTRIBUTION_IS_LOG_NORMAL:
        return input->second > 0.0 ? normal_value(input, u) : input->first;
    case DISTRIBUTION_IS_LIST:
        return input->values[(size_t)(u * (double)input->value_count)];
    default:
        return input->first;
    }
}

double input_truncated(const struct ensemble_input *input)
{
    bool spreads = input->distribution == DISTRIBUTION_IS_NORMAL ||
                   input->distribution == DISTRIBUTION_IS_LOG_NORMAL;
    if (!spreads || !(input->second > 0.0))
        return 0.0;
    double a, b;
    normal_bounds(input, &a, &b);
    return 1.0 - normal_between(a, b);
}

static enum percuss_status refuse(const struct ensemble_input *input, size_t index,
                                  const char *field, double value, const char *allowed,
                                  struct fault *fault)
{
    const enum quantity unit = limit_of(input->quantity)->quantity;
    const char *example =
        *units_si(unit) && allowed == limit_of(input->quantity)->text ? units_example(unit) : "";
    return fault_set(fault, PERCUSS_BAD_REQUEST, "inputs[%zu].%s: %g%s%s: must be %s%s%s (%s, %s)",
                     index, field, value, *units_si(unit) ? " " : "", units_si(unit), allowed,
                     *example ? ", such as " : "", example, input_quantity_name(input->quantity),
                     distribution_name(input->distribution));
}

static enum percuss_status check_list(const struct ensemble_input *input, size_t index,
                                      struct fault *fault)
{
    const struct limit *limit = limit_of(input->quantity);
    if (input->value_count == 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "inputs[%zu].values: none given: a list needs at least one", index);
    for (size_t i = 0; i < input->value_count; i++) {
        if (!limit_holds(limit, input->values[i]))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "inputs[%zu].values[%zu]: %g: must be %s (%s)", index, i,
                             input->values[i], limit->text, input_quantity_name(input->quantity));
    }
    return PERCUSS_OK;
}

static enum percuss_status check_spread(const struct ensemble_input *input, size_t index,
                                        struct fault *fault)
{
    /* mean and deviation */
    bool logarithmic = input->distribution == DISTRIBUTION_IS_LOG_NORMAL;
    if (!isfinite(input->first) || (logarithmic && !(input->first > 0.0)))
        return refuse(input, index, "first", input->first,
                      logarithmic ? "a finite mean > 0" : "a finite mean", fault);
    if (!(input->second >= 0.0 && isfinite(input->second)))
        return refuse(input, index, "second", input->second, "a finite standard deviation >= 0",
                      fault);
    /* bounds that leave enough of it */
    if (input->lower >= input->upper)
        return refuse(input, index, "upper", input->upper, "above lower", fault);
    if (input->second == 0.0)
        return PERCUSS_OK; /* a constant, checked as such */
    if (!(1.0 - input_truncated(input) >= LEAST_SHARE) &&
        !limit_holds(limit_of(input->quantity), input->first))
        return refuse(input, index, "first", input->first, limit_of(input->quantity)->text, fault);
    if (!(1.0 - input_truncated(input) >= LEAST_SHARE)) {
        char allowed[160];
        double low, high;
        bounds(input, &low, &high);
        snprintf(allowed, sizeof allowed,
                 "such that the distribution lies within its truncation and within what the "
                 "quantity can be, %g to %g%s%s",
                 low, high, *units_si(limit_of(input->quantity)->quantity) ? " " : "",
                 units_si(limit_of(input->quantity)->quantity));
        return refuse(input, index, "first", input->first, allowed, fault);
    }
    return PERCUSS_OK;
}

enum percuss_status input_check(const struct ensemble_input *input, size_t index,
                                struct fault *fault)
{
    const struct limit *limit = limit_of(input->quantity);
    /* parameters of the distribution */
    switch (input->distribution) {
    case DISTRIBUTION_IS_LIST:
        return check_list(input, index, fault);
    case DISTRIBUTION_IS_NORMAL:
    case DISTRIBUTION_IS_LOG_NORMAL: {
        enum percuss_status status = check_spread(input, index, fault);
        if (status || input->second > 0.0)
            return status;
        break;
    }
    case DISTRIBUTION_IS_UNIFORM:
        if (!limit_holds(limit, input->first))
            break;
        if (!limit_holds(limit, input->second))
            return refuse(input, index, "second", input->second, limit->text, fault);
        if (!(input->first <= input->second))
            return refuse(input, index, "second", input->second, "at least first", fault);
        break;
    default:
        break;
    }
    /* and its place within the limits */
    if (!limit_holds(limit, input->first))
        return refuse(input, index, "first", input->first, limit->text, fault);
    return PERCUSS_OK;
}
