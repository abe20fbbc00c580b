/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A family of contact tables as JSON, whose hash is taken for right: read, or refused in words. */
#include "fuzz.h"
#include "store/family_file.h"
#include "store/json_numbers.h"

enum percuss_status __wrap_json_numbers_check_hash(const json_t *root, const char *name,
                                                   const char *expected, struct fault *fault);

enum percuss_status __wrap_json_numbers_check_hash(const json_t *root, const char *name,
                                                   const char *expected, struct fault *fault)
{
    (void)root, (void)name, (void)expected, (void)fault;
    return PERCUSS_OK;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct fault fault = {""};
    struct contact_family *family = family_file_load(fuzz_file(0, data, size), &fault);
    if (!family)
        fuzz_refused(PERCUSS_BAD_REQUEST, fault.text);
    contact_family_free(family);
    return 0;
}
