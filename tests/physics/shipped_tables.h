/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The contact tables of the paper's rods as they are shipped: group fixtures. */
#ifndef PERCUSS_TEST_SHIPPED_TABLES_H
#define PERCUSS_TEST_SHIPPED_TABLES_H

#include "physics/support.h"
#include "store/table_store.h"

#define AL_205 ((struct material){"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0})
#define AL_575 ((struct material){"al-575", 70e9, 0.33, 2700.0, 575e6, 0.0})

static struct table_store *shipped;

static inline void complain(const struct fault *fault)
{
    fail_msg("%s", fault->text);
}

static inline int load_shipped(void **state)
{
    (void)state;
    size_t count;
    struct fault fault;
    shipped = table_store_create();
    if (table_store_load(shipped, PERCUSS_SOURCE_DIR "/config/tables", complain, &count, &fault))
        fail_msg("%s", fault.text);
    assert_int_equal(count, 2);
    return 0;
}

static inline int free_shipped(void **state)
{
    (void)state;
    table_store_free(shipped);
    return 0;
}

#endif
