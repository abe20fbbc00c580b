/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/notify.c against a socket as sd_notify(3) describes the manager's. */
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "check.h"
#include "daemon/notify.h"

/* A manager that listens at that name outside the file system. */
static int listen_at(const char *name)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    memcpy(address.sun_path + 1, name, strlen(name));
    socklen_t size = (socklen_t)(offsetof(struct sockaddr_un, sun_path) + 1 + strlen(name));
    int made = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0);
    assert_int_equal(bind(made, (struct sockaddr *)&address, size), 0);
    return made;
}

static void the_manager_hears(void **state)
{
    (void)state;
    char name[64], environment[65], heard[256];
    snprintf(name, sizeof name, "percuss-test-%ld", (long)getpid());
    snprintf(environment, sizeof environment, "@%s", name);
    int manager = listen_at(name);
    setenv("NOTIFY_SOCKET", environment, 1);
    setenv("WATCHDOG_USEC", "2500000", 1);
    struct notifier notifier = notifier_open();
    assert_true(notifier.watchdog == 2.5);
    /* programs that the daemon runs are not to speak for it */
    assert_null(getenv("NOTIFY_SOCKET"));
    assert_null(getenv("WATCHDOG_USEC"));
    notify(&notifier, "READY=1\nSTATUS=%d bodies", 14);
    ssize_t size = recv(manager, heard, sizeof heard - 1, 0);
    assert_true(size > 0);
    heard[size] = '\0';
    assert_string_equal(heard, "READY=1\nSTATUS=14 bodies");
    /* a manager that has gone is no matter */
    close(manager);
    notify(&notifier, "READY=1");
    notifier_close(&notifier);
    notify(&notifier, "READY=1");
}

static void a_watchdog_for_another_process_is_not_ours(void **state)
{
    (void)state;
    char name[64], environment[65];
    snprintf(name, sizeof name, "percuss-test-%ld", (long)getpid());
    snprintf(environment, sizeof environment, "@%s", name);
    int manager = listen_at(name);
    setenv("NOTIFY_SOCKET", environment, 1);
    setenv("WATCHDOG_USEC", "2500000", 1);
    setenv("WATCHDOG_PID", "1", 1);
    struct notifier notifier = notifier_open();
    assert_true(notifier.socket >= 0);
    assert_true(notifier.watchdog == 0.0);
    notifier_close(&notifier);
    close(manager);
}

static void without_a_manager_nothing_is_sent(void **state)
{
    (void)state;
    static const char *const names[] = {"", "/", "@", "relative", "/nobody/listens/here"};
    for (size_t i = 0; i < COUNT(names); i++) {
        setenv("NOTIFY_SOCKET", names[i], 1);
        setenv("WATCHDOG_USEC", "2500000", 1);
        struct notifier notifier = notifier_open();
        assert_int_equal(notifier.socket, -1);
        assert_true(notifier.watchdog == 0.0);
        notify(&notifier, "READY=1");
        notifier_close(&notifier);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_manager_hears),
        cmocka_unit_test(a_watchdog_for_another_process_is_not_ours),
        cmocka_unit_test(without_a_manager_nothing_is_sent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
