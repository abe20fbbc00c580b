/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Options of all commands, the client that they choose, and messages. */

#include <ctype.h>
#include <dlfcn.h>
#include <errno.h>
#include <math.h>
#include <percuss/local.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "others.h"
#include "percuss/habits.h"
#include "quantity.h"
#include "waiting.h"

/* The solver in this process, by libpercuss-local, which is loaded at its first use. */

/* The functions of the library that are used; the rest of its interface is that of libpercuss. */
struct library {
    struct percuss_local_config (*config_default)(void);
    enum percuss_result (*open)(const struct percuss_local_config *, struct percuss_client **);
    const char *(*error_text)(void);
};

/* It stays loaded till the end. False: it is not there, which is complained of. */
static bool load(struct library *library)
{
    void *handle = dlopen("libpercuss-local.so." PERCUSS_SOVERSION, RTLD_NOW | RTLD_LOCAL);
    if (handle) {
        *(void **)&library->config_default = dlsym(handle, "percuss_local_config_default");
        *(void **)&library->open = dlsym(handle, "percuss_local_open");
        *(void **)&library->error_text = dlsym(handle, "percuss_error_text");
    }
    if (handle && library->config_default && library->open && library->error_text)
        return true;
    complain("--local: %s: it comes with the package libpercuss-local" PERCUSS_SOVERSION, dlerror());
    return false;
}

/* A client that answers itself, by the settings and the catalogue that the options name.
 * EXIT_ANSWERED, or complains. */
static int in_process_open(const struct common *common, const uint8_t *id,
                           struct percuss_client **client)
{
    struct library library;
    *client = NULL;
    if (!load(&library))
        return EXIT_NO_SERVER;
    struct percuss_local_config config = library.config_default();
    config.settings = common->config;
    config.catalogue = common->catalogue;
    if (id)
        memcpy(config.id, id, sizeof config.id);
    enum percuss_result result = library.open(&config, client);
    if (result == PERCUSS_RESULT_OK)
        return EXIT_ANSWERED;
    complain("%s", library.error_text());
    return result == PERCUSS_RESULT_INVALID_ARGUMENT ? EXIT_USAGE : EXIT_ANSWERED_WITH_WARNING;
}

enum { HIGHEST_DOMAIN = 230 };
static const double DEFAULT_TIMEOUT = 30.0; /* s */
static const double DEFAULT_PATIENCE = 3.0; /* s for a server to appear; discovery takes 0.1 s */

static const struct argp_option common_options[] = {
    {"domain", OPTION_DOMAIN, "N", 0,
     "DDS domain of the server (default: PERCUSS_DOMAIN, or else 0)", 90},
    {"partition", OPTION_PARTITION, "NAME", 0,
     "DDS partition of the server, see percussd (default: PERCUSS_PARTITION, or else none)", 90},
    {"timeout", OPTION_TIMEOUT, "S", 0,
     "seconds, or with a unit, to wait for the server and then for the answer (default 3 and 30)",
     90},
    {"server", OPTION_SERVER, "ID", 0,
     "the server to ask: how its id begins, as percuss status shows it, or least-loaded: the one "
     "with least to do (default: PERCUSS_SERVER, or else the one up longest of those found within "
     "a moment)",
     90},
    {"security", OPTION_SECURITY, "DIR", 0,
     "folder of the identity to ask a secured server with (default: PERCUSS_SECURITY, or else "
     "none)",
     90},
    {"local", OPTION_LOCAL, NULL, 0, "solve in this process: no daemon is needed, none is asked",
     91},
    {"catalogue", OPTION_CATALOGUE, "FILE", 0,
     "with --local: bodies and materials (default: those of the settings)", 91},
    {"config", OPTION_CONFIG, "FILE", 0,
     "with --local: settings, as percussd reads them (default: those that are installed, which "
     "name "
     "a catalogue and contact tables)",
     91},
    {"json", OPTION_JSON, NULL, 0, "print one JSON object", 90},
    {"units", OPTION_UNITS, NULL, 0,
     "say units in the first line of comma-separated values: speed [m/s]", 90},
    {0},
};

double parse_number(const char *option, const char *text, struct argp_state *state)
{
    char *end;
    double number = strtod(text, &end);
    if (end == text || *end || !isfinite(number))
        argp_error(state, "--%s: '%s' is not a finite number", option, text);
    return number;
}

unsigned parse_count(const char *option, const char *text, unsigned most, struct argp_state *state)
{
    char *end;
    errno = 0;
    unsigned long number = strtoul(text, &end, 10);
    if (end == text || *end || errno || number > most || strchr(text, '-'))
        argp_error(state, "--%s: '%s' is not a whole number of 0..%u", option, text, most);
    return (unsigned)number;
}

static void parse_server(const char *text, char server[PERCUSS_SERVER_ID_SIZE],
                         struct argp_state *state)
{
    size_t length = strlen(text);
    bool digits = length > 0 && strspn(text, "0123456789abcdefABCDEF") == length;
    if (length >= PERCUSS_SERVER_ID_SIZE || (!digits && strcmp(text, PERCUSS_LEAST_LOADED) != 0))
        argp_error(state, "--server: '%s' is not 1 to %d hexadecimal digits, nor %s", text,
                   PERCUSS_SERVER_ID_SIZE - 1, PERCUSS_LEAST_LOADED);
    for (size_t i = 0; i <= length; i++)
        server[i] = (char)tolower((unsigned char)text[i]);
}

uint32_t environment_domain(void)
{
    uint32_t domain = percuss_client_config_default().domain;
    if (domain > HIGHEST_DOMAIN) {
        complain("PERCUSS_DOMAIN: '%s' is not a whole number of 0..%d", getenv("PERCUSS_DOMAIN"),
                 HIGHEST_DOMAIN);
        exit(EXIT_USAGE);
    }
    return domain;
}

void environment_server(char server[PERCUSS_SERVER_ID_SIZE])
{
    memcpy(server, percuss_client_config_default().server, PERCUSS_SERVER_ID_SIZE);
}

static error_t parse_common(int key, char *text, struct argp_state *state)
{
    struct common *common = state->input;
    switch (key) {
    /* which server, and how long it is waited for */
    case OPTION_DOMAIN:
        common->domain = parse_count("domain", text, HIGHEST_DOMAIN, state);
        return 0;
    case OPTION_PARTITION:
        common->partition = text;
        return 0;
    case OPTION_TIMEOUT:
        common->timeout = parse_quantity("timeout", text, QUANTITY_TIME, state);
        return 0;
    case OPTION_SERVER:
        parse_server(text, common->server, state);
        return 0;
    case OPTION_SECURITY:
        common->security = text;
        return 0;
    /* or none */
    case OPTION_LOCAL:
        common->local = true;
        return 0;
    case OPTION_CATALOGUE:
        common->catalogue = text;
        return 0;
    case OPTION_CONFIG:
        common->config = text;
        return 0;
    /* how it is told */
    case OPTION_JSON:
        common->json = true;
        return 0;
    case OPTION_UNITS:
        common->units = true;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

const struct argp common_argp = {
    .options = common_options, .parser = parse_common, .children = habits};

static error_t pass_on_common(int key, char *text, struct argp_state *state)
{
    (void)text;
    if (key != ARGP_KEY_INIT)
        return ARGP_ERR_UNKNOWN;
    state->child_inputs[0] = state->input;
    return 0;
}

void parse_only_common(int argc, char **argv, const char *doc, struct common *common)
{
    const struct argp_child children[] = {{&common_argp, 0, NULL, 0}, {0}};
    const struct argp only = {.parser = pass_on_common, .doc = doc, .children = children};
    argp_parse(&only, argc, argv, 0, NULL, common);
}

double common_timeout(const struct common *common)
{
    return isnan(common->timeout) ? DEFAULT_TIMEOUT : common->timeout;
}

double common_patience(const struct common *common)
{
    return isnan(common->timeout) ? DEFAULT_PATIENCE : common->timeout;
}

bool common_names_server(const struct common *common)
{
    return common->server[0] && strcmp(common->server, PERCUSS_LEAST_LOADED) != 0;
}

void complain(const char *format, ...)
{
    va_list arguments;
    waiting_clear();
    va_start(arguments, format);
    fputs("percuss: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
}

int complain_memory(void)
{
    complain("out of memory");
    return EXIT_FAILURE;
}

int complain_interrupted(void)
{
    complain("interrupted");
    return waiting_exit_code();
}

int complain_result(enum percuss_result result)
{
    if (result == PERCUSS_RESULT_OK)
        return EXIT_ANSWERED;
    if (result == PERCUSS_RESULT_CANCELLED)
        return complain_interrupted();
    complain("%s%s", percuss_error_text(),
             result == PERCUSS_RESULT_TIMEOUT ? "; --timeout S waits longer" : "");
    switch (result) {
    case PERCUSS_RESULT_TIMEOUT:
        return EXIT_TIMEOUT;
    case PERCUSS_RESULT_INVALID_ARGUMENT:
        return EXIT_USAGE;
    case PERCUSS_RESULT_NO_MEMORY:
        return EXIT_ANSWERED_WITH_WARNING;
    default:
        return EXIT_NO_SERVER;
    }
}

/* Of its identity, however many clients a command makes. */
static void warn_once(const struct percuss_client *client)
{
    static bool warned;
    char text[PERCUSS_WARNING_SIZE];
    if (!warned && percuss_client_warning(client, text))
        complain("warning: %s", text);
    warned = true;
}

int make_client(const struct common *common, const uint8_t *id, struct percuss_client **client)
{
    if (common->local)
        return in_process_open(common, id, client);
    if (common->catalogue || common->config) {
        *client = NULL;
        complain("--%s: needs --local: a server has its own",
                 common->catalogue ? "catalogue" : "config");
        return EXIT_USAGE;
    }
    struct percuss_client_config config = percuss_client_config_default();
    config.domain = common->domain;
    memcpy(config.server, common->server, sizeof config.server);
    if (id)
        memcpy(config.id, id, sizeof config.id);
    int code = complain_result(
        percuss_client_create_in(&config, common->partition, common->security, client));
    if (code == EXIT_ANSWERED)
        warn_once(*client);
    return code;
}

/* A server that is looked for. */
struct search {
    const struct common *common;
    unsigned asked; /* some ten times a second */
};

/* Says that it takes long, once. */
static bool search_goes_on(void *context)
{
    enum { UNSAID = 20 };
    struct search *search = context;
    const char *partition = search->common->partition;
    const bool among = partition && partition[0];
    if (++search->asked == UNSAID)
        complain("looking for a daemon in %s%s%sDDS domain %u ...", among ? "partition " : "",
                 among ? partition : "", among ? " of " : "", search->common->domain);
    return true;
}

int connect_client(const struct common *common, struct percuss_client *client)
{
    struct search search = {common, 0};
    percuss_client_watch(client, search_goes_on, &search);
    enum percuss_result result = percuss_client_connect(client, common_patience(common));
    percuss_client_watch(client, NULL, NULL);
    /* one that is secured is not started that easily */
    bool secured = common->security || getenv("PERCUSS_SECURITY");
    if (result != PERCUSS_RESULT_NO_SERVER || common_names_server(common) || secured)
        return complain_result(result);
    complain_no_server(common);
    return EXIT_NO_SERVER;
}

static int settle(const struct common *common, struct percuss_client **client)
{
    int code = connect_client(common, *client);
    if (code == EXIT_ANSWERED)
        code = others_settle(common, *client);
    if (code == EXIT_ANSWERED)
        return code;
    percuss_client_free(*client);
    *client = NULL;
    return code;
}

int open_client(const struct common *common, const uint8_t *id, struct percuss_client **client)
{
    int code = make_client(common, id, client);
    return code == EXIT_ANSWERED ? settle(common, client) : code;
}

int open_onlooker(const struct common *common, struct percuss_client **client)
{
    int code = make_client(common, NULL, client);
    return code == EXIT_ANSWERED && !percuss_client_observes(*client) ? settle(common, client)
                                                                      : code;
}

int status_exit_code(enum percuss_status status)
{
    switch (status) {
    case PERCUSS_OK:
        return EXIT_ANSWERED;
    case PERCUSS_TRUNCATED:
    case PERCUSS_NOT_APPROACHING:
        return EXIT_ANSWERED_WITH_WARNING;
    case PERCUSS_TIMEOUT:
        return EXIT_TIMEOUT;
    default:
        return EXIT_REJECTED;
    }
}

void format_hex(const uint8_t octets[16], char text[33])
{
    for (int i = 0; i < 16; i++)
        snprintf(text + 2 * i, 3, "%02x", octets[i]);
}
