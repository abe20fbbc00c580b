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
    return wire_participant_create_secured(membership->domain, membership->security);
}

bool dds_look_open(uint32_t domain, const char *partition, const char *security,
                   struct dds_look *look, struct findings *findings)
{
    char problem[512];
    struct membership membership = {domain, security};
    if (security && !wire_security_check(security, problem, sizeof problem)) {
        findings_add(findings, FINDING_PROBLEM, "security",
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

/* Words for one, of which there may be several in a process; false: it is ours. */
static bool describe(const dds_builtintopic_participant_t *participant, char *text, size_t size)
{
    char *name = property(participant, "__ProcessName");
    char *process = property(participant, "__Pid");
    char *host = property(participant, "__Hostname");
    char own[64] = "";
    gethostname(own, sizeof own - 1);
    bool ours = process && host && atol(process) == (long)getpid() && strcmp(host, own) == 0;
    if (name || process)
        snprintf(text, size, "%.40s (process %.12s on %.40s)", name ? name : "unnamed",
                 process ? process : "?", host ? host : "?");
    else
        snprintf(text, size, "one that is not of Cyclone DDS");
    dds_free(name);
    dds_free(process);
    dds_free(host);
    return !ours;
}

unsigned dds_look_participants(const struct dds_look *look, struct findings *findings)
{
    char names[1000] = "", text[128];
    size_t length = 0;
    unsigned count = 0;
    void *samples[TAKEN_AT_ONCE] = {NULL};
    dds_sample_info_t infos[TAKEN_AT_ONCE];
    dds_return_t taken;
    dds_entity_t reader =
        dds_create_reader(look->participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, NULL, NULL);
    while ((taken = dds_take(reader, samples, infos, TAKEN_AT_ONCE, TAKEN_AT_ONCE)) > 0) {
        for (dds_return_t i = 0; i < taken; i++) {
            if (!infos[i].valid_data || !describe(samples[i], text, sizeof text) ||
                strstr(names, text))
                continue;
            if (count++ < NAMED)
                length += (size_t)snprintf(names + length, sizeof names - length, "%s%s",
                                           length ? ", " : ": ", text);
        }
        dds_return_loan(reader, samples, taken);
    }
    findings_add(findings, FINDING_OK, "participants", NULL, "%u other process%s in the domain%s%s",
                 count, count == 1 ? " is" : "es are", names, count > NAMED ? ", ..." : "");
    return count;
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
