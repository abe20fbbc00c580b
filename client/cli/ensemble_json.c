/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "cli.h"
#include "ensemble_output.h"
#include "reply_json.h"

static void set(json_t *object, const char *name, double number)
{
    json_object_set_new(object, name, json_number(number));
}

static void set_count(json_t *object, const char *name, uint64_t count)
{
    json_object_set_new(object, name, json_integer((json_int_t)count));
}

static void set_text(json_t *object, const char *name, const char *text)
{
    json_t *value = json_string(text);
    json_object_set_new(object, name, value ? value : json_null());
}

static void set_octets(json_t *object, const char *name, const uint8_t octets[16])
{
    char text[33];
    format_hex(octets, text);
    set_text(object, name, text);
}

static void set_numbers(json_t *object, const char *name, const double *numbers, size_t count)
{
    json_t *array = json_array();
    for (size_t i = 0; i < count; ++i)
        json_array_append_new(array, json_number(numbers[i]));
    json_object_set_new(object, name, array);
}

static void set_counts(json_t *object, const char *name, const uint64_t *counts, size_t count)
{
    json_t *array = json_array();
    for (size_t i = 0; i < count; ++i)
        json_array_append_new(array, json_integer((json_int_t)counts[i]));
    json_object_set_new(object, name, array);
}

static json_t *statistic_to_json(const struct percuss_statistic *from)
{
    json_t *to = json_object();
    set_text(to, "quantity", from->quantity);
    set_count(to, "count", from->count);
    set(to, "mean", from->mean);
    set(to, "mean_low", from->mean_low);
    set(to, "mean_high", from->mean_high);
    set(to, "standard_deviation", from->standard_deviation);
    set(to, "standard_deviation_low", from->standard_deviation_low);
    set(to, "standard_deviation_high", from->standard_deviation_high);
    set(to, "skewness", from->skewness);
    set(to, "lowest", from->lowest);
    set(to, "highest", from->highest);
    set_numbers(to, "probabilities", from->probabilities, from->quantile_count);
    set_numbers(to, "quantiles", from->quantiles, from->quantile_count);
    set_numbers(to, "quantiles_low", from->quantiles_low, from->quantile_count);
    set_numbers(to, "quantiles_high", from->quantiles_high, from->quantile_count);
    set_numbers(to, "bin_edges", from->bin_edges, from->bin_count ? from->bin_count + 1 : 0);
    set_counts(to, "bin_counts", from->bin_counts, from->bin_count);
    set_numbers(to, "curve_values", from->curve_values, from->curve_count);
    set_numbers(to, "curve_shares", from->curve_shares, from->curve_count);
    return to;
}

static json_t *part_to_json(const struct percuss_input_part *from)
{
    json_t *to = json_object();
    set(to, "low", from->low);
    set(to, "high", from->high);
    set_count(to, "count", from->count);
    set(to, "mean", from->mean);
    set(to, "standard_deviation", from->standard_deviation);
    set(to, "local", from->local);
    json_object_set_new(to, "chaotic", json_boolean(from->chaotic));
    return to;
}

static json_t *sensitivity_to_json(const struct percuss_sensitivity *from)
{
    json_t *to = json_object(), *parts = json_array();
    set_text(to, "input", from->input);
    set_text(to, "body", from->body);
    set(to, "first_order", from->first_order);
    set(to, "first_order_low", from->first_order_low);
    set(to, "first_order_high", from->first_order_high);
    set(to, "noise", from->noise);
    set(to, "total", from->total);
    set(to, "total_low", from->total_low);
    set(to, "total_high", from->total_high);
    set(to, "mean", from->mean);
    set(to, "standard_deviation", from->standard_deviation);
    set(to, "lowest", from->lowest);
    set(to, "highest", from->highest);
    set(to, "resolution", from->resolution);
    for (size_t i = 0; i < from->part_count; ++i)
        json_array_append_new(parts, part_to_json(&from->parts[i]));
    json_object_set_new(to, "parts", parts);
    return to;
}

static json_t *interval_to_json(const struct percuss_sigma_interval *from)
{
    json_t *to = json_object();
    set(to, "sigmas", from->sigmas);
    set(to, "low", from->low);
    set(to, "high", from->high);
    set(to, "covered", from->covered);
    set(to, "unphysical", from->unphysical);
    set(to, "quantile_low", from->quantile_low);
    set(to, "quantile_high", from->quantile_high);
    return to;
}

static json_t *beta_to_json(const struct percuss_ensemble_reply *reply)
{
    json_t *to = json_object();
    set(to, "low", reply->beta.low);
    set(to, "high", reply->beta.high);
    set(to, "alpha", reply->beta.alpha);
    set(to, "beta", reply->beta.beta);
    set(to, "distance", reply->beta.distance);
    set(to, "p_value", reply->beta.p_value);
    return to;
}

static json_t *check_to_json(const struct percuss_ensemble_reply *reply)
{
    json_t *to = json_object();
    set_count(to, "count", reply->check.count);
    set(to, "within", reply->check.within);
    set(to, "largest", reply->check.largest);
    set(to, "mean_shift", reply->check.mean_shift);
    set(to, "mean_shift_half_width", reply->check.mean_shift_half_width);
    set(to, "standard_deviation_shift", reply->check.standard_deviation_shift);
    set(to, "quantile_shift", reply->check.quantile_shift);
    set(to, "within_low", reply->check.within_low);
    set(to, "within_high", reply->check.within_high);
    set_count(to, "unmet", reply->check.unmet);
    return to;
}

static void set_head(json_t *to, const struct percuss_ensemble_reply *reply)
{
    set_octets(to, "client", reply->client);
    set_count(to, "sequence", reply->sequence);
    set_octets(to, "server", reply->server);
    set_text(to, "catalogue_revision", reply->catalogue_revision);
    set_text(to, "version", reply->version);
    set_text(to, "status", percuss_status_name(reply->status));
    set_text(to, "message", reply->message);
    json_object_set_new(to, "complete", json_boolean(reply->complete));
    set_count(to, "samples", reply->samples);
    set_count(to, "requested", reply->requested);
    set_count(to, "refused", reply->refused);
    set_count(to, "truncated", reply->truncated);
}

static void set_model(json_t *to, const struct percuss_ensemble_reply *reply)
{
    json_object_set_new(to, "check", check_to_json(reply));
    set(to, "cut", reply->cut);
    set(to, "step_accuracy", reply->step_accuracy);
    set_count(to, "pilots", reply->pilots);
    set_count(to, "agreeing", reply->agreeing);
}

json_t *ensemble_to_json(const struct percuss_ensemble_reply *reply)
{
    json_t *to = json_object(), *statistics = json_array(), *intervals = json_array();
    json_t *sensitivities = json_array(), *warnings = json_array(), *timing = json_object();
    set_head(to, reply);
    for (size_t i = 0; i < reply->statistic_count; ++i)
        json_array_append_new(statistics, statistic_to_json(&reply->statistics[i]));
    json_object_set_new(to, "statistics", statistics);
    set_counts(to, "sub_impact_counts", reply->sub_impact_counts, reply->count_length);
    set_counts(to, "significant_counts", reply->significant_counts, reply->count_length);
    set(to, "possible_low", reply->possible_low);
    set(to, "possible_high", reply->possible_high);
    for (size_t i = 0; i < reply->interval_count; ++i)
        json_array_append_new(intervals, interval_to_json(&reply->intervals[i]));
    json_object_set_new(to, "intervals", intervals);
    json_object_set_new(to, "beta", beta_to_json(reply));
    for (size_t i = 0; i < reply->sensitivity_count; ++i)
        json_array_append_new(sensitivities, sensitivity_to_json(&reply->sensitivities[i]));
    json_object_set_new(to, "sensitivities", sensitivities);
    set_model(to, reply);
    for (size_t i = 0; i < reply->warning_count; ++i)
        json_array_append_new(warnings, json_string(reply->warnings[i]));
    json_object_set_new(to, "warnings", warnings);
    set(timing, "queue", reply->timing.queue);
    set(timing, "solve", reply->timing.solve);
    json_object_set_new(to, "timing", timing);
    return to;
}
