/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/cli/complete_line.c: what the words of a command line say that is being typed. */
#include <string.h>

#include "check.h"
#include "complete_line.h"

enum { MOST_WORDS = 16 };

static struct common common;

/* Of words between blanks; "_" is an empty one. */
static struct line read_words(const char *text)
{
    static char copy[256];
    char *words[MOST_WORDS], *rest = copy, empty[] = "";
    int count = 0;
    struct line line;
    common = (struct common){0};
    snprintf(copy, sizeof copy, "%s", text);
    for (char *word; (word = strsep(&rest, " ")) && count < MOST_WORDS;)
        words[count++] = strcmp(word, "_") ? word : empty;
    assert_true(line_read(count, words, &common, &line));
    return line;
}

/* The option whose value is next (NULL: none), what is to be completed, and what of the last word
 * bash has split off. */
static void expect(const char *text, const char *option, const char *word, size_t split)
{
    struct line line = read_words(text);
    if (option && (!line.option || strcmp(line.option->name, option) != 0))
        fail_msg("%s: not --%s", text, option);
    if (!option && line.option)
        fail_msg("%s: --%s", text, line.option->name);
    assert_string_equal(line.word, word);
    assert_int_equal(line.split, split);
    line_free(&line);
}

static void values_of_options(void **state)
{
    (void)state;
    expect("query --method m", "method", "m", 0);
    expect("query --method=m", "method", "m", 0);
    expect("query --method _", "method", "", 0);
    expect("query -a st", "a", "st", 0);
    expect("query -ast", "a", "st", 0);
    expect("query --json _", NULL, "", 0);
    expect("query --met", NULL, "--met", 0);
    expect("query --method modal --a", NULL, "--a", 0);
    expect("status --watch 3", NULL, "3", 0);
    expect("status --watch=3", "watch", "3", 0);
    expect("qu", NULL, "qu", 0);
    expect("--domain 7", "domain", "7", 0);
}

static void words_that_bash_has_split(void **state)
{
    (void)state;
    expect("query --method = m", "method", "m", 9);
    expect("query --method =", "method", "", 9);
    expect("query --method = modal --a = s", "a", "s", 4);
    expect("calibrate --fit young : al", "fit", "young:al", 6);
    expect("calibrate --fit young :", "fit", "young:", 6);
    expect("ensemble --input young @ al-beam = nor", "input", "young@al-beam=nor", 14);
    expect("sweep --speed 0.1 : 0.4 : 3 --met", NULL, "--met", 0);
    /* a value that was left out */
    expect("query --a = --b s", "b", "s", 0);
}

static void what_the_line_says(void **state)
{
    (void)state;
    struct line line = read_words(
        "--domain 7 query --local -a ball --b = bar --server 0a1b --partition gears --at-b _");
    assert_string_equal(line.command->name, "query");
    assert_string_equal(line.bodies[0], "ball");
    assert_string_equal(line.bodies[1], "bar");
    assert_true(common.local && common.domain == 7);
    assert_string_equal(common.server, "0a1b");
    assert_string_equal(common.partition, "gears");
    assert_string_equal(line.option->name, "at-b");
    line_free(&line);
    /* what is no server's id stays unsaid */
    line = read_words("query --server nowhere --domain x --a _");
    assert_string_equal(common.server, "");
    assert_int_equal(common.domain, 0);
    line_free(&line);
    line = read_words("help _");
    assert_true(line.help && !line.command);
    line_free(&line);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_of_options),
        cmocka_unit_test(words_that_bash_has_split),
        cmocka_unit_test(what_the_line_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
