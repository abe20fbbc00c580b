/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/prepared.c: a hit and a miss give the same bits, growing keeps what
 * scenes point at, a new revision forgets. */
#include <stdlib.h>

#include "model/bar.h"
#include "physics/support.h"
#include "solve/prepared.h"

static struct body beam(const char *id, double length)
{
    struct body body = make_bar(&beam_kind, ALUMINIUM, 0.010, length);
    snprintf(body.id, sizeof body.id, "%s", id);
    assert_int_equal(body_complete(&body, NULL), PERCUSS_OK);
    return body;
}

static void more_modes_change_no_bit(void **state)
{
    (void)state;
    struct body body = beam("beam", 1.0);
    struct prepared_cache *cache = prepared_cache_create();
    assert_non_null(cache);
    prepared_cache_use(cache, "one");
    const struct prepared_family *few = prepared_family_get(cache, &body, BAR_BENDING_Z, 5);
    assert_non_null(few);
    assert_true(few->modes->count >= 5);
    size_t count = few->modes->count;
    const struct prepared_family *many = prepared_family_get(cache, &body, BAR_BENDING_Z, 300);
    assert_non_null(many);
    assert_true(many != few && many->modes->count >= 300);
    /* the smaller one is still there: a scene may hold it */
    assert_memory_equal(few->modes->omega, many->modes->omega, count * sizeof(double));
    assert_memory_equal(few->modes->shapes, many->modes->shapes,
                        count * sizeof(struct beam_unit_mode));
    assert_memory_equal(few->modes->odd, many->modes->odd, count);
    assert_ptr_equal(prepared_family_get(cache, &body, BAR_BENDING_Z, 4), many);
    prepared_cache_free(cache);
}

/* Of 40 modes of a body all frequencies and participations in a load. */
static void note_modes(struct prepared_cache *cache, const struct body *body, double noted[2][40])
{
    const struct prepared_family *family = prepared_family_get(cache, body, BAR_BENDING_Z, 40);
    struct family_load load = {.acts = true, .bar = {.x = 0.1, .force = 1.0}};
    assert_non_null(family);
    memcpy(noted[0], family->modes->omega, sizeof noted[0]);
    for (size_t k = 0; k < 40; k++)
        noted[1][k] = modal_participation(body, family->modes, k, &load);
}

/* With other densities, or the modulus four times as large, the search is not made again, whether
 * before fewer or more modes were asked for: the bits are those of a search. */
static void bodies_alike_share_their_search(void **state)
{
    (void)state;
    for (size_t before = 5; before < 100; before += 37) {
        struct prepared_cache *cache = prepared_cache_create();
        struct prepared_cache *fresh = prepared_cache_create();
        assert_true(cache && fresh);
        prepared_cache_use(cache, "one");
        prepared_cache_use(fresh, "one");
        struct body body = beam("beam", 1.0);
        assert_non_null(prepared_family_get(cache, &body, BAR_BENDING_Z, before));
        body.varied = true;
        body.material.young *= 4.0;
        body.material.density = 2800.0;
        assert_int_equal(body_complete(&body, NULL), PERCUSS_OK);
        struct body first = beam("beam", 1.0);
        assert_true(modal_family_alike(&first, &body, BAR_BENDING_Z));
        double shared[2][40];
        double searched[2][40];
        note_modes(cache, &body, shared);
        note_modes(fresh, &body, searched);
        assert_memory_equal(shared, searched, sizeof shared);
        /* and further ones */
        const struct prepared_family *more = prepared_family_get(cache, &body, BAR_BENDING_Z, 120);
        const struct prepared_family *all = prepared_family_get(fresh, &body, BAR_BENDING_Z, 120);
        assert_memory_equal(more->modes->omega, all->modes->omega, 120 * sizeof(double));
        prepared_cache_free(cache);
        prepared_cache_free(fresh);
    }
    struct body thin = beam("beam", 1.0);
    struct body thick = beam("beam", 0.9);
    assert_false(modal_family_alike(&thin, &thick, BAR_BENDING_Z));
}

/* Even and odd modes of equal ends, in two groups that list all modes once, ascending. */
static void groups_split_by_parity(void **state)
{
    (void)state;
    struct body body = beam("beam", 1.0);
    struct prepared_cache *cache = prepared_cache_create();
    assert_non_null(cache);
    prepared_cache_use(cache, "one");
    const struct prepared_family *family = prepared_family_get(cache, &body, BAR_BENDING_Y, 40);
    assert_non_null(family);
    assert_int_equal(family->group_count, 2);
    size_t seen = 0;
    for (size_t g = 0; g < 2; g++) {
        const struct prepared_group *group = &family->groups[g];
        for (size_t k = 0; k < group->set->count; k++, seen++) {
            assert_int_equal(family->modes->odd[group->mode[k]], g);
            assert_true(group->set->omega[k] == family->modes->omega[group->mode[k]]);
            assert_true(k == 0 || group->mode[k] > group->mode[k - 1]);
        }
    }
    assert_int_equal(seen, family->modes->count);
    body.supports[0] = SUPPORT_CLAMPED;
    snprintf(body.id, sizeof body.id, "cantilever");
    family = prepared_family_get(cache, &body, BAR_BENDING_Y, 40);
    assert_non_null(family);
    assert_int_equal(family->group_count, 1);
    prepared_cache_free(cache);
}

/* Ellipses and circles asked for by turns, more than are kept. */
static void contacts_are_those_made_anew(void **state)
{
    (void)state;
    struct prepared_cache *cache = prepared_cache_create();
    assert_non_null(cache);
    for (int i = 0; i < 400; i++) {
        double modulus = i % 3 ? 5e10 : 7e10;
        double curvature[2] = {20.0, 20.0 + 3.0 * (i % 7) * (i % 11)};
        struct hertz_contact kept = prepared_contact_get(cache, modulus, curvature);
        struct hertz_contact made = hertz_contact_make(modulus, curvature[0], curvature[1]);
        assert_memory_equal(&kept, &made, sizeof kept);
    }
    prepared_cache_free(cache);
}

static void bodies_and_revisions_are_kept_apart(void **state)
{
    (void)state;
    struct body first = beam("first", 1.0), second = beam("second", 0.5);
    struct prepared_cache *cache = prepared_cache_create();
    assert_non_null(cache);
    prepared_cache_use(cache, "one");
    double omega[2];
    omega[0] = prepared_family_get(cache, &first, BAR_BENDING_Z, 8)->modes->omega[0];
    omega[1] = prepared_family_get(cache, &second, BAR_BENDING_Z, 8)->modes->omega[0];
    assert_true(omega[1] > 3.0 * omega[0]);
    /* the same revision remembers, another one looks again */
    second.length = 0.25;
    assert_int_equal(body_complete(&second, NULL), PERCUSS_OK);
    prepared_cache_use(cache, "one");
    assert_true(prepared_family_get(cache, &second, BAR_BENDING_Z, 8)->modes->omega[0] == omega[1]);
    prepared_cache_use(cache, "two");
    assert_true(prepared_family_get(cache, &second, BAR_BENDING_Z, 8)->modes->omega[0] >
                2.0 * omega[1]);
    /* several hundred bodies share buckets */
    for (int i = 0; i < 400; i++) {
        char id[32];
        snprintf(id, sizeof id, "beam-%d", i);
        struct body body = beam(id, 0.5 + 0.001 * i);
        assert_non_null(prepared_family_get(cache, &body, BAR_LONGITUDINAL, 1));
    }
    struct body again = beam("beam-7", 0.507);
    double c = sqrt(70e9 / 2700.0);
    measured_relative("beam-7",
                      prepared_family_get(cache, &again, BAR_LONGITUDINAL, 1)->modes->omega[0],
                      M_PI * c / 0.507, 1e-14);
    prepared_cache_free(cache);
    prepared_cache_free(NULL);
}

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
static void ask_participations(struct participations *cached, const struct body *body,
                               const struct modal_family *modes, const struct family_load *load,
                               size_t first, size_t step, size_t count)
{
    size_t which[MODES];
    double mine[MODES], plain[MODES];
    size_t n = 0;
    for (size_t k = first; k < MODES && n < count; k += step)
        which[n++] = k;
    participations_get(cached, body, modes, which, n, load, mine);
    modal_participations(body, modes, which, n, load, plain);
    assert_memory_equal(mine, plain, n * sizeof *mine);
}

/* More loads by turns than are cached, more modes each time, fewer again, even and odd ones. */
static void participations_in_any_order_are_the_same_bits(void **state)
{
    (void)state;
    struct body body = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    assert_int_equal(body_complete(&body, NULL), PERCUSS_OK);
    struct modal_family *modes = modal_family_create(&body, BAR_BENDING_Z, MODES);
    struct participations *cached = participations_create(MODES);
    assert_non_null(modes);
    assert_non_null(cached);
    uint64_t seed = 11;
    for (int i = 0; i < 3000; i++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        unsigned number = (unsigned)(seed >> 33);
        /* often the same few, at times any */
        size_t which = number % 4 ? number / 4 % 5 : number / 4 % LOADS;
        struct family_load load = load_at(-0.5 + (double)which / LOADS);
        ask_participations(cached, &body, modes, &load,
                           number / 256 % 3 ? 0 : number / 1024 % MODES, 1 + number / 65536 % 2,
                           1 + number / 131072 % MODES);
    }
    /* mode after mode, as a search for the last that matters does */
    for (size_t k = 0; k < MODES; k++) {
        struct family_load load = load_at(0.123);
        ask_participations(cached, &body, modes, &load, k, 1, 1);
    }
    participations_free(cached);
    modal_family_free(modes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(more_modes_change_no_bit),
        cmocka_unit_test(bodies_alike_share_their_search),
        cmocka_unit_test(groups_split_by_parity),
        cmocka_unit_test(contacts_are_those_made_anew),
        cmocka_unit_test(participations_in_any_order_are_the_same_bits),
        cmocka_unit_test(bodies_and_revisions_are_kept_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
