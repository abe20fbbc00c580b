/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Finding a server. A volatile request or reply that is written before both ends know each other is
 * lost, so a client asks only after a ping came back. Pings go to all servers; later requests name
 * the server that was chosen among those that answered, and the others ignore them. */

#include "connect.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "announcements.h"
#include "convert.h"
#include "error.h"
#include "exchange.h"
#include "failure.h"
#include "library.h"
#include "matched.h"
#include "moment.h"
#include "ping.h"
#include "receive.h"
#include "wire_daemons.h"

/* The partitions of the domain in which servers announce themselves. */

enum { MOST_NAMES = 4, TAKEN_AT_ONCE = 32 };

struct names {
    char name[MOST_NAMES][WIRE_PARTITION_SIZE];
    size_t count;
};

/* Each name once; there may be more than are worth naming. */
static void add_partition(struct names *names, const char *name)
{
    for (size_t i = 0; i < names->count; i++)
        if (strcmp(names->name[i], name) == 0)
            return;
    if (names->count < MOST_NAMES && strlen(name) < WIRE_PARTITION_SIZE)
        strcpy(names->name[names->count++], name);
}

/* The partition of a writer of announcements; empty: none. */
static void add_writer(struct names *names, const dds_builtintopic_endpoint_t *writer)
{
    uint32_t count = 0;
    char **partitions = NULL;
    if (strcmp(writer->topic_name, WIRE_TOPIC_SERVER_STATUS) != 0)
        return;
    dds_qget_partition(writer->qos, &count, &partitions);
    add_partition(names, count > 0 ? partitions[0] : "");
    for (uint32_t i = 0; i < count; i++)
        dds_free(partitions[i]);
    dds_free(partitions);
}

/* DDS reports all writers of the domain, of any partition. */
static void take_writers(dds_entity_t publications, struct names *names)
{
    void *samples[TAKEN_AT_ONCE] = {NULL};
    dds_sample_info_t infos[TAKEN_AT_ONCE];
    dds_return_t count;
    while ((count = dds_take(publications, samples, infos, TAKEN_AT_ONCE, TAKEN_AT_ONCE)) > 0) {
        for (dds_return_t i = 0; i < count; i++)
            if (infos[i].valid_data)
                add_writer(names, samples[i]);
        dds_return_loan(publications, samples, count);
    }
}

/* Words for where servers are that are not in the client's partition: "; one is in partition gears,
 * one in no partition"; empty: nowhere. */
static void partitions_list(const struct percuss_client *client, char *text, size_t size)
{
    struct names names = {.count = 0};
    size_t length = 0;
    *text = '\0';
    dds_entity_t publications =
        dds_create_reader(client->participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, NULL, NULL);
    if (publications < 0)
        return;
    take_writers(publications, &names);
    dds_delete(publications);
    /* those in our own would have been found */
    for (size_t i = 0; i < names.count && length < size; i++) {
        const char *name = names.name[i];
        if (strcmp(name, client->partition) != 0)
            length += (size_t)snprintf(text + length, size - length, "%s in %s%s",
                                       length ? ", one" : "; one is",
                                       *name ? "partition " : "no partition", name);
    }
}

/* The servers of the domain, by their announcements. */

/* s; servers that are there are all discovered within it, but for those that hang, and where the
 * machine is busy */
#define SERVERS_SETTLING 0.2
/* s; a server that others hear of is heard of within it, or by then they know that it has gone: its
 * lease of 1.7 s, and the second until they say so */
#define SERVERS_MISSING 2.7

/* Opens the reader that servers_look needs. */
enum percuss_result servers_open(struct percuss_client *client);

/* Those that have announced themselves by now, longest up first, draining ones last. For
 * percuss_server_list_free. `known` (may be NULL): their number by the announcements of those
 * servers. */
enum percuss_result servers_look(struct percuss_client *client, struct percuss_server_list *list,
                                 size_t *known);

/* Words for a server: its id, and where it runs if it has announced itself (NULL: not yet). */
void servers_describe(const uint8_t id[16], const struct percuss_server *server,
                      char text[SERVERS_NAME_SIZE]);

/* Whether its id begins as the configuration says. */
bool servers_is_wanted(const struct percuss_client *client, const uint8_t id[16]);

/* The one of that id; NULL: it is not in the list. */
const struct percuss_server *servers_find(const struct percuss_server_list *list,
                                          const uint8_t id[16]);

/* Requests that wait for each of its workers; a long computation takes all of them. INFINITY: it
 * drains. */
double servers_load(const struct percuss_server *server);

/* How many read requests, announced or not. */
size_t servers_reading(const struct percuss_client *client);

/* A server with the keys of its place in the list. */
struct sighting {
    bool draining;
    double started; /* s, by the clock of its host */
    struct percuss_server server;
};

static int compare_sightings(const void *left, const void *right)
{
    const struct sighting *a = left, *b = right;
    if (a->draining != b->draining)
        return a->draining - b->draining;
    if (a->started != b->started)
        return a->started < b->started ? -1 : 1;
    return memcmp(a->server.server, b->server.server, sizeof a->server.server);
}

/* The valid ones among the samples; their number. False: no memory for all of them. */
static bool list_sightings(const struct announcements *all, struct sighting *sightings,
                           size_t *listed)
{
    size_t count = 0;
    bool good = true;
    for (int i = 0; i < all->count; i++) {
        if (!all->infos[i].valid_data)
            continue;
        struct sighting *sighting = &sightings[count++];
        good = convert_announced_server(all->samples[i], &sighting->server) && good;
        sighting->draining = strcmp(sighting->server.state, "ready") != 0;
        sighting->started = 1e-9 * (double)all->infos[i].source_timestamp - sighting->server.uptime;
    }
    qsort(sightings, count, sizeof *sightings, compare_sightings);
    *listed = count;
    return good;
}

void servers_describe(const uint8_t id[16], const struct percuss_server *server,
                      char text[SERVERS_NAME_SIZE])
{
    int length =
        snprintf(text, SERVERS_NAME_SIZE, "percussd %02x%02x%02x%02x", id[0], id[1], id[2], id[3]);
    if (server)
        snprintf(text + length, SERVERS_NAME_SIZE - (size_t)length, " (process %u on %s)",
                 server->process, server->host);
}

/* Names the server that we stay with once it has announced itself: when it has gone, its host is no
 * longer known. */
static void note_name(struct percuss_client *client, const struct percuss_server_list *list)
{
    pthread_mutex_lock(&client->lock);
    const struct percuss_server *ours = servers_find(list, client->server.id);
    if (ours)
        servers_describe(client->server.id, ours, client->server_name);
    pthread_mutex_unlock(&client->lock);
}

/* Servers hear of each other, and say of how many. One of 0.1.0 says nothing. */
static size_t count_known(const struct announcements *all)
{
    size_t known = 0;
    for (int i = 0; i < all->count; i++) {
        const percuss_v1_ServerStatus *status = all->samples[i];
        if (all->infos[i].valid_data && known < 1 + (size_t)status->others)
            known = 1 + (size_t)status->others;
    }
    return known;
}

enum percuss_result servers_look(struct percuss_client *client, struct percuss_server_list *list,
                                 size_t *known)
{
    struct announcements all;
    *list = (struct percuss_server_list){0};
    if (known)
        *known = 0;
    enum percuss_result result = announcements_read(client, client->server_reader, &all);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* all that are announced, in the order in which they are preferred */
    struct sighting *sightings = calloc((size_t)all.count + 1, sizeof *sightings);
    list->servers = calloc((size_t)all.count + 1, sizeof *list->servers);
    bool good = sightings && list->servers;
    if (good)
        good = list_sightings(&all, sightings, &list->count);
    for (size_t i = 0; i < list->count; i++)
        list->servers[i] = sightings[i].server;
    if (known)
        *known = count_known(&all);
    announcements_release(&all);
    /* out of memory is said, and nothing kept */
    free(sightings);
    if (good) {
        note_name(client, list);
        return PERCUSS_RESULT_OK;
    }
    percuss_server_list_free(list);
    return error_set(PERCUSS_RESULT_NO_MEMORY, "a list of servers");
}

const struct percuss_server *servers_find(const struct percuss_server_list *list,
                                          const uint8_t id[16])
{
    for (size_t i = 0; i < list->count; i++)
        if (memcmp(list->servers[i].server, id, 16) == 0)
            return &list->servers[i];
    return NULL;
}

enum percuss_result servers_open(struct percuss_client *client)
{
    return announcements_open(client, &client->server_reader, &percuss_v1_ServerStatus_desc,
                              WIRE_TOPIC_SERVER_STATUS);
}

double servers_load(const struct percuss_server *server)
{
    if (strcmp(server->state, "ready") != 0)
        return INFINITY;
    double workers = fmax(1.0, server->workers);
    return server->queue_length / workers + (server->activity[0] ? 1.0 : 0.0);
}

size_t servers_reading(const struct percuss_client *client)
{
    dds_return_t count = dds_get_matched_subscriptions(client->request_writer, NULL, 0);
    return count > 0 ? (size_t)count : 0;
}

enum percuss_result servers_list(struct percuss_client *client, double timeout,
                                 struct percuss_server_list *list)
{
    uint8_t server[16];
    double deadline, settled = moment_now() + SERVERS_SETTLING;
    *list = (struct percuss_server_list){0};
    enum percuss_result result = moment_deadline(timeout, &deadline);
    if (result == PERCUSS_RESULT_OK)
        result = servers_open(client);
    /* our own server must be among them, if there is one; else any will do */
    const bool connected = announcements_server(client, server);
    while (result == PERCUSS_RESULT_OK) {
        result = servers_look(client, list, NULL);
        bool found = connected ? servers_find(list, server) != NULL : list->count > 0;
        double now = moment_now();
        /* complete when every reader of requests has announced itself, or has had time to */
        bool all = list->count >= servers_reading(client) || now >= fmin(settled, deadline);
        if (result != PERCUSS_RESULT_OK || (found && all))
            return result;
        percuss_server_list_free(list);
        if (now >= deadline)
            return error_set(connected ? PERCUSS_RESULT_TIMEOUT : PERCUSS_RESULT_NO_SERVER,
                             "no percussd has announced itself in DDS domain %u", client->domain);
        dds_sleepfor(ANNOUNCEMENTS_INTERVAL);
    }
    return result;
}

bool servers_is_wanted(const struct percuss_client *client, const uint8_t id[16])
{
    char text[PERCUSS_SERVER_ID_SIZE];
    for (int i = 0; i < 16; i++)
        snprintf(text + 2 * i, 3, "%02x", id[i]);
    return strncmp(text, client->wanted, strlen(client->wanted)) == 0;
}

/* For a client that only observes, without a connected server: the first of the wanted ones. */
static enum percuss_result find_observed(struct percuss_client *client, double timeout,
                                         struct percuss_server *server)
{
    struct percuss_server_list servers;
    enum percuss_result result = servers_list(client, timeout, &servers);
    if (result != PERCUSS_RESULT_OK)
        return result;
    const struct percuss_server *found = NULL;
    for (size_t i = 0; i < servers.count && !found; i++)
        if (servers_is_wanted(client, servers.servers[i].server))
            found = &servers.servers[i];
    if (found) {
        *server = *found;
        pthread_mutex_lock(&client->lock);
        servers_describe(found->server, found, client->server_name);
        pthread_mutex_unlock(&client->lock);
    }
    /* its tasks go with the list */
    server->tasks = NULL;
    server->task_count = 0;
    percuss_server_list_free(&servers);
    return found
               ? PERCUSS_RESULT_OK
               : error_set(PERCUSS_RESULT_NO_SERVER,
                           "no percussd in DDS domain %u announces itself to us%s%s",
                           client->domain, client->wanted[0] ? " with an id that begins with " : "",
                           client->wanted);
}

enum percuss_result announcements_connected(struct percuss_client *client, double timeout,
                                            struct percuss_server *server)
{
    struct percuss_server_list servers;
    uint8_t id[16];
    char name[SERVERS_NAME_SIZE];
    if (client->observes)
        return find_observed(client, timeout, server);
    const bool connected = announcements_server(client, id);
    pthread_mutex_lock(&client->lock);
    enum percuss_result result = exchange_check_connected(client);
    memcpy(name, client->server_name, sizeof name);
    pthread_mutex_unlock(&client->lock);
    /* another thread may have connected again in between */
    if (!connected && result == PERCUSS_RESULT_OK)
        result = failure_lost(name);
    if (result == PERCUSS_RESULT_OK)
        result = servers_list(client, timeout, &servers);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* it may have gone meanwhile, while others are there */
    const struct percuss_server *ours = servers_find(&servers, id);
    if (ours)
        *server = *ours;
    /* its tasks go with the list */
    server->tasks = NULL;
    server->task_count = 0;
    percuss_server_list_free(&servers);
    return ours ? PERCUSS_RESULT_OK : failure_lost(name);
}

static const double MATCH_POLL = 1e-3;       /* s */
static const double DISCOVERY_SPREAD = 0.05; /* s between the discovery of one server and another */
static const double LOOK_INTERVAL = 0.1;     /* s between looks for a server where there is none */
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
    size_t known;     /* servers, by their announcements */
    size_t most_seen; /* of announced */
    double news;      /* when so many were seen for the first time */
};

/* The error when the time is over and no server has been chosen. */
static enum percuss_result explain(const struct search *search)
{
    struct percuss_client *client = search->client;
    const struct percuss_server_list *announced = &search->announced;
    char others[512] = "", name[SERVERS_NAME_SIZE];
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
    /* a server with incompatible qualities of service may be there */
    enum percuss_result result = check_compatible(client);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* no server in sight */
    if (client->wanted[0])
        return error_set(PERCUSS_RESULT_NO_SERVER,
                         "no percussd in DDS domain %u has an id that begins with %s%s",
                         client->domain, client->wanted, others);
    if (servers_reading(client) > 0)
        return error_set(PERCUSS_RESULT_NO_SERVER,
                         "no percussd has answered in DDS domain %u, where somebody reads requests "
                         "who has not announced himself",
                         client->domain);
    /* some may be out of hearing */
    partitions_list(client, others, sizeof others);
    if (!others[0])
        wire_daemons_explain(client->domain, others, sizeof others);
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

/* Whether another server might be chosen: one that reads requests or has announced itself but has
 * not answered, or has answered and not announced yet since when it is up. */
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

/* Looks for announced servers. */
static enum percuss_result look_around(struct search *search)
{
    enum percuss_result result = servers_look(search->client, &search->announced, &search->known);
    if (search->announced.count > search->most_seen) {
        search->most_seen = search->announced.count;
        search->news = moment_now();
    }
    return result;
}

/* PENDING: no server can be chosen yet. */
static enum percuss_result choose(struct search *search)
{
    struct percuss_client *client = search->client;
    const struct client_server *server;
    const double now = moment_now();
    /* no answer so far: patience before a server is called incompatible */
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

static bool is_in_sight(const struct percuss_client *client, const void *subject)
{
    return is_answered(client, subject) || servers_reading(client) > 0;
}

/* Pings all servers and collects their answers, until another one comes or the next ping is due.
 * Where there is none it waits until one comes. */
static enum percuss_result ping_all(struct search *search)
{
    struct percuss_client *client = search->client;
    const bool anybody = servers_reading(client) > 0;
    const double until =
        fmin(search->deadline, moment_now() + (anybody ? PING_INTERVAL : LOOK_INTERVAL));
    pthread_mutex_lock(&client->lock);
    enum percuss_result result = anybody ? ping_write(client, NULL) : PERCUSS_RESULT_OK;
    if (result == PERCUSS_RESULT_OK)
        result = receive_until(client, anybody ? is_answered : is_in_sight, &search->count, until);
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
        /* a round is shorter than the time between two calls of the watch */
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
