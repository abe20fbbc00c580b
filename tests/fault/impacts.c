/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fault/impacts.h"

#include <string.h>

#include "check.h"

enum { SPECIMENS = 3 };

static unsigned char reply_bytes[IMPACTS_REPLY_MOST];

static struct body rod(void)
{
    struct body body = {.kind = &rod_kind, .radius = 0.01, .length = 1.0, .tip_radius = INFINITY};
    strcpy(body.id, "rod");
    body.material = (struct material){"al", 70e9, 0.33, 2700.0, 205e6, 0.0};
    return body;
}

/* Impact 1, 2, ... hits specimen 0, 1, 2, 0, ... and leaves up to four dents that tell it. */
static struct body_state *dents_after(unsigned impact)
{
    struct body_state sizes = {.dents = 1 + impact % 4};
    struct body_state *state = malloc(body_state_size(&sizes));
    *state = sizes;
    double *numbers = (double *)body_state_dents(state);
    for (size_t i = 0; i < 8 * state->dents; i++)
        numbers[i] = i % 5 == 4 ? -0.0 : sin(impact + 0.1 * (double)i);
    return state;
}

static const char *name_of(unsigned impact)
{
    static const char *const names[SPECIMENS] = {"one", "two", "three"};
    return names[impact % SPECIMENS];
}

struct stored_reply impacts_reply(unsigned impact, size_t size)
{
    memset(reply_bytes, (int)impact, size);
    return (struct stored_reply){.client = {(uint8_t)(impact % 2)},
                                 .sequence = impact,
                                 .content = {impact, ~(uint64_t)impact},
                                 .size = size,
                                 .bytes = reply_bytes};
}

enum percuss_status impacts_hit(struct specimen_store *store, unsigned impact, size_t size,
                                struct fault *fault)
{
    struct body body = rod();
    struct body_state *state = dents_after(impact), *before;
    struct specimen_change change = {name_of(impact), &body, state};
    struct stored_reply reply = impacts_reply(impact, size);
    /* as the daemon does: the dents before, then those after with the reply */
    enum percuss_status status = specimen_store_load(store, change.name, &body, &before, fault);
    if (!status) {
        free(before);
        status = specimen_store_commit(store, &change, 1, &reply, fault);
    }
    free(state);
    return status;
}

static void count_impacts(void *context, const struct specimen *specimen)
{
    *(unsigned *)context += (unsigned)specimen->impacts;
}

unsigned impacts_check(struct specimen_store *store)
{
    unsigned count = 0;
    struct fault fault;
    assert_int_equal(specimen_store_visit(store, NULL, count_impacts, &count, &fault), PERCUSS_OK);
    for (unsigned impact = count; impact > 0 && impact + SPECIMENS > count; impact--) {
        struct body body = rod();
        struct body_state *expected = dents_after(impact), *state;
        if (specimen_store_load(store, name_of(impact), &body, &state, &fault))
            fail_msg("%s", fault.text);
        assert_non_null(state);
        assert_int_equal(state->dents, expected->dents);
        const double *a = (const double *)body_state_dents(state);
        const double *b = (const double *)body_state_dents(expected);
        /* -0 may have become 0: equal, not the same */
        for (size_t i = 0; i < 8 * state->dents; i++)
            assert_true(a[i] == b[i]);
        free(expected);
        free(state);
    }
    return count;
}

void impacts_check_replies(struct specimen_store *store, unsigned count, size_t size)
{
    for (unsigned impact = 1; impact <= count + 2; impact++) {
        struct fault fault;
        struct stored_reply expected = impacts_reply(impact, size), found = expected;
        enum percuss_status status = specimen_store_find(store, &found, &fault);
        bool kept = impact <= count && impact + IMPACTS_KEPT > count;
        assert_int_equal(status, kept || impact > count ? PERCUSS_OK : PERCUSS_BAD_REQUEST);
        if (kept) {
            assert_non_null(found.bytes);
            assert_int_equal(found.size, size);
            assert_memory_equal(found.bytes, expected.bytes, size);
        } else {
            assert_null(found.bytes);
        }
        free(found.bytes);
    }
}
