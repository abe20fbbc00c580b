/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/mesh_format.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* by the end of its name */
static const struct {
    const char *suffix;
    enum mesh_format format;
} NAMES[] = {
    {".msh", MESH_FORMAT_MSH},    {".inp", MESH_FORMAT_INP},     {".bdf", MESH_FORMAT_BDF},
    {".nas", MESH_FORMAT_BDF},    {".step", MESH_FORMAT_SHAPE},  {".stp", MESH_FORMAT_SHAPE},
    {".iges", MESH_FORMAT_SHAPE}, {".igs", MESH_FORMAT_SHAPE},   {".brep", MESH_FORMAT_SHAPE},
    {".geo", MESH_FORMAT_SHAPE},  {".stl", MESH_FORMAT_SURFACE}, {".unv", MESH_FORMAT_UNV},
    {".vtk", MESH_FORMAT_VTK},    {".mesh", MESH_FORMAT_MESHED}};

/* by the first line that is neither empty nor a comment */
static const struct {
    const char *begin;
    enum mesh_format format;
} BEGINNINGS[] = {{"$MeshFormat", MESH_FORMAT_MSH}, {"$NOD", MESH_FORMAT_MSH},
                  {"BEGIN BULK", MESH_FORMAT_BDF},  {"GRID ", MESH_FORMAT_BDF},
                  {"GRID*", MESH_FORMAT_BDF},       {"GRID,", MESH_FORMAT_BDF},
                  {"SOL ", MESH_FORMAT_BDF},        {"CEND", MESH_FORMAT_BDF},
                  {"# vtk", MESH_FORMAT_VTK},       {"-1\n", MESH_FORMAT_UNV},
                  {"-1\r", MESH_FORMAT_UNV},        {"ISO-10303-21", MESH_FORMAT_SHAPE}};

/* Formats of other programs by the end of their names (between spaces) or their beginning, and what
 * these programs can write instead. */
static const struct foreign {
    const char *suffixes, *begin, *words;
} FOREIGN[] = {
    {" .med .rmed .hdf .h5 ", "\x89HDF",
     "is a file of Salome (MED) or another one of HDF5: in Salome select the mesh, quadratic by "
     "Modification, Convert to/from quadratic, and File, Export, UNV file"},
    {" .cdb ", "/COM,ANSYS",
     "is an archive of ANSYS (CDWRITE): save the geometry as STEP, or have the mesh written as "
     "bulk data of Nastran (.bdf) or as a deck of Abaqus (.inp) with mid-side nodes kept"},
    {" .cdb ", "/PREP7",
     "is an input of ANSYS (APDL): save the geometry as STEP, or have the mesh "
     "written as bulk data of Nastran (.bdf) with mid-side nodes kept"},
    {" .k .key .dyn ", "*KEYWORD",
     "is a keyword file of LS-DYNA, whose solids are linear as a rule: save the geometry as STEP, "
     "or mesh it with 10-node tetrahedra and write bulk data of Nastran (.bdf)"},
    {" .vtu .vtk ", "<?xml",
     "is XML, such as VTK's .vtu: in ParaView File, Save Data, as legacy "
     "VTK (.vtk)"},
    {" .vtu ", "<VTKFile", "is VTK's XML: in ParaView File, Save Data, as legacy VTK (.vtk)"},
    {" ", "(0 ", "is a mesh of Fluent, whose cells are linear: save the geometry as STEP"},
    {" .sldprt .sldasm .ipt .iam .catpart .prt .asm .x_t .x_b .sat .sab .f3d .fcstd .3dm .par ",
     NULL, "is a part of a CAD program: save it as STEP (.step)"},
    {" .obj .ply .3mf .amf .off ", NULL,
     "holds triangles of a surface: save the part as STEP, or where there is none as STL"}};

enum { BEGINNING_SIZE = 256, MOST_COMMENTS = 1000 };

static const char *suffix_of(const char *path)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
    return dot && (!slash || dot > slash) ? dot : "";
}

/* Whether a line is the section $NOD of Gmsh's first format, and no comment like "$NODES". */
static bool is_nod(const char *line)
{
    return strncmp(line, "$NOD", 4) == 0 && (line[4] == '\0' || isspace((unsigned char)line[4]));
}

/* The first line that says something: not empty, no comment of a deck ("**") or of bulk data ("$ ",
 * "$*", "$$"). */
static void first_line(const char *path, char line[BEGINNING_SIZE])
{
    FILE *stream = fopen(path, "rb");
    line[0] = '\0';
    for (int i = 0; stream && i < MOST_COMMENTS && fgets(line, BEGINNING_SIZE, stream); i++) {
        size_t blank = strspn(line, " \t\r\n\xEF\xBB\xBF");
        memmove(line, line + blank, strlen(line + blank) + 1);
        bool comment = strncmp(line, "**", 2) == 0 ||
                       (line[0] == '$' && strncmp(line, "$MeshFormat", 11) != 0 && !is_nod(line));
        if (line[0] && !comment)
            break;
    }
    if (stream)
        fclose(stream);
}

static const struct foreign *foreign_beginning(const char *line)
{
    for (size_t i = 0; i < sizeof FOREIGN / sizeof *FOREIGN; i++)
        if (FOREIGN[i].begin && strncasecmp(line, FOREIGN[i].begin, strlen(FOREIGN[i].begin)) == 0)
            return &FOREIGN[i];
    return NULL;
}

enum mesh_format mesh_format_of(const char *path)
{
    char line[BEGINNING_SIZE];
    const char *suffix = suffix_of(path);
    first_line(path, line);
    for (size_t i = 0; i < sizeof BEGINNINGS / sizeof *BEGINNINGS; i++)
        if (strncasecmp(line, BEGINNINGS[i].begin, strlen(BEGINNINGS[i].begin)) == 0)
            return BEGINNINGS[i].format;
    /* another program's contents win over a name that is read */
    if (foreign_beginning(line))
        return MESH_FORMAT_NONE;
    /* a keyword of a deck, with any blanks */
    if (line[0] == '*' && isalpha((unsigned char)line[1 + strspn(line + 1, " ")]))
        return MESH_FORMAT_INP;
    for (size_t i = 0; i < sizeof NAMES / sizeof *NAMES; i++)
        if (strcasecmp(suffix, NAMES[i].suffix) == 0)
            return NAMES[i].format;
    return MESH_FORMAT_NONE;
}

/* the entry of a program, by the file's first line or its name; NULL: there is none */
static const struct foreign *find_foreign(const char *path)
{
    char line[BEGINNING_SIZE], suffix[BEGINNING_SIZE];
    first_line(path, line);
    const struct foreign *found = foreign_beginning(line);
    if (found)
        return found;
    snprintf(suffix, sizeof suffix, " %s ", suffix_of(path));
    for (size_t i = 0; i < sizeof FOREIGN / sizeof *FOREIGN; i++)
        if (strlen(suffix) > 3 && strcasestr(FOREIGN[i].suffixes, suffix))
            return &FOREIGN[i];
    return NULL;
}

enum percuss_status mesh_format_refuse(const char *path, struct fault *fault)
{
    const struct foreign *foreign = find_foreign(path);
    if (foreign)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %s", path, foreign->words);
    return fault_set(
        fault, PERCUSS_BAD_REQUEST,
        "%s: its name must end with .msh, .inp, .bdf, .nas, .vtk, .unv, .step, .stp, .iges, .igs, "
        ".brep, .geo, .stl or .mesh",
        path);
}
