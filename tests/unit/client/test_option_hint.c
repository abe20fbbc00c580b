/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/cli/option_hint.c: which option was meant. */
#include <string.h>

#include "check.h"
#include "commands.h"
#include "option_hint.h"

enum { MOST_WORDS = 16 };

/* Of the words of `percuss query`, between blanks: what is unknown in `name`, what was meant in
 * `meant`; NULL: nothing. */
static void expect(const char *text, const char *name, const char *meant)
{
    static char copy[256];
    char *words[MOST_WORDS], *rest = copy;
    int count = 0;
    struct option_hint hint;
    snprintf(copy, sizeof copy, "percuss %s", text);
    for (char *word; (word = strsep(&rest, " ")) && count < MOST_WORDS;)
        words[count++] = word;
    bool found = option_hint_find(&query_argp, count, words, &hint);
    if (found != (name != NULL))
        fail_msg("%s: %s", text, found ? hint.name : "all are known");
    if (found)
        assert_string_equal(hint.name, name);
    if (found && meant)
        assert_string_equal(hint.meant, meant);
    else
        assert_null(hint.meant);
}

static void known_options_are_passed(void **state)
{
    (void)state;
    expect("", NULL, NULL);
    expect("--a x -b y --speed 0.3 --json -h", NULL, NULL);
    expect("--help --usage --version --hel", NULL, NULL);
    /* as far as getopt needs them */
    expect("--toler 1e-3 --contact=hertz", NULL, NULL);
    /* values, and what stands behind the end of the options */
    expect("--a --sped --b=--sped -a --sped", NULL, NULL);
    expect("--json -- --sped", NULL, NULL);
}

static void others_are_named(void **state)
{
    (void)state;
    expect("--sped 0.3", "sped", "speed");
    expect("--a x --contact_model=hertz", "contact_model", "contact-model");
    expect("--json --tolerence 1", "tolerence", "tolerance");
    /* of those that all commands share */
    expect("--domian 7", "domian", "domain");
    expect("--xyzzy", "xyzzy", NULL);
    expect("--json --xyzzy=3 --sped 3", "xyzzy", NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_options_are_passed),
        cmocka_unit_test(others_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
