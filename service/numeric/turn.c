/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "numeric/turn.h"

#include <threads.h>

/* The buffers that it guards are the process's, too. */
static once_flag made = ONCE_FLAG_INIT;
static mtx_t lock;

static void make(void)
{
    mtx_init(&lock, mtx_plain);
}

void turn_begin(void)
{
    call_once(&made, make);
    mtx_lock(&lock);
}

void turn_end(void)
{
    mtx_unlock(&lock);
}
