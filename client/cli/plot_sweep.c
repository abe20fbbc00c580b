/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "sweep_output.h"

/* Pixels of one body's panels and the axis before the first; curves have six colours. */
enum { WIDTH = 900, NARROW = 560, AXIS = 100, GAP = 30, COLOURS = 6 };

/* Pixels: heights and lower edges of the panels: restitution, with room for the legend, over
 * numbers of sub-impacts. Between them, with friction, the tangential impulse and restitution. */
enum { HEIGHT = 860, TANGENTIAL = 230 };
static const double HIGH = 485.9, LOW = 301.0, UPPER = 313.9, LOWER = 8.6;
static const char *const tangential_labels[2] = {"tangential impulse / mN s",
                                                 "tangential restitution"};

/* Restitutions are drawn on an axis of at least this: an elastic impact's errors are rounding. */
static const double LEAST_RESTITUTION = 0.05;

bool sweep_bodies_differ(const struct sweep_points *points)
{
    for (size_t k = 1; k < points->curve_count; k++)
        if (strcmp(points->curves[k].b, points->curves->b))
            return true;
    return false;
}

static bool models_differ(const struct sweep_points *points)
{
    for (size_t k = 1; k < points->curve_count; k++)
        if (strcmp(points->curves[k].contact_model, points->curves->contact_model))
            return true;
    return false;
}

/* Along the axis: of angles that differ, else of the speeds. */
static double place_of(const struct sweep_points *points, const struct sweep_row *row)
{
    return points->by_angle ? row->angle : row->speed;
}

static bool slides(const struct sweep_points *points)
{
    for (size_t k = 0; k < points->curve_count; k++)
        for (unsigned i = 0; i < points->curves[k].done; i++) {
            const double *impulse = points->curves[k].rows[i].impulse_tangential;
            if (fabs(impulse[0]) > 0.0 || fabs(impulse[1]) > 0.0)
                return true;
        }
    return false;
}

/* Of the restitution: all that is known. */
static double error_of(const struct sweep_row *row)
{
    double error = isnan(row->error_total) ? row->error : row->error_total;
    return isnan(error) ? 0.0 : error;
}

/* The ends of its bar, as far as there are restitutions. */
static struct plot_range bar_of(const struct sweep_row *row)
{
    double e = row->restitution, error = error_of(row);
    return (struct plot_range){fmax(e - error, fmin(e, 0.0)), fmin(e + error, fmax(e, 1.0))};
}

/* A list of speeds comes in any order. */
static int compare_places(const void *one, const void *other)
{
    const struct sweep_row *const *a = one, *const *b = other;
    double speeds = (*a)->speed - (*b)->speed, angles = (*a)->angle - (*b)->angle;
    double difference = speeds != 0.0 ? speeds : angles;
    return (difference > 0.0) - (difference < 0.0);
}

static void write_row(const struct plot *plot, const struct sweep_points *points,
                      const struct sweep_row *row, bool friction)
{
    fprintf(plot->data, "%.9g,%.9g,%.3g,%u,%u", place_of(points, row), row->restitution,
            isnan(row->error) ? 0.0 : row->error, row->sub_impacts, row->significant);
    if (friction)
        fprintf(plot->data, ",%.9g,%.9g,%.9g", row->impulse_tangential[0],
                row->tangential_restitution, row->restitution_kinematic);
    const struct plot_range bar = bar_of(row);
    fprintf(plot->data, ",%.3g,%.9g,%.9g\n", error_of(row), bar.low, bar.high);
}

/* Its points along the axis. False: out of memory. */
static bool write_curve(struct plot *plot, const struct sweep_points *points, size_t k)
{
    char name[PLOT_NAME];
    snprintf(name, sizeof name, "curve_%zu", k + 1);
    bool friction = slides(points);
    char columns[160];
    snprintf(columns, sizeof columns,
             "%s,restitution,error,sub_impacts,significant%s,error_total,bar_low,bar_high",
             points->by_angle ? "angle" : "speed",
             friction ? ",impulse_tangential_1,tangential_restitution,restitution_kinematic" : "");
    plot_table(plot, name, columns);
    const struct sweep_curve *curve = &points->curves[k];
    const struct sweep_row **rows = calloc(curve->done + 1, sizeof *rows);
    for (unsigned i = 0; rows && i < curve->done; i++)
        rows[i] = &curve->rows[i];
    if (rows)
        qsort(rows, curve->done, sizeof *rows, compare_places);
    for (unsigned i = 0; rows && i < curve->done; i++)
        if (rows[i]->sub_impacts > 0)
            write_row(plot, points, rows[i], friction);
    free(rows);
    return rows != NULL;
}

/* Restitutions that were measured; an impact known by its impulse alone is no point here. */
static void write_measured(struct plot *plot, const struct sweep_points *points, size_t k)
{
    const struct measured_set *set = &points->measured[k].set;
    char name[PLOT_NAME];
    snprintf(name, sizeof name, "measured_%zu", k + 1);
    plot_table(plot, name, "speed,restitution,sub_impacts");
    for (size_t i = 0; i < set->count; i++)
        fprintf(plot->data, "%.9g,%.9g,%.9g\n", set->impacts[i].speed, set->impacts[i].restitution,
                set->impacts[i].sub_impacts);
}

/* The ranges of the axes of all panels. */
struct axes {
    struct plot_range speed, restitution, count;
    struct plot_range tangential[2]; /* impulse, mN s, and restitution */
    bool friction, kinematic;        /* the latter: the restitutions differ */
};

static struct axes take_axes(const struct sweep_points *points)
{
    static const double same = 1e-3;
    struct axes axes = {.speed = PLOT_NOTHING,
                        .restitution = PLOT_NOTHING,
                        .count = {0.0, 1.0},
                        .tangential = {{0.0, 0.0}, {0.0, 0.0}},
                        .friction = slides(points)};
    for (size_t k = 0; k < points->curve_count; k++)
        for (unsigned i = 0; i < points->curves[k].done; i++) {
            const struct sweep_row *row = &points->curves[k].rows[i];
            plot_range_take(&axes.speed, place_of(points, row));
            const struct plot_range bar = bar_of(row);
            plot_range_take(&axes.restitution, bar.low);
            plot_range_take(&axes.restitution, bar.high);
            plot_range_take(&axes.count, row->sub_impacts);
            if (!axes.friction)
                continue;
            plot_range_take(&axes.tangential[0], 1e3 * row->impulse_tangential[0]);
            plot_range_take(&axes.tangential[1], row->tangential_restitution);
            plot_range_take(&axes.restitution, row->restitution_kinematic);
            axes.kinematic =
                axes.kinematic || fabs(row->restitution_kinematic - row->restitution) > same;
        }
    for (size_t k = 0; k < points->measured_count; k++)
        for (size_t i = 0; i < points->measured[k].set.count; i++) {
            const struct measured_impact *impact = &points->measured[k].set.impacts[i];
            plot_range_take(&axes.speed, impact->speed);
            plot_range_take(&axes.restitution, impact->restitution);
            plot_range_take(&axes.count, impact->sub_impacts);
        }
    axes.count.high += 0.5;
    double more = 0.5 * (LEAST_RESTITUTION - (axes.restitution.high - axes.restitution.low));
    if (more > 0.0 && axes.restitution.high >= axes.restitution.low) {
        axes.restitution.low -= more;
        axes.restitution.high += more;
    }
    return axes;
}

/* One panel of the picture's: the curves of one body, or all of them (NULL). */
struct group {
    const struct sweep_points *points;
    const char *b;
    bool bodies, models; /* by which the legend tells curves apart */
};

static bool holds(const struct group *group, size_t k)
{
    return !group->b || !strcmp(group->points->curves[k].b, group->b);
}

/* The colour of a curve among those of its group, from 1. */
static size_t colour_of(const struct group *group, size_t k)
{
    size_t before = 0;
    for (size_t i = 0; i < k; i++)
        before += holds(group, i);
    return before % COLOURS + 1;
}

/* Measured points, black, in a shape for each file. */
static void write_points(const struct plot *plot, const struct group *group, int column)
{
    for (size_t k = 0; k < group->points->measured_count; k++) {
        const struct sweep_measured *measured = &group->points->measured[k];
        if (group->b && measured->b && strcmp(measured->b, group->b) != 0)
            continue;
        fprintf(plot->script, ", @measured_%zu using 1:%d with points pt %zu ps 1 lc rgb 'black' ",
                k + 1, column, 4 + 2 * (k % 5));
        fputs(column == 2 ? "title " : "notitle", plot->script);
        if (column == 2)
            plot_text(plot, plot_file_name(measured->file));
    }
}

/* Writes the curve's title: the body, the model or both. */
static void write_title(const struct plot *plot, const struct group *group, size_t k)
{
    const struct sweep_curve *curve = &group->points->curves[k];
    char title[160];
    if (group->bodies && group->models)
        snprintf(title, sizeof title, "%s, %s", curve->b, curve->contact_model);
    else
        snprintf(title, sizeof title, "%s", group->models ? curve->contact_model : curve->b);
    plot_text(plot, title);
}

/* Restitution with its total error; with friction the kinematic one where it is another. */
static void write_restitution(const struct plot *plot, const struct group *group,
                              const struct axes *axes)
{
    const char *comma = "plot ";
    const int bar = axes->friction ? 10 : 7; /* column of its lower end */
    const bool kinematic = axes->kinematic;
    for (size_t k = 0; k < group->points->curve_count; k++) {
        if (!holds(group, k))
            continue;
        fprintf(plot->script,
                "%s@curve_%zu using 1:%d:(0):($%d-$%d) with vectors nohead lt %zu lw 1 "
                "notitle, "
                "@curve_%zu using 1:2 with linespoints lt %zu lw 1 ps 0.6 title ",
                comma, k + 1, bar, bar + 1, bar, colour_of(group, k), k + 1, colour_of(group, k));
        write_title(plot, group, k);
        if (kinematic)
            fprintf(plot->script, ", @curve_%zu using 1:8 with lines lt %zu lw 1 dt (6,5) notitle",
                    k + 1, colour_of(group, k));
        comma = ", ";
    }
    if (kinematic)
        fputs(", keyentry with lines lt 6 lw 1 dt (6,5) title 'kinematic'", plot->script);
    write_points(plot, group, 2);
    fputc('\n', plot->script);
}

/* The tangential impulse or restitution. */
static void write_tangential(const struct plot *plot, const struct group *group, int which)
{
    const char *comma = "plot ";
    for (size_t k = 0; k < group->points->curve_count; k++) {
        if (!holds(group, k))
            continue;
        fprintf(plot->script,
                "%s@curve_%zu using 1:($%d*%g) with linespoints lt %zu lw 1 ps 0.6 notitle", comma,
                k + 1, 6 + which, which == 0 ? 1e3 : 1.0, colour_of(group, k));
        comma = ", ";
    }
    fputc('\n', plot->script);
}

/* How many curves the group has. */
static size_t size_of(const struct group *group)
{
    size_t size = 0;
    for (size_t k = 0; k < group->points->curve_count; k++)
        size += holds(group, k);
    return size;
}

/* Numbers of sub-impacts, open, and of those that are not negligible, filled. Points of several
 * curves stand beside each other, within four fifths of a whole number. */
static void write_counts(const struct plot *plot, const struct group *group)
{
    const char *comma = "plot ";
    size_t size = size_of(group);
    double step = size > 1 ? fmin(0.8 / (double)size, 0.2) : 0.0;
    double aside = -0.5 * step * (double)(size - 1), open = size > 1 ? 0.45 : 0.8;
    for (size_t k = 0; k < group->points->curve_count; k++) {
        if (!holds(group, k))
            continue;
        fprintf(plot->script,
                "%s@curve_%zu using 1:($4+%.4g) with points lt %zu lw 1 pt 6 ps %g notitle, "
                "@curve_%zu using 1:($5+%.4g) with points lt %zu pt 7 ps %g notitle",
                comma, k + 1, aside, colour_of(group, k), open, k + 1, aside, colour_of(group, k),
                0.5 * open);
        aside += step;
        comma = ", ";
    }
    fprintf(plot->script,
            ", keyentry with points lt 6 pt 6 ps %g title 'all', "
            "keyentry with points lt 6 pt 7 ps %g title 'without negligible ones'",
            open, 0.5 * open);
    write_points(plot, group, 3);
    fputc('\n', plot->script);
}

/* Origin and size of a panel, in pixels. */
static void set_panel(const struct plot *plot, double lower, double height)
{
    fprintf(plot->script, "set origin 0,%.6g\nset size 1,%.6g\n", lower / plot->height,
            height / plot->height);
}

/* The body of a group, and of a sweep over the angle the speed and the coefficient that was given.
 */
static void write_subtitle(const struct plot *plot, const struct group *group, double middle)
{
    const struct sweep_points *points = group->points;
    char text[PERCUSS_ID_SIZE + 64];
    int length = snprintf(text, sizeof text, "%s", group->b ? group->b : "");
    if (points->by_angle)
        length += snprintf(text + length, sizeof text - (size_t)length, "%s%.6g m/s",
                           length > 0 ? ", " : "", points->speeds[0]);
    if (points->friction > 0.0)
        length += snprintf(text + length, sizeof text - (size_t)length, "%sfriction %.4g",
                           length > 0 ? ", " : "", points->friction);
    if (length == 0)
        return;
    fputs("set label 1 ", plot->script);
    plot_text(plot, text);
    fprintf(plot->script, " at screen %.6g,%.6g center\n", middle, 1.0 - 43.0 / plot->height);
}

/* The panels of the group that stands there. */
static void write_group(const struct plot *plot, const struct group *group, const struct axes *axes,
                        double left, double right)
{
    fprintf(plot->script, "set lmargin at screen %.6g\nset rmargin at screen %.6g\n", left, right);
    bool first = left * plot->width < AXIS + 1;
    set_panel(plot, UPPER + (axes->friction ? 2 * TANGENTIAL : 0), HIGH);
    fputs("set format x ''\nunset xlabel\n", plot->script);
    if (group->points->logarithmic)
        plot_range_set_log(plot, "x", &axes->speed, 0.02);
    else
        plot_range_set(plot, "xrange", &axes->speed, 0.02);
    plot_range_set(plot, "yrange", &axes->restitution, 0.05);
    write_subtitle(plot, group, 0.5 * (left + right));
    write_restitution(plot, group, axes);
    fputs("unset label 1\n", plot->script);
    for (int which = 0; which < 2 && axes->friction; which++) {
        set_panel(plot, UPPER + (1 - which) * TANGENTIAL, TANGENTIAL);
        if (first)
            fprintf(plot->script, "set ylabel '%s'\n", tangential_labels[which]);
        plot_range_set(plot, "yrange", &axes->tangential[which], 0.05);
        write_tangential(plot, group, which);
    }
    set_panel(plot, LOWER, LOW);
    fprintf(plot->script, "set format x '%%g'\nset xlabel '%s'\nset ytics 1\n",
            group->points->by_angle ? "angle / degrees" : "speed / (m/s)");
    plot_range_set(plot, "yrange", &axes->count, 0.0);
    fputs(first ? "set ylabel 'sub-impacts'\n" : "", plot->script);
    write_counts(plot, group);
    /* the next ones share the axes of the first */
    fputs("set ytics autofreq\nunset ylabel\nset format y ''\n", plot->script);
}

/* The body of every group: of several bodies by several models each has one, else all have one. */
static size_t list_groups(const struct sweep_points *points, const char *bodies[])
{
    size_t count = 0;
    bodies[0] = NULL;
    if (!sweep_bodies_differ(points) || !models_differ(points))
        return 1;
    for (size_t k = 0; k < points->curve_count; k++)
        if (count == 0 || strcmp(points->curves[k].b, bodies[count - 1]) != 0)
            bodies[count++] = points->curves[k].b;
    return count;
}

/* "A on B": which others, the legend tells. */
static void write_heading(const struct plot *plot, const struct sweep_points *points)
{
    char title[PERCUSS_ID_SIZE + 32];
    snprintf(title, sizeof title, "%s on bodies at rest", points->a);
    plot_text(plot, sweep_bodies_differ(points) ? title : points->title);
}

int sweep_plot(const struct plot_output *output, const struct sweep_points *points)
{
    struct plot plot;
    const char *bodies[PLOT_TABLES];
    size_t groups = list_groups(points, bodies);
    unsigned width = groups > 1 ? NARROW * (unsigned)groups : WIDTH;
    const struct axes axes = take_axes(points);
    int code =
        plot_begin(&plot, output, AXIS + width, HEIGHT + (axes.friction ? 2 * TANGENTIAL : 0));
    if (code != EXIT_ANSWERED)
        return code;
    bool good = true;
    for (size_t k = 0; k < points->curve_count; k++)
        good = write_curve(&plot, points, k) && good;
    if (!good)
        complain_memory();
    for (size_t k = 0; k < points->measured_count; k++)
        write_measured(&plot, points, k);
    fputs("set multiplot title ", plot.script);
    write_heading(&plot, points);
    fputs("\nset ylabel 'restitution e'\n", plot.script);
    for (size_t g = 0; g < groups; g++) {
        const struct group group = {points, bodies[g], !bodies[g] && sweep_bodies_differ(points),
                                    models_differ(points)};
        double whole = plot.width, left = AXIS + (double)width / (double)groups * (double)g;
        write_group(&plot, &group, &axes, left / whole,
                    (left + (double)width / (double)groups - GAP) / whole);
    }
    fputs("unset multiplot\n", plot.script);
    code = plot_end(&plot);
    return good ? code : EXIT_FAILURE;
}
