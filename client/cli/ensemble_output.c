/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The reply to an ensemble: as a table, as JSON and as a picture. */

#include "ensemble_output.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "csv.h"
#include "fold.h"
#include "html_page.h"
#include "json_schema.h"
#include "json_writer.h"
#include "others.h"
#include "plot_ensemble.h"
#include "request_json.h"

/* A table. */

/* "[low, high]" with a word for bounds that so few samples cannot give. */
struct bounds_text {
    char text[64];
};

static struct bounds_text bounds_of(double low, double high)
{
    struct bounds_text bounds;
    char ends[2][24];
    const double values[] = {low, high};
    for (int i = 0; i < 2; i++)
        snprintf(ends[i], sizeof ends[i], isnan(values[i]) ? "?" : "%.4f", values[i]);
    snprintf(bounds.text, sizeof bounds.text, "[%s, %s]", ends[0], ends[1]);
    return bounds;
}

/* No sample, one, or many that are equal: at most a value, and no distribution. */
static bool varies(const struct percuss_statistic *e)
{
    return e->standard_deviation > 0.0;
}

static void print_value(const struct percuss_statistic *e)
{
    if (e->count == 0)
        printf("  restitution: no sample has one\n");
    else if (e->count == 1)
        printf("  restitution %.4f from a single sample\n", e->mean);
    else
        printf("  restitution %.4f from each of %llu samples: it does not vary\n", e->mean,
               (unsigned long long)e->count);
}

static void print_restitution(const struct percuss_statistic *e)
{
    printf("  restitution         95 %% confidence\n");
    printf("    mean      %.4f  %s\n", e->mean, bounds_of(e->mean_low, e->mean_high).text);
    printf("    deviation %.4f  %s\n", e->standard_deviation,
           bounds_of(e->standard_deviation_low, e->standard_deviation_high).text);
    printf("    skewness  %+.3f\n", e->skewness);
    printf("    range     %.4f .. %.4f\n", e->lowest, e->highest);
    for (size_t i = 0; i < e->quantile_count; i++)
        printf("    %6.4g %%  %.4f  %s\n", 100.0 * e->probabilities[i], e->quantiles[i],
               bounds_of(e->quantiles_low[i], e->quantiles_high[i]).text);
}

static void print_histogram(const struct percuss_statistic *e)
{
    enum { WIDEST = 50, LEAST = 4, BEFORE = 30 };
    static const char bar[WIDEST + 1] = "##################################################";
    uint64_t most = 1;
    /* beside the numbers, if there is room */
    const size_t width = fold_width(), room = width > BEFORE + LEAST ? width - BEFORE : LEAST;
    const uint64_t wide = width == 0 || room > WIDEST ? WIDEST : room;
    for (size_t i = 0; i < e->bin_count; i++)
        most = e->bin_counts[i] > most ? e->bin_counts[i] : most;
    printf("\n");
    for (size_t i = 0; i < e->bin_count; i++)
        printf("  %7.4f .. %7.4f %8llu %.*s\n", e->bin_edges[i], e->bin_edges[i + 1],
               (unsigned long long)e->bin_counts[i], (int)(wide * e->bin_counts[i] / most), bar);
}

/* Statistics without friction. */
enum { PLAIN = 4 };

static void print_others(const struct percuss_ensemble_reply *reply)
{
    int width = 12;
    for (size_t i = 1; i < reply->statistic_count; i++)
        width = (int)fmax(width, (double)strlen(reply->statistics[i].quantity));
    printf("\n  %-*s %12s %12s %12s %12s %12s\n", width, "", "mean", "deviation", "lowest",
           "median", "highest");
    for (size_t i = 1; i < reply->statistic_count; i++) {
        const struct percuss_statistic *s = &reply->statistics[i];
        double median = NAN;
        for (size_t k = 0; k < s->quantile_count; k++)
            if (s->probabilities[k] == 0.5)
                median = s->quantiles[k];
        /* a group has no kinematic restitution, a contact without slip no tangential one */
        if (i >= PLAIN && s->count == 0)
            continue;
        printf("  %-*s %12.5g %12.5g %12.5g %12.5g %12.5g\n", width, s->quantity, s->mean,
               s->standard_deviation, s->lowest, median, s->highest);
    }
}

static void print_sub_impacts(const struct percuss_ensemble_reply *reply)
{
    double all = (double)(reply->samples - reply->refused);
    printf("\n  sub-impacts   share/%%   without negligible ones/%%\n");
    for (size_t k = 0; k < reply->count_length; k++)
        if (reply->sub_impact_counts[k] || reply->significant_counts[k])
            printf("  %11zu %9.3f %12.3f\n", k, 100.0 * (double)reply->sub_impact_counts[k] / all,
                   100.0 * (double)reply->significant_counts[k] / all);
}

static void print_intervals(const struct percuss_ensemble_reply *reply)
{
    printf("\n  mean -+ k deviations     samples/%%  impossible/%%   quantiles instead\n");
    for (size_t i = 0; i < reply->interval_count; i++) {
        const struct percuss_sigma_interval *s = &reply->intervals[i];
        printf("  %3.1f [%8.4f, %7.4f] %9.1f %12.1f      [%.4f, %.4f]\n", s->sigmas, s->low,
               s->high, 100.0 * s->covered, 100.0 * s->unphysical, s->quantile_low,
               s->quantile_high);
    }
    if (!isnan(reply->beta.alpha))
        printf("  Beta(%.3g, %.3g) is %.3g away (p %s %.2g)%s\n", reply->beta.alpha,
               reply->beta.beta, reply->beta.distance, reply->beta.p_value < 1e-9 ? "<" : "=",
               fmax(reply->beta.p_value, 1e-9),
               reply->beta.p_value < 0.05 ? ": it does not describe this distribution" : "");
}

/* Ranges of one input where the restitution is chaotic, neighbours together. */
static void print_chaos(const struct percuss_sensitivity *input)
{
    size_t known = 0, chaotic = 0;
    /* parts with a known spread, which is chaos */
    for (size_t i = 0; i < input->part_count; i++) {
        known += !isnan(input->parts[i].local);
        chaotic += input->parts[i].chaotic;
    }
    if (known == 0)
        return;
    printf("\n  known to %.3g, %s leaves more than half of the spread in", input->resolution,
           input->input);
    if (chaotic == 0)
        printf(" no part of its range");
    /* neighbours as one range */
    for (size_t i = 0; i < input->part_count; i++) {
        if (!input->parts[i].chaotic)
            continue;
        size_t last = i;
        while (last + 1 < input->part_count && input->parts[last + 1].chaotic)
            last++;
        printf(" %.4g..%.4g", input->parts[i].low, input->parts[last].high);
        i = last;
    }
    printf("\n");
}

/* One index with its interval; nothing where it was not found. */
static void print_index(double value, double low, double high)
{
    char ends[2][16];
    const double bounds[] = {low, high};
    if (isnan(value))
        return;
    for (int i = 0; i < 2; i++)
        snprintf(ends[i], sizeof ends[i], isnan(bounds[i]) ? "?" : "%.3f", bounds[i]);
    printf(" %7.3f [%s, %s]", value, ends[0], ends[1]);
}

/* A line an input; of several tangential impulses their names too. */
static void print_indices(const struct percuss_sensitivity *list, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const struct percuss_sensitivity *s = &list[i];
        char name[160];
        snprintf(name, sizeof name, "%s%s%s", s->input, s->body[0] ? "@" : "", s->body);
        if (i == 0 || strcmp(s->quantity, list[i - 1].quantity) != 0)
            if (s->quantity[0] && strcmp(s->quantity, "restitution") != 0)
                printf("  of %s\n", s->quantity);
        printf("  %-24s", name);
        print_index(s->first_order, s->first_order_low, s->first_order_high);
        print_index(s->total, s->total_low, s->total_high);
        printf("\n");
    }
}

static void print_heading(void)
{
    printf("\n  share of the variance that an input explains by itself, and that is left when all "
           "others are known,\n  with 95 %% confidence\n");
}

static void print_sensitivities(const struct percuss_ensemble_reply *reply)
{
    const struct percuss_sensitivity *leading = NULL;
    print_heading();
    print_indices(reply->sensitivities, reply->sensitivity_count);
    for (size_t i = 0; i < reply->sensitivity_count; i++)
        if (!leading || reply->sensitivities[i].first_order > leading->first_order)
            leading = &reply->sensitivities[i];
    /* of the others it says only that this one is not known */
    if (leading)
        print_chaos(leading);
}

static void print_tangential(const struct percuss_ensemble_reply *reply)
{
    if (reply->tangential_sensitivity_count == 0)
        return;
    print_heading();
    print_indices(reply->tangential_sensitivities, reply->tangential_sensitivity_count);
}

static void print_model(const struct percuss_ensemble_reply *reply)
{
    printf("\n  %llu samples in %.3g s", (unsigned long long)reply->samples, reply->timing.solve);
    if (reply->refused || reply->truncated)
        printf(" (%llu refused, %llu truncated)", (unsigned long long)reply->refused,
               (unsigned long long)reply->truncated);
    printf(", modes up to %.4g Hz\n", reply->cut);
    if (reply->check.count == 0)
        return;
    printf("  against the full accuracy search (%llu samples): %.1f %% within the tolerance",
           (unsigned long long)reply->check.count, 100.0 * reply->check.within);
    /* an older server does not say */
    if (!isnan(reply->check.within_high))
        printf(" (of all %.1f to %.1f %%)", 100.0 * reply->check.within_low,
               100.0 * reply->check.within_high);
    printf(",\n  the largest difference %.1e, the mean off by %.1e -+ %.1e\n", reply->check.largest,
           reply->check.mean_shift, reply->check.mean_shift_half_width);
}

static void print_distribution(const struct percuss_ensemble_reply *reply)
{
    const struct percuss_statistic *e = &reply->statistics[0];
    if (varies(e)) {
        print_restitution(e);
        print_histogram(e);
    }
    print_sub_impacts(reply);
    print_others(reply);
    if (varies(e)) {
        print_intervals(reply);
        print_sensitivities(reply);
    }
    print_tangential(reply);
}

/* What most people want to know, in six lines: the mean, the spread, the numbers of sub-impacts,
 * the largest cause, and how far the samples are to be trusted. */

/* Between which quantiles most of them lie: the outermost ones. */
static void summarize_restitution(const struct percuss_statistic *e)
{
    printf("  restitution  mean %.4f, 95 %% confidence %s\n", e->mean,
           bounds_of(e->mean_low, e->mean_high).text);
    printf("  spread       deviation %.4f, from %.4f to %.4f", e->standard_deviation, e->lowest,
           e->highest);
    const size_t last = e->quantile_count - 1;
    if (e->quantile_count > 1)
        printf(", %.4g %% between %.4f and %.4f",
               100.0 * (e->probabilities[last] - e->probabilities[0]), e->quantiles[0],
               e->quantiles[last]);
    putchar('\n');
}

/* Shares of samples below that are told together. */
static const double RARE = 0.01;

static void summarize_sub_impacts(const struct percuss_ensemble_reply *reply)
{
    const double all = (double)(reply->samples - reply->refused);
    double others = 0.0;
    const char *before = "  sub-impacts  ";
    for (size_t k = 0; k < reply->count_length; k++) {
        double share = (double)reply->sub_impact_counts[k] / all;
        if (share < RARE) {
            others += share;
            continue;
        }
        printf("%s%zu in %.3g %%", before, k, 100.0 * share);
        before = ", ";
    }
    if (others > 0.0)
        printf("%sothers in %.2g %%", before, 100.0 * others);
    putchar('\n');
}

/* The input that explains most by itself; nothing where a single one varies. */
static void summarize_cause(const struct percuss_ensemble_reply *reply)
{
    const struct percuss_sensitivity *leading = NULL;
    for (size_t i = 0; i < reply->sensitivity_count; i++)
        if (!leading || reply->sensitivities[i].first_order > leading->first_order)
            leading = &reply->sensitivities[i];
    if (!leading || isnan(leading->first_order))
        return;
    printf("  cause        %s%s%s: %.0f %% of the variance by itself\n", leading->input,
           leading->body[0] ? "@" : "", leading->body, 100.0 * leading->first_order);
}

static void summarize_samples(const struct percuss_ensemble_reply *reply)
{
    printf("  samples      %llu in %.3g s", (unsigned long long)reply->samples,
           reply->timing.solve);
    if (reply->refused || reply->truncated)
        printf(" (%llu refused, %llu truncated)", (unsigned long long)reply->refused,
               (unsigned long long)reply->truncated);
    if (reply->check.count > 0)
        printf("; %.1f %% of %llu solved again are within the tolerance",
               100.0 * reply->check.within, (unsigned long long)reply->check.count);
    putchar('\n');
}

static void print_summary(const struct percuss_ensemble_reply *reply, bool whole)
{
    const struct percuss_statistic *e = &reply->statistics[0];
    if (varies(e))
        summarize_restitution(e);
    else
        print_value(e);
    summarize_sub_impacts(reply);
    if (varies(e))
        summarize_cause(reply);
    summarize_samples(reply);
    if (!whole)
        printf("  more         with -v: quantiles, histogram, intervals, shares of all inputs\n");
}

void ensemble_print_table(const struct percuss_ensemble_request *request,
                          const struct percuss_ensemble_reply *reply, bool whole)
{
    if (reply->statistic_count > 0) {
        const struct percuss_contact *contact = &request->scene.contacts[request->contact];
        printf("%s on %s, %s sampling\n", request->scene.bodies[contact->a].id,
               request->scene.bodies[contact->b].id, percuss_sampling_name(request->sampling));
        print_summary(reply, whole);
    }
    if (reply->statistic_count > 0 && whole) {
        putchar('\n');
        print_distribution(reply);
        print_model(reply);
        print_server_line(reply->server, reply->catalogue_revision);
    }
    if (reply->message[0])
        fprintf(stderr, "percuss: %s: %s\n", percuss_status_name(reply->status), reply->message);
    for (size_t i = 0; i < reply->warning_count; i++)
        fprintf(stderr, "percuss: warning: %s\n", reply->warnings[i]);
}

/* Columns of the listed samples behind the inputs, and behind these with friction. */
enum { RESTITUTION, SIGNIFICANT = 5, STATUS, RESULTS, TANGENTIAL = 4 };
static const char *const result_names[RESULTS + TANGENTIAL] = {
    "restitution",
    "impulse",
    "end_time",
    "peak_force",
    "sub_impacts",
    "significant",
    "status",
    "impulse_tangential_1",
    "impulse_tangential_2",
    "tangential_restitution",
    "restitution_kinematic",
};

static void write_head(FILE *stream, const struct percuss_ensemble_request *request,
                       bool tangential, bool units)
{
    for (size_t i = 0; i < request->input_count; i++) {
        const struct percuss_input *input = &request->inputs[i];
        char name[sizeof input->name + sizeof input->body + 2];
        snprintf(name, sizeof name, "%s%s%s", input->name, input->body[0] ? "@" : "", input->body);
        csv_head(stream, name, units);
        putc(',', stream);
    }
    for (size_t c = 0; c < (tangential ? RESULTS + TANGENTIAL : RESULTS); c++) {
        fputs(c > 0 ? "," : "", stream);
        csv_head(stream, result_names[c], units);
    }
    putc('\n', stream);
}

/* Columns of the listed samples; 0: they did not arrive. */
static size_t column_count(const struct percuss_ensemble_request *request,
                           const struct percuss_ensemble_reply *reply)
{
    size_t plain = request->input_count + RESULTS, columns = reply->column_count;
    return reply->rows && (columns == plain || columns == plain + TANGENTIAL) ? columns : 0;
}

bool ensemble_write_csv(const char *file, const struct percuss_ensemble_request *request,
                        const struct percuss_ensemble_reply *reply, bool units)
{
    const size_t plain = request->input_count + RESULTS, columns = column_count(request, reply);
    if (columns == 0) {
        complain("%s: the samples did not arrive", file);
        return false;
    }
    FILE *stream = fopen(file, "w");
    if (!stream) {
        complain("%s: %s", file, strerror(errno));
        return false;
    }
    write_head(stream, request, columns > plain, units);
    for (uint64_t i = 0; i < reply->samples; i++) {
        /* inputs and results; two counts, and a status by its name */
        const double *row = reply->rows + i * columns;
        for (size_t c = 0; c + 3 < plain; c++)
            fprintf(stream, "%.17g,", row[c]);
        fprintf(stream, "%.0f,%.0f,%s", row[plain - 3], row[plain - 2],
                percuss_status_name((unsigned)row[plain - 1]));
        for (size_t c = plain; c < columns; c++)
            fprintf(stream, ",%.17g", row[c]);
        putc('\n', stream);
    }
    /* a full disk may show only at the end */
    bool failed = ferror(stream) != 0;
    failed = fclose(stream) != 0 || failed;
    if (failed)
        complain("%s: could not be written", file);
    return !failed;
}

/* JSON. */

JSON_TABLE(statistic, PERCUSS_STATISTIC_FIELDS)
JSON_TABLE(input_part, PERCUSS_INPUT_PART_FIELDS)
JSON_TABLE(sensitivity, PERCUSS_SENSITIVITY_FIELDS)
JSON_TABLE(sigma_interval, PERCUSS_SIGMA_INTERVAL_FIELDS)
JSON_TABLE(beta_fit, PERCUSS_BETA_FIT_FIELDS)
JSON_TABLE(ensemble_check, PERCUSS_ENSEMBLE_CHECK_FIELDS)
JSON_TABLE(timing, PERCUSS_TIMING_FIELDS)

#define ALL_FIELDS(F, L) PERCUSS_HEAD_FIELDS(F) PERCUSS_ENSEMBLE_REPLY_FIELDS(F, L)
JSON_TABLE(ensemble_reply, ALL_FIELDS)

json_t *ensemble_to_json(const struct percuss_ensemble_reply *reply)
{
    return json_object_of(ensemble_reply_members(), reply);
}

json_t *ensemble_schema(void)
{
    return json_schema(ensemble_reply_members(), false);
}

/* A page. */

/* More points cannot be told apart. */
enum { SAMPLES_SHOWN = 4000 };

static json_t *column_names(const struct percuss_ensemble_request *request, size_t columns)
{
    json_t *names = json_array();
    bool good = names;
    for (size_t c = 0; good && c < columns; c++) {
        const struct percuss_input *input = &request->inputs[c];
        json_t *name =
            c >= request->input_count
                ? json_string(result_names[c - request->input_count])
                : json_sprintf("%s%s%s", input->name, input->body[0] ? "@" : "", input->body);
        good = json_array_append_new(names, name) == 0;
    }
    if (good)
        return names;
    json_decref(names);
    return NULL;
}

struct samples {
    const double *rows;
    size_t count, columns;
};

static void put_samples(FILE *out, const void *context)
{
    const struct samples *samples = context;
    fputs(",\"samples\":[", out);
    for (size_t i = 0; i < samples->count; i++) {
        fputs(i ? "," : "", out);
        html_page_put_numbers(out, samples->rows + i * samples->columns, samples->columns);
    }
    fputc(']', out);
}

int ensemble_write_page(const char *file, const char *title,
                        const struct percuss_ensemble_request *request,
                        const struct percuss_ensemble_reply *reply, const struct common *common)
{
    const size_t columns = column_count(request, reply);
    const struct samples samples = {.rows = reply->rows,
                                    .columns = columns,
                                    .count = columns == 0 ? 0
                                             : reply->samples > SAMPLES_SHOWN
                                                 ? SAMPLES_SHOWN
                                                 : (size_t)reply->samples};
    json_t *data = json_pack(
        "{sssosssososo}", "kind", "ensemble", "title", json_text_or_null(title), "request_note",
        "Or, with the same catalogue, the impact in the middle of the inputs by this request, as "
        "percuss query --request FILE takes it:",
        "request", request_to_json(&request->scene), "reply", ensemble_to_json(reply), "columns",
        column_names(request, columns));
    return html_page_write(file, data, put_samples, &samples, common);
}

/* A picture. */

/* The memory that a picture's arrays lie in. */
struct columns {
    double *speeds; /* and restitutions, and numbers of sub-impacts */
    struct input_share shares[PERCUSS_MAX_INPUTS];
    char texts[PERCUSS_MAX_INPUTS][2 * PERCUSS_ID_SIZE];
    double *lows; /* and highs of the intervals */
};

/* A fixed speed has no panel. */
static bool speed_column(const struct percuss_ensemble_request *request, size_t *column)
{
    for (size_t i = 0; i < request->input_count; i++) {
        *column = i;
        if (!strcmp(request->inputs[i].name, "speed"))
            return request->inputs[i].distribution != PERCUSS_DISTRIBUTION_CONSTANT;
    }
    return false;
}

/* One sample has no deviation. False: they did not arrive, or out of memory; complains. */
static bool take_samples(const struct percuss_ensemble_request *request,
                         const struct percuss_ensemble_reply *reply, struct columns *columns,
                         struct ensemble_picture *picture)
{
    size_t count = reply->samples, speed;
    if (count < 2 || !speed_column(request, &speed))
        return true;
    if (!reply->rows || reply->column_count < request->input_count + RESULTS) {
        complain("--plot: the samples did not arrive");
        return false;
    }
    double *speeds = malloc(3 * count * sizeof *speeds);
    if (!speeds) {
        complain("--plot: out of memory");
        return false;
    }
    /* from rows to columns */
    for (size_t i = 0; i < count; i++) {
        const double *row = reply->rows + i * reply->column_count;
        const double *results = row + request->input_count;
        speeds[i] = row[speed];
        speeds[count + i] = results[RESTITUTION];
        speeds[2 * count + i] = results[SIGNIFICANT];
    }
    columns->speeds = speeds;
    picture->sample_count = count;
    picture->speeds = speeds;
    picture->restitutions = speeds + count;
    picture->sub_impacts = speeds + 2 * count;
    return true;
}

/* A single input causes everything: no panel. */
static void take_sensitivities(const struct percuss_ensemble_reply *reply, struct columns *columns,
                               struct ensemble_picture *picture)
{
    size_t count = reply->sensitivity_count;
    if (count < 2 || count > PERCUSS_MAX_INPUTS)
        return;
    for (size_t i = 0; i < count; i++) {
        const struct percuss_sensitivity *s = &reply->sensitivities[i];
        snprintf(columns->texts[i], sizeof columns->texts[i], "%s%s%s", s->input,
                 s->body[0] ? "@" : "", s->body);
        columns->shares[i] = (struct input_share){
            .name = columns->texts[i],
            .first_order = {s->first_order, s->first_order_low, s->first_order_high},
            .total = {s->total, s->total_low, s->total_high},
        };
    }
    picture->input_count = count;
    picture->inputs = columns->shares;
}

static bool take_intervals(const struct percuss_ensemble_reply *reply, struct columns *columns,
                           struct ensemble_picture *picture)
{
    size_t count = reply->interval_count;
    columns->lows = malloc((2 * count + 1) * sizeof *columns->lows);
    if (!columns->lows) {
        complain("--plot: out of memory");
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        columns->lows[i] = reply->intervals[i].low;
        columns->lows[count + i] = reply->intervals[i].high;
    }
    picture->interval_count = isnan(picture->deviation) ? 0 : count;
    picture->intervals_low = columns->lows;
    picture->intervals_high = columns->lows + count;
    return true;
}

int ensemble_plot(const struct plot_output *output, const char *scene,
                  const struct percuss_ensemble_request *request,
                  const struct percuss_ensemble_reply *reply)
{
    const struct percuss_statistic *e = &reply->statistics[0];
    char title[600];
    struct columns columns = {0};
    struct ensemble_picture picture = {.title = title,
                                       .mean = e->mean,
                                       .deviation = e->standard_deviation,
                                       .bins = e->highest > e->lowest ? e->bin_count : 0,
                                       .edges = e->bin_edges,
                                       .counts = e->bin_counts,
                                       .quantile_count = e->quantile_count,
                                       .probabilities = e->probabilities,
                                       .quantiles = e->quantiles,
                                       .quantiles_low = e->quantiles_low,
                                       .quantiles_high = e->quantiles_high,
                                       .curve_count = e->curve_count,
                                       .curve_values = e->curve_values,
                                       .curve_shares = e->curve_shares};
    snprintf(title, sizeof title, "%s\n%llu samples", scene, (unsigned long long)reply->samples);
    /* a picture without the samples is better than none, but a failure */
    bool complete = take_samples(request, reply, &columns, &picture) &&
                    take_intervals(reply, &columns, &picture);
    take_sensitivities(reply, &columns, &picture);
    int code = plot_ensemble(output, &picture);
    free(columns.speeds);
    free(columns.lows);
    return complete ? code : EXIT_FAILURE;
}
