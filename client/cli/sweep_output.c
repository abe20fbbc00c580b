/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "sweep_output.h"

#include <jansson.h>
#include <math.h>
#include <percuss/percuss.h>
#include <stdio.h>
#include <string.h>

#include "cli.h"
#include "csv.h"
#include "plot.h"
#include "reply_json.h"
#include "reply_table.h"

struct sweep_row sweep_row_of(const struct percuss_reply *reply, double speed)
{
    struct sweep_row row = {.speed = speed,
                            .restitution = NAN,
                            .error = NAN,
                            .impulse = NAN,
                            .end_time = NAN,
                            .status = percuss_status_name(reply->status)};
    /* a refusal has no contacts */
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

void sweep_print_row(const struct sweep_points *points, size_t k, unsigned i)
{
    const struct sweep_curve *curve = &points->curves[k];
    const struct sweep_row *row = &curve->rows[i];
    if (i == 0 && points->curve_count > 1)
        printf("%s%s on %s, contact model %s\n", k == 0 ? "" : "\n", points->a, curve->b,
               curve->contact_model);
    if (i == 0)
        printf("%10s %12s %9s %13s %11s %11s %12s  %s\n", "speed m/s", "restitution", "error",
               "impulse N s", "sub-impacts", "significant", "end time ms", "status");
    printf("%10.5g %12.6f %9.1e %13.6g %11u %11u %12.4f  %s\n", row->speed, row->restitution,
           row->error, row->impulse, row->sub_impacts, row->significant, 1e3 * row->end_time,
           row->status);
}

void sweep_csv_head(const struct sweep_points *points, FILE *file)
{
    if (points->curve_count > 1)
        fputs("b,contact_model,", file);
    csv_head(file, "speed,restitution,error,impulse,sub_impacts,significant,end_time,status",
             points->units);
    putc('\n', file);
}

void sweep_csv_row(const struct sweep_points *points, size_t k, unsigned i, FILE *file)
{
    const struct sweep_curve *curve = &points->curves[k];
    const struct sweep_row *row = &curve->rows[i];
    if (points->curve_count > 1)
        fprintf(file, "%s,%s,", curve->b, curve->contact_model);
    fprintf(file, "%.17g,%.17g,%.17g,%.17g,%u,%u,%.17g,%s\n", row->speed, row->restitution,
            row->error, row->impulse, row->sub_impacts, row->significant, row->end_time,
            row->status);
}

static json_t *curve_to_json(const struct sweep_curve *curve)
{
    json_t *array = json_array();
    for (unsigned i = 0; i < curve->done; i++) {
        struct sweep_row row = curve->rows[i];
        json_t *point = json_object();
        json_object_set_new(point, "speed", json_number(row.speed));
        json_object_set_new(point, "restitution", json_number(row.restitution));
        json_object_set_new(point, "error", json_number(row.error));
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

static void write_data(const struct plot *plot, const struct sweep_points *points)
{
    for (size_t k = 0; k < points->curve_count; k++) {
        fprintf(plot->script, "$curve%zu << EOD\n", k);
        for (unsigned i = 0; i < points->curves[k].done; i++) {
            struct sweep_row row = points->curves[k].rows[i];
            if (row.sub_impacts > 0)
                fprintf(plot->script, "%.9g %.9g %.3g %u %u\n", row.speed, row.restitution,
                        isnan(row.error) ? 0.0 : row.error, row.sub_impacts, row.significant);
        }
        fputs("EOD\n", plot->script);
    }
}

/* Restitutions that were measured; what is known by its impulse alone is no point here. */
static void write_measured(const struct plot *plot, const struct sweep_points *points)
{
    for (size_t k = 0; k < points->measured_count; k++) {
        const struct measured_set *set = &points->measured[k].set;
        fprintf(plot->script, "$measured%zu << EOD\nnan nan nan\n", k);
        for (size_t i = 0; i < set->count; i++)
            fprintf(plot->script, "%.9g %.9g %.9g\n", set->impacts[i].speed,
                    set->impacts[i].restitution, set->impacts[i].sub_impacts);
        fputs("EOD\n", plot->script);
    }
}

/* Points of every measured set, column 2 or 3 over the speed. */
static void plot_measured(const struct plot *plot, const struct sweep_points *points, int column)
{
    for (size_t k = 0; k < points->measured_count; k++) {
        const char *slash = strrchr(points->measured[k].file, '/');
        fprintf(plot->script, ", $measured%zu using 1:%d with points pt %zu ps 1 lc rgb 'black' ",
                k, column, k % 2 ? 6 + 2 * k : 4 + 2 * k);
        fputs(column == 2 ? "title " : "notitle", plot->script);
        if (column == 2)
            plot_text(plot, slash ? slash + 1 : points->measured[k].file);
    }
}

static bool bodies_differ(const struct sweep_points *points)
{
    for (size_t k = 1; k < points->curve_count; k++)
        if (strcmp(points->curves[k].b, points->curves->b))
            return true;
    return false;
}

/* What tells the curves apart: the bodies, the models or both. */
static void write_title(const struct plot *plot, const struct sweep_points *points, size_t k)
{
    const struct sweep_curve *curve = &points->curves[k], *first = points->curves;
    bool models = false;
    char title[160];
    for (size_t i = 1; i < points->curve_count; i++)
        models = models || strcmp(points->curves[i].contact_model, first->contact_model);
    if (models)
        snprintf(title, sizeof title, "%s, %s", curve->b, curve->contact_model);
    else
        snprintf(title, sizeof title, "%s", bodies_differ(points) ? curve->b : "estimated error");
    plot_text(plot, title);
}

int sweep_plot(const char *file, const struct sweep_points *points)
{
    struct plot plot;
    char title[160];
    int code = plot_begin(&plot, file, 1000, 800);
    if (code != EXIT_ANSWERED)
        return code;
    write_data(&plot, points);
    write_measured(&plot, points);
    snprintf(title, sizeof title, "%s on %s%s", points->a, points->curves[0].b,
             bodies_differ(points) ? " and others" : "");
    fputs("set multiplot title ", plot.script);
    plot_text(&plot, title);
    /* above, restitution with its error */
    fputs("\nset lmargin 10\nset key outside top center horizontal\nset bars 0.5\n"
          "set origin 0,0.32\nset size 1,0.64\nset ylabel 'restitution e'\nplot ",
          plot.script);
    for (size_t k = 0; k < points->curve_count; k++) {
        fprintf(plot.script,
                "%s$curve%zu using 1:2 with lines lt %zu lw 1 notitle, "
                "$curve%zu using 1:2:3 with yerrorbars lt %zu lw 1 ps 0.6 title ",
                k ? ", " : "", k, k + 1, k, k + 1);
        write_title(&plot, points, k);
    }
    plot_measured(&plot, points, 2);
    /* below, numbers of sub-impacts */
    fputs("\nset origin 0,0\nset size 1,0.33\nset key inside top left\nset ylabel 'sub-impacts'\n"
          "set xlabel 'speed / (m/s)'\nset yrange [0:*]\nset offsets 0,0,0.5,0\nset ytics 1\nplot ",
          plot.script);
    for (size_t k = 0; k < points->curve_count; k++)
        fprintf(plot.script,
                "%s$curve%zu using 1:4 with points lt %zu pt 6 ps 0.9 %s, "
                "$curve%zu using 1:5 with points lt %zu pt 7 ps 0.4 %s",
                k ? ", " : "", k, k + 1, k ? "notitle" : "title 'all'", k, k + 1,
                k ? "notitle" : "title 'without negligible ones'");
    plot_measured(&plot, points, 3);
    fputs("\nunset multiplot\n", plot.script);
    return plot_end(&plot);
}
