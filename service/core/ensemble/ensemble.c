/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/ensemble.h"

/* Of an input that is not drawn. */
static double stated_value(const struct ensemble_input *input, uint64_t index)
{
    bool listed = input->distribution == DISTRIBUTION_IS_LIST;
    return listed ? input->values[index % input->value_count] : input->first;
}

void ensemble_values(const struct ensemble *ensemble, const double *point, uint64_t index,
                     double *values)
{
    const struct ensemble_spec *spec = &ensemble->spec;
    for (size_t i = 0; i < spec->input_count; i++)
        values[i] = stated_value(&spec->inputs[i], index);
    for (size_t d = 0; d < ensemble->sampling.dimensions; d++)
        values[ensemble->drawn[d]] = input_value(&spec->inputs[ensemble->drawn[d]], point[d]);
}

/* Point `index`, with the correlation. */
static void find_point(const struct ensemble *ensemble, uint64_t index, double *point)
{
    sampling_point(&ensemble->sampling, index, point);
    copula_apply(&ensemble->copula, point);
}

void ensemble_inputs(const struct ensemble *ensemble, uint64_t index, double *values)
{
    double point[SAMPLING_MAX_DIMENSIONS];
    find_point(ensemble, index, point);
    ensemble_values(ensemble, point, index, values);
}

double ensemble_input(const struct ensemble *ensemble, uint64_t index, size_t input)
{
    const struct sampling *sampling = &ensemble->sampling;
    size_t d = 0;
    while (d < sampling->dimensions && ensemble->drawn[d] != input)
        d++;
    if (d == sampling->dimensions)
        return stated_value(&ensemble->spec.inputs[input], index);
    /* independent coordinates are computed alone */
    double point[SAMPLING_MAX_DIMENSIONS];
    if (ensemble->copula.factor)
        find_point(ensemble, index, point);
    else
        point[d] = sampling_coordinate(sampling, index, d);
    return input_value(&ensemble->spec.inputs[input], point[d]);
}

void ensemble_release(struct ensemble *ensemble)
{
    copula_release(&ensemble->copula);
}
