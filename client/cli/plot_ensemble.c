/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plot_ensemble.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include "cli.h"

/* SPEED_BINS: intervals of the speed in which the samples' mean and deviation are shown;
 * MOST_DOTS: samples drawn, as more hide each other and make an SVG large; FEW_DOTS: fewer are
 * drawn larger; HEIGHT: pixels of a panel; COLOURS: numbers of sub-impacts that are told apart, the
 * last also stands for more. */
enum { SPEED_BINS = 16, MOST_DOTS = 5000, FEW_DOTS = 1000, HEIGHT = 480, COLOURS = 4 };
static const char *const colours[COLOURS] = {"#7fa8d8", "#e0a060", "#70b878", "#b080c8"};

/* The range of the axis of restitutions: samples or bins, and quantiles with their bounds. */
static struct plot_range restitutions_of(const struct ensemble_picture *picture)
{
    struct plot_range range = PLOT_NOTHING;
    plot_range_take_all(&range, picture->edges, picture->bins > 0 ? picture->bins + 1 : 0);
    plot_range_take_all(&range, picture->quantiles, picture->quantile_count);
    plot_range_take_all(&range, picture->quantiles_low, picture->quantile_count);
    plot_range_take_all(&range, picture->quantiles_high, picture->quantile_count);
    plot_range_take_all(&range, picture->curve_values, picture->curve_count);
    return range;
}

static void write_histogram(struct plot *plot, const struct ensemble_picture *picture)
{
    struct plot_range range = restitutions_of(picture), densities = {0.0, 0.0};
    plot_table(plot, "histogram", "restitution,density,width");
    /* a density of area 1 */
    double all = 0.0;
    for (size_t i = 0; i < picture->bins; i++)
        all += (double)picture->counts[i];
    for (size_t i = 0; i < picture->bins; i++) {
        double width = picture->edges[i + 1] - picture->edges[i];
        double density = (double)picture->counts[i] / (all * width);
        plot_range_take(&densities, density);
        fprintf(plot->data, "%.9g,%.9g,%.9g\n", picture->edges[i] + 0.5 * width, density, width);
    }
    densities.high *= 1.05;
    plot_range_set(plot, "xrange", &range, 0.03);
    plot_range_set(plot, "yrange", &densities, 0.0);
    /* bars, and a line at the mean */
    fprintf(plot->script,
            "set xlabel 'restitution e'\nset ylabel 'density'\nset style fill solid 0.6 border\n"
            "set arrow 1 from %.9g, graph 0 to %.9g, graph 1 nohead lt 2\n"
            "plot @histogram using 1:2:3 with boxes lt 1 lw 1 title 'samples', "
            "keyentry with lines lt 2 title 'mean'\nunset arrow 1\n",
            picture->mean, picture->mean);
}

static void write_distribution(struct plot *plot, const struct ensemble_picture *picture)
{
    struct plot_range range = restitutions_of(picture);
    plot_table(plot, "quantiles", "restitution,probability,low,high");
    for (size_t i = 0; i < picture->quantile_count; i++)
        fprintf(plot->data, "%.9g,%.9g,%.9g,%.9g\n", picture->quantiles[i],
                picture->probabilities[i], picture->quantiles_low[i], picture->quantiles_high[i]);
    plot_range_set(plot, "xrange", &range, 0.03);
    fputs("set xlabel 'restitution e'\nset ylabel 'share of samples below'\n"
          "set yrange [0:1]\n"
          "plot @quantiles using 1:2:3:4 with xerrorbars lt 1 ps 0.4 "
          "title 'quantiles, 95 % intervals'",
          plot->script);
    if (picture->curve_count > 0)
        fputs(", @distribution using 1:2 with lines lt 1 lw 1 title 'all samples'", plot->script);
    fputc('\n', plot->script);
    if (picture->curve_count > 0)
        plot_table(plot, "distribution", "restitution,share");
    for (size_t i = 0; i < picture->curve_count; i++)
        fprintf(plot->data, "%.9g,%.9g\n", picture->curve_values[i], picture->curve_shares[i]);
}

/* Mean and deviation of the samples within equal intervals of the speed; widens the range by them.
 */
static void write_bands(struct plot *plot, const struct ensemble_picture *picture,
                        const struct plot_range *speeds, struct plot_range *reach)
{
    double width = (speeds->high - speeds->low) / SPEED_BINS;
    plot_table(plot, "bands", "speed,mean,deviation");
    for (int b = 0; b < SPEED_BINS && width > 0.0; b++) {
        /* the samples within this interval */
        double count = 0.0, sum = 0.0, squares = 0.0;
        for (size_t i = 0; i < picture->sample_count; i++) {
            int at = (int)((picture->speeds[i] - speeds->low) / width);
            double e = picture->restitutions[i];
            if ((at < SPEED_BINS ? at : SPEED_BINS - 1) != b || !isfinite(e))
                continue;
            count += 1.0;
            sum += e;
            squares += e * e;
        }
        if (!(count > 1.0))
            continue;
        /* its middle, mean and deviation */
        double mean = sum / count;
        double deviation = sqrt(fmax(0.0, (squares - sum * mean) / (count - 1.0)));
        fprintf(plot->data, "%.9g,%.9g,%.9g\n", speeds->low + (b + 0.5) * width, mean, deviation);
        plot_range_take(reach, mean - deviation);
        plot_range_take(reach, mean + deviation);
    }
}

/* Each with the same chance (Knuth's selection sampling), as every so manieth would follow the
 * pattern of a Sobol sequence. */
static void write_dots(struct plot *plot, const struct ensemble_picture *picture)
{
    uint64_t random = 1;
    size_t wanted = picture->sample_count < MOST_DOTS ? picture->sample_count : MOST_DOTS;
    plot_table(plot, "samples", "speed,restitution,sub_impacts");
    for (size_t i = 0; i < picture->sample_count; i++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        double chance = (double)(random >> 11) * 0x1p-53;
        if (chance * (double)(picture->sample_count - i) >= (double)wanted)
            continue;
        wanted--;
        fprintf(plot->data, "%.9g,%.9g,%.0f\n", picture->speeds[i], picture->restitutions[i],
                picture->sub_impacts ? picture->sub_impacts[i] : 0.0);
    }
}

/* Grey behind the samples, darker towards the mean; leaves the height of the panel alone. */
static void write_intervals(const struct plot *plot, const struct ensemble_picture *picture)
{
    for (size_t i = picture->interval_count; i-- > 0;)
        fprintf(plot->script,
                "set object %zu rectangle from graph 0, first %.9g to graph 1, first %.9g behind "
                "fillcolor rgb '#000000' fillstyle transparent solid 0.07 noborder\n",
                picture->interval_count - i, picture->intervals_low[i], picture->intervals_high[i]);
}

/* The samples with k sub-impacts, or k and more; nothing if there are none. */
static void write_colour(const struct plot *plot, const struct ensemble_picture *picture, int k)
{
    size_t i = 0;
    bool last = k == COLOURS;
    while (i < picture->sample_count &&
           !(picture->sub_impacts[i] == k || (last && picture->sub_impacts[i] > k)))
        i++;
    if (i == picture->sample_count)
        return;
    fprintf(plot->script,
            "@samples using 1:($3 %s %d ? $2 : NaN) with points pt 7 ps %g lc rgb '%s' notitle, "
            "keyentry with points pt 7 ps 0.8 lc rgb '%s' title '%s%d sub-impact%s', ",
            last ? ">=" : "==", k, picture->sample_count < FEW_DOTS ? 0.4 : 0.2, colours[k - 1],
            colours[k - 1], last ? "≥ " : "", k, k > 1 ? "s" : "");
}

static void write_samples(struct plot *plot, const struct ensemble_picture *picture)
{
    struct plot_range speeds = PLOT_NOTHING, reach = PLOT_NOTHING;
    plot_range_take_all(&speeds, picture->speeds, picture->sample_count);
    plot_range_take_all(&reach, picture->restitutions, picture->sample_count);
    plot_range_take_all(&reach, picture->intervals_low, picture->interval_count);
    plot_range_take_all(&reach, picture->intervals_high, picture->interval_count);
    write_dots(plot, picture);
    write_bands(plot, picture, &speeds, &reach);
    write_intervals(plot, picture);
    plot_range_set(plot, "xrange", &speeds, 0.03);
    plot_range_set(plot, "yrange", &reach, 0.03);
    fputs("set xlabel 'speed / (m/s)'\nset ylabel 'restitution e'\nplot ", plot->script);
    /* the samples, in colours by their number of sub-impacts if that is known */
    if (!picture->sub_impacts)
        fputs("@samples using 1:2 with points pt 7 ps 0.2 lc rgb '#808080' title 'samples', ",
              plot->script);
    for (int k = 1; picture->sub_impacts && k <= COLOURS; k++)
        write_colour(plot, picture, k);
    /* behind them the intervals, and over them mean and deviation of each band */
    if (picture->interval_count > 0)
        fputs("keyentry with boxes fillstyle solid 0.18 noborder lc rgb '#000000' "
              "title 'all ± kσ', ",
              plot->script);
    fputs("@bands using 1:2:3 with yerrorbars lt 6 lw 1.5 ps 0.6 title 'local ± σ'\n",
          plot->script);
    for (size_t i = 1; i <= picture->interval_count; i++)
        fprintf(plot->script, "unset object %zu\n", i);
}

/* A name as a string among the data, where only double quotes count. */
static void write_name(const struct plot *plot, const char *name)
{
    fputc('"', plot->data);
    for (; *name; name++)
        fputc(*name == '"' ? '\'' : *name, plot->data);
    fputc('"', plot->data);
}

/* A bar without an interval gets one of no length. */
static void write_share(const struct plot *plot, const struct index_share *share,
                        struct plot_range *reach)
{
    double low = isnan(share->low) ? share->value : share->low;
    double high = isnan(share->high) ? share->value : share->high;
    fprintf(plot->data, ",%.9g,%.9g,%.9g", share->value, low, high);
    plot_range_take(reach, low);
    plot_range_take(reach, high);
}

/* Bars of the shares in that column, the interval in the next two, so far above the input's row. */
static void write_bars(const struct plot *plot, int column, double above, const char *title)
{
    fprintf(plot->script,
            "@sensitivities using (0.5*$%d):(%g-$0):(0.5*$%d):(0.12) with boxxyerror "
            "lt %d lw 1 title '%s', "
            "@sensitivities using %d:(%g-$0):($%d-$%d):(0) with vectors nohead lt 6 lw 1.5 notitle",
            column, above, column, above > 0.0 ? 1 : 2, title, column + 1, above, column + 2,
            column + 1);
}

static void write_sensitivities(struct plot *plot, const struct ensemble_picture *picture)
{
    struct plot_range reach = {0.0, 1.0};
    plot_table(plot, "sensitivities",
               "input,alone,alone_low,alone_high,total,total_low,total_high");
    for (size_t i = 0; i < picture->input_count; i++) {
        write_name(plot, picture->inputs[i].name);
        write_share(plot, &picture->inputs[i].first_order, &reach);
        write_share(plot, &picture->inputs[i].total, &reach);
        fputc('\n', plot->data);
    }
    /* a row for each input, the first above: its name over its bars */
    struct plot_range rows = {0.5 - (double)picture->input_count, 0.6};
    plot_range_set(plot, "xrange", &reach, 0.03);
    plot_range_set(plot, "yrange", &rows, 0.0);
    fputs("unset ylabel\nunset ytics\nset xlabel 'share of the variance'\n"
          "set style fill solid 0.6 border\nplot ",
          plot->script);
    write_bars(plot, 2, 0.12, "alone");
    fputs(", ", plot->script);
    write_bars(plot, 5, -0.16, "with its interactions");
    fputs(", @sensitivities using (0):(0.37-$0):1 with labels left notitle", plot->script);
    fputc('\n', plot->script);
}

int plot_ensemble(const struct plot_output *output, const struct ensemble_picture *picture)
{
    struct plot plot;
    /* a panel for each part that the reply has */
    size_t panels = (picture->bins > 0) + (picture->quantile_count > 0) +
                    (picture->sample_count > 0) + (picture->input_count > 0);
    unsigned rows = panels > 3 ? 2 : 1, columns = (unsigned)(panels + rows - 1) / rows;
    /* many inputs need room for their rows */
    unsigned high = HEIGHT, needed = 60 * (unsigned)picture->input_count + 90;
    high = needed > high ? needed : high;
    int code = plot_begin(&plot, output, columns > 2 ? 1500 : 620 * columns, high * rows);
    if (code != EXIT_ANSWERED)
        return code;
    /* over all of them */
    char title[700];
    snprintf(title, sizeof title, "%.600s: e = %.4f, standard deviation %.4f", picture->title,
             picture->mean, picture->deviation);
    fprintf(plot.script, "set multiplot layout %u,%u title ", rows, columns);
    plot_text(&plot, title);
    fputs(" offset 0,0.5\n", plot.script);
    if (picture->sample_count > 0)
        write_samples(&plot, picture);
    if (picture->bins > 0)
        write_histogram(&plot, picture);
    if (picture->quantile_count > 0)
        write_distribution(&plot, picture);
    if (picture->input_count > 0)
        write_sensitivities(&plot, picture);
    fputs("unset multiplot\n", plot.script);
    return plot_end(&plot);
}
