/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Specimens in this process: none without a store. */

#include "error.h"
#include "library.h"
#include "moment.h"

enum percuss_result local_specimens(struct percuss_client *client, double timeout,
                                    struct percuss_specimen_list *list)
{
    double deadline;
    (void)client;
    *list = (struct percuss_specimen_list){0};
    return moment_deadline(timeout, &deadline);
}

enum percuss_result local_clear_specimen(struct percuss_client *client, const char *name,
                                         double timeout)
{
    double deadline;
    enum percuss_result result = moment_deadline(timeout, &deadline);
    (void)client;
    return result ? result
                  : error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                              "specimen: %.63s: the server keeps none of that name", name);
}
