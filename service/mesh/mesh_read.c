/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/mesh_read.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "mesh/gmsh.h"
#include "mesh/inp.h"
#include "mesh/msh.h"

/* formats that Gmsh reads, and what it is to do with them */
static const struct {
    const char *suffix;
    enum gmsh_task task;
} FORMATS[] = {{".step", GMSH_MESH},   {".stp", GMSH_MESH},    {".iges", GMSH_MESH},
               {".igs", GMSH_MESH},    {".brep", GMSH_MESH},   {".geo", GMSH_MESH},
               {".stl", GMSH_FILL},    {".bdf", GMSH_CONVERT}, {".nas", GMSH_CONVERT},
               {".unv", GMSH_CONVERT}, {".vtk", GMSH_CONVERT}, {".mesh", GMSH_CONVERT}};

static const struct {
    const char *name;
    double metres;
} UNITS[] = {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"um", 1e-6}, {"in", 0.0254}, {"ft", 0.3048}};

double mesh_read_unit(const char *name)
{
    for (size_t i = 0; i < sizeof UNITS / sizeof *UNITS; i++)
        if (strcmp(name, UNITS[i].name) == 0)
            return UNITS[i].metres;
    return 0.0;
}

static const char *suffix_of(const char *path)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
    return dot && (!slash || dot > slash) ? dot : "";
}

static enum percuss_status read_through_gmsh(const char *path, enum gmsh_task task,
                                             const struct mesh_options *options,
                                             struct solid_mesh *mesh, struct fault *fault)
{
    struct gmsh_file file;
    enum percuss_status status =
        gmsh_run(path, task, options->unit, options->size / options->unit, &file, fault);
    if (status == PERCUSS_OK)
        status = msh_read(file.mesh, path, options->unit, mesh, fault);
    gmsh_forget(&file);
    return status;
}

enum percuss_status mesh_read(const char *path, const struct mesh_options *options,
                              struct solid_mesh *mesh, struct fault *fault)
{
    const char *suffix = suffix_of(path);
    memset(mesh, 0, sizeof *mesh);
    if (!(options->unit > 0.0 && isfinite(options->unit)))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "unit: %g: must be > 0 m", options->unit);
    if (!(options->size >= 0.0 && isfinite(options->size)))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "size: %g: must be >= 0 m", options->size);
    if (strcasecmp(suffix, ".inp") == 0)
        return inp_read(path, options->unit, mesh, fault);
    if (strcasecmp(suffix, ".msh") == 0)
        return msh_is_readable(path) ? msh_read(path, path, options->unit, mesh, fault)
                                     : read_through_gmsh(path, GMSH_CONVERT, options, mesh, fault);
    for (size_t i = 0; i < sizeof FORMATS / sizeof *FORMATS; i++)
        if (strcasecmp(suffix, FORMATS[i].suffix) == 0)
            return read_through_gmsh(path, FORMATS[i].task, options, mesh, fault);
    return fault_set(
        fault, PERCUSS_BAD_REQUEST,
        "%s: its name must end with .msh, .inp, .step, .stp, .iges, .igs, .brep, .geo, "
        ".stl, .bdf, .nas, .unv, .vtk or .mesh",
        path);
}
