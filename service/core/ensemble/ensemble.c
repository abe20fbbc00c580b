/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/ensemble.h"

void ensemble_values(const struct ensemble *ensemble, const double *point, uint64_t index,
                     double *values)
{
    const struct ensemble_spec *spec = &ensemble->spec;
    for (size_t i = 0; i < spec->input_count; i++) {
        const struct ensemble_input *input = &spec->inputs[i];
        bool listed = input->distribution == DISTRIBUTION_IS_LIST;
        values[i] = listed ? input->values[index % input->value_count] : input->first;
    }
    for (size_t d = 0; d < ensemble->sampling.dimensions; d++)
        values[ensemble->drawn[d]] = input_value(&spec->inputs[ensemble->drawn[d]], point[d]);
}

void ensemble_inputs(const struct ensemble *ensemble, uint64_t index, double *values)
{
    double point[SAMPLING_MAX_DIMENSIONS];
    sampling_point(&ensemble->sampling, index, point);
    copula_apply(&ensemble->copula, point);
    ensemble_values(ensemble, point, index, values);
}

void ensemble_release(struct ensemble *ensemble)
{
    copula_release(&ensemble->copula);
}
