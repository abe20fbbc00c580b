/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/response.h"

#include <stdlib.h>
#include <string.h>

struct response {
    size_t length, room;        /* of a row, and what there is memory for */
    double *row[2];             /* the key */
    unsigned long used;         /* when it was asked of last */
    int level[RESPONSE_LEVELS]; /* at level % RESPONSE_LEVELS; NONE: not yet */
    double block[RESPONSE_LEVELS][STEP_POINTS][NODES];
};

struct responses {
    unsigned long asked;
    struct response *of[RESPONSE_PAIRS]; /* NULL: not made yet, nor those behind it */
};

enum { NONE = -1 };

void responses_free(struct responses *kept)
{
    for (size_t i = 0; kept && i < RESPONSE_PAIRS && kept->of[i]; i++) {
        free(kept->of[i]->row[0]);
        free(kept->of[i]);
    }
    free(kept);
}

/* Other rows nearly always differ in their first number. */
static bool is_of(const struct response *response, const double *const rows[2], size_t length)
{
    size_t size = length * sizeof **rows;
    return response->length == length && response->row[0][0] == rows[0][0] &&
           memcmp(response->row[0], rows[0], size) == 0 &&
           memcmp(response->row[1], rows[1], size) == 0;
}

/* The key for rows of that length; what it was is gone. False: out of memory. */
static bool make_room(struct response *response, size_t length)
{
    response->length = 0;
    if (response->room >= length)
        return true;
    free(response->row[0]);
    response->row[0] = malloc(2 * length * sizeof **response->row);
    response->room = response->row[0] ? length : 0;
    return response->row[0] != NULL;
}

/* A new one, or else the one that was not asked of for longest. NULL: out of memory. */
static struct response *take(struct responses *kept)
{
    struct response **oldest = kept->of;
    for (struct response **each = kept->of; each < kept->of + RESPONSE_PAIRS; each++) {
        if (!*each)
            return *each = calloc(1, sizeof **each);
        if ((*each)->used < (*oldest)->used)
            oldest = each;
    }
    return *oldest;
}

struct response *responses_find(struct responses **kept, const double *const rows[2], size_t length)
{
    if (!*kept)
        *kept = calloc(1, sizeof **kept);
    if (!*kept || length == 0)
        return NULL;
    /* one that is known */
    unsigned long now = ++(*kept)->asked;
    for (size_t i = 0; i < RESPONSE_PAIRS && (*kept)->of[i]; i++)
        if (is_of((*kept)->of[i], rows, length)) {
            (*kept)->of[i]->used = now;
            return (*kept)->of[i];
        }
    /* or one without any level */
    struct response *made = take(*kept);
    if (!made || !make_room(made, length))
        return NULL;
    made->length = length;
    made->used = now;
    made->row[1] = made->row[0] + length;
    for (int which = 0; which < 2; which++)
        memcpy(made->row[which], rows[which], length * sizeof **rows);
    for (int i = 0; i < RESPONSE_LEVELS; i++)
        made->level[i] = NONE;
    return made;
}

double (*response_block(struct response *response, int level, bool *known))[NODES]
{
    int at = level % RESPONSE_LEVELS;
    *known = response->level[at] == level;
    if (!*known)
        memset(response->block[at], 0, sizeof response->block[at]);
    response->level[at] = level;
    return response->block[at];
}
