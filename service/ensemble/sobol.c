/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/sobol.h"

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
