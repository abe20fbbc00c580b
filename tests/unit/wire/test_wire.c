/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests wire.c: no participant where DDS would end the process for lack of descriptors or address
 * space. */
#include "wire.h"

#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "check.h"

/* The code of a participant in a process with that limit; 1: it is made. A signal fails the test.
 */
static int code_under(int kind, rlim_t limit)
{
    int ends[2], code = 0, status;
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    if (child == 0) {
        struct rlimit both = {limit, limit};
        setrlimit((__rlimit_resource_t)kind, &both);
        dds_entity_t made = wire_participant_create(19);
        code = made > 0 ? 1 : (int)made;
        if (write(ends[1], &code, sizeof code) < 0)
            _exit(1);
        _exit(0);
    }
    close(ends[1]);
    assert_int_equal(read(ends[0], &code, sizeof code), sizeof code);
    close(ends[0]);
    waitpid(child, &status, 0);
    assert_int_equal(status, 0);
    return code;
}

static void descriptors_are_needed(void **state)
{
    (void)state;
    /* those that are open already count: a pipe of the test, and what it inherited below the limit
     */
    for (rlim_t limit = 6; limit < 11; limit++)
        assert_int_equal(code_under(RLIMIT_NOFILE, limit), WIRE_NO_DESCRIPTORS);
    assert_int_equal(code_under(RLIMIT_NOFILE, 64), 1);
    assert_non_null(strstr(wire_participant_problem(WIRE_NO_DESCRIPTORS),
                           "fewer than 8 file descriptors are left"));
}

static void address_space_is_needed(void **state)
{
    (void)state;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    assert_int_equal(code_under(RLIMIT_AS, 60 << 20), WIRE_NO_ADDRESS_SPACE);
    assert_int_equal(code_under(RLIMIT_AS, 1 << 30), 1);
    assert_non_null(
        strstr(wire_participant_problem(WIRE_NO_ADDRESS_SPACE), "KiB of address space are left"));
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(descriptors_are_needed),
        cmocka_unit_test(address_space_is_needed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
