/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss doctor: what keeps a server from answering. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "configuration.h"
#include "dds_look.h"
#include "domains.h"
#include "json_writer.h"
#include "machine.h"
#include "start_advice.h"
#include "state.h"

static error_t parse(int key, char *text, struct argp_state *state)
{
    (void)text;
    if (key != ARGP_KEY_INIT)
        return ARGP_ERR_UNKNOWN;
    state->child_inputs[0] = state->input;
    return 0;
}

static const struct argp_child children[] = {{&common_argp, 0, NULL, 0}, {0}};
const struct argp doctor_argp = {
    .parser = parse,
    .doc = "Looks for what keeps a server from answering, or from answering well: domain, "
           "variables, the configuration of DDS, interfaces, other processes of the domain, the "
           "server itself, daemons of this machine and their files. A line for each: ok, warning "
           "or problem, what was found, and what to do."
           "\vExit status: 0 nothing is wrong, 1 a server answers and something is wrong, 2 "
           "usage, 3 no server, 4 a server is there and has not answered.",
    .children = children,
};

/* Where the domain comes from. */
static void look_at_domain(const struct common *common, struct findings *findings)
{
    const char *stated = getenv("PERCUSS_DOMAIN");
    const bool set = stated && *stated;
    const bool by_variable = set && strtoul(stated, NULL, 10) == common->domain;
    if (set && !by_variable)
        findings_add(findings, FINDING_OK, "domain", NULL, "%u, by --domain; PERCUSS_DOMAIN is %s",
                     common->domain, stated);
    else
        findings_add(findings, FINDING_OK, "domain", NULL, "%u%s", common->domain,
                     by_variable           ? ", as PERCUSS_DOMAIN says"
                     : common->domain == 0 ? ", as neither --domain nor PERCUSS_DOMAIN says another"
                                           : ", by --domain");
}

/* Those that change who is asked. */
static void look_at_variables(struct findings *findings)
{
    static const char *const names[] = {"PERCUSS_DOMAIN", "PERCUSS_PARTITION", "PERCUSS_SERVER",
                                        "PERCUSS_SECURITY", "CYCLONEDDS_URI"};
    char text[700] = "";
    size_t length = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names && length < sizeof text; i++) {
        const char *value = getenv(names[i]);
        if (value && *value)
            length += (size_t)snprintf(text + length, sizeof text - length, "%s%s=%.100s%s",
                                       length ? ", " : "", names[i], value,
                                       strlen(value) > 100 ? "..." : "");
    }
    findings_add(findings, FINDING_OK, "variables", NULL, "%s",
                 text[0] ? text : "neither PERCUSS_* nor CYCLONEDDS_URI are set");
}

static const struct percuss_server *find_server(const struct percuss_server_list *list,
                                                const uint8_t id[16])
{
    for (size_t i = 0; i < list->count; i++)
        if (memcmp(list->servers[i].server, id, 16) == 0)
            return &list->servers[i];
    return NULL;
}

/* One that answers beside ours. */
static void look_at_other(const struct percuss_server *ours, const struct percuss_server *other,
                          struct findings *findings)
{
    char id[33];
    format_hex(other->server, id);
    bool alike = strcmp(ours->catalogue_revision, other->catalogue_revision) == 0;
    findings_add(findings, alike ? FINDING_OK : FINDING_WARNING, "another daemon",
                 alike ? NULL
                       : "stop one of them, choose with --server, or give each a domain of its own "
                         "(--domain N, PERCUSS_DOMAIN)",
                 "percussd %.8s (process %u on %s) answers here too, with %s (%s)", id,
                 other->process, other->host, alike ? "the same catalogue" : "another catalogue",
                 other->catalogue);
}

/* Its version, its load and its clock. */
static void look_at_server(const struct percuss_server *server, const struct dds_look *look,
                           struct findings *findings)
{
    static const double NOTICEABLE = 1.0; /* s; announcements take some ms on a busy machine */
    if (strcmp(server->version, PERCUSS_VERSION) != 0)
        findings_add(findings, FINDING_WARNING, "version",
                     "install the same one on both sides: what one of them does not know is left "
                     "out",
                     "percussd is %s, percuss is " PERCUSS_VERSION, server->version);
    if (strcmp(server->state, "ready") != 0)
        findings_add(findings, FINDING_WARNING, "state of the daemon",
                     "start it again when it has ended", "it is ending (%s)", server->state);
    if (10 * server->queue_length >= 9 * server->queue_capacity)
        findings_add(findings, FINDING_WARNING, "queue",
                     "percuss status shows for whom it works; PercussBusy in the runbook",
                     "%u of %u places are taken: requests are refused", server->queue_length,
                     server->queue_capacity);
    const double ahead = dds_look_clock(look, server->server);
    if (fabs(ahead) >= NOTICEABLE)
        findings_add(findings, FINDING_WARNING, "clock", "set both by NTP",
                     "that of %s is %.1f s %s ours: times in the two logs do not agree",
                     server->host, fabs(ahead), ahead > 0.0 ? "ahead of" : "behind");
    else if (!isnan(ahead))
        findings_add(findings, FINDING_OK, "clock", NULL, "within %.1g s of that of %s",
                     fmax(1e-3, fabs(ahead)), server->host);
}

/* The one that has answered, and the others. */
static void look_at_servers(const struct common *common, struct percuss_client *client,
                            const struct dds_look *look, struct findings *findings)
{
    struct percuss_server_list list;
    uint8_t id[16];
    char digits[33];
    double trip = NAN;
    percuss_client_server(client, id);
    if (percuss_servers(client, common_patience(common), &list) != PERCUSS_RESULT_OK) {
        findings_add(findings, FINDING_WARNING, "daemon", NULL, "the servers cannot be listed: %s",
                     percuss_error_text());
        return;
    }
    const struct percuss_server *ours = find_server(&list, id);
    const bool answers = percuss_ping(client, common_patience(common), &trip) == PERCUSS_RESULT_OK;
    format_hex(id, digits);
    if (ours && !answers)
        findings_add(findings, FINDING_WARNING, "daemon",
                     "look whether it is stopped or busy (its log, top)",
                     "percussd %s %.8s (process %u on %s) announces itself and does not answer: %s",
                     ours->version, digits, ours->process, ours->host, percuss_error_text());
    if (ours && answers) {
        findings_add(findings, FINDING_OK, "daemon", NULL,
                     "percussd %s %.8s (process %u on %s) answers within %.0f us: %s, up %.0f s, "
                     "%u bodies, %u specimens kept, catalogue %s",
                     ours->version, digits, ours->process, ours->host, 1e6 * trip, ours->state,
                     ours->uptime, ours->bodies, ours->specimens, ours->catalogue);
        look_at_server(ours, look, findings);
    }
    for (size_t i = 0; ours && i < list.count; i++)
        if (&list.servers[i] != ours)
            look_at_other(ours, &list.servers[i], findings);
    percuss_server_list_free(&list);
}

/* That there is none; and where there is one. */
static void look_elsewhere(const struct common *common, struct findings *findings)
{
    unsigned domains[DOMAINS_MOST];
    char advice[1200], found[768], text[128] = "";
    size_t length = 0;
    /* before the library has something else to say */
    snprintf(found, sizeof found, "%s", percuss_error_text());
    start_advice(common, advice, sizeof advice);
    findings_add(findings, FINDING_PROBLEM, "daemon",
                 wire_daemons_are_in(common->domain) ? NULL : advice, "%s", found);
    size_t count = domains_with_server(common, domains);
    for (size_t i = 0; i < count && length < sizeof text; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%u", i ? ", " : "",
                                   domains[i]);
    if (count > 0)
        findings_add(findings, FINDING_WARNING, "other domains",
                     "ask there: --domain N, or PERCUSS_DOMAIN=N",
                     "percussd announces itself in domain %s of this machine", text);
}

/* Whether a server answers; returns the exit code. */
static int look_for_server(const struct common *common, struct percuss_client *client,
                           const struct dds_look *look, struct findings *findings)
{
    char text[PERCUSS_WARNING_SIZE];
    if (percuss_client_warning(client, text))
        findings_add(findings, FINDING_WARNING, "security", NULL, "%s", text);
    enum percuss_result result = percuss_client_connect(client, common_patience(common));
    const unsigned silent = dds_look_participants(look, findings);
    const char *identity = getenv("PERCUSS_SECURITY");
    if (silent > 0 && result != PERCUSS_RESULT_OK && !common->security && !(identity && *identity))
        findings_add(
            findings, FINDING_WARNING, "security",
            "name the folder of an identity: --security DIR, or PERCUSS_SECURITY",
            "%u of the participants tell%s nothing more, as a secured daemon to whoever has "
            "no identity",
            silent, silent == 1 ? "s" : "");
    if (result == PERCUSS_RESULT_OK) {
        look_at_servers(common, client, look, findings);
        return EXIT_ANSWERED;
    }
    if (result == PERCUSS_RESULT_NO_SERVER)
        look_elsewhere(common, findings);
    else
        findings_add(findings, FINDING_PROBLEM, "daemon",
                     result == PERCUSS_RESULT_TIMEOUT
                         ? "look whether it is stopped or busy (its log, top); --timeout S waits "
                           "longer"
                         : NULL,
                     "%s", percuss_error_text());
    return result == PERCUSS_RESULT_TIMEOUT ? EXIT_TIMEOUT : EXIT_NO_SERVER;
}

/* In a process of its own, which a configuration of DDS may end. */
static int look_at_network(void *context, struct findings *findings)
{
    const struct common *common = context;
    struct dds_look look;
    struct percuss_client *client;
    struct percuss_client_config config = percuss_client_config_default();
    const char *security = common->security ? common->security : getenv("PERCUSS_SECURITY");
    const char *partition = common->partition ? common->partition : getenv("PERCUSS_PARTITION");
    config.domain = common->domain;
    memcpy(config.server, common->server, sizeof config.server);
    if (!dds_look_open(common->domain, partition, security && *security ? security : NULL, &look,
                       findings))
        return EXIT_NO_SERVER;
    int code = EXIT_NO_SERVER;
    if (percuss_client_create_in(&config, common->partition, common->security, &client) ==
        PERCUSS_RESULT_OK)
        code = look_for_server(common, client, &look, findings);
    else
        findings_add(findings, FINDING_PROBLEM, "client", NULL, "%s", percuss_error_text());
    percuss_client_free(client);
    dds_look_close(&look);
    return code;
}

/* That the process with DDS has not come to an end by itself. */
static void look_at_end(const struct watched *end, struct findings *findings)
{
    if (end->late)
        findings_add(findings, FINDING_PROBLEM, "DDS", NULL,
                     "it has not come back, and was ended: so programs with this configuration "
                     "hang");
    else if (end->code < 0)
        findings_add(findings, FINDING_PROBLEM, "DDS", NULL,
                     "it has ended the process, by signal %s", strsignal(end->signal));
}

/* The daemons of this machine, or the one that would be started. */
static void look_at_machine(const struct common *common, bool answered, struct findings *findings)
{
    char daemon[PATH_MAX], settings[PATH_MAX];
    struct wire_daemon *daemons = calloc(WIRE_DAEMONS_MOST, sizeof *daemons);
    if (!daemons)
        return;
    size_t count = machine_look_at_daemons(common->domain, answered, daemons, findings);
    for (size_t i = 0; i < count && start_advice_program(daemon); i++)
        if (!daemons[i].elsewhere)
            state_look_at_running(&daemons[i], daemon, findings);
    if (count == 0 && !answered && start_advice_daemon(daemon, settings))
        state_look_at_start(daemon, settings, common->domain, findings);
    free(daemons);
}

static size_t count_level(const struct findings *findings, enum finding_level level)
{
    size_t count = 0;
    for (size_t i = 0; i < findings->count; i++)
        count += findings->each[i].level == level;
    return count;
}

static void print_text(const struct findings *findings)
{
    for (size_t i = 0; i < findings->count; i++) {
        const struct finding *finding = &findings->each[i];
        printf("%-8s %s: %s%s%s\n", finding_level_name(finding->level), finding->subject,
               finding->found, finding->advice[0] ? "; to do: " : "", finding->advice);
    }
    size_t problems = count_level(findings, FINDING_PROBLEM);
    size_t warnings = count_level(findings, FINDING_WARNING);
    if (problems + warnings == 0)
        puts("nothing is wrong");
    else
        printf("%zu problem%s, %zu warning%s\n", problems, problems == 1 ? "" : "s", warnings,
               warnings == 1 ? "" : "s");
}

/* What is not UTF-8, as a path may be, with ? for its bytes beyond ASCII. */
static json_t *printable(const char *text)
{
    json_t *whole = json_string(text);
    if (whole)
        return whole;
    char plain[sizeof((struct finding *)0)->found];
    snprintf(plain, sizeof plain, "%s", text);
    for (char *at = plain; *at; at++)
        if (*at & 0x80)
            *at = '?';
    return json_string(plain);
}

static void print_json(const struct findings *findings)
{
    json_t *root = json_object(), *list = json_array();
    json_object_set_new(root, "problems",
                        json_integer((json_int_t)count_level(findings, FINDING_PROBLEM)));
    json_object_set_new(root, "warnings",
                        json_integer((json_int_t)count_level(findings, FINDING_WARNING)));
    json_object_set_new(root, "findings", list);
    for (size_t i = 0; i < findings->count; i++) {
        const struct finding *finding = &findings->each[i];
        json_array_append_new(list, json_pack("{sssssoso}", "level",
                                              finding_level_name(finding->level), "subject",
                                              finding->subject, "found", printable(finding->found),
                                              "advice", printable(finding->advice)));
    }
    json_print(root);
}

int command_doctor(int argc, char **argv, struct common *common)
{
    /* s besides the patience of connecting, listing and asking: to look at other domains, at the
     * clock, and to join and leave */
    static const double BESIDES = 10.0, PATIENCES = 3.0;
    struct findings findings = {0}, of_network = {0};
    struct watched end;
    argp_parse(&doctor_argp, argc, argv, 0, NULL, common);
    if (common->local) {
        complain("doctor: --local asks no server: there is nothing to look at");
        return EXIT_USAGE;
    }
    findings_add(&findings, FINDING_OK, "version", NULL, "percuss " PERCUSS_VERSION);
    look_at_domain(common, &findings);
    look_at_variables(&findings);
    machine_look_at_interfaces(configuration_given() != NULL, &findings);
    const unsigned taken = machine_indices(common->domain);
    watched_run(look_at_network, common, PATIENCES * common_patience(common) + BESIDES, &of_network,
                &end);
    configuration_look(&end, taken, &findings);
    for (size_t i = 0; i < of_network.count; i++)
        findings_keep(&findings, &of_network.each[i]);
    look_at_end(&end, &findings);
    look_at_machine(common, end.code == EXIT_ANSWERED, &findings);
    (common->json ? print_json : print_text)(&findings);
    int code = end.code < 0 ? EXIT_NO_SERVER : end.code;
    if (code == EXIT_ANSWERED && count_level(&findings, FINDING_OK) < findings.count)
        code = EXIT_ANSWERED_WITH_WARNING;
    free(findings.each);
    free(of_network.each);
    free(end.log);
    return code;
}
