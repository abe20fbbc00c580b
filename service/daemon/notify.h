/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Messages to the service manager: datagrams to the socket that it names, see sd_notify(3), without
 * its library. */
#ifndef PERCUSS_DAEMON_NOTIFY_H
#define PERCUSS_DAEMON_NOTIFY_H

/* Of the main thread. */
struct notifier {
    int socket;      /* connected; -1: no manager listens */
    double watchdog; /* s: the manager wants a sign of life in each; 0: it does not */
};

/* By NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID, which are taken out of the environment: they
 * are not for the programs that the daemon runs. Before there are threads. */
struct notifier notifier_open(void);
void notifier_close(struct notifier *notifier);

/* Sends lines "NAME=value"; no effect where no manager listens or the datagram is not taken. */
void notify(const struct notifier *notifier, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
