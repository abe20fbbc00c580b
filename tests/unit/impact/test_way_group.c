/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/way_step.c for several contacts: rigid bodies, modes and springs of
 * Hunt and Crossley's law beside elastic ones, against Runge and Kutta's steps and CVODE; symmetry
 * and energy. */
#include "unit/impact/runge_kutta.h"
#include "unit/impact/toy_scene.h"

/* ---- The same scenes by Runge and Kutta's steps ---- */

enum { MOST = 4 };

/* A power law with dissipation of each contact; 0: elastic. */
struct spring {
    double stiffness, exponent, dissipation;
};

/* y: gaps, their rates, q and v of the modes, the loss. */
struct pushed {
    const struct toy *toy;
    struct spring spring[MOST];
    size_t contacts, modes;
    const double *omega, *phi; /* [contact][mode] */
    double damping;
};

static void rates_of(double time, const double *y, double *rate, void *context)
{
    const struct pushed *of = context;
    size_t n = of->contacts, m = of->modes;
    double force[MOST];
    const double *q = y + 2 * n, *v = q + m;
    (void)time;
    rate[2 * (n + m)] = 0.0;
    for (size_t c = 0; c < n; c++) {
        double d = -y[c], speed = -y[n + c];
        for (size_t k = 0; k < m; k++) {
            d -= of->phi[c * m + k] * q[k];
            speed -= of->phi[c * m + k] * v[k];
        }
        const struct spring *spring = &of->spring[c];
        double elastic = d > 0.0 ? spring->stiffness * pow(d, spring->exponent) : 0.0;
        force[c] = fmax(0.0, elastic * (1.0 + spring->dissipation * speed));
        rate[2 * (n + m)] += (force[c] - elastic) * speed;
    }
    for (size_t a = 0; a < n; a++) {
        rate[a] = y[n + a];
        rate[n + a] = of->toy->gap_acceleration[a];
        for (size_t b = 0; b < n; b++)
            rate[n + a] += of->toy->w[a * n + b] * force[b];
    }
    for (size_t k = 0; k < m; k++) {
        double push = 0.0, omega = of->omega[k];
        for (size_t c = 0; c < n; c++)
            push += of->phi[c * m + k] * force[c];
        rate[2 * n + k] = v[k];
        rate[2 * n + m + k] = push - omega * (2.0 * of->damping * v[k] + omega * q[k]);
    }
}

/* The scene at an instant; the loss of all springs. */
static double follow(struct pushed *of, double until, double *y)
{
    size_t n = of->contacts;
    const struct runge_kutta steps = {
        .size = 2 * (n + of->modes) + 1, .rates = rates_of, .context = of, .tolerance = 1e-13};
    memset(y, 0, steps.size * sizeof *y);
    memcpy(y, of->toy->gap, n * sizeof *y);
    memcpy(y + n, of->toy->gap_rate, n * sizeof *y);
    runge_kutta_run(&steps, 0.0, until, y);
    return y[steps.size - 1];
}

static void set_laws(struct toy *toy, const struct pushed *of)
{
    for (size_t c = 0; c < of->contacts; c++) {
        const struct spring *spring = &of->spring[c];
        toy->laws[c] =
            spring->dissipation > 0.0
                ? contact_law_dissipative(spring->stiffness, spring->exponent, spring->dissipation)
                : contact_law_power(spring->stiffness, spring->exponent, 0.0);
    }
}

/* A row of balls: contact c is between balls c and c + 1. */
static void row_of_balls(struct toy *toy, const double *mass)
{
    size_t n = toy->scene.contacts;
    for (size_t c = 0; c < n; c++) {
        toy->w[c * n + c] = 1.0 / mass[c] + 1.0 / mass[c + 1];
        if (c > 0)
            toy->w[c * n + c - 1] = toy->w[(c - 1) * n + c] = -1.0 / mass[c];
    }
}

/* Uniform in 0..1, always the same ones. */
static double draw(void)
{
    static unsigned long long at = 4711;
    at = at * 6364136223846793005ull + 1442695040888963407ull;
    return (double)(at >> 11) * 0x1p-53;
}

/* Against Runge and Kutta at the end of the window. `fine`: of the rates at an accuracy of 1e-9,
 * `rough` at 1e-4. */
static void compare(struct toy *toy, struct pushed *of, double fine, double rough)
{
    double y[RUNGE_KUTTA_MOST];
    static const double accuracies[] = {1e-9, 1e-4};
    of->toy = toy;
    of->contacts = toy->scene.contacts;
    set_laws(toy, of);
    for (int i = 0; i < 2; i++) {
        const struct impact_outcome outcome = toy_run(toy, accuracies[i], 200.0);
        double off = i == 0 ? fine : rough;
        double lost = follow(of, outcome.window, y);
        assert_true(outcome.end_reason != PERCUSS_END_LIMIT);
        for (size_t c = 0; c < of->contacts; c++)
            print_message("rate %.9g %.9g blows %zu end %d window %g\n", outcome.motion.gap_rate[c],
                          y[of->contacts + c], outcome.tracks[c].count, outcome.end_reason,
                          outcome.window),
                is_near("rate", outcome.motion.gap_rate[c], y[of->contacts + c], off);
        measured("lost", outcome.relaxed, lost, off);
        measured("closure", outcome.energy.closure / outcome.energy.available, 0.0, off);
        print_message("%lu steps, %lu rejected\n", outcome.steps, outcome.rejected);
    }
}

/* Three and four balls, the first of which hits; light ones in the middle close their contacts
 * again and again. */
static void rows_of_balls(void **state)
{
    (void)state;
    for (int i = 0; i < 8; i++) {
        size_t n = 2 + (size_t)(i % 2);
        double mass[MOST + 1];
        struct toy toy;
        struct pushed of = {.modes = 0};
        toy_init(&toy, n);
        for (size_t b = 0; b <= n; b++)
            mass[b] = 0.2 + 1.5 * draw();
        row_of_balls(&toy, mass);
        for (size_t c = 0; c < n; c++)
            of.spring[c] = (struct spring){0.5 + draw(), 1.5, i < 4 || c == 0 ? draw() : 0.0};
        toy.gap_rate[0] = -1.0;
        compare(&toy, &of, 1e-6, 1e-3);
        toy_free(&toy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_of_balls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
