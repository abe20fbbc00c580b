/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/notify.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

/* A socket to which each datagram goes; -1: there is none. */
static int connect_to(const char *name)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    size_t length = name ? strlen(name) : 0;
    /* a path, or "@" for a name outside the file system, which begins with a zero */
    if (length < 2 || length >= sizeof address.sun_path || (*name != '/' && *name != '@'))
        return -1;
    memcpy(address.sun_path, name, length);
    if (*name == '@')
        address.sun_path[0] = '\0';
    socklen_t size = (socklen_t)(offsetof(struct sockaddr_un, sun_path) + length);
    /* the daemon does not wait for a manager that does not listen */
    int made = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (made >= 0 && connect(made, (const struct sockaddr *)&address, size) != 0) {
        close(made);
        made = -1;
    }
    return made;
}

/* The seconds between signs of life that are expected of this process; 0: none are. */
static double watchdog_seconds(void)
{
    const char *text = getenv("WATCHDOG_USEC"), *process = getenv("WATCHDOG_PID");
    bool ours = !process || strtol(process, NULL, 10) == getpid();
    double seconds = text && ours ? 1e-6 * strtod(text, NULL) : 0.0;
    return seconds > 0.0 ? seconds : 0.0;
}

struct notifier notifier_open(void)
{
    struct notifier notifier = {connect_to(getenv("NOTIFY_SOCKET")), 0.0};
    if (notifier.socket >= 0)
        notifier.watchdog = watchdog_seconds();
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
    unsetenv("WATCHDOG_PID");
    return notifier;
}

void notifier_close(struct notifier *notifier)
{
    if (notifier->socket >= 0)
        close(notifier->socket);
    notifier->socket = -1;
}

void notify(const struct notifier *notifier, const char *format, ...)
{
    char lines[1024];
    va_list arguments;
    if (notifier->socket < 0)
        return;
    va_start(arguments, format);
    int length = vsnprintf(lines, sizeof lines, format, arguments);
    va_end(arguments);
    if (length > 0 && (size_t)length < sizeof lines)
        send(notifier->socket, lines, (size_t)length, MSG_NOSIGNAL);
}
