/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/base/sha256.c. */
#include <string.h>

#include "base/sha256.h"
#include "check.h"

/* The examples of FIPS 180-4's companion, and a length on either side of a block's end (coreutils'
 * sha256sum). */
static void test_known_values(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        size_t times;
        const char *expected;
    } rows[] = {
        {"", 1, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
        {"abc", 1, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
        {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", 1,
         "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
        {"a", 1000000, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"},
        {"a", 55, "9f4390f8d30c2dd92ec9f095b65e2b9ae9b0a925a5258e241c9f1e910f734318"},
        {"a", 64, "ffe054fe7ae0cb6dc65c3af9b61d5209f439851db43d0ba5997337df154668eb"},
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        char text[SHA256_TEXT];
        struct sha256 hash = sha256_begin();
        for (size_t k = 0; k < rows[i].times; k++)
            sha256_add(&hash, rows[i].text, strlen(rows[i].text));
        sha256_end(&hash, text);
        assert_string_equal(text, rows[i].expected);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
