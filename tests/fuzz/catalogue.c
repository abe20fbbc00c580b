/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The text of a catalogue: bodies that are whole, or a refusal in words. */
#include <math.h>

#include "catalogue/catalogue.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct body_set *set;
    struct fault fault = {""};
    enum percuss_status status =
        catalogue_parse((const char *)data, size, "catalogue.yaml", &set, &fault);
    if (status) {
        fuzz_refused(status, fault.text);
        FUZZ_REQUIRE(!set, "a set beside a refusal");
        return 0;
    }
    for (size_t i = 0; i < set->count; i++) {
        const struct body *body = &set->bodies[i];
        FUZZ_REQUIRE(body->kind && body->id[0], "a body that is none");
        FUZZ_REQUIRE(body->mass > 0.0, "body %s: mass %g", body->id, body->mass);
    }
    body_set_free(set);
    return 0;
}
