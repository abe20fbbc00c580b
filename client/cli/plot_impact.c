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
#include "plot.h"

static size_t largest_contact(const struct percuss_reply *reply)
{
    size_t largest = 0;
    for (size_t c = 1; c < reply->contact_count; c++)
        if (reply->contacts[c].impulse > reply->contacts[largest].impulse)
            largest = c;
    return largest;
}

static void write_data(const struct plot *plot, const struct percuss_contact_trace *trace)
{
    fputs("$data << EOD\n", plot->script);
    for (size_t i = 0; i < trace->count; i++)
        fprintf(plot->script, "%.9g %.9g %.9g %.9g %.9g %.9g\n", 1e3 * trace->time[i],
                trace->force[i], 1e6 * trace->displacement_a[i], 1e6 * trace->displacement_b[i],
                trace->velocity_a[i], trace->velocity_b[i]);
    fputs("EOD\n", plot->script);
}

/* Of the measured motion, what lies within the simulated time and a twentieth before it; the
 * columns are those of write_data. */
static void write_measured(const struct plot *plot, const struct history_motion *motion,
                           double until)
{
    fputs("$measured << EOD\n", plot->script);
    for (size_t i = 0; i < motion->count; i++) {
        if (motion->time[i] < -0.05 * until || motion->time[i] > until)
            continue;
        fprintf(plot->script, "%.9g nan", 1e3 * motion->time[i]);
        for (int which = 0; which < 2; which++)
            fprintf(plot->script, " %.9g",
                    motion->displacement[which] ? 1e6 * motion->displacement[which][i] : NAN);
        for (int which = 0; which < 2; which++)
            fprintf(plot->script, " %.9g",
                    motion->velocity[which] ? motion->velocity[which][i] : NAN);
        fputc('\n', plot->script);
    }
    fputs("EOD\n", plot->script);
}

/* The bodies' names, and what was measured of them. */
struct panels {
    const char *names[2];
    const struct history_motion *measured;
};

/* One panel: the columns of bodies A and B, with the force on the right-hand axis. */
static void write_panel(const struct plot *plot, const char *label, int column,
                        const struct panels *panels)
{
    fprintf(plot->script,
            "set ylabel '%s'\nplot $data using 1:2 axes x1y2 with filledcurves "
            "above y2=0 lc rgb '#d8d8d8' title 'contact force'",
            label);
    /* measured points below the simulated lines */
    for (int which = 0; panels->measured && which < 2; which++)
        if (panels->measured->velocity[which])
            fprintf(plot->script,
                    ", $measured using 1:%d with points lt %d pt 7 ps 0.3 lc rgb '%s' "
                    "title 'measured'",
                    column + which, which + 1, which == 0 ? "#8fb4d8" : "#e4a98f");
    for (int which = 0; which < 2; which++) {
        fprintf(plot->script, ", $data using 1:%d with lines lt %d title ", column + which,
                which + 1);
        plot_text(plot, panels->names[which]);
    }
    fputc('\n', plot->script);
}

int plot_impact(const char *file, const struct impact_picture *picture)
{
    struct plot plot;
    const struct percuss_request *request = picture->request;
    size_t c = largest_contact(picture->reply);
    const struct percuss_contact_result *contact = &picture->reply->contacts[c];
    const struct percuss_contact_trace *trace = &picture->trace->contacts[c];
    const struct panels panels = {
        {request->bodies[request->contacts[c].a].id, request->bodies[request->contacts[c].b].id},
        picture->measured};
    int code = plot_begin(&plot, file, 1000, 800);
    if (code != EXIT_ANSWERED)
        return code;
    char title[256];
    snprintf(title, sizeof title, "%s on %s: e = %.4f, %u sub-impact%s", panels.names[0],
             panels.names[1], contact->restitution, contact->sub_impact_count,
             contact->sub_impact_count == 1 ? "" : "s");
    write_data(&plot, trace);
    if (panels.measured && trace->count > 0)
        write_measured(&plot, panels.measured, trace->time[trace->count - 1]);
    /* displacements over velocities, with the force on the right of both */
    fputs("set y2tics\nset y2label 'contact force / N'\nset border 11\nset y2range [0:*]\n"
          "set lmargin 12\nset rmargin 11\n"
          "set multiplot layout 2,1 title ",
          plot.script);
    plot_text(&plot, title);
    fputs("\nset key at screen 0.5,0.94 center horizontal\nset tmargin 4\n", plot.script);
    write_panel(&plot, "displacement / µm", 3, &panels);
    fputs("unset key\nset tmargin 1\nset bmargin 4\nset xlabel 'time / ms'\n", plot.script);
    write_panel(&plot, "velocity / (m/s)", 5, &panels);
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
    csv_head(out,
             "contact,time,force,indentation,gap,gap_rate,displacement_a,velocity_a,displacement_b,"
             "velocity_b",
             units);
    putc('\n', out);
    for (size_t c = 0; c < trace->contact_count; c++) {
        const struct percuss_contact_trace *t = &trace->contacts[c];
        for (size_t i = 0; i < t->count; i++)
            fprintf(out, "%zu,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", c,
                    t->time[i], t->force[i], t->indentation[i], t->gap[i], t->gap_rate[i],
                    t->displacement_a[i], t->velocity_a[i], t->displacement_b[i], t->velocity_b[i]);
    }
    /* a full disk may show only at the end */
    bool written = !ferror(out) && (out == stdout ? fflush(out) : fclose(out)) == 0;
    if (!written)
        complain("--trace: %s: writing failed", file);
    return written ? EXIT_ANSWERED : EXIT_FAILURE;
}
