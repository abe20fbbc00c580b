/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "jumps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "distance.h"

/* Readings that a flight needs for a mean. */
enum { LEAST_FLIGHT = 3 };

double jumps_time(const struct search *search, size_t i)
{
    return search->history->time[i] - search->history->time[0];
}

struct range jumps_flight(const struct search *search, const struct range *ranges, size_t count,
                          size_t k)
{
    return (struct range){k ? ranges[k - 1].end : 0, k < count ? ranges[k].first : search->count};
}

double jumps_mean(const struct search *search, size_t first, size_t end)
{
    return (search->sum[end] - search->sum[first]) / (double)(end - first);
}

/* Standard deviation of a reading: second differences hardly see the motion, and their median not
 * the contacts. Their variance is six times that of independent readings. */
static bool find_noise(struct search *search)
{
    double *bend = calloc(search->count, sizeof *bend);
    if (!bend)
        return false;
    for (size_t i = 1; i + 1 < search->count; i++)
        bend[i - 1] = fabs(search->v[i + 1] - 2.0 * search->v[i] + search->v[i - 1]);
    search->noise = 1.4826 * sample_median(bend, search->count - 2) / sqrt(6.0);
    free(bend);
    return true;
}

/* Mean of the readings after i less that of those before. */
static double step_at(const struct search *search, size_t i, size_t window)
{
    size_t first = i > window ? i - window : 0;
    size_t end = i + 1 + window < search->count ? i + 1 + window : search->count;
    if (i == first || i + 1 >= end)
        return 0.0;
    return jumps_mean(search, i + 1, end) - jumps_mean(search, first, i);
}

double jumps_largest(const struct search *search, size_t window)
{
    double largest = 0.0;
    for (size_t i = window; i + window < search->count; i++)
        largest = fmax(largest, fabs(step_at(search, i, window)));
    return largest;
}

/* A window about half as long as the strongest contact: the change seen through a short one is a
 * share of the whole jump, through one as long as the contact some 80 % of it. */
static void choose_window(struct search *search)
{
    size_t longest = search->count / 8;
    double whole = jumps_largest(search, longest);
    size_t window = 1;
    while (window < longest && jumps_largest(search, window) < 0.5 * whole)
        window += 1 + window / 4;
    search->window = window > 2 ? window / 2 : 1;
}

/* Lists ranges in which the velocity changes; near ones are one. Returns how many. */
static size_t find_ranges(const struct search *search, struct range *ranges, size_t room)
{
    size_t w = search->window, count = 0, last = 0;
    double floor_noise = JUMPS_SIGNIFICANT * search->noise * sqrt(2.0 / (double)w);
    double threshold = fmax(floor_noise, JUMPS_LEAST_SHARE * jumps_largest(search, w));
    for (size_t i = w; i + w < search->count; i++) {
        if (fabs(step_at(search, i, w)) <= threshold)
            continue;
        if (count > 0 && i <= last + w)
            ranges[count - 1].end = i + 1;
        else if (count < room)
            ranges[count++] = (struct range){i, i + 1};
        else
            break;
        last = i;
    }
    return count;
}

/* Drops ranges with a jump that does not stand out of the means on both sides; the flights between
 * the others are left in ranges. Returns how many ranges stay. */
static size_t keep_significant(const struct search *search, struct range *ranges, size_t count)
{
    for (size_t k = 0; k < count;) {
        /* from flight to flight, which must be long enough to have a mean */
        size_t before = k ? ranges[k - 1].end : 0;
        size_t after = k + 1 < count ? ranges[k + 1].first : search->count;
        double n1 = (double)(ranges[k].first - before), n2 = (double)(after - ranges[k].end);
        bool flights = n1 >= LEAST_FLIGHT && n2 >= LEAST_FLIGHT;
        double jump = flights ? jumps_mean(search, ranges[k].end, after) -
                                    jumps_mean(search, before, ranges[k].first)
                              : INFINITY;
        /* deviation of a difference of two means */
        double allowed = JUMPS_SIGNIFICANT * search->noise * sqrt(1.0 / n1 + 1.0 / n2);
        if (fabs(jump) > fmax(allowed, JUMPS_LEAST_SHARE * jumps_largest(search, search->window))) {
            k++;
            continue;
        }
        memmove(&ranges[k], &ranges[k + 1], (count - k - 1) * sizeof *ranges);
        --count;
    }
    return count;
}

/* When the smoothed velocity passes `level` of the way from `low` to `high` on the way out from the
 * middle of the range, in direction `way` (-1: towards its start). */
static double crossing(const struct search *search, struct range range, double low, double high,
                       double level, int way)
{
    const double *t = search->history->time;
    size_t m = search->window / 4;
    size_t i;
    double previous = 0.0;
    /* where half of the jump is made */
    for (i = range.first; i + 1 < range.end; i++)
        if ((jumps_mean(search, i - m, i + m + 1) - low) / (high - low) >= 0.5)
            break;
    previous = (jumps_mean(search, i - m, i + m + 1) - low) / (high - low);
    /* one reading later all of it is made: within that */
    if (way > 0 && previous > level && i > m) {
        double share = (jumps_mean(search, i - 1 - m, i + m) - low) / (high - low);
        return t[i - 1] + (level - share) / (previous - share) * (t[i] - t[i - 1]);
    }
    /* outwards from there, between two readings in proportion */
    while (i > m + 1 && i + m + 2 < search->count) {
        size_t next = way < 0 ? i - 1 : i + 1;
        double share = (jumps_mean(search, next - m, next + m + 1) - low) / (high - low);
        bool passed = way < 0 ? share < level : share > level;
        if (passed) {
            double part = (level - previous) / (share - previous);
            return t[i] + part * (t[next] - t[i]);
        }
        previous = share;
        i = next;
    }
    return t[i];
}

double jumps_edge(const struct search *search, struct range range, double low, double high, int way)
{
    /* the lower crossing must stand out of the smoothed noise */
    double smooth = search->noise / sqrt((double)(2 * (search->window / 4) + 1));
    bool quiet = smooth < 0.004 * fabs(high - low);
    double inner = quiet ? 0.10 : 0.25, outer = quiet ? 0.02 : 0.08;
    double near = crossing(search, range, low, high, way < 0 ? inner : 1.0 - inner, way);
    double far = crossing(search, range, low, high, way < 0 ? outer : 1.0 - outer, way);
    double ratio = pow(outer / inner, 0.4);
    return (far - ratio * near) / (1.0 - ratio);
}

void jumps_level(struct search *search, double acceleration)
{
    search->acceleration = acceleration;
    for (size_t i = 0; i < search->count; i++)
        search->v[i] = search->history->velocity_a[i] -
                       (acceleration != 0.0 ? acceleration * jumps_time(search, i) : 0.0);
    search->sum[0] = 0.0;
    for (size_t i = 0; i < search->count; i++)
        search->sum[i + 1] = search->sum[i] + search->v[i];
}

size_t jumps_find(struct search *search, struct range *ranges, struct measured_fault *fault)
{
    if (!find_noise(search)) {
        measured_fail(fault, "out of memory");
        return 0;
    }
    choose_window(search);
    /* changes of the velocity, if a flight comes before them */
    size_t count = find_ranges(search, ranges, HISTORY_SUB_IMPACTS);
    if (count > 0 && ranges[0].first < search->window + LEAST_FLIGHT) {
        measured_fail(fault, "time: begins %zu readings before the impact: more are needed",
                      ranges[0].first);
        return 0;
    }
    /* of these, jumps */
    count = keep_significant(search, ranges, count);
    if (count == 0)
        measured_fail(fault, "velocity_a: no jump stands out of the noise (%.2g m/s a reading)",
                      search->noise);
    return count;
}
