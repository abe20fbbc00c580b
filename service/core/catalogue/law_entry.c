/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/law_entry.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "catalogue/shipped.h"

/* Rows of a curve. */
enum { LEAST_ROWS = 3, MOST_ROWS = 10000, MOST_BYTES = 1 << 20 };

/* The two curves meet: as equal as five printed digits are. */
static const double SAME_POINT = 1e-5;
/* Places of an unloading curve that are looked at. */
enum { SHARES = 64 };
/* By which unloading may exceed loading, of the largest force: digits that were printed, and the
 * ripple of splines where both are the same curve. */
static const double MADE = 1e-4;

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

/* A decimal number, to which *text moves on. */
static bool read_number(const char **text, double *value)
{
    const char *end = units_number_end(*text);
    if (end == *text)
        return false;
    *value = strtod(*text, NULL);
    *text = end;
    return isfinite(*value);
}

/* Two numbers and nothing else, with a comma, a semicolon or blanks between them. */
static bool read_row(const char *text, double *indentation, double *force)
{
    text += strspn(text, " \t");
    if (!read_number(&text, indentation))
        return false;
    size_t between = strspn(text, " \t");
    between += text[between] == ',' || text[between] == ';';
    between += strspn(text + between, " \t");
    text += between;
    return between > 0 && read_number(&text, force) && text[strspn(text, " \t\r\n")] == '\0';
}

/* Names of columns: what begins like no number. Other units than m and N, or the force first, are
 * refused. */
static bool are_names(const char *text)
{
    return !strchr("+-.0123456789", text[strspn(text, " \t\"")]);
}

/* Whether a word stands there alone: "um" does not in "column". */
static bool has_word(const char *text, const char *word)
{
    size_t length = strlen(word);
    for (const char *at = text; (at = strstr(at, word)); at++)
        if ((at == text || !isalpha((unsigned char)at[-1])) && !isalpha((unsigned char)at[length]))
            return true;
    return false;
}

static bool are_other_columns(const char *text)
{
    static const char *const other[] = {"mm", "um", "\xc2\xb5m", "\xce\xbcm",
                                        "nm", "cm", "kN",        "mN"};
    size_t first = strcspn(text, ",;\t\r\n");
    for (size_t i = 0; i < sizeof other / sizeof *other; i++)
        if (has_word(text, other[i]))
            return true;
    return memmem(text, first, "orce", 4) || memmem(text, first, "ORCE", 4);
}

static enum percuss_status refuse_line(const struct rows *rows, size_t line, const char *must)
{
    return fault_set(rows->fault, PERCUSS_BAD_REQUEST, "%.300s:%zu: %s", rows->path, line, must);
}

/* One line; *begun: it is not the first with anything in it. */
static enum percuss_status read_line(struct rows *rows, const char *text, size_t line, bool *begun)
{
    struct own_curve *curve = &rows->curve;
    double indentation, force;
    if (text[strspn(text, " \t\r\n")] == '\0' || text[strspn(text, " \t")] == '#')
        return PERCUSS_OK;
    bool first = !*begun;
    *begun = true;
    if (first && are_names(text))
        return are_other_columns(text)
                   ? refuse_line(rows, line, "must name an indentation in m, then a force in N")
                   : PERCUSS_OK;
    if (!read_row(text, &indentation, &force))
        return refuse_line(rows, line,
                           "must be two numbers with decimal points, an indentation in m and a "
                           "force in N, with a comma, a semicolon or a blank between them");
    if (curve->count == MOST_ROWS) {
        char must[64];
        snprintf(must, sizeof must, "must have at most %d points", MOST_ROWS);
        return refuse_line(rows, line, must);
    }
    curve->indentation[curve->count] = indentation;
    curve->force[curve->count] = force;
    rows->line[curve->count++] = line;
    return PERCUSS_OK;
}

/* Rows as they stand. */
static enum percuss_status read_rows(FILE *file, struct rows *rows)
{
    static const char BOM[] = "\xef\xbb\xbf";
    char *text = NULL;
    size_t room = 0;
    bool begun = false;
    enum percuss_status status = PERCUSS_OK;
    for (size_t line = 1; !status; line++) {
        ssize_t length = getline(&text, &room, file);
        if (length < 0)
            break;
        if (strlen(text) < (size_t)length)
            status = refuse_line(rows, line, "must be text: it has a byte 0");
        else
            status =
                read_line(rows, text + (line == 1 && !strncmp(text, BOM, 3) ? 3 : 0), line, &begun);
    }
    free(text);
    if (!status && ferror(file))
        status =
            fault_set(rows->fault, PERCUSS_BAD_REQUEST, "%.300s: %s", rows->path, strerror(errno));
    return status;
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
    /* a pipe must not be waited for */
    int descriptor = open(rows->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    const char *why = descriptor < 0 || fstat(descriptor, &about) != 0 ? strerror(errno)
                      : !S_ISREG(about.st_mode)                        ? "not a regular file"
                      : about.st_size > MOST_BYTES                     ? "more than 1 MB"
                                                                       : NULL;
    FILE *file = why ? NULL : fdopen(descriptor, "r");
    if (!file) {
        if (!why)
            why = strerror(errno);
        if (descriptor >= 0)
            close(descriptor);
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

/* From no largest indentation does unloading, in proportion to that of the file, bear more force
 * than loading does there: no energy is made. */
static enum percuss_status check_energy(const struct rows *rows, const struct spline *loading,
                                        const struct spline *back)
{
    size_t n = loading->count - 1;
    double last = loading->place[n], from = back->place[0] / last;
    double most = own_curve_force(back, back->place[back->count - 1]);
    for (size_t i = 2; i <= 2 * n; i++) {
        /* at the points, and between them */
        double depth = 0.5 * (loading->place[i / 2] + loading->place[(i + 1) / 2]);
        double force = own_curve_force(loading, depth);
        for (int k = 1; k < SHARES; k++) {
            double part = from + (1.0 - from) * k / SHARES;
            double bears = force * own_curve_force(back, part * last) / most;
            double held = own_curve_force(loading, part * depth);
            if (bears > held + MADE * force)
                return fault_set(rows->fault, PERCUSS_BAD_REQUEST,
                                 "%.300s: must never bear more than loading: from %g m it would, "
                                 "in proportion, %g N at %g m for %g N, and make energy",
                                 rows->path, depth, bears, part * depth, held);
        }
    }
    return PERCUSS_OK;
}

/* Unloading begins where loading ended. */
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
    struct spline loading, unloading;
    double *blocks[2] = {NULL, NULL};
    enum percuss_status status =
        own_curve_spline(points, &blocks[0], &loading) &&
                own_curve_spline(back, &blocks[1], &unloading)
            ? check_energy(rows, &loading, &unloading)
            : fault_set(rows->fault, PERCUSS_INTERNAL, "%.300s: out of memory", rows->path);
    free(blocks[0]);
    free(blocks[1]);
    return status;
}

/* Reads the file that a key names, if it stands there. */
static enum percuss_status read_curve(struct reader *reader, struct entry entry, const char *key,
                                      const struct own_curve *loading, struct own_curve *curve)
{
    const yaml_node_t *name = reader_find(reader, entry.value, key).value;
    if (!name)
        return PERCUSS_OK;
    const char *stated = (const char *)name->data.scalar.value;
    size_t mark = reader_enter(reader, key);
    struct fault fault = {0};
    if (strlen(stated) >= sizeof curve->file)
        return reader_refuse(reader, name, "a path of %zu bytes: at most %zu are allowed",
                             strlen(stated), sizeof curve->file - 1);
    char *path = shipped_resolve(reader->name, stated);
    if (!path)
        return fault_set(reader->fault, PERCUSS_INTERNAL, "out of memory");
    struct rows rows = {.path = path, .fault = &fault};
    enum percuss_status status = read_file(&rows);
    if (!status && loading)
        status = check_unloading(&rows, loading);
    if (!status && !loading && rows.curve.indentation[0] != 0.0)
        status = refuse_row(&rows, 0, "must be at 0 m: the touch");
    *curve = rows.curve;
    strcpy(curve->file, stated);
    free(rows.line);
    free(path);
    if (status == PERCUSS_INTERNAL)
        return fault_set(reader->fault, status, "%s", fault.text);
    if (status)
        return reader_refuse(reader, name, "%s", fault.text);
    reader_leave(reader, mark);
    return PERCUSS_OK;
}

enum percuss_status law_entry_read(struct reader *reader, struct entry entry, struct own_law *law)
{
    enum percuss_status status = read_curve(reader, entry, "points", NULL, &law->points);
    if (!status)
        status = read_curve(reader, entry, "unloading", &law->points, &law->unloading);
    return status;
}
