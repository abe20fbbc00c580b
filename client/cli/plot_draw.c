/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plot_draw.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli.h"

enum { NOT_FOUND = 127 };

/* The script is UTF-8 whatever the locale is: in that of C gnuplot warns of signs that it has not.
 * The array is to be freed; NULL: out of memory. */
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

char *plot_draw(FILE *script, const char *file, size_t *size)
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
    /* gnuplot in a process of its own, whose picture comes through a pipe */
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
