/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "in_process.h"

#include <dlfcn.h>
#include <percuss/local.h>
#include <string.h>

/* What is needed of the library; the rest of the interface is that of libpercuss. */
struct library {
    struct percuss_local_config (*config_default)(void);
    enum percuss_result (*open)(const struct percuss_local_config *, struct percuss_client **);
    const char *(*error_text)(void);
};

/* It stays loaded till the end. False: it is not there, which is complained of. */
static bool load(struct library *library)
{
    void *handle = dlopen("libpercuss-local.so." PERCUSS_SOVERSION, RTLD_NOW | RTLD_LOCAL);
    if (handle) {
        *(void **)&library->config_default = dlsym(handle, "percuss_local_config_default");
        *(void **)&library->open = dlsym(handle, "percuss_local_open");
        *(void **)&library->error_text = dlsym(handle, "percuss_error_text");
    }
    if (handle && library->config_default && library->open && library->error_text)
        return true;
    complain("--local: %s", dlerror());
    return false;
}

int in_process_open(const struct common *common, const uint8_t *id, struct percuss_client **client)
{
    struct library library;
    *client = NULL;
    if (!load(&library))
        return EXIT_NO_SERVER;
    struct percuss_local_config config = library.config_default();
    config.settings = common->config;
    config.catalogue = common->catalogue;
    if (id)
        memcpy(config.id, id, sizeof config.id);
    enum percuss_result result = library.open(&config, client);
    if (result == PERCUSS_RESULT_OK)
        return EXIT_ANSWERED;
    complain("%s", library.error_text());
    return result == PERCUSS_RESULT_INVALID_ARGUMENT ? EXIT_USAGE : EXIT_ANSWERED_WITH_WARNING;
}
