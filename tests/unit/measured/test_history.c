/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/measured/history.c: sub-impacts of known start,
 * length and jump are found again in noisy readings, and bad files are refused by line. */
#include "files.h"
#include "history_motion.h"
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
            assert_true(found.acceleration == 0.0);
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
            size_t next = 0;
            struct measured_impact impact = measured_impact_from(&found, &next);
            assert_int_equal(next, 3);
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

enum { BOUNCES = 6 };

/* A body that falls from rest at time 0 and bounces off the ground after `until`, again and again:
 * its place and velocity at t. */
static void fall(double until, double restitution, double t, double *place, double *velocity)
{
    static const double g = 9.81;
    double start = 0.0, up = 0.0, height = 0.5 * g * until * until;
    double flight = until;
    while (t - start > flight) {
        double speed = start == 0.0 ? g * until : up;
        start += flight;
        up = restitution * speed;
        height = 0.0;
        flight = 2.0 * up / g;
    }
    t -= start;
    *place = height + up * t - 0.5 * g * t * t;
    *velocity = up - g * t;
}

/* Readings from `first` to `last`; velocities, or displacements and their differences as
 * history_read makes them. */
static struct history make_falling_of(uint64_t seed, double until, double restitution,
                                      const double span[2], double rate, double noise,
                                      bool displacement)
{
    static double time[MOST], velocity[MOST], place[MOST];
    struct random random = {seed};
    struct history history = {.time = time, .velocity_a = velocity};
    for (double t = span[0]; t < span[1] && history.count < MOST; t += 1.0 / rate) {
        size_t i = history.count++;
        time[i] = 3.0 + t;
        fall(until, restitution, t, &place[i], &velocity[i]);
        place[i] += noise * random_normal(&random);
        velocity[i] += noise * random_normal(&random);
    }
    if (!displacement)
        return history;
    for (size_t i = 0; i < history.count; i++) {
        size_t a = i > 0 ? i - 1 : 0, b = i + 1 < history.count ? i + 1 : i;
        velocity[i] = (place[b] - place[a]) / (time[b] - time[a]);
    }
    history.displacement_a = place;
    history.from_displacement = true;
    return history;
}

static struct history make_falling(double until, double restitution, const double span[2],
                                   double rate, double noise, bool displacement)
{
    return make_falling_of(11, until, restitution, span, rate, noise, displacement);
}

/* A sphere on a wall: e = jump/speed - 1. */
static void check_bounce(const struct history_sub_impact *bounce, double speed, double restitution,
                         double slack)
{
    assert_true(bounce->begins);
    measured_relative("speed", -bounce->approach, speed, slack);
    measured("restitution", -bounce->jump / bounce->approach - 1.0, restitution, 2.0 * slack);
}

/* The speeds are those at the touch, whatever gravity makes of them before and after. */
static void falls_between_contacts(void **state)
{
    (void)state;
    struct history_impacts found;
    struct measured_fault fault;
    /* slowly, over a few milliseconds, with readings of 0.5 mm/s: two instants 0.1 ms apart */
    const double drop = 0.2 / 9.81, near_it[2] = {drop - 5.05e-3, drop + 19.8e-3};
    struct history slow = make_falling(drop, 0.8, near_it, 10e3, 5e-4, false);
    assert_true(history_find(&slow, &found, &fault));
    assert_int_equal(found.count, 1);
    measured_relative("gravity", found.acceleration, -9.81, 0.01);
    check_bounce(&found.list[0], 0.2, 0.8, 5e-3);
    /* upside down it is the same */
    for (size_t i = 0; i < slow.count; i++)
        slow.velocity_a[i] = -slow.velocity_a[i];
    assert_true(history_find(&slow, &found, &fault));
    measured_relative("gravity", found.acceleration, 9.81, 0.01);
    check_bounce(&found.list[0], 0.2, 0.8, 5e-3);
    /* displacements of 10 um, a hundred of them: parabolas that meet */
    const double long_drop = 2.0 / 9.81, span[2] = {long_drop - 0.0505, long_drop + 0.0495};
    struct history places = make_falling(long_drop, 0.8, span, 1e3, 1e-5, true);
    assert_true(history_find(&places, &found, &fault));
    assert_int_equal(found.count, 1);
    measured_relative("gravity", found.acceleration, -9.81, 0.01);
    check_bounce(&found.list[0], 2.0, 0.8, 1e-3);
}

static void bounces_are_impacts(void **state)
{
    (void)state;
    struct history_impacts found;
    struct measured_fault fault;
    const double drop = 2.0 / 9.81;
    double end = drop;
    for (int k = 1; k < BOUNCES; k++)
        end += 2.0 * 2.0 * pow(0.8, k) / 9.81;
    const double span[2] = {drop - 0.05, end + 0.05};
    for (int displacement = 0; displacement < 2; displacement++) {
        struct history history = make_falling(drop, 0.8, span, displacement ? 2e3 : 5e3,
                                              displacement ? 1e-5 : 1e-3, displacement);
        assert_true(history_find(&history, &found, &fault));
        assert_int_equal(found.count, BOUNCES);
        for (size_t k = 0, next = 0; k < BOUNCES; k++) {
            check_bounce(&found.list[k], 2.0 * pow(0.8, (double)k), 0.8, 2e-3);
            struct measured_impact impact = measured_impact_from(&found, &next);
            assert_int_equal(next, k + 1);
            assert_true(impact.sub_impacts == 1.0 && isnan(impact.second_start));
            assert_true(impact.speed == -found.list[k].approach);
        }
    }
}

/* An accelerometer: integrated readings of half a sine of force, with an offset. The speed before
 * is 2 m/s. */
static struct history make_shaken(uint64_t seed, double restitution)
{
    static double time[MOST], velocity[MOST], acceleration[MOST];
    struct random random = {seed};
    struct history history = {.time = time, .velocity_a = velocity, .acceleration_a = acceleration};
    /* the pulse begins anywhere between two readings */
    const double step = 1e-5, length = 3e-4, begin = step * random_uniform(&random);
    for (; history.count < 1200; history.count++) {
        size_t i = history.count;
        double t = (double)i * step - 5e-3 - begin;
        time[i] = (double)i * step;
        acceleration[i] = 3.0 + 20.0 * random_normal(&random);
        if (t > 0.0 && t < length)
            acceleration[i] +=
                2.0 * (1.0 + restitution) * M_PI / (2.0 * length) * sin(M_PI * t / length);
        velocity[i] =
            i ? velocity[i - 1] + 0.5 * step * (acceleration[i - 1] + acceleration[i]) : 0.0;
    }
    return history;
}

/* Of 200 histories of each instrument 95 % of the intervals hold the truth, but for chance (three
 * of its deviations are 9), and they are no wider than that takes: the errors' root mean square is
 * half of a half width for normal errors. An integral of kinked forces is judged by its worst
 * phase. */
static void intervals_hold_the_truth(void **state)
{
    (void)state;
    enum { TRIES = 200, INSTRUMENTS = 4 };
    static const double least_share[INSTRUMENTS] = {0.4, 0.4, 0.3, 0.2};
    const double e = 0.8, drop = 2.0 / 9.81;
    for (int instrument = 0; instrument < INSTRUMENTS; instrument++) {
        size_t held = 0;
        double squares = 0.0, widths = 0.0;
        for (uint64_t seed = 1; seed <= TRIES; seed++) {
            /* the touch is anywhere between two readings */
            const double rate = instrument == 0 ? 50e3 : 1e3, phase = (double)seed / TRIES / rate;
            const double span[2] = {drop - 0.05 + phase, drop + 0.05};
            const struct pulse pulse = {0.0, 180e-6, 0.3 * (1.0 + e)};
            struct history history =
                instrument == 0   ? make_falling_of(seed, drop, e, span, rate, 5e-3, false)
                : instrument == 1 ? make_falling_of(seed, drop, e, span, rate, 1e-4, true)
                : instrument == 2 ? make(&pulse, 1, 250e3, 2e-3, seed)
                                  : make_shaken(seed, e);
            struct history_impacts found;
            struct measured_fault fault;
            size_t next = 0;
            assert_true(history_find(&history, &found, &fault));
            struct measured_impact impact = measured_impact_from(&found, &next);
            if (instrument == 3)
                impact.speed = 2.0;
            measured_complete(&impact, 1.0, 1.0);
            double half = measured_half_width(&impact), error = impact.restitution - e;
            held += fabs(error) <= half;
            squares += error * error / TRIES;
            widths += half / TRIES;
        }
        print_message("instrument %d: %zu of %d held, half width %.2g, error %.2g\n", instrument,
                      held, TRIES, widths, sqrt(squares));
        assert_true(held >= 181);
        assert_true(sqrt(squares) > least_share[instrument] * widths);
    }
}

/* A body that is held until shortly before its fall moves by no one acceleration. */
static void refuses_other_motion(void **state)
{
    (void)state;
    struct history_impacts found;
    struct measured_fault fault;
    const double drop = 2.0 / 9.81, span[2] = {0.0, drop + 0.1};
    struct history history = make_falling(drop, 0.8, span, 5e3, 1e-3, false);
    assert_true(history_find(&history, &found, &fault));
    for (size_t i = 0; i < 300; i++)
        history.velocity_a[i] = history.velocity_a[300];
    assert_false(history_find(&history, &found, &fault));
    if (!strstr(fault.text, "velocity_a: between contacts it misses even motion and even "
                            "acceleration (-7.9") ||
        !strstr(fault.text, "must be at most 0.0"))
        fail_msg("%s", fault.text);
}

/* Displacement readings in millimetres and milliseconds, under names of their own; a reading is
 * missing. */
static void reads_files(void **state)
{
    (void)state;
    struct history history = make(pulses, 3, 500e3, 1e-6, 9), read;
    static struct measured_remarks remarks;
    struct column_map map = {0};
    struct measured_fault fault;
    char path[128];
    snprintf(path, sizeof path, "%s/one.csv", files_folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("time (ms);x;comment\n", file);
    double x = 0.0;
    for (size_t i = 0; i < history.count; i++) {
        if (i == 7)
            fprintf(file, "%.9g;;x\n", 1e3 * history.time[i]);
        else
            fprintf(file, "%.9g;%.12g;x\n", 1e3 * history.time[i], 1e3 * x);
        x += history.velocity_a[i] * 2e-6;
    }
    fclose(file);
    assert_true(column_map_add(&map, "displacement_a=x:mm", &fault));
    if (!history_read(path, &map, &read, &remarks))
        fail_msg("%s", remarks.error[0].text);
    assert_int_equal(read.count, history.count - 1);
    assert_true(read.from_displacement);
    near(read.time[100], history.time[101], 1e-12);
    near(read.velocity_a[100], -0.3, 1e-4);
    near(read.displacement_a[99] - read.displacement_a[100], 0.3 * 2e-6, 1e-9);
    assert_true(files_say(remarks.note, remarks.notes,
                          "rows left out: readings that are not there in line 9"));
    assert_true(files_say(remarks.note, remarks.notes, "columns that are not read: 'comment'"));
    history_free(&read);
}

static void refuse(const char *text, size_t errors, const char *words)
{
    static struct measured_remarks remarks;
    struct history history;
    remarks = (struct measured_remarks){0};
    if (history_read(files_text("bad.csv", text), NULL, &history, &remarks))
        fail_msg("accepted: %s", text);
    assert_int_equal(remarks.errors, errors);
    assert_true(files_say(remarks.error, remarks.errors, words));
}

static void refuses_bad_files(void **state)
{
    (void)state;
    char text[2000] = "time,velocity_a\n";
    refuse("speed,restitution\n1,2\n", 1,
           "bad.csv:1: column 'time': missing, and all that may be there (time, velocity_a");
    refuse(
        "time,velocity\n0,1\n", 1,
        "column 'velocity_a', 'displacement_a' or 'acceleration_a' (or one of b): missing; there "
        "are 'time', 'velocity'");
    refuse("velocity_a\n0\n", 1, "column 'time': missing");
    refuse("time,velocity_a\n0,1\n1,1\n", 1, "2 readings: must be at least 32");
    /* all that is wrong at once, by lines */
    for (int i = 0; i < 40; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "%d,%s\n", i == 9 ? 3 : i,
                 i == 20 ? "x" : "1");
    refuse(text, 2, "bad.csv:11: time: 3: must be later than the line before");
    refuse(text, 2, "bad.csv:22: velocity_a: 'x': must be a finite number");
    /* readings that are counted, with a line between them that is blank */
    static struct measured_remarks remarks;
    struct column_map counted = {.rate = 240.0};
    struct history history;
    strcpy(text, "velocity_a\n");
    for (int i = 0; i < 40; i++)
        strcat(text, i == 20 ? "\n1\n" : "1\n");
    assert_false(history_read(files_text("bad.csv", text), &counted, &history, &remarks));
    assert_true(files_say(remarks.error, remarks.errors,
                          "bad.csv:23: a line before has no reading: must be nan there"));
    /* more gaps than readings tell */
    strcpy(text, "time,velocity_a\n");
    for (int i = 0; i < 40; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "%d,%s\n", i, i % 8 ? "1" : "");
    refuse(text, 1,
           "5 of 40 rows: readings that are not there in lines 2, 10, 18, 26 and 34: must "
           "be at most a tenth");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lays_the_first_touch_on_zero),
        cmocka_unit_test(finds_sub_impacts),
        cmocka_unit_test(invents_nothing),
        cmocka_unit_test(takes_what_instruments_give),
        cmocka_unit_test(falls_between_contacts),
        cmocka_unit_test(bounces_are_impacts),
        cmocka_unit_test(intervals_hold_the_truth),
        cmocka_unit_test(refuses_other_motion),
        cmocka_unit_test(reads_files),
        cmocka_unit_test(refuses_bad_files),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
