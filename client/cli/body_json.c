/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "body_json.h"

#include <percuss/percuss.h>

#include "json_writer.h"

JSON_TABLE(relaxation_term, PERCUSS_RELAXATION_TERM_FIELDS)

/* An object or array under way; NULL as soon as memory has run out. */

static json_t *with(json_t *object, const char *name, json_t *value)
{
    if (object && json_object_set_new(object, name, value) == 0)
        return object;
    json_decref(object);
    return NULL;
}

static json_t *and_then(json_t *array, json_t *value)
{
    if (array && json_array_append_new(array, value) == 0)
        return array;
    json_decref(array);
    return NULL;
}

static json_t *numbers(const double *values, size_t count)
{
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++)
        array = and_then(array, json_number(values[i]));
    return array;
}

static json_t *supports(const struct percuss_body *body)
{
    static const char *const names[] = {"free", "pinned", "clamped"};
    json_t *array = json_array();
    for (int i = 0; i < 2; i++) {
        unsigned support = body->supports[i];
        array = and_then(array, json_string(support < 3 ? names[support] : "?"));
    }
    return array;
}

static json_t *sites(const struct percuss_body *body)
{
    json_t *array = json_array();
    for (size_t i = 0; i < body->site_count; i++) {
        json_t *object = with(json_object(), "name", json_text_or_null(body->sites[i].name));
        object = with(object, "point", numbers(body->sites[i].point, 3));
        object = with(object, "normal", numbers(body->sites[i].normal, 3));
        array = and_then(array, object);
    }
    return array;
}

static json_t *relaxation(const struct percuss_body *body)
{
    json_t *array = json_array();
    for (size_t i = 0; i < body->relaxation_count; i++)
        array = and_then(array, json_object_of(relaxation_term_members(), &body->relaxation[i]));
    return array;
}

json_t *body_to_json(const struct percuss_body *body)
{
    json_t *object = with(json_object(), "id", json_text_or_null(body->id));
    object = with(object, "shape", json_text_or_null(body->shape));
    object = with(object, "material", json_text_or_null(body->material));
    object = with(object, "mass", json_number(body->mass));
    object = with(object, "description", json_text_or_null(body->description));
    object = with(object, "half_extents", numbers(body->half_extents, 3));
    object = with(object, "radius", json_number(body->radius));
    object = with(object, "tip_radius", json_number(body->tip_radius));
    object = with(object, "supports", supports(body));
    /* the others under the names that inputs have */
    for (unsigned p = 0; p < PERCUSS_PARAMETER_COUNT; p++)
        if (p != PERCUSS_PARAMETER_RADIUS)
            object = with(object, percuss_parameter_name(p), json_number(body->parameters[p]));
    object = with(object, "inertia", numbers(body->inertia, 3));
    object = with(object, "products", numbers(body->products, 3));
    object = with(object, "sites", sites(body));
    object = with(object, "loss_factor", json_number(body->loss_factor));
    object = with(object, "loss_frequency", json_number(body->loss_frequency));
    object = with(object, "relaxation", relaxation(body));
    object = with(object, "rate_reference", json_number(body->rate_reference));
    object = with(object, "rate_exponent", json_number(body->rate_exponent));
    return with(object, "rate_coefficient", json_number(body->rate_coefficient));
}
