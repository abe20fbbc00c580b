/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble_output.h"
#include "json_schema.h"
#include "json_writer.h"

JSON_TABLE(statistic, PERCUSS_STATISTIC_FIELDS)
JSON_TABLE(input_part, PERCUSS_INPUT_PART_FIELDS)
JSON_TABLE(sensitivity, PERCUSS_SENSITIVITY_FIELDS)
JSON_TABLE(sigma_interval, PERCUSS_SIGMA_INTERVAL_FIELDS)
JSON_TABLE(beta_fit, PERCUSS_BETA_FIT_FIELDS)
JSON_TABLE(ensemble_check, PERCUSS_ENSEMBLE_CHECK_FIELDS)
JSON_TABLE(timing, PERCUSS_TIMING_FIELDS)

#define ALL_FIELDS(F, L) PERCUSS_HEAD_FIELDS(F) PERCUSS_ENSEMBLE_REPLY_FIELDS(F, L)
JSON_TABLE(ensemble_reply, ALL_FIELDS)

json_t *ensemble_to_json(const struct percuss_ensemble_reply *reply)
{
    return json_object_of(ensemble_reply_members(), reply);
}

json_t *ensemble_schema(void)
{
    return json_schema(ensemble_reply_members(), false);
}
