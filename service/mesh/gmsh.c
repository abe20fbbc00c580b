/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/gmsh.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_ARGUMENTS = 40, ARGUMENT_SIZE = 32, LOG_SHOWN = 400 };
/* what the shell of old says where there is no such program: some posix_spawn do so too */
static const int NOT_FOUND = 127;

/* triangles that meet at less than 40 degrees are one surface (Gmsh's tutorial 13) */
static const char FILL_SCRIPT[] = "Merge \"%s\";\n"
                                  "ClassifySurfaces{40*Pi/180, 1, 1, Pi};\n"
                                  "CreateGeometry;\n"
                                  "Surface Loop(1) = Surface{:};\n"
                                  "Volume(1) = {1};\n";

struct arguments {
    int count;
    const char *list[MOST_ARGUMENTS];
};

static void add(struct arguments *arguments, const char *argument)
{
    if (arguments->count < MOST_ARGUMENTS - 1)
        arguments->list[arguments->count++] = argument;
}

static void set_number(struct arguments *arguments, const char *option, const char *value)
{
    add(arguments, "-setnumber");
    add(arguments, option);
    add(arguments, value);
}

/* in which unit Gmsh's geometry kernel is to give lengths; NULL: it knows no such unit */
static const char *kernel_unit(double unit)
{
    static const struct {
        double unit;
        const char *name;
    } UNITS[] = {{1.0, "M"},   {0.01, "CM"},     {0.001, "MM"},
                 {1e-6, "UM"}, {0.0254, "INCH"}, {0.3048, "FT"}};
    for (size_t i = 0; i < sizeof UNITS / sizeof *UNITS; i++)
        if (fabs(unit - UNITS[i].unit) < 1e-9 * unit)
            return UNITS[i].name;
    return NULL;
}

static enum percuss_status make_folder(struct gmsh_file *file, struct fault *fault)
{
    const char *base = getenv("TMPDIR");
    int length = snprintf(file->folder, sizeof file->folder, "%s/percuss-mesh-XXXXXX",
                          base && *base ? base : "/tmp");
    if (length >= (int)sizeof file->folder || !mkdtemp(file->folder)) {
        file->folder[0] = '\0';
        return fault_set(fault, PERCUSS_BAD_REQUEST, "TMPDIR: %.200s: %s", base ? base : "/tmp",
                         strerror(errno));
    }
    snprintf(file->mesh, sizeof file->mesh, "%s/mesh.msh", file->folder);
    snprintf(file->log, sizeof file->log, "%s/log", file->folder);
    snprintf(file->script, sizeof file->script, "%s/fill.geo", file->folder);
    return PERCUSS_OK;
}

/* the script that fills a surface; names of files stand in quotes there */
static enum percuss_status write_script(const char *path, const struct gmsh_file *file,
                                        struct fault *fault)
{
    char *whole = realpath(path, NULL);
    enum percuss_status status = PERCUSS_OK;
    if (!whole || strpbrk(whole, "\"\\\n"))
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %s", path,
                           whole ? "its name must be without quotes" : strerror(errno));
    FILE *stream = status == PERCUSS_OK ? fopen(file->script, "w") : NULL;
    if (stream) {
        fprintf(stream, FILL_SCRIPT, whole);
        if (fclose(stream) != 0)
            stream = NULL;
    }
    if (status == PERCUSS_OK && !stream)
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %s", file->script, strerror(errno));
    free(whole);
    return status;
}

/* copies the last lines of what gmsh said, in one line */
static void last_words(const struct gmsh_file *file, char words[LOG_SHOWN])
{
    FILE *stream = fopen(file->log, "r");
    words[0] = '\0';
    if (!stream)
        return;
    char line[LOG_SHOWN];
    size_t filled = 0;
    while (fgets(line, sizeof line, stream)) {
        line[strcspn(line, "\n")] = '\0';
        if (strncmp(line, "Error", 5) != 0 && strncmp(line, "Warning", 7) != 0)
            continue;
        /* under a rule it counts what it has said */
        if (strstr(line, ": -----"))
            break;
        size_t length = strlen(line);
        if (filled + length + 2 >= LOG_SHOWN)
            filled = 0;
        filled +=
            (size_t)snprintf(words + filled, LOG_SHOWN - filled, "%s%s", filled ? "; " : "", line);
        if (filled >= LOG_SHOWN)
            filled = LOG_SHOWN - 1;
    }
    fclose(stream);
}

/* starts the program, its output into the log, and waits; -1: there is no such program */
static int run(const struct arguments *arguments, const struct gmsh_file *file)
{
    posix_spawn_file_actions_t actions;
    pid_t child;
    int result = 0, error = posix_spawn_file_actions_init(&actions);
    if (error)
        return -1;
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, file->log,
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    error = posix_spawnp(&child, "gmsh", &actions, NULL, (char *const *)arguments->list, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error)
        return -1;
    while (waitpid(child, &result, 0) < 0)
        if (errno != EINTR)
            return -1;
    if (WIFEXITED(result))
        return WEXITSTATUS(result) == NOT_FOUND ? -1 : WEXITSTATUS(result);
    return 1;
}

static void fill_arguments(const char *path, enum gmsh_task task, double unit, const char *size,
                           const struct gmsh_file *file, struct arguments *arguments)
{
    add(arguments, "gmsh");
    add(arguments, path);
    add(arguments, task == GMSH_CONVERT ? "-save" : "-3");
    if (task != GMSH_CONVERT) {
        add(arguments, "-order");
        add(arguments, "2");
    }
    /* triangles know no curvature: straight edges then. Else ten elements about a full turn (edges
     * of .6 of a radius), and curved ones are kept from turning inside out */
    if (task == GMSH_FILL)
        set_number(arguments, "Mesh.SecondOrderLinear", "1");
    if (task == GMSH_MESH) {
        set_number(arguments, "Mesh.MeshSizeFromCurvature", "10");
        set_number(arguments, "Mesh.HighOrderOptimize", "2");
        if (kernel_unit(unit)) {
            add(arguments, "-setstring");
            add(arguments, "Geometry.OCCTargetUnit");
            add(arguments, kernel_unit(unit));
        }
    }
    if (task != GMSH_CONVERT && *size) {
        add(arguments, "-clmax");
        add(arguments, size);
    }
    /* the same mesh every time */
    set_number(arguments, "General.NumThreads", "1");
    add(arguments, "-nopopup");
    add(arguments, "-bin");
    add(arguments, "-format");
    add(arguments, "msh41");
    add(arguments, "-o");
    add(arguments, file->mesh);
}

enum percuss_status gmsh_run(const char *path, enum gmsh_task task, double unit, double size,
                             struct gmsh_file *file, struct fault *fault)
{
    struct arguments arguments = {0};
    char words[LOG_SHOWN], limit[ARGUMENT_SIZE] = "", safe[GMSH_PATH_SIZE * 4];
    memset(file, 0, sizeof *file);
    if (access(path, R_OK) != 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %s", path, strerror(errno));
    enum percuss_status status = make_folder(file, fault);
    if (status == PERCUSS_OK && task == GMSH_FILL)
        status = write_script(path, file, fault);
    if (status != PERCUSS_OK)
        return status;

    /* a name that begins with a dash is no option */
    snprintf(safe, sizeof safe, "%s%s", path[0] == '-' ? "./" : "", path);
    if (size > 0.0)
        snprintf(limit, sizeof limit, "%.9g", size);
    fill_arguments(task == GMSH_FILL ? file->script : safe, task, unit, limit, file, &arguments);
    int result = run(&arguments, file);
    if (result < 0)
        return fault_set(
            fault, PERCUSS_BAD_REQUEST,
            "%s: is a file for Gmsh, and there is no program gmsh: install it (Debian: "
            "gmsh), or give a .msh (4.1) or .inp file",
            path);
    if (result == 0 && access(file->mesh, R_OK) == 0)
        return PERCUSS_OK;
    last_words(file, words);
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: gmsh could not make a mesh of it: %s", path,
                     words[0] ? words : "it says nothing");
}

void gmsh_forget(const struct gmsh_file *file)
{
    if (!file->folder[0])
        return;
    unlink(file->mesh);
    unlink(file->log);
    unlink(file->script);
    rmdir(file->folder);
}
