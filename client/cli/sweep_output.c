/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "sweep_output.h"

#include <jansson.h>
#include <math.h>
#include <percuss/percuss.h>
#include <stdio.h>

#include "reply_json.h"
#include "reply_table.h"

struct row {
    double speed, restitution, error, impulse;
    unsigned sub_impacts, significant;
    double end_time;
    const char *status;
};

static struct row row_of(const struct sweep_points *points, unsigned i)
{
    const struct percuss_reply *reply = &points->replies[i];
    struct row row = {.speed = points->speeds[i],
                      .restitution = NAN,
                      .error = NAN,
                      .impulse = NAN,
                      .end_time = NAN,
                      .status = percuss_status_name(reply->status)};
    if (reply->contact_count > 0) {
        const struct percuss_contact_result *contact = &reply->contacts[0];
        row.restitution = contact->restitution;
        row.error = reply_restitution_error(reply);
        row.impulse = contact->impulse;
        row.sub_impacts = contact->sub_impact_count;
        row.significant = reply_significant(contact);
        row.end_time = contact->end_time;
    }
    return row;
}

void sweep_print_table(const struct sweep_points *points)
{
    printf("%10s %12s %9s %13s %11s %11s %12s  %s\n", "speed m/s", "restitution", "error",
           "impulse N s", "sub-impacts", "significant", "end time ms", "status");
    for (unsigned i = 0; i < points->count; ++i) {
        struct row row = row_of(points, i);
        printf("%10.5g %12.6f %9.1e %13.6g %11u %11u %12.4f  %s\n", row.speed, row.restitution,
               row.error, row.impulse, row.sub_impacts, row.significant, 1e3 * row.end_time,
               row.status);
    }
}

void sweep_print_csv(const struct sweep_points *points)
{
    puts("speed,restitution,error,impulse,sub_impacts,significant,end_time,status");
    for (unsigned i = 0; i < points->count; ++i) {
        struct row row = row_of(points, i);
        printf("%.17g,%.17g,%.17g,%.17g,%u,%u,%.17g,%s\n", row.speed, row.restitution, row.error,
               row.impulse, row.sub_impacts, row.significant, row.end_time, row.status);
    }
}

void sweep_print_json(const struct sweep_points *points)
{
    json_t *root = json_object(), *array = json_array();
    json_object_set_new(root, "points", array);
    for (unsigned i = 0; i < points->count; ++i) {
        struct row row = row_of(points, i);
        json_t *point = json_object();
        json_object_set_new(point, "speed", json_number(row.speed));
        json_object_set_new(point, "restitution", json_number(row.restitution));
        json_object_set_new(point, "error", json_number(row.error));
        json_object_set_new(point, "impulse", json_number(row.impulse));
        json_object_set_new(point, "sub_impacts", json_integer(row.sub_impacts));
        json_object_set_new(point, "significant", json_integer(row.significant));
        json_object_set_new(point, "end_time", json_number(row.end_time));
        json_object_set_new(point, "status", json_string(row.status));
        json_object_set_new(point, "reply", reply_to_json(&points->replies[i]));
        json_array_append_new(array, point);
    }
    json_print(root);
}
