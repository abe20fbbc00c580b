/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The daemon's program. main() at the end is the order of the world: command line and settings, its
 * turn where several daemons have the task, the service until a signal, the queued requests, the
 * end. */

#include <argp.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "catalogue/shipped.h"
#include "daemon/check_config.h"
#include "daemon/limits.h"
#include "daemon/log.h"
#include "daemon/notify.h"
#include "daemon/service.h"
#include "daemon/specimen_lane.h"
#include "daemon/standby.h"
#include "exchange/clock.h"
#include "percuss/habits.h"
#include "respond/settings.h"

enum { KEY_CHECK = 0x100, KEY_STORE, KEY_FORMAT, KEY_PARTITION, USAGE = 2 };

const char *argp_program_version = "percussd " PERCUSS_VERSION;

/* The command line. */
struct arguments {
    const char *config, *catalogue; /* NULL: not given */
    char *shipped;                  /* settings used where none are given, for free(); NULL: none */
    int domain;                     /* -1: not given */
    const char *partition;          /* NULL: not given; empty: none */
    int log_format;                 /* enum log_format; -1: not given */
    bool check_config;
    const char *check_store; /* file; NULL: not asked for */
};

static const struct argp_option ARGUMENT_OPTIONS[] = {
    {"config", 'c', "FILE", 0,
     "Settings; the shipped percussd.yaml explains each key, and is read where no other file is "
     "given",
     0},
    {"catalogue", 'C', "FILE", 0, "Bodies and materials; goes before the one in the settings", 0},
    {"domain", 'd', "N", 0,
     "DDS domain, 0 to 230; goes before PERCUSS_DOMAIN, and that before the one in the settings",
     0},
    {"partition", KEY_PARTITION, "NAME", 0,
     "Answer only those who ask in this DDS partition; goes before PERCUSS_PARTITION, and that "
     "before the one in the settings; empty: none",
     0},
    {"log-format", KEY_FORMAT, "FORMAT", 0,
     "text, json (an object a line) or journal (of systemd); goes before the one in the settings",
     0},
    {"check-config", KEY_CHECK, NULL, 0,
     "Look at all that a start needs, say ok or what is wrong: of settings and catalogue the first "
     "error of each",
     0},
    {"check-store", KEY_STORE, "FILE", 0,
     "Look through a store of specimens, or a copy, that no daemon has open", 0},
    {0},
};

static int arguments_domain(struct argp_state *state, const char *name, const char *text)
{
    char *end;
    long domain = strtol(text, &end, 10);
    if (end == text || *end || domain < 0 || domain > SETTINGS_MAX_DOMAIN)
        argp_error(state, "%s: %s: must be a whole number, 0 to %d", name, text,
                   SETTINGS_MAX_DOMAIN);
    return (int)domain;
}

static const char *arguments_partition(struct argp_state *state, const char *name, const char *text)
{
    if (*text && !wire_partition_is_good(text))
        argp_error(state, "%s: %s: must be " WIRE_PARTITION_RULE ", or empty", name, text);
    return text;
}

static int arguments_format(struct argp_state *state, const char *text)
{
    for (enum log_format format = 0; format < LOG_FORMAT_COUNT; format++) {
        if (strcmp(text, log_format_name(format)) == 0)
            return (int)format;
    }
    argp_error(state, "--log-format: %s: must be text, journal or json", text);
    return -1;
}

/* Values of the environment, unless the command line has them. */
static void arguments_environment(struct argp_state *state, struct arguments *arguments)
{
    const char *domain = getenv("PERCUSS_DOMAIN");
    if (arguments->domain < 0 && domain && *domain)
        arguments->domain = arguments_domain(state, "PERCUSS_DOMAIN", domain);
    const char *partition = getenv("PERCUSS_PARTITION");
    if (!arguments->partition && partition && *partition)
        arguments->partition = arguments_partition(state, "PERCUSS_PARTITION", partition);
}

static error_t arguments_parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    switch (key) {
    /* files, domain and partition, and the log */
    case 'c':
        arguments->config = text;
        return 0;
    case 'C':
        arguments->catalogue = text;
        return 0;
    case 'd':
        arguments->domain = arguments_domain(state, "--domain", text);
        return 0;
    case KEY_PARTITION:
        arguments->partition = arguments_partition(state, "--partition", text);
        return 0;
    case KEY_FORMAT:
        arguments->log_format = arguments_format(state, text);
        return 0;
    /* only a check */
    case KEY_CHECK:
        arguments->check_config = true;
        return 0;
    case KEY_STORE:
        arguments->check_store = text;
        return 0;
    /* all options are read */
    case ARGP_KEY_END:
        arguments_environment(state, arguments);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* Ends the program for --help, --version and, with exit code 2, wrong usage. */
static struct arguments arguments_read(int argc, char **argv)
{
    static const struct argp argp = {
        .options = ARGUMENT_OPTIONS,
        .parser = arguments_parse,
        .children = habits,
        .doc =
            "Answers what impacts do, on DDS."
            "\vSIGTERM and SIGINT: answers what is waiting and ends. SIGHUP: reads the catalogue "
            "again; a bad one is logged and the old one stays. SIGUSR1: looks through the store of "
            "specimens and copies it to the file that the settings name as its backup.",
    };
    struct arguments arguments = {.domain = -1, .log_format = -1};
    argp_err_exit_status = USAGE;
    argp_parse(&argp, argc, argv, 0, NULL, &arguments);
    /* an administrator's catalogue needs the plain settings, without the shared store */
    if (!arguments.config && !arguments.check_store)
        arguments.shipped = arguments.catalogue ? shipped_plain_settings() : shipped_settings();
    return arguments;
}

enum { STATUS_SIZE = 400 };

/* Longer than the service's end after draining takes, s; and the time for it that the manager
 * grants before it kills the daemon. */
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

/* Says which settings were found where none were given. `look`: on stderr, for --check-config,
 * which is about the catalogue where one is given. */
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

/* Sends the manager the status, and a sign of life unless a thread has not moved for half of the
 * time after which the manager kills the daemon. */
static void report_to_manager(struct service *service, const struct notifier *notifier)
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

/* Ends the daemon where another one has taken its place and may answer already. */
static void look_at_place(const char *standby)
{
    if (!standby[0] || standby_is_held(standby))
        return;
    log_line(LEVEL_ERROR, "standby: %s: its lock is not this process's any more: ends at once",
             standby);
    _exit(EXIT_FAILURE);
}

/* Until a signal asks for the end. */
static void serve_until_signal(struct service *service, const sigset_t *signals,
                               const struct notifier *notifier, const char *standby)
{
    /* signs of life are sent more often than the manager expects them */
    double period = notifier->watchdog > 0.0 ? fmin(1.0, 0.25 * notifier->watchdog) : 1.0;
    notify(notifier, "READY=1");
    for (;;) {
        look_at_place(standby);
        report_to_manager(service, notifier);
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

/* Answers the queued requests, for a bounded time or until the signal comes again. Ends the process
 * where a thread still works after that, so that nothing can be taken apart. */
static void drain(struct service *service, const sigset_t *signals, double seconds,
                  const struct notifier *notifier)
{
    notify(notifier, "STOPPING=1\nEXTEND_TIMEOUT_USEC=%.0f", 1e6 * (seconds + END_SECONDS));
    service_begin_drain(service);
    bool drained = false;
    for (double waited = 0.0; !drained && waited <= seconds; waited += 0.25) {
        drained = service_drain(service, 0.25);
        report_to_manager(service, notifier);
        int signal_number = wait_for_signal(signals, 0.0);
        if (!drained && (signal_number == SIGTERM || signal_number == SIGINT))
            break;
    }
    drained = drained || service_cut_short(service);
    log_sum_up(true);
    if (drained)
        return;
    log_line(LEVEL_ERROR, "ends with requests unanswered");
    _exit(EXIT_FAILURE);
}

static void *free_service(void *service)
{
    service_free(service);
    return NULL;
}

/* Takes the service apart; ends the process where that takes too long. Cyclone DDS ends its threads
 * that receive by a packet to its own address each, which never comes where the machine has lost
 * that address. */
static void take_apart(struct service *service)
{
    pthread_t thread;
    struct timespec end;
    if (pthread_create(&thread, NULL, free_service, service) != 0) {
        service_free(service);
        return;
    }
    clock_gettime(CLOCK_MONOTONIC, &end);
    end.tv_sec += (time_t)APART_SECONDS;
    if (pthread_clockjoin_np(thread, NULL, CLOCK_MONOTONIC, &end) == 0)
        return;
    log_line(LEVEL_ERROR,
             "DDS does not end within %g s (has this machine lost its address?): "
             "ends without it",
             APART_SECONDS);
    _exit(EXIT_FAILURE);
}

/* Reads settings and limits and opens the log. False: they are wrong, as stderr says. With
 * --check-config the limits and the log are left to that. */
static bool configure(struct arguments *arguments, struct settings *settings)
{
    struct fault fault;
    bool check = arguments->check_config;
    if (gather_settings(arguments, settings, &fault) ||
        (!check && limits_check(settings, &fault))) {
        fprintf(stderr, "percussd: %s\n", fault.text);
        free(arguments->shipped);
        return false;
    }
    if (!check) {
        log_limit(settings->log_level);
        log_use(settings->log_format);
        log_limit_rate();
        limits_fit(settings);
    }
    name_settings(arguments, check);
    return true;
}

int main(int argc, char **argv)
{
    struct arguments arguments = arguments_read(argc, argv);
    struct settings settings;
    struct fault fault;
    uint8_t server[16];
    /* a store alone, or the settings, which may be all that is to be checked */
    if (arguments.check_store)
        return specimen_lane_check_file(arguments.check_store) ? EXIT_SUCCESS : EXIT_FAILURE;
    if (!configure(&arguments, &settings))
        return EXIT_FAILURE;
    if (arguments.check_config)
        return check_config(&settings) ? EXIT_SUCCESS : EXIT_FAILURE;
    /* signals are blocked before there are threads, so that no thread takes them */
    struct notifier notifier = notifier_open();
    sigset_t signals = block_signals();
    /* its turn, where several daemons have the task */
    const bool shares_task = settings.standby[0];
    enum standby_end place =
        shares_task ? standby_wait(&settings, &signals, &notifier, server, &fault) : STANDBY_TAKEN;
    if (place == STANDBY_STOPPED)
        return EXIT_SUCCESS;
    /* catalogue, tables, store, DDS, threads */
    struct service *service = NULL;
    if (place == STANDBY_TAKEN)
        service = service_create(&settings, shares_task ? server : NULL, &fault);
    if (!service) {
        log_line(LEVEL_ERROR, "%s", fault.text);
        return EXIT_FAILURE;
    }
    /* until a signal, then the queued requests, then the end */
    serve_until_signal(service, &signals, &notifier, settings.standby);
    drain(service, &signals, settings.drain_seconds, &notifier);
    take_apart(service);
    notifier_close(&notifier);
    log_line(LEVEL_INFO, "ended");
    return EXIT_SUCCESS;
}
