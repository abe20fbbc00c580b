/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "respond/ensemble_prepare.h"

#include <stdlib.h>

#include "ensemble/create.h"
#include "ensemble/extras.h"
#include "exchange/question.h"

enum percuss_status ensemble_prepare(struct ensemble_prepared *prepared,
                                     const struct ensemble_means *means,
                                     const struct ensemble_question *question,
                                     const struct watch *watch, struct fault *fault)
{
    const percuss_v1_EnsembleRequest *request = question->request;
    if (request->samples > means->most_samples)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "samples: %llu: must be at most %u, as the server's limits.samples says",
                         (unsigned long long)request->samples, means->most_samples);
    prepared->decoded = calloc(1, sizeof *prepared->decoded);
    if (!prepared->decoded)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_status status = decode_ensemble(request, prepared->decoded, fault);
    if (status)
        return status;
    /* as for a single request: tables that are insisted on are computed when the impact as it is
     * stated is tried; no input changes a material, so that the workers only look them up */
    table_maker_init(&prepared->maker, &means->tables, means->limit);
    prepared->decoded->spec.catalogue = means->snapshot->set;
    prepared->decoded->spec.tables =
        table_maker_begin(&prepared->maker, means->snapshot->tables, &request->scene,
                          question->envelope.client, question->arrival);
    status = ensemble_create(&prepared->ensemble, &prepared->decoded->spec, watch, fault);
    /* why it was given up */
    if (prepared->maker.status)
        return fault_set(fault, prepared->maker.status, "%s", prepared->maker.fault.text);
    /* computing a table is for a single thread */
    table_maker_only_finds(&prepared->maker);
    return status;
}

void ensemble_prepared_release(struct ensemble_prepared *prepared)
{
    ensemble_release(&prepared->ensemble);
    free(prepared->decoded);
}

struct digest ensemble_prepared_digest(const struct ensemble_prepared *prepared,
                                       const struct ensemble_question *question)
{
    struct hasher hasher = {0};
    const struct ensemble_model *model = &prepared->ensemble.model;
    struct digest asked = question_digest_ensemble(question->request);
    hash_bytes(&hasher, &asked, sizeof asked);
    hash_text(&hasher, question->envelope.revision);
    hash_text(&hasher, question->envelope.version);
    hash_number(&hasher, prepared->ensemble.count);
    hash_number(&hasher, model->pilots);
    hash_number(&hasher, model->agreeing);
    hash_bytes(&hasher, &model->tolerance, sizeof model->tolerance);
    hash_bytes(&hasher, &model->model.cut, sizeof model->model.cut);
    hash_bytes(&hasher, &model->model.accuracy, sizeof model->model.accuracy);
    hash_number(&hasher, sizeof(struct ensemble_sample));
    hash_number(&hasher, sizeof(struct ensemble_extra));
    return hash_digest(&hasher);
}
