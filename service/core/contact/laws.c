/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/law_closed_form.h"

/* The models that are no law themselves: AUTO selects one, the others compute the contact. */
const struct contact_law_operations contact_law_AUTO = {
    .model = PERCUSS_CONTACT_AUTO,
    .effort = CONTACT_EFFORT_LEAST,
    .tables = CONTACT_TABLES_IF_ANY,
    .yields_if_needed = true,
    .make = contact_law_closed_form,
};

const struct contact_law_operations contact_law_CONCURRENT_FE = {
    .model = PERCUSS_CONTACT_CONCURRENT_FE,
    .effort = CONTACT_EFFORT_LONG,
    .method = CONTACT_CONCURRENT,
    .make = contact_law_closed_form,
};

const struct contact_law_operations contact_law_COMPLETE_FE = {
    .model = PERCUSS_CONTACT_COMPLETE_FE,
    .effort = CONTACT_EFFORT_LONG,
    .method = CONTACT_COMPLETE,
    .make = contact_law_closed_form,
};

/* The catalogue's law of the two materials is in its place. */
const struct contact_law_operations contact_law_LAW = {
    .model = PERCUSS_CONTACT_LAW,
    .effort = CONTACT_EFFORT_SHORT,
    .make = contact_law_closed_form,
};

#define ENTRY(name, text) &contact_law_##name,

const struct contact_law_operations *contact_law_asked(unsigned model)
{
    static const struct contact_law_operations *const all[] = {PERCUSS_CONTACT_MODEL_LIST(ENTRY)};
    return all[model < PERCUSS_CONTACT_COUNT ? model : PERCUSS_CONTACT_AUTO];
}

const char *contact_law_refuses(const struct contact_law *law, size_t rubbing)
{
    if (law->operations->lossy && rubbing > 0)
        return "method cvode has no friction beside it (options.friction none; method modal has)";
    return NULL;
}
