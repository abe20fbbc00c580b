/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "flights.h"

#include <math.h>
#include <stdlib.h>

#include "distance.h"

/* Rounds in which flights and their acceleration are found from each other. */
enum { ROUNDS = 3 };
/* Acceleration counts from so many of its standard deviations on. */
static const double ACCELERATED = 4.0;

/* Least squares of values over time. */
static struct line line_of(const struct search *search, const double *y, struct range flight)
{
    double n = (double)(flight.end - flight.first);
    struct line line = {0};
    double squares = 0.0, products = 0.0;
    for (size_t i = flight.first; i < flight.end; i++) {
        line.middle += jumps_time(search, i) / n;
        line.at += y[i] / n;
    }
    for (size_t i = flight.first; i < flight.end; i++) {
        double t = jumps_time(search, i) - line.middle;
        squares += t * t;
        products += t * (y[i] - line.at);
    }
    line.rate = squares > 0.0 ? products / squares : 0.0;
    return line;
}

double line_at(const struct line *line, double t)
{
    return line->at + line->rate * (t - line->middle);
}

/* Sums of least squares for one acceleration a of all flights: of readings y = (line of the
 * flight's own) + a p(t), with p and y less their parts in such lines. */
struct normal {
    double pp, py, yy;
    double freedom;
};

static void add_flight(const struct search *search, const double *y, const double *p, bool sloped,
                       struct range flight, struct normal *normal)
{
    struct line of_y = line_of(search, y, flight);
    struct line of_p = line_of(search, p, flight);
    if (!sloped)
        of_y.rate = of_p.rate = 0.0;
    for (size_t i = flight.first; i < flight.end; i++) {
        double left_y = y[i] - line_at(&of_y, jumps_time(search, i));
        double left_p = p[i] - line_at(&of_p, jumps_time(search, i));
        normal->pp += left_p * left_p;
        normal->py += left_p * left_y;
        normal->yy += left_y * left_y;
    }
    normal->freedom += (double)(flight.end - flight.first) - (sloped ? 2.0 : 1.0);
}

/* The acceleration that all flights have in common and its standard deviation: of displacements
 * by parabolas, of velocities by lines. False: out of memory. */
static bool fit_acceleration(const struct search *search, const struct range *ranges, size_t count,
                             double *acceleration, double *deviation)
{
    const struct history *history = search->history;
    bool parabola = history->displacement_a;
    const double *y = parabola ? history->displacement_a : history->velocity_a;
    struct normal normal = {0};
    double *p = calloc(search->count, sizeof *p);
    if (!p)
        return false;
    for (size_t i = 0; i < search->count; i++) {
        double t = jumps_time(search, i);
        p[i] = parabola ? 0.5 * t * t : t;
    }
    for (size_t k = 0; k <= count; k++)
        add_flight(search, y, p, parabola, jumps_flight(search, ranges, count, k), &normal);
    free(p);
    *acceleration = normal.pp > 0.0 ? normal.py / normal.pp : 0.0;
    double left = fmax(0.0, normal.yy - *acceleration * normal.py);
    *deviation = sqrt(left / fmax(1.0, normal.freedom - 1.0) / normal.pp);
    return true;
}

/* Median of the slopes over a few readings: contacts are in few of them. */
static bool guess_acceleration(const struct search *search, double *acceleration)
{
    const struct history *history = search->history;
    size_t lag = search->count / 32 > 4 ? search->count / 32 : 4;
    double *slope = calloc(search->count, sizeof *slope);
    if (!slope)
        return false;
    for (size_t i = 0; i + lag < search->count; i++)
        slope[i] = (history->velocity_a[i + lag] - history->velocity_a[i]) /
                   (history->time[i + lag] - history->time[i]);
    *acceleration = sample_median(slope, search->count - lag);
    free(slope);
    return true;
}

/* Flights may fall by this share of another gravity than the stated one: it differs by half a per
 * cent from place to place. */
static const double GRAVITY_SHARE = 0.02;

bool flights_state_gravity(struct search *search, double *acceleration,
                           struct measured_fault *fault)
{
    const double stated = search->history->gravity, found = fabs(*acceleration);
    const double allowed = fmax(ACCELERATED * search->deviation, GRAVITY_SHARE * stated);
    if (found > 0.0 && fabs(found - stated) > allowed)
        return measured_fail(fault,
                             "%s: between contacts it changes its velocity by %.4g m/s^2, where "
                             "gravity is %.4g m/s^2: are its unit, --scale and --rate right?",
                             search->history->displacement_a ? "displacement" : "velocity", found,
                             stated);
    *acceleration = found > 0.0 ? copysign(stated, *acceleration) : 0.0;
    search->deviation = found > 0.0 ? 0.0 : search->deviation;
    return true;
}

bool flights_acceleration(struct search *search, double *acceleration)
{
    struct range ranges[HISTORY_SUB_IMPACTS];
    struct measured_fault fault;
    double deviation = INFINITY, longest = 0.0, jump = 0.0;
    if (!guess_acceleration(search, acceleration))
        return false;
    for (int round = 0; round < ROUNDS; round++) {
        jumps_level(search, *acceleration);
        size_t count = jumps_find(search, ranges, &fault);
        if (count == 0) {
            *acceleration = 0.0;
            return true;
        }
        if (!fit_acceleration(search, ranges, count, acceleration, &deviation))
            return false;
        for (size_t k = 0; k <= count; k++) {
            struct range flight = jumps_flight(search, ranges, count, k);
            longest = fmax(longest,
                           jumps_time(search, flight.end - 1) - jumps_time(search, flight.first));
        }
        jump = jumps_largest(search, search->window);
    }
    /* a change of velocity below a jump's least share is not told from its ends */
    double change = fabs(*acceleration) * 0.5 * longest;
    search->deviation = isfinite(deviation) ? deviation : 0.0;
    if (fabs(*acceleration) <= ACCELERATED * deviation || change <= JUMPS_LEAST_SHARE * jump)
        *acceleration = 0.0;
    return true;
}

/* Deviation of the rate by what the readings are off it. */
static void doubt_line(const struct search *search, const double *y, struct range flight,
                       struct line *line)
{
    double left = 0.0, squares = 0.0;
    const bool sloped = search->history->displacement_a;
    for (size_t i = flight.first; i < flight.end; i++) {
        double t = jumps_time(search, i) - line->middle;
        left += pow(y[i] - (sloped ? line_at(line, jumps_time(search, i)) : line->rate), 2.0);
        squares += t * t;
    }
    line->count = flight.end - flight.first;
    double n = (double)line->count;
    double variance = left / fmax(1.0, sloped ? n - 2.0 : n - 1.0);
    line->deviation = sqrt(variance / (sloped ? squares : n));
    line->at_deviation = sqrt(variance / n);
}

struct line flights_line(const struct search *search, double *levelled, struct range flight)
{
    const double *x = search->history->displacement_a;
    for (size_t i = flight.first; x && i < flight.end; i++) {
        double t = jumps_time(search, i);
        levelled[i] = x[i] - 0.5 * search->acceleration * t * t;
    }
    struct line line = line_of(search, x ? levelled : search->v, flight);
    if (!x)
        line.rate = jumps_mean(search, flight.first, flight.end);
    doubt_line(search, x ? levelled : search->v, flight, &line);
    return line;
}

/* What the trapezoids of an integral miss: those of twice the step miss four times as much. These
 * begin at one reading or the next; where the force sets in makes one of them better by chance. */
static double missed_by(const struct search *search, struct range range)
{
    const double *a = search->history->acceleration_a, *t = search->history->time;
    double missed = 0.0;
    for (size_t begin = range.first; begin <= range.first + 1; begin++) {
        double one = 0.0, two = 0.0;
        for (size_t i = begin; i + 2 <= range.end; i += 2) {
            one += 0.5 * ((a[i] + a[i + 1]) * (t[i + 1] - t[i]) +
                          (a[i + 1] + a[i + 2]) * (t[i + 2] - t[i + 1]));
            two += 0.5 * (a[i] + a[i + 2]) * (t[i + 2] - t[i]);
        }
        missed = fmax(missed, fabs(two - one) / 3.0);
    }
    return missed;
}

void flights_follow_integral(struct search *search, const struct range *ranges, size_t count,
                             struct line *lines)
{
    const double *a = search->history->acceleration_a;
    double sum = 0.0, squares = 0.0, readings = 0.0;
    for (size_t k = 0; k <= count; k++) {
        const struct range flight = jumps_flight(search, ranges, count, k);
        for (size_t i = flight.first; i < flight.end; i++) {
            sum += a[i];
            squares += a[i] * a[i];
        }
        readings += (double)(flight.end - flight.first);
    }
    const double mean = sum / readings, offset = mean - search->acceleration;
    const double noise = sqrt(fmax(0.0, squares - readings * mean * mean) / (readings - 1.0));
    const double step = noise * jumps_time(search, search->count - 1) / (double)(search->count - 1);
    search->deviation = noise / sqrt(readings);
    lines[0] = (struct line){.rate = search->v[ranges[0].first],
                             .middle = jumps_time(search, ranges[0].first),
                             .count = (size_t)readings};
    for (size_t k = 0; k < count; k++) {
        const struct range range = ranges[k];
        double length = jumps_time(search, range.end) - jumps_time(search, range.first);
        double added = search->v[range.end] - search->v[range.first] - offset * length;
        lines[k + 1] =
            (struct line){.rate = lines[k].rate + added,
                          .middle = jumps_time(search, range.end),
                          .deviation = hypot(hypot(lines[k].deviation, missed_by(search, range)),
                                             step * sqrt((double)(range.end - range.first))),
                          .count = (size_t)readings};
    }
}

double flights_misfit(const struct search *search, const struct range *ranges, size_t count)
{
    double squares = 0.0, readings = 0.0;
    for (size_t k = 0; k <= count; k++) {
        struct range flight = jumps_flight(search, ranges, count, k);
        double mean = jumps_mean(search, flight.first, flight.end);
        for (size_t i = flight.first; i < flight.end; i++)
            squares += (search->v[i] - mean) * (search->v[i] - mean);
        readings += (double)(flight.end - flight.first);
    }
    return sqrt(squares / readings);
}
