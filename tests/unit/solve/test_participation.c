/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/solve/participation.c: kept or not, they are the bits of modal_participations. */
#include <stdlib.h>

#include "model/bar.h"
#include "physics/support.h"
#include "solve/participation.h"

enum { MODES = 40, LOADS = 3 * PARTICIPATION_LOADS };

/* Along a beam, across it. */
static struct family_load load_at(double x)
{
    struct family_load load = {.acts = true};
    load.bar.x = x;
    load.bar.force = 1.0;
    return load;
}

/* Modes from `first` on, by steps of one or two, asked for and compared. */
static void ask(struct participations *kept, const struct body *body,
                const struct modal_family *modes, const struct family_load *load, size_t first,
                size_t step, size_t count)
{
    size_t which[MODES];
    double mine[MODES], plain[MODES];
    size_t n = 0;
    for (size_t k = first; k < MODES && n < count; k += step)
        which[n++] = k;
    participations_get(kept, body, modes, which, n, load, mine);
    modal_participations(body, modes, which, n, load, plain);
    assert_memory_equal(mine, plain, n * sizeof *mine);
}

/* More loads by turns than are kept, more modes each time, fewer again, even and odd ones. */
static void any_order_gives_the_same_bits(void **state)
{
    (void)state;
    struct body body = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    assert_int_equal(body_complete(&body, NULL), PERCUSS_OK);
    struct modal_family *modes = modal_family_create(&body, BAR_BENDING_Z, MODES);
    struct participations *kept = participations_create(MODES);
    assert_non_null(modes);
    assert_non_null(kept);
    uint64_t seed = 11;
    for (int i = 0; i < 3000; i++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        unsigned number = (unsigned)(seed >> 33);
        /* often the same few, at times any */
        size_t which = number % 4 ? number / 4 % 5 : number / 4 % LOADS;
        struct family_load load = load_at(-0.5 + (double)which / LOADS);
        ask(kept, &body, modes, &load, number / 256 % 3 ? 0 : number / 1024 % MODES,
            1 + number / 65536 % 2, 1 + number / 131072 % MODES);
    }
    /* mode after mode, as who looks for the last that matters */
    for (size_t k = 0; k < MODES; k++) {
        struct family_load load = load_at(0.123);
        ask(kept, &body, modes, &load, k, 1, 1);
    }
    participations_free(kept);
    modal_family_free(modes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_order_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
