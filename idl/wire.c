/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#include "wire_loopback.h"
#include "wire_security.h"

/* The domain of an earlier participant of this process serves as well, as soon as it is ready. */
static dds_return_t create_domain(uint32_t domain)
{
    static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&one_at_a_time);
    dds_entity_t created = wire_loopback_create(domain);
    pthread_mutex_unlock(&one_at_a_time);
    return created == DDS_RETCODE_PRECONDITION_NOT_MET || created > 0 ? DDS_RETCODE_OK : created;
}

bool wire_is_configured(void)
{
    const char *uri = getenv("CYCLONEDDS_URI");
    return uri && *uri;
}

dds_entity_t wire_participant_create(uint32_t domain)
{
    return wire_participant_create_secured(domain, NULL);
}

dds_entity_t wire_participant_create_secured(uint32_t domain, const char *security)
{
    dds_return_t made = wire_is_configured() ? DDS_RETCODE_OK : create_domain(domain);
    if (made < 0)
        return made;
    dds_qos_t *qos = security ? dds_create_qos() : NULL;
    if (qos)
        wire_security_set(security, qos);
    dds_entity_t participant = dds_create_participant(domain, qos, NULL);
    dds_delete_qos(qos);
    /* what the plugins find wrong is no more than an error to DDS, and a line in its log */
    return security && participant == DDS_RETCODE_ERROR ? DDS_RETCODE_NOT_ALLOWED_BY_SECURITY
                                                        : participant;
}

const char *wire_participant_problem(dds_return_t code)
{
    if (code == DDS_RETCODE_UNSUPPORTED)
        return "its sockets cannot be closed to other machines: /proc/self/fd and socket filters "
               "are needed for it, or a configuration in CYCLONEDDS_URI";
    if (code == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY)
        return "its certificate or its permissions are not good, or do not belong together";
    return dds_strretcode(-code);
}

static void set_partition(dds_qos_t *qos, const char *partition)
{
    if (partition && *partition)
        dds_qset_partition1(qos, partition);
}

dds_qos_t *wire_qos_exchange(const char *partition)
{
    dds_qos_t *qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    dds_qset_durability(qos, DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, WIRE_WINDOW);
    set_partition(qos, partition);
    return qos;
}

dds_qos_t *wire_qos_announcement(const char *partition)
{
    dds_qos_t *qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
    set_partition(qos, partition);
    return qos;
}
