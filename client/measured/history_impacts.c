/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "history_impacts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "distance.h"
#include "flights.h"

/* Flights miss their lines by no more than so many standard deviations of a reading, or this share
 * of the largest jump, which is some per cent of e. */
static const double MISFIT = 4.0, MISFIT_SHARE = 0.01;

/* Mean velocity of B in a flight; 0 where it was not measured. */
static double velocity_of_b(const struct search *search, struct range flight)
{
    const double *b = search->history->velocity_b;
    return b ? sample_mean(b + flight.first, flight.end - flight.first) : 0.0;
}

/* A contact shorter than so many readings is an instant: its edges are not resolved. */
static const double RESOLVED = 4.0;

/* When a contact begins, from the first reading on: where the displacements before and after it
 * meet, or its start, or its middle where its length is that of a few readings. */
static double touch_of(const struct search *search, struct range range, const struct line lines[2],
                       const struct history_sub_impact *contact)
{
    const struct line *a = &lines[0], *b = &lines[1];
    const double *time = search->history->time;
    double met = (line_at(a, 0.0) - line_at(b, 0.0)) / (b->rate - a->rate);
    bool within =
        met >= jumps_time(search, range.first - 1) && met <= jumps_time(search, range.end);
    if (search->history->displacement_a && within)
        return met;
    double reading = (time[range.end] - time[range.first]) / (double)(range.end - range.first);
    bool resolved = contact->end - contact->start > RESOLVED * reading;
    return (resolved ? contact->start : 0.5 * (contact->start + contact->end)) - time[0];
}

/* Half of the 95 % interval of (-v_after + v_before)/v_before as a share of it, of the impact from
 * contact `first` on to `last`. With v = rate + a (touch - middle) of both flights, e = -v_after /
 * v_before and independent errors of both rates, of a and of the touch,
 *   de^2 v_before^2 = dr_after^2 + e^2 dr_before^2 + ((t - m_after) + e (t - m_before))^2 da^2
 *                     + (1 + e)^2 a^2 dt^2. */
static double doubt_of(const struct search *search, const struct history_impacts *impacts,
                       const struct line *lines, size_t first, size_t last, double touch,
                       double late)
{
    const struct line *before = &lines[first], *after = &lines[last + 1];
    const double speed = fabs(impacts->list[first].approach), a = search->acceleration;
    double jump = 0.0;
    for (size_t k = first; k <= last; k++)
        jump += impacts->list[k].jump;
    const double freedom = fmax(1.0, fmin((double)before->count, (double)after->count) - 2.0);
    const double student = student_quantile(0.975, freedom);
    /* where no speed is known the jump's share alone */
    if (!(speed > 0.0))
        return student *
               hypot(hypot(before->deviation, after->deviation),
                     (after->middle - before->middle) * search->deviation) /
               fabs(jump);
    const double e = jump / speed - 1.0;
    const double parts[] = {
        after->deviation,
        e * before->deviation,
        ((touch - after->middle) + e * (touch - before->middle)) * search->deviation,
        (1.0 + e) * a * late,
    };
    double sum = 0.0;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        sum += parts[i] * parts[i];
    return student * sqrt(sum) / fabs(jump);
}

/* Standard deviation of a touch: where displacements meet by theirs there, otherwise by that of
 * any instant between two readings. */
static double late_of(const struct search *search, struct range range, const struct line lines[2],
                      double touch)
{
    const double *time = search->history->time;
    double reading = (time[range.end] - time[range.first]) / (double)(range.end - range.first);
    double late = reading / sqrt(12.0), off = 0.0;
    if (!search->history->displacement_a)
        return late;
    for (int i = 0; i < 2; i++)
        off = hypot(off,
                    hypot(lines[i].at_deviation, (touch - lines[i].middle) * lines[i].deviation));
    return fmin(late, off / fabs(lines[1].rate - lines[0].rate));
}

/* Of every impact that begins. */
static void take_doubts(const struct search *search, const struct range *ranges,
                        const struct line *lines, struct history_impacts *impacts)
{
    for (size_t k = 0; k < impacts->count; k++) {
        size_t last = k;
        while (last + 1 < impacts->count && !impacts->list[last + 1].begins)
            last++;
        const double touch = touch_of(search, ranges[k], &lines[k], &impacts->list[k]);
        const double late = late_of(search, ranges[k], &lines[k], touch);
        impacts->list[k].doubt =
            impacts->list[k].begins ? doubt_of(search, impacts, lines, k, last, touch, late) : NAN;
    }
}

/* The contacts one after another; `lines` has room for the flights. */
static void take_contacts(const struct search *search, const struct range *ranges, size_t count,
                          const struct line *lines, struct history_impacts *impacts)
{
    double total = 0.0, left_with = 0.0;
    for (size_t k = 0; k < count; k++)
        total += lines[k + 1].rate - lines[k].rate;
    /* whichever way the instrument counts: the contact pushes A back */
    double sign = impacts->direction = total < 0.0 ? -1.0 : 1.0;
    double first = search->history->time[0];
    for (size_t k = 0; k < count; k++) {
        struct history_sub_impact *contact = &impacts->list[k];
        double low = lines[k].rate, high = lines[k + 1].rate;
        double b = velocity_of_b(search, jumps_flight(search, ranges, count, k));
        contact->start = jumps_edge(search, ranges[k], low, high, -1);
        contact->end = jumps_edge(search, ranges[k], low, high, 1);
        contact->jump = sign * (high - low);
        double touch = touch_of(search, ranges[k], &lines[k], contact);
        contact->approach = sign * (low + search->acceleration * touch - b);
        /* neither is told by an integral, nor by the body that was at rest */
        if (search->history->acceleration_a || search->history->of_b)
            contact->approach = 0.0;
        /* gravity has turned A that had left */
        contact->begins = k == 0 || (contact->approach != 0.0 && search->acceleration != 0.0 &&
                                     left_with > 0.0 && contact->approach < 0.0);
        b = velocity_of_b(search, jumps_flight(search, ranges, count, k + 1));
        left_with = sign * (high + search->acceleration * (contact->end - first) - b);
    }
}

/* The lines of all flights, less contacts whose jump of slopes does not stand out of these: a
 * flight of a few displacements has hardly a slope, whatever its differences are. Returns how many
 * contacts stay. */
static size_t fit_flights(const struct search *search, struct range *ranges, size_t count,
                          double *levelled, struct line *lines)
{
    for (bool whole = false; !whole;) {
        whole = true;
        for (size_t k = 0; k <= count; k++)
            lines[k] = flights_line(search, levelled, jumps_flight(search, ranges, count, k));
        for (size_t k = 0; search->history->displacement_a && count > 1 && k < count; k++) {
            double jump = fabs(lines[k + 1].rate - lines[k].rate);
            if (jump > JUMPS_SIGNIFICANT * hypot(lines[k].deviation, lines[k + 1].deviation))
                continue;
            memmove(&ranges[k], &ranges[k + 1], (count - k - 1) * sizeof *ranges);
            count--;
            whole = false;
            break;
        }
    }
    return count;
}

static bool measure(struct search *search, struct range *ranges, size_t count,
                    struct history_impacts *impacts, struct measured_fault *fault)
{
    /* lines of one slope */
    double misfit = flights_misfit(search, ranges, count);
    double allowed =
        fmax(MISFIT * search->noise, MISFIT_SHARE * jumps_largest(search, search->window));
    if (misfit > allowed)
        return measured_fail(fault,
                             "velocity_a: between contacts it misses even motion and even "
                             "acceleration (%.4g m/s^2) by %.2g m/s: must be at most %.2g m/s",
                             search->acceleration, misfit, allowed);
    /* and the flights between them */
    struct line lines[HISTORY_SUB_IMPACTS + 1];
    double *levelled = calloc(search->count, sizeof *levelled);
    if (!levelled)
        return measured_fail(fault, "out of memory");
    count = fit_flights(search, ranges, count, levelled, lines);
    free(levelled);
    if (search->history->acceleration_a)
        flights_follow_integral(search, ranges, count, lines);
    impacts->count = count;
    impacts->of_b = search->history->of_b;
    impacts->noise = search->noise;
    impacts->acceleration = search->acceleration;
    take_contacts(search, ranges, count, lines, impacts);
    take_doubts(search, ranges, lines, impacts);
    impacts->before = impacts->list[0].approach;
    if (!(impacts->before < 0.0) && !search->history->acceleration_a && !search->history->of_b)
        return measured_fail(fault, "velocity_a: %g m/s before the impact: it does not approach",
                             impacts->before);
    return true;
}

static bool find(struct search *search, struct history_impacts *impacts,
                 struct measured_fault *fault)
{
    struct range ranges[HISTORY_SUB_IMPACTS];
    double acceleration;
    if (!flights_acceleration(search, &acceleration))
        return measured_fail(fault, "out of memory");
    if (search->history->gravity > 0.0 && !flights_state_gravity(search, &acceleration, fault))
        return false;
    jumps_level(search, acceleration);
    size_t count = jumps_find(search, ranges, fault);
    return count > 0 && measure(search, ranges, count, impacts, fault);
}

bool history_find(const struct history *history, struct history_impacts *impacts,
                  struct measured_fault *fault)
{
    struct search search = {.history = history, .count = history->count, .window = 1};
    if (history->count < HISTORY_LEAST_READINGS)
        return measured_fail(fault, "%zu readings: must be at least %d", history->count,
                             HISTORY_LEAST_READINGS);
    search.v = calloc(history->count, sizeof *search.v);
    search.sum = calloc(history->count + 1, sizeof *search.sum);
    bool good = search.v && search.sum ? find(&search, impacts, fault)
                                       : measured_fail(fault, "out of memory");
    free(search.v);
    free(search.sum);
    return good;
}
