/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Finding a server. A volatile request or reply that is written before both ends know each other is
 * lost, so a client asks only after a ping came back. Pings go to everybody; what is asked later
 * names the server that was chosen among those that answered, and the others ignore it. */

#include "connect.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "error.h"
#include "exchange.h"
#include "failure.h"
#include "library.h"
#include "matched.h"
#include "moment.h"
#include "partitions.h"
#include "ping.h"
#include "receive.h"
#include "servers.h"

static const double MATCH_POLL = 1e-3;       /* s */
static const double DISCOVERY_SPREAD = 0.05; /* s between the discovery of one server and another */
static const double GRACE = 2.0; /* s until incompatible qualities of service are a verdict */

static enum percuss_result unanswered(const char *server, double start)
{
    return error_set(PERCUSS_RESULT_TIMEOUT, "%s is there but has not answered for %.1f s (busy?)",
                     server, moment_now() - start);
}

enum percuss_result connect_match(struct percuss_client *client, dds_entity_t writer,
                                  dds_entity_t reader, double deadline)
{
    const double start = moment_now();
    dds_guid_t participant;
    char name[sizeof client->server_name];
    /* the server that is ours now */
    pthread_mutex_lock(&client->lock);
    dds_instance_handle_t replies = client->server.writer;
    memcpy(name, client->server_name, sizeof name);
    pthread_mutex_unlock(&client->lock);
    /* while it is there: both endpoints are to find its process */
    while (matched_participant(dds_get_matched_publication_data, client->reply_reader, replies,
                               &participant)) {
        if (matched_both(writer, reader, &participant))
            return PERCUSS_RESULT_OK;
        if (moment_now() >= deadline)
            return unanswered(name, start);
        dds_sleepfor((dds_duration_t)(1e9 * MATCH_POLL));
    }
    return failure_lost(name);
}

static const char *policy_name(uint32_t policy)
{
    static const struct {
        dds_qos_policy_id_t policy;
        const char *name;
    } names[] = {
        {DDS_DURABILITY_QOS_POLICY_ID, "durability"},
        {DDS_PRESENTATION_QOS_POLICY_ID, "presentation"},
        {DDS_DEADLINE_QOS_POLICY_ID, "deadline"},
        {DDS_OWNERSHIP_QOS_POLICY_ID, "ownership"},
        {DDS_LIVELINESS_QOS_POLICY_ID, "liveliness"},
        {DDS_RELIABILITY_QOS_POLICY_ID, "reliability"},
        {DDS_DESTINATIONORDER_QOS_POLICY_ID, "destination order"},
        {DDS_TYPE_CONSISTENCY_ENFORCEMENT_QOS_POLICY_ID, "type consistency"},
        {DDS_DATA_REPRESENTATION_QOS_POLICY_ID, "data representation"},
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (names[i].policy == policy)
            return names[i].name;
    return "a policy unknown to this library";
}

/* INCOMPATIBLE with the policy in words if DDS has refused a match, else OK. */
static enum percuss_result check_compatible(struct percuss_client *client)
{
    uint32_t requests = atomic_load(&client->refused_requests);
    uint32_t policy = requests ? requests : atomic_load(&client->refused_replies);
    if (!policy)
        return PERCUSS_RESULT_OK;
    return error_set(PERCUSS_RESULT_INCOMPATIBLE,
                     "a server is there, but its %s do not match ours: %s (policy %u)",
                     requests ? "requests" : "replies", policy_name(policy), policy);
}

/* A search for a server. */
struct search {
    struct percuss_client *client;
    double start, deadline;
    double heard;                                        /* when the first answer had come */
    struct client_server answering[CLIENT_MOST_SERVERS]; /* a copy */
    size_t count;
    struct percuss_server_list announced;
    size_t known;     /* servers, by what those say */
    size_t most_seen; /* of announced */
    double news;      /* when so many were seen for the first time */
};

/* What there is when the time is over and no server has been chosen. */
static enum percuss_result explain(const struct search *search)
{
    struct percuss_client *client = search->client;
    const struct percuss_server_list *announced = &search->announced;
    char others[200] = "", name[SERVERS_NAME_SIZE];
    size_t length = 0;
    /* the wanted one may be there and not answer; others are worth naming */
    for (size_t i = 0; i < announced->count; i++) {
        const struct percuss_server *server = &announced->servers[i];
        servers_describe(server->server, server, name);
        if (servers_is_wanted(client, server->server))
            return unanswered(name, search->start);
        if (length < sizeof others)
            length += (size_t)snprintf(others + length, sizeof others - length, "%s%s",
                                       i ? ", " : "; there is ", name);
    }
    /* somebody may be there whose qualities of service rule us out */
    enum percuss_result result = check_compatible(client);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* nobody, as far as can be seen */
    if (client->wanted[0])
        return error_set(PERCUSS_RESULT_NO_SERVER,
                         "no percussd in DDS domain %u has an id that begins with %s%s",
                         client->domain, client->wanted, others);
    if (servers_reading(client) > 0)
        return error_set(PERCUSS_RESULT_NO_SERVER,
                         "no percussd has answered in DDS domain %u, where somebody reads requests "
                         "who has not announced himself",
                         client->domain);
    partitions_list(client, others, sizeof others);
    return error_set(PERCUSS_RESULT_NO_SERVER, "no percussd in %s%s%sDDS domain %u%s%s",
                     client->partition[0] ? "partition " : "", client->partition,
                     client->partition[0] ? " of " : "", client->domain,
                     client->secured ? " accepts our certificate and permissions" : "", others);
}

static const struct client_server *find_answering(const struct search *search,
                                                  const struct percuss_server *announced)
{
    for (size_t k = 0; k < search->count; k++)
        if (memcmp(announced->server, search->answering[k].id, 16) == 0)
            return &search->answering[k];
    return NULL;
}

/* The answering one that was up first, or of all the one that has least to do; those that have not
 * announced themselves come last. */
static const struct client_server *find_best(const struct search *search)
{
    const struct client_server *best = NULL;
    double least = INFINITY;
    for (size_t i = 0; i < search->announced.count; i++) {
        const struct percuss_server *server = &search->announced.servers[i];
        const struct client_server *answering = find_answering(search, server);
        double load = search->client->least_loaded ? servers_load(server) : 0.0;
        if (answering && (!best || load < least)) {
            best = answering;
            least = load;
        }
    }
    return best ? best : search->answering;
}

/* The one that is wanted among those that answer. PENDING: none; INVALID_ARGUMENT: several. */
static enum percuss_result find_wanted(const struct search *search,
                                       const struct client_server **found)
{
    *found = NULL;
    for (size_t k = 0; k < search->count; k++) {
        if (!servers_is_wanted(search->client, search->answering[k].id))
            continue;
        if (*found)
            return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                             "server: '%s': the ids of several servers begin so: more digits are "
                             "needed",
                             search->client->wanted);
        *found = &search->answering[k];
    }
    return *found ? PERCUSS_RESULT_OK : PERCUSS_RESULT_PENDING;
}

/* Stays with a server. */
static void settle_on(const struct search *search, const struct client_server *server)
{
    struct percuss_client *client = search->client;
    pthread_mutex_lock(&client->lock);
    client->server = *server;
    /* false when it has gone already, which receive_note_loss sees too */
    matched_participant(dds_get_matched_publication_data, client->reply_reader, server->writer,
                        &client->server.participant);
    servers_describe(server->id, servers_find(&search->announced, server->id), client->server_name);
    client->connected = true;
    receive_note_loss(client);
    pthread_mutex_unlock(&client->lock);
}

/* Whether somebody may be there who would be chosen: one who reads requests or has announced
 * himself but has not answered, or has answered and not said yet since when he is up. */
static bool may_be_more(const struct search *search)
{
    bool more =
        search->count < servers_reading(search->client) || search->count < search->announced.count;
    for (size_t k = 0; k < search->count; k++)
        more = more || !servers_find(&search->announced, search->answering[k].id);
    return more;
}

/* When one of those that answer is chosen, if nothing else comes. */
static double settling(const struct search *search)
{
    if (!search->client->least_loaded)
        return search->heard + (may_be_more(search) ? SERVERS_SETTLING : DISCOVERY_SPREAD);
    /* by their load: all are to be heard of, and to have time to answer */
    return search->announced.count < search->known
               ? search->heard + SERVERS_MISSING
               : fmax(search->heard, search->news) + SERVERS_SETTLING;
}

/* Looks who has announced himself by now. */
static enum percuss_result look_around(struct search *search)
{
    enum percuss_result result = servers_look(search->client, &search->announced, &search->known);
    if (search->announced.count > search->most_seen) {
        search->most_seen = search->announced.count;
        search->news = moment_now();
    }
    return result;
}

/* PENDING: nobody can be chosen yet. */
static enum percuss_result choose(struct search *search)
{
    struct percuss_client *client = search->client;
    const struct client_server *server;
    const double now = moment_now();
    /* no answer so far: patience before anybody is called incompatible */
    if (search->count == 0)
        return now - search->start < GRACE ? PERCUSS_RESULT_PENDING
               : check_compatible(client)  ? PERCUSS_RESULT_INCOMPATIBLE
                                           : PERCUSS_RESULT_PENDING;
    /* others that answer within a moment have a chance as well */
    search->heard = fmin(search->heard, now);
    if (now < fmin(settling(search), search->deadline))
        return PERCUSS_RESULT_PENDING;
    /* the best of them, or the one that is wanted */
    if (!client->wanted[0]) {
        settle_on(search, find_best(search));
        return PERCUSS_RESULT_OK;
    }
    enum percuss_result result = find_wanted(search, &server);
    if (result == PERCUSS_RESULT_OK)
        settle_on(search, server);
    return result;
}

static bool is_answered(const struct percuss_client *client, const void *subject)
{
    const size_t *before = subject;
    return client->answering_count > *before;
}

/* Pings all servers and collects who answers, until another one has or the next ping is due. */
static enum percuss_result ping_all(struct search *search)
{
    struct percuss_client *client = search->client;
    pthread_mutex_lock(&client->lock);
    enum percuss_result result = ping_write(client, NULL);
    double until = fmin(search->deadline, moment_now() + PING_INTERVAL);
    if (result == PERCUSS_RESULT_OK)
        result = receive_until(client, is_answered, &search->count, until);
    search->count = client->answering_count;
    memcpy(search->answering, client->answering, sizeof search->answering);
    pthread_mutex_unlock(&client->lock);
    return result == PERCUSS_RESULT_TIMEOUT ? PERCUSS_RESULT_OK : result;
}

enum percuss_result connect_find(struct percuss_client *client, double timeout)
{
    struct search search = {.client = client, .start = moment_now(), .heard = INFINITY};
    enum percuss_result result = moment_deadline(timeout, &search.deadline);
    if (client->observes)
        return error_set(PERCUSS_RESULT_TRANSPORT,
                         "asking a server: our permissions do not allow it: the identity in %s may "
                         "only see what servers announce",
                         client->identity);
    if (result == PERCUSS_RESULT_OK)
        result = client_check_identity(client);
    if (result == PERCUSS_RESULT_OK)
        result = servers_open(client);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* answers from before do not count */
    pthread_mutex_lock(&client->lock);
    client->connected = false;
    client->answering_count = 0;
    const struct watching watching = client->watching;
    pthread_mutex_unlock(&client->lock);
    double ask = watching_first(&watching);
    /* asks and looks around until one can be chosen; the last round begins after the deadline */
    do {
        percuss_server_list_free(&search.announced);
        bool late = moment_now() >= search.deadline;
        result = client_check_identity(client);
        /* a round is shorter than the time between two questions to whoever watches */
        if (result == PERCUSS_RESULT_OK && !watching_asks(&watching, &ask))
            result = watching_cancelled();
        if (result == PERCUSS_RESULT_OK)
            result = ping_all(&search);
        if (result == PERCUSS_RESULT_OK)
            result = look_around(&search);
        if (result == PERCUSS_RESULT_OK)
            result = choose(&search);
        if (result == PERCUSS_RESULT_PENDING && late)
            result = explain(&search);
    } while (result == PERCUSS_RESULT_PENDING);
    percuss_server_list_free(&search.announced);
    return result;
}

static bool never(const struct percuss_client *client, const void *subject)
{
    (void)client, (void)subject;
    return false;
}

static bool ping_is_answered(const struct percuss_client *client, const void *subject)
{
    const uint64_t *before = subject;
    return client->pings_answered > *before;
}

enum percuss_result connect_ping(struct percuss_client *client, double timeout, double *round_trip)
{
    double deadline;
    enum percuss_result result = moment_deadline(timeout, &deadline);
    if (result != PERCUSS_RESULT_OK)
        return result;
    pthread_mutex_lock(&client->lock);
    result = exchange_check_connected(client);
    if (result == PERCUSS_RESULT_OK) {
        /* answers to earlier pings, which look the same, must not count */
        receive_until(client, never, NULL, 0.0);
        uint64_t before = client->pings_answered;
        double start = moment_now();
        result = ping_write(client, client->server.id);
        if (result == PERCUSS_RESULT_OK)
            result = receive_until(client, ping_is_answered, &before, deadline);
        if (result == PERCUSS_RESULT_TIMEOUT)
            result = unanswered(client->server_name, start);
        *round_trip = moment_now() - start;
    }
    pthread_mutex_unlock(&client->lock);
    return result;
}
