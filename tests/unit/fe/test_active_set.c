/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/active_set.c: the conditions of contact on full matrices, three ways to ask.
 */
#include "check.h"
#include "fe/active_set.h"

enum { N = 12 };

/* neighbours press each other down like points on a half-space; initial gaps of a paraboloid, the
 * middle dented by `dent` */
struct scene {
    double compliance[N * N], initial[N], force[N], scratch[(N + 1) * (N + 3)];
    bool active[N];
    struct active_set set;
};

static void scene_make(struct scene *scene, double dent)
{
    for (size_t i = 0; i < N; i++) {
        double x = (double)i;
        scene->initial[i] = 0.01 * x * x + dent * exp(-x * x / 9.0);
        scene->active[i] = false;
        for (size_t j = 0; j < N; j++)
            scene->compliance[i * N + j] = 0.05 / (0.7 + fabs(x - (double)j));
    }
    scene->set = (struct active_set){.count = N,
                                     .compliance = scene->compliance,
                                     .initial = scene->initial,
                                     .force = scene->force,
                                     .active = scene->active,
                                     .scratch = scene->scratch};
}

static size_t check(const struct scene *scene)
{
    size_t active = 0;
    double total = 0.0;
    for (size_t i = 0; i < N; i++) {
        double gap = scene->initial[i] - scene->set.indentation;
        for (size_t j = 0; j < N; j++)
            gap += scene->compliance[i * N + j] * scene->force[j];
        assert_true(gap >= -1e-12 && scene->force[i] >= -1e-12);
        assert_true(fabs(gap * scene->force[i]) < 1e-12);
        active += scene->active[i];
        total += scene->force[i];
    }
    assert_true(fabs(total - scene->set.total) < 1e-12 * fmax(1.0, total));
    return active;
}

static void finds_contact_at_an_indentation(void **state)
{
    (void)state;
    struct scene scene;
    size_t before = 0;
    scene_make(&scene, 0.0);
    scene.set.kind = ACTIVE_SET_BY_INDENTATION;
    for (double d = -0.1; d < 1.2; d += 0.05) {
        scene.set.indentation = d;
        assert_true(active_set_solve(&scene.set));
        size_t active = check(&scene);
        assert_true(active >= before);
        assert_true((d > 0.0) == (active > 0));
        before = active;
    }
    /* the slope is the derivative while the same nodes touch */
    double total = scene.set.total, slope = scene.set.stiffness;
    scene.set.indentation += 1e-6;
    assert_true(active_set_solve(&scene.set));
    assert_true(fabs((scene.set.total - total) / 1e-6 / slope - 1.0) < 1e-5);
}

static void finds_a_ring(void **state)
{
    (void)state;
    struct scene scene;
    scene_make(&scene, 0.3);
    scene.set.kind = ACTIVE_SET_BY_INDENTATION;
    scene.set.indentation = 0.28;
    assert_true(active_set_solve(&scene.set));
    assert_true(check(&scene) > 0);
    assert_false(scene.active[0]);
}

static void finds_it_under_a_force_and_at_an_edge(void **state)
{
    (void)state;
    struct scene scene;
    scene_make(&scene, 0.0);
    scene.set.kind = ACTIVE_SET_BY_TOTAL;
    scene.set.total = 3.0;
    assert_true(active_set_solve(&scene.set));
    check(&scene);
    double indentation = scene.set.indentation;
    scene.set.kind = ACTIVE_SET_BY_INDENTATION;
    assert_true(active_set_solve(&scene.set));
    assert_true(fabs(scene.set.total - 3.0) < 1e-12);
    scene.set.kind = ACTIVE_SET_BY_EDGE;
    scene.set.edge = 5;
    assert_true(active_set_solve(&scene.set));
    check(&scene);
    assert_true(fabs(scene.force[5]) < 1e-14 && scene.force[4] > 0.0);
    assert_true(scene.set.indentation != indentation);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_contact_at_an_indentation),
        cmocka_unit_test(finds_a_ring),
        cmocka_unit_test(finds_it_under_a_force_and_at_an_edge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
