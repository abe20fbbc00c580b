/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Many impacts with uncertain inputs. */
#ifndef PERCUSS_ENSEMBLE_H
#define PERCUSS_ENSEMBLE_H

#include <percuss/ensemble_reply.h>
#include <percuss/ensemble_request.h>

#ifdef __cplusplus
extern "C" {
#endif

struct percuss_client;

/* An empty request with default options and 1000 plain samples. */
PERCUSS_API void percuss_ensemble_request_init(struct percuss_ensemble_request *request);

/* Told of progress a few times a second, in the calling thread, and of all samples that the reply
 * is of. False cancels: the reply then has the results so far. */
typedef bool percuss_progress_function(void *context,
                                       const struct percuss_ensemble_progress *progress);

/* Asks and waits as long as there is progress at least every `timeout` seconds. `progress` NULL:
 * none is reported. The reply is to be freed after OK. One ensemble at a time on one client. */
PERCUSS_API enum percuss_result percuss_solve_ensemble(
    struct percuss_client *client, const struct percuss_ensemble_request *request, double timeout,
    percuss_progress_function *progress, void *context, struct percuss_ensemble_reply *reply);

/* Releases the arrays and empties the reply; NULL is allowed. */
PERCUSS_API void percuss_ensemble_reply_free(struct percuss_ensemble_reply *reply);

/* As percuss_status_name. */
PERCUSS_API const char *percuss_distribution_name(unsigned distribution);
PERCUSS_API const char *percuss_sampling_name(unsigned sampling);

#ifdef __cplusplus
}
#endif

#endif
