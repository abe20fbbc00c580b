/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/beam.c: frequencies and shapes against the digits
 * of others. */
#include "unit/model/beam_cases.h"

/* Roots x = sqrt(b) of cos x cosh x = 1, cos x cosh x = -1, tan x = tanh x and sin x = 0. */
static void test_textbook_roots_of_euler_bernoulli(void **state)
{
    (void)state;
    static const struct {
        enum support supports[2];
        double roots[3];
    } rows[] = {
        {{SUPPORT_FREE, SUPPORT_FREE}, {4.730040744862704, 7.853204624095838, 10.99560783800167}},
        {{SUPPORT_CLAMPED, SUPPORT_CLAMPED},
         {4.730040744862704, 7.853204624095838, 10.99560783800167}},
        {{SUPPORT_CLAMPED, SUPPORT_FREE},
         {1.875104068711961, 4.694091132974175, 7.854757438237613}},
        {{SUPPORT_CLAMPED, SUPPORT_PINNED},
         {3.926602312047919, 7.068582745628732, 10.21017612281303}},
        {{SUPPORT_PINNED, SUPPORT_FREE}, {3.926602312047919, 7.068582745628732, 10.21017612281303}},
        {{SUPPORT_PINNED, SUPPORT_PINNED}, {M_PI, 2.0 * M_PI, 3.0 * M_PI}},
    };

    for (size_t i = 0; i < COUNT(rows); i++) {
        for (int mirrored = 0; mirrored < 2; mirrored++) {
            struct beam_plane plane =
                supported(&slim, rows[i].supports[mirrored], rows[i].supports[!mirrored]);
            struct beam_mode modes[3];
            beam_modes(&plane, 3, modes);
            for (int k = 0; k < 3; k++)
                near(sqrt(modes[k].omega), rows[i].roots[k], 4e-15 * rows[i].roots[k]);
        }
    }
}

/* The paper's beam: 1 m, r 10 mm, 68.9 GPa, 0.33, 2710 kg/m^3, Cowper. */
static void test_symmetric_frequencies_of_the_papers_beam(void **state)
{
    (void)state;
    static const double hertz[] = {89.67617, 482.22915, 1180.58011, 2168.87533, 3427.14857};
    double area = M_PI * 1e-4, second_moment = M_PI / 4.0 * 1e-8;
    double shear = beam_shear_cowper_circle(0.33) * 68.9e9 / 2.66 * area;
    struct beam_plane plane = {1.0,           68.9e9 * second_moment, shear,
                               2710.0 * area, 2710.0 * second_moment, {0}};
    struct beam_mode modes[10];

    beam_modes(&plane, COUNT(modes), modes);
    for (size_t k = 0; k < COUNT(hertz); k++)
        near(modes[2 * k].omega / (2.0 * M_PI), hertz[k], 0.51e-5);
}

/* From mpmath with 60 digits: root of the determinant of the four end conditions on the four
 * exponentials, null vector by cofactors, norm by exact integrals of the exponentials, for the same
 * double-precision data. w and psi at s = -1/2, -3/16, 0, 1/2. Slender and stubby, below and above
 * the cut-off (b = 336, and 9.2). */
static const struct reference {
    const struct beam_plane *plane;
    enum support supports[2];
    size_t number;
    double b, w[4], psi[4];
} references[] = {
    {&slim,
     {SUPPORT_FREE, SUPPORT_FREE},
     1,
     22.373285448061324,
     {2.0, -0.6213328566901934, -1.215644458832525, 2.0},
     {-9.2945510137268907, -6.0275956252577883, 0.0, 9.2945510137268907}},
    {&slim,
     {SUPPORT_FREE, SUPPORT_FREE},
     200,
     396760.56432489249,
     {-2.0, 1.3533180011743527, 0.0, 2.0},
     {1259.7786540895071, 258.5850183764231, 890.79802910075243, 1259.7786540895071}},
    {&slim,
     {SUPPORT_FREE, SUPPORT_FREE},
     500,
     2472338.3698739846,
     {-2.0, 0.6666556584777465, 0.0, 2.0},
     {3144.734246243383, 1961.0956055552666, 2223.6629105482623, 3144.734246243383}},
    {&slim,
     {SUPPORT_CLAMPED, SUPPORT_FREE},
     7,
     416.99078605660549,
     {0.0, -0.89547396693220185, 7.3587973706001167e-5, 2.0},
     {0.0, 22.289015536198295, -28.878739062762534, 40.840704391502417}},
    {&slender,
     {SUPPORT_FREE, SUPPORT_FREE},
     1,
     22.358558376732086,
     {1.9990129645931296, -0.62108244687069205, -1.2152574325411358, 1.9990129645931296},
     {-9.2863861474112676, -6.0217304676407425, 0.0, 9.2863861474112676}},
    {&slender,
     {SUPPORT_FREE, SUPPORT_FREE},
     7,
     546.04680522792377,
     {1.9755275047053683, -0.40817853672126848, 1.4085667061994391, 1.9755275047053683},
     {-46.165850480185958, -30.994913917775061, 0.0, 46.165850480185958}},
    {&slender,
     {SUPPORT_FREE, SUPPORT_FREE},
     200,
     61980.110384174771,
     {0.40880899901525793, -0.96206202501632605, 1.2125243215766497, 0.40880899901525793},
     {-308.31898120343592, -208.40373130175927, 0.0, 308.31898120343592}},
    {&slender,
     {SUPPORT_CLAMPED, SUPPORT_FREE},
     120,
     41313.455925201064,
     {0.0, 0.91050664115760137, -1.0012679663663472, 0.67011425354613855},
     {0.0, -225.2341055451033, -94.997604917630372, 225.57597670288379}},
    {&stubby,
     {SUPPORT_FREE, SUPPORT_FREE},
     2,
     27.955271607549159,
     {-0.93582534868105536, 1.1028263895109264, 0.0, 0.93582534868105536},
     {8.3203822764466138, 3.0166119581862076, 0.25470249646346675, 8.3203822764466138}},
    {&stubby,
     {SUPPORT_FREE, SUPPORT_FREE},
     50,
     459.95521841268675,
     {1.4160172097757317, 1.4113705589981861, 1.4027385693948328, 1.4160172097757317},
     {-0.26997264815910286, -0.78399795315044163, 0.0, 0.26997264815910286}},
    {&stubby,
     {SUPPORT_FREE, SUPPORT_FREE},
     200,
     1835.2272012228416,
     {0.040578645610446519, 0.069121273168531241, 0.082437912315890373, 0.040578645610446519},
     {-11.305746242618381, 9.3974620293099562, 0.0, 11.305746242618381}},
    {&stubby,
     {SUPPORT_PINNED, SUPPORT_FREE},
     7,
     65.945643221098434,
     {0.0, -0.54507303755677235, 0.79519196696187661, 0.40835239033329864},
     {-6.963631281501363, 3.7206769170708672, 8.6934754948196372, -9.6082237726638391}},
    {&stubby,
     {SUPPORT_PINNED, SUPPORT_FREE},
     400,
     3663.8409502642862,
     {0.0, -1.4071245528758155, -0.99988935281578775, 1.4141832054902447},
     {0.20055642646428767, 0.029372506992383869, -0.17488849620996929, 0.10860268008957236}},
    {&stubby,
     {SUPPORT_CLAMPED, SUPPORT_PINNED},
     120,
     1094.2315669131751,
     {0.0, 0.32453718949238828, -0.0078258790987363553, 0.0},
     {0.0, 10.23441433759638, 7.5447137981110683, 10.664871790479128}},
    {&block,
     {SUPPORT_CLAMPED, SUPPORT_CLAMPED},
     7,
     35.501585443291959,
     {0.0, -1.3636912173195389, 1.3521783869675736, 0.0},
     {0.0, 0.87316298565742222, 0.0, 0.0}},
    {&block,
     {SUPPORT_CLAMPED, SUPPORT_CLAMPED},
     50,
     230.25487206712441,
     {0.0, -0.00084126705487407333, 0.0, 0.0},
     {0.0, 0.083427996967777633, 0.23307602238663544, 0.0}},
    {&block,
     {SUPPORT_CLAMPED, SUPPORT_CLAMPED},
     400,
     1834.7237268418482,
     {0.0, 0.02877822275547478, 0.027411708984325695, 0.0},
     {0.0, -5.2248983325330607, 0.0, 0.0}},
    {&block,
     {SUPPORT_FREE, SUPPORT_CLAMPED},
     7,
     31.715937971949442,
     {1.3911235339143154, -0.26515954331544271, 0.75532326330006521, 0.0},
     {-1.3624486314452521, 2.5195607497832991, -0.17274242014578508, 0.0}},
    {&block,
     {SUPPORT_FREE, SUPPORT_CLAMPED},
     50,
     226.65013495946345,
     {1.4144881762112531, 1.2460361736708942, 0.99734366749823234, 0.0},
     {-0.12044708587237296, -0.17405930846508133, 0.19468346674773506, 0.0}},
    {&block,
     {SUPPORT_FREE, SUPPORT_CLAMPED},
     400,
     1828.4409600259488,
     {-0.0064425338984080752, -0.0013838669558826255, 0.0019707110917077406, 0.0},
     {5.6566902621054365, -0.55449694058773924, -3.9999170672332551, 0.0}},
};

static void test_reference_digits(void **state)
{
    (void)state;
    static const double sites[4] = {-0.5, -0.1875, 0.0, 0.5};

    for (size_t i = 0; i < COUNT(references); i++) {
        const struct reference *expected = &references[i];
        struct beam_plane plane =
            supported(expected->plane, expected->supports[0], expected->supports[1]);
        struct beam_mode *modes = solve(&plane, expected->number);
        const struct beam_mode *mode = &modes[expected->number - 1];

        near(mode->omega, expected->b, 6e-16 * expected->b);
        for (int k = 0; k < 4; k++) {
            double w, psi;
            beam_mode_at(&plane, mode, sites[k], &w, &psi);
            near(w, expected->w[k], 1e-12);
            /* the phase's rounding comes with the slope's factor */
            near(psi, expected->psi[k], 1e-12 * mode->beta);
        }
        free(modes);
    }
}

/* Counts below b from a Rayleigh-Ritz solution with 140 Legendre polynomials each for w and psi
 * (numpy, scipy.linalg.eigh), which agreed with the first 100 frequencies to 1e-9. */
static void test_counts_of_a_spectral_discretisation(void **state)
{
    (void)state;
    static const double limits[4] = {50.0, 100.0, 200.0, 300.0};
    static const struct {
        const struct beam_plane *plane;
        enum support supports[2];
        int below[4];
    } rows[] = {
        {&stubby, {SUPPORT_FREE, SUPPORT_FREE}, {4, 10, 20, 31}},
        {&stubby, {SUPPORT_PINNED, SUPPORT_FREE}, {5, 10, 21, 32}},
        {&stubby, {SUPPORT_CLAMPED, SUPPORT_FREE}, {5, 11, 22, 33}},
        {&stubby, {SUPPORT_CLAMPED, SUPPORT_PINNED}, {4, 11, 21, 32}},
        {&stubby, {SUPPORT_CLAMPED, SUPPORT_CLAMPED}, {4, 10, 20, 31}},
        {&stubby, {SUPPORT_PINNED, SUPPORT_PINNED}, {5, 11, 22, 32}},
        {&block, {SUPPORT_FREE, SUPPORT_FREE}, {10, 20, 42, 64}},
        {&block, {SUPPORT_PINNED, SUPPORT_FREE}, {10, 21, 43, 65}},
        {&block, {SUPPORT_CLAMPED, SUPPORT_FREE}, {11, 22, 44, 66}},
        {&block, {SUPPORT_CLAMPED, SUPPORT_PINNED}, {10, 21, 43, 65}},
        {&block, {SUPPORT_CLAMPED, SUPPORT_CLAMPED}, {10, 20, 42, 64}},
        {&block, {SUPPORT_PINNED, SUPPORT_PINNED}, {11, 21, 43, 65}},
    };

    for (size_t i = 0; i < COUNT(rows); i++) {
        struct beam_plane plane =
            supported(rows[i].plane, rows[i].supports[0], rows[i].supports[1]);
        struct beam_mode *modes = solve(&plane, 100);
        for (int j = 0; j < 4; j++) {
            int below = 0;
            while (modes[below].omega < limits[j])
                below++;
            assert_int_equal(below, rows[i].below[j]);
        }
        free(modes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_textbook_roots_of_euler_bernoulli),
        cmocka_unit_test(test_symmetric_frequencies_of_the_papers_beam),
        cmocka_unit_test(test_reference_digits),
        cmocka_unit_test(test_counts_of_a_spectral_discretisation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
