/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_permissions.h"

#include <dds/ddsi/ddsi_domaingv.h>
#include <dds/ddsrt/dynlib.h>
#include <dds/security/core/dds_security_utils.h>
#include <dds/security/dds_security_api.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <pthread.h>
#include <search.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/queue.h>

#include "wire_revoked.h"

/* A participant of another process, as one participant of this process sees it. Handles are
 * addresses of objects of the plugins, and may come again when the object has gone. */
struct peer {
    int64_t permissions;
    dds_security_access_control *access; /* whose handle that is */
    X509 *certificate;
    int64_t own_keys, keys; /* of the two participants, once keys are exchanged */
    bool cut;               /* revoked: not believed any more, whatever the next list says */
    LIST_ENTRY(peer) others;
};

/* A reader or writer of this process. */
struct own {
    int64_t keys, participant; /* its keys, and those of its participant */
    char *topic;
    char **partitions;
    unsigned partition_count;
};

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* of these two */
static LIST_HEAD(, peer) peers = LIST_HEAD_INITIALIZER(peers);
static void *owns; /* tree of struct own */

/* Held while DDS is told whom to cut off, so that it does not stop meanwhile. Before `lock`. */
static pthread_mutex_t cutting = PTHREAD_MUTEX_INITIALIZER;

static atomic_ullong refused;

/* Cyclone DDS's functions, the same in all domains: set once, with the lock. */
static dds_security_access_control_listener listener;
static dds_security_access_control access_behind;
static dds_security_crypto_key_factory keys_behind;

/* With the lock. */
static struct peer *peer_find(int64_t permissions)
{
    struct peer *peer;
    LIST_FOREACH(peer, &peers, others)
    if (peer->permissions == permissions)
        return peer;
    return NULL;
}

/* With the lock. `own_keys`, `keys`: of the participant of this process and of the other. */
static struct peer *peer_find_pair(int64_t own_keys, int64_t keys)
{
    struct peer *peer;
    LIST_FOREACH(peer, &peers, others)
    if (peer->own_keys == own_keys && peer->keys == keys)
        return peer;
    return NULL;
}

/* With the lock. */
static void peer_free(struct peer *peer)
{
    if (!peer)
        return;
    LIST_REMOVE(peer, others);
    X509_free(peer->certificate);
    free(peer);
}

static void peer_forget(int64_t permissions)
{
    pthread_mutex_lock(&lock);
    peer_free(peer_find(permissions));
    pthread_mutex_unlock(&lock);
}

/* Keeps it, with the certificate, which becomes its own; without memory it is unknown. */
static void peer_keep(int64_t permissions, dds_security_access_control *access, X509 *certificate)
{
    struct peer *peer = calloc(1, sizeof *peer);
    pthread_mutex_lock(&lock);
    peer_free(peer_find(permissions));
    if (peer) {
        *peer =
            (struct peer){.permissions = permissions, .access = access, .certificate = certificate};
        LIST_INSERT_HEAD(&peers, peer, others);
    }
    pthread_mutex_unlock(&lock);
    if (!peer)
        X509_free(certificate);
}

/* All peers of a domain that stops: DDS is not told of them any more. */
static void peers_forget(const dds_security_access_control *access)
{
    pthread_mutex_lock(&cutting);
    pthread_mutex_lock(&lock);
    struct peer *next;
    for (struct peer *peer = LIST_FIRST(&peers); peer; peer = next) {
        next = LIST_NEXT(peer, others);
        if (peer->access == access)
            peer_free(peer);
    }
    pthread_mutex_unlock(&lock);
    pthread_mutex_unlock(&cutting);
}

/* The keys of a participant have gone. */
static void peers_forget_keys(int64_t keys)
{
    struct peer *peer;
    pthread_mutex_lock(&lock);
    LIST_FOREACH(peer, &peers, others)
    if (peer->own_keys == keys || peer->keys == keys)
        peer->own_keys = peer->keys = DDS_SECURITY_HANDLE_NIL;
    pthread_mutex_unlock(&lock);
}

static int compare(const void *left, const void *right)
{
    const int64_t a = ((const struct own *)left)->keys, b = ((const struct own *)right)->keys;
    return (a > b) - (a < b);
}

static void own_free(struct own *own)
{
    if (!own)
        return;
    for (unsigned i = 0; i < own->partition_count; i++)
        free(own->partitions[i]);
    free(own->partitions);
    free(own->topic);
    free(own);
}

/* With the lock. */
static struct own *own_find(int64_t keys)
{
    struct own **found = tfind(&(struct own){.keys = keys}, &owns, compare);
    return found ? *found : NULL;
}

static void own_forget(int64_t keys)
{
    pthread_mutex_lock(&lock);
    struct own *own = own_find(keys);
    if (own)
        tdelete(own, &owns, compare);
    pthread_mutex_unlock(&lock);
    own_free(own);
}

/* Without memory it is unknown. */
static void own_keep(struct own *own)
{
    own_forget(own->keys);
    pthread_mutex_lock(&lock);
    const bool kept = tsearch(own, &owns, compare) != NULL;
    pthread_mutex_unlock(&lock);
    if (!kept)
        own_free(own);
}

/* The reader or writer that this thread is making, borrowed: DDS tells its topic right before it
 * has keys made for it. */
static _Thread_local struct {
    const char *topic;
    const DDS_Security_PartitionQosPolicy *partition;
} in_making;

static void begin_endpoint(const char *topic, const DDS_Security_PartitionQosPolicy *partition)
{
    in_making.topic = topic;
    in_making.partition = partition;
}

static bool copy_partitions(struct own *own, const DDS_Security_StringSeq *names)
{
    own->partitions = calloc(names->_length + 1, sizeof *own->partitions);
    if (!own->partitions)
        return false;
    for (; own->partition_count < names->_length; own->partition_count++) {
        own->partitions[own->partition_count] = strdup(names->_buffer[own->partition_count]);
        if (!own->partitions[own->partition_count])
            return false;
    }
    return true;
}

/* Keeps it, or nothing where there is no memory, or DDS told no topic. Returns the handle. */
static int64_t end_endpoint(int64_t keys, int64_t participant)
{
    struct own *own = keys && in_making.topic ? calloc(1, sizeof *own) : NULL;
    if (own) {
        *own = (struct own){
            .keys = keys, .participant = participant, .topic = strdup(in_making.topic)};
        if (own->topic && copy_partitions(own, &in_making.partition->name))
            own_keep(own);
        else
            own_free(own);
    }
    in_making.topic = NULL;
    return keys;
}

/* Access control. */

static X509 *read_certificate(const DDS_Security_AuthenticatedPeerCredentialToken *credential)
{
    for (unsigned i = 0; i < credential->properties._length; i++) {
        const DDS_Security_Property_t *property = &credential->properties._buffer[i];
        if (strcmp(property->name, "c.id") != 0 || !property->value)
            continue;
        BIO *text = BIO_new_mem_buf(property->value, -1);
        X509 *certificate = text ? PEM_read_bio_X509(text, NULL, NULL, NULL) : NULL;
        BIO_free(text);
        ERR_clear_error();
        return certificate;
    }
    return NULL;
}

static void say_revoked(const X509 *certificate, DDS_Security_SecurityException *exception)
{
    char subject[256];
    X509_NAME_oneline(X509_get_subject_name(certificate), subject, sizeof subject);
    DDS_Security_Exception_set(exception, "percuss", 1, 0, "the certificate of %s is revoked",
                               subject);
}

/* With the lock. */
static bool is_believed(const struct peer *peer)
{
    return peer && peer->certificate && !peer->cut && !wire_revoked_has(peer->certificate);
}

/* Whether the participant with these permissions may be believed. */
static bool believe(int64_t permissions, DDS_Security_SecurityException *exception)
{
    pthread_mutex_lock(&lock);
    const struct peer *peer = peer_find(permissions);
    const bool believed = is_believed(peer);
    if (!peer)
        DDS_Security_Exception_set(exception, "percuss", 1, 0, "out of memory for a participant");
    else if (!peer->certificate)
        DDS_Security_Exception_set(exception, "percuss", 1, 0, "there is no certificate");
    else if (!believed)
        say_revoked(peer->certificate, exception);
    /* one that is cut has been counted */
    if (peer && peer->certificate && !believed && !peer->cut)
        atomic_fetch_add(&refused, 1);
    pthread_mutex_unlock(&lock);
    return believed;
}

/* Of a participant that is not believed. */
static void give_back(dds_security_access_control *access, int64_t permissions)
{
    DDS_Security_SecurityException none = DDS_SECURITY_EXCEPTION_INIT;
    access->return_permissions_handle(access, permissions, &none);
    DDS_Security_Exception_reset(&none);
}

static DDS_Security_PermissionsHandle validate_remote_permissions(
    dds_security_access_control *access, const dds_security_authentication *authentication,
    const DDS_Security_IdentityHandle own, const DDS_Security_IdentityHandle remote,
    const DDS_Security_PermissionsToken *permissions,
    const DDS_Security_AuthenticatedPeerCredentialToken *credential,
    DDS_Security_SecurityException *exception)
{
    const int64_t handle = access_behind.validate_remote_permissions(
        access, authentication, own, remote, permissions, credential, exception);
    if (!handle)
        return handle;
    peer_keep(handle, access, read_certificate(credential));
    if (believe(handle, exception))
        return handle;
    give_back(access, handle);
    return DDS_SECURITY_HANDLE_NIL;
}

static DDS_Security_boolean return_permissions_handle(dds_security_access_control *access,
                                                      DDS_Security_PermissionsHandle handle,
                                                      DDS_Security_SecurityException *exception)
{
    peer_forget(handle);
    return access_behind.return_permissions_handle(access, handle, exception);
}

static DDS_Security_boolean get_datawriter_sec_attributes(
    dds_security_access_control *access, const DDS_Security_PermissionsHandle permissions,
    const char *topic, const DDS_Security_PartitionQosPolicy *partition,
    const DDS_Security_DataTagQosPolicy *tag, DDS_Security_EndpointSecurityAttributes *attributes,
    DDS_Security_SecurityException *exception)
{
    begin_endpoint(topic, partition);
    return access_behind.get_datawriter_sec_attributes(access, permissions, topic, partition, tag,
                                                       attributes, exception);
}

static DDS_Security_boolean get_datareader_sec_attributes(
    dds_security_access_control *access, const DDS_Security_PermissionsHandle permissions,
    const char *topic, const DDS_Security_PartitionQosPolicy *partition,
    const DDS_Security_DataTagQosPolicy *tag, DDS_Security_EndpointSecurityAttributes *attributes,
    DDS_Security_SecurityException *exception)
{
    begin_endpoint(topic, partition);
    return access_behind.get_datareader_sec_attributes(access, permissions, topic, partition, tag,
                                                       attributes, exception);
}

static DDS_Security_boolean set_listener(dds_security_access_control *access,
                                         const dds_security_access_control_listener *given,
                                         DDS_Security_SecurityException *exception)
{
    pthread_mutex_lock(&lock);
    if (given && !listener.on_revoke_permissions)
        listener = *given;
    pthread_mutex_unlock(&lock);
    if (!given)
        peers_forget(access);
    return access_behind.set_listener(access, given, exception);
}

/* Cryptography. */

/* DDS does not give the permissions back of whom the cryptography refuses. */
static void dismiss(int64_t permissions)
{
    pthread_mutex_lock(&lock);
    const struct peer *peer = peer_find(permissions);
    dds_security_access_control *access = peer ? peer->access : NULL;
    pthread_mutex_unlock(&lock);
    if (access)
        give_back(access, permissions);
}

/* Keys of a participant are shared by all of this process; permissions are one participant's. */
static DDS_Security_ParticipantCryptoHandle register_matched_remote_participant(
    dds_security_crypto_key_factory *keys, const DDS_Security_ParticipantCryptoHandle own,
    const DDS_Security_IdentityHandle identity, const DDS_Security_PermissionsHandle permissions,
    const DDS_Security_SharedSecretHandle secret, DDS_Security_SecurityException *exception)
{
    /* a list may have come since its permissions were validated */
    if (!believe(permissions, exception)) {
        dismiss(permissions);
        return DDS_SECURITY_HANDLE_NIL;
    }
    const int64_t handle = keys_behind.register_matched_remote_participant(
        keys, own, identity, permissions, secret, exception);
    pthread_mutex_lock(&lock);
    struct peer *peer = handle ? peer_find(permissions) : NULL;
    if (peer) {
        peer->own_keys = own;
        peer->keys = handle;
    }
    pthread_mutex_unlock(&lock);
    return handle;
}

static DDS_Security_DatawriterCryptoHandle
register_local_datawriter(dds_security_crypto_key_factory *keys,
                          const DDS_Security_ParticipantCryptoHandle participant,
                          const DDS_Security_PropertySeq *properties,
                          const DDS_Security_EndpointSecurityAttributes *attributes,
                          DDS_Security_SecurityException *exception)
{
    return end_endpoint(
        keys_behind.register_local_datawriter(keys, participant, properties, attributes, exception),
        participant);
}

static DDS_Security_DatareaderCryptoHandle
register_local_datareader(dds_security_crypto_key_factory *keys,
                          const DDS_Security_ParticipantCryptoHandle participant,
                          const DDS_Security_PropertySeq *properties,
                          const DDS_Security_EndpointSecurityAttributes *attributes,
                          DDS_Security_SecurityException *exception)
{
    return end_endpoint(
        keys_behind.register_local_datareader(keys, participant, properties, attributes, exception),
        participant);
}

/* With the lock. Whether the permissions of the participant with these keys allow it to read, or to
 * write, what `own` writes, or reads. */
static bool may_match(const struct own *own, int64_t keys, bool reads,
                      DDS_Security_SecurityException *exception)
{
    const struct peer *peer = peer_find_pair(own->participant, keys);
    if (!is_believed(peer)) {
        DDS_Security_Exception_set(exception, "percuss", 1, 0, "%s: no permissions are known",
                                   own->topic);
        return false;
    }
    dds_security_access_control *access = peer->access;
    const int domain = (int)access->gv->config.domainId;
    const DDS_Security_PartitionQosPolicy partition = {
        .name = {own->partition_count, own->partition_count, own->partitions}};
    DDS_Security_boolean relays = false;
    if (reads) {
        const DDS_Security_SubscriptionBuiltinTopicDataSecure reader = {.topic_name = own->topic,
                                                                        .partition = partition};
        return access_behind.check_remote_datareader(access, peer->permissions, domain, &reader,
                                                     &relays, exception);
    }
    const DDS_Security_PublicationBuiltinTopicDataSecure writer = {.topic_name = own->topic,
                                                                   .partition = partition};
    return access_behind.check_remote_datawriter(access, peer->permissions, domain, &writer,
                                                 exception);
}

/* DDS's own readers and writers, which tell who is there, and give keys. */
static bool is_builtin(const struct own *own)
{
    return strncmp(own->topic, "DCPS", 4) == 0;
}

/* A reader or writer of this process of which nothing is known matches none. */
static bool match_is_good(int64_t endpoint, int64_t participant, bool reads,
                          DDS_Security_SecurityException *exception)
{
    pthread_mutex_lock(&lock);
    const struct own *own = own_find(endpoint);
    const bool good = own && (is_builtin(own) || may_match(own, participant, reads, exception));
    pthread_mutex_unlock(&lock);
    if (!own)
        DDS_Security_Exception_set(exception, "percuss", 1, 0,
                                   "nothing is known of the reader or writer here");
    return good;
}

static DDS_Security_DatareaderCryptoHandle register_matched_remote_datareader(
    dds_security_crypto_key_factory *keys, const DDS_Security_DatawriterCryptoHandle writer,
    const DDS_Security_ParticipantCryptoHandle participant,
    const DDS_Security_SharedSecretHandle secret, const DDS_Security_boolean relays,
    DDS_Security_SecurityException *exception)
{
    return match_is_good(writer, participant, true, exception)
               ? keys_behind.register_matched_remote_datareader(keys, writer, participant, secret,
                                                                relays, exception)
               : DDS_SECURITY_HANDLE_NIL;
}

static DDS_Security_DatawriterCryptoHandle register_matched_remote_datawriter(
    dds_security_crypto_key_factory *keys, const DDS_Security_DatareaderCryptoHandle reader,
    const DDS_Security_ParticipantCryptoHandle participant,
    const DDS_Security_SharedSecretHandle secret, DDS_Security_SecurityException *exception)
{
    return match_is_good(reader, participant, false, exception)
               ? keys_behind.register_matched_remote_datawriter(keys, reader, participant, secret,
                                                                exception)
               : DDS_SECURITY_HANDLE_NIL;
}

static DDS_Security_boolean unregister_participant(dds_security_crypto_key_factory *keys,
                                                   const DDS_Security_ParticipantCryptoHandle one,
                                                   DDS_Security_SecurityException *exception)
{
    peers_forget_keys(one);
    return keys_behind.unregister_participant(keys, one, exception);
}

static DDS_Security_boolean unregister_datawriter(dds_security_crypto_key_factory *keys,
                                                  const DDS_Security_DatawriterCryptoHandle one,
                                                  DDS_Security_SecurityException *exception)
{
    own_forget(one);
    return keys_behind.unregister_datawriter(keys, one, exception);
}

static DDS_Security_boolean unregister_datareader(dds_security_crypto_key_factory *keys,
                                                  const DDS_Security_DatareaderCryptoHandle one,
                                                  DDS_Security_SecurityException *exception)
{
    own_forget(one);
    return keys_behind.unregister_datareader(keys, one, exception);
}

/* Cyclone DDS's plugins, which these stand in front of. */

/* A function of one of them, by Cyclone DDS's own search for libraries; NULL: it is not there. The
 * library stays loaded. */
static void *find_function(const char *library, const char *name)
{
    ddsrt_dynlib_t handle;
    void *function = NULL;
    if (ddsrt_dlopen(library, true, &handle) != DDS_RETCODE_OK)
        return NULL;
    return ddsrt_dlsym(handle, name, &function) == DDS_RETCODE_OK ? function : NULL;
}

int wire_permissions_access_init(const char *argument, void **context, struct ddsi_domaingv *domain)
{
    plugin_init init = (plugin_init)find_function("dds_security_ac", "init_access_control");
    if (!init || init(argument, context, domain) != DDS_RETCODE_OK)
        return DDS_RETCODE_ERROR;
    dds_security_access_control *access = *context;
    pthread_mutex_lock(&lock);
    if (!access_behind.validate_remote_permissions)
        access_behind = *access;
    pthread_mutex_unlock(&lock);
    access->validate_remote_permissions = validate_remote_permissions;
    access->return_permissions_handle = return_permissions_handle;
    access->get_datawriter_sec_attributes = get_datawriter_sec_attributes;
    access->get_datareader_sec_attributes = get_datareader_sec_attributes;
    access->set_listener = set_listener;
    return DDS_RETCODE_OK;
}

int wire_permissions_access_end(void *context)
{
    peers_forget(context);
    plugin_finalize end =
        (plugin_finalize)find_function("dds_security_ac", "finalize_access_control");
    return end ? end(context) : DDS_RETCODE_ERROR;
}

int wire_permissions_crypto_init(const char *argument, void **context, struct ddsi_domaingv *domain)
{
    plugin_init init = (plugin_init)find_function("dds_security_crypto", "init_crypto");
    if (!init || init(argument, context, domain) != DDS_RETCODE_OK)
        return DDS_RETCODE_ERROR;
    dds_security_crypto_key_factory *keys =
        ((dds_security_cryptography *)*context)->crypto_key_factory;
    pthread_mutex_lock(&lock);
    if (!keys_behind.register_local_datawriter)
        keys_behind = *keys;
    pthread_mutex_unlock(&lock);
    keys->register_matched_remote_participant = register_matched_remote_participant;
    keys->register_local_datawriter = register_local_datawriter;
    keys->register_local_datareader = register_local_datareader;
    keys->register_matched_remote_datareader = register_matched_remote_datareader;
    keys->register_matched_remote_datawriter = register_matched_remote_datawriter;
    keys->unregister_participant = unregister_participant;
    keys->unregister_datawriter = unregister_datawriter;
    keys->unregister_datareader = unregister_datareader;
    return DDS_RETCODE_OK;
}

int wire_permissions_crypto_end(void *context)
{
    plugin_finalize end = (plugin_finalize)find_function("dds_security_crypto", "finalize_crypto");
    return end ? end(context) : DDS_RETCODE_ERROR;
}

/* Revocation. */

unsigned long long wire_permissions_refused(void)
{
    return atomic_load(&refused);
}

/* With the lock. One that is revoked and not cut off yet; NULL: none. */
static struct peer *peer_find_revoked(void)
{
    struct peer *peer;
    LIST_FOREACH(peer, &peers, others)
    if (peer->certificate && !peer->cut && wire_revoked_has(peer->certificate))
        return peer;
    return NULL;
}

unsigned wire_permissions_cut(void)
{
    unsigned count = 0;
    pthread_mutex_lock(&cutting);
    pthread_mutex_lock(&lock);
    for (struct peer *peer; (peer = peer_find_revoked()) != NULL; count++) {
        peer->cut = true;
        const int64_t permissions = peer->permissions;
        dds_security_access_control *access = peer->access;
        /* DDS gives its permissions back meanwhile; of one whose keys are not exchanged yet it
         * knows nothing, and that one is refused when they are */
        pthread_mutex_unlock(&lock);
        listener.on_revoke_permissions(access, permissions);
        pthread_mutex_lock(&lock);
    }
    pthread_mutex_unlock(&lock);
    pthread_mutex_unlock(&cutting);
    atomic_fetch_add(&refused, count);
    return count;
}
