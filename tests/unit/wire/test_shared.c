/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests idl/wire_shared.c: which configurations ask for shared memory. */
#include <stdio.h>
#include <unistd.h>

#include "check.h"
#include "wire_shared.h"

static void xml_asks(void **state)
{
    (void)state;
    assert_true(wire_shared_is_asked("<Domain><SharedMemory><Enable>true</Enable></SharedMemory>"));
    assert_true(wire_shared_is_asked("<Domain><SharedMemory>\n<LogLevel>info</LogLevel><Enable> "
                                     "TRUE </></></>"));
    assert_false(wire_shared_is_asked("<SharedMemory><Enable>false</Enable></SharedMemory>"));
    assert_false(wire_shared_is_asked("<SharedMemory><LogLevel>info</LogLevel></SharedMemory>"
                                      "<TCP><Enable>true</Enable></TCP>"));
    assert_false(wire_shared_is_asked(
        "<!-- <SharedMemory><Enable>true</Enable></SharedMemory> --><Domain></Domain>"));
    assert_false(wire_shared_is_asked("<!-- <SharedMemory><Enable>true"));
    assert_false(wire_shared_is_asked(""));
}

static void files_ask(void **state)
{
    (void)state;
    char path[] = "/tmp/percuss-shared-XXXXXX", both[128];
    int file = mkstemp(path);
    static const char text[] = "<SharedMemory><Enable>true</Enable></SharedMemory>";
    assert_true(file >= 0);
    assert_int_equal(write(file, text, sizeof text - 1), sizeof text - 1);
    close(file);
    snprintf(both, sizeof both, "/nowhere/at/all, file://%s", path);
    assert_true(wire_shared_is_asked(path));
    assert_true(wire_shared_is_asked(both));
    unlink(path);
    assert_false(wire_shared_is_asked(both));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(xml_asks),
        cmocka_unit_test(files_ask),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
