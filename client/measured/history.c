/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "history.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "distance.h"

enum { LEAST_FLIGHT = 3 };
/* A jump counts from so many standard deviations on, and from this share of the largest. */
static const double SIGNIFICANT = 6.0, LEAST_SHARE = 2e-3;

void history_free(struct history *history)
{
    free(history->time);
    free(history->velocity_a);
    free(history->velocity_b);
    *history = (struct history){0};
}

/* A search under way. */
struct search {
    const struct history *history;
    const double *v;
    size_t count, window; /* readings on each side that are compared */
    double *sum;          /* [count + 1]: running sums of v */
    double noise;
};

static double mean_between(const struct search *search, size_t first, size_t end)
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
    return mean_between(search, i + 1, end) - mean_between(search, first, i);
}

static double largest_step(const struct search *search, size_t window)
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
    double whole = largest_step(search, longest);
    size_t window = 1;
    while (window < longest && largest_step(search, window) < 0.5 * whole)
        window += 1 + window / 4;
    search->window = window > 2 ? window / 2 : 1;
}

/* Readings that belong to a contact: [first, end). */
struct range {
    size_t first, end;
};

/* Lists ranges in which the velocity changes; near ones are one. Returns how many. */
static size_t find_ranges(const struct search *search, struct range *ranges, size_t room)
{
    size_t w = search->window, count = 0, last = 0;
    double floor_noise = SIGNIFICANT * search->noise * sqrt(2.0 / (double)w);
    double threshold = fmax(floor_noise, LEAST_SHARE * largest_step(search, w));
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

/* Drops ranges whose jump does not stand out of the means on both sides; the flights between the
 * others are left in ranges. Returns how many ranges stay. */
static size_t keep_significant(const struct search *search, struct range *ranges, size_t count)
{
    for (size_t k = 0; k < count;) {
        /* from flight to flight, which must be long enough to have a mean */
        size_t before = k ? ranges[k - 1].end : 0;
        size_t after = k + 1 < count ? ranges[k + 1].first : search->count;
        double n1 = (double)(ranges[k].first - before), n2 = (double)(after - ranges[k].end);
        bool flights = n1 >= LEAST_FLIGHT && n2 >= LEAST_FLIGHT;
        double jump = flights ? mean_between(search, ranges[k].end, after) -
                                    mean_between(search, before, ranges[k].first)
                              : INFINITY;
        /* deviation of a difference of two means */
        double allowed = SIGNIFICANT * search->noise * sqrt(1.0 / n1 + 1.0 / n2);
        if (fabs(jump) > fmax(allowed, LEAST_SHARE * largest_step(search, search->window))) {
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
    size_t i = range.first;
    double previous = 0.0;
    /* where half of the jump is made */
    for (i = range.first; i + 1 < range.end; i++)
        if ((mean_between(search, i - m, i + m + 1) - low) / (high - low) >= 0.5)
            break;
    previous = (mean_between(search, i - m, i + m + 1) - low) / (high - low);
    /* outwards from there, between two readings in proportion */
    while (i > m + 1 && i + m + 2 < search->count) {
        size_t next = way < 0 ? i - 1 : i + 1;
        double share = (mean_between(search, next - m, next + m + 1) - low) / (high - low);
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

/* Start or end of a contact: the change of velocity begins with the 5/2 power of time (the force
 * with the 3/2), so two crossings tell where it is zero. */
static double edge(const struct search *search, struct range range, double low, double high,
                   int way)
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

static bool measure(const struct search *search, const struct range *ranges, size_t count,
                    struct history_impacts *impacts, struct measured_fault *fault)
{
    double total = 0.0, before = mean_between(search, 0, ranges[0].first), low = before;
    impacts->count = count;
    impacts->noise = search->noise;
    for (size_t k = 0; k < count; k++) {
        size_t after = k + 1 < count ? ranges[k + 1].first : search->count;
        double high = mean_between(search, ranges[k].end, after);
        impacts->list[k] = (struct history_sub_impact){
            .start = edge(search, ranges[k], low, high, -1),
            .end = edge(search, ranges[k], low, high, 1),
            .jump = high - low,
        };
        total += high - low;
        low = high;
    }
    /* whichever way the instrument counts: the contact pushes A back */
    double sign = total < 0.0 ? -1.0 : 1.0;
    for (size_t k = 0; k < count; k++)
        impacts->list[k].jump *= sign;
    /* the approach, relative to B */
    if (search->history->velocity_b)
        before -= sample_mean(search->history->velocity_b, ranges[0].first);
    impacts->before = sign * before;
    if (!(impacts->before < 0.0))
        return measured_fail(fault, "velocity_a: %g m/s before the impact: it does not approach",
                             impacts->before);
    return true;
}

static bool find(struct search *search, struct history_impacts *impacts,
                 struct measured_fault *fault)
{
    struct range ranges[HISTORY_SUB_IMPACTS];
    for (size_t i = 0; i < search->count; i++)
        search->sum[i + 1] = search->sum[i] + search->v[i];
    if (!find_noise(search))
        return measured_fail(fault, "out of memory");
    choose_window(search);
    /* where the velocity changes, if what comes before is a flight */
    size_t count = find_ranges(search, ranges, HISTORY_SUB_IMPACTS);
    if (count > 0 && ranges[0].first < search->window + LEAST_FLIGHT)
        return measured_fail(fault, "time: begins %zu readings before the impact: more are needed",
                             ranges[0].first);
    /* of these, jumps */
    count = keep_significant(search, ranges, count);
    if (count == 0)
        return measured_fail(fault,
                             "velocity_a: no jump stands out of the noise (%.2g m/s a reading)",
                             search->noise);
    return measure(search, ranges, count, impacts, fault);
}

bool history_find(const struct history *history, struct history_impacts *impacts,
                  struct measured_fault *fault)
{
    struct search search = {history, history->velocity_a, history->count, 1, NULL, 0.0};
    if (history->count < HISTORY_LEAST_READINGS)
        return measured_fail(fault, "%zu readings: must be at least %d", history->count,
                             HISTORY_LEAST_READINGS);
    search.sum = calloc(history->count + 1, sizeof *search.sum);
    if (!search.sum)
        return measured_fail(fault, "out of memory");
    bool good = find(&search, impacts, fault);
    free(search.sum);
    return good;
}
