/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plot_impact.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "csv.h"

/* Of the bodies' curves by one model after the other, from light and wide to dark and thin, so that
 * those that agree are all seen; the same again for more. */
enum { STYLES = 4 };
static const char *const styles[STYLES] = {"lw 2", "lw 2 dt (8,5)", "lw 2 dt (2,4)",
                                           "lw 2 dt (9,4,2,4)"};
static const char *const colours[2][STYLES] = {{"#1f5fa8", "#0b2440", "#58b0e0", "#6a5acd"},
                                               {"#c8501e", "#5a1c00", "#f0a060", "#b03070"}};
static const char *const pale[2] = {"#a9c8e6", "#efc3ae"};
static const char *const dark[STYLES] = {"#606060", "#101010", "#a0a0a0", "#7a6a3a"};

/* Pixels of one impact, and of the axis before the first. */
enum { WIDTH = 900, NARROW = 520, AXIS = 100, GAP = 30, HEIGHT = 960 };

/* The three panels of an impact, from above: share of the height, and lower edge. The first has
 * room for the legend. */
enum { DISPLACEMENT, VELOCITY, FORCE, PANELS };
static const double heights[PANELS] = {0.42, 0.27, 0.25}, origins[PANELS] = {0.515, 0.255, 0.01};

static size_t largest_contact(const struct percuss_reply *reply)
{
    size_t largest = 0;
    for (size_t c = 1; c < reply->contact_count; c++)
        if (reply->contacts[c].impulse > reply->contacts[largest].impulse)
            largest = c;
    return largest;
}

static const struct percuss_contact_trace *trace_of(const struct impact_run *run)
{
    return &run->trace.contacts[largest_contact(&run->reply)];
}

static const char *name_of(const struct impact_run *run, int which)
{
    const struct percuss_contact *contact = &run->request.contacts[largest_contact(&run->reply)];
    return run->request.bodies[which == 0 ? contact->a : contact->b].id;
}

/* The times that are drawn: the contacts, and a quarter of their time before and after them. A
 * trace goes on for as long as vibration could bring the bodies together again. */
static struct plot_range drawn_times(const struct impact_run *run)
{
    const struct percuss_contact_trace *trace = trace_of(run);
    const struct percuss_contact_result *contact =
        &run->reply.contacts[largest_contact(&run->reply)];
    struct plot_range times = PLOT_NOTHING;
    plot_range_take_all(&times, trace->time, trace->count);
    if (contact->sub_impacts_listed == 0 || !(contact->end_time > contact->sub_impacts[0].start))
        return times;
    double start = contact->sub_impacts[0].start, margin = 0.25 * (contact->end_time - start);
    return (struct plot_range){fmax(times.low, start - margin),
                               fmin(times.high, contact->end_time + margin)};
}

/* The last instant of an impact that is drawn, by its first model; 0: there is none. */
static double end_of(const struct impact_picture *picture, size_t speed)
{
    return fmax(0.0, drawn_times(&picture->runs[speed * picture->model_count]).high);
}

/* Measured instants that are drawn: the simulated ones and a twentieth of their time before. */
static bool is_drawn(const struct impact_picture *picture, size_t speed, size_t i)
{
    double time = picture->measured[speed].motion.time[i], end = end_of(picture, speed);
    return time >= -0.05 * end && time <= end;
}

/* The columns are those of write_run, without a force. */
static void write_measured(struct plot *plot, const struct impact_picture *picture, size_t speed)
{
    const struct history_motion *motion = &picture->measured[speed].motion;
    char name[PLOT_NAME];
    snprintf(name, sizeof name, "measured_%zu", speed + 1);
    plot_table(plot, name, "time,force,displacement_a,displacement_b,velocity_a,velocity_b");
    for (size_t i = 0; i < motion->count; i++) {
        if (!is_drawn(picture, speed, i))
            continue;
        fprintf(plot->data, "%.9g,nan", motion->time[i]);
        for (int which = 0; which < 2; which++)
            fprintf(plot->data, ",%.9g",
                    motion->displacement[which] ? motion->displacement[which][i] : NAN);
        for (int which = 0; which < 2; which++)
            fprintf(plot->data, ",%.9g",
                    motion->velocity[which] ? motion->velocity[which][i] : NAN);
        fputc('\n', plot->data);
    }
}

/* The ranges of the axes of all impacts: time, and each panel's numbers. */
struct axes {
    struct plot_range time, values[PANELS];
};

static void take_measured(struct axes *axes, const struct impact_picture *picture, size_t speed)
{
    const struct history_motion *motion = &picture->measured[speed].motion;
    for (size_t i = 0; i < motion->count; i++) {
        if (!is_drawn(picture, speed, i))
            continue;
        plot_range_take(&axes->time, motion->time[i]);
        for (int which = 0; which < 2 && motion->velocity[which]; which++) {
            plot_range_take(&axes->values[DISPLACEMENT], motion->displacement[which][i]);
            plot_range_take(&axes->values[VELOCITY], motion->velocity[which][i]);
        }
    }
}

static bool is_on(const struct axes *axes, double time)
{
    return time >= axes->time.low && time <= axes->time.high;
}

/* Of the instants that are on the axis of time. */
static void take_run(struct axes *axes, const struct impact_run *run)
{
    const struct percuss_contact_trace *trace = trace_of(run);
    for (size_t i = 0; i < trace->count; i++) {
        if (!is_on(axes, trace->time[i]))
            continue;
        plot_range_take(&axes->values[DISPLACEMENT], trace->displacement_a[i]);
        plot_range_take(&axes->values[DISPLACEMENT], trace->displacement_b[i]);
        plot_range_take(&axes->values[VELOCITY], trace->velocity_a[i]);
        plot_range_take(&axes->values[VELOCITY], trace->velocity_b[i]);
        plot_range_take(&axes->values[FORCE], trace->force[i]);
    }
}

static struct axes take_axes(const struct impact_picture *picture)
{
    struct axes axes = {PLOT_NOTHING, {PLOT_NOTHING, PLOT_NOTHING, PLOT_NOTHING}};
    const size_t count = picture->speed_count * picture->model_count;
    /* the time of all of them, then the numbers of each panel */
    for (size_t k = 0; k < count; k++) {
        const struct plot_range times = drawn_times(&picture->runs[k]);
        plot_range_take(&axes.time, times.low);
        plot_range_take(&axes.time, times.high);
    }
    for (size_t speed = 0; speed < picture->measured_count; speed++)
        take_measured(&axes, picture, speed);
    for (size_t k = 0; k < count; k++)
        take_run(&axes, &picture->runs[k]);
    return axes;
}

/* Writes the data along the axis of time. */
static void write_run(struct plot *plot, const struct impact_picture *picture, size_t k,
                      const struct axes *axes)
{
    const struct percuss_contact_trace *trace = trace_of(&picture->runs[k]);
    char name[PLOT_NAME];
    snprintf(name, sizeof name, "impact_%zu_%zu", k / picture->model_count + 1,
             k % picture->model_count + 1);
    plot_table(plot, name, "time,force,displacement_a,displacement_b,velocity_a,velocity_b");
    for (size_t i = 0; i < trace->count; i++) {
        if (!is_on(axes, trace->time[i]))
            continue;
        fprintf(plot->data, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", trace->time[i], trace->force[i],
                trace->displacement_a[i], trace->displacement_b[i], trace->velocity_a[i],
                trace->velocity_b[i]);
    }
}

/* In the units of the panels: ms; um, m/s, N. */
static const double scales[PANELS] = {1e6, 1.0, 1.0};
static const char *const labels[PANELS] = {"displacement / µm", "velocity / (m/s)",
                                           "contact force / N"};

static void set_ranges(const struct plot *plot, const struct axes *axes, int panel)
{
    struct plot_range time = {1e3 * axes->time.low, 1e3 * axes->time.high};
    struct plot_range values = axes->values[panel];
    values.low *= scales[panel];
    values.high *= scales[panel];
    plot_range_set(plot, "xrange", &time, 0.02);
    plot_range_set(plot, "yrange", &values, 0.05);
}

/* The name of a curve in the legend, which stands above the first panel. */
static void write_title(const struct plot *plot, const struct impact_run *run, int which,
                        const char *model)
{
    char title[2 * PERCUSS_ID_SIZE];
    snprintf(title, sizeof title, "%s%s%s", name_of(run, which), model ? ", " : "",
             model ? model : "");
    fputs(" title ", plot->script);
    plot_text(plot, title);
}

/* Measured points of both bodies, below the simulated lines; the legend's are large. */
static void write_points(const struct plot *plot, const struct impact_picture *picture,
                         size_t speed, int panel)
{
    const struct impact_measured *measured = &picture->measured[speed];
    const struct impact_run *run = &picture->runs[speed * picture->model_count];
    for (int which = 0; which < 2; which++) {
        if (!measured->motion.velocity[which])
            continue;
        fprintf(plot->script,
                "@measured_%zu using ($1*1e3):($%d*%g) with points pt 7 ps 0.4 lc rgb '%s' "
                "notitle, ",
                speed + 1, 3 + 2 * panel + which, scales[panel], pale[which]);
        if (panel != DISPLACEMENT)
            continue;
        fprintf(plot->script, "keyentry with points pt 7 ps 1 lc rgb '%s'", pale[which]);
        write_title(plot, run, which, plot_file_name(measured->file));
        fputs(", ", plot->script);
    }
}

/* A line for each model and body, or for the force. */
static void write_lines(const struct plot *plot, const struct impact_picture *picture, size_t speed,
                        int panel)
{
    for (size_t m = 0; m < picture->model_count; m++) {
        const struct impact_run *run = &picture->runs[speed * picture->model_count + m];
        const char *model = picture->model_count > 1
                                ? percuss_contact_model_name(run->request.options.contact_model)
                                : NULL;
        for (int which = 0; which < (panel == FORCE ? 1 : 2); which++) {
            fprintf(plot->script,
                    "%s@impact_%zu_%zu using ($1*1e3):($%d*%g) with lines %s lc rgb '%s'",
                    m + (size_t)which > 0 ? ", " : "", speed + 1, m + 1,
                    panel == FORCE ? 2 : 3 + 2 * panel + which, scales[panel], styles[m % STYLES],
                    panel == FORCE ? dark[m % STYLES] : colours[which][m % STYLES]);
            if (panel == DISPLACEMENT)
                write_title(plot, run, which, model);
            else
                fputs(" notitle", plot->script);
        }
    }
    fputc('\n', plot->script);
}

/* Writes the contact's results above the legend. */
static void write_heading(const struct plot *plot, const struct impact_picture *picture,
                          size_t speed, double middle)
{
    const struct impact_run *run = &picture->runs[speed * picture->model_count];
    const struct percuss_contact_result *contact =
        &run->reply.contacts[largest_contact(&run->reply)];
    char title[160] = "";
    size_t length = 0;
    if (picture->speeds)
        length = (size_t)snprintf(title, sizeof title, "%.6g m/s: ", picture->speeds[speed]);
    for (size_t m = 0; m < picture->model_count; m++) {
        const struct percuss_reply *reply = &run[m].reply;
        length += (size_t)snprintf(title + length, sizeof title - length, "%s%.4f",
                                   m == 0 ? "e = " : " / ",
                                   reply->contacts[largest_contact(reply)].restitution);
    }
    if (picture->model_count == 1)
        snprintf(title + length, sizeof title - length, ", %u sub-impact%s",
                 contact->sub_impact_count, contact->sub_impact_count == 1 ? "" : "s");
    fputs("set label 1 ", plot->script);
    plot_text(plot, title);
    fprintf(plot->script, " at screen %.6g,0.95 center\n", middle);
}

/* One impact: its panels below each other, the axis of time below all of them. */
static void write_impact(const struct plot *plot, const struct impact_picture *picture,
                         size_t speed, const struct axes *axes)
{
    double whole = plot->width, wide = (whole - AXIS) / (double)picture->speed_count;
    double left = AXIS + wide * (double)speed;
    fprintf(plot->script, "set lmargin at screen %.6g\nset rmargin at screen %.6g\n", left / whole,
            (left + wide - GAP) / whole);
    write_heading(plot, picture, speed, (left + 0.5 * (wide - GAP)) / whole);
    for (int panel = 0; panel < PANELS; panel++) {
        fprintf(plot->script, "set origin 0,%g\nset size 1,%g\n", origins[panel], heights[panel]);
        set_ranges(plot, axes, panel);
        if (speed == 0)
            fprintf(plot->script, "set ylabel '%s'\n", labels[panel]);
        if (panel == FORCE)
            fputs("set format x '%g'\nset xlabel 'time / ms'\n", plot->script);
        fputs("plot ", plot->script);
        if (panel != FORCE && speed < picture->measured_count)
            write_points(plot, picture, speed, panel);
        write_lines(plot, picture, speed, panel);
        fputs("unset label 1\n", plot->script);
    }
    /* the next ones share the axes of the first */
    fputs("set format xy ''\nunset xlabel\nunset ylabel\n", plot->script);
}

int plot_impact(const struct plot_output *output, const struct impact_picture *picture)
{
    struct plot plot;
    size_t speeds = picture->speed_count;
    unsigned width = speeds > 1 ? NARROW * (unsigned)speeds : WIDTH;
    int code = plot_begin(&plot, output, AXIS + width, HEIGHT);
    if (code != EXIT_ANSWERED)
        return code;
    const struct axes axes = take_axes(picture);
    for (size_t k = 0; k < speeds * picture->model_count; k++)
        write_run(&plot, picture, k, &axes);
    for (size_t speed = 0; speed < picture->measured_count; speed++)
        write_measured(&plot, picture, speed);
    /* over all of them */
    char title[2 * PERCUSS_ID_SIZE + 8];
    snprintf(title, sizeof title, "%s on %s", name_of(picture->runs, 0), name_of(picture->runs, 1));
    fputs("set multiplot title ", plot.script);
    plot_text(&plot, picture->title ? picture->title : title);
    fputs("\nset format x ''\n", plot.script);
    for (size_t speed = 0; speed < speeds; speed++)
        write_impact(&plot, picture, speed, &axes);
    fputs("unset multiplot\n", plot.script);
    return plot_end(&plot);
}

int write_trace_csv(const char *file, const struct percuss_trace *trace, bool units)
{
    FILE *out = strcmp(file, "-") ? fopen(file, "w") : stdout;
    if (!out) {
        complain("--trace: %s: %s", file, strerror(errno));
        return EXIT_FAILURE;
    }
    bool friction = false;
    for (size_t c = 0; c < trace->contact_count; c++)
        friction = friction || trace->contacts[c].slip_1;
    csv_head(out,
             "contact,time,force,indentation,gap,gap_rate,displacement_a,velocity_a,displacement_b,"
             "velocity_b",
             units);
    if (friction)
        csv_head(out, ",force_tangential_1,force_tangential_2,slip_1,slip_2", units);
    putc('\n', out);
    for (size_t c = 0; c < trace->contact_count; c++) {
        const struct percuss_contact_trace *t = &trace->contacts[c];
        for (size_t i = 0; i < t->count; i++) {
            fprintf(out, "%zu,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g", c, t->time[i],
                    t->force[i], t->indentation[i], t->gap[i], t->gap_rate[i], t->displacement_a[i],
                    t->velocity_a[i], t->displacement_b[i], t->velocity_b[i]);
            if (t->slip_1)
                fprintf(out, ",%.17g,%.17g,%.17g,%.17g", t->force_tangential_1[i],
                        t->force_tangential_2[i], t->slip_1[i], t->slip_2[i]);
            else if (friction)
                fputs(",nan,nan,nan,nan", out);
            putc('\n', out);
        }
    }
    /* a full disk may show only at the end */
    bool written = !ferror(out) && (out == stdout ? fflush(out) : fclose(out)) == 0;
    if (!written)
        complain("--trace: %s: writing failed", file);
    return written ? EXIT_ANSWERED : EXIT_FAILURE;
}
