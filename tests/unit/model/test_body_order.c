/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/body.c, orders: what is told of it while others listen. */
#include "model/body.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"

enum { TOLD = 20000 };

static void *tell(void *argument)
{
    const struct body_order *order = argument;
    for (int i = 0; i < TOLD; i++) {
        char text[BODY_NEWS_SIZE];
        memset(text, 'a' + i % 26, sizeof text);
        text[sizeof text - 1] = '\0';
        body_order_tell(order, i % 26 == 0 ? PERCUSS_UNKNOWN_BODY : PERCUSS_BUSY, "%s", text);
    }
    return NULL;
}

static void news_come_whole(void **state)
{
    (void)state;
    pthread_t thread;
    struct body_order order = {.id = "part"};
    assert_true(body_order_begin(&order));
    tell(&order);
    assert_int_equal(pthread_create(&thread, NULL, tell, &order), 0);
    for (int i = 0; i < TOLD; i++) {
        struct body_news news = body_order_news(&order);
        size_t length = strlen(news.text);
        assert_int_equal(length, BODY_NEWS_SIZE - 1);
        /* one letter all along, and its status */
        assert_true(news.text[0] == news.text[length / 2] && news.text[0] == news.text[length - 1]);
        assert_int_equal(news.status, news.text[0] == 'a' ? PERCUSS_UNKNOWN_BODY : PERCUSS_BUSY);
    }
    pthread_join(thread, NULL);
    body_order_clear(&order);
    assert_null(order.board);
}

static void what_is_too_long_is_cut(void **state)
{
    (void)state;
    char text[2 * BODY_NEWS_SIZE] = "";
    struct body_order order = {.id = "part"};
    assert_true(body_order_begin(&order));
    memset(text, 'x', sizeof text - 1);
    body_order_tell(&order, PERCUSS_BUSY, "%s", text);
    assert_int_equal(strlen(body_order_news(&order).text), BODY_NEWS_SIZE - 1);
    body_order_clear(&order);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(news_come_whole),
        cmocka_unit_test(what_is_too_long_is_cut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
