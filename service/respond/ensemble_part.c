/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "respond/ensemble_part.h"

#include <stdlib.h>

#include "ensemble/extras.h"
#include "respond/ensemble_prepare.h"

struct ensemble_part {
    const struct ensemble_question *question;
    struct ensemble_prepared prepared;
    struct ensemble_worker *worker;
};

enum percuss_status ensemble_part_create(const struct ensemble_means *means,
                                         const struct ensemble_question *question,
                                         struct ensemble_part **part, struct fault *fault)
{
    struct ensemble_part *created = calloc(1, sizeof *created);
    *part = NULL;
    if (!created)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    created->question = question;
    enum percuss_status status = ensemble_prepare(&created->prepared, means, question, NULL, fault);
    if (!status)
        status = ensemble_worker_create(&created->worker, &created->prepared.ensemble, NULL, fault);
    if (status)
        ensemble_part_free(created);
    else
        *part = created;
    return status;
}

void ensemble_part_free(struct ensemble_part *part)
{
    if (!part)
        return;
    ensemble_worker_free(part->worker);
    ensemble_prepared_release(&part->prepared);
    free(part);
}

struct digest ensemble_part_digest(const struct ensemble_part *part)
{
    return ensemble_prepared_digest(&part->prepared, part->question);
}

uint64_t ensemble_part_items(const struct ensemble_part *part, bool extras, uint64_t done)
{
    const struct ensemble *ensemble = &part->prepared.ensemble;
    if (!extras)
        return ensemble->count;
    return done > 0 && done <= ensemble->count ? ensemble_extras(ensemble, done) : 0;
}

void ensemble_part_solve(struct ensemble_part *part, const struct ensemble_range *range,
                         void *items)
{
    struct ensemble_sample *samples = items;
    struct ensemble_extra *extras = items;
    for (uint64_t i = range->first; i < range->end; i++) {
        if (range->extras)
            extras[i - range->first] = ensemble_extra(part->worker, range->done, i);
        else
            ensemble_solve(part->worker, i, &samples[i - range->first], NULL);
    }
}
