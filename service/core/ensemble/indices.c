/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/indices.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "ensemble/sampling.h"
#include "numeric/random_stream.h"
#include "numeric/sorting.h"
#include "numeric/special.h"

/* Order by chance, the same for any x. */
static double random_place(size_t sample)
{
    return random_hash(0, (uint32_t)((uint64_t)sample >> 32), (uint32_t)sample);
}

/* Samples by ascending x; with `keys`, memory. */
static bool sort_by(const double *x, double *keys, size_t *samples, size_t count)
{
    for (size_t i = 0; i < count; i++)
        keys[i] = x ? x[samples[i]] : random_place(samples[i]);
    return sorting_ascend(keys, samples, count);
}

static bool has_equals(const double *sorted, size_t count)
{
    for (size_t i = 1; i < count; i++)
        if (sorted[i] == sorted[i - 1])
            return true;
    return false;
}

bool indices_sort(const double *x, const double *y, size_t count, struct indices_point *sorted,
                  size_t *kept)
{
    size_t n = 0, *samples = malloc((count + 1) * sizeof *samples);
    double *keys = malloc((count + 1) * sizeof *keys);
    bool good = samples && keys;
    for (size_t i = 0; good && i < count; i++)
        if (isfinite(x[i]) && isfinite(y[i]))
            samples[n++] = i;
    good = good && sort_by(x, keys, samples, n);
    /* equal x keep the order they had: one by chance */
    if (good && has_equals(keys, n))
        good = sort_by(NULL, keys, samples, n) && sort_by(x, keys, samples, n);
    for (size_t i = 0; good && i < n; i++)
        sorted[i] = (struct indices_point){x[samples[i]], y[samples[i]], samples[i]};
    *kept = good ? n : 0;
    free(samples);
    free(keys);
    return good;
}

/* Neighbours in x: members [first, end). */
struct class
{
    size_t first, end;
    double sum; /* of y */
};

/* Part of one replicate in a class. */
struct class_part {
    double sum, count;
};

struct classes {
    size_t replicates; /* sample i belongs to i mod this; 1: each is independent of all others */
    size_t member_count;
    struct indices_point *members; /* by ascending x; y less the mean of all */
    size_t *place;                 /* of each sample among them; SIZE_MAX: a value is missing */
    double mean, variance;         /* of y */
    size_t count;
    struct class *list;
    struct class_part *parts; /* [count * replicates]; NULL: not asked for, or of no use */
};

static inline double class_size(const struct class *class)
{
    return (double)(class->end - class->first);
}

/* y becomes the distance from the mean, which is summed up in the order of the points. */
static void centre(struct classes *classes, size_t count)
{
    double sum = 0.0, squares = 0.0;
    for (size_t i = 0; i < count; i++)
        if (classes->place[i] != SIZE_MAX)
            sum += classes->members[classes->place[i]].y;
    classes->mean = sum / (double)classes->member_count;
    for (size_t i = 0; i < count; i++) {
        if (classes->place[i] == SIZE_MAX)
            continue;
        double *y = &classes->members[classes->place[i]].y;
        *y -= classes->mean;
        squares += *y * *y;
    }
    classes->variance = squares / ((double)classes->member_count - 1.0);
}

/* No classes yet. False: out of memory. Release it all the same. */
static bool classes_create(struct classes *classes, const struct indices_data *data)
{
    *classes = (struct classes){.replicates = data->replicates, .member_count = data->kept};
    classes->members = malloc((data->kept + 1) * sizeof *classes->members);
    classes->place = malloc((data->count + 1) * sizeof *classes->place);
    classes->list = malloc((data->kept + 1) * sizeof *classes->list);
    if (!classes->members || !classes->place || !classes->list)
        return false;
    for (size_t i = 0; i < data->count; i++)
        classes->place[i] = SIZE_MAX;
    for (size_t i = 0; i < data->kept; i++) {
        classes->members[i] = data->sorted[i];
        classes->place[data->sorted[i].sample] = i;
    }
    centre(classes, data->count);
    return true;
}

static void classes_release(struct classes *classes)
{
    free(classes->members);
    free(classes->place);
    free(classes->list);
    free(classes->parts);
}

/* Makes classes of `size` members each, of less than twice as many where the members do not divide
 * evenly. Where many have the same x, a class does not reach from one value to the next. */
static void classes_divide(struct classes *classes, size_t size)
{
    const struct indices_point *members = classes->members;
    size_t n = classes->member_count, run = 0; /* end of those with the same x */
    classes->count = 0;
    for (size_t first = 0, end = 0; first < n; first = end) {
        double sum = 0.0;
        for (; end < n; end++) {
            while (run < n && (run <= end || members[run].x == members[end].x))
                run++;
            bool full = end - first >= size && n - end >= size;
            bool changes = end > first && members[end].x != members[end - 1].x;
            if (full && (changes || run - end >= size))
                break;
            sum += members[end].y;
        }
        classes->list[classes->count++] = (struct class){first, end, sum};
    }
}

/* Afterwards class_mean_without may be called. False: out of memory. */
static bool classes_split(struct classes *classes)
{
    size_t replicates = classes->replicates;
    free(classes->parts);
    classes->parts = NULL;
    if (replicates == 1)
        return true;
    classes->parts = calloc(classes->count * replicates, sizeof *classes->parts);
    if (!classes->parts)
        return false;
    for (size_t k = 0; k < classes->count; k++)
        for (size_t i = classes->list[k].first; i < classes->list[k].end; i++) {
            const struct indices_point *member = &classes->members[i];
            struct class_part *part = &classes->parts[k * replicates + member->sample % replicates];
            part->sum += member->y;
            part->count += 1.0;
        }
    return true;
}

/* Mean of y over the members of a class that are independent of one member (an index; of this or
 * another class): without it, or where there are replicates without all of its own. 0, which is the
 * mean of all, where nothing else is left. */
static double class_mean_without(const struct classes *classes, const struct class *class,
                                 size_t member)
{
    const struct indices_point *out = &classes->members[member];
    size_t k = (size_t)(class - classes->list), replicates = classes->replicates;
    bool inside = member >= class->first && member < class->end;
    struct class_part part = {inside ? out->y : 0.0, inside};
    if (classes->parts)
        part = classes->parts[k * replicates + out->sample % replicates];
    double left = class_size(class) - part.count;
    return left > 0.0 ? (class->sum - part.sum) / left : 0.0;
}

/* The class of a value, or the nearest one. */
static const struct class *class_at(const struct classes *classes, double x)
{
    size_t low = 0, high = classes->count - 1;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (classes->members[classes->list[middle].end - 1].x >= x)
            high = middle;
        else
            low = middle + 1;
    }
    return &classes->list[low];
}

/* Variance of y within a class, from pairs of members of different replicates, as points of the
 * same one are not independent of each other. */
static double class_variance(const struct classes *classes, const struct class *class)
{
    /* sums by replicate */
    size_t replicates = classes->replicates;
    double sums[SAMPLING_REPLICATES] = {0}, squares[SAMPLING_REPLICATES] = {0};
    double counts[SAMPLING_REPLICATES] = {0};
    for (size_t i = class->first; i < class->end; i++) {
        const struct indices_point *member = &classes->members[i];
        size_t r = member->sample % replicates;
        counts[r] += 1.0;
        sums[r] += member->y;
        squares[r] += member->y * member->y;
    }
    /* of n values the squared differences of all pairs sum up to n sum y^2 - (sum y)^2 */
    double n = class_size(class), all = 0.0, apart = 0.0, pairs = n * n;
    for (size_t r = 0; r < replicates; r++) {
        all += squares[r];
        apart -= counts[r] * squares[r] - sums[r] * sums[r];
        pairs -= counts[r] * counts[r];
    }
    all = n * all - class->sum * class->sum;
    /* half the mean square difference: of all pairs, or of those across replicates */
    if (replicates == 1 || pairs == 0.0)
        return all / (n * (n - 1.0));
    return (all + apart) / pairs;
}

/* FINE: members of a class, for the first-order index; LEAST: samples, or rows, for an estimate. */
enum { FINE = 8, LEAST = 16 };

static const double ONE_SIDED = 1.645; /* deviations of a normal distribution that 95 % are below */

/* An index before it is put into its bounds, and its standard error with degrees of freedom. */
struct estimate {
    double value, error, degrees;
};

/* Variance of the index of an input without influence: within a class of c members y leaves
 * c/(c - 1) times the square of the class mean to chance, and that has the variance 2/c^2 of all.
 */
static double chance_of(const struct classes *classes)
{
    double sum = 0.0, n = (double)classes->member_count;
    for (size_t k = 0; k < classes->count; k++) {
        double c = class_size(&classes->list[k]);
        sum += 2.0 * c / (c - 1.0);
    }
    return sum / (n * n);
}

/* 1 - R, R = the variance within classes over that of all. The error follows from the contribution
 * of each class to (variance within) - R (variance): these numbers are independent of each other,
 * but for a drift along x. Differences of neighbours give their scatter; the drift adds to the
 * error where x itself is random. Where all class means are alike by chance, that error is too
 * small: the error by chance is its lower bound. `added`: memory, one number a class. */
static struct estimate first_order(const struct classes *classes, double *added)
{
    /* variance within the classes */
    double n = (double)classes->member_count, count = (double)classes->count, within = 0.0;
    for (size_t k = 0; k < classes->count; k++) {
        const struct class *class = &classes->list[k];
        added[k] = class_size(class) * class_variance(classes, class);
        within += added[k];
    }
    /* contribution of each class to the error, and scatter of neighbours */
    double rest = within / (n * classes->variance), all = 0.0, scatter = 0.0;
    for (size_t k = 0; k < classes->count; k++) {
        for (size_t i = classes->list[k].first; i < classes->list[k].end; i++)
            added[k] -= rest * classes->members[i].y * classes->members[i].y;
        all += added[k] * added[k];
        if (k > 0)
            scatter += 0.5 * (added[k] - added[k - 1]) * (added[k] - added[k - 1]);
    }
    scatter *= count / (count - 1.0);
    /* plain points have random x, and hence a random drift */
    double drift = classes->replicates == 1 ? fmax(0.0, all - scatter) * count / n : 0.0;
    double error = sqrt(scatter + drift) / (n * classes->variance);
    /* the scatter of differences has two thirds of their degrees of freedom */
    return (struct estimate){1.0 - rest, fmax(error, rest * sqrt(chance_of(classes))),
                             2.0 / 3.0 * (count - 1.0)};
}

/* Trusted share of the class means: their variance, less that of chance, over the observed one; 0
 * where all of it may be chance. */
static double belief(const struct classes *classes)
{
    double n = (double)classes->member_count, spare = (double)classes->count - 1.0, between = 0.0;
    for (size_t k = 0; k < classes->count; k++)
        between += classes->list[k].sum * classes->list[k].sum / class_size(&classes->list[k]);
    double seen = between / (classes->variance * (n - 1.0));
    double explained = (seen - spare / n) / (1.0 - spare / n);
    return explained > ONE_SIDED * sqrt(2.0 * spare) / n ? explained / seen : 0.0;
}

/* Contribution of one replicate, or of all plain points, to the total index: u of samples, v of
 * rows. */
struct contribution {
    double samples, u, u_squares;
    double rows, v, v_squares, uv;
};

/* u = (y - g(x))^2 of every member, g = trust times the mean of its class without the values that
 * depend on that member. */
static double find_u(const struct classes *classes, double trust, double *u)
{
    double sum = 0.0, n = (double)classes->member_count;
    double exact = trust > 0.0 ? 1.0 : n / (n - 1.0); /* y is less its own mean */
    for (size_t k = 0; k < classes->count; k++)
        for (size_t i = classes->list[k].first; i < classes->list[k].end; i++) {
            double g = trust * class_mean_without(classes, &classes->list[k], i);
            double off = classes->members[i].y - g;
            u[i] = exact * off * off;
            sum += u[i];
        }
    return sum / n;
}

/* v = (y' - g(x') - y + g(x))^2/2 of every row; NAN where a value is missing. */
static double find_v(const struct indices_data *data, const struct classes *classes, double trust,
                     double *v)
{
    double sum = 0.0, count = 0.0;
    for (size_t k = 0; k < data->row_count; k++) {
        /* rows with both values */
        const struct indices_row *row = &data->rows[k];
        size_t at = classes->place[row->sample];
        v[k] = NAN;
        if (at == SIZE_MAX || !isfinite(row->y))
            continue;
        /* y and y' less their class means */
        const struct indices_point *member = &classes->members[at];
        double g = class_mean_without(classes, class_at(classes, member->x), at);
        double anew = class_mean_without(classes, class_at(classes, row->x), at);
        double off = row->y - classes->mean - trust * anew - member->y + trust * g;
        v[k] = 0.5 * off * off;
        sum += v[k];
        count += 1.0;
    }
    return count < LEAST ? NAN : sum / count;
}

/* Standard error of mean u + mean v, over plain points, where the rows are some of the samples. */
static double plain_error(const struct contribution *all)
{
    double n = all->samples, m = all->rows, u = all->u / n, v = all->v / m;
    double of_u = all->u_squares / n - u * u;
    double of_v = (all->v_squares / m - v * v) * m / (m - 1.0);
    double both = all->uv / m - u * v;
    return sqrt(fmax(0.0, of_u / n + of_v / m + 2.0 * both / n));
}

/* The same by the spread of replicates, those that have rows. */
static double replicated_error(const struct contribution *each, size_t count, double *degrees)
{
    double means[SAMPLING_REPLICATES];
    for (size_t r = 0; r < count; r++)
        means[r] = each[r].u / each[r].samples + each[r].v / each[r].rows;
    struct moments moments = summary_moments(means, count);
    *degrees = (double)moments.count - 1.0;
    return moments.deviation / sqrt((double)moments.count);
}

/* `work`: memory, one number a sample and a row. */
static struct estimate total_order(const struct indices_data *data, const struct classes *classes,
                                   double trust, double *work)
{
    /* the identity of indices.h, divided by the variance */
    struct contribution each[SAMPLING_REPLICATES] = {0};
    double *u = work, *v = work + classes->member_count;
    double mean_u = find_u(classes, trust, u), mean_v = find_v(data, classes, trust, v);
    struct estimate total = {1.0 + (mean_v - mean_u) / classes->variance, NAN, NAN};
    if (isnan(mean_v))
        return total;
    /* contributions of samples and rows of each replicate to its error */
    double n = (double)classes->member_count, part = (1.0 - total.value) * n / (n - 1.0);
    for (size_t i = 0; i < classes->member_count; i++) {
        const struct indices_point *member = &classes->members[i];
        struct contribution *one = &each[member->sample % data->replicates];
        /* the variance, by which it is divided, is an estimate too */
        u[i] = part * member->y * member->y - u[i];
        one->samples += 1.0;
        one->u += u[i];
        one->u_squares += u[i] * u[i];
    }
    for (size_t k = 0; k < data->row_count; k++) {
        struct contribution *one = &each[data->rows[k].sample % data->replicates];
        if (isnan(v[k]))
            continue;
        one->rows += 1.0;
        one->v += v[k];
        one->v_squares += v[k] * v[k];
        one->uv += v[k] * u[classes->place[data->rows[k].sample]];
    }
    /* from their sums, or from the spread of replicates */
    total.degrees = each[0].rows - 1.0;
    total.error = data->replicates == 1 ? plain_error(each)
                                        : replicated_error(each, data->replicates, &total.degrees);
    total.error /= classes->variance;
    return total;
}

static double clip(double share)
{
    return share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
}

static double half_width(const struct estimate *estimate, double level)
{
    return special_student_quantile(estimate->degrees, 0.5 + 0.5 * level) * estimate->error;
}

static void find_first(const struct indices_data *data, struct classes *classes, double *work,
                       struct estimate *first, struct indices *indices)
{
    size_t size = classes->member_count / FINE;
    size = size < 2 ? 2 : size > FINE ? FINE : size;
    classes_divide(classes, 2 * size);
    struct estimate coarse = first_order(classes, work);
    classes_divide(classes, size);
    *first = first_order(classes, work);
    indices->noise = ONE_SIDED * sqrt(chance_of(classes));
    double half = half_width(first, data->level);
    /* half as wide classes explain more where y is rough; finer ones may add as much again */
    double hidden = fmax(0.0, first->value - coarse.value);
    indices->first_order = clip(first->value);
    /* the upper bound of a negative estimate starts from 0 */
    indices->first_bounds =
        (struct interval){clip(first->value - half), clip(fmax(0.0, first->value) + half + hidden)};
}

/* A mean of squares is skewed: its logarithm is less so, but where the error is as large as the
 * index itself. */
static struct interval total_bounds(const struct estimate *total, double half)
{
    double value = total->value;
    if (!(value > 0.0))
        return (struct interval){0.0, clip(value + half)};
    return (struct interval){clip(value * exp(-half / value)),
                             clip(fmin(value * exp(half / value), value + 2.0 * half))};
}

/* With the class means as control variate or, where these are mere noise, without: the estimate
 * with the smaller error. */
static bool find_total(const struct indices_data *data, struct classes *classes, double *work,
                       struct estimate *total, struct indices *indices)
{
    classes_divide(classes, (size_t)sqrt(2.0 * (double)classes->member_count));
    if (!classes_split(classes))
        return false;
    double trust = belief(classes);
    *total = total_order(data, classes, 0.0, work);
    struct estimate aided = total_order(data, classes, trust, work);
    if (aided.error < total->error)
        *total = aided;
    indices->total = clip(total->value);
    indices->total_bounds = total_bounds(total, half_width(total, data->level));
    return true;
}

static void widen(struct interval *interval, double value)
{
    interval->low = fmin(interval->low, value);
    interval->high = fmax(interval->high, value);
}

/* Pools two estimates that chance has put in the wrong order. */
static void order(const struct estimate *first, const struct estimate *total,
                  struct indices *indices)
{
    double of_first = first->error * first->error, of_total = total->error * total->error;
    if (!(first->value > total->value))
        return;
    double pooled =
        of_first + of_total > 0.0
            ? (first->value * of_total + total->value * of_first) / (of_first + of_total)
            : 0.5 * (first->value + total->value);
    indices->first_order = indices->total = clip(pooled);
    widen(&indices->first_bounds, indices->first_order);
    widen(&indices->total_bounds, indices->total);
}

bool indices_find(const struct indices_data *data, struct indices *indices)
{
    /* unknown where there are too few values */
    static const struct interval unknown = {NAN, NAN};
    *indices = (struct indices){NAN, NAN, unknown, unknown, NAN};
    struct classes classes;
    double *work = malloc((data->kept + data->row_count + 1) * sizeof *work);
    bool good = classes_create(&classes, data) && work;
    size_t n = classes.member_count;
    /* both indices where x and y vary */
    if (good && n >= LEAST && classes.members[n - 1].x > classes.members[0].x &&
        classes.variance > 0.0) {
        struct estimate first, total = {NAN, NAN, NAN};
        find_first(data, &classes, work, &first, indices);
        if (data->row_count > 0) {
            good = find_total(data, &classes, work, &total, indices);
            order(&first, &total, indices);
        }
    }
    classes_release(&classes);
    free(work);
    return good;
}

/* ---- where along an input the answer is smooth ---- */

/* From this share of the deviation of all samples on, neighbours count as chaotic. */
static const double CHAOTIC = 0.5;

static double mean_of(const struct indices_point *pairs, size_t count)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++)
        sum += pairs[i].y;
    return sum / (double)count;
}

/* Sum of squared differences from the mean. */
static double scatter_of(const struct indices_point *pairs, size_t count)
{
    double mean = mean_of(pairs, count), sum = 0.0;
    for (size_t i = 0; i < count; i++)
        sum += (pairs[i].y - mean) * (pairs[i].y - mean);
    return sum;
}

/* Root mean square difference over sqrt 2 of pairs one to two resolutions apart, the first of them
 * among [first, end). Where many have the same x (a list's) each of them has another partner. */
static double local_deviation(const struct indices_point *sorted, size_t count, size_t first,
                              size_t end, double resolution)
{
    double sum = 0.0;
    size_t found = 0, alike = first;  /* the first of the same x */
    size_t far = first, past = first; /* the first partner, and the end of those of its x */
    for (size_t i = first; i < end; i++) {
        alike = sorted[i].x > sorted[alike].x ? i : alike;
        while (far < count && sorted[far].x < sorted[i].x + resolution)
            far++;
        if (far == count)
            break;
        if (sorted[far].x > sorted[i].x + 2.0 * resolution)
            continue;
        for (past = past > far ? past : far + 1; past < count && sorted[past].x == sorted[far].x;)
            past++;
        double difference = sorted[far + (i - alike) % (past - far)].y - sorted[i].y;
        sum += difference * difference;
        found++;
    }
    return found >= 3 ? sqrt(0.5 * sum / (double)found) : NAN;
}

void influence_parts(const struct indices_point *sorted, size_t count, double resolution,
                     struct influence_part *parts, size_t part_count)
{
    if (count == 0)
        return;
    double low = sorted[0].x, width = (sorted[count - 1].x - low) / (double)part_count;
    double all = sqrt(scatter_of(sorted, count) / fmax(1.0, (double)count - 1.0));
    size_t first = 0;
    /* equal parts of the range */
    for (size_t k = 0; k < part_count; k++) {
        struct influence_part *part = &parts[k];
        *part = (struct influence_part){
            .low = low + width * (double)k, .mean = NAN, .deviation = NAN, .local = NAN};
        part->high = k + 1 < part_count ? low + width * (double)(k + 1) : sorted[count - 1].x;
        /* samples in this part */
        size_t end = first;
        while (end < count && (k + 1 == part_count || sorted[end].x < part->high))
            end++;
        part->count = end - first;
        if (part->count > 0)
            part->mean = mean_of(sorted + first, part->count);
        if (part->count > 1)
            part->deviation =
                sqrt(scatter_of(sorted + first, part->count) / ((double)part->count - 1.0));
        /* and whether neighbours in it differ as much as all */
        part->local = local_deviation(sorted, count, first, end, resolution);
        part->chaotic = part->local > CHAOTIC * all;
        first = end;
    }
}
