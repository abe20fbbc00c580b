/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "records.h"

#include <math.h>
#include <string.h>

/* Impulses applied to a pair since its last impact belong to that one. */
static void take_applied(struct records *records, uint32_t a, uint32_t b)
{
    double *applied = &records->engine->applied[a][b];
    for (size_t i = records->count; i-- > 0;)
        if (records->list[i].a == a && records->list[i].b == b) {
            records->list[i].applied = *applied;
            break;
        }
    *applied = 0.0;
}

static void write_sub_impacts(struct records *records, const struct percuss_slow_report *report,
                              size_t contact)
{
    const struct percuss_contact_result *result = &report->reply->contacts[contact];
    for (uint32_t i = 0; i < result->sub_impacts_listed; i++) {
        const struct percuss_sub_impact *sub = &result->sub_impacts[i];
        fprintf(records->sub_impacts, "%s,%d,%zu,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", records->scene,
                records->impacts, contact, report->time, sub->start, sub->end, sub->peak_force,
                sub->impulse, sub->gap_rate_after);
    }
}

static void print(const struct record *record)
{
    printf("  %3d.%zu  %11.9f  %8.5f  %9.6f  %10.7f  %8.6f", record->impact, record->contact + 1,
           record->time, record->gap_rate, record->delassus[record->contact], record->impulse,
           record->restitution);
    if (record->answered)
        printf("  %3u in %5.2f ms, error %.0e\n", record->sub_impacts, 1e3 * record->window,
               record->error);
    else
        printf("  declared\n");
}

static void print_friction(const struct percuss_reply *reply, size_t contact)
{
    const struct percuss_contact_result *result = &reply->contacts[contact];
    printf("         friction: tangential impulse %.7f N s, %s; the rigid bodies lose %.9g J, "
           "%.9g J of it by sliding\n",
           hypot(result->impulse_tangential[0], result->impulse_tangential[1]),
           percuss_friction_state_name(result->friction_state),
           reply->energy.available - reply->energy.rigid_after, reply->energy.friction);
}

void records_report(void *context, const struct percuss_slow_report *report)
{
    struct records *records = context;
    records->impacts++;
    for (size_t i = 0; i < report->count && records->count < RECORD_IMPACTS; i++) {
        take_applied(records, report->contacts[i].a, report->contacts[i].b);
        struct record *record = &records->list[records->count++];
        *record = (struct record){.impact = records->impacts,
                                  .contact = i,
                                  .count = report->count,
                                  .a = report->contacts[i].a,
                                  .b = report->contacts[i].b,
                                  .time = report->time,
                                  .gap_rate = report->gap_rate[i],
                                  .impulse = report->impulse[i],
                                  .restitution = report->restitution[i],
                                  .restitution_reply = NAN,
                                  .answered = report->reply != NULL};
        memcpy(record->delassus, report->delassus + i * report->count,
               report->count * sizeof(double));
        if (record->answered) {
            record->restitution_reply = report->reply->contacts[i].restitution;
            record->sub_impacts = report->reply->contacts[i].sub_impact_count;
            record->window = report->reply->window;
            record->error =
                report->reply->error.restitution_time + report->reply->error.restitution_modes;
            write_sub_impacts(records, report, i);
        }
        print(record);
        if (record->answered && report->reply->contacts[i].friction > 0.0)
            print_friction(report->reply, i);
    }
    if (report->message[0])
        printf("         %s\n", report->message);
}

void records_finish(struct records *records)
{
    for (uint32_t a = 0; a < ENGINE_BODIES; a++)
        for (uint32_t b = 0; b < ENGINE_BODIES; b++)
            take_applied(records, a, b);
}

void records_write(const struct records *records, FILE *file)
{
    for (size_t i = 0; i < records->count; i++) {
        const struct record *record = &records->list[i];
        fprintf(file, "%s,%d,%zu,%.12g,%.17g,%.17g,%.17g,%.17g,%.17g,%u,%s,", records->scene,
                record->impact, record->contact, record->time, record->gap_rate, record->impulse,
                record->applied, record->restitution, record->restitution_reply,
                record->sub_impacts, record->answered ? "percuss" : "declared");
        for (size_t j = 0; j < record->count; j++)
            fprintf(file, "%s%.12g", j ? ";" : "", record->delassus[j]);
        fprintf(file, "\n");
    }
}
