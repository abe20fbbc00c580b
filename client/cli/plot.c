/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plot.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli.h"
#include "output_file.h"

enum { NOT_FOUND = 127 };

static bool ends_in(const char *file, const char *ending)
{
    size_t length = strlen(file), tail = strlen(ending);
    return length > tail && !strcmp(file + length - tail, ending);
}

void plot_check(const char *file, struct argp_state *state)
{
    if (!ends_in(file, ".png") && !ends_in(file, ".svg"))
        argp_error(state, "--plot: '%s': a name that ends in .png or .svg is needed", file);
    output_file_check("plot", file, state);
}

void plot_text(const struct plot *plot, const char *text)
{
    fputc('\'', plot->script);
    for (; *text; text++) {
        if (*text == '\'')
            fputc('\'', plot->script);
        if (*text != '\n')
            fputc(*text, plot->script);
    }
    fputc('\'', plot->script);
}

int plot_begin(struct plot *plot, const char *file, unsigned width, unsigned height)
{
    *plot = (struct plot){tmpfile(), file};
    if (!plot->script) {
        complain("--plot: a temporary file: %s", strerror(errno));
        return EXIT_FAILURE;
    }
    /* PNG or SVG by the file's name */
    if (ends_in(file, ".png"))
        fprintf(plot->script, "set terminal pngcairo noenhanced size %u,%u font 'sans,12'\n", width,
                height);
    else
        fprintf(plot->script,
                "set terminal svg noenhanced size %u,%u dynamic font 'sans,12' "
                "background 'white'\n",
                width, height);
    /* what all pictures have in common: grid, axes, colours */
    fputs("set encoding utf8\nset datafile missing 'nan'\nset grid lt 1 lw 0.5 lc rgb "
          "'#d0d0d0'\nset border 3\n"
          "set tics nomirror out\nset key top right\n"
          "set linetype 1 lc rgb '#1f5fa8' lw 2 pt 7\nset linetype 2 lc rgb '#c8501e' lw 2 pt 5\n"
          "set linetype 3 lc rgb '#3c8c46' lw 2 pt 9\nset linetype 4 lc rgb '#8a4ba0' lw 2 pt 13\n"
          "set linetype 5 lc rgb '#a88f1f' lw 2 pt 11\nset linetype 6 lc rgb '#505050' lw 2 pt 6\n",
          plot->script);
    return EXIT_ANSWERED;
}

/* In the child: gnuplot reads the script as its standard input and draws on its standard output,
 * which is never ours. */
static void become_gnuplot(FILE *script, int picture)
{
    if (dup2(fileno(script), STDIN_FILENO) >= 0 && dup2(picture, STDOUT_FILENO) >= 0)
        execlp("gnuplot", "gnuplot", "-", (char *)NULL);
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

/* Runs the script; the picture, which the caller frees, or NULL with a complaint. */
static char *draw(struct plot *plot, size_t *size)
{
    int pipe_ends[2], status = 0;
    bool written = fflush(plot->script) == 0 && !ferror(plot->script);
    rewind(plot->script);
    if (!written || pipe2(pipe_ends, O_CLOEXEC)) {
        complain("--plot: %s: gnuplot could not be started: %s", plot->file, strerror(errno));
        return NULL;
    }
    /* gnuplot in a process of its own, whose picture comes through a pipe */
    pid_t child = fork();
    if (child == 0)
        become_gnuplot(plot->script, pipe_ends[1]);
    close(pipe_ends[1]);
    char *picture = child > 0 ? read_all(pipe_ends[0], size) : NULL;
    close(pipe_ends[0]);
    /* no picture, and why */
    bool ended = child > 0 && waitpid(child, &status, 0) == child;
    if (!ended)
        complain("--plot: %s: gnuplot could not be started: %s", plot->file, strerror(errno));
    else if (WIFEXITED(status) && WEXITSTATUS(status) == NOT_FOUND)
        complain("--plot: %s: gnuplot is not installed (Debian: apt-get install gnuplot-nox); "
                 "the numbers are available as CSV all the same",
                 plot->file);
    else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !picture || *size == 0)
        complain("--plot: gnuplot could not draw %s", plot->file);
    else
        return picture;
    free(picture);
    return NULL;
}

int plot_end(struct plot *plot)
{
    size_t size = 0;
    char *picture = draw(plot, &size);
    int code = picture ? output_file_write("plot", plot->file, picture, size) : EXIT_FAILURE;
    free(picture);
    fclose(plot->script);
    return code;
}
