/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/fe/matched.c: the rod end's numbers, and whole bodies
 * meshed and loaded by Hertz's pressure on a small patch, which know nothing of the correction's
 * idea. */
#include <string.h>

#include "check.h"
#include "fe/matched.h"
#include "fe/mesh.h"
#include "fe/quad.h"
#include "numeric/band.h"

/* PHYSICS of the project: beta(0) = 0.6469, beta(0.3) = 0.5987 for an endless rod; what remains at
 * a finite length falls off like radius / length. */
static void rod_end_has_the_known_compliance(void **state)
{
    (void)state;
    static const double known[][2] = {{0.0, 0.6469}, {0.3, 0.5987}};
    for (size_t i = 0; i < 2; i++) {
        double beta[2];
        for (size_t k = 0; k < 2; k++) {
            double slenderness = k ? 1000.0 : 500.0;
            double compliance;
            assert_true(matched_cylinder(known[i][0], slenderness, &compliance));
            beta[k] = slenderness / (3.0 * M_PI) - compliance;
        }
        double endless = 2.0 * beta[1] - beta[0];
        if (!(fabs(endless - known[i][1]) < 1e-4))
            fail_msg("beta(%g) = %.6f is not %.4f", known[i][0], endless, known[i][1]);
    }
}

/* A body of radius 1, E = 1, under Hertz's pressure of total 1 on a patch around the origin,
 * balanced by uniform acceleration. */
struct body_case {
    struct mesh mesh;
    struct band matrix;
    double *load, *weight;
    double poisson, patch;
};

static void add_elements(struct body_case *c)
{
    struct material material = {"m", 1.0, c->poisson, 1.0, INFINITY, 0.0};
    struct plastic_law law = plastic_law_make(&material);
    double moduli[16];
    plastic_law_moduli(&law, moduli);
    for (size_t e = 0; e < c->mesh.elements; e++) {
        const uint32_t *nodes = c->mesh.quads[e];
        struct quad quad;
        double r[4], z[4], k[64] = {0.0};
        for (int i = 0; i < 4; i++) {
            r[i] = c->mesh.r[nodes[i]];
            z[i] = c->mesh.z[nodes[i]];
        }
        assert_true(quad_make(r, z, &quad));
        for (int p = 0; p < QUAD_POINTS; p++) {
            quad_add_stiffness(&quad, p, moduli, k);
            for (int i = 0; i < 4; i++)
                c->weight[nodes[i]] += 0.25 * quad.volume[p];
        }
        for (int i = 0; i < 8; i++)
            for (int j = 0; j < 8; j++) {
                size_t a = 2 * nodes[i / 2] + i % 2, b = 2 * nodes[j / 2] + j % 2;
                bool fixed = (i % 2 == 0 && r[i / 2] == 0.0) || (j % 2 == 0 && r[j / 2] == 0.0);
                if (a >= b && (a == b || !fixed))
                    *band_entry(&c->matrix, a, b) += k[8 * i + j];
            }
    }
}

/* shares of the pressure of 1 on the contact nodes, along the outward normal */
static void spread(const struct body_case *c, double (*normal)(double), double *shares)
{
    enum { PIECES = 50 };
    const struct mesh_nodes *contact = &c->mesh.contact;
    for (size_t i = 0; i + 1 < contact->count; i++) {
        uint32_t a = contact->index[i], b = contact->index[i + 1];
        for (int k = 0; k < PIECES; k++) {
            double part = (k + 0.5) / PIECES;
            double r = c->mesh.r[a] + part * (c->mesh.r[b] - c->mesh.r[a]);
            double inside = 1.0 - r * r / (c->patch * c->patch);
            if (inside <= 0.0)
                continue;
            double area = 2.0 * M_PI * r * (c->mesh.r[b] - c->mesh.r[a]) / PIECES / normal(r);
            double pressure = 1.5 / (M_PI * c->patch * c->patch) * sqrt(inside);
            shares[i] += pressure * area * (1.0 - part);
            shares[i + 1] += pressure * area * part;
        }
    }
    double sum = 0.0;
    for (size_t i = 0; i < contact->count; i++)
        sum += shares[i];
    for (size_t i = 0; i < contact->count; i++)
        shares[i] /= sum;
}

static double flat(double r)
{
    (void)r;
    return 1.0;
}

static double round_off(double r)
{
    return sqrt(1.0 - r * r);
}

/* Compliance under the pressure, averaged with it, above the half-space's 0.6 (1 - nu^2) / patch
 * (u = pi p0 (2 a^2 - r^2) / (4 a E*), Johnson section 3.4). */
static double above_half_space(struct body_case *c, double (*normal)(double))
{
    size_t n = 2 * c->mesh.nodes, width = 0;
    for (size_t e = 0; e < c->mesh.elements; e++)
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                if (c->mesh.quads[e][i] > c->mesh.quads[e][j] + width)
                    width = c->mesh.quads[e][i] - c->mesh.quads[e][j];
    width = 2 * width + 1;
    c->matrix = (struct band){n, width, calloc(n * (width + 1), sizeof(double))};
    c->load = calloc(n, sizeof(double));
    c->weight = calloc(c->mesh.nodes, sizeof(double));
    double *shares = calloc(c->mesh.contact.count, sizeof(double));
    add_elements(c);
    spread(c, normal, shares);
    double force = 0.0, volume = 0.0, mean = 0.0, under = 0.0;
    for (size_t i = 0; i < c->mesh.contact.count; i++) {
        uint32_t node = c->mesh.contact.index[i];
        double cosine = shares[i] > 0.0 ? normal(c->mesh.r[node]) : 1.0;
        c->load[2 * node] -= node ? shares[i] * sqrt(1.0 - cosine * cosine) : 0.0;
        c->load[2 * node + 1] -= shares[i] * cosine;
        force += shares[i] * cosine;
    }
    for (size_t i = 0; i < c->mesh.nodes; i++)
        volume += c->weight[i];
    for (size_t i = 0; i < c->mesh.nodes; i++)
        c->load[2 * i + 1] += force * c->weight[i] / volume;
    /* the loads balance: hold the last node of the axis by any spring */
    uint32_t last = c->mesh.axis.index[c->mesh.axis.count - 1];
    *band_entry(&c->matrix, 2 * last + 1, 2 * last + 1) += 1.0;
    assert_true(band_factor(&c->matrix));
    band_forward(&c->matrix, 0, n, c->load);
    band_backward(&c->matrix, 0, n, c->load);
    for (size_t i = 0; i < c->mesh.nodes; i++)
        mean += c->weight[i] / volume * c->load[2 * i + 1];
    for (size_t i = 0; i < c->mesh.contact.count; i++) {
        uint32_t node = c->mesh.contact.index[i];
        double cosine = shares[i] > 0.0 ? normal(c->mesh.r[node]) : 1.0;
        under -= shares[i] * (cosine * (c->load[2 * node + 1] - mean) +
                              sqrt(1.0 - cosine * cosine) * c->load[2 * node]);
    }
    free(c->matrix.values);
    free(c->load);
    free(c->weight);
    free(shares);
    mesh_free(&c->mesh);
    return under - 0.6 * (1.0 - c->poisson * c->poisson) / c->patch;
}

/* 30 elements in the patch: the half-space's share, 12 or more, is held to 1e-3 of itself */
static const struct mesh_grade fine = {
    .size = 0.05 / 30.0, .core = 36, .growth = 1.04, .matched = 0.06, .coarse = 0.1};

static void agrees_with_a_whole_rod(void **state)
{
    (void)state;
    static const double cases[][2] = {{0.3, 20.0}, {0.0, 20.0}, {0.33, 2.0}};
    for (size_t i = 0; i < 3; i++) {
        struct body_case c = {.poisson = cases[i][0], .patch = 0.05};
        assert_int_equal(mesh_cylinder(1.0, cases[i][1], &fine, &c.mesh, NULL), PERCUSS_OK);
        double compliance;
        assert_true(matched_cylinder(cases[i][0], cases[i][1], &compliance));
        near(above_half_space(&c, flat), compliance, 0.015);
    }
}

static void agrees_with_a_whole_sphere(void **state)
{
    (void)state;
    for (double poisson = 0.0; poisson < 0.4; poisson += 0.3) {
        struct body_case c = {.poisson = poisson, .patch = 0.05};
        assert_int_equal(mesh_sphere(1.0, &fine, &c.mesh, NULL), PERCUSS_OK);
        near(above_half_space(&c, round_off), matched_sphere(poisson, 0.05), 0.015);
    }
}

static void knows_its_shapes(void **state)
{
    (void)state;
    double compliance;
    struct body body = {.kind = &rod_kind,
                        .material = {"al", 70e9, 0.33, 2700.0, INFINITY, 0.0},
                        .radius = 0.010,
                        .length = 1.0,
                        .tip_radius = INFINITY};
    assert_true(matched_compliance(&body, 3e-4, &compliance));
    near(compliance * 70e9 * 0.010, -0.5876, 2e-3);
    body.tip_radius = 0.02;
    assert_true(matched_compliance(&body, 3e-4, &compliance) && isnan(compliance));
    body.kind = &sphere_kind;
    assert_true(matched_compliance(&body, 3e-4, &compliance));
    near(compliance * 70e9 * 0.010, matched_sphere(0.33, 0.03), 1e-12);
    body.kind = &cylinder_kind;
    assert_true(matched_compliance(&body, 3e-4, &compliance));
    body.kind = &half_space_kind;
    assert_true(matched_compliance(&body, 3e-4, &compliance) && compliance == 0.0);
    body.kind = &beam_kind;
    assert_true(matched_compliance(&body, 3e-4, &compliance) && isnan(compliance));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rod_end_has_the_known_compliance),
        cmocka_unit_test(agrees_with_a_whole_rod),
        cmocka_unit_test(agrees_with_a_whole_sphere),
        cmocka_unit_test(knows_its_shapes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
