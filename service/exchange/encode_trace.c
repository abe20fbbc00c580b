/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/encode_trace.h"

#include <string.h>

enum { COLUMNS = 9 };

static size_t parts_of(const struct trace *trace)
{
    return (trace->count + TRACE_PART_INSTANTS - 1) / TRACE_PART_INSTANTS;
}

size_t encode_trace_room(const struct trace *trace)
{
    if (!trace)
        return 0;
    return answer_room(trace->contacts * parts_of(trace), sizeof(percuss_v1_Trace)) +
           trace->contacts * COLUMNS * answer_room(trace->count, sizeof(double));
}

/* Part of a column in each sample of a contact. */
static void fill_column(struct answer *answer, const struct trace *trace, const double *values,
                        dds_sequence_double *first)
{
    double *copy = answer_take(answer, trace->count, sizeof *copy);
    memcpy(copy, values, trace->count * sizeof *copy);
    for (size_t part = 0; part < parts_of(trace); part++) {
        /* the same member of the next sample */
        dds_sequence_double *list =
            (dds_sequence_double *)((char *)first + part * sizeof(percuss_v1_Trace));
        size_t start = part * TRACE_PART_INSTANTS;
        size_t left = trace->count - start;
        list->_buffer = copy + start;
        list->_length = (uint32_t)(left < TRACE_PART_INSTANTS ? left : TRACE_PART_INSTANTS);
        list->_maximum = list->_length;
        list->_release = false;
    }
}

void encode_trace(struct answer *answer, const struct envelope *envelope, const struct trace *trace)
{
    if (!trace)
        return;
    size_t parts = parts_of(trace);
    answer->trace_count = trace->contacts * parts;
    answer->traces = answer_take(answer, answer->trace_count, sizeof *answer->traces);
    for (size_t c = 0; c < trace->contacts; c++) {
        const struct trace_contact *contact = &trace->contact[c];
        percuss_v1_Trace *first = &answer->traces[c * parts];
        /* of which request, contact and part each sample is */
        for (size_t part = 0; part < parts; part++) {
            memcpy(first[part].client, envelope->client, sizeof first[part].client);
            first[part].sequence = envelope->sequence;
            first[part].contact = (uint32_t)c;
            first[part].part = (uint32_t)part;
            first[part].parts = (uint32_t)parts;
        }
        /* the histories, cut into the parts */
        fill_column(answer, trace, trace->time, &first->time);
        fill_column(answer, trace, contact->force, &first->force);
        fill_column(answer, trace, contact->indentation, &first->indentation);
        fill_column(answer, trace, contact->gap, &first->gap);
        fill_column(answer, trace, contact->gap_rate, &first->gap_rate);
        fill_column(answer, trace, contact->displacement[0], &first->displacement_a);
        fill_column(answer, trace, contact->velocity[0], &first->velocity_a);
        fill_column(answer, trace, contact->displacement[1], &first->displacement_b);
        fill_column(answer, trace, contact->velocity[1], &first->velocity_b);
    }
}
