/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/body_order.h"

#include <stdlib.h>

void body_order_clear(struct body_order *order)
{
    for (size_t i = 0; i < order->argument_count; i++)
        free(order->arguments[i]);
    free(order->mesh);
    *order = (struct body_order){.argument_count = 0};
}
