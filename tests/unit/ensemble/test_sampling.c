/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/ensemble/sampling.c: points are functions of their index, strata are
 * hit once, Sobol's nets are nets. */
#include <string.h>

#include "check.h"
#include "ensemble/ensemble.h"

static struct sampling make(enum sampling_method method, size_t dimensions, uint64_t count)
{
    struct sampling sampling;
    struct fault fault;
    assert_int_equal(sampling_create(&sampling, method, dimensions, count, 7, &fault), PERCUSS_OK);
    return sampling;
}

static void points_are_functions_of_their_index(void **state)
{
    (void)state;
    for (unsigned method = 0; method < SAMPLING_METHODS; method++) {
        struct sampling sampling = make(method, 3, 100);
        double forth[100][3], back[3];
        for (uint64_t i = 0; i < 100; i++)
            sampling_point(&sampling, i, forth[i]);
        for (uint64_t i = 100; i-- > 0;) {
            sampling_point(&sampling, i, back);
            assert_memory_equal(back, forth[i], sizeof back);
            for (int d = 0; d < 3; d++)
                assert_true(back[d] > 0.0 && back[d] < 1.0);
        }
    }
}

/* Each replicate has one point in each of its strata, in every dimension. */
static void latin_hypercubes_are_stratified(void **state)
{
    (void)state;
    struct sampling sampling = make(SAMPLING_IS_LATIN_HYPERCUBE, 2, 1000);
    assert_int_equal(sampling.count, 1008);
    uint64_t size = sampling.count / SAMPLING_REPLICATES;
    for (uint64_t r = 0; r < SAMPLING_REPLICATES; r++) {
        unsigned hits[2][63] = {{0}};
        for (uint64_t i = r; i < sampling.count; i += SAMPLING_REPLICATES) {
            double point[2];
            sampling_point(&sampling, i, point);
            for (int d = 0; d < 2; d++)
                hits[d][(size_t)(point[d] * (double)size)]++;
        }
        for (uint64_t k = 0; k < size; k++)
            assert_true(hits[0][k] == 1 && hits[1][k] == 1);
    }
}

/* Every aligned block of 2^k points has one in each interval of length 2^-k: the direction numbers
 * are odd and scrambling keeps this. */
static void sobol_is_a_net_in_each_dimension(void **state)
{
    (void)state;
    struct sampling sampling = make(SAMPLING_IS_SOBOL, SOBOL_DIMENSIONS, 256 * SAMPLING_REPLICATES);
    for (size_t d = 0; d < SOBOL_DIMENSIONS; d++) {
        for (uint64_t block = 0; block < 256; block += 64) {
            unsigned hits[64] = {0};
            for (uint64_t j = block; j < block + 64; j++) {
                double point[SOBOL_DIMENSIONS];
                sampling_point(&sampling, j * SAMPLING_REPLICATES + 5, point);
                hits[(size_t)(point[d] * 64.0)]++;
            }
            for (int k = 0; k < 64; k++)
                assert_int_equal(hits[k], 1);
        }
    }
}

/* The first two dimensions are a (0, 2)-sequence: any elementary rectangle has its share. */
static void sobol_is_a_net_in_two_dimensions(void **state)
{
    (void)state;
    struct sobol_directions x = sobol_directions(0), y = sobol_directions(1);
    for (unsigned split = 0; split <= 6; split++) {
        unsigned hits[64] = {0};
        for (uint64_t i = 0; i < 64; i++) {
            uint64_t a = (uint64_t)sobol_point(&x, i) >> (32 - split);
            uint64_t b = (uint64_t)sobol_point(&y, i) >> (32 - (6 - split));
            hits[a << (6 - split) | b]++;
        }
        for (int k = 0; k < 64; k++)
            assert_int_equal(hits[k], 1);
    }
}

/* Sobol's property A, which Joe and Kuo's numbers have: of the first 2^d points of d dimensions one
 * lies in each of the 2^d halves-by-halves. The leading bits of the directions are independent. */
static void sobol_has_property_a(void **state)
{
    (void)state;
    for (unsigned dimensions = 1; dimensions <= SOBOL_DIMENSIONS; dimensions++) {
        uint32_t rows[SOBOL_DIMENSIONS];
        for (unsigned d = 0; d < dimensions; d++) {
            struct sobol_directions directions = sobol_directions(d);
            rows[d] = 0;
            for (unsigned k = 0; k < dimensions; k++)
                rows[d] |= (directions.bit[k] >> 31) << k;
        }
        /* elimination over GF(2) */
        unsigned rank = 0;
        for (unsigned column = 0; column < dimensions; column++) {
            unsigned pivot = rank;
            while (pivot < dimensions && !(rows[pivot] >> column & 1))
                pivot++;
            if (pivot == dimensions)
                continue;
            uint32_t row = rows[pivot];
            rows[pivot] = rows[rank];
            rows[rank] = row;
            for (unsigned d = 0; d < dimensions; d++)
                if (d != rank && rows[d] >> column & 1)
                    rows[d] ^= row;
            rank++;
        }
        assert_int_equal(rank, dimensions);
    }
}

/* Error of the mean of a smooth function of six variables, mean 1: over all replicates far below
 * plain sampling's. */
static double mean_error(enum sampling_method method)
{
    struct sampling sampling = make(method, 6, 4096);
    double sum = 0.0;
    for (uint64_t i = 0; i < sampling.count; i++) {
        double point[6], product = 1.0;
        sampling_point(&sampling, i, point);
        for (int d = 0; d < 6; d++)
            product *= 1.0 + (point[d] - 0.5) / (d + 1.0);
        sum += product;
    }
    return fabs(sum / (double)sampling.count - 1.0);
}

static void better_points_have_smaller_errors(void **state)
{
    (void)state;
    /* deviation of the function 0.37, of its mean over 4096 plain points 0.0058 */
    assert_true(mean_error(SAMPLING_IS_PLAIN) < 0.02);
    assert_true(mean_error(SAMPLING_IS_LATIN_HYPERCUBE) < 0.004);
    assert_true(mean_error(SAMPLING_IS_SOBOL) < 0.002);
}

static void refuses_too_many_dimensions(void **state)
{
    (void)state;
    struct sampling sampling;
    struct fault fault;
    assert_int_equal(sampling_create(&sampling, SAMPLING_IS_SOBOL, 17, 10, 1, &fault),
                     PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "17 inputs"));
}

/* Drawn ones, a constant and a list, independent and correlated. */
static void one_input_is_that_of_all(void **state)
{
    (void)state;
    static const double list[] = {3.0, 1.0, 2.0};
    struct ensemble_input inputs[] = {
        {.distribution = DISTRIBUTION_IS_UNIFORM, .first = 1.0, .second = 2.0},
        {.distribution = DISTRIBUTION_IS_CONSTANT, .first = 5.0},
        {.distribution = DISTRIBUTION_IS_LIST, .values = list, .value_count = 3},
        {.distribution = DISTRIBUTION_IS_UNIFORM, .first = -2.0, .second = -1.0},
    };
    const struct copula_pair pair = {0, 1, 0.7};
    for (unsigned method = 0; method < 2 * SAMPLING_METHODS; method++) {
        struct fault fault;
        struct ensemble ensemble = {.spec = {.inputs = inputs, .input_count = 4},
                                    .sampling = make(method / 2, 2, 100),
                                    .drawn = {3, 0}};
        assert_int_equal(copula_create(&ensemble.copula, 2, &pair, method % 2, &fault), PERCUSS_OK);
        for (uint64_t i = 0; i < 100; i++) {
            double values[4];
            ensemble_inputs(&ensemble, i, values);
            assert_true(values[1] == 5.0 && values[2] == list[i % 3]);
            for (size_t k = 0; k < 4; k++)
                assert_true(ensemble_input(&ensemble, i, k) == values[k]);
        }
        ensemble_release(&ensemble);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_are_functions_of_their_index),
        cmocka_unit_test(latin_hypercubes_are_stratified),
        cmocka_unit_test(sobol_is_a_net_in_each_dimension),
        cmocka_unit_test(sobol_is_a_net_in_two_dimensions),
        cmocka_unit_test(sobol_has_property_a),
        cmocka_unit_test(better_points_have_smaller_errors),
        cmocka_unit_test(refuses_too_many_dimensions),
        cmocka_unit_test(one_input_is_that_of_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
