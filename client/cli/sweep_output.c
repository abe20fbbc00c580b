/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "sweep_output.h"

#include <jansson.h>
#include <math.h>
#include <percuss/percuss.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"
#include "csv.h"
#include "measured_file.h"
#include "reply_json.h"
#include "reply_table.h"

struct sweep_row sweep_row_of(const struct sweep_points *points, unsigned i,
                              const struct percuss_reply *reply)
{
    struct sweep_row row = {.speed = points->speeds[i],
                            .restitution = NAN,
                            .error = NAN,
                            .error_total = NAN,
                            .impulse = NAN,
                            .end_time = NAN,
                            .status = percuss_status_name(reply->status),
                            .angle = points->angles[i],
                            .impulse_tangential = {NAN, NAN},
                            .slip_after = {NAN, NAN},
                            .tangential_restitution = NAN,
                            .restitution_kinematic = NAN,
                            .friction_state = percuss_friction_state_name(0)};
    /* a refusal has no contacts */
    if (reply->contact_count > 0) {
        const struct percuss_contact_result *contact = &reply->contacts[0];
        row.restitution = contact->restitution;
        row.error = reply_restitution_error(reply);
        row.error_total = reply_total_error(reply);
        row.impulse = contact->impulse;
        row.sub_impacts = contact->sub_impact_count;
        row.significant = reply_significant(contact);
        row.end_time = contact->end_time;
        row.tangential_restitution = contact->tangential_restitution;
        row.restitution_kinematic = contact->restitution_kinematic;
        row.friction_state = percuss_friction_state_name(contact->friction_state);
        memcpy(row.impulse_tangential, contact->impulse_tangential, sizeof row.impulse_tangential);
        memcpy(row.slip_after, contact->slip_after, sizeof row.slip_after);
    }
    return row;
}

void sweep_print_row(const struct sweep_points *points, size_t k, unsigned i)
{
    const struct sweep_curve *curve = &points->curves[k];
    const struct sweep_row *row = &curve->rows[i];
    if (i == 0 && points->curve_count > 1)
        printf("%s%s on %s, contact model %s\n", k == 0 ? "" : "\n", points->a, curve->b,
               curve->contact_model);
    if (i == 0) {
        printf("%10s %12s %9s %9s %13s %11s %11s %12s", "speed m/s", "restitution", "error",
               "numerical", "impulse N s", "sub-impacts", "significant", "end time ms");
        if (points->askew)
            printf(" %9s %14s %12s %9s", "angle deg", "tangential N s", "tang. rest.", "slip");
        puts("  status");
    }
    printf("%10.5g %12.6f %9.1e %9.1e %13.6g %11u %11u %12.4f", row->speed, row->restitution,
           row->error_total, row->error, row->impulse, row->sub_impacts, row->significant,
           1e3 * row->end_time);
    if (points->askew)
        printf(" %9.5g %14.6g %12.6f %9s", row->angle, row->impulse_tangential[0],
               row->tangential_restitution, row->friction_state);
    printf("  %s\n", row->status);
}

void sweep_csv_head(const struct sweep_points *points, FILE *file)
{
    if (points->curve_count > 1)
        fputs("b,contact_model,", file);
    csv_head(file, "speed,restitution,error,impulse,sub_impacts,significant,end_time,status",
             points->units);
    if (points->askew)
        csv_head(file,
                 ",angle,impulse_tangential_1,impulse_tangential_2,slip_after_1,slip_after_2,"
                 "tangential_restitution,restitution_kinematic,friction_state",
                 points->units);
    csv_head(file, ",error_total", points->units);
    putc('\n', file);
}

void sweep_csv_row(const struct sweep_points *points, size_t k, unsigned i, FILE *file)
{
    const struct sweep_curve *curve = &points->curves[k];
    const struct sweep_row *row = &curve->rows[i];
    if (points->curve_count > 1)
        fprintf(file, "%s,%s,", curve->b, curve->contact_model);
    fprintf(file, "%.17g,%.17g,%.17g,%.17g,%u,%u,%.17g,%s", row->speed, row->restitution,
            row->error, row->impulse, row->sub_impacts, row->significant, row->end_time,
            row->status);
    if (points->askew)
        fprintf(file, ",%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%s", row->angle,
                row->impulse_tangential[0], row->impulse_tangential[1], row->slip_after[0],
                row->slip_after[1], row->tangential_restitution, row->restitution_kinematic,
                row->friction_state);
    fprintf(file, ",%.17g\n", row->error_total);
}

static json_t *curve_to_json(const struct sweep_curve *curve)
{
    json_t *array = json_array();
    for (unsigned i = 0; i < curve->done; i++) {
        struct sweep_row row = curve->rows[i];
        json_t *point = json_object();
        json_object_set_new(point, "speed", json_number(row.speed));
        json_object_set_new(point, "angle", json_number(row.angle));
        json_object_set_new(point, "restitution", json_number(row.restitution));
        json_object_set_new(point, "error", json_number(row.error));
        json_object_set_new(point, "error_total", json_number(row.error_total));
        json_object_set_new(point, "impulse", json_number(row.impulse));
        json_object_set_new(point, "sub_impacts", json_integer(row.sub_impacts));
        json_object_set_new(point, "significant", json_integer(row.significant));
        json_object_set_new(point, "end_time", json_number(row.end_time));
        json_object_set_new(point, "status", json_string(row.status));
        json_object_set_new(point, "reply", reply_to_json(&curve->replies[i]));
        json_array_append_new(array, point);
    }
    return array;
}

void sweep_print_json(const struct sweep_points *points)
{
    json_t *root = json_object(), *curves = json_array();
    for (size_t k = 0; k < points->curve_count; k++) {
        json_t *curve = json_object();
        json_object_set_new(curve, "b", json_string(points->curves[k].b));
        json_object_set_new(curve, "contact_model", json_string(points->curves[k].contact_model));
        json_object_set_new(curve, "points", curve_to_json(&points->curves[k]));
        json_array_append_new(curves, curve);
    }
    if (points->curve_count == 1) {
        json_object_set(root, "points", json_object_get(json_array_get(curves, 0), "points"));
        json_decref(curves);
    } else {
        json_object_set_new(root, "curves", curves);
    }
    json_object_set_new(root, "warnings", tally_to_json(points->warnings));
    json_print(root);
}

void sweep_measured_add(struct sweep_measurements *measurements, const char *text,
                        struct argp_state *state)
{
    if (measurements->count == SWEEP_MEASURED_MOST)
        argp_error(state, "--measured: '%s': at most %d files", text, SWEEP_MEASURED_MOST);
    struct sweep_measured *measured = &measurements->list[measurements->count++];
    const char *equals = strchr(text, '=');
    *measured = (struct sweep_measured){.file = text};
    /* a file's name may have one too */
    if (equals && access(text, F_OK) != 0) {
        measured->b = strndup(text, (size_t)(equals - text));
        measured->file = equals + 1;
        if (!measured->b)
            exit(complain_memory());
    }
}

static void check_measured(const struct sweep_measured *measured, const struct scene *scene,
                           struct argp_state *state)
{
    size_t b = 0;
    while (measured->b && b < scene->b_count && strcmp(scene->all_b[b], measured->b) != 0)
        b++;
    if (measured->b && b == scene->b_count)
        argp_error(state,
                   "--measured: '%s=%s': a body that --b names is needed before the =", measured->b,
                   measured->file);
}

void sweep_measured_read(struct sweep_measurements *measurements, const struct scene *scene,
                         bool is_drawn, struct argp_state *state)
{
    for (size_t i = 0; i < measurements->count; i++)
        check_measured(&measurements->list[i], scene, state);
    if (measurements->count > 0 && !is_drawn)
        argp_error(state,
                   "--measured is laid over a picture: --plot FILE or --html FILE is needed");
    for (size_t i = 0; i < measurements->count; i++) {
        struct measured_remarks remarks = {0};
        struct sweep_measured *measured = &measurements->list[i];
        bool good = measured_read(measured->file, &measurements->columns, &measured->set, &remarks);
        measured_file_complain("--measured: ", &remarks);
        if (!good)
            argp_error(state, "--measured: '%s' is not read", measured->file);
    }
}

void sweep_measured_free(struct sweep_measurements *measurements)
{
    for (size_t i = 0; i < measurements->count; i++) {
        free(measurements->list[i].b);
        measured_set_free(&measurements->list[i].set);
    }
    measurements->count = 0;
}
