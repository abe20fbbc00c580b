/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The names under which Cyclone DDS finds the plugins of wire_permissions.h: compiled into each
 * program and library that opens secured participants (wire_plugins in CMake), which Cyclone DDS
 * opens as if it were a file of plugins. */
#include "wire_permissions.h"

/* Of a program the name that the loader knows it by; empty in a library, whose path is looked up.
 */
const char *const wire_plugin_library = WIRE_PLUGIN_LIBRARY;

#define EXPORTED __attribute__((visibility("default")))

EXPORTED int percuss_plugin_access_init(const char *, void **, struct ddsi_domaingv *);
EXPORTED int percuss_plugin_access_end(void *);
EXPORTED int percuss_plugin_crypto_init(const char *, void **, struct ddsi_domaingv *);
EXPORTED int percuss_plugin_crypto_end(void *);

int percuss_plugin_access_init(const char *argument, void **context, struct ddsi_domaingv *domain)
{
    return wire_permissions_access_init(argument, context, domain);
}

int percuss_plugin_access_end(void *context)
{
    return wire_permissions_access_end(context);
}

int percuss_plugin_crypto_init(const char *argument, void **context, struct ddsi_domaingv *domain)
{
    return wire_permissions_crypto_init(argument, context, domain);
}

int percuss_plugin_crypto_end(void *context)
{
    return wire_permissions_crypto_end(context);
}
