/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The daemon's settings: every number in its range, every text ended, or a refusal in words. */
#include "respond/settings.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct settings settings = settings_default();
    struct fault fault = {""};
    enum percuss_status status = settings_load(fuzz_file(0, data, size), &settings, &fault);
    if (status) {
        fuzz_refused(status, fault.text);
        return 0;
    }
    FUZZ_REQUIRE(settings.domain <= SETTINGS_MAX_DOMAIN, "domain %u", settings.domain);
    FUZZ_REQUIRE(settings.workers >= 1 && settings.queue_capacity >= 1, "%u workers, %u places",
                 settings.workers, settings.queue_capacity);
    FUZZ_REQUIRE(settings.drain_seconds >= 0.0 && settings.token_minutes > 0.0 &&
                     settings.session_minutes > 0.0 && settings.bodies_days > 0.0,
                 "a time that is none");
    FUZZ_REQUIRE(settings.log_level < LEVEL_COUNT, "log level %d", (int)settings.log_level);
    FUZZ_REQUIRE(memchr(settings.catalogue, 0, sizeof settings.catalogue) &&
                     memchr(settings.tables[SETTINGS_FOLDERS_MOST - 1], 0, SETTINGS_PATH_SIZE) &&
                     memchr(settings.store, 0, sizeof settings.store),
                 "a path without an end");
    return 0;
}
