/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A contact table as JSON, whose hashes are taken for right: else no changed number would come
 * further. The law that is made of it has forces that are numbers, do not pull and rise. */
#include <math.h>

#include "contact/law_table.h"
#include "fuzz.h"
#include "store/json_numbers.h"
#include "store/table_curves.h"
#include "store/table_file.h"

enum percuss_status __wrap_json_numbers_check_hash(const json_t *root, const char *name,
                                                   const char *expected, struct fault *fault);

enum percuss_status __wrap_json_numbers_check_hash(const json_t *root, const char *name,
                                                   const char *expected, struct fault *fault)
{
    (void)root, (void)name, (void)expected, (void)fault;
    return PERCUSS_OK;
}

static void load_and_unload(const struct contact_curves *curves)
{
    struct contact_law law = contact_law_table(curves);
    double range = contact_law_table_range(&law), before = 0.0;
    for (int i = 0; i <= 40; i++) {
        double stiffness, d = range * i / 20.0;
        double force = law.operations->force(&law, d, &stiffness);
        FUZZ_REQUIRE(isfinite(force) && isfinite(stiffness), "force %g at %g m, slope %g", force, d,
                     stiffness);
        /* but for the rounding of a spline */
        FUZZ_REQUIRE(force >= before * (1.0 - 1e-9), "the force falls from %g to %g N at %g m",
                     before, force, d);
        double stored = law.operations->stored(&law, d);
        FUZZ_REQUIRE(isfinite(stored), "energy %g at %g m", stored, d);
        before = force;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct indentation_table table = {0};
    struct contact_curves *curves;
    struct fault fault = {""};
    enum percuss_status status = table_json_read((const char *)data, size, &table, &fault);
    if (status) {
        fuzz_refused(status, fault.text);
        return 0;
    }
    status = table_curves_make(&table, NULL, &curves, &fault);
    if (status)
        fuzz_refused(status, fault.text);
    else
        load_and_unload(curves);
    contact_curves_free(curves);
    indentation_table_free(&table);
    return 0;
}
