/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reply_json.h"

#include "json_schema.h"

JSON_TABLE(sub_impact, PERCUSS_SUB_IMPACT_FIELDS)
JSON_TABLE(contact_result, PERCUSS_CONTACT_RESULT_FIELDS)
JSON_TABLE(body_velocity, PERCUSS_BODY_VELOCITY_FIELDS)
JSON_TABLE(body_state, PERCUSS_BODY_STATE_FIELDS)
JSON_TABLE(body_energy, PERCUSS_BODY_ENERGY_FIELDS)
JSON_TABLE(energy, PERCUSS_ENERGY_FIELDS)
JSON_TABLE(error_estimate, PERCUSS_ERROR_FIELDS)
JSON_TABLE(body_model, PERCUSS_BODY_MODEL_FIELDS)
JSON_TABLE(model, PERCUSS_MODEL_FIELDS)
JSON_TABLE(timing, PERCUSS_TIMING_FIELDS)

#define ALL_FIELDS(F, L) PERCUSS_HEAD_FIELDS(F) PERCUSS_REPLY_FIELDS(F, L)
JSON_TABLE(reply, ALL_FIELDS)

/* All that is known to be wrong stands before its parts. False: out of memory. */
static bool lead_with_total(json_t *reply)
{
    static const char *const first[] = {"restitution_total", "total_met"};
    json_t *error = json_object_get(reply, "error");
    json_t *ordered = json_object();
    bool good = error && ordered;
    for (size_t i = 0; good && i < sizeof first / sizeof first[0]; i++)
        good = json_object_set(ordered, first[i], json_object_get(error, first[i])) == 0;
    const char *key;
    json_t *value;
    json_object_foreach(error, key, value)
    {
        bool there = json_object_get(ordered, key);
        good = good && (there || json_object_set(ordered, key, value) == 0);
    }
    good = good && json_object_set(reply, "error", ordered) == 0;
    json_decref(ordered);
    return good;
}

json_t *reply_to_json(const struct percuss_reply *reply)
{
    json_t *object = json_object_of(reply_members(), reply);
    if (object && lead_with_total(object))
        return object;
    json_decref(object);
    return NULL;
}

json_t *reply_schema(void)
{
    return json_schema(reply_members(), false);
}
