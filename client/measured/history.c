/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Time histories of an impact: their reading, the flights and contacts in them, and their
 * alignment. */

#include "history.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "distance.h"
#include "table.h"
#include "text.h"

/* Reading a file. */

/* Replaces displacements by their differences: central ones, one-sided at the ends. */
static bool differentiate(const double *time, double *values, size_t count)
{
    double *slope = calloc(count, sizeof *slope);
    if (!slope)
        return false;
    for (size_t i = 0; i < count; i++) {
        size_t before = i > 0 ? i - 1 : 0, after = i + 1 < count ? i + 1 : i;
        slope[i] = (values[after] - values[before]) / (time[after] - time[before]);
    }
    memcpy(values, slope, count * sizeof *values);
    free(slope);
    return true;
}

/* The columns that are read: time, and of each body its velocity or else its displacement;
 * HISTORY_COLUMNS: the other one was not measured. */
struct choice {
    size_t column[3];
    bool of_b; /* the first body is B */
    double *values[3];
};

static size_t choose(const struct table *table, const size_t columns[3])
{
    for (int i = 0; i < 3; i++)
        if (table_has(table, columns[i]))
            return columns[i];
    return HISTORY_COLUMNS;
}

/* The body that is followed, and the other one, of which an acceleration tells no velocity. */
static bool choose_bodies(const struct table *table, struct choice *choice)
{
    static const size_t a[] = {HISTORY_VELOCITY_A, HISTORY_DISPLACEMENT_A, HISTORY_ACCELERATION_A};
    static const size_t b[] = {HISTORY_VELOCITY_B, HISTORY_DISPLACEMENT_B, HISTORY_ACCELERATION_B};
    choice->column[1] = choose(table, a);
    choice->column[2] = choose(table, b);
    choice->of_b = choice->column[1] == HISTORY_COLUMNS;
    if (choice->of_b)
        choice->column[1] = choice->column[2];
    if (choice->of_b || choice->column[2] == HISTORY_ACCELERATION_B)
        choice->column[2] = HISTORY_COLUMNS;
    return choice->column[1] < HISTORY_COLUMNS;
}

static double rate_of(const struct table *table)
{
    const struct column_map *map = table->layout.source->map;
    return map ? map->rate : 0.0;
}

/* False with the columns that are missing. */
static bool choose_columns(const struct table *table, struct choice *choice,
                           struct measured_remarks *remarks)
{
    const char *file = text_name(table->layout.source->file);
    char list[256];
    bool time = table_has(table, HISTORY_TIME) || rate_of(table) > 0.0;
    choice->column[0] = HISTORY_TIME;
    bool motion = choose_bodies(table, choice);
    layout_list(&table->layout, true, list, sizeof list);
    if (!time)
        remarks_wrong(remarks,
                      "%s: column 'time': missing; there are %s; --rate F says how many readings "
                      "there are a second",
                      file, list);
    if (!motion)
        remarks_wrong(
            remarks,
            "%s: column 'velocity_a', 'displacement_a' or 'acceleration_a' (or one of b): "
            "missing; there are %s",
            file, list);
    return time && motion;
}

/* Whether all readings of the row are there; they are taken as number `count`. */
static bool take_reading(struct table *table, size_t row, const struct choice *choice, size_t count,
                         struct measured_remarks *remarks)
{
    bool whole = true;
    for (int i = 0; i < 3; i++) {
        if (!choice->values[i])
            continue;
        double *value = &choice->values[i][count];
        /* readings are counted where nothing says their times */
        if (i == 0 && !table_has(table, HISTORY_TIME)) {
            *value = (double)row / rate_of(table);
            if (row > 0 && table->numbers[row] != table->numbers[row - 1] + 1)
                remarks_wrong(remarks, "%s:%zu: a line before has no reading: must be nan there",
                              text_name(table->layout.source->file), table->numbers[row]);
            continue;
        }
        whole = table_number(table, row, choice->column[i], value, remarks) && whole;
        whole = whole && !isnan(*value);
    }
    return whole;
}

static void check_order(const struct table *table, size_t row, const struct choice *choice,
                        size_t count, struct measured_remarks *remarks)
{
    const double *time = choice->values[0];
    if (count > 0 && !(time[count] > time[count - 1]))
        remarks_wrong(remarks, "%s:%zu: time: %.10g: must be later than the line before",
                      text_name(table->layout.source->file), table->numbers[row], time[count]);
}

/* Returns the number of readings; names faults. */
static size_t take_readings(struct table *table, const struct choice *choice,
                            struct measured_remarks *remarks)
{
    const char *file = text_name(table->layout.source->file);
    struct left_out left = {0};
    char text[400] = "";
    size_t count = 0;
    for (size_t row = 0; row < table->rows; row++) {
        size_t errors = remarks->errors;
        if (take_reading(table, row, choice, count, remarks))
            check_order(table, row, choice, count++, remarks);
        else if (remarks->errors == errors)
            left_out_add(&left, table->numbers[row]);
    }
    /* a gap hides an event in it */
    left_out_tell(&left, "readings that are not there", text, sizeof text);
    if (10 * left.count > table->rows)
        remarks_wrong(remarks, "%s: %zu of %zu rows: %s: must be at most a tenth", file, left.count,
                      table->rows, text);
    else if (left.count > 0)
        remarks_note(remarks, "%s: %zu of %zu rows left out: %s", file, left.count, table->rows,
                     text);
    if (count < HISTORY_LEAST_READINGS)
        remarks_wrong(remarks, "%s: %zu readings: must be at least %d", file, count,
                      HISTORY_LEAST_READINGS);
    return count;
}

/* Room for the columns; false: out of memory. */
static bool make_room(const struct table *table, struct choice *choice)
{
    bool good = true;
    for (int i = 0; i < 3; i++)
        if (choice->column[i] < HISTORY_COLUMNS) {
            choice->values[i] = calloc(table->rows + 1, sizeof(double));
            good = good && choice->values[i];
        }
    return good;
}

/* Replaces accelerations by their integral from the first on, by trapezoids. */
static void accumulate(const double *time, double *values, size_t count)
{
    double velocity = 0.0, before = values[0];
    values[0] = 0.0;
    for (size_t i = 1; i < count; i++) {
        velocity += 0.5 * (before + values[i]) * (time[i] - time[i - 1]);
        before = values[i];
        values[i] = velocity;
    }
}

/* Velocities of displacements and accelerations; false: out of memory. */
static bool derive(const struct choice *choice, struct history *history)
{
    bool good = true;
    if (choice->column[1] == HISTORY_ACCELERATION_A ||
        choice->column[1] == HISTORY_ACCELERATION_B) {
        history->acceleration_a = calloc(history->count, sizeof(double));
        if (!history->acceleration_a)
            return false;
        memcpy(history->acceleration_a, choice->values[1], history->count * sizeof(double));
        accumulate(history->time, choice->values[1], history->count);
    }
    for (int i = 1; i < 3; i++) {
        size_t column = choice->column[i];
        if (column != HISTORY_DISPLACEMENT_A && column != HISTORY_DISPLACEMENT_B)
            continue;
        history->from_displacement = true;
        /* A's flights are fitted to the readings themselves */
        if (i == 1) {
            history->displacement_a = calloc(history->count, sizeof(double));
            good = history->displacement_a;
            if (good)
                memcpy(history->displacement_a, choice->values[i], history->count * sizeof(double));
        }
        good = good && differentiate(history->time, choice->values[i], history->count);
    }
    return good;
}

static void read_table(struct table *table, struct history *history,
                       struct measured_remarks *remarks)
{
    struct choice choice = {{0}, false, {NULL, NULL, NULL}};
    const struct column_map *map = table->layout.source->map;
    const char *file = text_name(table->layout.source->file);
    size_t errors = remarks->errors;
    if (!choose_columns(table, &choice, remarks))
        return;
    bool memory = make_room(table, &choice);
    *history = (struct history){
        .time = choice.values[0],
        .velocity_a = choice.values[1],
        .velocity_b = choice.values[2],
        .of_b = choice.of_b,
        .gravity = map && choice.column[1] < HISTORY_ACCELERATION_A ? map->gravity : 0.0};
    if (memory)
        history->count = take_readings(table, &choice, remarks);
    if (memory && remarks->errors == errors)
        memory = derive(&choice, history);
    if (!memory)
        remarks_wrong(remarks, "%s: out of memory", file);
}

bool history_read(const char *file, const struct column_map *map, struct history *history,
                  struct measured_remarks *remarks)
{
    const struct table_source source = {file, HISTORY_KINDS, HISTORY_COLUMNS, map};
    struct table table;
    size_t errors = remarks->errors;
    *history = (struct history){0};
    if (!table_read(&source, &table, remarks))
        return false;
    read_table(&table, history, remarks);
    table_free(&table);
    if (remarks->errors == errors)
        return true;
    history_free(history);
    return false;
}

/* Flights and contacts. */

enum { LEAST_FLIGHT = 3 };
/* Rounds in which flights and their acceleration are found from each other. */
enum { ROUNDS = 3 };
/* Acceleration counts from so many of its standard deviations on. */
static const double ACCELERATED = 4.0;
/* Flights miss their lines by no more than so many standard deviations of a reading, or this share
 * of the largest jump, which is some per cent of e. */
static const double MISFIT = 4.0, MISFIT_SHARE = 0.01;
/* A jump counts from so many standard deviations on, and from this share of the largest. */
static const double SIGNIFICANT = 6.0, LEAST_SHARE = 2e-3;

void history_free(struct history *history)
{
    free(history->time);
    free(history->velocity_a);
    free(history->velocity_b);
    free(history->displacement_a);
    free(history->acceleration_a);
    *history = (struct history){0};
}

/* A search under way. */
struct search {
    const struct history *history;
    double acceleration;  /* of A in flight, m/s^2 */
    double deviation;     /* standard, of that */
    double *v;            /* [count]: A's velocity less that of the acceleration */
    size_t count, window; /* readings on each side that are compared */
    double *sum;          /* [count + 1]: running sums of v */
    double noise;
};

/* Readings that belong to a contact: [first, end). */
struct range {
    size_t first, end;
};

static double time_of(const struct search *search, size_t i)
{
    return search->history->time[i] - search->history->time[0];
}

/* The k-th of the flights before, between and behind `count` contacts. */
static struct range flight_of(const struct search *search, const struct range *ranges, size_t count,
                              size_t k)
{
    return (struct range){k ? ranges[k - 1].end : 0, k < count ? ranges[k].first : search->count};
}

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
    size_t i;
    double previous = 0.0;
    /* where half of the jump is made */
    for (i = range.first; i + 1 < range.end; i++)
        if ((mean_between(search, i - m, i + m + 1) - low) / (high - low) >= 0.5)
            break;
    previous = (mean_between(search, i - m, i + m + 1) - low) / (high - low);
    /* one reading later all of it is made: within that */
    if (way > 0 && previous > level && i > m) {
        double share = (mean_between(search, i - 1 - m, i + m) - low) / (high - low);
        return t[i - 1] + (level - share) / (previous - share) * (t[i] - t[i - 1]);
    }
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

/* A flight's line, y = at + rate (t - middle), and the standard deviations of its rate and
 * of `at`. */
struct line {
    double middle, at, rate;
    double deviation, at_deviation;
    size_t count; /* readings */
};

/* Least squares of values over time. */
static struct line line_of(const struct search *search, const double *y, struct range flight)
{
    double n = (double)(flight.end - flight.first);
    struct line line = {0};
    double squares = 0.0, products = 0.0;
    for (size_t i = flight.first; i < flight.end; i++) {
        line.middle += time_of(search, i) / n;
        line.at += y[i] / n;
    }
    for (size_t i = flight.first; i < flight.end; i++) {
        double t = time_of(search, i) - line.middle;
        squares += t * t;
        products += t * (y[i] - line.at);
    }
    line.rate = squares > 0.0 ? products / squares : 0.0;
    return line;
}

static double line_at(const struct line *line, double t)
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
        double left_y = y[i] - line_at(&of_y, time_of(search, i));
        double left_p = p[i] - line_at(&of_p, time_of(search, i));
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
        double t = time_of(search, i);
        p[i] = parabola ? 0.5 * t * t : t;
    }
    for (size_t k = 0; k <= count; k++)
        add_flight(search, y, p, parabola, flight_of(search, ranges, count, k), &normal);
    free(p);
    *acceleration = normal.pp > 0.0 ? normal.py / normal.pp : 0.0;
    double left = fmax(0.0, normal.yy - *acceleration * normal.py);
    *deviation = sqrt(left / fmax(1.0, normal.freedom - 1.0) / normal.pp);
    return true;
}

/* Computes A's velocity without the acceleration. */
static void level(struct search *search, double acceleration)
{
    search->acceleration = acceleration;
    for (size_t i = 0; i < search->count; i++)
        search->v[i] = search->history->velocity_a[i] -
                       (acceleration != 0.0 ? acceleration * time_of(search, i) : 0.0);
    search->sum[0] = 0.0;
    for (size_t i = 0; i < search->count; i++)
        search->sum[i + 1] = search->sum[i] + search->v[i];
}

/* Contacts of the levelled velocity; their number, 0 with the reason. */
static size_t find_contacts(struct search *search, struct range *ranges,
                            struct measured_fault *fault)
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

/* The stated gravity instead of the fitted acceleration, if one stands out of noise. False with the
 * reason if that is another one: a scale or a rate is wrong, or the body does not fall freely. */
static bool state_gravity(struct search *search, double *acceleration, struct measured_fault *fault)
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

/* Acceleration of falling bodies, 0 where none stands out of noise and jumps. False: out of memory.
 */
static bool find_acceleration(struct search *search, double *acceleration)
{
    struct range ranges[HISTORY_SUB_IMPACTS];
    struct measured_fault fault;
    double deviation = INFINITY, longest = 0.0, jump = 0.0;
    if (!guess_acceleration(search, acceleration))
        return false;
    for (int round = 0; round < ROUNDS; round++) {
        level(search, *acceleration);
        size_t count = find_contacts(search, ranges, &fault);
        if (count == 0) {
            *acceleration = 0.0;
            return true;
        }
        if (!fit_acceleration(search, ranges, count, acceleration, &deviation))
            return false;
        for (size_t k = 0; k <= count; k++) {
            struct range flight = flight_of(search, ranges, count, k);
            longest =
                fmax(longest, time_of(search, flight.end - 1) - time_of(search, flight.first));
        }
        jump = largest_step(search, search->window);
    }
    /* a change of velocity below a jump's least share is not told from its ends */
    double change = fabs(*acceleration) * 0.5 * longest;
    search->deviation = isfinite(deviation) ? deviation : 0.0;
    if (fabs(*acceleration) <= ACCELERATED * deviation || change <= LEAST_SHARE * jump)
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
        double t = time_of(search, i) - line->middle;
        left += pow(y[i] - (sloped ? line_at(line, time_of(search, i)) : line->rate), 2.0);
        squares += t * t;
    }
    line->count = flight.end - flight.first;
    double n = (double)line->count;
    double variance = left / fmax(1.0, sloped ? n - 2.0 : n - 1.0);
    line->deviation = sqrt(variance / (sloped ? squares : n));
    line->at_deviation = sqrt(variance / n);
}

/* A flight's velocity, levelled: the mean of its readings, or the slope of its displacements. */
static struct line flight_line(const struct search *search, double *levelled, struct range flight)
{
    const double *x = search->history->displacement_a;
    for (size_t i = flight.first; x && i < flight.end; i++) {
        double t = time_of(search, i);
        levelled[i] = x[i] - 0.5 * search->acceleration * t * t;
    }
    struct line line = line_of(search, x ? levelled : search->v, flight);
    if (!x)
        line.rate = mean_between(search, flight.first, flight.end);
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

/* The same of an integral of accelerations, whose errors last: no mean lessens them. From flight to
 * flight its velocity changes by what the contact between them adds; its offset is the mean of all
 * flights' accelerations, and the deviations add up by those of one reading's. */
static void follow_integral(struct search *search, const struct range *ranges, size_t count,
                            struct line *lines)
{
    const double *a = search->history->acceleration_a;
    double sum = 0.0, squares = 0.0, readings = 0.0;
    for (size_t k = 0; k <= count; k++) {
        const struct range flight = flight_of(search, ranges, count, k);
        for (size_t i = flight.first; i < flight.end; i++) {
            sum += a[i];
            squares += a[i] * a[i];
        }
        readings += (double)(flight.end - flight.first);
    }
    const double mean = sum / readings, offset = mean - search->acceleration;
    const double noise = sqrt(fmax(0.0, squares - readings * mean * mean) / (readings - 1.0));
    const double step = noise * time_of(search, search->count - 1) / (double)(search->count - 1);
    search->deviation = noise / sqrt(readings);
    lines[0] = (struct line){.rate = search->v[ranges[0].first],
                             .middle = time_of(search, ranges[0].first),
                             .count = (size_t)readings};
    for (size_t k = 0; k < count; k++) {
        const struct range range = ranges[k];
        double length = time_of(search, range.end) - time_of(search, range.first);
        double added = search->v[range.end] - search->v[range.first] - offset * length;
        lines[k + 1] =
            (struct line){.rate = lines[k].rate + added,
                          .middle = time_of(search, range.end),
                          .deviation = hypot(hypot(lines[k].deviation, missed_by(search, range)),
                                             step * sqrt((double)(range.end - range.first))),
                          .count = (size_t)readings};
    }
}

/* Root mean square of the velocities' departures from their flights' lines. */
static double find_misfit(const struct search *search, const struct range *ranges, size_t count)
{
    double squares = 0.0, readings = 0.0;
    for (size_t k = 0; k <= count; k++) {
        struct range flight = flight_of(search, ranges, count, k);
        double mean = mean_between(search, flight.first, flight.end);
        for (size_t i = flight.first; i < flight.end; i++)
            squares += (search->v[i] - mean) * (search->v[i] - mean);
        readings += (double)(flight.end - flight.first);
    }
    return sqrt(squares / readings);
}

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
    bool within = met >= time_of(search, range.first - 1) && met <= time_of(search, range.end);
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
        double b = velocity_of_b(search, flight_of(search, ranges, count, k));
        contact->start = edge(search, ranges[k], low, high, -1);
        contact->end = edge(search, ranges[k], low, high, 1);
        contact->jump = sign * (high - low);
        double touch = touch_of(search, ranges[k], &lines[k], contact);
        contact->approach = sign * (low + search->acceleration * touch - b);
        /* neither is told by an integral, nor by the body that was at rest */
        if (search->history->acceleration_a || search->history->of_b)
            contact->approach = 0.0;
        /* gravity has turned A that had left */
        contact->begins = k == 0 || (contact->approach != 0.0 && search->acceleration != 0.0 &&
                                     left_with > 0.0 && contact->approach < 0.0);
        b = velocity_of_b(search, flight_of(search, ranges, count, k + 1));
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
            lines[k] = flight_line(search, levelled, flight_of(search, ranges, count, k));
        for (size_t k = 0; search->history->displacement_a && count > 1 && k < count; k++) {
            double jump = fabs(lines[k + 1].rate - lines[k].rate);
            if (jump > SIGNIFICANT * hypot(lines[k].deviation, lines[k + 1].deviation))
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
    double misfit = find_misfit(search, ranges, count);
    double allowed =
        fmax(MISFIT * search->noise, MISFIT_SHARE * largest_step(search, search->window));
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
        follow_integral(search, ranges, count, lines);
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
    if (!find_acceleration(search, &acceleration))
        return measured_fail(fault, "out of memory");
    if (search->history->gravity > 0.0 && !state_gravity(search, &acceleration, fault))
        return false;
    level(search, acceleration);
    size_t count = find_contacts(search, ranges, fault);
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

/* Alignment of a history with the first touch, and displacements. */

/* By trapezoids, 0 at time 0 (between two readings: by the line through them). */
static void integrate(const struct history_motion *motion, const double *velocity,
                      double *displacement)
{
    const double *time = motion->time;
    double at_zero = 0.0;
    for (size_t i = 1; i < motion->count; i++) {
        double step = 0.5 * (velocity[i - 1] + velocity[i]) * (time[i] - time[i - 1]);
        displacement[i] = displacement[i - 1] + step;
        if (time[i - 1] <= 0.0 && time[i] > 0.0)
            at_zero = displacement[i - 1] - step * time[i - 1] / (time[i] - time[i - 1]);
    }
    for (size_t i = 0; i < motion->count; i++)
        displacement[i] -= at_zero;
}

bool history_align(const struct history *history, const struct history_impacts *impacts,
                   struct history_motion *motion)
{
    const bool of_b = history->of_b;
    const double *measured[2] = {of_b ? NULL : history->velocity_a,
                                 of_b ? history->velocity_a : history->velocity_b};
    double start = impacts->list[0].start;
    /* the contact pushes B the other way */
    double sign = of_b ? -impacts->direction : impacts->direction;
    size_t count = history->count;
    *motion = (struct history_motion){.count = count, .time = calloc(count, sizeof(double))};
    bool good = motion->time;
    /* from the first touch on */
    for (size_t i = 0; good && i < count; i++)
        motion->time[i] = history->time[i] - start;
    /* the motion of each body that was measured */
    for (int which = 0; good && which < 2; which++) {
        if (!measured[which])
            continue;
        motion->velocity[which] = calloc(count, sizeof(double));
        motion->displacement[which] = calloc(count, sizeof(double));
        good = motion->velocity[which] && motion->displacement[which];
        for (size_t i = 0; good && i < count; i++)
            motion->velocity[which][i] = sign * measured[which][i];
        if (good)
            integrate(motion, motion->velocity[which], motion->displacement[which]);
    }
    if (!good)
        history_motion_free(motion);
    return good;
}

void history_motion_free(struct history_motion *motion)
{
    free(motion->time);
    for (int which = 0; which < 2; which++) {
        free(motion->velocity[which]);
        free(motion->displacement[which]);
    }
    *motion = (struct history_motion){0};
}
