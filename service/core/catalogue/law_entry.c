/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/law_entry.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "catalogue/shipped.h"

/* Rows of a curve. */
enum { LEAST_ROWS = 3, MOST_ROWS = 10000, LINE = 256 };

/* The two curves meet: as equal as five printed digits are. */
static const double SAME_POINT = 1e-5;
/* Of a force of loading between two points: digits that were printed. */
static const double ROUNDING = 1e-6;

/* A file that is being read. */
struct rows {
    const char *path;
    struct own_curve curve;
    size_t *line; /* [count]: where they stand */
    struct fault *fault;
};

static enum percuss_status refuse_row(const struct rows *rows, size_t row, const char *must)
{
    return fault_set(rows->fault, PERCUSS_BAD_REQUEST, "%.300s:%zu: %g m, %g N: %s", rows->path,
                     rows->line[row], rows->curve.indentation[row], rows->curve.force[row], must);
}

/* Two numbers and nothing else, with a comma, a semicolon or blanks between them. */
static bool read_row(const char *text, double *indentation, double *force)
{
    char *end;
    *indentation = strtod(text, &end);
    if (end == text)
        return false;
    const char *next = end + strspn(end, " \t");
    next += *next == ',' || *next == ';';
    *force = strtod(next, &end);
    return next > text && end > next && end[strspn(end, " \t\r\n")] == '\0' &&
           isfinite(*indentation) && isfinite(*force);
}

/* Rows as they stand; the first line may be names of columns. */
static enum percuss_status read_rows(FILE *file, struct rows *rows)
{
    char text[LINE];
    struct own_curve *curve = &rows->curve;
    bool named = false;
    for (size_t line = 1; fgets(text, sizeof text, file); line++) {
        double indentation, force;
        size_t blank = strspn(text, " \t\r\n");
        if (text[blank] == '\0' || text[blank] == '#')
            continue;
        if (!read_row(text, &indentation, &force)) {
            if (!named && curve->count == 0 && strlen(text) + 1 < sizeof text) {
                named = true;
                continue;
            }
            return fault_set(rows->fault, PERCUSS_BAD_REQUEST,
                             "%.300s:%zu: must be two finite numbers, an indentation in m and a "
                             "force in N",
                             rows->path, line);
        }
        if (curve->count == MOST_ROWS)
            return fault_set(rows->fault, PERCUSS_BAD_REQUEST,
                             "%.300s:%zu: must have at most %d points", rows->path, line,
                             MOST_ROWS);
        curve->indentation[curve->count] = indentation;
        curve->force[curve->count] = force;
        rows->line[curve->count++] = line;
    }
    return PERCUSS_OK;
}

/* A test of unloading is mostly written as it happened, from the largest indentation on. */
static void turn_round(struct rows *rows)
{
    struct own_curve *curve = &rows->curve;
    size_t n = curve->count;
    if (n < 2 || curve->indentation[0] < curve->indentation[n - 1])
        return;
    for (size_t i = 0; i < n / 2; i++) {
        size_t j = n - 1 - i, line = rows->line[i];
        double d = curve->indentation[i], f = curve->force[i];
        curve->indentation[i] = curve->indentation[j];
        curve->force[i] = curve->force[j];
        rows->line[i] = rows->line[j];
        curve->indentation[j] = d;
        curve->force[j] = f;
        rows->line[j] = line;
    }
}

static enum percuss_status check_rows(const struct rows *rows)
{
    const struct own_curve *curve = &rows->curve;
    if (curve->count < LEAST_ROWS)
        return fault_set(rows->fault, PERCUSS_BAD_REQUEST,
                         "%.300s: %zu points: must have at least %d", rows->path, curve->count,
                         LEAST_ROWS);
    if (curve->force[0] != 0.0)
        return refuse_row(rows, 0, "must have no force: the curve ends there");
    if (!(curve->indentation[0] >= 0.0))
        return refuse_row(rows, 0, "must have an indentation of at least 0");
    for (size_t i = 1; i < curve->count; i++)
        if (!(curve->indentation[i] > curve->indentation[i - 1] &&
              curve->force[i] > curve->force[i - 1]))
            return refuse_row(rows, i,
                              "must rise in both columns from point to point: smooth a measurement "
                              "that does not");
    return PERCUSS_OK;
}

/* `rows` keeps its memory where this fails, too. */
static enum percuss_status read_file(struct rows *rows)
{
    struct stat about;
    FILE *file = fopen(rows->path, "re");
    if (!file || fstat(fileno(file), &about) != 0 || !S_ISREG(about.st_mode)) {
        const char *why = file ? "not a regular file" : strerror(errno);
        if (file)
            fclose(file);
        return fault_set(rows->fault, PERCUSS_BAD_REQUEST, "%.300s: %s", rows->path, why);
    }
    rows->curve.indentation = malloc(2 * MOST_ROWS * sizeof *rows->curve.indentation);
    rows->line = malloc(MOST_ROWS * sizeof *rows->line);
    enum percuss_status status = PERCUSS_INTERNAL;
    if (rows->curve.indentation && rows->line) {
        rows->curve.force = rows->curve.indentation + MOST_ROWS;
        status = read_rows(file, rows);
    } else {
        fault_set(rows->fault, PERCUSS_INTERNAL, "%.300s: out of memory", rows->path);
    }
    fclose(file);
    if (!status)
        turn_round(rows);
    return status ? status : check_rows(rows);
}

/* The force of loading at an indentation within its points, linear between them. */
static double loading_at(const struct own_curve *points, double d)
{
    size_t i = 1;
    while (i + 1 < points->count && points->indentation[i] < d)
        i++;
    const double *x = points->indentation + i, *f = points->force + i;
    return f[-1] + (f[0] - f[-1]) * (d - x[-1]) / (x[0] - x[-1]);
}

/* Unloading begins where loading ended, and bears no more force anywhere: no energy is made. */
static enum percuss_status check_unloading(const struct rows *rows, const struct own_curve *points)
{
    const struct own_curve *back = &rows->curve;
    size_t top = back->count - 1, last = points->count - 1;
    if (!(fabs(back->indentation[top] - points->indentation[last]) <=
          SAME_POINT * points->indentation[last]) ||
        !(fabs(back->force[top] - points->force[last]) <= SAME_POINT * points->force[last])) {
        char must[128];
        snprintf(must, sizeof must, "must be the last one of points, %g m and %g N",
                 points->indentation[last], points->force[last]);
        return refuse_row(rows, top, must);
    }
    for (size_t i = 0; i < top; i++) {
        double loading = loading_at(points, back->indentation[i]);
        if (back->force[i] > loading * (1.0 + ROUNDING)) {
            char must[128];
            snprintf(must, sizeof must,
                     "must not exceed the force of loading there, %g N: it would make energy",
                     loading);
            return refuse_row(rows, i, must);
        }
    }
    return PERCUSS_OK;
}

/* Reads the file that a key names, if it stands there. */
static enum percuss_status read_curve(struct reader *reader, struct entry entry, const char *key,
                                      const struct own_curve *loading, struct own_curve *curve)
{
    const yaml_node_t *name = reader_find(reader, entry.value, key).value;
    if (!name)
        return PERCUSS_OK;
    size_t mark = reader_enter(reader, key);
    struct fault fault = {0};
    char *path = shipped_resolve(reader->name, (const char *)name->data.scalar.value);
    if (!path)
        return fault_set(reader->fault, PERCUSS_INTERNAL, "out of memory");
    struct rows rows = {.path = path, .fault = &fault};
    enum percuss_status status = read_file(&rows);
    if (!status && loading)
        status = check_unloading(&rows, loading);
    if (!status && !loading && rows.curve.indentation[0] != 0.0)
        status = refuse_row(&rows, 0, "must be at 0 m: the touch");
    *curve = rows.curve;
    free(rows.line);
    free(path);
    if (status == PERCUSS_INTERNAL)
        return fault_set(reader->fault, status, "%s", fault.text);
    if (status)
        return reader_refuse(reader, name, "%s", fault.text);
    reader_leave(reader, mark);
    return PERCUSS_OK;
}

/* Refuses a key beside another one. */
static enum percuss_status refuse_beside(struct reader *reader, struct entry entry, const char *key,
                                         const char *other)
{
    const yaml_node_t *value = reader_find(reader, entry.value, key).value;
    if (!value || !reader_find(reader, entry.value, other).value)
        return PERCUSS_OK;
    reader_enter(reader, key);
    return reader_refuse(reader, value, "must not stand beside %s", other);
}

enum percuss_status law_entry_read(struct reader *reader, struct entry entry, struct own_law *law)
{
    static const char *const apart[][2] = {
        {"exponent", "points"},     {"hysteresis", "points"},      {"dissipation", "points"},
        {"unloading", "stiffness"}, {"dissipation", "hysteresis"},
    };
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; !status && i < sizeof apart / sizeof *apart; i++)
        status = refuse_beside(reader, entry, apart[i][0], apart[i][1]);
    if (!status)
        status = read_curve(reader, entry, "points", NULL, &law->points);
    if (!status)
        status = read_curve(reader, entry, "unloading", &law->points, &law->unloading);
    return status;
}
