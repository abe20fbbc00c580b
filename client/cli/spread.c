/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spread.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli.h"

/* Sixteen replicates of 32 points tell the deviation to a few per cent, within some 20 ms. */
enum { SAMPLES = 512 };

enum percuss_result spread_ask(struct percuss_client *client, const struct percuss_request *request,
                               double speed, double deviation, double timeout,
                               struct percuss_ensemble_reply *reply)
{
    struct percuss_ensemble_request *ensemble = malloc(sizeof *ensemble);
    *reply = (struct percuss_ensemble_reply){0};
    if (!ensemble)
        return PERCUSS_RESULT_NO_MEMORY;
    /* the same scene at speeds that are distributed normally */
    percuss_ensemble_request_init(ensemble);
    ensemble->scene = *request;
    ensemble->samples = SAMPLES;
    ensemble->sampling = PERCUSS_SAMPLING_SOBOL;
    ensemble->input_count = 1;
    ensemble->inputs[0] = (struct percuss_input){
        .name = "speed",
        .distribution = PERCUSS_DISTRIBUTION_NORMAL,
        .first = speed,
        .second = deviation,
        .lower = NAN,
        .upper = NAN,
    };
    enum percuss_result result =
        percuss_solve_ensemble(client, ensemble, timeout, NULL, NULL, reply);
    free(ensemble);
    return result;
}

void spread_print(double deviation, const struct percuss_ensemble_reply *reply)
{
    if (reply->statistic_count == 0) {
        complain("%s: %s", percuss_status_name(reply->status), reply->message);
        return;
    }
    const struct percuss_statistic *e = &reply->statistics[0];
    size_t last = e->quantile_count - 1;
    printf("\n  with the speed known to -+ %g m/s\n", deviation);
    printf("  restitution  %.4f -+ %.4f", e->mean, e->standard_deviation);
    if (e->quantile_count > 1)
        printf(", %g %% of it between %.4f and %.4f",
               100.0 * (e->probabilities[last] - e->probabilities[0]), e->quantiles[0],
               e->quantiles[last]);
    printf("\n");
    for (size_t i = 0; i < reply->warning_count; i++)
        complain("warning: %s", reply->warnings[i]);
}
