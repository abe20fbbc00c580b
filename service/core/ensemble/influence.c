/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/influence.h"

#include <math.h>
#include <stdlib.h>

/* From this share of the deviation of all samples on, neighbours count as chaotic. */
static const double CHAOTIC = 0.5;

static int compare(const void *a, const void *b)
{
    const struct influence_pair *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    return (p->y > q->y) - (p->y < q->y);
}

size_t influence_sort(struct influence_pair *pairs, size_t count)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (isfinite(pairs[i].x) && isfinite(pairs[i].y))
            pairs[kept++] = pairs[i];
    qsort(pairs, kept, sizeof *pairs, compare);
    return kept;
}

static double mean_of(const struct influence_pair *pairs, size_t count)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++)
        sum += pairs[i].y;
    return sum / (double)count;
}

/* Sum of squared differences from the mean. */
static double scatter_of(const struct influence_pair *pairs, size_t count)
{
    double mean = mean_of(pairs, count), sum = 0.0;
    for (size_t i = 0; i < count; i++)
        sum += (pairs[i].y - mean) * (pairs[i].y - mean);
    return sum;
}

/* Root mean square difference over sqrt 2 of pairs one to two resolutions apart, the first of them
 * among [first, end). */
static double local_deviation(const struct influence_pair *sorted, size_t count, size_t first,
                              size_t end, double resolution)
{
    double sum = 0.0;
    size_t found = 0, far = first;
    for (size_t i = first; i < end; i++) {
        while (far < count && sorted[far].x < sorted[i].x + resolution)
            far++;
        if (far == count)
            break;
        if (sorted[far].x > sorted[i].x + 2.0 * resolution)
            continue;
        double difference = sorted[far].y - sorted[i].y;
        sum += difference * difference;
        found++;
    }
    return found >= 3 ? sqrt(0.5 * sum / (double)found) : NAN;
}

void influence_parts(const struct influence_pair *sorted, size_t count, double resolution,
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
