/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/cli/json_schema.c: what is printed and read is what its schema says. */
#include <string.h>

#include "check.h"
#include "convert.h"
#include "ensemble_output.h"
#include "reply_json.h"
#include "request_json.h"
#include "unit/client/wire_reply.h"

static const json_t *at(const json_t *object, const char *name)
{
    const json_t *value = json_object_get(object, name);
    if (!value)
        fail_msg("no %s", name);
    return value;
}

static bool has_type(const json_t *value, const char *type)
{
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        return !strcmp(type, "object");
    case JSON_ARRAY:
        return !strcmp(type, "array");
    case JSON_STRING:
        return !strcmp(type, "string");
    case JSON_INTEGER:
        return !strcmp(type, "integer") || !strcmp(type, "number");
    case JSON_REAL:
        return !strcmp(type, "number");
    case JSON_NULL:
        return !strcmp(type, "null");
    default:
        return !strcmp(type, "boolean");
    }
}

/* Types, names, and that nothing required is missing, all the way down. */
static void agrees(const json_t *value, const json_t *schema, const char *path)
{
    const json_t *type = at(schema, "type"), *names = json_object_get(schema, "enum");
    bool good = json_is_string(type) && has_type(value, json_string_value(type));
    for (size_t i = 0; i < json_array_size(type); i++)
        good = good || has_type(value, json_string_value(json_array_get(type, i)));
    for (size_t i = 0; names && (good = i < json_array_size(names)); i++)
        if (json_equal(value, json_array_get(names, i)))
            break;
    if (!good)
        fail_msg("%s: not as its schema", path);
    const json_t *required = json_object_get(schema, "required");
    for (size_t i = 0; i < json_array_size(required); i++)
        at(value, json_string_value(json_array_get(required, i)));
    const char *name;
    json_t *member;
    json_object_foreach((json_t *)value, name, member)
        agrees(member, at(at(schema, "properties"), name), name);
    for (size_t i = 0; i < json_array_size(value); i++)
        agrees(json_array_get(value, i), at(schema, "items"), path);
}

static void replies_are_as_their_schema(void **state)
{
    (void)state;
    struct percuss_reply reply;
    percuss_v1_Reply wire = wire_reply();
    assert_int_equal(convert_reply(&wire, &reply), PERCUSS_RESULT_OK);
    json_t *value = reply_to_json(&reply), *schema = reply_schema();
    agrees(value, schema, "reply");
    json_decref(value);
    json_decref(schema);
    percuss_reply_free(&reply);
}

static void ensembles_are_as_their_schema(void **state)
{
    (void)state;
    double numbers[3] = {1.0, NAN, 3.0};
    uint64_t counts[2] = {4, 5};
    struct percuss_input_part part = {.low = NAN};
    struct percuss_statistic statistic = {
        .quantile_count = 3, .bin_count = 2, .bin_counts = counts};
    statistic.probabilities = statistic.quantiles = statistic.quantiles_low = numbers;
    statistic.quantiles_high = statistic.bin_edges = numbers;
    struct percuss_sensitivity sensitivity = {.part_count = 1, .parts = &part};
    struct percuss_sigma_interval interval = {.sigmas = 1.0};
    struct percuss_ensemble_reply reply = {.statistic_count = 1,
                                           .statistics = &statistic,
                                           .interval_count = 1,
                                           .intervals = &interval};
    reply.sensitivity_count = 1;
    reply.sensitivities = &sensitivity;
    json_t *value = ensemble_to_json(&reply), *schema = ensemble_schema();
    agrees(value, schema, "ensemble");
    assert_int_equal(json_array_size(at(json_array_get(at(value, "statistics"), 0), "bin_edges")),
                     3);
    json_decref(value);
    json_decref(schema);
}

/* Members by their path. */
static const json_t *find(const json_t *schema, const char *list, const char *name)
{
    const json_t *object = at(at(schema, "properties"), list);
    if (json_object_get(object, "items"))
        object = at(object, "items");
    return at(at(object, "properties"), name);
}

static void requests_have_ranges(void **state)
{
    (void)state;
    json_t *schema = request_schema();
    const json_t *gap = find(schema, "contacts", "gap");
    assert_true(json_real_value(at(gap, "minimum")) == -json_real_value(at(gap, "maximum")));
    assert_string_equal(json_string_value(at(find(schema, "bodies", "elapsed"), "description")),
                        "s; since that state, which is that at `window` of its reply");
    const json_t *horizon = at(find(schema, "options", "horizon"), "anyOf");
    assert_int_equal(json_integer_value(at(json_array_get(horizon, 0), "const")), 0);
    assert_true(json_real_value(at(json_array_get(horizon, 1), "maximum")) == 10.0);
    assert_int_equal(json_array_size(at(find(schema, "options", "method"), "enum")),
                     PERCUSS_METHOD_COUNT);
    assert_true(json_is_false(at(at(at(schema, "properties"), "options"), "additionalProperties")));
    json_decref(schema);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(replies_are_as_their_schema),
        cmocka_unit_test(ensembles_are_as_their_schema),
        cmocka_unit_test(requests_have_ranges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
