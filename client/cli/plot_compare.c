/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <stdio.h>

#include "cli.h"
#include "compare.h"

/* The paper's areas A to D: half, one, one and a half and two deviations about the mean. */
enum { AREAS = 4 };
static const char *const colours[AREAS] = {"#c4c4c4", "#d2d2d2", "#e0e0e0", "#ececec"};

/* The part of the axis of speeds that is left free at either end. */
static const double MARGIN = 0.03;

static void write_impacts(struct plot *plot, const struct comparison *comparison)
{
    plot_table(plot, "impacts",
               "speed,restitution,simulated_restitution,share,sub_impacts,simulated_sub_impacts");
    for (size_t i = 0; i < comparison->set->count; i++) {
        const struct measured_impact *measured = &comparison->set->impacts[i];
        const struct measured_impact *twin = &comparison->twins[i].impact;
        fprintf(plot->data, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", measured->speed,
                measured->restitution, twin->restitution, 1.0 / (double)comparison->set->count,
                measured->sub_impacts, twin->sub_impacts);
    }
}

/* The ranges of the axes. */
struct axes {
    struct plot_range speed, restitution, areas, count;
};

static struct axes take_axes(const struct comparison *comparison)
{
    struct axes axes = {PLOT_NOTHING, PLOT_NOTHING, PLOT_NOTHING, {0.0, 1.0}};
    for (size_t i = 0; i < comparison->set->count; i++) {
        const struct measured_impact *measured = &comparison->set->impacts[i];
        const struct measured_impact *twin = &comparison->twins[i].impact;
        plot_range_take(&axes.speed, measured->speed);
        plot_range_take(&axes.restitution, measured->restitution);
        plot_range_take(&axes.restitution, twin->restitution);
        plot_range_take(&axes.count, measured->sub_impacts);
        plot_range_take(&axes.count, twin->sub_impacts);
    }
    /* areas may reach where no restitution is: below 0 */
    double wide = 0.5 * AREAS * comparison->differences.measured_deviation;
    axes.areas = axes.restitution;
    plot_range_take(&axes.areas, comparison->differences.measured_mean - wide);
    plot_range_take(&axes.areas, comparison->differences.measured_mean + wide);
    plot_range_take(&axes.areas, 0.0);
    axes.count.high += 0.5;
    return axes;
}

/* The areas with their letters on their right, at both of their ends, and the mean. */
static void write_areas(const struct plot *plot, const struct comparison *comparison)
{
    double mean = comparison->differences.measured_mean,
           deviation = comparison->differences.measured_deviation;
    if (!(deviation > 0.0))
        return;
    for (int area = AREAS; area-- > 0;) {
        double half = 0.5 * (area + 1) * deviation, letter = half - 0.25 * deviation;
        fprintf(plot->script,
                "set object rectangle from graph 0, first %.9g to graph 1, first %.9g "
                "fc rgb '%s' fs solid noborder behind\n"
                "set label '%c' at graph 1.012, first %.9g tc rgb '#606060'\n"
                "set label '%c' at graph 1.012, first %.9g tc rgb '#606060'\n",
                mean - half, mean + half, colours[area], 'A' + area, mean + letter, 'A' + area,
                mean - letter);
    }
    fprintf(plot->script,
            "set arrow from graph 0, first %.9g to graph 1, first %.9g nohead lc rgb '#808080'\n",
            mean, mean);
}

static void write_restitution(const struct plot *plot, const struct comparison *comparison,
                              const struct axes *axes)
{
    fputs("set origin 0,0.56\nset size 1,0.41\nset xlabel 'speed / (m/s)'\n"
          "set ylabel 'restitution e'\n",
          plot->script);
    plot_range_set(plot, "xrange", &axes->speed, MARGIN);
    plot_range_set(plot, "yrange", &axes->areas, 0.04);
    write_areas(plot, comparison);
    fputs("plot @impacts using 1:2:(0):($3-$2) with vectors nohead lc rgb '#909090' lw 1 notitle, "
          "'' using 1:2 with points lt 2 title 'measured', "
          "'' using 1:3 with points lt 1 title 'simulated'",
          plot->script);
    if (comparison->differences.measured_deviation > 0.0)
        fputs(", keyentry with lines lc rgb '#808080' lw 1 title 'mean of the measured', "
              "keyentry with boxes fs solid noborder lc rgb '#d2d2d2' "
              "title 'A to D: ± 0.5, 1, 1.5, 2 σ'",
              plot->script);
    fputs("\nunset object\nunset label\nunset arrow\n", plot->script);
}

static void write_counts(const struct plot *plot, const struct axes *axes)
{
    fputs("set origin 0,0.29\nset size 1,0.27\nset ytics 1\nset ylabel 'sub-impacts'\n",
          plot->script);
    plot_range_set(plot, "yrange", &axes->count, 0.0);
    fputs("plot @impacts using 1:5 with points lt 2 title 'measured', "
          "'' using 1:6 with points lt 1 pt 6 ps 1.4 title 'simulated'\nset ytics autofreq\n",
          plot->script);
}

static void write_distributions(const struct plot *plot, const struct axes *axes)
{
    fputs("set origin 0,0.01\nset size 1,0.28\nset xlabel 'restitution e'\n"
          "set ylabel 'share of impacts below'\nset yrange [0:1.02]\n",
          plot->script);
    plot_range_set(plot, "xrange", &axes->restitution, MARGIN);
    fputs("plot @impacts using 2:4 smooth cumulative with steps lt 2 title 'measured', "
          "'' using 3:4 smooth cumulative with steps lt 1 title 'simulated'\n",
          plot->script);
}

int compare_plot(const struct plot_output *output, const struct comparison *comparison)
{
    struct plot plot;
    char title[600];
    int code = plot_begin(&plot, output, 1000, 1200);
    if (code != EXIT_ANSWERED)
        return code;
    write_impacts(&plot, comparison);
    snprintf(title, sizeof title, "%s: %zu impacts", comparison->title, comparison->set->count);
    fputs("set multiplot title ", plot.script);
    plot_text(&plot, title);
    fputs("\nset lmargin 10\nset rmargin 4\n", plot.script);
    /* restitution over speed, joined to its twin, on areas of the measured deviation; how many
     * sub-impacts; both distributions */
    const struct axes axes = take_axes(comparison);
    write_restitution(&plot, comparison, &axes);
    write_counts(&plot, &axes);
    write_distributions(&plot, &axes);
    fputs("unset multiplot\n", plot.script);
    return plot_end(&plot);
}
