/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss-ros2: a percussd for programs that speak ROS 2. */

#include <argp.h>
#include <dds/dds.h>
#include <errno.h>
#include <math.h>
#include <percuss/percuss.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/units.h"
#include "give.h"
#include "percuss/habits.h"
#include "service.h"
#include "take.h"
#include "wire.h"

/* A line on standard error. */
__attribute__((format(printf, 1, 2))) static void say(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    flockfile(stderr);
    fputs("percuss-ros2: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    funlockfile(stderr);
    va_end(arguments);
}

/* The side of percussd. */

/* A client that several threads ask by, and its connection. */
struct ask_line {
    struct percuss_client *client;
    uint32_t domain;
    double timeout;                /* s for an answer */
    atomic_uint_fast64_t sequence; /* of the last question */
    pthread_mutex_t lock;          /* of `connections` and of connecting */
    unsigned connections;          /* so far */
    atomic_uint failures;          /* to connect */
};

/* An answer and the data that it borrows; zeroed before the first. */
struct ask {
    struct percuss_request request; /* large */
    struct percuss_reply reply;
    struct give_pieces pieces;
    char message[512];
    percuss_msgs_msg_dds__Answer_ answer;
};

static const double PATIENCE = 3.0; /* s for a server to appear; discovery takes 0.1 s */

static unsigned ask_connections(struct ask_line *line)
{
    pthread_mutex_lock(&line->lock);
    unsigned count = line->connections;
    pthread_mutex_unlock(&line->lock);
    return count;
}

/* Connects unless that has been done after `seen` connections. */
static bool ask_connect(struct ask_line *line, unsigned seen)
{
    unsigned failures = atomic_load(&line->failures);
    pthread_mutex_lock(&line->lock);
    /* another thread may have connected meanwhile, or tried in vain */
    if (line->connections == seen && atomic_load(&line->failures) == failures) {
        if (percuss_client_connect(line->client, PATIENCE) == PERCUSS_RESULT_OK) {
            line->connections++;
            say("connected to a percussd in domain %u", line->domain);
        } else {
            atomic_fetch_add(&line->failures, 1);
        }
    }
    bool connected = line->connections > seen;
    pthread_mutex_unlock(&line->lock);
    return connected;
}

static uint32_t status_of(enum percuss_result result)
{
    switch (result) {
    case PERCUSS_RESULT_INVALID_ARGUMENT:
        return PERCUSS_BAD_REQUEST;
    case PERCUSS_RESULT_TIMEOUT:
        return PERCUSS_TIMEOUT;
    case PERCUSS_RESULT_WINDOW_FULL:
        return PERCUSS_BUSY;
    case PERCUSS_RESULT_NO_SERVER:
    case PERCUSS_RESULT_INCOMPATIBLE:
        return percuss_msgs_msg_dds__Answer_STATUS_NO_SERVER;
    default:
        return PERCUSS_INTERNAL;
    }
}

static void ask_refuse(struct ask *ask, uint32_t status, const char *message)
{
    snprintf(ask->message, sizeof ask->message, "%s", message);
    give_refusal(status, ask->message, &ask->answer);
}

/* Fills ask->answer in any case: with a status where there is no answer. */
static void ask_answer(struct ask_line *line, struct ask *ask,
                       const percuss_msgs_msg_dds__Question_ *question)
{
    char problem[TAKE_PROBLEM_SIZE];
    if (!take_question(question, &ask->request, problem)) {
        ask_refuse(ask, PERCUSS_BAD_REQUEST, problem);
        return;
    }
    ask->request.sequence = atomic_fetch_add(&line->sequence, 1) + 1;
    unsigned seen = ask_connections(line);
    const double timeout = line->timeout;
    enum percuss_result result = PERCUSS_RESULT_NO_SERVER;
    if (seen > 0)
        result = percuss_solve(line->client, &ask->request, timeout, &ask->reply);
    /* one that has gone may have been started again, and knows by the number the requests that it
     * has answered */
    if (result == PERCUSS_RESULT_NO_SERVER && ask_connect(line, seen))
        result = percuss_solve(line->client, &ask->request, timeout, &ask->reply);
    if (result == PERCUSS_RESULT_NO_SERVER) {
        snprintf(problem, sizeof problem, "no percussd answers in DDS domain %u", line->domain);
        ask_refuse(ask, status_of(result), problem);
    } else if (result != PERCUSS_RESULT_OK)
        ask_refuse(ask, status_of(result), percuss_error_text());
    else if (!give_answer(&ask->pieces, &ask->reply, &ask->answer))
        ask_refuse(ask, PERCUSS_INTERNAL, "the bridge is out of memory");
}

/* Releases the data that the answer borrows. */
static void ask_clear(struct ask *ask)
{
    give_pieces_free(&ask->pieces);
    percuss_reply_free(&ask->reply);
}

/* Topics and a service of ROS 2 on the one side, a percussd on the other. Each of several threads
 * takes one question at a time and waits for its answer. */

enum { BRIDGE_NAME_SIZE = 128, BRIDGE_MOST_THREADS = 64, BRIDGE_MOST_SILENT = 64 };

struct bridge_config {
    struct percuss_client_config client;
    uint32_t ros_domain;
    bool network;       /* the side of ROS 2 hears other machines */
    const char *prefix; /* of all names: letters, digits, _ and / */
    double timeout;     /* s for an answer */
    unsigned threads;
};

/* Writers of questions on the topic without a reader of replies of their own: others read them. The
 * latest ones. */
struct bridge_silent {
    pthread_mutex_t lock;
    dds_instance_handle_t writers[BRIDGE_MOST_SILENT];
    unsigned count;
};

struct bridge {
    struct bridge_config config;
    struct ask_line line;
    dds_entity_t participant, stop;
    dds_entity_t request_reader, reply_writer;   /* topics */
    dds_entity_t service_reader, service_writer; /* rmw_cyclonedds */
    dds_entity_t body_writer;
    struct percuss_body_list announced;
    struct bridge_silent silent;
    pthread_t threads[BRIDGE_MOST_THREADS];
    unsigned running;
};

static const double BODIES_TIMEOUT = 1.0; /* s; they are there already, once connected */

static bool is_silent(struct bridge_silent *silent, dds_instance_handle_t writer)
{
    bool found = false;
    pthread_mutex_lock(&silent->lock);
    for (unsigned i = 0; i < silent->count && i < BRIDGE_MOST_SILENT && !found; i++)
        found = silent->writers[i] == writer;
    pthread_mutex_unlock(&silent->lock);
    return found;
}

/* Waits for the asker's reader, but once for an asker without one. */
static void await_reader(struct bridge *bridge, dds_instance_handle_t client)
{
    struct bridge_silent *silent = &bridge->silent;
    if (is_silent(silent, client) ||
        service_await(bridge->request_reader, bridge->reply_writer, client))
        return;
    pthread_mutex_lock(&silent->lock);
    silent->writers[silent->count++ % BRIDGE_MOST_SILENT] = client;
    pthread_mutex_unlock(&silent->lock);
}

/* A question on the topic: the reply has the same client and number. */
static void answer_topic(struct bridge *bridge, struct ask *ask, const void *sample,
                         dds_instance_handle_t client)
{
    const percuss_msgs_msg_dds__Request_ *request = sample;
    percuss_msgs_msg_dds__Reply_ reply = {.sequence_number = request->sequence_number};
    memcpy(reply.client, request->client, sizeof reply.client);
    ask_answer(&bridge->line, ask, &request->question);
    reply.answer = ask->answer;
    await_reader(bridge, client);
    dds_return_t written = dds_write(bridge->reply_writer, &reply);
    if (written < 0)
        say("a reply was not written: %s", dds_strretcode(-written));
    ask_clear(ask);
}

/* One of the service: the reply begins with the request's beginning. */
static void answer_service(struct bridge *bridge, struct ask *ask, const void *sample,
                           dds_instance_handle_t client)
{
    const percuss_msgs_srv_dds__Impact_Request_ *request = sample;
    percuss_msgs_srv_dds__Impact_Response_ response = {.header_guid = request->header_guid,
                                                       .header_number = request->header_number};
    ask_answer(&bridge->line, ask, &request->question);
    response.answer = ask->answer;
    service_await(bridge->service_reader, bridge->service_writer, client);
    dds_return_t written = dds_write(bridge->service_writer, &response);
    if (written < 0)
        say("a response was not written: %s", dds_strretcode(-written));
    ask_clear(ask);
}

/* Takes and answers one question of that reader, if there is one. */
static void serve(struct bridge *bridge, struct ask *ask, dds_entity_t reader)
{
    void *sample = NULL;
    dds_sample_info_t info;
    if (dds_take(reader, &sample, &info, 1, 1) != 1)
        return;
    if (info.valid_data && reader == bridge->request_reader)
        answer_topic(bridge, ask, sample, info.publication_handle);
    else if (info.valid_data)
        answer_service(bridge, ask, sample, info.publication_handle);
    dds_return_loan(reader, &sample, 1);
}

static void *work(void *argument)
{
    struct bridge *bridge = argument;
    struct ask *ask = calloc(1, sizeof *ask);
    dds_entity_t waitset = dds_create_waitset(bridge->participant);
    const dds_entity_t readers[] = {bridge->request_reader, bridge->service_reader};
    bool stopped = !ask || waitset < 0 || dds_waitset_attach(waitset, bridge->stop, 0) < 0;
    /* conditions, which hold while there are samples: each take leaves the others */
    for (size_t i = 0; i < 2 && !stopped; i++) {
        dds_entity_t unread = dds_create_readcondition(readers[i], DDS_ANY_STATE);
        stopped = unread < 0 || dds_waitset_attach(waitset, unread, unread) < 0;
    }
    if (stopped)
        say("a thread could not begin");
    /* every thread is woken, one gets the sample */
    while (!stopped) {
        dds_attach_t woken[3];
        dds_waitset_wait(waitset, woken, 3, DDS_INFINITY);
        for (size_t i = 0; i < 2; i++)
            serve(bridge, ask, readers[i]);
        bool triggered = false;
        stopped = dds_read_guardcondition(bridge->stop, &triggered) < 0 || triggered;
    }
    if (waitset > 0)
        dds_delete(waitset);
    free(ask);
    return NULL;
}

/* A reader or a writer of a topic named `kind`/`prefix`/`name`; 0 after a message. */
static dds_entity_t create_end(struct bridge *bridge, const dds_topic_descriptor_t *type,
                               const char *kind, const char *name, dds_qos_t *qos)
{
    char topic_name[BRIDGE_NAME_SIZE + 32];
    bool reads = strstr(name, "equest") != NULL;
    snprintf(topic_name, sizeof topic_name, "%s/%s/%s", kind, bridge->config.prefix, name);
    dds_entity_t topic = wire_topic_create(bridge->participant, type, topic_name);
    dds_entity_t end = topic;
    if (topic > 0)
        end = reads ? dds_create_reader(bridge->participant, topic, qos, NULL)
                    : dds_create_writer(bridge->participant, topic, qos, NULL);
    if (end < 0)
        say("%s: %s", topic_name, dds_strretcode(-end));
    return end < 0 ? 0 : end;
}

static bool create_ends(struct bridge *bridge)
{
    dds_qos_t *topics = wire_qos_exchange(NULL), *service = wire_qos_exchange(NULL);
    dds_qos_t *announced = wire_qos_announcement(NULL);
    service_name(bridge->participant, service);
    bridge->reply_writer =
        create_end(bridge, &percuss_msgs_msg_dds__Reply__desc, "rt", "reply", topics);
    bridge->request_reader =
        create_end(bridge, &percuss_msgs_msg_dds__Request__desc, "rt", "request", topics);
    bridge->service_writer = create_end(bridge, &percuss_msgs_srv_dds__Impact_Response__desc, "rr",
                                        "impactReply", service);
    bridge->service_reader = create_end(bridge, &percuss_msgs_srv_dds__Impact_Request__desc, "rq",
                                        "impactRequest", service);
    bridge->body_writer =
        create_end(bridge, &percuss_msgs_msg_dds__BodyList__desc, "rt", "bodies", announced);
    dds_delete_qos(announced);
    dds_delete_qos(service);
    dds_delete_qos(topics);
    return bridge->reply_writer && bridge->request_reader && bridge->service_writer &&
           bridge->service_reader && bridge->body_writer;
}

/* False, with the fault on standard error; bridge_free in any case. */
static bool bridge_open(struct bridge *bridge, const struct bridge_config *config)
{
    *bridge = (struct bridge){
        .config = *config, .line = {.domain = config->client.domain, .timeout = config->timeout}};
    pthread_mutex_init(&bridge->line.lock, NULL);
    pthread_mutex_init(&bridge->silent.lock, NULL);
    /* percussd's side first: where both are in one domain, its participant makes it */
    char warning[PERCUSS_WARNING_SIZE];
    if (percuss_client_create(&config->client, &bridge->line.client) != PERCUSS_RESULT_OK) {
        say("%s", percuss_error_text());
        return false;
    }
    if (percuss_client_observes(bridge->line.client)) {
        say("PERCUSS_SECURITY: the permissions of that identity do not allow asking");
        return false;
    }
    if (percuss_client_warning(bridge->line.client, warning))
        say("warning: %s", warning);
    bridge->participant = config->network ? wire_participant_create_open(config->ros_domain)
                                          : wire_participant_create(config->ros_domain);
    if (bridge->participant < 0) {
        say("DDS domain %u: %s", config->ros_domain, wire_participant_problem(bridge->participant));
        return false;
    }
    if (!create_ends(bridge))
        return false;
    bridge->stop = dds_create_guardcondition(bridge->participant);
    while (bridge->running < config->threads) {
        if (bridge->stop < 0 ||
            pthread_create(&bridge->threads[bridge->running], NULL, work, bridge)) {
            say("a thread cannot be made");
            return false;
        }
        bridge->running++;
    }
    return true;
}

/* Their pairs are those of the catalogue. */
static bool same_bodies(const struct percuss_body_list *a, const struct percuss_body_list *b)
{
    return a->count == b->count && strcmp(a->catalogue_revision, b->catalogue_revision) == 0 &&
           (a->count == 0 || memcmp(a->bodies, b->bodies, a->count * sizeof *a->bodies) == 0);
}

/* To be called now and then: connects where no server is known, and announces its bodies where they
 * are others than before. */
static void bridge_tend(struct bridge *bridge)
{
    struct percuss_body_list list = {0};
    struct give_pieces pieces = {0};
    percuss_msgs_msg_dds__BodyList_ bodies = {0};
    /* a lost server is looked for at the next question, the first one at once */
    if (percuss_bodies(bridge->line.client, BODIES_TIMEOUT, &list) != PERCUSS_RESULT_OK) {
        if (!ask_connect(&bridge->line, ask_connections(&bridge->line)) ||
            percuss_bodies(bridge->line.client, BODIES_TIMEOUT, &list) != PERCUSS_RESULT_OK)
            return;
    }
    if (same_bodies(&list, &bridge->announced)) {
        percuss_body_list_free(&list);
        return;
    }
    if (give_bodies(&pieces, &list, &bodies) && dds_write(bridge->body_writer, &bodies) >= 0) {
        percuss_body_list_free(&bridge->announced);
        bridge->announced = list;
    } else {
        percuss_body_list_free(&list);
    }
    give_pieces_free(&pieces);
}

/* Answers the current questions first. */
static void bridge_free(struct bridge *bridge)
{
    if (bridge->stop > 0)
        dds_set_guardcondition(bridge->stop, true);
    for (unsigned i = 0; i < bridge->running; i++)
        pthread_join(bridge->threads[i], NULL);
    if (bridge->participant > 0)
        dds_delete(bridge->participant);
    percuss_body_list_free(&bridge->announced);
    percuss_client_free(bridge->line.client);
    pthread_mutex_destroy(&bridge->line.lock);
    pthread_mutex_destroy(&bridge->silent.lock);
}

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
    /* a domain in the environment is checked as an option is; options override it */
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
