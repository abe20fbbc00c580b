/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "configuration.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "machine.h"
#include "wire_loopback.h"
#include "wire_shared.h"

enum { VALUE_SIZE = 128, LINE_SIZE = 400 };

static const char VARIABLE[] = "CYCLONEDDS_URI";
static const char SUBJECT[] = "configuration";

const char *configuration_given(void)
{
    const char *uri = getenv(VARIABLE);
    return uri && *uri ? uri : NULL;
}

int configuration_trace(int (*join)(void *context), void *context)
{
    static const char trace[] = ",<CycloneDDS><Domain><Tracing><Verbosity>config</Verbosity>"
                                "<OutputFile>stderr</OutputFile></Tracing></Domain></CycloneDDS>";
    const char *uri = configuration_given();
    size_t size = uri ? strlen(uri) + sizeof trace : 0;
    char *kept = uri ? strdup(uri) : NULL, *with = uri ? malloc(size) : NULL;
    if (kept && with) {
        snprintf(with, size, "%s%s", uri, trace);
        setenv(VARIABLE, with, 1);
    }
    int joined = join(context);
    if (kept && with)
        setenv(VARIABLE, kept, 1);
    free(kept);
    free(with);
    return joined;
}

/* The first value of a setting; empty: none. */
static void read_setting(const char *log, const char *name, char value[VALUE_SIZE])
{
    char key[VALUE_SIZE];
    snprintf(key, sizeof key, "config: Domain/%s: ", name);
    const char *found = strstr(log, key), *from = found ? found + strlen(key) : "";
    const char *end = strstr(from, " {");
    snprintf(value, VALUE_SIZE, "%.*s", end ? (int)(end - from) : 0, from);
}

/* What follows those words to the end of the line; empty: it is not there. */
static void read_note(const char *log, const char *words, char value[VALUE_SIZE])
{
    const char *found = strstr(log, words), *from = found ? found + strlen(words) : "";
    snprintf(value, VALUE_SIZE, "%.*s", (int)strcspn(from, "\n"), from);
}

/* Where the message of a line begins: behind "1795852510.738208 [77]    percuss: ". */
static const char *message_of(const char *line)
{
    double time;
    int domain, length = 0;
    if (sscanf(line, "%lf [%d] %n", &time, &domain, &length) < 2 || length == 0)
        return line;
    const char *colon = strstr(line + length, ": ");
    return colon ? colon + 2 : line;
}

static bool is_news(const char *message)
{
    return strncmp(message, "config: Domain", 14) != 0 && strcmp(message, "udp finalized") != 0 &&
           strcmp(message, "Finis.") != 0 && strcmp(message, "No network interface selected") != 0;
}

/* The last line that DDS has written and that is neither one of its settings, nor of its end, nor
 * says only that the line before is why it ends; empty: none. */
static void last_message(const char *log, char message[LINE_SIZE])
{
    *message = '\0';
    for (const char *line = log; *line; line += strcspn(line, "\n"), line += *line == '\n') {
        char text[LINE_SIZE];
        snprintf(text, sizeof text, "%.*s", (int)strcspn(line, "\n"), line);
        const char *begin = message_of(text);
        if (begin != text && is_news(begin))
            snprintf(message, LINE_SIZE, "%s", begin);
    }
}

/* What to do about it. */
static void advise(const char *message, unsigned taken, char *advice, size_t size)
{
    if (strstr(message, "configuration file"))
        snprintf(advice, size, "name a file that is there and that this user can read, or unset %s",
                 VARIABLE);
    else if (strstr(message, "interface"))
        snprintf(advice, size, "name one of the interfaces above in General/Interfaces of it");
    else if (strstr(message, "participant index"))
        snprintf(advice, size,
                 "other processes have participant indices 0 to %u of this domain: end some, or "
                 "raise Discovery/MaxAutoParticipantIndex in it for all",
                 taken ? taken - 1 : 0);
    else
        snprintf(advice, size, "correct it, or unset %s: then this machine alone is heard",
                 VARIABLE);
}

/* Without its daemon programs refuse to start (wire.h). */
static bool look_at_shared_memory(struct findings *findings)
{
    if (!wire_shared_is_asked(configuration_given()) || wire_shared_is_there())
        return false;
    findings_add(findings, FINDING_PROBLEM, SUBJECT,
                 "start iox-roudi on this machine, or set SharedMemory/Enable to false in it",
                 "%s=%.300s wants shared memory (SharedMemory/Enable), whose daemon iox-roudi is "
                 "not there",
                 VARIABLE, configuration_given());
    return true;
}

/* By its values: whether anybody can be found. */
static void look_at_reach(const char *log, struct findings *findings)
{
    char multicast[VALUE_SIZE], peer[VALUE_SIZE], address[VALUE_SIZE];
    read_setting(log, "General/AllowMulticast/#text", multicast);
    read_setting(log, "Discovery/Peers/Peer[@Address]", peer);
    read_note(log, "ownip: udp/", address);
    const bool wanted = strcmp(multicast, "false") != 0;
    if (!wanted && !peer[0])
        findings_add(findings, FINDING_PROBLEM, SUBJECT,
                     "name the other machines (or 127.0.0.1) as Discovery/Peers/Peer in it",
                     "AllowMulticast is false and no Peer is named: DDS finds nobody");
    else if (!peer[0] && address[0] && strncmp(address, "127.", 4) != 0 &&
             !machine_multicasts(address))
        findings_add(findings, FINDING_PROBLEM, SUBJECT,
                     "name the other machines as Discovery/Peers/Peer in it",
                     "multicast is not available from %s: no packet comes back that is sent so, "
                     "and DDS finds others by it alone where no Peer is named",
                     address);
}

/* That it works, by the settings that decide who is heard. */
static void tell(const char *log, unsigned taken, struct findings *findings)
{
    char interfaces[VALUE_SIZE], multicast[VALUE_SIZE], peer[VALUE_SIZE], index[VALUE_SIZE],
        most[VALUE_SIZE];
    read_note(log, "selected interfaces: ", interfaces);
    read_setting(log, "General/AllowMulticast/#text", multicast);
    read_setting(log, "Discovery/Peers/Peer[@Address]", peer);
    read_setting(log, "Discovery/ParticipantIndex/#text", index);
    read_setting(log, "Discovery/MaxAutoParticipantIndex/#text", most);
    findings_add(findings, FINDING_OK, SUBJECT, NULL,
                 "%s=%.300s: interface %s, AllowMulticast %s, first peer %s, ParticipantIndex %s",
                 VARIABLE, configuration_given(), interfaces, multicast, peer[0] ? peer : "none",
                 index);
    const unsigned indices = (unsigned)atoi(most);
    if (strcmp(index, "auto") == 0 && 10 * taken >= 9 * indices)
        findings_add(findings, FINDING_WARNING, "indices",
                     "raise Discovery/MaxAutoParticipantIndex in it for all processes",
                     "%u of %u participant indices of the domain are taken: without multicast "
                     "each process needs one",
                     taken, indices);
}

static void look_at_built_in(unsigned taken, struct findings *findings)
{
    enum { INDICES = WIRE_LOOPBACK_INDICES - WIRE_LOOPBACK_CLIENTS };
    const bool few = 10 * taken >= 9 * INDICES;
    findings_add(findings, FINDING_OK, SUBJECT, NULL,
                 "%s is not set: the built-in one: 127.0.0.1 alone, no multicast", VARIABLE);
    findings_add(findings, few ? FINDING_WARNING : FINDING_OK, "indices",
                 few ? "end processes, or give all of them a CYCLONEDDS_URI with "
                       "Discovery/MaxAutoParticipantIndex above 119"
                     : NULL,
                 "%u of the %d participant indices of clients are taken in the domain, one by each "
                 "process",
                 taken < INDICES ? taken : INDICES, INDICES);
}

void configuration_look(const struct watched *end, unsigned taken, struct findings *findings)
{
    char message[LINE_SIZE], advice[LINE_SIZE];
    const char *log = end->log ? end->log : "";
    if (!configuration_given()) {
        look_at_built_in(taken, findings);
    } else if (look_at_shared_memory(findings)) {
        return;
    } else if (strstr(log, "Unicast Ports: ")) {
        tell(log, taken, findings);
        look_at_reach(log, findings);
    } else {
        last_message(log, message);
        advise(message, taken, advice, sizeof advice);
        findings_add(findings, FINDING_PROBLEM, SUBJECT, advice, "%s=%.300s cannot be used: %s",
                     VARIABLE, configuration_given(),
                     message[0] ? message : "Cyclone DDS does not say why");
    }
}
