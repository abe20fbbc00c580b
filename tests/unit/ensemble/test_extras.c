/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/ensemble/extras.c: the samples that are looked at again stand for all. */
#include "check.h"
#include "ensemble/extras.h"

/* Two inputs, nothing else. */
static struct ensemble *make(enum sampling_method method, uint64_t count)
{
    struct fault fault;
    struct ensemble *ensemble = calloc(1, sizeof *ensemble);
    assert_non_null(ensemble);
    ensemble->spec.seed = 5;
    assert_int_equal(sampling_create(&ensemble->sampling, method, 2, count, 5, &fault), PERCUSS_OK);
    ensemble->count = ensemble->sampling.count;
    return ensemble;
}

/* Numbers of samples at which every so manieth one would lie in a part of the cube, or in a single
 * replicate. */
static void chosen_ones_are_spread(void **state)
{
    (void)state;
    static const uint64_t counts[] = {3200, 6400, 25600, 1003};
    for (unsigned method = 0; method < SAMPLING_METHODS; method++)
        for (int c = 0; c < 4; c++) {
            struct ensemble *ensemble = make(method, counts[c]);
            uint64_t done = ensemble->count;
            unsigned quarters[2][4] = {{0}}, replicates[SAMPLING_REPLICATES] = {0};
            bool *taken = calloc(done, sizeof *taken);
            for (uint64_t k = 0; k < 192; k++) {
                double point[2];
                struct ensemble_extra_place place = ensemble_extra_place(ensemble, done, k);
                assert_true(place.dimension == SIZE_MAX && place.sample < done);
                assert_false(taken[place.sample]);
                taken[place.sample] = true;
                sampling_point(&ensemble->sampling, place.sample, point);
                for (int d = 0; d < 2; d++)
                    quarters[d][(int)(4.0 * point[d])]++;
                replicates[place.sample % ensemble->sampling.replicates]++;
            }
            for (int q = 0; q < 8; q++) /* 48 -+ 6 of each at random */
                assert_in_range(quarters[q / 4][q % 4], 24, 72);
            for (uint64_t r = 0; r < ensemble->sampling.replicates; r++)
                assert_int_equal(replicates[r], 192 / ensemble->sampling.replicates);
            free(taken);
            free(ensemble);
        }
}

/* The same samples with each input drawn anew, one after the other. */
static void substitutes_belong_to_samples(void **state)
{
    (void)state;
    struct ensemble *ensemble = make(SAMPLING_IS_SOBOL, 1600);
    uint64_t count = ensemble_extras(ensemble, 1600), each = (count - 200) / 2;
    assert_int_equal(each, 400);
    for (uint64_t k = 0; k < each; k++) {
        struct ensemble_extra_place one = ensemble_extra_place(ensemble, 1600, 200 + k);
        struct ensemble_extra_place two = ensemble_extra_place(ensemble, 1600, 200 + each + k);
        assert_true(one.dimension == 0 && two.dimension == 1 && one.sample == two.sample);
    }
    free(ensemble);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chosen_ones_are_spread),
        cmocka_unit_test(substitutes_belong_to_samples),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
