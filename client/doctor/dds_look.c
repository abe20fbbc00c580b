/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "dds_look.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "configuration.h"
#include "wire.h"
#include "wire_security.h"

enum { TAKEN_AT_ONCE = 32, NAMED = 8 };

struct membership {
    uint32_t domain;
    const char *security;
};

static int join(void *context)
{
    const struct membership *membership = context;
    return wire_participant_create_client(membership->domain, membership->security);
}

bool dds_look_open(uint32_t domain, const char *partition, const char *security,
                   struct dds_look *look, struct findings *findings)
{
    char problem[512];
    struct membership membership = {domain, security};
    if (security && !wire_security_check(security, problem, sizeof problem)) {
        findings_add(findings, FINDING_PROBLEM, "identity",
                     "deploy/security/percuss-keys.sh makes it", "%s", problem);
        return false;
    }
    look->participant = configuration_trace(join, &membership);
    if (look->participant < 0) {
        /* the configuration is looked at by itself */
        if (look->participant != WIRE_CONFIGURED_BADLY)
            findings_add(findings, FINDING_PROBLEM, "DDS", NULL, "domain %u cannot be joined: %s",
                         domain, wire_participant_problem(look->participant));
        return false;
    }
    dds_entity_t topic = wire_topic_create(look->participant, &percuss_v1_ServerStatus_desc,
                                           WIRE_TOPIC_SERVER_STATUS);
    dds_qos_t *qos = wire_qos_announcement(partition);
    look->status_reader = dds_create_reader(look->participant, topic, qos, NULL);
    dds_delete_qos(qos);
    return true;
}

void dds_look_close(const struct dds_look *look)
{
    dds_delete(look->participant);
}

/* A property of a participant as Cyclone DDS sets them; others may have none. For dds_free(). */
static char *property(const dds_builtintopic_participant_t *participant, const char *name)
{
    char *value = NULL;
    return dds_qget_prop(participant->qos, name, &value) ? value : NULL;
}

/* Whether it is one of this process. */
static bool is_ours(const struct dds_look *look, const dds_builtintopic_participant_t *participant)
{
    enum { MOST = 8 };
    dds_entity_t own[MOST];
    dds_domainid_t domain = 0;
    dds_guid_t id;
    dds_get_domainid(look->participant, &domain);
    dds_return_t count = dds_lookup_participant(domain, own, MOST);
    for (dds_return_t i = 0; i < count && i < MOST; i++)
        if (dds_get_guid(own[i], &id) == DDS_RETCODE_OK &&
            memcmp(&id, &participant->key, sizeof id) == 0)
            return true;
    return false;
}

/* Words for one, of which there may be several in a process; false: it says nothing of itself. */
static bool describe(const dds_builtintopic_participant_t *participant, char *text, size_t size)
{
    char *name = property(participant, "__ProcessName");
    char *process = property(participant, "__Pid");
    char *host = property(participant, "__Hostname");
    snprintf(text, size, "%.40s (process %.12s on %.40s)", name ? name : "unnamed",
             process ? process : "?", host ? host : "?");
    const bool described = name || process;
    dds_free(name);
    dds_free(process);
    dds_free(host);
    return described;
}

/* Those that were found. */
struct participants {
    char names[1000]; /* of the first of them */
    size_t length;
    unsigned count, silent; /* all; those that say nothing of themselves */
};

static void note_participant(const dds_builtintopic_participant_t *participant,
                             struct participants *all)
{
    char text[128];
    const bool described = describe(participant, text, sizeof text);
    if (described && strstr(all->names, text))
        return;
    all->silent += !described;
    if (all->count++ < NAMED && described)
        all->length += (size_t)snprintf(all->names + all->length, sizeof all->names - all->length,
                                        "%s%s", all->length ? ", " : ": ", text);
}

unsigned dds_look_participants(const struct dds_look *look, struct findings *findings)
{
    struct participants all = {.names = ""};
    void *samples[TAKEN_AT_ONCE] = {NULL};
    dds_sample_info_t infos[TAKEN_AT_ONCE];
    dds_return_t taken;
    dds_entity_t reader =
        dds_create_reader(look->participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, NULL, NULL);
    while ((taken = dds_take(reader, samples, infos, TAKEN_AT_ONCE, TAKEN_AT_ONCE)) > 0) {
        for (dds_return_t i = 0; i < taken; i++)
            if (infos[i].valid_data && !is_ours(look, samples[i]))
                note_participant(samples[i], &all);
        dds_return_loan(reader, samples, taken);
    }
    findings_add(findings, FINDING_OK, "participants", NULL, "%u other process%s in the domain%s%s",
                 all.count, all.count == 1 ? " is" : "es are", all.names,
                 all.count > NAMED ? ", ..." : "");
    return all.silent;
}

/* The first announcement that comes is as old as a second; the next one is new. */
double dds_look_clock(const struct dds_look *look, const uint8_t server[16])
{
    static const dds_duration_t POLL = DDS_MSECS(1), PATIENCE = DDS_MSECS(1500);
    const dds_time_t begin = dds_time();
    void *sample = NULL;
    dds_sample_info_t info;
    /* what has come so far */
    while (dds_take(look->status_reader, &sample, &info, 1, 1) > 0)
        dds_return_loan(look->status_reader, &sample, 1);
    while (dds_time() < begin + PATIENCE) {
        dds_sleepfor(POLL);
        const dds_time_t now = dds_time();
        if (dds_take(look->status_reader, &sample, &info, 1, 1) <= 0)
            continue;
        bool is_its =
            info.valid_data && memcmp(((percuss_v1_ServerStatus *)sample)->server, server, 16) == 0;
        dds_return_loan(look->status_reader, &sample, 1);
        if (is_its)
            return 1e-9 * (double)(info.source_timestamp - now);
    }
    return NAN;
}
