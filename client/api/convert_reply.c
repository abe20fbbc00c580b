/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "convert.h"
#include "convert_members.h"
#include "error.h"

CONVERTER(sub_impact, SubImpact, PERCUSS_SUB_IMPACT_FIELDS)
CONVERTER(contact_result, ContactResult, PERCUSS_CONTACT_RESULT_FIELDS)
CONVERTER(body_velocity, BodyVelocity, PERCUSS_BODY_VELOCITY_FIELDS)
CONVERTER(body_state, BodyState, PERCUSS_BODY_STATE_FIELDS)
CONVERTER(body_energy, BodyEnergy, PERCUSS_BODY_ENERGY_FIELDS)
CONVERTER(energy, Energy, PERCUSS_ENERGY_FIELDS)
CONVERTER(error_estimate, ErrorEstimate, PERCUSS_ERROR_FIELDS)
CONVERTER(body_model, BodyModel, PERCUSS_BODY_MODEL_FIELDS)
CONVERTER(model, Model, PERCUSS_MODEL_FIELDS)
CONVERTER(timing, Timing, PERCUSS_TIMING_FIELDS)

enum percuss_result convert_reply(const percuss_v1_Reply *from, struct percuss_reply *to)
{
    struct storage all = {0}, *storage = &all;
    *to = (struct percuss_reply){0};
    PERCUSS_HEAD_FIELDS(PERCUSS_COPY)
    PERCUSS_REPLY_FIELDS(PERCUSS_COPY, CONVERT)
    to->storage = all.blocks;
    if (!all.failed)
        return PERCUSS_RESULT_OK;
    percuss_reply_free(to);
    return error_set(PERCUSS_RESULT_NO_MEMORY, "a reply");
}

void percuss_reply_free(struct percuss_reply *reply)
{
    if (!reply)
        return;
    storage_free(reply->storage);
    *reply = (struct percuss_reply){0};
}
