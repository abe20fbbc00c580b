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

/* Along both tangents, by one model after the other. */
static const char *const tangent_colours[2][2] = {{"#3c8c46", "#0f3a16"}, {"#8a4ba0", "#38154a"}};

/* Pixels of one impact, and of the axis before the first. */
enum { WIDTH = 900, NARROW = 520, AXIS = 100, GAP = 30 };

/* The panels of an impact, from above; the slip with friction alone. */
enum { DISPLACEMENT, VELOCITY, FORCE, SLIP, PANELS };

/* In pixels: the picture, and each panel's height and lower edge. The first has room for the
 * legend. */
struct layout {
    int panels;
    unsigned height;
    double heights[PANELS], origins[PANELS];
};
static const struct layout frictionless = {3, 960, {403.2, 259.2, 240}, {494.4, 244.8, 9.6}};
static const struct layout sliding = {4, 1160, {383, 229, 240, 230}, {714, 485, 240, 10}};

/* Below them, with room of their own in pixels: the sub-impacts with friction beside each other,
 * and Coulomb's circle. */
enum {
    BLOWS = 3,
    BLOW_ROW = 340,
    BLOW_BOTTOM = 70,
    BLOW_HEIGHT = 230,
    BLOW_GAP = 14,
    CIRCLE = 330
};

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

static const struct percuss_contact_result *result_of(const struct impact_run *run)
{
    return &run->reply.contacts[largest_contact(&run->reply)];
}

/* Whether all of them have friction, by their histories. */
static bool slides(const struct impact_picture *picture)
{
    for (size_t k = 0; k < picture->speed_count * picture->model_count; k++)
        if (!trace_of(&picture->runs[k])->slip_1)
            return false;
    return true;
}

/* Whether anything but rounding happens along the second tangent. */
static bool turns(const struct impact_picture *picture)
{
    static const double nothing = 1e-6;
    for (size_t k = 0; k < picture->speed_count * picture->model_count; k++) {
        const struct percuss_contact_trace *trace = trace_of(&picture->runs[k]);
        double first = 0.0, second = 0.0;
        for (size_t i = 0; i < trace->count; i++) {
            first = fmax(first, fmax(fabs(trace->slip_1[i]), fabs(trace->gap_rate[i])));
            second = fmax(second, fabs(trace->slip_2[i]));
        }
        if (second > nothing * first)
            return true;
    }
    return false;
}

/* The largest tangential force that the coefficient allows. */
static double limit_at(const struct impact_run *run, size_t i)
{
    return result_of(run)->friction * trace_of(run)->force[i];
}

/* The times that are drawn: the contacts, and a quarter of their time before and after them. A
 * trace goes on for as long as vibration could bring the bodies together again. */
static struct plot_range drawn_times(const struct impact_run *run)
{
    const struct percuss_contact_trace *trace = trace_of(run);
    const struct percuss_contact_result *contact = result_of(run);
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
        if (!trace->slip_1)
            continue;
        plot_range_take(&axes->values[FORCE], -limit_at(run, i));
        plot_range_take(&axes->values[SLIP], trace->slip_1[i]);
        plot_range_take(&axes->values[SLIP], trace->slip_2[i]);
    }
}

static struct axes take_axes(const struct impact_picture *picture)
{
    static const double least_slip = 0.1; /* of the velocities: less is rounding */
    struct axes axes = {PLOT_NOTHING, {PLOT_NOTHING, PLOT_NOTHING, PLOT_NOTHING, PLOT_NOTHING}};
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
    double least = least_slip * (axes.values[VELOCITY].high - axes.values[VELOCITY].low);
    plot_range_take(&axes.values[SLIP], least);
    plot_range_take(&axes.values[SLIP], -least);
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
    plot_table(plot, name,
               trace->slip_1 ? "time,force,displacement_a,displacement_b,velocity_a,velocity_b,"
                               "limit,force_tangential_1,force_tangential_2,slip_1,slip_2"
                             : "time,force,displacement_a,displacement_b,velocity_a,velocity_b");
    for (size_t i = 0; i < trace->count; i++) {
        if (!is_on(axes, trace->time[i]))
            continue;
        fprintf(plot->data, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g", trace->time[i], trace->force[i],
                trace->displacement_a[i], trace->displacement_b[i], trace->velocity_a[i],
                trace->velocity_b[i]);
        if (trace->slip_1)
            fprintf(plot->data, ",%.9g,%.9g,%.9g,%.9g,%.9g", limit_at(&picture->runs[k], i),
                    trace->force_tangential_1[i], trace->force_tangential_2[i], trace->slip_1[i],
                    trace->slip_2[i]);
        putc('\n', plot->data);
    }
}

/* In the units of the panels: ms; um, m/s, N, m/s. Slow velocities in mm/s: the numbers of an axis
 * have their room. */
struct unit {
    double scale;
    const char *label;
};

static struct unit unit_of(const struct axes *axes, int panel)
{
    static const double slow = 0.05;
    static const struct unit units[PANELS] = {{1e6, "displacement / µm"},
                                              {1.0, "velocity / (m/s)"},
                                              {1.0, "contact force / N"},
                                              {1.0, "slip / (m/s)"}};
    const struct plot_range *values = &axes->values[panel];
    bool small = values->high - values->low < slow;
    if (small && panel == VELOCITY)
        return (struct unit){1e3, "velocity / (mm/s)"};
    return small && panel == SLIP ? (struct unit){1e3, "slip / (mm/s)"} : units[panel];
}

/* Columns of the tables. */
enum { COLUMN_FORCE = 2, COLUMN_LIMIT = 7, COLUMN_TANGENTIAL = 8, COLUMN_SLIP = 10 };

static void set_ranges(const struct plot *plot, const struct axes *axes, int panel)
{
    struct plot_range time = {1e3 * axes->time.low, 1e3 * axes->time.high};
    struct plot_range values = axes->values[panel];
    values.low *= unit_of(axes, panel).scale;
    values.high *= unit_of(axes, panel).scale;
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
                         size_t speed, const struct axes *axes, int panel)
{
    const struct impact_measured *measured = &picture->measured[speed];
    const struct impact_run *run = &picture->runs[speed * picture->model_count];
    for (int which = 0; which < 2; which++) {
        if (!measured->motion.velocity[which])
            continue;
        fprintf(plot->script,
                "@measured_%zu using ($1*1e3):($%d*%g) with points pt 7 ps 0.4 lc rgb '%s' "
                "notitle, ",
                speed + 1, 3 + 2 * panel + which, unit_of(axes, panel).scale, pale[which]);
        if (panel != DISPLACEMENT)
            continue;
        fprintf(plot->script, "keyentry with points pt 7 ps 1 lc rgb '%s'", pale[which]);
        write_title(plot, run, which, plot_file_name(measured->file));
        fputs(", ", plot->script);
    }
}

/* A line from one column, on the axis of time in ms; a NULL title: none. */
static void write_line(const struct plot *plot, const char *table, int column, double scale,
                       const char *style, const char *colour, const char *title)
{
    fprintf(plot->script, "%s using ($1*1e3):($%d*%g) with lines %s lc rgb '%s' ", table, column,
            scale, style, colour);
    fputs(title ? "title " : "notitle", plot->script);
    if (title)
        plot_text(plot, title);
}

static const char *const tangent_names[2][2] = {{"tangential force", ""},
                                                {"along the first tangent", "along the second"}};

/* Coulomb's limits of the first model, and the tangential force or the slip of every one. */
static void write_tangential(const struct plot *plot, const struct impact_picture *picture,
                             size_t speed, const struct axes *axes, int panel)
{
    bool both = turns(picture);
    for (size_t m = 0; m < picture->model_count; m++) {
        char table[PLOT_NAME];
        snprintf(table, sizeof table, "@impact_%zu_%zu", speed + 1, m + 1);
        for (int side = 1; side >= -1 && m == 0 && panel == FORCE; side -= 2) {
            fputs(", ", plot->script);
            write_line(plot, table, COLUMN_LIMIT, side, "lw 1.5 dt (6,5)", "#606060",
                       side > 0 ? "Coulomb's limit" : NULL);
        }
        for (int t = 0; t < (both ? 2 : 1); t++) {
            const char *title = m > 0 || (panel == SLIP && !both) ? NULL : tangent_names[both][t];
            fputs(panel == FORCE || m > 0 || t > 0 ? ", " : "", plot->script);
            write_line(plot, table, (panel == FORCE ? COLUMN_TANGENTIAL : COLUMN_SLIP) + t,
                       unit_of(axes, panel).scale, styles[m % STYLES], tangent_colours[t][m % 2],
                       title);
        }
    }
}

/* A line for each model and body, or for the force. */
static void write_lines(const struct plot *plot, const struct impact_picture *picture, size_t speed,
                        const struct axes *axes, int panel)
{
    for (size_t m = 0; m < picture->model_count && panel != SLIP; m++) {
        const struct impact_run *run = &picture->runs[speed * picture->model_count + m];
        const char *model = picture->model_count > 1
                                ? percuss_contact_model_name(run->request.options.contact_model)
                                : NULL;
        for (int which = 0; which < (panel == FORCE ? 1 : 2); which++) {
            fprintf(
                plot->script, "%s@impact_%zu_%zu using ($1*1e3):($%d*%g) with lines %s lc rgb '%s'",
                m + (size_t)which > 0 ? ", " : "", speed + 1, m + 1,
                panel == FORCE ? COLUMN_FORCE : 3 + 2 * panel + which, unit_of(axes, panel).scale,
                styles[m % STYLES], panel == FORCE ? dark[m % STYLES] : colours[which][m % STYLES]);
            if (panel == DISPLACEMENT)
                write_title(plot, run, which, model);
            else
                fputs(panel == FORCE && m == 0 && slides(picture) ? " title 'normal force'"
                                                                  : " notitle",
                      plot->script);
        }
    }
    if (panel >= FORCE && slides(picture))
        write_tangential(plot, picture, speed, axes, panel);
    fputc('\n', plot->script);
}

/* Writes the contact's results above the legend. */
static void write_heading(const struct plot *plot, const struct impact_picture *picture,
                          size_t speed, double middle)
{
    const struct impact_run *run = &picture->runs[speed * picture->model_count];
    const struct percuss_contact_result *contact = result_of(run);
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
        length +=
            (size_t)snprintf(title + length, sizeof title - length, ", %u sub-impact%s",
                             contact->sub_impact_count, contact->sub_impact_count == 1 ? "" : "s");
    if (contact->friction > 0.0)
        snprintf(title + length, sizeof title - length, ", friction %.4g", contact->friction);
    fputs("set label 1 ", plot->script);
    plot_text(plot, title);
    fprintf(plot->script, " at screen %.6g,%.6g center\n", middle, 1.0 - 48.0 / plot->height);
}

/* One impact: its panels below each other, the axis of time below all of them. */
static void write_impact(const struct plot *plot, const struct impact_picture *picture,
                         size_t speed, const struct axes *axes)
{
    bool friction = slides(picture);
    const struct layout *layout = friction ? &sliding : &frictionless;
    double high = plot->height, below = high - layout->height;
    double whole = plot->width, wide = (whole - AXIS) / (double)picture->speed_count;
    double left = AXIS + wide * (double)speed;
    fprintf(plot->script, "set lmargin at screen %.6g\nset rmargin at screen %.6g\n", left / whole,
            (left + wide - GAP) / whole);
    write_heading(plot, picture, speed, (left + 0.5 * (wide - GAP)) / whole);
    for (int panel = 0; panel < layout->panels; panel++) {
        fprintf(plot->script, "set origin 0,%.6g\nset size 1,%.6g\n",
                (below + layout->origins[panel]) / high, layout->heights[panel] / high);
        set_ranges(plot, axes, panel);
        if (speed == 0)
            fprintf(plot->script, "set ylabel '%s'\n", unit_of(axes, panel).label);
        if (panel == layout->panels - 1)
            fputs("set format x '%g'\nset xlabel 'time / ms'\n", plot->script);
        fputs("plot ", plot->script);
        if (panel < FORCE && speed < picture->measured_count)
            write_points(plot, picture, speed, axes, panel);
        write_lines(plot, picture, speed, axes, panel);
        fputs("unset label 1\n", plot->script);
    }
    /* the next ones share the axes of the first */
    fputs("set format xy ''\nunset xlabel\nunset ylabel\n", plot->script);
}

/* The sub-impacts with friction, larger. */

/* The largest sub-impacts of the first model, in their order, without negligible ones. */
static size_t list_blows(const struct impact_picture *picture, uint32_t list[BLOWS])
{
    const struct percuss_contact_result *contact = result_of(picture->runs);
    size_t count = 0;
    for (uint32_t i = 0; i < contact->sub_impacts_listed; i++) {
        const struct percuss_sub_impact *sub = &contact->sub_impacts[i];
        size_t larger = 0;
        for (uint32_t j = 0; j < contact->sub_impacts_listed; j++)
            larger += contact->sub_impacts[j].impulse > sub->impulse;
        if (larger < BLOWS && count < BLOWS && !sub->negligible && sub->end > sub->start)
            list[count++] = i;
    }
    return count;
}

/* The table of a sub-impact by one model: time from its start in the first model, Coulomb's limits,
 * tangential forces, and these as parts of the limit where that is not hardly anything. */
static void write_blow(struct plot *plot, const struct impact_picture *picture, size_t blow,
                       const struct percuss_sub_impact *sub, size_t m, struct plot_range *forces)
{
    static const double hardly = 0.01, beside = 0.05;
    const struct impact_run *run = &picture->runs[m];
    const struct percuss_contact_trace *trace = trace_of(run);
    double length = sub->end - sub->start, most = result_of(run)->friction * sub->peak_force;
    char name[PLOT_NAME];
    snprintf(name, sizeof name, "sub_impact_%zu_%zu", blow + 1, m + 1);
    plot_table(plot, name, "time,limit,force_tangential_1,force_tangential_2,part_1,part_2");
    for (size_t i = 0; i < trace->count; i++) {
        double time = trace->time[i] - sub->start, limit = limit_at(run, i);
        double by = limit > hardly * most ? 1.0 / limit : NAN;
        if (!(time >= -beside * length && time <= (1.0 + beside) * length))
            continue;
        fprintf(plot->data, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", time, limit,
                trace->force_tangential_1[i], trace->force_tangential_2[i],
                trace->force_tangential_1[i] * by, trace->force_tangential_2[i] * by);
        plot_range_take(forces, limit);
        plot_range_take(forces, -limit);
    }
}

/* Sets the margins of a panel, in pixels. */
static void set_place(const struct plot *plot, double left, double right)
{
    fprintf(plot->script,
            "set lmargin at screen %.6g\nset rmargin at screen %.6g\nset bmargin at screen %.6g\n"
            "set tmargin at screen %.6g\n",
            left / plot->width, right / plot->width, (double)BLOW_BOTTOM / plot->height,
            (double)(BLOW_BOTTOM + BLOW_HEIGHT) / plot->height);
}

/* A step of tics for at most `most` of them. */
static double tic_step(double length, size_t most)
{
    static const double steps[] = {1.0, 2.0, 5.0, 10.0};
    double ten = pow(10.0, floor(log10(length / (double)most)));
    size_t k = 0;
    while (k < 3 && steps[k] * ten * (double)most < length)
        k++;
    return steps[k] * ten;
}

/* One sub-impact: the tangential forces within their limits. */
static void write_blow_panel(const struct plot *plot, const struct impact_picture *picture,
                             size_t blow, uint32_t number, size_t count)
{
    const struct percuss_sub_impact *sub = &result_of(picture->runs)->sub_impacts[number];
    double length = 1e6 * (sub->end - sub->start);
    char title[96];
    snprintf(title, sizeof title, "%u at %.4g ms: %s", number + 1, 1e3 * sub->start,
             percuss_friction_state_name(sub->friction_state));
    fputs("set title ", plot->script);
    plot_text(plot, title);
    fprintf(plot->script, "\nunset key\nset xtics %.6g\n", tic_step(length, 12 / count));
    plot_range_set(plot, "xrange", &(struct plot_range){0.0, length}, 0.06);
    const char *comma = "plot ";
    for (size_t m = 0; m < picture->model_count; m++) {
        for (int side = 1; side >= -1 && m == 0; side -= 2) {
            fprintf(
                plot->script,
                "%s@sub_impact_%zu_%zu using ($1*1e6):($2*%d) with lines lw 1.5 dt (6,5) lc rgb "
                "'#606060'",
                comma, blow + 1, m + 1, side);
            comma = ", ";
        }
        for (int t = 0; t < (turns(picture) ? 2 : 1); t++)
            fprintf(plot->script,
                    ", @sub_impact_%zu_%zu using ($1*1e6):($%d*1) with lines %s lc rgb '%s'",
                    blow + 1, m + 1, 3 + t, styles[m % STYLES], tangent_colours[t][m % 2]);
    }
    fputs("\nunset ylabel\nset format y ''\n", plot->script);
}

/* The way of the tangential force in Coulomb's circle, a colour for each sub-impact. */
static void write_circle(const struct plot *plot, const struct impact_picture *picture,
                         const uint32_t *blow, size_t count)
{
    static const char *const blow_colours[BLOWS] = {"#1f5fa8", "#c8501e", "#101010"};
    fputs("unset title\nset format y '%g'\nset xtics 1\nset ytics 1\n"
          "set xlabel 'force along the first / limit'\nset ylabel 'along the second / limit'\n"
          "set key outside top center horizontal\n"
          "set object 1 circle at 0,0 size 1 fs empty border lc rgb '#606060'\n"
          "set xrange [-1.15:1.15]\nset yrange [-1.15:1.15]\n",
          plot->script);
    const char *comma = "plot ";
    for (size_t k = 0; k < count; k++)
        for (size_t m = 0; m < picture->model_count; m++) {
            fprintf(plot->script, "%s@sub_impact_%zu_%zu using 5:6 with lines %s lc rgb '%s' ",
                    comma, k + 1, m + 1, styles[m % STYLES], blow_colours[k]);
            if (m == 0)
                fprintf(plot->script, "title '%u'", blow[k] + 1);
            else
                fputs("notitle", plot->script);
            comma = ", ";
        }
    fputc('\n', plot->script);
}

static void write_blows(struct plot *plot, const struct impact_picture *picture)
{
    uint32_t blow[BLOWS];
    size_t count = list_blows(picture, blow);
    struct plot_range forces = PLOT_NOTHING;
    if (count == 0)
        return;
    for (size_t k = 0; k < count; k++)
        for (size_t m = 0; m < picture->model_count; m++)
            write_blow(plot, picture, k, &result_of(picture->runs)->sub_impacts[blow[k]], m,
                       &forces);
    bool circle = turns(picture);
    double wide = (plot->width - AXIS - (circle ? CIRCLE : GAP - BLOW_GAP)) / (double)count;
    fputs("set format x '%g'\nset format y '%g'\nset xlabel 'time from start / µs'\n"
          "set ylabel 'tangential force / N'\n",
          plot->script);
    plot_range_set(plot, "yrange", &forces, 0.05);
    fprintf(plot->script, "set origin 0,0\nset size 1,%.6g\n", (double)BLOW_ROW / plot->height);
    for (size_t k = 0; k < count; k++) {
        double left = AXIS + wide * (double)k;
        set_place(plot, left, left + wide - BLOW_GAP);
        write_blow_panel(plot, picture, k, blow[k], count);
    }
    if (!circle)
        return;
    set_place(plot, plot->width - GAP - BLOW_HEIGHT, plot->width - GAP);
    write_circle(plot, picture, blow, count);
}

int plot_impact(const struct plot_output *output, const struct impact_picture *picture)
{
    struct plot plot;
    size_t speeds = picture->speed_count;
    unsigned width = speeds > 1 ? NARROW * (unsigned)speeds : WIDTH;
    bool friction = slides(picture), larger = friction && speeds == 1;
    unsigned height = (friction ? sliding : frictionless).height + (larger ? BLOW_ROW : 0);
    int code = plot_begin(&plot, output, AXIS + width, height);
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
    if (larger)
        write_blows(&plot, picture);
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
