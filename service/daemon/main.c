/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "daemon/arguments.h"
#include "daemon/check_config.h"
#include "daemon/log.h"
#include "daemon/service.h"
#include "daemon/settings.h"

/* Settings file, then command line. */
static enum percuss_status gather_settings(const struct arguments *arguments,
                                           struct settings *settings, struct fault *fault)
{
    *settings = settings_default();
    if (arguments->config && settings_load(arguments->config, settings, fault))
        return PERCUSS_BAD_REQUEST;
    if (arguments->domain >= 0)
        settings->domain = (unsigned)arguments->domain;
    if (arguments->log_format >= 0)
        settings->log_format = (enum log_format)arguments->log_format;
    if (arguments->catalogue)
        snprintf(settings->catalogue, sizeof settings->catalogue, "%s", arguments->catalogue);
    if (!settings->catalogue[0])
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "%s: catalogue: missing: must be given there or as --catalogue FILE",
                         arguments->config);
    return PERCUSS_OK;
}

/* The signals the main thread waits for; threads started later inherit that they are blocked. */
static sigset_t block_signals(void)
{
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &signals, NULL);
    signal(SIGPIPE, SIG_IGN);
    return signals;
}

/* A signal that came within `seconds`, or 0. */
static int wait_for_signal(const sigset_t *signals, long seconds)
{
    struct timespec timeout = {.tv_sec = seconds};
    int signal_number = sigtimedwait(signals, NULL, &timeout);
    return signal_number > 0 ? signal_number : 0;
}

/* Until somebody asks for the end. */
static void serve(struct service *service, const sigset_t *signals)
{
    for (;;) {
        int signal_number = wait_for_signal(signals, 1);
        if (signal_number == SIGHUP)
            service_reload(service);
        else if (signal_number) {
            log_line(LEVEL_INFO, "signal %s: draining", sigabbrev_np(signal_number));
            return;
        }
        service_tick(service);
    }
}

/* Answers what is queued, for a bounded time or until the signal comes again. */
static bool drain(struct service *service, const sigset_t *signals, double seconds)
{
    service_begin_drain(service);
    bool drained = false;
    for (double waited = 0.0; !drained && waited <= seconds; waited += 0.25) {
        drained = service_drain(service, 0.25);
        int signal_number = wait_for_signal(signals, 0);
        if (!drained && signal_number && signal_number != SIGHUP)
            break;
    }
    return drained || service_cut_short(service);
}

int main(int argc, char **argv)
{
    struct arguments arguments = arguments_read(argc, argv);
    struct settings settings;
    struct fault fault;
    /* the settings, which may be all that is to be looked at */
    if (gather_settings(&arguments, &settings, &fault)) {
        fprintf(stderr, "percussd: %s\n", fault.text);
        return EXIT_FAILURE;
    }
    if (arguments.check_config)
        return check_config(&settings) ? EXIT_SUCCESS : EXIT_FAILURE;
    log_limit(settings.log_level);
    log_use(settings.log_format);
    /* blocked before there are threads, so that no thread takes them */
    sigset_t signals = block_signals();
    struct service *service = service_create(&settings, &fault);
    if (!service) {
        log_line(LEVEL_ERROR, "%s", fault.text);
        return EXIT_FAILURE;
    }
    /* until a signal, and then what is still queued */
    serve(service, &signals);
    if (!drain(service, &signals, settings.drain_seconds)) {
        /* a thread still works, so nothing is taken apart */
        log_line(LEVEL_ERROR, "ends with requests unanswered");
        _exit(EXIT_FAILURE);
    }
    service_free(service);
    log_line(LEVEL_INFO, "ended");
    return EXIT_SUCCESS;
}
