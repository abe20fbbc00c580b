/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Plugins of DDS Security as an attacker with an identity has them: Cyclone DDS's, but what its
 * permissions forbid it creates all the same, and its readers and writers announce themselves
 * without the attributes by which Cyclone DDS tells whether a peer's permissions are to be looked
 * up. */
#include <dds/ddsrt/dynlib.h>
#include <dds/security/dds_security_api.h>
#include <stdlib.h>
#include <string.h>

int patched_access_init(const char *argument, void **context, struct ddsi_domaingv *gv);
int patched_access_finalize(void *context);
int patched_crypto_init(const char *argument, void **context, struct ddsi_domaingv *gv);
int patched_crypto_finalize(void *context);

static int start(const char *library, const char *init, void **context, struct ddsi_domaingv *gv)
{
    ddsrt_dynlib_t handle;
    void *function;
    if (ddsrt_dlopen(library, true, &handle) || ddsrt_dlsym(handle, init, &function))
        abort();
    return ((plugin_init)function)("", context, gv);
}

static int end(const char *library, const char *finalize, void *context)
{
    ddsrt_dynlib_t handle;
    void *function;
    if (ddsrt_dlopen(library, true, &handle) || ddsrt_dlsym(handle, finalize, &function))
        abort();
    return ((plugin_finalize)function)(context);
}

static DDS_Security_boolean allow_endpoint(dds_security_access_control *instance,
                                           const DDS_Security_PermissionsHandle permissions,
                                           const DDS_Security_DomainId domain, const char *topic,
                                           const DDS_Security_Qos *qos,
                                           const DDS_Security_PartitionQosPolicy *partition,
                                           const DDS_Security_DataTags *tags,
                                           DDS_Security_SecurityException *exception)
{
    (void)instance, (void)permissions, (void)domain, (void)topic;
    (void)qos, (void)partition, (void)tags, (void)exception;
    return true;
}

static DDS_Security_boolean allow_topic(dds_security_access_control *instance,
                                        const DDS_Security_PermissionsHandle permissions,
                                        const DDS_Security_DomainId domain, const char *topic,
                                        const DDS_Security_Qos *qos,
                                        DDS_Security_SecurityException *exception)
{
    (void)instance, (void)permissions, (void)domain, (void)topic, (void)qos, (void)exception;
    return true;
}

/* whoever answers it is as good a server as any */
static DDS_Security_boolean
believe_writer(dds_security_access_control *instance,
               const DDS_Security_PermissionsHandle permissions, const DDS_Security_DomainId domain,
               const DDS_Security_PublicationBuiltinTopicDataSecure *data,
               DDS_Security_SecurityException *exception)
{
    (void)instance, (void)permissions, (void)domain, (void)data, (void)exception;
    return true;
}

static DDS_Security_boolean
believe_reader(dds_security_access_control *instance,
               const DDS_Security_PermissionsHandle permissions, const DDS_Security_DomainId domain,
               const DDS_Security_SubscriptionBuiltinTopicDataSecure *data,
               DDS_Security_boolean *relay_only, DDS_Security_SecurityException *exception)
{
    (void)instance, (void)permissions, (void)domain, (void)data, (void)exception;
    *relay_only = false;
    return true;
}

int patched_access_init(const char *argument, void **context, struct ddsi_domaingv *gv)
{
    (void)argument;
    int code = start("dds_security_ac", "init_access_control", context, gv);
    dds_security_access_control *access = *context;
    access->check_create_datawriter = allow_endpoint;
    access->check_create_datareader = allow_endpoint;
    access->check_create_topic = allow_topic;
    access->check_remote_datawriter = believe_writer;
    access->check_remote_datareader = believe_reader;
    return code;
}

int patched_access_finalize(void *context)
{
    return end("dds_security_ac", "finalize_access_control", context);
}

static DDS_Security_crypto_transform_encode_datawriter_submessage encode;

/* PID_ENDPOINT_SECURITY_INFO of discovery (DDS Security 1.1, 7.4.1.3): both masks become 0 */
static DDS_Security_boolean
encode_without_attributes(dds_security_crypto_transform *instance, DDS_Security_OctetSeq *encoded,
                          const DDS_Security_OctetSeq *plain,
                          const DDS_Security_DatawriterCryptoHandle writer,
                          const DDS_Security_DatareaderCryptoHandleSeq *readers,
                          DDS_Security_long *index, DDS_Security_SecurityException *exception)
{
    static const unsigned char attributes[4] = {0x04, 0x10, 0x08, 0x00};
    for (size_t i = 0; i + 12 <= plain->_length; i += 4) {
        if (memcmp(plain->_buffer + i, attributes, sizeof attributes) == 0)
            memset(plain->_buffer + i + 4, 0, 8);
    }
    return encode(instance, encoded, plain, writer, readers, index, exception);
}

int patched_crypto_init(const char *argument, void **context, struct ddsi_domaingv *gv)
{
    (void)argument;
    int code = start("dds_security_crypto", "init_crypto", context, gv);
    dds_security_cryptography *crypto = *context;
    encode = crypto->crypto_transform->encode_datawriter_submessage;
    crypto->crypto_transform->encode_datawriter_submessage = encode_without_attributes;
    return code;
}

int patched_crypto_finalize(void *context)
{
    return end("dds_security_crypto", "finalize_crypto", context);
}
