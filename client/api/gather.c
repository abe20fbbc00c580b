/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "gather.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"

/* Those of friction come last. */
enum { FRICTIONLESS = 9, COLUMNS = 13 };

/* The same columns on the wire and in a contact's trace. */
static void list_columns(const percuss_v1_Trace *wire, const dds_sequence_double *lists[COLUMNS])
{
    const dds_sequence_double *all[COLUMNS] = {
        &wire->time,
        &wire->force,
        &wire->indentation,
        &wire->gap,
        &wire->gap_rate,
        &wire->displacement_a,
        &wire->velocity_a,
        &wire->displacement_b,
        &wire->velocity_b,
        &wire->force_tangential_1,
        &wire->force_tangential_2,
        &wire->slip_1,
        &wire->slip_2,
    };
    memcpy(lists, all, sizeof all);
}

/* The first `columns` of a contact are one block that begins with `time`. */
static void place_columns(struct percuss_contact_trace *contact, size_t columns, double *block,
                          size_t room)
{
    double **all[COLUMNS] = {
        &contact->time,
        &contact->force,
        &contact->indentation,
        &contact->gap,
        &contact->gap_rate,
        &contact->displacement_a,
        &contact->velocity_a,
        &contact->displacement_b,
        &contact->velocity_b,
        &contact->force_tangential_1,
        &contact->force_tangential_2,
        &contact->slip_1,
        &contact->slip_2,
    };
    for (size_t i = 0; i < columns; i++)
        *all[i] = block + i * room;
}

/* Room for `needed` instants: by the received instants, not by the announced ones. */
static bool make_room(struct gather *gather, uint32_t c, size_t needed)
{
    struct percuss_contact_trace *contact = &gather->contacts[c];
    if (needed <= gather->room[c] && contact->time)
        return true;
    size_t room = needed > 2 * gather->room[c] ? needed : 2 * gather->room[c];
    size_t columns = gather->columns[c];
    double *block = calloc(columns * room + 1, sizeof *block);
    if (!block) {
        gather->out_of_memory = true;
        return false;
    }
    for (size_t i = 0; i < columns && contact->count > 0; i++)
        memcpy(block + i * room, contact->time + i * gather->room[c],
               contact->count * sizeof *block);
    free(contact->time);
    gather->room[c] = room;
    place_columns(contact, columns, block, room);
    return true;
}

void gather_add(struct gather *gather, const percuss_v1_Trace *wire)
{
    const dds_sequence_double *lists[COLUMNS];
    uint32_t c = wire->contact;
    list_columns(wire, lists);
    /* the parts of a history come in order: none is skipped */
    if (c >= PERCUSS_MAX_CONTACTS || wire->part != gather->next[c] || wire->part >= wire->parts)
        return;
    struct percuss_contact_trace *contact = &gather->contacts[c];
    size_t length = wire->time._length;
    if (wire->part == 0) {
        gather->parts[c] = wire->parts;
        gather->longest[c] = length;
        gather->columns[c] = wire->slip_1._length > 0 ? COLUMNS : FRICTIONLESS;
    }
    /* the first part is as long as any */
    if (wire->parts != gather->parts[c] || length > gather->longest[c] ||
        !make_room(gather, c, contact->count + length))
        return;
    for (size_t i = 0; i < gather->columns[c]; i++) {
        double *column = contact->time + i * gather->room[c] + contact->count;
        /* a column that the server does not know stays undefined */
        for (size_t k = 0; k < length; k++)
            column[k] = k < lists[i]->_length ? lists[i]->_buffer[k] : NAN;
    }
    contact->count += length;
    gather->next[c]++;
}

bool gather_is_complete(const struct gather *gather, size_t contacts)
{
    for (size_t c = 0; c < contacts && !gather->out_of_memory; c++)
        if (gather->parts[c] == 0 || gather->next[c] < gather->parts[c])
            return false;
    return true;
}

enum percuss_result gather_collect(struct gather *gather, size_t contacts,
                                   struct percuss_trace *trace)
{
    *trace = (struct percuss_trace){0};
    if (!gather->out_of_memory)
        trace->contacts = calloc(contacts + 1, sizeof *trace->contacts);
    if (!trace->contacts)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a trace of %zu contacts", contacts);
    trace->contact_count = contacts;
    memcpy(trace->contacts, gather->contacts, contacts * sizeof *trace->contacts);
    memset(gather->contacts, 0, contacts * sizeof *trace->contacts);
    return PERCUSS_RESULT_OK;
}

void gather_clear(struct gather *gather)
{
    for (size_t c = 0; c < PERCUSS_MAX_CONTACTS; c++)
        free(gather->contacts[c].time);
    *gather = (struct gather){0};
}

void percuss_trace_free(struct percuss_trace *trace)
{
    if (!trace)
        return;
    for (size_t c = 0; trace->contacts && c < trace->contact_count; c++)
        free(trace->contacts[c].time);
    free(trace->contacts);
    *trace = (struct percuss_trace){0};
}
