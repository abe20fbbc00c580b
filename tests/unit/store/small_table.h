/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A coarse computed table of the paper's rod 1, made once for all tests of a program. */
#ifndef PERCUSS_TEST_SMALL_TABLE_H
#define PERCUSS_TEST_SMALL_TABLE_H

#include <stdio.h>
#include <string.h>

#include "check.h"
#include "store/table_key.h"

static const struct material small_steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
static const struct material small_soft = {"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0};

static struct indentation_table small_table;

static inline int make_small_table(void **state)
{
    (void)state;
    struct region_input input = {{small_steel, small_soft}, 0.015, 8e-6, 6, 0.0};
    struct fault fault;
    if (indentation_table_make(&input, NULL, &small_table, &fault))
        fail_msg("%s", fault.text);
    return 0;
}

static inline int free_small_table(void **state)
{
    (void)state;
    indentation_table_free(&small_table);
    return 0;
}

#endif
