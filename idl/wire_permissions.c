/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_permissions.h"

#include <dds/ddsi/ddsi_domaingv.h>
#include <dds/ddsrt/dynlib.h>
#include <dds/security/core/dds_security_utils.h>
#include <dds/security/dds_security_api.h>
#include <openssl/pem.h>
#include <pthread.h>
#include <search.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* What is known of a handle of the plugins, which is the address of an object of theirs. */
struct known {
    int64_t handle;
    /* of the permissions of a remote participant */
    dds_security_access_control *access; /* whose handle it is; NULL: no permissions */
    X509 *certificate;                   /* of that participant */
    /* of the keys of a remote participant */
    int64_t permissions;
    /* of the keys of a reader or writer of this process; NULL: one of DDS itself */
    char *topic;
    char **partitions;
    unsigned partition_count;
};

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* of these two */
static void *all;                                        /* tree of struct known */
static X509_CRL *revoked;

static atomic_ullong refused;

/* Cyclone DDS's functions, the same in all domains: set once, with the lock. */
static dds_security_access_control_listener listener;
static dds_security_access_control access_behind;
static dds_security_crypto_key_factory keys_behind;

static int compare(const void *left, const void *right)
{
    const int64_t a = ((const struct known *)left)->handle,
                  b = ((const struct known *)right)->handle;
    return (a > b) - (a < b);
}

static void known_free(struct known *known)
{
    if (!known)
        return;
    for (unsigned i = 0; i < known->partition_count; i++)
        free(known->partitions[i]);
    free(known->partitions);
    free(known->topic);
    X509_free(known->certificate);
    free(known);
}

/* With the lock. */
static struct known *known_find(int64_t handle)
{
    struct known **found = tfind(&(struct known){.handle = handle}, &all, compare);
    return found ? *found : NULL;
}

static void known_forget(int64_t handle)
{
    pthread_mutex_lock(&lock);
    struct known *known = known_find(handle);
    if (known)
        tdelete(known, &all, compare);
    pthread_mutex_unlock(&lock);
    known_free(known);
}

/* Keeps `known`, which may be NULL: no memory. An object that has gone may have had the same
 * handle. */
static void known_keep(struct known *known, int64_t handle)
{
    known_forget(handle);
    if (!known)
        return;
    known->handle = handle;
    pthread_mutex_lock(&lock);
    const bool kept = tsearch(known, &all, compare) != NULL;
    pthread_mutex_unlock(&lock);
    if (!kept)
        known_free(known);
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

static bool copy_partitions(struct known *known, const DDS_Security_StringSeq *names)
{
    known->partitions = calloc(names->_length + 1, sizeof *known->partitions);
    if (!known->partitions)
        return false;
    for (; known->partition_count < names->_length; known->partition_count++) {
        known->partitions[known->partition_count] = strdup(names->_buffer[known->partition_count]);
        if (!known->partitions[known->partition_count])
            return false;
    }
    return true;
}

/* Keeps what it is, or nothing where there is no memory. Returns the handle. */
static int64_t end_endpoint(int64_t handle)
{
    struct known *known = handle ? calloc(1, sizeof *known) : NULL;
    const bool is_own = known && in_making.topic && strncmp(in_making.topic, "DCPS", 4) != 0;
    if (is_own)
        known->topic = strdup(in_making.topic);
    if (is_own && (!known->topic || !copy_partitions(known, &in_making.partition->name))) {
        known_free(known);
        known = NULL;
    }
    if (handle)
        known_keep(known, handle);
    in_making.topic = NULL;
    return handle;
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
        return certificate;
    }
    return NULL;
}

/* With the lock. Serial numbers are an authority's own. */
static bool is_revoked(X509 *certificate)
{
    X509_REVOKED *entry;
    return revoked &&
           X509_NAME_cmp(X509_CRL_get_issuer(revoked), X509_get_issuer_name(certificate)) == 0 &&
           X509_CRL_get0_by_cert(revoked, &entry, certificate) == 1;
}

static void say_revoked(const X509 *certificate, DDS_Security_SecurityException *exception)
{
    char subject[256];
    X509_NAME_oneline(X509_get_subject_name(certificate), subject, sizeof subject);
    DDS_Security_Exception_set(exception, "percuss", 1, 0, "the certificate of %s is revoked",
                               subject);
}

/* Whether the participant with these permissions, which are known, may be believed; a list that
 * came meanwhile has it already. */
static bool is_believed(int64_t handle, DDS_Security_SecurityException *exception)
{
    pthread_mutex_lock(&lock);
    const struct known *known = known_find(handle);
    const bool believed = known && known->certificate && !is_revoked(known->certificate);
    if (known && known->certificate && !believed) {
        atomic_fetch_add(&refused, 1);
        say_revoked(known->certificate, exception);
    }
    pthread_mutex_unlock(&lock);
    return believed;
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
    struct known *known = calloc(1, sizeof *known);
    if (known)
        *known = (struct known){.access = access, .certificate = read_certificate(credential)};
    known_keep(known, handle);
    if (is_believed(handle, exception))
        return handle;
    DDS_Security_SecurityException none = DDS_SECURITY_EXCEPTION_INIT;
    access->return_permissions_handle(access, handle, &none);
    DDS_Security_Exception_reset(&none);
    return DDS_SECURITY_HANDLE_NIL;
}

static DDS_Security_boolean return_permissions_handle(dds_security_access_control *access,
                                                      DDS_Security_PermissionsHandle handle,
                                                      DDS_Security_SecurityException *exception)
{
    known_forget(handle);
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
    return access_behind.set_listener(access, given, exception);
}

/* Cryptography. */

static DDS_Security_ParticipantCryptoHandle register_matched_remote_participant(
    dds_security_crypto_key_factory *keys, const DDS_Security_ParticipantCryptoHandle own,
    const DDS_Security_IdentityHandle identity, const DDS_Security_PermissionsHandle permissions,
    const DDS_Security_SharedSecretHandle secret, DDS_Security_SecurityException *exception)
{
    const int64_t handle = keys_behind.register_matched_remote_participant(
        keys, own, identity, permissions, secret, exception);
    struct known *known = handle ? calloc(1, sizeof *known) : NULL;
    if (known)
        known->permissions = permissions;
    if (handle)
        known_keep(known, handle);
    return handle;
}

static DDS_Security_DatawriterCryptoHandle
register_local_datawriter(dds_security_crypto_key_factory *keys,
                          const DDS_Security_ParticipantCryptoHandle participant,
                          const DDS_Security_PropertySeq *properties,
                          const DDS_Security_EndpointSecurityAttributes *attributes,
                          DDS_Security_SecurityException *exception)
{
    return end_endpoint(keys_behind.register_local_datawriter(keys, participant, properties,
                                                              attributes, exception));
}

static DDS_Security_DatareaderCryptoHandle
register_local_datareader(dds_security_crypto_key_factory *keys,
                          const DDS_Security_ParticipantCryptoHandle participant,
                          const DDS_Security_PropertySeq *properties,
                          const DDS_Security_EndpointSecurityAttributes *attributes,
                          DDS_Security_SecurityException *exception)
{
    return end_endpoint(keys_behind.register_local_datareader(keys, participant, properties,
                                                              attributes, exception));
}

/* With the lock. Whether the participant's permissions allow it to read, or to write, what `own`
 * writes, or reads. */
static bool may_match(const struct known *own, int64_t participant, bool reads,
                      DDS_Security_SecurityException *exception)
{
    const struct known *keys = known_find(participant);
    const struct known *permissions = keys ? known_find(keys->permissions) : NULL;
    if (!permissions || !permissions->access) {
        DDS_Security_Exception_set(exception, "percuss", 1, 0, "%s: no permissions are known",
                                   own->topic);
        return false;
    }
    dds_security_access_control *access = permissions->access;
    const int domain = (int)access->gv->config.domainId;
    const DDS_Security_PartitionQosPolicy partition = {
        .name = {own->partition_count, own->partition_count, own->partitions}};
    DDS_Security_boolean relays = false;
    if (reads) {
        const DDS_Security_SubscriptionBuiltinTopicDataSecure reader = {.topic_name = own->topic,
                                                                        .partition = partition};
        return access_behind.check_remote_datareader(access, permissions->handle, domain, &reader,
                                                     &relays, exception);
    }
    const DDS_Security_PublicationBuiltinTopicDataSecure writer = {.topic_name = own->topic,
                                                                   .partition = partition};
    return access_behind.check_remote_datawriter(access, permissions->handle, domain, &writer,
                                                 exception);
}

/* A reader or writer of this process of which nothing is known, for lack of memory, matches none.
 */
static bool match_is_good(int64_t endpoint, int64_t participant, bool reads,
                          DDS_Security_SecurityException *exception)
{
    pthread_mutex_lock(&lock);
    const struct known *own = known_find(endpoint);
    const bool good = own && (!own->topic || may_match(own, participant, reads, exception));
    pthread_mutex_unlock(&lock);
    if (!own)
        DDS_Security_Exception_set(exception, "percuss", 1, 0, "out of memory");
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
    known_forget(one);
    return keys_behind.unregister_participant(keys, one, exception);
}

static DDS_Security_boolean unregister_datawriter(dds_security_crypto_key_factory *keys,
                                                  const DDS_Security_DatawriterCryptoHandle one,
                                                  DDS_Security_SecurityException *exception)
{
    known_forget(one);
    return keys_behind.unregister_datawriter(keys, one, exception);
}

static DDS_Security_boolean unregister_datareader(dds_security_crypto_key_factory *keys,
                                                  const DDS_Security_DatareaderCryptoHandle one,
                                                  DDS_Security_SecurityException *exception)
{
    known_forget(one);
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

/* With the lock. One that is on the list and is there; NULL: none. */
static struct known *found;
static void look_at(const void *node, VISIT order, int depth)
{
    (void)depth;
    struct known *known = *(struct known *const *)node;
    if ((order == postorder || order == leaf) && known->certificate &&
        is_revoked(known->certificate))
        found = known;
}

unsigned wire_permissions_revoke(X509_CRL *list)
{
    unsigned count = 0;
    pthread_mutex_lock(&lock);
    X509_CRL_free(revoked);
    revoked = list;
    for (;;) {
        found = NULL;
        twalk(all, look_at);
        if (!found)
            break;
        /* DDS gives its handle back meanwhile */
        const int64_t handle = found->handle;
        dds_security_access_control *access = found->access;
        X509_free(found->certificate);
        found->certificate = NULL;
        pthread_mutex_unlock(&lock);
        listener.on_revoke_permissions(access, handle);
        count++;
        pthread_mutex_lock(&lock);
    }
    pthread_mutex_unlock(&lock);
    atomic_fetch_add(&refused, count);
    return count;
}
