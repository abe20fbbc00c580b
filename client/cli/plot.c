/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Pictures by gnuplot: its process, and the parts that all scripts have. */

#include "plot.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli.h"
#include "output_file.h"

/* Gnuplot, as a program. */

enum { NOT_FOUND = 127 };

/* The script is UTF-8 in any locale: in the C locale gnuplot warns of signs outside ASCII. The
 * array is to be freed; NULL: out of memory. */
static char **environment_utf8(void)
{
    static char utf8[] = "LC_ALL=C.UTF-8";
    size_t count = 0, kept = 0;
    while (environ[count])
        count++;
    char **variables = calloc(count + 2, sizeof *variables);
    for (size_t i = 0; variables && i < count; i++)
        if (strncmp(environ[i], "LC_ALL=", 7) != 0)
            variables[kept++] = environ[i];
    if (variables)
        variables[kept] = utf8;
    return variables;
}

/* In the child: gnuplot reads the script as its standard input and draws on its standard output,
 * which is never ours. */
static void become_gnuplot(FILE *script, int picture, char **variables)
{
    char *const arguments[] = {"gnuplot", "-", NULL};
    if (dup2(fileno(script), STDIN_FILENO) >= 0 && dup2(picture, STDOUT_FILENO) >= 0)
        execvpe("gnuplot", arguments, variables);
    _exit(NOT_FOUND);
}

/* Everything that comes out of a pipe; the caller frees it. NULL: out of memory. */
static char *read_all(int from, size_t *size)
{
    char *bytes = NULL, part[1 << 14];
    ssize_t count;
    FILE *memory = open_memstream(&bytes, size);
    if (!memory)
        return NULL;
    while ((count = read(from, part, sizeof part)) > 0 || (count < 0 && errno == EINTR))
        fwrite(part, 1, count > 0 ? (size_t)count : 0, memory);
    bool good = count == 0 && !ferror(memory);
    good = fclose(memory) == 0 && good;
    if (good)
        return bytes;
    free(bytes);
    return NULL;
}

/* Runs the script, from its first byte on; the picture that it writes to its standard output, to be
 * freed, or NULL with a complaint that names the file it would have been. */
static char *plot_draw(FILE *script, const char *file, size_t *size)
{
    int pipe_ends[2], status = 0;
    bool written = fflush(script) == 0 && !ferror(script);
    rewind(script);
    char **variables = environment_utf8();
    if (!written || !variables || pipe2(pipe_ends, O_CLOEXEC)) {
        free(variables);
        complain("--plot: %s: gnuplot could not be started: %s", file, strerror(errno));
        return NULL;
    }
    /* gnuplot in a process of its own; its picture comes through a pipe */
    pid_t child = fork();
    if (child == 0)
        become_gnuplot(script, pipe_ends[1], variables);
    free(variables);
    close(pipe_ends[1]);
    char *picture = child > 0 ? read_all(pipe_ends[0], size) : NULL;
    close(pipe_ends[0]);
    /* no picture, and why */
    bool ended = child > 0 && waitpid(child, &status, 0) == child;
    if (!ended)
        complain("--plot: %s: gnuplot could not be started: %s", file, strerror(errno));
    else if (WIFEXITED(status) && WEXITSTATUS(status) == NOT_FOUND)
        complain("--plot: %s: gnuplot is not installed (Debian: apt-get install gnuplot-nox); "
                 "the numbers are available as CSV all the same",
                 file);
    else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !picture || *size == 0)
        complain("--plot: gnuplot could not draw %s", file);
    else
        return picture;
    free(picture);
    return NULL;
}

/* Of the folder's script, and of its picture where no other is wanted. */
static const char *const SCRIPT = "plot.gp", *const PICTURE = "plot.png";

/* Pixels an inch: a PDF is as large as the pictures of pixels are on a screen. */
static const double RESOLUTION = 96.0;

static const struct argp_option options[] = {
    {"plot", OPTION_PLOT, "FILE", 0,
     "draw the answer with gnuplot: FILE.png, FILE.svg or FILE.pdf; percuss(1) says what", 40},
    {"plot-data", OPTION_PLOT_DATA, "DIR", 0,
     "write what is drawn as comma-separated values into the folder DIR, and plot.gp, the gnuplot "
     "script that draws it",
     40},
    {0},
};

static bool ends_in(const char *file, const char *ending)
{
    size_t length = strlen(file), tail = strlen(ending);
    return length > tail && !strcmp(file + length - tail, ending);
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct plot_output *output = state->input;
    switch (key) {
    case OPTION_PLOT:
        if (!ends_in(text, ".png") && !ends_in(text, ".svg") && !ends_in(text, ".pdf"))
            argp_error(state, "--plot: '%s': a name that ends in .png, .svg or .pdf is needed",
                       text);
        output_file_check("plot", text, state);
        output->file = text;
        return 0;
    case OPTION_PLOT_DATA:
        output_folder_check("plot-data", text, state);
        output->folder = text;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

const struct argp plot_argp = {.options = options, .parser = parse};

bool plot_wanted(const struct plot_output *output)
{
    return output->file || output->folder;
}

void plot_text(const struct plot *plot, const char *text)
{
    fputc('\'', plot->script);
    for (; *text; text++) {
        if (*text == '\'')
            fputc('\'', plot->script);
        if (*text == '\n')
            fputs("'.\"\\n\".'", plot->script);
        else
            fputc(*text, plot->script);
    }
    fputc('\'', plot->script);
}

const char *plot_file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static void release(struct plot *plot)
{
    if (plot->script)
        fclose(plot->script);
    if (plot->data)
        fclose(plot->data);
    free(plot->script_text);
    free(plot->data_text);
}

int plot_begin(struct plot *plot, const struct plot_output *output, unsigned width, unsigned height)
{
    *plot = (struct plot){.output = output, .width = width, .height = height};
    plot->script = open_memstream(&plot->script_text, &plot->script_size);
    plot->data = open_memstream(&plot->data_text, &plot->data_size);
    if (!plot->script || !plot->data) {
        release(plot);
        return complain_memory();
    }
    /* common to all pictures: grid, axes, colours, legends outside of the plots */
    fputs("set encoding utf8\nset datafile separator comma\nset datafile columnheaders\n"
          "set datafile missing 'nan'\nset grid lt 1 lw 0.5 lc rgb '#d0d0d0'\nset border 3\n"
          "set tics nomirror out\n"
          "set key outside top center horizontal Left reverse samplen 2.5\n"
          "set linetype 1 lc rgb '#1f5fa8' lw 2 pt 7\nset linetype 2 lc rgb '#c8501e' lw 2 pt 5\n"
          "set linetype 3 lc rgb '#3c8c46' lw 2 pt 9\nset linetype 4 lc rgb '#8a4ba0' lw 2 pt 13\n"
          "set linetype 5 lc rgb '#a88f1f' lw 2 pt 11\nset linetype 6 lc rgb '#505050' lw 2 pt 6\n",
          plot->script);
    return EXIT_ANSWERED;
}

void plot_table(struct plot *plot, const char *name, const char *columns)
{
    size_t k = plot->table_count++;
    fflush(plot->data);
    snprintf(plot->tables[k].name, PLOT_NAME, "%s", name);
    plot->tables[k].begin = plot->data_size;
    fprintf(plot->data, "%s\n", columns);
}

/* The text of a table; its size. */
static const char *table_text(const struct plot *plot, size_t k, size_t *size)
{
    size_t begin = plot->tables[k].begin;
    *size = (k + 1 < plot->table_count ? plot->tables[k + 1].begin : plot->data_size) - begin;
    return plot->data_text + begin;
}

/* PNG, SVG or PDF by the file's name. */
static void put_terminal(const struct plot *plot, const char *file, FILE *out)
{
    if (ends_in(file, ".png"))
        fprintf(out, "set terminal pngcairo noenhanced size %u,%u font 'sans,12'\n", plot->width,
                plot->height);
    else if (ends_in(file, ".svg"))
        fprintf(out,
                "set terminal svg noenhanced size %u,%u dynamic font 'sans,12' "
                "background 'white'\n",
                plot->width, plot->height);
    else
        fprintf(out,
                "set terminal pdfcairo noenhanced size %.4gin,%.4gin font 'sans,9' fontscale 1 "
                "linewidth 1.6\n",
                plot->width / RESOLUTION, plot->height / RESOLUTION);
}

/* Everything in one script, drawn on its standard output. */
static int draw(const struct plot *plot)
{
    const char *file = plot->output->file;
    FILE *script = tmpfile();
    if (!script) {
        complain("--plot: a temporary file: %s", strerror(errno));
        return EXIT_FAILURE;
    }
    put_terminal(plot, file, script);
    for (size_t k = 0; k < plot->table_count; k++) {
        const char *name = plot->tables[k].name;
        size_t size;
        const char *text = table_text(plot, k, &size);
        fprintf(script, "$%s << EOD\n%.*sEOD\n%s = '$%s'\n", name, (int)size, text, name, name);
    }
    fwrite(plot->script_text, 1, plot->script_size, script);
    size_t size = 0;
    char *picture = plot_draw(script, file, &size);
    int code = picture ? output_file_write("plot", file, picture, size) : EXIT_FAILURE;
    free(picture);
    fclose(script);
    return code;
}

static int write_into(const char *folder, const char *name, const char *text, size_t size)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return output_file_write("plot-data", path, text, size);
}

/* The script that reads the tables' files where it lies, and draws beside them. */
static int write_script(const struct plot *plot)
{
    char *text = NULL;
    size_t size = 0;
    FILE *script = open_memstream(&text, &size);
    if (!script)
        return complain_memory();
    const char *file = plot->output->file ? plot_file_name(plot->output->file) : PICTURE;
    const struct plot names = {.script = script};
    fprintf(script,
            "# The picture from the files beside this one: gnuplot %s, in this folder;\n"
            "# LC_ALL=C.UTF-8 gnuplot %s where the locale is C.\n",
            SCRIPT, SCRIPT);
    put_terminal(plot, file, script);
    fputs("set output ", script);
    plot_text(&names, file);
    fputc('\n', script);
    for (size_t k = 0; k < plot->table_count; k++)
        fprintf(script, "%s = \"'%s.csv'\"\n", plot->tables[k].name, plot->tables[k].name);
    fwrite(plot->script_text, 1, plot->script_size, script);
    bool good = fclose(script) == 0;
    int code = good ? write_into(plot->output->folder, SCRIPT, text, size) : complain_memory();
    free(text);
    return code;
}

static int write_data(const struct plot *plot)
{
    const char *folder = plot->output->folder;
    int code = output_folder_make("plot-data", folder);
    for (size_t k = 0; k < plot->table_count && code == EXIT_ANSWERED; k++) {
        char name[PLOT_NAME + 8];
        size_t size;
        const char *text = table_text(plot, k, &size);
        snprintf(name, sizeof name, "%s.csv", plot->tables[k].name);
        code = write_into(folder, name, text, size);
    }
    return code == EXIT_ANSWERED ? write_script(plot) : code;
}

int plot_end(struct plot *plot)
{
    /* the texts are complete only now */
    bool good = fflush(plot->script) == 0 && fflush(plot->data) == 0 && !ferror(plot->script) &&
                !ferror(plot->data);
    int code = good ? EXIT_ANSWERED : complain_memory();
    if (good && plot->output->folder)
        code = write_data(plot);
    if (good && plot->output->file) {
        int drawn = draw(plot);
        code = code == EXIT_ANSWERED ? drawn : code;
    }
    release(plot);
    return code;
}

/* Ranges of axes. */

void plot_range_take(struct plot_range *range, double value)
{
    if (!isfinite(value))
        return;
    bool first = range->low > range->high;
    range->low = first ? value : fmin(range->low, value);
    range->high = first ? value : fmax(range->high, value);
}

void plot_range_take_all(struct plot_range *range, const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        plot_range_take(range, values[i]);
}

void plot_range_set(const struct plot *plot, const char *axis, const struct plot_range *range,
                    double margin)
{
    double low = range->low, high = range->high;
    /* of nothing, the unit; about one value, a tenth of it */
    if (low > high) {
        low = 0.0;
        high = 1.0;
    }
    double width = high > low ? high - low : fmax(0.1 * fabs(high), 1e-9);
    fprintf(plot->script, "set %s [%.9g:%.9g]\n", axis, low - margin * width,
            high + margin * width);
}

void plot_range_set_log(const struct plot *plot, const char *axis, const struct plot_range *range,
                        double margin)
{
    bool none = range->low > range->high;
    double low = none ? 1.0 : range->low, high = none ? 1.0 : range->high;
    double wider = high > low ? pow(high / low, margin) : 1.1;
    fprintf(plot->script, "set logscale %s\nset %srange [%.9g:%.9g]\n", axis, axis, low / wider,
            high * wider);
}
