/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/spec.h"

#include <math.h>
#include <string.h>

#include "contact/law_closed_form.h"

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

/* The same number cannot be replaced twice. */
static bool clash(const struct ensemble_spec *spec, size_t i, size_t j)
{
    const struct ensemble_input *a = &spec->inputs[i], *b = &spec->inputs[j];
    const struct solve_body *bodies = spec->request->bodies;
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
