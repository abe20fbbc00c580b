/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors client/measured/text.c: one text, in the encodings and with the line ends of programs of
 * rigs. */
#include "files.h"
#include "text.h"

static void same(const char *bytes, size_t size, const char *expected)
{
    struct measured_fault fault;
    char *text = text_read(files_write("text", bytes, size), &fault);
    if (!text)
        fail_msg("%s", fault.text);
    assert_string_equal(text, expected);
    free(text);
}
#define SAME(bytes, expected) same(bytes, sizeof(bytes) - 1, expected)

static void reads_encodings(void **state)
{
    (void)state;
    SAME("", "");
    SAME("a;\xC2\xB5m\n", "a;\xC2\xB5m\n");
    SAME("\xEF\xBB\xBFspeed", "speed");
    SAME("\xEF\xBB\xBF\xEF\xBB\xBFspeed", "speed");
    /* Windows-1252: micro, squared; a byte that is no Latin letter */
    SAME("\xB5m, m/s\xB2", "\xC2\xB5m, m/s\xC2\xB2");
    SAME("\x80", "\xEF\xBF\xBD");
    /* UTF-16 with its mark, either way round; a pair of surrogates, and half of one */
    SAME("\xFF\xFE\xB5\0m\0\n\0", "\xC2\xB5m\n");
    SAME("\xFE\xFF\0\xB5\0m\0\n", "\xC2\xB5m\n");
    SAME("\xFE\xFF\xD8\x3D\xDE\x00", "\xF0\x9F\x98\x80");
    SAME("\xFE\xFF\xDE\x00\0a", "\xEF\xBF\xBD"
                                "a");
    SAME("\xFF\xFE\x13\x20x\0y", "\xE2\x80\x93x");
}

static void reads_line_ends(void **state)
{
    (void)state;
    SAME("a\r\nb\rc\nd", "a\nb\nc\nd");
    SAME("\r\r\n\n", "\n\n\n");
}

static void refuse(const char *file, const char *words)
{
    struct measured_fault fault;
    assert_null(text_read(file, &fault));
    assert_true(files_say(&fault, 1, words));
}

static void refuses_what_is_no_text(void **state)
{
    (void)state;
    refuse(files_write("zero", "speed\0\n", 7), "zero: a zero byte is in it");
    refuse("/nowhere/file.csv", "/nowhere/file.csv: No such file");
    refuse(files_folder, "Is a directory");
}

static void knows_files(void **state)
{
    (void)state;
    struct measured_fault fault;
    int ends[2];
    char path[40];
    assert_true(text_is_file(files_text("file", "x"), &fault));
    assert_false(text_is_file(files_text("file", ""), &fault));
    assert_true(files_say(&fault, 1, "file: must be a file with something in it"));
    assert_false(text_is_file("/dev/zero", &fault));
    assert_false(text_is_file("/nowhere/file.csv", &fault));
    assert_true(files_say(&fault, 1, "No such file"));
    /* a pipe that nobody writes into */
    assert_int_equal(pipe(ends), 0);
    snprintf(path, sizeof path, "/proc/self/fd/%d", ends[0]);
    assert_false(text_is_file(path, &fault));
    close(ends[0]);
    close(ends[1]);
}

/* More than is read at once. */
static void reads_long_files(void **state)
{
    (void)state;
    static char bytes[300001];
    memset(bytes, 'x', sizeof bytes - 1);
    same(bytes, sizeof bytes - 1, bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_encodings),         cmocka_unit_test(reads_line_ends),
        cmocka_unit_test(refuses_what_is_no_text), cmocka_unit_test(knows_files),
        cmocka_unit_test(reads_long_files),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
