/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/log.c: the forms of a line, whatever its message holds. */
#include <jansson.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "daemon/log.h"

static const uint8_t client[16] = {0x01, 0xab, [15] = 0xff};
static const struct log_request request = {client, 7};

struct captured {
    char text[8192];
};

/* What a line with that message puts on stderr. */
static struct captured line_of(enum log_format format, const struct log_request *about,
                               const char *message)
{
    struct captured captured = {""};
    int ends[2], before = dup(STDERR_FILENO);
    assert_int_equal(pipe(ends), 0);
    dup2(ends[1], STDERR_FILENO);
    log_use(format);
    if (about)
        log_about(LEVEL_WARNING, about, "%s", message);
    else
        log_line(LEVEL_WARNING, "%s", message);
    dup2(before, STDERR_FILENO);
    close(before);
    close(ends[1]);
    ssize_t size = read(ends[0], captured.text, sizeof captured.text - 1);
    close(ends[0]);
    assert_true(size > 0);
    /* one line */
    assert_ptr_equal(strchr(captured.text, '\n'), captured.text + size - 1);
    return captured;
}

static void text_has_the_time_and_the_level(void **state)
{
    (void)state;
    struct captured line = line_of(LOG_TEXT, NULL, "a\nb\"c");
    assert_int_equal(line.text[10], 'T');
    assert_string_equal(line.text + 23, "Z warning a b\"c\n");
    line = line_of(LOG_TEXT, &request, "busy");
    assert_string_equal(line.text + 23,
                        "Z warning client 01ab00000000000000000000000000ff request 7: busy\n");
}

/* sd-daemon(3): the level of syslog, and no time, which the journal has. */
static void the_journal_has_its_own_clock(void **state)
{
    (void)state;
    struct captured line = line_of(LOG_JOURNAL, NULL, "busy");
    assert_string_equal(line.text, "<4>busy\n");
}

static void json_is_an_object(void **state)
{
    (void)state;
    struct captured line = line_of(LOG_JSON, &request, "busy");
    json_t *object = json_loads(line.text, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(object);
    assert_string_equal(json_string_value(json_object_get(object, "level")), "warning");
    assert_string_equal(json_string_value(json_object_get(object, "client")),
                        "01ab00000000000000000000000000ff");
    assert_int_equal(json_integer_value(json_object_get(object, "sequence")), 7);
    assert_string_equal(json_string_value(json_object_get(object, "message")), "busy");
    assert_int_equal(strlen(json_string_value(json_object_get(object, "time"))), 24);
    json_decref(object);
    line = line_of(LOG_JSON, NULL, "busy");
    assert_null(strstr(line.text, "client"));
}

/* What clients send may stand in a message: a reader of JSON (jansson, which insists on UTF-8) gets
 * it back, with U+FFFD for octets that are no UTF-8. */
static void json_takes_any_octets(void **state)
{
    (void)state;
    static const struct {
        const char *message, *read;
    } cases[] = {
        {"quote \" backslash \\ tab \t line \n end", "quote \" backslash \\ tab \t line \n end"},
        {"\xc3\xa9 \xe2\x82\xac \xf0\x9f\x94\xa7", "\xc3\xa9 \xe2\x82\xac \xf0\x9f\x94\xa7"},
        {"cut \xe2\x82", "cut \xef\xbf\xbd\xef\xbf\xbd"},
        {"\x80 \xff \xfe", "\xef\xbf\xbd \xef\xbf\xbd \xef\xbf\xbd"},
        /* an overlong slash, a surrogate, one beyond the last character: an octet each */
        {"\xc0\xaf", "\xef\xbf\xbd\xef\xbf\xbd"},
        {"\xed\xa0\x80", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"},
        {"\xf4\x90\x80\x80", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct captured line = line_of(LOG_JSON, NULL, cases[i].message);
        json_t *object = json_loads(line.text, 0, NULL);
        assert_non_null(object);
        assert_string_equal(json_string_value(json_object_get(object, "message")), cases[i].read);
        json_decref(object);
    }
}

static void long_messages_are_cut(void **state)
{
    (void)state;
    char message[5000];
    memset(message, '\x01', sizeof message - 1);
    message[sizeof message - 1] = '\0';
    for (enum log_format format = 0; format < LOG_FORMAT_COUNT; format++)
        line_of(format, &request, message);
    struct captured line = line_of(LOG_JSON, NULL, message);
    json_t *object = json_loads(line.text, 0, NULL);
    assert_int_equal(strlen(json_string_value(json_object_get(object, "message"))), 1199);
    json_decref(object);
}

static void levels_are_left_out(void **state)
{
    (void)state;
    assert_true(log_shows(LEVEL_INFO));
    assert_false(log_shows(LEVEL_DEBUG));
    log_limit(LEVEL_DEBUG);
    assert_true(log_shows(LEVEL_DEBUG));
    log_limit(LEVEL_INFO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_has_the_time_and_the_level),
        cmocka_unit_test(the_journal_has_its_own_clock),
        cmocka_unit_test(json_is_an_object),
        cmocka_unit_test(json_takes_any_octets),
        cmocka_unit_test(long_messages_are_cut),
        cmocka_unit_test(levels_are_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
