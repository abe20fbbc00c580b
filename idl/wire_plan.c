/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_plan.h"

#include <stdlib.h>

#include "wire_ops.h"

static bool put_struct(struct wire_plan *plan, const uint32_t *ops, uint32_t *first);

static bool put_list(struct wire_plan *plan, const uint32_t *ops, struct wire_step *step)
{
    struct wire_ops_list list = wire_ops_read_list(ops);
    step->kind = WIRE_LIST;
    step->bound = list.bound;
    step->size = (uint32_t)list.size;
    step->booleans = list.type == DDS_OP_VAL_BLN;
    if (list.elements) {
        step->element = WIRE_STRUCT;
        return put_struct(plan, list.elements, &step->inner);
    }
    step->element = list.type == DDS_OP_VAL_STR   ? WIRE_STRING
                    : list.type == DDS_OP_VAL_BST ? WIRE_TEXT
                                                  : WIRE_NUMBERS;
    return true;
}

/* The step of one member, and before it those of the structs in it. */
static bool put_member(struct wire_plan *plan, const uint32_t *ops, struct wire_step *step)
{
    enum dds_stream_typecode type = DDS_OP_TYPE(*ops);
    bool array = type == DDS_OP_VAL_ARR;
    *step = (struct wire_step){.offset = ops[1]};
    if (wire_ops_is_list(*ops))
        return put_list(plan, ops, step);
    if (type == DDS_OP_VAL_EXT) {
        step->kind = WIRE_STRUCT;
        return put_struct(plan, ops + DDS_OP_ADR_JSR(ops[2]), &step->inner);
    }
    if (type == DDS_OP_VAL_STR || type == DDS_OP_VAL_BST) {
        step->kind = type == DDS_OP_VAL_STR ? WIRE_STRING : WIRE_TEXT;
        step->size = type == DDS_OP_VAL_STR ? sizeof(char *) : ops[2];
        return true;
    }
    type = array ? DDS_OP_SUBTYPE(*ops) : type;
    step->kind = WIRE_NUMBERS;
    step->size = (uint32_t)wire_ops_number_size(type);
    step->count = array ? ops[2] : 1;
    step->booleans = type == DDS_OP_VAL_BLN;
    return true;
}

/* Whether numbers follow others of their size without a gap: then they are one step. */
static bool joins(struct wire_step *last, const struct wire_step *next)
{
    if (last->kind != WIRE_NUMBERS || next->kind != WIRE_NUMBERS || last->size != next->size ||
        last->booleans != next->booleans || last->offset + last->size * last->count != next->offset)
        return false;
    last->count += next->count;
    return true;
}

static bool append(struct wire_plan *plan, const struct wire_step *steps, uint32_t count)
{
    struct wire_step *grown = realloc(plan->steps, (plan->count + count) * sizeof *grown);
    if (!grown)
        return false;
    plan->steps = grown;
    for (uint32_t i = 0; i < count; i++)
        grown[plan->count++] = steps[i];
    return true;
}

/* The steps of one struct stand together, behind those of the structs in it. */
static bool put_struct(struct wire_plan *plan, const uint32_t *ops, uint32_t *first)
{
    enum { MOST = 64 };
    struct wire_step own[MOST + 1];
    uint32_t count = 0;
    if (DDS_OP(*ops) != DDS_OP_DLC)
        return false;
    for (ops++; *ops != DDS_OP_RTS; ops = wire_ops_next(ops)) {
        if (count == MOST || !wire_ops_are_known(ops) || !put_member(plan, ops, &own[count]))
            return false;
        count += count == 0 || !joins(&own[count - 1], &own[count]);
    }
    own[count] = (struct wire_step){.kind = WIRE_END};
    *first = plan->count;
    return append(plan, own, count + 1);
}

struct wire_plan *wire_plan_create(const uint32_t *ops)
{
    struct wire_plan *plan = calloc(1, sizeof *plan);
    if (plan && put_struct(plan, ops, &plan->first))
        return plan;
    wire_plan_free(plan);
    return NULL;
}

void wire_plan_free(struct wire_plan *plan)
{
    if (!plan)
        return;
    free(plan->steps);
    free(plan);
}
