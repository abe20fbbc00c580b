/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plot_ensemble.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include "cli.h"
#include "plot.h"

/* Intervals of the speed in which the samples' mean and deviation are shown. */
enum { SPEED_BINS = 16 };

static void write_histogram(const struct plot *plot, const struct ensemble_picture *picture)
{
    fputs("$histogram << EOD\n", plot->script);
    double all = 0.0;
    for (size_t i = 0; i < picture->bins; ++i)
        all += (double)picture->counts[i];
    for (size_t i = 0; i < picture->bins; ++i) {
        double width = picture->edges[i + 1] - picture->edges[i];
        fprintf(plot->script, "%.9g %.9g %.9g\n", picture->edges[i] + 0.5 * width,
                (double)picture->counts[i] / (all * width), width);
    }
    fputs("EOD\nset xlabel 'restitution e'\nset ylabel 'density'\nset yrange [0:*]\n"
          "set style fill solid 0.6 border\n",
          plot->script);
    fprintf(plot->script,
            "set arrow 1 from %.9g, graph 0 to %.9g, graph 1 nohead lt 2\n"
            "plot $histogram using 1:2:3 with boxes lt 1 lw 1 title 'samples', "
            "NaN with lines lt 2 title 'mean'\nunset arrow 1\nset yrange [*:*]\n",
            picture->mean, picture->mean);
}

static void write_distribution(const struct plot *plot, const struct ensemble_picture *picture)
{
    fputs("$distribution << EOD\n", plot->script);
    for (size_t i = 0; i < picture->quantile_count; ++i)
        fprintf(plot->script, "%.9g %.9g %.9g %.9g\n", picture->quantiles[i],
                picture->probabilities[i], picture->quantiles_low[i], picture->quantiles_high[i]);
    fputs("EOD\nset xlabel 'restitution e'\nset ylabel 'share of samples below'\n"
          "set yrange [0:1]\nset key bottom right\n"
          "plot $distribution using 1:2:3:4 with xerrorbars lt 1 ps 0.4 "
          "title 'quantiles, 95 % intervals', '' using 1:2 with lines lt 1 notitle\n"
          "set yrange [*:*]\nset key top right\n",
          plot->script);
}

/* Mean and deviation of the samples within equal intervals of the speed. */
static void write_bands(const struct plot *plot, const struct ensemble_picture *picture)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < picture->sample_count; ++i) {
        low = fmin(low, picture->speeds[i]);
        high = fmax(high, picture->speeds[i]);
    }
    double width = (high - low) / SPEED_BINS;
    fputs("$bands << EOD\n", plot->script);
    for (int b = 0; b < SPEED_BINS && width > 0.0; ++b) {
        double count = 0.0, sum = 0.0, squares = 0.0;
        for (size_t i = 0; i < picture->sample_count; ++i) {
            int at = (int)((picture->speeds[i] - low) / width);
            double e = picture->restitutions[i];
            if ((at < SPEED_BINS ? at : SPEED_BINS - 1) != b || !isfinite(e))
                continue;
            count += 1.0;
            sum += e;
            squares += e * e;
        }
        if (count > 1.0)
            fprintf(plot->script, "%.9g %.9g %.9g\n", low + (b + 0.5) * width, sum / count,
                    sqrt(fmax(0.0, (squares - sum * sum / count) / (count - 1.0))));
    }
    fputs("EOD\n", plot->script);
}

static void write_samples(const struct plot *plot, const struct ensemble_picture *picture)
{
    fputs("$samples << EOD\n", plot->script);
    for (size_t i = 0; i < picture->sample_count; ++i)
        fprintf(plot->script, "%.9g %.9g\n", picture->speeds[i], picture->restitutions[i]);
    fputs("EOD\n", plot->script);
    write_bands(plot, picture);
    fputs("set xlabel 'speed / (m/s)'\nset ylabel 'restitution e'\nset offsets 0,0,graph 0.2,0\n"
          "plot $samples using 1:2 with dots lc rgb '#808080' title 'samples', "
          "$bands using 1:2:3 with yerrorbars lt 1 ps 0.6 "
          "title 'mean and standard deviation about a speed'\nset offsets 0,0,0,0\n",
          plot->script);
}

/* A name as a string among the data, where only double quotes count. */
static void write_name(const struct plot *plot, const char *name)
{
    fputc('"', plot->script);
    for (; *name; ++name)
        fputc(*name == '"' ? '\'' : *name, plot->script);
    fputc('"', plot->script);
}

static void write_sensitivities(const struct plot *plot, const struct ensemble_picture *picture)
{
    fputs("$sensitivities << EOD\n", plot->script);
    for (size_t i = 0; i < picture->input_count; ++i) {
        write_name(plot, picture->inputs[i]);
        fprintf(plot->script, " %.9g %.9g\n", picture->first_order[i], picture->total[i]);
    }
    fputs("EOD\nset datafile separator whitespace\nset xlabel 'input'\n"
          "set ylabel 'share of the variance'\nset yrange [0:1.3]\nset style data histograms\n"
          "set style histogram clustered gap 1\nset xtics rotate by -20\n"
          "plot $sensitivities using 2:xtic(1) lt 1 title 'alone', "
          "'' using 3 lt 2 title 'with its interactions'\n",
          plot->script);
}

int plot_ensemble(const char *file, const struct ensemble_picture *picture)
{
    struct plot plot;
    size_t panels = (picture->bins > 0) + (picture->quantile_count > 0) +
                    (picture->sample_count > 0) + (picture->input_count > 0);
    unsigned columns = panels > 1 ? 2 : 1, rows = panels > 2 ? 2 : 1;
    int code = plot_begin(&plot, file, 600 * columns, 420 * rows);
    if (code != EXIT_ANSWERED)
        return code;
    char title[256];
    snprintf(title, sizeof title, "%.150s: e = %.4f, standard deviation %.4f", picture->title,
             picture->mean, picture->deviation);
    fprintf(plot.script, "set multiplot layout %u,%u title ", rows, columns);
    plot_text(&plot, title);
    fputc('\n', plot.script);
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
