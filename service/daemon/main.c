/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "daemon/arguments.h"
#include "daemon/check_config.h"
#include "daemon/limits.h"
#include "daemon/log.h"
#include "daemon/notify.h"
#include "daemon/service.h"
#include "daemon/standby.h"
#include "daemon/store_care.h"
#include "exchange/clock.h"
#include "respond/settings.h"

enum { STATUS_SIZE = 400 };

/* More than what follows the draining takes, s; and what the manager is told, who then ends it. */
static const double APART_SECONDS = 8.0, END_SECONDS = 10.0;

/* Settings file, then command line. */
static enum percuss_status gather_settings(const struct arguments *arguments,
                                           struct settings *settings, struct fault *fault)
{
    const char *file = arguments->config ? arguments->config : arguments->shipped;
    *settings = settings_default();
    settings->shipped = !arguments->config;
    if (file && settings_load(file, settings, fault))
        return PERCUSS_BAD_REQUEST;
    if (arguments->domain >= 0)
        settings->domain = (unsigned)arguments->domain;
    if (arguments->partition)
        snprintf(settings->partition, sizeof settings->partition, "%s", arguments->partition);
    if (arguments->log_format >= 0)
        settings->log_format = (enum log_format)arguments->log_format;
    if (arguments->catalogue)
        snprintf(settings->catalogue, sizeof settings->catalogue, "%s", arguments->catalogue);
    if (settings->catalogue[0])
        return PERCUSS_OK;
    if (!file)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "--config FILE or --catalogue FILE must be given: no settings are "
                         "installed beside this program");
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "%s: catalogue: missing: must be given there or as --catalogue FILE", file);
}

/* Which settings were found where none were given; `look`: it is all that is asked, which is about
 * the catalogue where one is given. */
static void name_settings(struct arguments *arguments, bool look)
{
    if (arguments->shipped && look && !arguments->catalogue)
        fprintf(stderr, "percussd: no settings are given: %s\n", arguments->shipped);
    else if (arguments->shipped && !look)
        log_line(LEVEL_INFO, "no settings are given: %s", arguments->shipped);
    free(arguments->shipped);
}

/* The signals the main thread waits for; threads started later inherit that they are blocked. */
static sigset_t block_signals(void)
{
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGHUP);
    sigaddset(&signals, SIGUSR1);
    pthread_sigmask(SIG_BLOCK, &signals, NULL);
    signal(SIGPIPE, SIG_IGN);
    return signals;
}

/* A signal that came within `seconds`, or 0. */
static int wait_for_signal(const sigset_t *signals, double seconds)
{
    struct timespec timeout = {.tv_sec = (time_t)seconds,
                               .tv_nsec = (long)(1e9 * (seconds - floor(seconds)))};
    int signal_number = sigtimedwait(signals, NULL, &timeout);
    return signal_number > 0 ? signal_number : 0;
}

/* Tells the manager how it goes, and that it goes on: not where a thread has stopped moving for
 * half of the time after which the manager kills the daemon. */
static void report(struct service *service, const struct notifier *notifier)
{
    char line[STATUS_SIZE];
    if (notifier->socket < 0)
        return;
    service_describe(service, line, sizeof line);
    notify(notifier, "STATUS=%s", line);
    if (notifier->watchdog > 0.0 && service_is_alive(service, 0.5 * notifier->watchdog))
        notify(notifier, "WATCHDOG=1");
}

static void reload(struct service *service, const struct notifier *notifier)
{
    notify(notifier, "RELOADING=1\nMONOTONIC_USEC=%.0f", 1e6 * clock_now());
    service_reload(service);
    notify(notifier, "READY=1");
}

/* Ends the daemon where its place is another one's, which may answer already. */
static void look_at_place(const char *standby)
{
    if (!standby[0] || standby_is_held(standby))
        return;
    log_line(LEVEL_ERROR, "standby: %s: its lock is not this process's any more: ends at once",
             standby);
    _exit(EXIT_FAILURE);
}

/* Until somebody asks for the end. */
static void serve(struct service *service, const sigset_t *signals, const struct notifier *notifier,
                  const char *standby)
{
    /* signs of life are due more often than the manager looks for them */
    double period = notifier->watchdog > 0.0 ? fmin(1.0, 0.25 * notifier->watchdog) : 1.0;
    notify(notifier, "READY=1");
    for (;;) {
        look_at_place(standby);
        report(service, notifier);
        int signal_number = wait_for_signal(signals, period);
        if (signal_number == SIGHUP)
            reload(service, notifier);
        else if (signal_number == SIGUSR1)
            service_back_up(service);
        else if (signal_number) {
            log_line(LEVEL_INFO, "signal %s: draining", sigabbrev_np(signal_number));
            return;
        }
        service_tick(service);
    }
}

/* Answers what is queued, for a bounded time or until the signal comes again. */
static bool drain(struct service *service, const sigset_t *signals, double seconds,
                  const struct notifier *notifier)
{
    notify(notifier, "STOPPING=1\nEXTEND_TIMEOUT_USEC=%.0f", 1e6 * (seconds + END_SECONDS));
    service_begin_drain(service);
    bool drained = false;
    for (double waited = 0.0; !drained && waited <= seconds; waited += 0.25) {
        drained = service_drain(service, 0.25);
        report(service, notifier);
        int signal_number = wait_for_signal(signals, 0.0);
        if (!drained && (signal_number == SIGTERM || signal_number == SIGINT))
            break;
    }
    return drained || service_cut_short(service);
}

static void *take_apart(void *service)
{
    service_free(service);
    return NULL;
}

/* Takes the service apart. False: it takes too long. Cyclone DDS ends its threads that receive by a
 * packet to its own address each, which never comes where the machine has lost that address. */
static bool is_taken_apart(struct service *service)
{
    pthread_t thread;
    struct timespec end;
    if (pthread_create(&thread, NULL, take_apart, service) != 0) {
        service_free(service);
        return true;
    }
    clock_gettime(CLOCK_MONOTONIC, &end);
    end.tv_sec += (time_t)APART_SECONDS;
    return pthread_clockjoin_np(thread, NULL, CLOCK_MONOTONIC, &end) == 0;
}

int main(int argc, char **argv)
{
    struct arguments arguments = arguments_read(argc, argv);
    struct settings settings;
    struct fault fault;
    /* a store alone, or the settings, which may be all that is to be looked at */
    if (arguments.check_store)
        return store_care_check_file(arguments.check_store) ? EXIT_SUCCESS : EXIT_FAILURE;
    if (gather_settings(&arguments, &settings, &fault) ||
        (!arguments.check_config && limits_check(&settings, &fault))) {
        fprintf(stderr, "percussd: %s\n", fault.text);
        free(arguments.shipped);
        return EXIT_FAILURE;
    }
    if (!arguments.check_config) {
        log_limit(settings.log_level);
        log_use(settings.log_format);
        log_limit_rate();
        limits_fit(&settings);
    }
    name_settings(&arguments, arguments.check_config);
    if (arguments.check_config)
        return check_config(&settings) ? EXIT_SUCCESS : EXIT_FAILURE;
    struct notifier notifier = notifier_open();
    /* blocked before there are threads, so that no thread takes them */
    sigset_t signals = block_signals();
    /* its turn, where several have the task */
    uint8_t server[16];
    enum standby_end place = settings.standby[0]
                                 ? standby_wait(&settings, &signals, &notifier, server, &fault)
                                 : STANDBY_TAKEN;
    if (place == STANDBY_STOPPED)
        return EXIT_SUCCESS;
    struct service *service = NULL;
    if (place == STANDBY_TAKEN)
        service = service_create(&settings, settings.standby[0] ? server : NULL, &fault);
    if (!service) {
        log_line(LEVEL_ERROR, "%s", fault.text);
        return EXIT_FAILURE;
    }
    /* until a signal, and then what is still queued */
    serve(service, &signals, &notifier, settings.standby);
    if (!drain(service, &signals, settings.drain_seconds, &notifier)) {
        /* a thread still works, so nothing is taken apart */
        log_sum_up(true);
        log_line(LEVEL_ERROR, "ends with requests unanswered");
        _exit(EXIT_FAILURE);
    }
    log_sum_up(true);
    if (!is_taken_apart(service)) {
        log_line(LEVEL_ERROR,
                 "DDS does not end within %g s (has this machine lost its address?): "
                 "ends without it",
                 APART_SECONDS);
        _exit(EXIT_FAILURE);
    }
    notifier_close(&notifier);
    log_line(LEVEL_INFO, "ended");
    return EXIT_SUCCESS;
}
