/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/mesh_family.c: a half-space's field beside a smooth one, given at sites, is what comes back
 * between them. */
#include "model/mesh_family.h"

#include <string.h>

#include "bodies/made_mesh.h"
#include "check.h"
#include "model/mesh_surface.h"

static const double RADIUS = 0.01, LENGTH = 0.08;
enum { SIDE = 9 };

/* Regular part between two places of an end, symmetric and not linear. */
static double smooth(const double a[3], const double b[3])
{
    double x = (a[1] + b[1]) / RADIUS, y = (a[2] + b[2]) / RADIUS, z = a[1] * b[2] + a[2] * b[1];
    return 1e-10 * (2.0 - 0.3 * x + 0.2 * y + 0.05 * x * x + 0.1 * z / (RADIUS * RADIUS));
}

static double singular(const struct mesh_body *body, const double a[3], const double b[3])
{
    const struct material *m = body->materials;
    double distance = hypot(a[1] - b[1], a[2] - b[2]);
    return (1.0 - m->poisson * m->poisson) / (M_PI * m->young * distance);
}

/* Sites on a grid of the right end, 1.5 mm apart. */
static struct mesh_body *make_body(void)
{
    struct body rod = {.id = "rod",
                       .kind = &rod_kind,
                       .radius = RADIUS,
                       .length = LENGTH,
                       .tip_radius = INFINITY,
                       .material = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0}};
    struct fault fault;
    assert_int_equal(body_complete(&rod, &fault), PERCUSS_OK);
    struct mesh_body *body = made_mesh_bar(
        &(struct made_mesh){.bar = &rod, .modes = 4, .removed = 2, .around = 24, .along = 8});
    assert_true(body && mesh_surface_prepare(body));
    size_t n = body->site_count = SIDE * SIDE;
    body->near = 4e-3;
    body->element_size = 1e-3;
    body->site_face = calloc(n, sizeof *body->site_face);
    body->site_point = calloc(n, sizeof *body->site_point);
    body->site_normal = calloc(n, sizeof *body->site_normal);
    body->between = calloc(n * n, sizeof *body->between);
    for (size_t s = 0; s < n; s++) {
        struct mesh_place place;
        const double p[3] = {0.5 * LENGTH, 1.5e-3 * ((double)(s % SIDE) - 4.0),
                             1.5e-3 * ((double)(s / SIDE) - 4.0)};
        memcpy(body->site_point[s], p, sizeof p);
        body->site_normal[s][0] = 1.0;
        assert_int_equal(mesh_surface_find(body, p, 0.0, &place, 1), 1);
        body->site_face[s] = place.face;
    }
    for (size_t a = 0; a < n; a++)
        for (size_t b = 0; b < n; b++) {
            const double *p = body->site_point[a], *q = body->site_point[b];
            body->between[a * n + b] =
                (float)(smooth(p, q) + (a == b ? 0.0 : singular(body, p, q)));
        }
    return body;
}

static struct mesh_push push_at(const struct mesh_body *body, double y, double z)
{
    struct mesh_place place;
    struct mesh_push push = {.point = {0.5 * LENGTH, y, z}, .direction = {-1.0, 0.0, 0.0}};
    assert_int_equal(mesh_surface_find(body, push.point, 0.0, &place, 1), 1);
    push.face = place.face;
    return push;
}

static void comes_back_between_sites(void **state)
{
    (void)state;
    struct mesh_body *body = make_body();
    const double places[][2] = {{0.0, 0.0}, {0.7e-3, -1.1e-3}, {2.3e-3, 3.1e-3}, {-4.1e-3, 0.2e-3}};
    for (size_t i = 0; i < COUNT(places); i++)
        for (size_t j = 0; j < i; j++) {
            struct mesh_push a = push_at(body, places[i][0], places[i][1]);
            struct mesh_push b = push_at(body, places[j][0], places[j][1]);
            double exact = smooth(a.point, b.point) + singular(body, a.point, b.point);
            /* planes leave of x^2 what half a site's distance squared is: .05 (1.5/2/10)^2 and of
             * the mixed term less, over 1.5 mm, at both places */
            near(mesh_between(body, &a, &b), exact, 1e-10 * 4.0 * 0.05 * 0.15 * 0.15);
            /* as far as floats are */
            near_relative(mesh_between(body, &b, &a), mesh_between(body, &a, &b), 1e-12);
        }
    /* on sites: theirs, as floats hold it */
    struct mesh_push a = push_at(body, 1.5e-3, 0.0), b = push_at(body, -3e-3, 3e-3);
    near_relative(mesh_between(body, &a, &b),
                  smooth(a.point, b.point) + singular(body, a.point, b.point), 1e-4);
    mesh_body_free(body);
}

static void says_where_nothing_is_known(void **state)
{
    (void)state;
    struct mesh_body *body = make_body();
    struct mesh_push a = push_at(body, 0.0, 0.0), b = a;
    b.face = 0; /* on the side, which has no sites */
    assert_true(isnan(mesh_between(body, &a, &b)));
    free(body->between);
    body->between = NULL;
    assert_true(isnan(mesh_between(body, &a, &a)));
    mesh_body_free(body);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(comes_back_between_sites),
        cmocka_unit_test(says_where_nothing_is_known),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
