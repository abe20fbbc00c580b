/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/classes.h"

#include <math.h>
#include <stdlib.h>

#include "ensemble/sampling.h"

static int compare(const void *a, const void *b)
{
    const struct member *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    return (p->order > q->order) - (p->order < q->order);
}

/* y becomes the distance from the mean. */
static void centre(struct classes *classes)
{
    double sum = 0.0, squares = 0.0;
    for (size_t i = 0; i < classes->member_count; i++)
        sum += classes->members[i].y;
    classes->mean = sum / (double)classes->member_count;
    for (size_t i = 0; i < classes->member_count; i++) {
        classes->members[i].y -= classes->mean;
        squares += classes->members[i].y * classes->members[i].y;
    }
    classes->variance = squares / ((double)classes->member_count - 1.0);
}

bool classes_create(struct classes *classes, const struct class_samples *samples)
{
    /* room for all samples */
    const double *x = samples->x, *y = samples->y;
    size_t count = samples->count;
    *classes = (struct classes){.replicates = samples->replicates};
    classes->members = calloc(count + 1, sizeof *classes->members);
    classes->place = calloc(count + 1, sizeof *classes->place);
    classes->list = calloc(count + 1, sizeof *classes->list);
    if (!classes->members || !classes->place || !classes->list)
        return false;
    /* members have both values, and an order by chance among equal x */
    for (size_t i = 0; i < count; i++) {
        uint32_t order = random_hash(0, (uint32_t)((uint64_t)i >> 32), (uint32_t)i);
        classes->place[i] = SIZE_MAX;
        if (isfinite(x[i]) && isfinite(y[i]))
            classes->members[classes->member_count++] = (struct member){x[i], y[i], i, order};
    }
    /* by ascending x, and back from a sample to its place */
    centre(classes);
    qsort(classes->members, classes->member_count, sizeof *classes->members, compare);
    for (size_t i = 0; i < classes->member_count; i++)
        classes->place[classes->members[i].sample] = i;
    return true;
}

void classes_release(struct classes *classes)
{
    free(classes->members);
    free(classes->place);
    free(classes->list);
    free(classes->parts);
}

void classes_divide(struct classes *classes, size_t size)
{
    const struct member *members = classes->members;
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

bool classes_split(struct classes *classes)
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
            const struct member *member = &classes->members[i];
            struct class_part *part = &classes->parts[k * replicates + member->sample % replicates];
            part->sum += member->y;
            part->count += 1.0;
        }
    return true;
}

double class_mean_without(const struct classes *classes, const struct class *class, size_t member)
{
    const struct member *out = &classes->members[member];
    size_t k = (size_t)(class - classes->list), replicates = classes->replicates;
    bool inside = member >= class->first && member < class->end;
    struct class_part part = {inside ? out->y : 0.0, inside};
    if (classes->parts)
        part = classes->parts[k * replicates + out->sample % replicates];
    double left = class_size(class) - part.count;
    return left > 0.0 ? (class->sum - part.sum) / left : 0.0;
}

const struct class *class_at(const struct classes *classes, double x)
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

double class_variance(const struct classes *classes, const struct class *class)
{
    /* sums by replicate */
    size_t replicates = classes->replicates;
    double sums[SAMPLING_REPLICATES] = {0}, squares[SAMPLING_REPLICATES] = {0};
    double counts[SAMPLING_REPLICATES] = {0};
    for (size_t i = class->first; i < class->end; i++) {
        const struct member *member = &classes->members[i];
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
