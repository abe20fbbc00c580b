/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/mesh_read.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mesh/bdf.h"
#include "mesh/card.h"
#include "mesh/inp.h"
#include "mesh/mesh_format.h"
#include "mesh/msh.h"
#include "mesh/unv.h"
#include "mesh/vtk_legacy.h"

/* Units of length, by percuss's names and by those of Gmsh's geometry kernel. */
static const struct {
    const char *name, *kernel;
    double metres;
} UNITS[] = {{"m", "M", 1.0},    {"cm", "CM", 0.01},     {"mm", "MM", 0.001},
             {"um", "UM", 1e-6}, {"in", "INCH", 0.0254}, {"ft", "FT", 0.3048}};

/* ---- Gmsh as a process: it meshes a geometry or converts formats that we do not read ---- */

enum { GMSH_PATH_SIZE = 256 };

/* A mesh in a temporary folder; gmsh_forget deletes both. */
struct gmsh_file {
    char folder[GMSH_PATH_SIZE], mesh[GMSH_PATH_SIZE + 16], log[GMSH_PATH_SIZE + 16],
        script[GMSH_PATH_SIZE + 16];
};

enum gmsh_task {
    GMSH_CONVERT, /* the file holds a mesh */
    GMSH_MESH,    /* it holds a geometry: mesh it with tetrahedra of second order */
    GMSH_FILL     /* it holds triangles of a surface: the same inside */
};

enum { MOST_ARGUMENTS = 40, ARGUMENT_SIZE = 32, LOG_SHOWN = 400 };
/* the exit code of shells, and of some posix_spawn, where there is no such program */
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

static void add_argument(struct arguments *arguments, const char *argument)
{
    if (arguments->count < MOST_ARGUMENTS - 1)
        arguments->list[arguments->count++] = argument;
}

static void add_number(struct arguments *arguments, const char *option, const char *value)
{
    add_argument(arguments, "-setnumber");
    add_argument(arguments, option);
    add_argument(arguments, value);
}

/* The unit in which Gmsh's geometry kernel is to give lengths; NULL: it knows no such unit. */
static const char *kernel_unit(double unit)
{
    for (size_t i = 0; i < sizeof UNITS / sizeof *UNITS; i++)
        if (fabs(unit - UNITS[i].metres) < 1e-9 * unit)
            return UNITS[i].kernel;
    return NULL;
}

static enum percuss_status make_gmsh_folder(struct gmsh_file *file, struct fault *fault)
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

/* writes the script that fills a surface; it quotes the file's name */
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

/* joins the last errors and warnings of gmsh's log in one line */
static void last_messages(const struct gmsh_file *file, char messages[LOG_SHOWN])
{
    FILE *stream = fopen(file->log, "r");
    messages[0] = '\0';
    if (!stream)
        return;
    char line[LOG_SHOWN];
    size_t filled = 0;
    while (fgets(line, sizeof line, stream)) {
        line[strcspn(line, "\n")] = '\0';
        if (strncmp(line, "Error", 5) != 0 && strncmp(line, "Warning", 7) != 0)
            continue;
        /* under a rule it counts its messages */
        if (strstr(line, ": -----"))
            break;
        size_t length = strlen(line);
        if (filled + length + 2 >= LOG_SHOWN)
            filled = 0;
        filled += (size_t)snprintf(messages + filled, LOG_SHOWN - filled, "%s%s",
                                   filled ? "; " : "", line);
        if (filled >= LOG_SHOWN)
            filled = LOG_SHOWN - 1;
    }
    fclose(stream);
}

/* starts the program with its output in the log, and waits; -1: there is no such program */
static int run_gmsh(const struct arguments *arguments, const struct gmsh_file *file)
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
    add_argument(arguments, "gmsh");
    add_argument(arguments, path);
    add_argument(arguments, task == GMSH_CONVERT ? "-save" : "-3");
    if (task != GMSH_CONVERT) {
        add_argument(arguments, "-order");
        add_argument(arguments, "2");
    }
    /* triangles have no curvature: straight edges. A geometry: ten elements about a full turn
     * (edges of .6 of a radius), and optimised curved elements, so that none is inverted */
    if (task == GMSH_FILL)
        add_number(arguments, "Mesh.SecondOrderLinear", "1");
    if (task == GMSH_MESH) {
        add_number(arguments, "Mesh.MeshSizeFromCurvature", "10");
        add_number(arguments, "Mesh.HighOrderOptimize", "2");
        if (kernel_unit(unit)) {
            add_argument(arguments, "-setstring");
            add_argument(arguments, "Geometry.OCCTargetUnit");
            add_argument(arguments, kernel_unit(unit));
        }
    }
    if (task != GMSH_CONVERT && *size) {
        add_argument(arguments, "-clmax");
        add_argument(arguments, size);
    }
    /* groups name parts and sets; they do not choose what is saved */
    add_number(arguments, "Mesh.SaveAll", "1");
    /* the same mesh every time */
    add_number(arguments, "General.NumThreads", "1");
    add_argument(arguments, "-nopopup");
    add_argument(arguments, "-bin");
    add_argument(arguments, "-format");
    add_argument(arguments, "msh41");
    add_argument(arguments, "-o");
    add_argument(arguments, file->mesh);
}

/* Runs gmsh on `path`. Converts geometries with a unit to `unit` (m); elements are at most `size`
 * of these units (0: Gmsh's default). PERCUSS_BAD_REQUEST: there is no gmsh, or it fails, with its
 * last messages. */
static enum percuss_status gmsh_run(const char *path, enum gmsh_task task, double unit, double size,
                                    struct gmsh_file *file, struct fault *fault)
{
    struct arguments arguments = {0};
    char messages[LOG_SHOWN], limit[ARGUMENT_SIZE] = "", safe[GMSH_PATH_SIZE * 4];
    memset(file, 0, sizeof *file);
    if (access(path, R_OK) != 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %s", path, strerror(errno));
    enum percuss_status status = make_gmsh_folder(file, fault);
    if (status == PERCUSS_OK && task == GMSH_FILL)
        status = write_script(path, file, fault);
    if (status != PERCUSS_OK)
        return status;

    /* gmsh would take a name that begins with a dash for an option */
    snprintf(safe, sizeof safe, "%s%s", path[0] == '-' ? "./" : "", path);
    if (size > 0.0)
        snprintf(limit, sizeof limit, "%.9g", size);
    fill_arguments(task == GMSH_FILL ? file->script : safe, task, unit, limit, file, &arguments);
    int result = run_gmsh(&arguments, file);
    if (result < 0)
        return fault_set(
            fault, PERCUSS_BAD_REQUEST,
            "%s: is a file for Gmsh, and there is no program gmsh: install it (Debian: "
            "gmsh), or give a .msh (4.1) or .inp file",
            path);
    if (result == 0 && access(file->mesh, R_OK) == 0)
        return PERCUSS_OK;
    last_messages(file, messages);
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: gmsh could not make a mesh of it: %s", path,
                     messages[0] ? messages : "it says nothing");
}

static void gmsh_forget(const struct gmsh_file *file)
{
    if (!file->folder[0])
        return;
    unlink(file->mesh);
    unlink(file->log);
    unlink(file->script);
    rmdir(file->folder);
}

/* ---- reading ---- */

double mesh_read_unit(const char *name)
{
    for (size_t i = 0; i < sizeof UNITS / sizeof *UNITS; i++)
        if (strcmp(name, UNITS[i].name) == 0)
            return UNITS[i].metres;
    return 0.0;
}

static enum percuss_status read_through_gmsh(const char *path, enum gmsh_task task,
                                             const struct mesh_options *options,
                                             struct solid_mesh *mesh, struct fault *fault)
{
    struct gmsh_file file;
    enum percuss_status status =
        gmsh_run(path, task, options->unit, options->size / options->unit, &file, fault);
    if (status == PERCUSS_OK)
        status = msh_read(&(struct msh_source){file.mesh, path, true}, options->unit,
                          options->raise, mesh, fault);
    gmsh_forget(&file);
    return status;
}

static enum percuss_status read_format(const char *path, enum mesh_format format,
                                       const struct mesh_options *options, struct solid_mesh *mesh,
                                       struct fault *fault)
{
    switch (format) {
    case MESH_FORMAT_INP:
        return inp_read(path, options->unit, options->instance, options->raise, mesh, fault);
    case MESH_FORMAT_BDF:
        return bdf_read(path, options->unit, options->raise, mesh, fault);
    case MESH_FORMAT_VTK:
        return vtk_legacy_read(path, options->unit, options->raise, mesh, fault);
    case MESH_FORMAT_UNV:
        return unv_read(path, options->unit, options->raise, mesh, fault);
    case MESH_FORMAT_MSH:
        if (msh_is_readable(path))
            return msh_read(&(struct msh_source){path, path, false}, options->unit, options->raise,
                            mesh, fault);
        return read_through_gmsh(path, GMSH_CONVERT, options, mesh, fault);
    case MESH_FORMAT_MESHED:
        return read_through_gmsh(path, GMSH_CONVERT, options, mesh, fault);
    case MESH_FORMAT_SHAPE:
        return read_through_gmsh(path, GMSH_MESH, options, mesh, fault);
    case MESH_FORMAT_SURFACE:
        return read_through_gmsh(path, GMSH_FILL, options, mesh, fault);
    case MESH_FORMAT_NONE:
        break;
    }
    return mesh_format_refuse(path, fault);
}

enum percuss_status mesh_read(const char *path, const struct mesh_options *options,
                              struct solid_mesh *mesh, struct fault *fault)
{
    memset(mesh, 0, sizeof *mesh);
    if (!(options->unit > 0.0 && isfinite(options->unit)))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "unit: %g: must be > 0 m", options->unit);
    if (!(options->size >= 0.0 && isfinite(options->size)))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "size: %g: must be >= 0 m", options->size);
    return read_format(path, mesh_format_of(path), options, mesh, fault);
}

/* ---- digest of a mesh's files ---- */

struct digest_walk {
    struct sha256 *hash;
    enum mesh_format format; /* follow the files that its decks include */
    const char *path;        /* of the first file */
    int depth;
    bool done; /* after *STEP: the reader stops there */
};

static enum percuss_status digest_add_file(struct digest_walk *digest, const char *path,
                                           struct fault *fault);

/* Follows the files of INPUT=, of *INCLUDE and others, and stops at *STEP. */
static enum percuss_status digest_follow(struct digest_walk *digest, struct scan *scan, char *line)
{
    struct card card;
    char path[INP_PATH_SIZE];
    if (!card_parse(line, &card))
        return PERCUSS_OK; /* the reader refuses it */
    if (strcmp(card.name, "STEP") == 0)
        digest->done = true;
    const char *name = card_value(&card, "INPUT");
    if (!name || !*name)
        return PERCUSS_OK;
    /* the reader refuses deeper files */
    if (digest->depth == INP_MOST_DEPTH) {
        digest->done = true;
        return PERCUSS_OK;
    }
    /* the reader asks for files of some keywords only: those that are not there are its matter */
    inp_include_path(digest->path, scan->file, name, path);
    if (access(path, R_OK) != 0 && strcmp(card.name, "INCLUDE") != 0)
        return PERCUSS_OK;
    digest->depth++;
    enum percuss_status status = digest_add_file(digest, path, scan->fault);
    digest->depth--;
    return status;
}

/* follows INCLUDE of bulk data */
static enum percuss_status digest_follow_bdf(struct digest_walk *digest, const char *path,
                                             struct fault *fault)
{
    struct bdf_lines lines;
    struct bdf_card card = {0};
    char included[BDF_PATH_SIZE];
    enum percuss_status status =
                            bdf_open(&lines, path, digest->depth ? BDF_BULK : BDF_WHOLE, fault),
                        refused;
    if (status)
        return status;
    while (!status && bdf_next(&lines, &card, &refused)) {
        /* the reader refuses deeper files, and what cannot be understood */
        if (strcmp(card.name, "INCLUDE") != 0 || digest->depth == BDF_MOST_DEPTH)
            continue;
        if (bdf_include(&lines, included))
            break;
        digest->depth++;
        status = digest_add_file(digest, included, fault);
        digest->depth--;
    }
    bdf_card_free(&card);
    scan_close(&lines.scan);
    return status;
}

static enum percuss_status digest_add_file(struct digest_walk *digest, const char *path,
                                           struct fault *fault)
{
    struct scan scan;
    char line[CARD_LINE_SIZE];
    enum percuss_status status = scan_open(path, &scan, fault), refused;
    if (status)
        return status;
    /* the size shows where an included file ends */
    uint64_t size = scan.size;
    if (digest->depth > 0)
        sha256_add(digest->hash, &size, sizeof size);
    sha256_add(digest->hash, scan.text, scan.size);
    while (!status && digest->format == MESH_FORMAT_INP && !digest->done &&
           card_line(&scan, line, &refused))
        if (line[0] == '*')
            status = digest_follow(digest, &scan, line);
    scan_close(&scan);
    return digest->format == MESH_FORMAT_BDF ? digest_follow_bdf(digest, path, fault) : status;
}

enum percuss_status mesh_digest(const char *path, struct sha256 *hash, struct fault *fault)
{
    struct digest_walk digest = {.hash = hash, .format = mesh_format_of(path), .path = path};
    return digest_add_file(&digest, path, fault);
}
