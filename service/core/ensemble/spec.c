/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/spec.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "contact/law_closed_form.h"
#include "model/limits.h"
#include "numeric/special.h"

/* ---- uncertain inputs ---- */

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

static const struct limit *input_limit(enum input_quantity quantity)
{
    static const struct limit *const limits[INPUT_QUANTITY_COUNT] = {
        [INPUT_SPEED] = &limit_speed,       [INPUT_DIRECTION] = &limit_direction,
        [INPUT_MODEL_FORCE] = &limit_model, [INPUT_MODEL_COMPLIANCE] = &limit_model,
        [INPUT_MODEL_YIELD] = &limit_model, [INPUT_MODEL_FRICTION] = &limit_model,
        [INPUT_FRICTION] = &limit_friction, [INPUT_SITE] = &limit_site,
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
    return quantity != INPUT_SPEED && quantity != INPUT_DIRECTION && quantity != INPUT_FRICTION &&
           !input_is_of_model(quantity);
}

/* Where values may lie: the stated truncation within the quantity's own limits. */
static void input_bounds(const struct ensemble_input *input, double *low, double *high)
{
    const struct limit *limit = input_limit(input->quantity);
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
    input_bounds(input, &low, &high);
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
    input_bounds(input, &low, &high);
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

static enum percuss_status input_refuse(const struct ensemble_input *input, size_t index,
                                        const char *field, double value, const char *allowed,
                                        struct fault *fault)
{
    const enum quantity unit = input_limit(input->quantity)->quantity;
    const char *example =
        *units_si(unit) && allowed == input_limit(input->quantity)->text ? units_example(unit) : "";
    return fault_set(fault, PERCUSS_BAD_REQUEST, "inputs[%zu].%s: %g%s%s: must be %s%s%s (%s, %s)",
                     index, field, value, *units_si(unit) ? " " : "", units_si(unit), allowed,
                     *example ? ", such as " : "", example, input_quantity_name(input->quantity),
                     distribution_name(input->distribution));
}

static enum percuss_status input_check_list(const struct ensemble_input *input, size_t index,
                                            struct fault *fault)
{
    const struct limit *limit = input_limit(input->quantity);
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

static enum percuss_status input_check_spread(const struct ensemble_input *input, size_t index,
                                              struct fault *fault)
{
    /* mean and deviation */
    bool logarithmic = input->distribution == DISTRIBUTION_IS_LOG_NORMAL;
    if (!isfinite(input->first) || (logarithmic && !(input->first > 0.0)))
        return input_refuse(input, index, "first", input->first,
                            logarithmic ? "a finite mean > 0" : "a finite mean", fault);
    if (!(input->second >= 0.0 && isfinite(input->second)))
        return input_refuse(input, index, "second", input->second,
                            "a finite standard deviation >= 0", fault);
    /* bounds that leave enough of it */
    if (input->lower >= input->upper)
        return input_refuse(input, index, "upper", input->upper, "above lower", fault);
    if (input->second == 0.0)
        return PERCUSS_OK; /* a constant, checked as such */
    if (!(1.0 - input_truncated(input) >= LEAST_SHARE) &&
        !limit_holds(input_limit(input->quantity), input->first))
        return input_refuse(input, index, "first", input->first, input_limit(input->quantity)->text,
                            fault);
    if (!(1.0 - input_truncated(input) >= LEAST_SHARE)) {
        char allowed[160];
        double low, high;
        input_bounds(input, &low, &high);
        snprintf(allowed, sizeof allowed,
                 "such that the distribution lies within its truncation and within what the "
                 "quantity can be, %g to %g%s%s",
                 low, high, *units_si(input_limit(input->quantity)->quantity) ? " " : "",
                 units_si(input_limit(input->quantity)->quantity));
        return input_refuse(input, index, "first", input->first, allowed, fault);
    }
    return PERCUSS_OK;
}

enum percuss_status input_check(const struct ensemble_input *input, size_t index,
                                struct fault *fault)
{
    const struct limit *limit = input_limit(input->quantity);
    /* parameters of the distribution */
    switch (input->distribution) {
    case DISTRIBUTION_IS_LIST:
        return input_check_list(input, index, fault);
    case DISTRIBUTION_IS_NORMAL:
    case DISTRIBUTION_IS_LOG_NORMAL: {
        enum percuss_status status = input_check_spread(input, index, fault);
        if (status || input->second > 0.0)
            return status;
        break;
    }
    case DISTRIBUTION_IS_UNIFORM:
        if (!limit_holds(limit, input->first))
            break;
        if (!limit_holds(limit, input->second))
            return input_refuse(input, index, "second", input->second, limit->text, fault);
        if (!(input->first <= input->second))
            return input_refuse(input, index, "second", input->second, "at least first", fault);
        break;
    default:
        break;
    }
    /* and its place within the limits */
    if (!limit_holds(limit, input->first))
        return input_refuse(input, index, "first", input->first, limit->text, fault);
    return PERCUSS_OK;
}

/* ---- the specification ---- */

bool spec_is_drawn(const struct ensemble_spec *spec, size_t input)
{
    const struct ensemble_input *one = &spec->inputs[input];
    switch (one->distribution) {
    case DISTRIBUTION_IS_CONSTANT:
        return false;
    case DISTRIBUTION_IS_UNIFORM:
        return one->second > one->first;
    case DISTRIBUTION_IS_LIST:
        return spec->samples > 0 && one->value_count > 1;
    default:
        return one->second > 0.0;
    }
}

static bool changes_body(const struct ensemble_input *input)
{
    return input_is_of_body(input->quantity) && input->quantity != INPUT_SITE;
}

bool spec_changes_bodies(const struct ensemble_spec *spec)
{
    bool changes = false;
    for (size_t i = 0; i < spec->input_count; i++)
        changes = changes || changes_body(&spec->inputs[i]);
    return changes;
}

bool spec_changes_scene(const struct ensemble_spec *spec)
{
    bool changes = spec_changes_bodies(spec);
    for (size_t i = 0; i < spec->input_count; i++)
        changes = changes || spec->inputs[i].quantity == INPUT_SITE ||
                  spec->inputs[i].quantity == INPUT_FRICTION ||
                  input_is_of_model(spec->inputs[i].quantity);
    return changes;
}

/* Without a number of samples the lists give it: they must have one length. */
static enum percuss_status check_lists(const struct ensemble_spec *spec, struct fault *fault)
{
    size_t count = 0;
    /* lists of one length */
    for (size_t i = 0; i < spec->input_count; i++) {
        const struct ensemble_input *input = &spec->inputs[i];
        if (input->distribution != DISTRIBUTION_IS_LIST)
            continue;
        if (count > 0 && input->value_count != count)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "inputs[%zu].values: %zu given: must be %zu as in the list before "
                             "(samples: 0: their values are taken side by side)",
                             i, input->value_count, count);
        count = input->value_count;
    }
    /* at least one */
    if (count == 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "samples: 0: must be 1 to %d (0 goes with inputs that are lists)",
                         ENSEMBLE_MAX_SAMPLES);
    if (spec->sampling != SAMPLING_IS_PLAIN)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "sampling: %s: must be plain with samples: 0 (lists taken in order)",
                         sampling_name(spec->sampling));
    return PERCUSS_OK;
}

static enum percuss_status check_numbers(const struct ensemble_spec *spec, struct fault *fault)
{
    /* samples and when to stop */
    if (spec->samples > ENSEMBLE_MAX_SAMPLES)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "samples: %llu: must be at most %d",
                         (unsigned long long)spec->samples, ENSEMBLE_MAX_SAMPLES);
    if (!(spec->half_width >= 0.0 && isfinite(spec->half_width)))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "half_width: %g: must be >= 0 and finite",
                         spec->half_width);
    if (!(spec->quantile_half_width >= 0.0 && isfinite(spec->quantile_half_width)))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "quantile_half_width: %g: must be >= 0 and finite",
                         spec->quantile_half_width);
    /* quantiles and bins */
    for (size_t i = 0; i < spec->quantile_count; i++) {
        if (!(spec->quantiles[i] > 0.0 && spec->quantiles[i] < 1.0))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "quantiles[%zu]: %g: must be a probability between 0 and 1", i,
                             spec->quantiles[i]);
    }
    if (spec->quantile_count > ENSEMBLE_MAX_QUANTILES)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "quantiles: %zu given: must be at most %d",
                         spec->quantile_count, ENSEMBLE_MAX_QUANTILES);
    if (spec->bins > ENSEMBLE_MAX_BINS)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "bins: %zu: must be at most %d", spec->bins,
                         ENSEMBLE_MAX_BINS);
    /* and of which contact */
    if (spec->contact >= spec->request->contact_count)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "contact: %zu: must be an index into contacts, 0 to %zu", spec->contact,
                         spec->request->contact_count - 1);
    return PERCUSS_OK;
}

static bool is_of_friction(const struct ensemble_input *input)
{
    return input->quantity == INPUT_FRICTION || input->quantity == INPUT_MODEL_FRICTION;
}

/* The same number cannot be replaced twice. */
static bool clash(const struct ensemble_spec *spec, size_t i, size_t j)
{
    const struct ensemble_input *a = &spec->inputs[i], *b = &spec->inputs[j];
    const struct solve_body *bodies = spec->request->bodies;
    if (is_of_friction(a) && is_of_friction(b))
        return true;
    return a->quantity == b->quantity &&
           (!input_is_of_body(a->quantity) || strcmp(bodies[a->body].id, bodies[b->body].id) == 0);
}

/* Nor a number that the request itself replaces. */
static enum percuss_status check_overrides(const struct ensemble_spec *spec, size_t i,
                                           struct fault *fault)
{
    const char *name = input_quantity_name(spec->inputs[i].quantity);
    const struct solve_request *request = spec->request;
    for (size_t b = 0; changes_body(&spec->inputs[i]) && b < request->body_count; b++) {
        const struct solve_body *body = &request->bodies[b];
        if (strcmp(body->id, request->bodies[spec->inputs[i].body].id) != 0)
            continue;
        for (size_t k = 0; k < body->variation_count; k++)
            if (strcmp(parameter_name(body->variations[k].parameter), name) == 0)
                return fault_set(fault, PERCUSS_BAD_REQUEST,
                                 "inputs[%zu].name: %s: must be another one: bodies[%zu].overrides "
                                 "give it already",
                                 i, name, b);
    }
    return PERCUSS_OK;
}

/* Refuses an input that is impossible with this impact. */
static enum percuss_status check_input(const struct ensemble_spec *spec, size_t i,
                                       struct fault *fault)
{
    const struct ensemble_input *input = &spec->inputs[i];
    const char *name = input_quantity_name(input->quantity);
    /* nothing that a state or another contact depends on */
    if (changes_body(input) && spec->request->bodies[input->body].state)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "inputs[%zu].body: %s: must have no state token: its vibration is that of "
                         "the catalogue's %s",
                         i, spec->request->bodies[input->body].id, name);
    bool moves = input->quantity == INPUT_SITE || input->quantity == INPUT_RADIUS ||
                 input->quantity == INPUT_SCALE;
    if (moves && spec->request->contact_count > 1)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "inputs[%zu].name: %s: must be another one where there are %zu contacts: "
                         "it would move them apart",
                         i, name, spec->request->contact_count);
    if (is_of_friction(input) && spec->request->options.friction == PERCUSS_FRICTION_NONE)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "inputs[%zu].name: %s: must be another one with options.friction none", i,
                         name);
    /* nothing that is given twice */
    enum percuss_status status = check_overrides(spec, i, fault);
    if (status)
        return status;
    for (size_t j = 0; j < i; j++)
        if (clash(spec, i, j))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "inputs[%zu].name: %s: is inputs[%zu] already", i, name, j);
    return input_check(input, i, fault);
}

static enum percuss_status check_correlations(const struct ensemble_spec *spec, struct fault *fault)
{
    for (size_t p = 0; p < spec->correlation_count; p++) {
        const struct copula_pair *pair = &spec->correlations[p];
        bool known = pair->first < spec->input_count && pair->second < spec->input_count &&
                     pair->first != pair->second;
        if (!known || !spec_is_drawn(spec, pair->first) || !spec_is_drawn(spec, pair->second))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "correlations[%zu]: inputs %zu and %zu: must be two different "
                             "uncertain inputs",
                             p, pair->first, pair->second);
    }
    return PERCUSS_OK;
}

/* Whether a contact of any body of that id (inputs change all of them) leaves dents, in it or its
 * partner. solve() refuses contacts of unknown bodies. */
static bool yields(const struct ensemble_spec *spec, const char *id)
{
    const struct solve_request *request = spec->request;
    bool yields = false;
    for (size_t c = 0; c < request->contact_count && c < PERCUSS_MAX_CONTACTS; c++) {
        const struct solve_contact *contact = &request->contacts[c];
        if (contact->a >= request->body_count || contact->b >= request->body_count)
            continue;
        const char *ids[] = {request->bodies[contact->a].id, request->bodies[contact->b].id};
        if (strcmp(ids[0], id) != 0 && strcmp(ids[1], id) != 0)
            continue;
        const struct body *a = body_set_find(spec->catalogue, ids[0]);
        const struct body *b = body_set_find(spec->catalogue, ids[1]);
        yields = yields || (a && b && closed_form_softer(&a->material, &b->material) >= 0);
    }
    return yields;
}

enum percuss_status spec_check_tables(const struct ensemble_spec *spec, struct fault *fault)
{
    const struct contact_law_operations *law =
        contact_law_asked(spec->request->options.contact_model);
    bool insists = law->tables == CONTACT_TABLES_ONLY;
    for (size_t i = 0; insists && i < spec->input_count; i++) {
        enum input_quantity quantity = spec->inputs[i].quantity;
        bool material = quantity == INPUT_YOUNG || quantity == INPUT_POISSON;
        if (quantity == INPUT_YIELD ||
            (material && yields(spec, spec->request->bodies[spec->inputs[i].body].id)))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "inputs[%zu].name: %s: must be another one with options.contact_model "
                             "table: a table is of one material only (auto or closed-form do "
                             "without)",
                             i, input_quantity_name(quantity));
    }
    return PERCUSS_OK;
}

enum percuss_status spec_check(const struct ensemble_spec *spec, struct fault *fault)
{
    enum percuss_status status = check_numbers(spec, fault);
    if (!status && spec->input_count == 0)
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "inputs: none given: must be 1 to %d",
                           ENSEMBLE_MAX_INPUTS);
    for (size_t i = 0; !status && i < spec->input_count; i++)
        status = check_input(spec, i, fault);
    if (!status && spec->samples == 0)
        status = check_lists(spec, fault);
    if (!status)
        status = check_correlations(spec, fault);
    return status;
}
