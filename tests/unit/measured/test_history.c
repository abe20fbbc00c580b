/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/measured/history.c, history_align.c, impact.c and table.c: sub-impacts of known
 * start, length and jump are found again in noisy readings, and bad files are refused by line. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "impact.h"
#include "random.h"

enum { MOST = 20000 };

struct pulse {
    double start, length, jump;
};

/* Velocity share of a Hertz-like force sin^(3/2) over its length, by its own integral. */
static double share(double s)
{
    enum { PARTS = 200 };
    static double table[PARTS + 1];
    if (table[PARTS] == 0.0) {
        for (int i = 0; i < PARTS; i++) {
            double sum = 0.0;
            for (int k = 0; k < 20; k++)
                sum += pow(sin(M_PI * (i + (k + 0.5) / 20) / PARTS), 1.5);
            table[i + 1] = table[i] + sum;
        }
        for (int i = 0; i <= PARTS; i++)
            table[i] /= table[PARTS];
        table[PARTS] = 1.0;
    }
    if (s <= 0.0 || s >= 1.0)
        return s > 0.0;
    int i = (int)(s * PARTS);
    return table[i] + (s * PARTS - i) * (table[i + 1] - table[i]);
}

/* Readings of A at `rate` until 8 ms, with noise. */
static struct history make(const struct pulse *pulses, int count, double rate, double noise,
                           uint64_t seed)
{
    static double time[MOST], velocity[MOST];
    struct random random = {seed};
    struct history history = {.time = time, .velocity_a = velocity};
    for (double t = -1e-3; t < 8e-3 && history.count < MOST; t += 1.0 / rate) {
        double v = -0.3;
        for (int k = 0; k < count; k++)
            v += pulses[k].jump * share((t - pulses[k].start) / pulses[k].length);
        time[history.count] = t;
        velocity[history.count++] = v + noise * random_normal(&random);
    }
    return history;
}

static const struct pulse pulses[] = {
    {0.0, 180e-6, 0.25}, {3.99e-3, 80e-6, 0.02}, {5.29e-3, 190e-6, 0.17}};

static void finds_sub_impacts(void **state)
{
    (void)state;
    static const double noises[] = {0.0, 1e-4, 5e-4, 2e-3};
    static const double rates[] = {1e6, 250e3};
    for (int r = 0; r < 2; r++) {
        for (int n = 0; n < 4; n++) {
            struct history history = make(pulses, 3, rates[r], noises[n], 7);
            struct history_impacts found;
            struct measured_fault fault;
            if (!history_find(&history, &found, &fault))
                fail_msg("%s", fault.text);
            assert_int_equal(found.count, 3);
            /* a mean over hundreds of readings */
            measured("before", found.before, -0.3, 1e-6 + 0.2 * noises[n]);
            measured("noise", found.noise, noises[n], 1e-6 + 0.1 * noises[n]);
            for (int k = 0; k < 3; k++) {
                /* the extrapolation misses some per cent of the length, the noise more */
                double slack = (0.05 + 1.5 * noises[n] / pulses[k].jump) * pulses[k].length;
                measured("jump", found.list[k].jump, pulses[k].jump, 2e-6 + 0.5 * noises[n]);
                measured("start", found.list[k].start, pulses[k].start, slack + 1.0 / rates[r]);
                measured("end", found.list[k].end, pulses[k].start + pulses[k].length,
                         slack + 1.0 / rates[r]);
            }
            struct measured_impact impact = measured_impact_from(&found);
            measured("second", impact.second_start, 3.99e-3, 20e-6);
            measured("momentum", impact.momentum, 0.44, 1e-5 + noises[n]);
            measured_complete(&impact, 0.11, 10.0);
            measured("impulse", impact.impulse, 0.11 * 0.44, 0.11 * (1e-5 + noises[n]));
            measured("restitution", impact.restitution, 0.11 * 0.44 * 10.0 / 0.3 - 1.0,
                     1e-4 + 10.0 * noises[n]);
        }
    }
}

/* Turned round and late by a second, on a moving body B: from the touch on all is as it was. */
static void lays_the_first_touch_on_zero(void **state)
{
    (void)state;
    struct history history = make(pulses, 3, 1e6, 0.0, 7);
    static double moving[MOST];
    struct history_impacts found;
    struct history_motion motion;
    struct measured_fault fault;
    for (size_t i = 0; i < history.count; i++) {
        history.time[i] += 1.0;
        moving[i] = 0.1;
        history.velocity_a[i] = 0.1 - history.velocity_a[i];
    }
    history.velocity_b = moving;
    assert_true(history_find(&history, &found, &fault));
    assert_true(history_align(&history, &found, &motion));
    assert_int_equal(motion.count, history.count);
    /* the start is known to 5 % of the first contact's 180 us, and a reading's microsecond */
    measured("time", motion.time[0], -1e-3, 1e-5);
    measured("approach", motion.velocity[0][0] - motion.velocity[1][0], -0.3, 1e-12);
    /* before the touch it came with -0.4 m/s, B with -0.1 */
    measured("A's way", motion.displacement[0][0], 0.4e-3, 0.4 * 1e-5);
    measured("B's way", motion.displacement[1][history.count - 1],
             -0.1 * motion.time[history.count - 1], 1e-9);
    history_motion_free(&motion);
    assert_null(motion.time);
}

/* Grazes below the noise are not found, and none is invented; 60 seeds. */
static void invents_nothing(void **state)
{
    (void)state;
    static const struct pulse with_graze[] = {{0.0, 180e-6, 0.25}, {2e-3, 50e-6, 1e-5}};
    for (uint64_t seed = 1; seed <= 60; seed++) {
        struct history history = make(with_graze, 2, 500e3, 1e-3, seed);
        struct history_impacts found;
        struct measured_fault fault;
        assert_true(history_find(&history, &found, &fault));
        assert_int_equal(found.count, 1);
    }
    struct history silent = make(with_graze, 0, 500e3, 1e-3, 5);
    struct history_impacts found;
    struct measured_fault fault;
    assert_false(history_find(&silent, &found, &fault));
    assert_non_null(strstr(fault.text, "no jump stands out of the noise"));
}

/* The other sense of direction, a moving body B, and displacement instead of velocity. */
static void takes_what_instruments_give(void **state)
{
    (void)state;
    struct history history = make(pulses, 3, 1e6, 1e-4, 3);
    struct history_impacts found, other;
    struct measured_fault fault;
    assert_true(history_find(&history, &found, &fault));
    static double b[MOST];
    for (size_t i = 0; i < history.count; i++) {
        history.velocity_a[i] = -history.velocity_a[i];
        b[i] = -0.05; /* A moves at +0.3 now and B comes towards it */
    }
    history.velocity_b = b;
    assert_true(history_find(&history, &other, &fault));
    assert_int_equal(other.count, found.count);
    measured("before", other.before, found.before - 0.05, 1e-12);
    measured("jump", other.list[2].jump, found.list[2].jump, 1e-12);
}

static char folder[] = "/tmp/percuss-measured-XXXXXX";

static const char *write_file(const char *name, const char *text)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    return path;
}

static void refuse(const char *text, const char *message)
{
    struct measured_set set;
    struct measured_fault fault;
    if (measured_read(write_file("bad.csv", text), &set, &fault))
        fail_msg("accepted: %s", text);
    if (!strstr(fault.text, message))
        fail_msg("'%s' does not say '%s'", fault.text, message);
}

static void reads_tables(void **state)
{
    (void)state;
    struct measured_set set;
    struct measured_fault fault;
    /* displacement readings in a file beside the table */
    struct history history = make(pulses, 3, 500e3, 1e-6, 9);
    char path[128];
    snprintf(path, sizeof path, "%s/one.csv", folder);
    FILE *file = fopen(path, "w");
    fputs("time, displacement_a, comment\n", file);
    double x = 0.0;
    for (size_t i = 0; i < history.count; i++) {
        fprintf(file, "%.9g,%.12g,x\n", history.time[i], x);
        x += history.velocity_a[i] * 2e-6;
    }
    fclose(file);
    bool read =
        measured_read(write_file("good.csv", "# from the rig\nspeed,restitution, sub_impacts"
                                             ",history\n0.2,0.7,1,\r\n\n0.25,nan,,one.csv\n"),
                      &set, &fault);
    if (!read)
        fail_msg("%s", fault.text);
    assert_int_equal(set.count, 2);
    assert_true(set.impacts[0].speed == 0.2 && set.impacts[0].restitution == 0.7);
    assert_true(isnan(set.impacts[0].second_start));
    /* the row's speed stands, the rest is the history's */
    assert_true(set.impacts[1].speed == 0.25);
    assert_true(set.impacts[1].sub_impacts == 3.0);
    measured("momentum", set.impacts[1].momentum, 0.44, 1e-4);
    measured_complete(&set.impacts[0], 0.11, 10.0);
    measured("impulse", set.impacts[0].impulse, 1.7 * 0.2 / 10.0, 1e-15);
    measured("first impulse", set.impacts[0].first_impulse, 1.7 * 0.2 / 10.0, 1e-15);
    measured_set_free(&set);
}

static void refuses_bad_tables(void **state)
{
    (void)state;
    refuse("", "empty");
    refuse("speed,colour\n1,2\n", "column 'colour': unknown; allowed are speed,");
    refuse("speed,\x1b[2J\n1,2\n", "column '?[2J': unknown");
    refuse("speed,restitution\n", "no impacts");
    refuse("speed,restitution\n0.1,0.5\n0.1\n", "bad.csv:3: 1 values: must be 2");
    refuse("speed,restitution\n0.1,half\n", "bad.csv:2: restitution: 'half': must be a finite");
    refuse("speed,restitution\n-0.1,0.5\n", "bad.csv:2: speed: -0.1: must be m/s > 0");
    refuse("restitution\n0.5\n", "bad.csv:2: speed: unknown");
    refuse("speed\n0.5\n", "bad.csv:2: restitution: unknown");
    refuse("speed,history\n0.5,nowhere.csv\n", "nowhere.csv: No such file");
    write_file("short.csv", "time,velocity_a\n0,1\n1,1\n");
    refuse("history\nshort.csv\n", "short.csv: 2 readings: must be at least 32");
    write_file("blind.csv", "time,speed\n");
    refuse("history\nblind.csv\n", "readings");
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : 1;
}

static int remove_folder(void **state)
{
    (void)state;
    static const char *const names[] = {"bad.csv", "good.csv", "one.csv", "short.csv", "blind.csv"};
    char path[128];
    for (size_t i = 0; i < 5; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lays_the_first_touch_on_zero),
        cmocka_unit_test(finds_sub_impacts),
        cmocka_unit_test(invents_nothing),
        cmocka_unit_test(takes_what_instruments_give),
        cmocka_unit_test(reads_tables),
        cmocka_unit_test(refuses_bad_tables),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
