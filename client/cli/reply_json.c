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

json_t *reply_to_json(const struct percuss_reply *reply)
{
    return json_object_of(reply_members(), reply);
}

json_t *reply_schema(void)
{
    return json_schema(reply_members(), false);
}
