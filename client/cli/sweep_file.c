/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "sweep_file.h"

#include <errno.h>
#include <percuss/percuss.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"

/* A file under way. */
struct reading {
    const char *name;
    const struct sweep_points *points;
    FILE *file;
    char *line;
    size_t room, number; /* of the line */
    long good;           /* where the last whole line ends */
};

/* A whole line without its end; false: there is none. */
static bool next_line(struct reading *reading)
{
    ssize_t length = getline(&reading->line, &reading->room, reading->file);
    if (length <= 0 || reading->line[length - 1] != '\n')
        return false;
    reading->line[length - 1] = '\0';
    reading->number++;
    reading->good = ftell(reading->file);
    return true;
}

/* What a function would write, without the end of the line; NULL: no memory. */
static char *line_of(const struct sweep_points *points, size_t k, unsigned i, bool head)
{
    char *text = NULL;
    size_t size;
    FILE *memory = open_memstream(&text, &size);
    if (!memory)
        return NULL;
    if (head)
        sweep_csv_head(points, memory);
    else
        sweep_csv_row(points, k, i, memory);
    if (fclose(memory) != 0 || size == 0)
        return text;
    text[size - 1] = '\0';
    return text;
}

static const char *status_of(const char *name)
{
    for (unsigned status = 0; status < PERCUSS_STATUS_COUNT; status++)
        if (strcmp(percuss_status_name(status), name) == 0)
            return percuss_status_name(status);
    return NULL;
}

/* The row in the line, if it is one: as it would be written. */
static bool parse_row(const struct reading *reading, size_t k, unsigned i, struct sweep_row *row)
{
    char status[32] = "";
    const char *text = reading->line;
    for (int skipped = 0; reading->points->curve_count > 1 && skipped < 2; skipped++) {
        text = strchr(text, ',');
        if (!text)
            return false;
        text++;
    }
    if (sscanf(text, "%lf,%lf,%lf,%lf,%u,%u,%lf,%31[^,]", &row->speed, &row->restitution,
               &row->error, &row->impulse, &row->sub_impacts, &row->significant, &row->end_time,
               status) != 8)
        return false;
    row->status = status_of(status);
    if (!row->status || row->speed != reading->points->speeds[i])
        return false;
    char *written = line_of(reading->points, k, i, false);
    bool same = written && strcmp(written, reading->line) == 0;
    free(written);
    return same;
}

static int refuse(const struct reading *reading, const char *what)
{
    complain("--resume: %s:%zu: '%.200s' %s: another sweep's file?", reading->name, reading->number,
             reading->line, what);
    return EXIT_USAGE;
}

static int read_rows(struct reading *reading, struct sweep_curve *curves)
{
    char *head = line_of(reading->points, 0, 0, true);
    if (!head)
        return complain_memory();
    bool empty = !next_line(reading), good = empty || strcmp(head, reading->line) == 0;
    free(head);
    if (!good)
        return refuse(reading, "is not the first line of this sweep");
    /* curve by curve, speed by speed, as they are asked for */
    for (size_t k = 0; !empty && k < reading->points->curve_count; k++)
        for (unsigned i = 0; i < reading->points->count; i++) {
            if (!next_line(reading))
                return EXIT_ANSWERED;
            if (!parse_row(reading, k, i, &curves[k].rows[i]))
                return refuse(reading, "is not the row of this sweep that stands here");
            curves[k].done = i + 1;
        }
    if (!empty && next_line(reading))
        return refuse(reading, "is one row more than this sweep has");
    return EXIT_ANSWERED;
}

int sweep_file_open(const char *name, const struct sweep_points *points, struct sweep_curve *curves,
                    FILE **file)
{
    struct reading reading = {.name = name, .points = points, .file = fopen(name, "a+e")};
    *file = NULL;
    if (!reading.file) {
        complain("--resume: %s: %s", name, strerror(errno));
        return EXIT_USAGE;
    }
    rewind(reading.file);
    int code = read_rows(&reading, curves);
    /* what was cut goes; what comes is added at the end */
    if (code == EXIT_ANSWERED && ftruncate(fileno(reading.file), reading.good) != 0) {
        complain("--resume: %s: %s", name, strerror(errno));
        code = EXIT_FAILURE;
    }
    free(reading.line);
    if (code != EXIT_ANSWERED) {
        fclose(reading.file);
        return code;
    }
    fseek(reading.file, 0, SEEK_END);
    if (reading.good == 0)
        sweep_csv_head(points, reading.file);
    *file = reading.file;
    return EXIT_ANSWERED;
}

bool sweep_file_agrees(const char *name, const struct sweep_points *points, size_t k, unsigned i,
                       const struct percuss_reply *again)
{
    struct sweep_row row = sweep_row_of(again, points->speeds[i]);
    struct sweep_curve curve = points->curves[k];
    struct sweep_points other = *points;
    const double speed = points->speeds[i];
    /* the same curve with the row alone */
    curve.rows = &row;
    other.curves = &curve;
    char *held = line_of(points, k, i, false), *fresh = line_of(&other, 0, 0, false);
    bool same = held && fresh && strcmp(held, fresh) == 0;
    if (!same)
        complain(
            "--resume: %s: its row at %g m/s, '%s', is '%s' now: it has the answers to another "
            "question, or of another catalogue",
            name, speed, held ? held : "", fresh ? fresh : "");
    free(held);
    free(fresh);
    return same;
}
