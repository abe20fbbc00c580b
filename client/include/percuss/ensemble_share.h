/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* An ensemble shared among processes and machines, by libpercuss-local in each. Sample i is a
 * function of the request and of i alone: the reply is the same to the byte, for any division of
 * the samples among processes, as long as all have the same catalogue and the same build of the
 * library.
 *
 * One process asks, with percuss_solve_ensemble_shared, and is told which ranges of items are
 * wanted. Others solve them: percuss_ensemble_worker_create with the same request, then
 * percuss_ensemble_worker_solve. Solved parts travel as octets, by any means. */
#ifndef PERCUSS_ENSEMBLE_SHARE_H
#define PERCUSS_ENSEMBLE_SHARE_H

#include <percuss/ensemble.h>

#ifdef __cplusplus
extern "C" {
#endif

struct percuss_client; /* of percuss_local_open */

/* Items first .. first + count - 1: samples, or the extra solutions that belong to `done` samples.
 */
struct percuss_ensemble_range {
    uint64_t first, count;
    bool extras;
    uint64_t done; /* of extras */
};

/* Octets of the part that holds a range. */
PERCUSS_API size_t percuss_ensemble_part_size(const struct percuss_ensemble_range *range);

struct percuss_ensemble_worker;

/* Prepares the request, which must stay as long as the worker, as must the client; one thread at a
 * time. INVALID_ARGUMENT where the ensemble is refused, with the reason. The caller frees it. */
PERCUSS_API enum percuss_result
percuss_ensemble_worker_create(struct percuss_client *client,
                               const struct percuss_ensemble_request *request,
                               struct percuss_ensemble_worker **worker);
PERCUSS_API void percuss_ensemble_worker_free(struct percuss_ensemble_worker *worker);

/* Solves a range and writes the part, percuss_ensemble_part_size octets. INVALID_ARGUMENT: this
 * ensemble has no such range. */
PERCUSS_API enum percuss_result
percuss_ensemble_worker_solve(struct percuss_ensemble_worker *worker,
                              const struct percuss_ensemble_range *range, void *part);

/* An ensemble that is being asked for. */
struct percuss_ensemble_sharing;

/* Has the range solved, whole or in any pieces and in any order, and hands over every piece with
 * percuss_ensemble_take, in the calling thread. Samples missing when it returns cut the ensemble
 * short. */
typedef void percuss_share_function(void *context, struct percuss_ensemble_sharing *sharing,
                                    const struct percuss_ensemble_range *range);

/* Takes a piece, of `size` octets. OK; PENDING: taken, but no more are wanted, since progress was
 * told to cancel; INVALID_ARGUMENT: no part of this ensemble (another request, catalogue or
 * version), damaged on its way, or not of the range that is asked for. */
PERCUSS_API enum percuss_result percuss_ensemble_take(struct percuss_ensemble_sharing *sharing,
                                                      const void *part, size_t size);

/* As percuss_solve_ensemble, with the samples solved through `share`; `progress` may be NULL here,
 * too. */
PERCUSS_API enum percuss_result
percuss_solve_ensemble_shared(struct percuss_client *client,
                              const struct percuss_ensemble_request *request,
                              percuss_share_function *share, percuss_progress_function *progress,
                              void *context, struct percuss_ensemble_reply *reply);

#ifdef __cplusplus
}
#endif

#endif
