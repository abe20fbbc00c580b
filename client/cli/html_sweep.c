/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The data of the page of a sweep (client/page/results.js): columns of each curve. */

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#include "html_page.h"
#include "json_writer.h"
#include "sweep_output.h"

/* Numbers of a row by the names of their columns in CSV. */
static const struct {
    const char *name;
    size_t offset;
} NUMBERS[] = {
    {"speed", offsetof(struct sweep_row, speed)},
    {"angle", offsetof(struct sweep_row, angle)},
    {"restitution", offsetof(struct sweep_row, restitution)},
    {"error", offsetof(struct sweep_row, error)},
    {"error_total", offsetof(struct sweep_row, error_total)},
    {"impulse", offsetof(struct sweep_row, impulse)},
    {"end_time", offsetof(struct sweep_row, end_time)},
    {"impulse_tangential_1", offsetof(struct sweep_row, impulse_tangential[0])},
    {"tangential_restitution", offsetof(struct sweep_row, tangential_restitution)},
};

/* NAN: not all sub-impacts are listed, or the row was read from a file. */
static double peak_force(const struct percuss_reply *reply)
{
    double peak = 0.0;
    if (reply->contact_count == 0 ||
        reply->contacts[0].sub_impacts_listed < reply->contacts[0].sub_impact_count)
        return NAN;
    for (uint32_t i = 0; i < reply->contacts[0].sub_impacts_listed; i++)
        peak = fmax(peak, reply->contacts[0].sub_impacts[i].peak_force);
    return peak;
}

static double impulse_error(const struct percuss_reply *reply)
{
    return reply->contact_count > 0 ? reply->contacts[0].impulse_error : NAN;
}

/* The columns that only the replies have. */
static bool add_of_replies(json_t *object, const struct sweep_curve *curve)
{
    json_t *peaks = json_array(), *errors = json_array();
    const struct percuss_reply nothing = {0};
    bool good = peaks && errors;
    for (unsigned i = 0; good && i < curve->done; i++) {
        const struct percuss_reply *reply = curve->replies ? &curve->replies[i] : &nothing;
        good = json_array_append_new(peaks, json_number(peak_force(reply))) == 0 &&
               json_array_append_new(errors, json_number(impulse_error(reply))) == 0;
    }
    good = json_object_set(object, "peak_force", peaks) == 0 && good;
    good = json_object_set(object, "impulse_error", errors) == 0 && good;
    json_decref(peaks);
    json_decref(errors);
    return good;
}

static bool add_of_rows(json_t *object, const struct sweep_curve *curve)
{
    json_t *counts = json_array(), *significant = json_array(), *status = json_array();
    bool good = counts && significant && status;
    for (unsigned i = 0; good && i < curve->done; i++) {
        const struct sweep_row *row = &curve->rows[i];
        good = json_array_append_new(counts, json_integer(row->sub_impacts)) == 0 &&
               json_array_append_new(significant, json_integer(row->significant)) == 0 &&
               json_array_append_new(status, json_string(row->status)) == 0;
    }
    good = json_object_set(object, "sub_impacts", counts) == 0 && good;
    good = json_object_set(object, "significant", significant) == 0 && good;
    good = json_object_set(object, "status", status) == 0 && good;
    json_decref(counts);
    json_decref(significant);
    json_decref(status);
    return good;
}

static json_t *curve_columns(const struct sweep_curve *curve)
{
    json_t *object = json_pack("{soss}", "b", json_text_or_null(curve->b), "contact_model",
                               curve->contact_model);
    bool good = object;
    for (size_t n = 0; good && n < sizeof NUMBERS / sizeof *NUMBERS; n++)
        good = json_object_set_new(object, NUMBERS[n].name,
                                   html_page_numbers((const char *)curve->rows + NUMBERS[n].offset,
                                                     sizeof *curve->rows, curve->done)) == 0;
    if (good && add_of_rows(object, curve) && add_of_replies(object, curve))
        return object;
    json_decref(object);
    return NULL;
}

static json_t *measured_impacts(const struct sweep_measured *measured)
{
    json_t *array = json_array();
    bool good = array;
    for (size_t i = 0; good && i < measured->set.count; i++) {
        const struct measured_impact *impact = &measured->set.impacts[i];
        good = json_array_append_new(
                   array, json_pack("{sosososo}", "speed", json_number(impact->speed),
                                    "restitution", json_number(impact->restitution), "half_width",
                                    json_number(measured_half_width(impact)), "sub_impacts",
                                    json_number(impact->sub_impacts))) == 0;
    }
    if (good)
        return array;
    json_decref(array);
    return NULL;
}

/* "trials.csv", or "trials.csv on al-beam". */
static json_t *measured_set_name(const struct sweep_measured *measured)
{
    return json_sprintf("%s%s%s", plot_file_name(measured->file), measured->b ? " on " : "",
                        measured->b ? measured->b : "");
}

json_t *sweep_to_page(const struct sweep_points *points)
{
    json_t *curves = json_array(), *measured = json_array();
    bool good = curves && measured;
    for (size_t k = 0; good && k < points->curve_count; k++)
        good = json_array_append_new(curves, curve_columns(&points->curves[k])) == 0;
    for (size_t k = 0; good && k < points->measured_count; k++)
        good = json_array_append_new(
                   measured, json_pack("{soso}", "name", measured_set_name(&points->measured[k]),
                                       "impacts", measured_impacts(&points->measured[k]))) == 0;
    if (!good) {
        json_decref(curves);
        json_decref(measured);
        return NULL;
    }
    json_t *title = sweep_bodies_differ(points) ? json_sprintf("%s on bodies at rest", points->a)
                                                : json_text_or_null(points->title);
    return json_pack(
        "{sssosssosbsbsosososs}", "kind", "sweep", "a", json_text_or_null(points->a),
        "request_note",
        "Or, with the same catalogue, its first point by this request, as percuss query "
        "--request FILE takes it:",
        "title", title, "by_angle", points->by_angle, "logarithmic", points->logarithmic, "curves",
        curves, "measured", measured, "warnings", tally_to_json(points->warnings), "version",
        PERCUSS_VERSION);
}
