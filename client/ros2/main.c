/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss-ros2: a percussd for programs that speak ROS 2. */

#include <argp.h>
#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/units.h"
#include "bridge.h"
#include "percuss/habits.h"
#include "say.h"

enum { HIGHEST_DOMAIN = 230, HIGHEST_ROS_DOMAIN = 232, USAGE = 2, TEND_SECONDS = 2 };
enum { OPTION_DOMAIN = 256, OPTION_ROS, OPTION_NAMESPACE, OPTION_NETWORK, OPTION_SERVER };
enum { OPTION_TIMEOUT = 300, OPTION_THREADS };

const char *argp_program_version = "percuss-ros2 " PERCUSS_VERSION;

static const struct argp_option options[] = {
    {"domain", OPTION_DOMAIN, "N", 0, "DDS domain of percussd (default: PERCUSS_DOMAIN, or else 0)",
     0},
    {"ros-domain", OPTION_ROS, "N", 0, "of ROS 2 (default: ROS_DOMAIN_ID, or else 0)", 0},
    {"namespace", OPTION_NAMESPACE, "NAME", 0, "of topics and service (default: percuss)", 0},
    {"network", OPTION_NETWORK, NULL, 0,
     "be heard in ROS 2's domain as its nodes are, by other machines too; percussd's domain must "
     "be "
     "another one, and stays as it is (default: this machine only, unless CYCLONEDDS_URI says "
     "more)",
     0},
    {"server", OPTION_SERVER, "ID", 0, "the percussd to ask: how its id begins", 0},
    {"timeout", OPTION_TIMEOUT, "S", 0,
     "seconds, or with a unit, to wait for an answer (default 60)", 0},
    {"threads", OPTION_THREADS, "N", 0, "questions that wait for an answer at once (default 8)", 0},
    {0},
};

static unsigned parse_whole(const char *name, const char *text, unsigned least, unsigned most,
                            struct argp_state *state)
{
    char *end;
    errno = 0;
    unsigned long number = strtoul(text, &end, 10);
    if (end == text || *end || errno || number < least || number > most || strchr(text, '-'))
        argp_error(state, "%s: '%s' is not a whole number of %u..%u", name, text, least, most);
    return (unsigned)number;
}

static const char *parse_namespace(char *text, struct argp_state *state)
{
    const char *name = text + (*text == '/');
    size_t length = strlen(name);
    const char *letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_/";
    if (length == 0 || length >= BRIDGE_NAME_SIZE || strspn(name, letters) < length ||
        *name == '/' || name[length - 1] == '/' || strstr(name, "//"))
        argp_error(state, "--namespace: '%s': 1 to %d letters, digits, _ and single / are allowed",
                   text, BRIDGE_NAME_SIZE - 1);
    return name;
}

static double parse_timeout(const char *text, struct argp_state *state)
{
    double seconds;
    if (units_read(text, QUANTITY_TIME, &seconds) || !(seconds > 0.0))
        argp_error(state, "--timeout: '%s': a time > 0 is needed, in s or with a unit, such as %s",
                   text, units_example(QUANTITY_TIME));
    return seconds;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct bridge_config *config = state->input;
    switch (key) {
    case OPTION_DOMAIN:
        config->client.domain = parse_whole("--domain", text, 0, HIGHEST_DOMAIN, state);
        return 0;
    case OPTION_ROS:
        config->ros_domain = parse_whole("--ros-domain", text, 0, HIGHEST_ROS_DOMAIN, state);
        return 0;
    case OPTION_NAMESPACE:
        config->prefix = parse_namespace(text, state);
        return 0;
    case OPTION_NETWORK:
        config->network = true;
        return 0;
    case OPTION_SERVER:
        if (strlen(text) >= sizeof config->client.server)
            argp_error(state, "--server: '%s' is longer than an id", text);
        strncpy(config->client.server, text, sizeof config->client.server - 1);
        return 0;
    case OPTION_TIMEOUT:
        config->timeout = parse_timeout(text, state);
        return 0;
    case OPTION_THREADS:
        config->threads = parse_whole("--threads", text, 1, BRIDGE_MOST_THREADS, state);
        return 0;
    case ARGP_KEY_END:
        if (config->network && config->ros_domain == config->client.domain)
            argp_error(state,
                       "--network: percussd's domain %u is ROS 2's too; start percussd "
                       "with another --domain",
                       config->client.domain);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp argp = {
    .options = options,
    .parser = parse,
    .children = habits,
    .doc =
        "Answers questions about impacts in a ROS 2 domain by asking a percussd: topics "
        "/percuss/request and /percuss/reply, service /percuss/impact (rmw_cyclonedds), topic "
        "/percuss/bodies. SIGTERM ends it.\v"
        "The messages are those of the package percuss_msgs. Exit status: 0 ended by a signal, 1 "
        "it could not start, 2 usage."};

int main(int argc, char **argv)
{
    static struct bridge bridge;
    struct bridge_config config = {.client = percuss_client_config_default(),
                                   .prefix = "percuss",
                                   .timeout = 60.0,
                                   .threads = 8};
    argp_err_exit_status = USAGE;
    const char *ros_domain = getenv("ROS_DOMAIN_ID");
    /* a domain in the environment is checked as an option is; what follows overrides it */
    if (ros_domain && *ros_domain) {
        struct argp_state state = {
            .root_argp = &argp, .name = "percuss-ros2", .err_stream = stderr, .out_stream = stdout};
        config.ros_domain = parse_whole("ROS_DOMAIN_ID", ros_domain, 0, HIGHEST_ROS_DOMAIN, &state);
    }
    argp_parse(&argp, argc, argv, 0, NULL, &config);

    /* signals are waited for here, no thread is interrupted */
    sigset_t ending;
    sigemptyset(&ending);
    sigaddset(&ending, SIGTERM);
    sigaddset(&ending, SIGINT);
    pthread_sigmask(SIG_BLOCK, &ending, NULL);
    bool open = bridge_open(&bridge, &config);
    if (open) {
        say("ready: domain %u of ROS 2, /%s, percussd in domain %u", config.ros_domain,
            config.prefix, config.client.domain);
        do {
            bridge_tend(&bridge);
        } while (sigtimedwait(&ending, NULL, &(struct timespec){.tv_sec = TEND_SECONDS}) < 0);
    }
    bridge_free(&bridge);
    return open ? EXIT_SUCCESS : EXIT_FAILURE;
}
