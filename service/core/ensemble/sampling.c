/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/sampling.h"

#include <math.h>
#include <stdlib.h>

#include "numeric/special.h"

/* Degree and inner coefficients of the primitive polynomial, and the first direction numbers m_i;
 * dimension 0 is van der Corput's sequence. */
static const struct {
    unsigned degree, inner;
    uint32_t m[6];
} table[SOBOL_DIMENSIONS] = {
    {0, 0, {0}},
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
};

struct sobol_directions sobol_directions(unsigned dimension)
{
    struct sobol_directions directions;
    unsigned degree = table[dimension].degree;
    for (unsigned i = 0; i < SOBOL_BITS; i++) {
        /* van der Corput, the numbers that are given, or those that follow */
        if (degree == 0) {
            directions.bit[i] = UINT32_C(1) << (SOBOL_BITS - 1 - i);
        } else if (i < degree) {
            directions.bit[i] = table[dimension].m[i] << (SOBOL_BITS - 1 - i);
        } else {
            /* Joe and Kuo 2008, degree s, inner coefficients a:
             * v_i = a_1 v_(i-1) ^ ... ^ a_(s-1) v_(i-s+1) ^ v_(i-s) ^ (v_(i-s) >> s) */
            uint32_t v = directions.bit[i - degree];
            v ^= v >> degree;
            for (unsigned k = 1; k < degree; k++)
                if (table[dimension].inner >> (degree - 1 - k) & 1)
                    v ^= directions.bit[i - k];
            directions.bit[i] = v;
        }
    }
    return directions;
}

uint32_t sobol_point(const struct sobol_directions *directions, uint64_t index)
{
    uint32_t point = 0;
    for (unsigned i = 0; i < SOBOL_BITS && index >> i; i++)
        if (index >> i & 1)
            point ^= directions->bit[i];
    return point;
}

/* Indices of the random numbers that belong to a whole replicate: no point has them. */
static const uint64_t REPLICATE_BASE = UINT64_C(1) << 62;

const char *sampling_name(unsigned method)
{
    static const char *const names[] = {"plain", "latin-hypercube", "sobol"};
    return method < SAMPLING_METHODS ? names[method] : "?";
}

enum percuss_status sampling_create(struct sampling *sampling, enum sampling_method method,
                                    size_t dimensions, uint64_t count, uint64_t seed,
                                    struct fault *fault)
{
    if (method == SAMPLING_IS_SOBOL && dimensions > SOBOL_DIMENSIONS)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "sampling: sobol: has %d dimensions and %zu inputs are uncertain: use "
                         "latin-hypercube or plain",
                         SOBOL_DIMENSIONS, dimensions);
    /* as many points in each replicate */
    uint64_t replicates = method == SAMPLING_IS_PLAIN ? 1 : SAMPLING_REPLICATES;
    *sampling = (struct sampling){
        .method = method,
        .dimensions = dimensions,
        .count = (count + replicates - 1) / replicates * replicates,
        .replicates = replicates,
        .stream = {seed, STREAM_SAMPLES},
    };
    for (unsigned d = 0; method == SAMPLING_IS_SOBOL && d < dimensions; d++)
        sampling->sobol[d] = sobol_directions(d);
    return PERCUSS_OK;
}

/* 64 random bits that all points of a replicate share in a dimension. */
static uint64_t shared_bits(const struct sampling *sampling, uint64_t replicate, uint64_t dimension)
{
    return random_bits(&sampling->stream, REPLICATE_BASE + replicate, dimension);
}

static double latin_coordinate(const struct sampling *sampling, uint64_t index, uint64_t dimension)
{
    uint64_t size = sampling->count / sampling->replicates;
    uint64_t replicate = index % sampling->replicates;
    uint64_t key = shared_bits(sampling, replicate, dimension);
    uint64_t cell = random_permute(key, index / sampling->replicates, size);
    double within = random_uniform(&sampling->stream, index, dimension);
    double u = ((double)cell + within) / (double)size;
    return u < 1.0 ? u : 1.0 - 0x1p-53;
}

/* Owen's nested uniform scrambling (1995): whether a bit is flipped depends on those before it, the
 * same way for the whole replicate; bits that the sequence does not have are each point's own. */
static double sobol_coordinate(const struct sampling *sampling, uint64_t index, uint64_t dimension)
{
    uint32_t point = sobol_point(&sampling->sobol[dimension], index / sampling->replicates);
    uint64_t key = shared_bits(sampling, index % sampling->replicates, dimension);
    uint32_t scrambled = 0;
    for (uint32_t bit = 0; bit < SOBOL_BITS; bit++) {
        uint32_t before = bit ? point >> (SOBOL_BITS - bit) : 0;
        uint32_t flip = random_hash(key, before, bit) & 1;
        scrambled |= (point ^ flip << (SOBOL_BITS - 1 - bit)) & UINT32_C(1)
                                                                    << (SOBOL_BITS - 1 - bit);
    }
    uint64_t rest = random_bits(&sampling->stream, index, dimension) >> SOBOL_BITS;
    return random_uniform_of((uint64_t)scrambled << SOBOL_BITS | rest);
}

double sampling_coordinate(const struct sampling *sampling, uint64_t index, size_t dimension)
{
    if (sampling->method == SAMPLING_IS_LATIN_HYPERCUBE)
        return latin_coordinate(sampling, index, dimension);
    if (sampling->method == SAMPLING_IS_SOBOL)
        return sobol_coordinate(sampling, index, dimension);
    return random_uniform(&sampling->stream, index, dimension);
}

void sampling_point(const struct sampling *sampling, uint64_t index, double *point)
{
    for (size_t d = 0; d < sampling->dimensions; d++)
        point[d] = sampling_coordinate(sampling, index, d);
}

/* ---- correlation of the points ---- */

/* In place, lower triangle. False: not positive definite. */
static bool copula_factorise(double *a, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j <= i; j++) {
            double sum = a[i * n + j];
            for (size_t k = 0; k < j; k++)
                sum -= a[i * n + k] * a[j * n + k];
            if (i == j && !(sum > 1e-12))
                return false;
            a[i * n + j] = i == j ? sqrt(sum) : sum / a[j * n + j];
        }
    }
    return true;
}

static enum percuss_status copula_fill(double *matrix, size_t n, const struct copula_pair *pairs,
                                       size_t count, struct fault *fault)
{
    for (size_t i = 0; i < n; i++)
        matrix[i * n + i] = 1.0;
    for (size_t p = 0; p < count; p++) {
        const struct copula_pair *pair = &pairs[p];
        if (!(fabs(pair->coefficient) < 1.0))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "correlations[%zu].coefficient: %g: must be between -1 and 1", p,
                             pair->coefficient);
        matrix[pair->first * n + pair->second] = pair->coefficient;
        matrix[pair->second * n + pair->first] = pair->coefficient;
    }
    return PERCUSS_OK;
}

enum percuss_status copula_create(struct copula *copula, size_t dimensions,
                                  const struct copula_pair *pairs, size_t pair_count,
                                  struct fault *fault)
{
    *copula = (struct copula){.dimensions = dimensions};
    if (pair_count == 0)
        return PERCUSS_OK;
    copula->factor = calloc(dimensions * dimensions, sizeof *copula->factor);
    if (!copula->factor)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_status status = copula_fill(copula->factor, dimensions, pairs, pair_count, fault);
    if (!status && !copula_factorise(copula->factor, dimensions))
        status = fault_set(fault, PERCUSS_BAD_REQUEST,
                           "correlations: no distribution has these coefficients: the matrix must "
                           "be positive definite");
    if (status)
        copula_release(copula);
    return status;
}

void copula_release(struct copula *copula)
{
    free(copula->factor);
    copula->factor = NULL;
}

void copula_apply(const struct copula *copula, double *point)
{
    size_t n = copula->dimensions;
    double z[SAMPLING_MAX_DIMENSIONS];
    if (!copula->factor)
        return;
    for (size_t i = 0; i < n; i++)
        z[i] = special_normal_quantile(point[i]);
    for (size_t i = 0; i < n; i++) {
        double sum = 0.0;
        for (size_t j = 0; j <= i; j++)
            sum += copula->factor[i * n + j] * z[j];
        point[i] = fmax(0x1p-54, fmin(special_normal_cdf(sum), 1.0 - 0x1p-53));
    }
}
