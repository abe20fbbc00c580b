/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/places.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* A cell of the grid that sorts points is so many times as wide as the tolerance of one point: few
 * points lie near its walls, and few of them share it. */
static const double CELL = 1000.0;
static const size_t FIRST_ROOM = 1024;

void places_free(struct places *places)
{
    free(places->points);
    free(places->next);
    free(places->bucket);
    memset(places, 0, sizeof *places);
}

static size_t bucket_of(const struct places *places, const int64_t cell[3])
{
    uint64_t hash = 0;
    for (int c = 0; c < 3; c++) {
        hash = (hash ^ (uint64_t)cell[c]) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
    }
    return (size_t)(hash % places->buckets);
}

static void cell_at(const struct places *places, const double point[3], double offset,
                    int64_t cell[3])
{
    for (int c = 0; c < 3; c++)
        cell[c] = (int64_t)floor((point[c] + offset) / (CELL * places->same));
}

static bool is_same(const struct places *places, size_t i, const double point[3])
{
    for (int c = 0; c < 3; c++)
        if (!(fabs(places->points[i][c] - point[c]) < places->same))
            return false;
    return true;
}

size_t places_find(const struct places *places, const double point[3])
{
    if (places->count == 0)
        return SIZE_MAX;
    /* the cells that a point which is the same may lie in */
    int64_t low[3], high[3];
    cell_at(places, point, -places->same, low);
    cell_at(places, point, places->same, high);
    for (int corner = 0; corner < 8; corner++) {
        int64_t cell[3];
        bool again = false;
        for (int c = 0; c < 3; c++) {
            bool up = corner >> c & 1;
            cell[c] = up ? high[c] : low[c];
            again |= up && high[c] == low[c];
        }
        if (again)
            continue;
        for (size_t i = places->bucket[bucket_of(places, cell)]; i != SIZE_MAX; i = places->next[i])
            if (is_same(places, i, point))
                return i;
    }
    return SIZE_MAX;
}

static void link_point(struct places *places, size_t i)
{
    int64_t cell[3];
    cell_at(places, places->points[i], 0.0, cell);
    size_t bucket = bucket_of(places, cell);
    places->next[i] = places->bucket[bucket];
    places->bucket[bucket] = i;
}

/* twice the room, and as many buckets as points */
static bool grow(struct places *places)
{
    size_t room = places->room ? 2 * places->room : FIRST_ROOM;
    double(*points)[3] = realloc(places->points, room * sizeof *points);
    if (points)
        places->points = points;
    size_t *next = realloc(places->next, room * sizeof *next);
    if (next)
        places->next = next;
    size_t *bucket = realloc(places->bucket, room * sizeof *bucket);
    if (bucket)
        places->bucket = bucket;
    if (!points || !next || !bucket)
        return false;
    places->room = room;
    places->buckets = room;
    for (size_t b = 0; b < room; b++)
        places->bucket[b] = SIZE_MAX;
    for (size_t i = 0; i < places->count; i++)
        link_point(places, i);
    return true;
}

size_t places_add(struct places *places, const double point[3])
{
    size_t found = places_find(places, point);
    if (found != SIZE_MAX)
        return found;
    if (places->count == places->room && !grow(places))
        return SIZE_MAX;
    memcpy(places->points[places->count], point, sizeof *places->points);
    link_point(places, places->count);
    return places->count++;
}
