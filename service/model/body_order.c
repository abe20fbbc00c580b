/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/body_order.h"

#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

struct body_board {
    atomic_flag taken; /* somebody copies the news, which is soon done */
    struct body_news news;
};

static void take(struct body_board *board)
{
    while (atomic_flag_test_and_set_explicit(&board->taken, memory_order_acquire))
        ;
}

static void give_back(struct body_board *board)
{
    atomic_flag_clear_explicit(&board->taken, memory_order_release);
}

bool body_order_begin(struct body_order *order)
{
    order->board = calloc(1, sizeof *order->board);
    if (!order->board)
        return false;
    atomic_flag_clear(&order->board->taken);
    body_order_tell(order, PERCUSS_BUSY, "its mesh waits to be reduced: ask again later");
    return true;
}

void body_order_tell(const struct body_order *order, enum percuss_status status, const char *format,
                     ...)
{
    struct body_news news = {.status = status};
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(news.text, sizeof news.text, format, arguments);
    va_end(arguments);
    take(order->board);
    order->board->news = news;
    give_back(order->board);
}

struct body_news body_order_news(const struct body_order *order)
{
    take(order->board);
    struct body_news news = order->board->news;
    give_back(order->board);
    return news;
}

void body_order_clear(struct body_order *order)
{
    for (size_t i = 0; i < order->argument_count; i++)
        free(order->arguments[i]);
    free(order->mesh);
    free(order->board);
    *order = (struct body_order){.argument_count = 0};
}
