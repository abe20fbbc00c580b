/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Sequences whose models are wrong by what is known of them: nineteen of twenty answers stay within
 * the error that is stated without them. */
#include "physics/estimates/drawn.h"

enum { SCENES = 12, DRAWS = 5 };

static struct solve_result stated, shifted;

/* Normal, by Box and Muller. */
static double deviate(uint64_t *r)
{
    double radius = sqrt(-2.0 * log(random_between(r, 1e-12, 1.0)));
    return radius * cos(random_between(r, 0.0, 2.0 * M_PI));
}

/* Largest difference over the contacts. */
static double difference(void)
{
    double largest = 0.0;
    for (size_t c = 0; c < stated.contact_count; c++)
        largest = fmax(largest, fabs(shifted.contacts[c].restitution -
                                     stated.contacts[c].restitution)); /* NAN: has none */
    return largest;
}

/* How many of the draws of a class are covered; *judged is how many there are. */
static unsigned count_covered(enum scene_class class, unsigned *judged)
{
    struct lab *lab = lab_create();
    uint64_t r = 2463534242u + class;
    unsigned covered = 0;
    lab->set.compliance = PERCUSS_COMPLIANCE_MATCHED;
    for (uint64_t number = 0; number < SCENES; number++) {
        struct scene_drawn scene;
        if (!scene_draw(lab, class, number, &scene))
            continue;
        if (solve(lab->workspace, &lab->means, &scene.request, &stated) == PERCUSS_OK)
            for (int i = 0; i < DRAWS; i++) {
                for (int k = 0; k < SOLVE_SHIFTS; k++)
                    scene.request.model_shift[k] = deviate(&r);
                if (solve(lab->workspace, &lab->means, &scene.request, &shifted) != PERCUSS_OK)
                    continue;
                (*judged)++;
                covered += difference() <= stated.restitution_total;
            }
        scene_release(&scene);
    }
    lab_free(lab);
    return covered;
}

static void sequences_stay_within_what_is_stated(void **state)
{
    (void)state;
    static const enum scene_class classes[] = {CLASS_HEAVY, CLASS_GROUP, CLASS_ROLLED,
                                               CLASS_RINGING};
    unsigned judged = 0, covered = 0;
    for (size_t k = 0; k < sizeof classes / sizeof *classes; k++)
        covered += count_covered(classes[k], &judged);
    printf("%u of %u\n", covered, judged);
    assert_true(judged > 150);
    assert_true(covered >= 0.95 * judged);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sequences_stay_within_what_is_stated)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
