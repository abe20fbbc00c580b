/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plot_impact.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
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

/* One panel: the columns of bodies A and B, with the force on the right-hand axis. */
static void write_panel(const struct plot *plot, const char *label, int column, const char *a,
                        const char *b)
{
    fprintf(plot->script,
            "set ylabel '%s'\nplot $data using 1:2 axes x1y2 with filledcurves "
            "above y2=0 lc rgb '#d8d8d8' title 'contact force', ",
            label);
    fprintf(plot->script, "'' using 1:%d with lines lt 1 title ", column);
    plot_text(plot, a);
    fprintf(plot->script, ", '' using 1:%d with lines lt 2 title ", column + 1);
    plot_text(plot, b);
    fputc('\n', plot->script);
}

int plot_impact(const char *file, const struct percuss_request *request,
                const struct percuss_reply *reply, const struct percuss_trace *trace)
{
    struct plot plot;
    size_t c = largest_contact(reply);
    const struct percuss_contact_result *contact = &reply->contacts[c];
    const char *a = request->bodies[request->contacts[c].a].id;
    const char *b = request->bodies[request->contacts[c].b].id;
    int code = plot_begin(&plot, file, 1000, 800);
    if (code != EXIT_ANSWERED)
        return code;
    char title[256];
    snprintf(title, sizeof title, "%s on %s: e = %.4f, %u sub-impact%s", a, b, contact->restitution,
             contact->sub_impact_count, contact->sub_impact_count == 1 ? "" : "s");
    write_data(&plot, &trace->contacts[c]);
    /* displacements over velocities, with the force on the right of both */
    fputs("set y2tics\nset y2label 'contact force / N'\nset border 11\nset y2range [0:*]\n"
          "set lmargin 12\nset rmargin 11\n"
          "set multiplot layout 2,1 title ",
          plot.script);
    plot_text(&plot, title);
    fputs("\nset key at screen 0.5,0.94 center horizontal\nset tmargin 4\n", plot.script);
    write_panel(&plot, "displacement / µm", 3, a, b);
    fputs("unset key\nset tmargin 1\nset bmargin 4\nset xlabel 'time / ms'\n", plot.script);
    write_panel(&plot, "velocity / (m/s)", 5, a, b);
    fputs("unset multiplot\n", plot.script);
    return plot_end(&plot);
}

int write_trace_csv(const char *file, const struct percuss_trace *trace)
{
    FILE *out = strcmp(file, "-") ? fopen(file, "w") : stdout;
    if (!out) {
        complain("--trace: %s: %s", file, strerror(errno));
        return EXIT_FAILURE;
    }
    fputs("contact,time,force,indentation,gap,gap_rate,displacement_a,velocity_a,displacement_b,"
          "velocity_b\n",
          out);
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
