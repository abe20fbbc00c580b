/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "json_schema.h"

static json_t *number(const struct json_member *member)
{
    if (!isfinite(member->high))
        return json_pack("{s[ss]}", "type", "number", "null");
    json_t *range = member->high > member->low
                        ? json_pack("{sfsf}", "minimum", member->low, "maximum", member->high)
                        : json_object();
    if (member->defaulted)
        range = json_pack("{s[{si}o]}", "anyOf", "const", 0, range);
    json_object_set_new(range, "type", json_string("number"));
    return range;
}

static json_t *vector(const struct json_member *member)
{
    int size = (int)member->size;
    return json_pack("{sssosisi}", "type", "array", "items", number(member), "minItems", size,
                     "maxItems", size);
}

static json_t *array_of(json_t *items)
{
    return json_pack("{ssso}", "type", "array", "items", items);
}

static json_t *choice(const struct json_member *member)
{
    json_t *names = json_array();
    for (unsigned i = 0; i < member->size; i++)
        json_array_append_new(names, json_string(member->name_of(i)));
    return json_pack("{ssso}", "type", "string", "enum", names);
}

static json_t *overrides(const struct json_member *member)
{
    json_t *properties = json_object();
    for (unsigned i = 0; i < member->size; i++)
        json_object_set_new(properties, member->name_of(i), json_pack("{ss}", "type", "number"));
    return json_pack("{sssosb}", "type", "object", "properties", properties, "additionalProperties",
                     false);
}

static json_t *schema_of(const struct json_member *member, bool read)
{
    const struct json_member undefined = {.high = INFINITY};
    switch (member->kind) {
    case JSON_KIND_NUMBER:
        return number(member);
    case JSON_KIND_VECTOR:
        return vector(member);
    case JSON_KIND_TEXT:
        return json_pack("{sssi}", "type", "string", "maxLength", (int)member->size - 1);
    case JSON_KIND_OCTETS:
        return json_pack("{ssss}", "type", "string", "pattern", "^[0-9a-f]{32}$");
    case JSON_KIND_COUNT:
    case JSON_KIND_LONG_COUNT:
        return json_pack("{sssi}", "type", "integer", "minimum", 0);
    case JSON_KIND_FLAG:
        return json_pack("{ss}", "type", "boolean");
    case JSON_KIND_CHOICE:
        return choice(member);
    case JSON_KIND_OVERRIDES:
        return overrides(member);
    case JSON_KIND_OBJECT:
        return json_schema(member->members(), read);
    case JSON_KIND_LIST:
        return array_of(json_schema(member->members(), read));
    case JSON_KIND_TEXTS:
        return array_of(json_pack("{ss}", "type", "string"));
    case JSON_KIND_NUMBERS:
    case JSON_KIND_EDGES:
        return array_of(number(&undefined));
    case JSON_KIND_COUNTS:
        return array_of(json_pack("{sssi}", "type", "integer", "minimum", 0));
    }
    return NULL;
}

json_t *json_schema(const struct json_member *members, bool read)
{
    json_t *properties = json_object(), *required = json_array();
    for (; members->name; members++) {
        json_t *schema = schema_of(members, read);
        if (members->what[0])
            json_object_set_new(schema, "description", json_string(members->what));
        json_object_set_new(properties, members->name, schema);
        json_array_append_new(required, json_string(members->name));
    }
    if (!read)
        return json_pack("{sssoso}", "type", "object", "properties", properties, "required",
                         required);
    json_decref(required);
    return json_pack("{sssosb}", "type", "object", "properties", properties, "additionalProperties",
                     false);
}
