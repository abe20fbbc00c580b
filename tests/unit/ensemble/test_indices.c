/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/ensemble/indices.c: Sobol indices of functions that have closed ones, and that
 * their intervals are honest: over many ensembles the nominal 95 % interval covers the truth as
 * often as it says. */
#include <string.h>

#include "check.h"
#include "ensemble/indices.h"
#include "ensemble/sampling.h"

enum { MOST_INPUTS = 3, MOST_SAMPLES = 2048 };

struct function {
    const char *name;
    double (*of)(const double u[MOST_INPUTS]);
    size_t inputs;
    double first[MOST_INPUTS], total[MOST_INPUTS];
};

/* Ishigami's function, x in (-pi, pi), a = 7, b = 0.1 (Saltelli et al. 2008). */
static double ishigami(const double u[MOST_INPUTS])
{
    double a = M_PI * (2.0 * u[0] - 1.0), b = M_PI * (2.0 * u[1] - 1.0);
    double c = M_PI * (2.0 * u[2] - 1.0);
    return sin(a) + 7.0 * sin(b) * sin(b) + 0.1 * c * c * c * c * sin(a);
}

/* Sobol's g-function with a = 0, 1, 4.5: V_i = 1/(3 (1 + a_i)^2), V = prod(1 + V_i) - 1, S_i =
 * V_i/V, T_i = V_i prod_{j != i}(1 + V_j)/V. */
static double g_function(const double u[MOST_INPUTS])
{
    static const double a[] = {0.0, 1.0, 4.5};
    double product = 1.0;
    for (int i = 0; i < 3; i++)
        product *= (fabs(4.0 * u[i] - 2.0) + a[i]) / (1.0 + a[i]);
    return product;
}

/* Without interactions: total and first-order indices are the same. */
static double additive(const double u[MOST_INPUTS])
{
    return sqrt(0.617) * u[0] + sqrt(0.383) * u[1];
}

/* With nothing else. */
static double product(const double u[MOST_INPUTS])
{
    return (u[0] - 0.5) * (u[1] - 0.5);
}

static const struct function functions[] = {
    {"ishigami", ishigami, 3, {0.31391, 0.44241, 0.0}, {0.55759, 0.44241, 0.24368}},
    {"g", g_function, 3, {0.72407, 0.18102, 0.02394}, {0.79305, 0.24402, 0.03457}},
    {"additive", additive, 2, {0.617, 0.383}, {0.617, 0.383}},
    {"product", product, 2, {0.0, 0.0}, {1.0, 1.0}},
};

/* An ensemble as the service makes them: half as many solutions more as there are samples. */
struct trial {
    struct sampling sampling;
    uint64_t count;
    size_t row_count;
    double x[MOST_INPUTS][MOST_SAMPLES], y[MOST_SAMPLES];
    struct indices_row rows[MOST_INPUTS][MOST_SAMPLES];
};

static void solve(struct trial *trial, const struct function *function, uint64_t seed)
{
    const struct sampling *sampling = &trial->sampling;
    const struct random_stream anew = {seed, STREAM_SUBSTITUTES};
    double u[MOST_INPUTS];
    for (uint64_t i = 0; i < trial->count; i++) {
        sampling_point(sampling, i, u);
        for (size_t d = 0; d < function->inputs; d++)
            trial->x[d][i] = u[d];
        trial->y[i] = function->of(u);
    }
    for (size_t d = 0; d < function->inputs; d++)
        for (size_t k = 0; k < trial->row_count; k++) {
            uint64_t replicates = sampling->replicates, replicate = k % replicates;
            uint64_t key = random_bits(&anew, replicate, 99);
            uint64_t within = random_permute(key, k / replicates, trial->count / replicates);
            uint64_t i = within * replicates + replicate;
            sampling_point(sampling, i, u);
            u[d] = random_uniform(&anew, i, d);
            trial->rows[d][k] = (struct indices_row){i, u[d], function->of(u)};
        }
}

static struct trial *make(const struct function *function, enum sampling_method method,
                          uint64_t count, uint64_t seed)
{
    struct fault fault;
    static struct trial trial;
    assert_int_equal(
        sampling_create(&trial.sampling, method, function->inputs, count, seed, &fault),
        PERCUSS_OK);
    trial.count = trial.sampling.count;
    trial.row_count = trial.count / (2 * function->inputs);
    solve(&trial, function, seed);
    return &trial;
}

static struct indices_data plain_data(const double *x, const double *y, size_t count)
{
    static struct indices_point sorted[MOST_SAMPLES];
    struct indices_data data = {.count = count, .sorted = sorted, .replicates = 1, .level = 0.95};
    assert_true(indices_sort(x, y, count, sorted, &data.kept));
    return data;
}

static struct indices find(const struct trial *trial, size_t dimension)
{
    struct indices indices;
    struct indices_data data = plain_data(trial->x[dimension], trial->y, trial->count);
    data.replicates = trial->sampling.replicates;
    data.row_count = trial->row_count;
    data.rows = trial->rows[dimension];
    assert_true(indices_find(&data, &indices));
    return indices;
}

static bool covers(const struct interval *interval, double value)
{
    return interval->low <= value + 1e-12 && value - 1e-12 <= interval->high;
}

/* What is wrong with any of many ensembles. */
static void check_order(const struct indices *indices)
{
    assert_true(indices->first_order <= indices->total);
    assert_true(covers(&indices->first_bounds, indices->first_order));
    assert_true(covers(&indices->total_bounds, indices->total));
    assert_true(indices->first_bounds.low >= 0.0 && indices->first_bounds.high <= 1.0);
    assert_true(indices->total_bounds.low >= 0.0 && indices->total_bounds.high <= 1.0);
}

enum { TRIALS = 240 };

/* How many of TRIALS ensembles must cover. Of exact 95 % intervals 215 do with all but 0.05 %
 * probability (228 -+ 3.4), of 90 % intervals 200. They are exact for many samples only: squares of
 * interactions have long tails, of which few rows see too little (Ishigami's x1: 42 rows of a
 * fourth power, 86 %), and Sobol replicates share the class means (88 % where the error is below
 * 0.005). */
static unsigned least(enum sampling_method method, uint64_t count)
{
    return count < 512 ? 194 : method == SAMPLING_IS_SOBOL ? 200 : 206;
}

static void cover(enum sampling_method method, uint64_t count)
{
    for (size_t f = 0; f < sizeof functions / sizeof *functions; f++) {
        const struct function *function = &functions[f];
        unsigned first[MOST_INPUTS] = {0}, total[MOST_INPUTS] = {0};
        for (uint64_t seed = 1; seed <= TRIALS; seed++) {
            const struct trial *trial = make(function, method, count, seed);
            for (size_t d = 0; d < function->inputs; d++) {
                struct indices indices = find(trial, d);
                check_order(&indices);
                first[d] += covers(&indices.first_bounds, function->first[d]);
                total[d] += covers(&indices.total_bounds, function->total[d]);
            }
        }
        for (size_t d = 0; d < function->inputs; d++) {
            if (getenv("PERCUSS_MEASURE"))
                print_message("    %s %s %u x%zu: first %u total %u of %d\n", function->name,
                              sampling_name(method), (unsigned)count, d + 1, first[d], total[d],
                              TRIALS);
            assert_in_range(first[d], least(method, count), TRIALS);
            assert_in_range(total[d], least(method, count), TRIALS);
        }
    }
}

static void plain_is_honest(void **state)
{
    (void)state;
    cover(SAMPLING_IS_PLAIN, 256);
    cover(SAMPLING_IS_PLAIN, 512);
    cover(SAMPLING_IS_PLAIN, 2048);
}

static void latin_hypercube_is_honest(void **state)
{
    (void)state;
    cover(SAMPLING_IS_LATIN_HYPERCUBE, 256);
    cover(SAMPLING_IS_LATIN_HYPERCUBE, 1024);
}

static void sobol_is_honest(void **state)
{
    (void)state;
    cover(SAMPLING_IS_SOBOL, 256);
    cover(SAMPLING_IS_SOBOL, 1024);
}

/* By itself the estimate of a total index from rows alone is as often below that of the first order
 * as above where there are no interactions (0.585 < 0.614 has been seen, the truth 0.617). With the
 * class means as control variate it is as good as the first order's. */
static void totals_use_all_samples(void **state)
{
    (void)state;
    double plain = 0.0, aided = 0.0;
    for (uint64_t seed = 1; seed <= TRIALS; seed++) {
        const struct trial *trial = make(&functions[2], SAMPLING_IS_PLAIN, 512, seed);
        double jansen = 0.0;
        for (size_t k = 0; k < trial->row_count; k++) {
            const struct indices_row *row = &trial->rows[0][k];
            jansen += pow(row->y - trial->y[row->sample], 2.0);
        }
        jansen *= 0.5 / (double)trial->row_count * 12.0; /* the variance is 1/12 */
        plain += pow(jansen - 0.617, 2.0);
        aided += pow(find(trial, 0).total - 0.617, 2.0);
    }
    /* 128 rows: 0.617 sqrt(1.4/128) = 0.065 (the square of a difference of two uniform numbers has
     * the variance 1.4 in units of its mean squared); 512 samples: about 0.02 */
    assert_true(sqrt(plain / TRIALS) > 0.055 && sqrt(plain / TRIALS) < 0.075);
    assert_true(sqrt(aided / TRIALS) < 0.025);
}

/* The third input does nothing: its index stays below the noise in 95 % of all ensembles, and its
 * total index is exactly nothing. */
static double without_third(const double u[MOST_INPUTS])
{
    return u[0] + 3.0 * u[0] * u[1];
}

static void noise_is_honest(void **state)
{
    (void)state;
    static const struct function function = {"no x3", without_third, 3, {0}, {0}};
    unsigned below = 0;
    for (uint64_t seed = 1; seed <= TRIALS; seed++) {
        const struct trial *trial = make(&function, SAMPLING_IS_PLAIN, 256, seed);
        struct indices alone, indices = find(trial, 2);
        const struct indices_data data = plain_data(trial->x[2], trial->y, trial->count);
        assert_true(indices_find(&data, &alone));
        assert_true(isnan(alone.total) && isnan(alone.total_bounds.low));
        below += alone.first_order <= alone.noise;
        assert_true(indices.total < 1e-9 && indices.first_order < 1e-9);
        assert_true(indices.total_bounds.high < 1e-9 && indices.first_bounds.high > 0.0);
    }
    /* 95 % of 240 with the deviation 3.4 */
    assert_in_range(below, 218, 238);
}

/* Samples of the same x are no neighbours: a list of three values explains what it explains. */
static double of_a_list(const double u[MOST_INPUTS])
{
    return floor(3.0 * u[0]) + 4.0 * u[1];
}

static void equal_values_are_one_class(void **state)
{
    (void)state;
    static const struct function function = {"list", of_a_list, 2, {0}, {0}};
    for (unsigned method = 0; method < SAMPLING_METHODS; method++) {
        struct trial *trial = make(&function, method, 2048, 3);
        for (uint64_t i = 0; i < trial->count; i++)
            trial->x[0][i] = floor(3.0 * trial->x[0][i]);
        for (size_t k = 0; k < trial->row_count; k++)
            trial->rows[0][k].x = floor(3.0 * trial->rows[0][k].x);
        struct indices indices = find(trial, 0);
        /* variances 2/3 and 16/12 */
        assert_true(covers(&indices.first_bounds, 1.0 / 3.0));
        assert_true(covers(&indices.total_bounds, 1.0 / 3.0));
        assert_true(indices.first_bounds.high - indices.first_bounds.low < 0.15);
    }
}

/* 16 periods in the range of x1: resolved by samples that are dense enough; where a class is a
 * quarter of a period wide the interval knows that it is not. */
static double rough(const double u[MOST_INPUTS])
{
    return sin(100.0 * u[0]) + u[1];
}

static void rough_functions_are_resolved(void **state)
{
    (void)state;
    static const struct function function = {"rough", rough, 2, {0}, {0}};
    /* of the sine the mean square is 0.5 - sin(200)/400, the mean (1 - cos 100)/100 */
    double sine = 0.5 - sin(200.0) / 400.0 - pow((1.0 - cos(100.0)) / 100.0, 2.0);
    double first = sine / (sine + 1.0 / 12.0);
    struct indices coarse = find(make(&function, SAMPLING_IS_PLAIN, 512, 1), 0);
    struct indices fine = find(make(&function, SAMPLING_IS_PLAIN, 2048, 1), 0);
    if (getenv("PERCUSS_MEASURE"))
        print_message("    rough: %g, at most %g; %g; truth %g\n", coarse.first_order,
                      coarse.first_bounds.high, fine.first_order, first);
    assert_true(coarse.first_order < first - 0.03 && covers(&coarse.first_bounds, first));
    assert_true(fabs(fine.first_order - first) < 0.02 && covers(&fine.first_bounds, first));
}

static void too_few_say_nothing(void **state)
{
    (void)state;
    const double x[20] = {0.0}, y[20] = {1.0}, some[20] = {1.0, 2.0, NAN, 4.0};
    struct indices indices;
    struct indices_data data = plain_data(some, some, 4);
    assert_true(indices_find(&data, &indices));
    assert_true(isnan(indices.first_order) && isnan(indices.total) && isnan(indices.noise));
    data = plain_data(x, y, 20);
    assert_true(indices_find(&data, &indices));
    assert_true(isnan(indices.first_order) && isnan(indices.first_bounds.high));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_is_honest),
        cmocka_unit_test(latin_hypercube_is_honest),
        cmocka_unit_test(sobol_is_honest),
        cmocka_unit_test(totals_use_all_samples),
        cmocka_unit_test(noise_is_honest),
        cmocka_unit_test(equal_values_are_one_class),
        cmocka_unit_test(rough_functions_are_resolved),
        cmocka_unit_test(too_few_say_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
