/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests endpoint/reply_bytes.c: a reply comes back as it was, byte by byte; damaged bytes do not.
 */
#include "unit/exchange/sample.h"

#include <math.h>

#include "endpoint/reply_bytes.h"
#include "exchange/encode.h"

/* The answer, or NULL where the bytes are damaged. */
static struct answer *read_back(const void *bytes, size_t size)
{
    bool damaged;
    struct answer *answer = reply_bytes_read(bytes, size, &damaged);
    assert_true(damaged == !answer);
    return answer;
}

static void comes_back_as_it_was(void **state)
{
    (void)state;
    struct envelope envelope = sample_envelope(42);
    struct solve_result *result = sample_result(2, 3);
    struct answer *answer = encode_result(&envelope, result, sample_tokens, 256);
    answer->reply->timing.solve = 0.1;
    size_t size, size_again;
    void *bytes = reply_bytes_write(answer, &size);
    struct answer *read = read_back(bytes, size);
    assert_non_null(read);
    assert_int_equal(read->exchange, EXCHANGE_SINGLE);
    assert_true(read->reply->sequence == 42);
    assert_true(read->reply->timing.solve == 0.1);
    assert_true(isnan(read->reply->contacts._buffer[0].restitution) ==
                isnan(answer->reply->contacts._buffer[0].restitution));
    assert_true(read->reply->contacts._buffer[1].sub_impacts._buffer[2].start == 2.0);
    assert_string_equal(read->reply->warnings._buffer[1], "mind the step");
    void *again = reply_bytes_write(read, &size_again);
    assert_int_equal(size_again, size);
    assert_memory_equal(again, bytes, size);
    free(again);
    free(bytes);
    answer_release(read);
    answer_release(answer);
    free(result);
}

static void damaged_bytes_do_not(void **state)
{
    (void)state;
    struct envelope envelope = sample_envelope(42);
    struct solve_result *result = sample_result(2, 3);
    struct answer *answer = encode_result(&envelope, result, sample_tokens, 256);
    size_t size;
    void *bytes = reply_bytes_write(answer, &size);
    assert_null(read_back(bytes, 0));
    assert_null(read_back(bytes, 3));
    assert_null(read_back(bytes, size / 2));
    /* the size of all: it would end before a member, which the decoder does not survive */
    for (uint32_t shorter = 0; shorter < size - 4; shorter++) {
        memcpy(bytes, &shorter, sizeof shorter);
        answer_release(read_back(bytes, size));
    }
    const uint32_t header_only = 24;
    memcpy(bytes, &header_only, sizeof header_only);
    assert_null(read_back(bytes, size));
    memset(bytes, 0xff, 4);
    assert_null(read_back(bytes, size));
    free(bytes);
    /* any octet: refused or read, nothing worse */
    bytes = reply_bytes_write(answer, &size);
    for (size_t i = 0; i < size; i++) {
        for (unsigned flipped = 1; flipped < 256; flipped <<= 1) {
            ((uint8_t *)bytes)[i] ^= (uint8_t)flipped;
            answer_release(read_back(bytes, size));
            ((uint8_t *)bytes)[i] ^= (uint8_t)flipped;
        }
    }
    free(bytes);
    answer_release(answer);
    free(result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(comes_back_as_it_was),
        cmocka_unit_test(damaged_bytes_do_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
