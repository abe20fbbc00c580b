/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/participation.h"

#include <stdlib.h>
#include <string.h>

/* At one load, of the modes up to some. */
struct row {
    struct family_load load; /* the key, to the last byte */
    size_t known;            /* modes; 0: there is no such load yet */
    unsigned long used;      /* when it was asked of last */
    double *shape;           /* [modes] */
};

struct participations {
    unsigned long asked;
    struct row rows[PARTICIPATION_LOADS];
    size_t *index; /* [modes]: 0, 1, ... */
    double shapes[];
};

struct participations *participations_create(size_t modes)
{
    struct participations *kept =
        calloc(1, sizeof *kept + PARTICIPATION_LOADS * modes * sizeof *kept->shapes);
    if (!kept)
        return NULL;
    kept->index = malloc((modes + 1) * sizeof *kept->index);
    if (!kept->index) {
        free(kept);
        return NULL;
    }
    for (size_t k = 0; k < modes; k++)
        kept->index[k] = k;
    for (size_t i = 0; i < PARTICIPATION_LOADS; i++)
        kept->rows[i].shape = kept->shapes + i * modes;
    return kept;
}

void participations_free(struct participations *kept)
{
    if (!kept)
        return;
    free(kept->index);
    free(kept);
}

/* NULL: there is none of that load. */
static struct row *find_row(struct participations *kept, const struct family_load *load)
{
    for (struct row *row = kept->rows; row < kept->rows + PARTICIPATION_LOADS; row++)
        if (row->known > 0 && memcmp(&row->load, load, sizeof *load) == 0)
            return row;
    return NULL;
}

/* For that load, in place of the one that was not asked of for longest. */
static struct row *take_row(struct participations *kept, const struct family_load *load)
{
    struct row *oldest = kept->rows;
    for (struct row *row = kept->rows; row < kept->rows + PARTICIPATION_LOADS; row++)
        if (row->used < oldest->used)
            oldest = row;
    memcpy(&oldest->load, load, sizeof *load);
    oldest->known = 0;
    return oldest;
}

void participations_get(struct participations *kept, const struct body *body,
                        const struct modal_family *modes, const size_t *which, size_t count,
                        const struct family_load *load, double *shape)
{
    if (count == 0)
        return;
    struct row *row = find_row(kept, load);
    size_t wanted = which[count - 1] + 1;
    /* nobody pays for modes before those that are asked for */
    if (which[0] > (row ? row->known : 0)) {
        modal_participations(body, modes, which, count, load, shape);
        return;
    }
    if (!row)
        row = take_row(kept, load);
    if (wanted > row->known) {
        modal_participations(body, modes, kept->index + row->known, wanted - row->known, load,
                             row->shape + row->known);
        row->known = wanted;
    }
    row->used = ++kept->asked;
    for (size_t i = 0; i < count; i++)
        shape[i] = row->shape[which[i]];
}
