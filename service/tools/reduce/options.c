/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/options.h"

#include <argp.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/units.h"
#include "mesh/mesh_read.h"
#include "model/limits.h"
#include "percuss/habits.h"

enum {
    USAGE = 2,
    YOUNG = 256,
    POISSON,
    DENSITY,
    SIZE,
    RAISE,
    INSTANCE,
    SITE,
    FLEXIBILITY,
    ADD_SITES,
    STIFFNESS,
    MASS,
    FREEDOMS,
    VTK,
    JSON,
    PROGRESS
};

/* Wider than those of a catalogue: whether it is a solid's is asked when the mesh's unit is known.
 */
static const struct limit limit_stiffness = {
    1.0, 1e15, false, false, "a modulus, 1 to 1e+15 Pa", QUANTITY_STRESS};
static const struct limit limit_mass = {
    1e-3, 1e6, false, false, "a density, 0.001 to 1e+06 kg/m^3", QUANTITY_DENSITY};
static const struct limit limit_frequency = {
    1e-3, 1e12, false, false, "a frequency, 0.001 to 1e+12 Hz", QUANTITY_FREQUENCY};

static const struct limit limit_period = {
    0.1, 86400.0, false, false, "a time, 0.1 to 86400 s", QUANTITY_TIME};

static const struct argp_option list[] = {
    {"output", 'o', "BODY.h5", 0, "The body's file", 0},
    {NULL, 0, NULL, 0, "What it is made of, where FILE does not say:", 1},
    {"material", 'm', "NAME", 0, "A material of the catalogue, for all parts", 1},
    {"part", 'p', "PART=NAME", 0, "A material of the catalogue for one part", 1},
    {"catalogue", 'C', "FILE", 0, "Where the materials stand", 1},
    {"young", YOUNG, "E", 0,
     "Or by numbers, all three, or those that FILE lacks: Young's modulus in Pa, or such as 70GPa,",
     1},
    {"poisson", POISSON, "N", 0, "Poisson's ratio,", 1},
    {"density", DENSITY, "R", 0, "and density in kg/m^3, or such as 2.7g/cm^3", 1},
    {NULL, 0, NULL, 0, "How it is computed:", 2},
    {"unit", 'u', "UNIT", 0, "Of lengths in FILE: m (default), cm, mm, um, in, ft", 2},
    {"size", SIZE, "H", 0, "Of the elements that Gmsh makes of a shape, in the unit or such as 4mm",
     2},
    {"raise", RAISE, NULL, 0,
     "Take linear elements, too, with mid nodes in the middle of their straight edges", 2},
    {"max-frequency", 'f', "F", 0,
     "All modes below it, in Hz or such as 20kHz; default: as far as the mesh is good, at most 300 "
     "modes",
     2},
    {"modes", 'n', "N", 0, "So many modes instead", 2},
    {"instance", INSTANCE, "NAME", 0, "Of the instances in a deck's assembly, the body", 2},
    {"fixed", 'x', "SET", 0,
     "Hold the nodes of a set, such as foot or PART.foot (as often as needed)", 2},
    {"stiffness", STIFFNESS, "K", 0, "Take it from a file (.mtx, .sti), with", 2},
    {"mass", MASS, "M", 0, "the mass (.mtx, .mas)", 2},
    {"freedoms", FREEDOMS, "DOF", 0, "and which row is which direction (.dof)", 2},
    {"site", SITE, "X,Y,Z", 0,
     "A place that will be hit, in the unit or such as 0,20mm,45mm (as often as needed)", 2},
    {"flexibility", FLEXIBILITY, "WHEN", 0,
     "That of the surface is solved for ahead (default) or later: at the sites alone, to which "
     "--add-sites adds others",
     2},
    {"sites", 0, NULL, OPTION_ALIAS, NULL, 0},
    {"add-sites", ADD_SITES, "BODY.h5", 0,
     "Solve for it at the sites and add them to a body that was made so; FILE, if the mesh has "
     "moved, but no other option of it",
     2},
    {NULL, 0, NULL, 0, "What is told:", 3},
    {"vtk", VTK, "FILE.vtu", 0, "Also write mesh and modes for ParaView", 3},
    {"json", JSON, NULL, 0, "The report as one JSON object", 3},
    {"progress", PROGRESS, "S", 0,
     "A line of progress for each stage and every S seconds, or such as 2min; default 30 s without "
     "stages, if "
     "standard error is no terminal",
     3},
    {0},
};

static double parse_number(struct argp_state *state, const char *name, const char *text,
                           double least, double most)
{
    char *end;
    double number = strtod(text, &end);
    if (end == text || *end || !(number >= least && number <= most))
        argp_error(state, "--%s: %s: must be a number, %g to %g", name, text, least, most);
    return number;
}

/* The same in its SI unit, or with one of its own. */
static double parse_quantity(struct argp_state *state, const char *name, const char *text,
                             const struct limit *limit)
{
    double number;
    if (units_read(text, limit->quantity, &number) || !limit_holds(limit, number))
        argp_error(state, "--%s: %s: must be %s, or with a unit, such as %s", name, text,
                   limit->text, units_example(limit->quantity));
    return number;
}

static void check_room(struct argp_state *state, const char *name, size_t count)
{
    if (count == OPTIONS_MOST)
        argp_error(state, "--%s: must be given at most %d times", name, OPTIONS_MOST);
}

static void add_part(struct argp_state *state, struct options *options, char *text)
{
    /* names of parts may have an equals sign, those of materials have none */
    char *equals = strrchr(text, '=');
    check_room(state, "part", options->part_count);
    if (!equals || equals == text || !equals[1])
        argp_error(state, "--part: %s: must be PART=MATERIAL", text);
    *equals = '\0';
    options->parts[options->part_count++] = (struct part_option){text, equals + 1};
}

/* The first `length` characters as a length in the mesh's unit: a number alone is in it already.
 * False: it is none. */
static bool read_length(const char *text, size_t length, double unit, double *number)
{
    char copy[64];
    if (length >= sizeof copy)
        return false;
    memcpy(copy, text, length);
    copy[length] = '\0';
    if (units_read(copy, QUANTITY_LENGTH, number))
        return false;
    const char *rest = units_number_end(copy);
    if (rest[strspn(rest, " ")])
        *number /= unit;
    return true;
}

static bool read_site(const char *at, double unit, double site[3])
{
    for (int k = 0; k < 3; k++) {
        size_t length = strcspn(at, ",");
        bool last = k == 2;
        if ((at[length] == '\0') != last || !read_length(at, length, unit, &site[k]))
            return false;
        at += length + !last;
    }
    return true;
}

enum percuss_status options_read_sites(struct options *options, struct fault *fault)
{
    for (size_t i = 0; i < options->site_count; i++)
        if (!read_site(options->site_texts[i], options->unit, options->sites[i]))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "--site: %s: must be three numbers, X,Y,Z, in the unit of the mesh or "
                             "with their own, such as 8mm",
                             options->site_texts[i]);
    return PERCUSS_OK;
}

/* When the unit of the mesh is known: that of a body to add to stands in its file. */
static void read_lengths(struct argp_state *state, struct options *options)
{
    const char *size = options->size_text;
    if (options->add_to)
        return;
    if (!(options->unit > 0.0))
        options->unit = 1.0;
    if (size && !(read_length(size, strlen(size), options->unit, &options->size) &&
                  options->size >= 1e-9 && options->size <= 1e9))
        argp_error(state,
                   "--size: %s: must be a number, 1e-09 to 1e+09, in the unit of the mesh, or a "
                   "length with its own, such as 8mm",
                   size);
    struct fault fault;
    if (options_read_sites(options, &fault))
        argp_error(state, "%s", fault.text);
}

static error_t parse_material(int key, char *text, struct argp_state *state)
{
    struct options *options = state->input;
    switch (key) {
    /* by names of a catalogue */
    case 'm':
        options->material = text;
        return 0;
    case 'p':
        add_part(state, options, text);
        return 0;
    case 'C':
        options->catalogue = text;
        return 0;
    /* by numbers */
    case YOUNG:
        options->young = parse_quantity(state, "young", text, &limit_stiffness);
        return 0;
    case POISSON:
        options->poisson = parse_number(state, "poisson", text, -0.99, 0.4999);
        return 0;
    case DENSITY:
        options->density = parse_quantity(state, "density", text, &limit_mass);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static error_t parse_matrices(int key, char *text, struct argp_state *state)
{
    struct options *options = state->input;
    switch (key) {
    case STIFFNESS:
        options->stiffness = text;
        return 0;
    case MASS:
        options->mass = text;
        return 0;
    case FREEDOMS:
        options->freedoms = text;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static error_t parse_method(int key, char *text, struct argp_state *state)
{
    struct options *options = state->input;
    switch (key) {
    /* lengths */
    case 'u':
        options->unit = mesh_read_unit(text);
        if (!(options->unit > 0.0))
            argp_error(state, "--unit: %s: must be m, cm, mm, um, in or ft", text);
        return 0;
    case SIZE:
        options->size_text = text;
        return 0;
    case RAISE:
        options->raise = true;
        return 0;
    /* which modes */
    case 'f':
        options->max_frequency = parse_quantity(state, "max-frequency", text, &limit_frequency);
        return 0;
    case 'n':
        options->modes = (size_t)parse_number(state, "modes", text, 1.0, LIMIT_MODES);
        return 0;
    /* places */
    case INSTANCE:
        options->instance = text;
        return 0;
    case 'x':
        check_room(state, "fixed", options->fixed_count);
        options->fixed[options->fixed_count++] = text;
        return 0;
    case FLEXIBILITY:
        options->later = strcmp(text, "later") == 0;
        if (!options->later && strcmp(text, "ahead") != 0)
            argp_error(state, "--flexibility: %s: must be ahead or later", text);
        return 0;
    case ADD_SITES:
        options->add_to = text;
        return 0;
    case SITE:
        check_room(state, "site", options->site_count);
        options->site_texts[options->site_count++] = text;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* The body's file has all else. */
static void options_check_adding(struct argp_state *state, const struct options *options)
{
    bool numbers = !isnan(options->young) || !isnan(options->poisson) || !isnan(options->density);
    if (options->site_count == 0)
        argp_error(state, "--add-sites: needs --site X,Y,Z");
    if (options->body || options->vtk || options->later || numbers || options->material ||
        options->part_count || options->catalogue || options->unit > 0.0 || options->size_text ||
        options->raise || options->instance || options->fixed_count || options->stiffness ||
        options->mass || options->freedoms || options->modes || options->max_frequency > 0.0)
        argp_error(state, "--add-sites: must be given with --site, FILE, --json and --progress "
                          "alone: all else stands in the body's file");
}

static void options_check(struct argp_state *state, const struct options *options)
{
    if (options->add_to) {
        options_check_adding(state, options);
        return;
    }
    bool numbers = !isnan(options->young) || !isnan(options->poisson) || !isnan(options->density);
    if (!options->file)
        argp_error(state, "FILE must be given");
    if (!options->body)
        argp_error(state, "-o BODY.h5 must be given");
    if (numbers && options->material)
        argp_error(state, "--material: must be given without --young, --poisson and --density");
    if ((options->material || options->part_count) && !options->catalogue)
        argp_error(state, "--material, --part: need --catalogue FILE");
    if (!options->stiffness != !options->mass || (options->freedoms && !options->mass))
        argp_error(state, "--stiffness and --mass must be given together");
    if (options->modes && options->max_frequency > 0.0)
        argp_error(state, "--modes: must be given without --max-frequency");
    if (options->later && options->stiffness)
        argp_error(state, "--flexibility later: must be given without --stiffness and --mass");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct options *options = state->input;
    switch (key) {
    /* output */
    case 'o':
        options->body = text;
        return 0;
    case VTK:
        options->vtk = text;
        return 0;
    case JSON:
        options->json = true;
        return 0;
    case PROGRESS:
        options->progress = parse_quantity(state, "progress", text, &limit_period);
        return 0;
    case ARGP_KEY_ARG:
        if (options->file)
            argp_error(state, "'%s': one FILE alone is reduced", text);
        options->file = text;
        return 0;
    case ARGP_KEY_END:
        read_lengths(state, options);
        options_check(state, options);
        return 0;
    /* materials, matrices and method */
    default:
        if (parse_material(key, text, state) == 0 || parse_matrices(key, text, state) == 0)
            return 0;
        return parse_method(key, text, state);
    }
}

struct options options_read(int argc, char **argv)
{
    static const struct argp argp = {
        .options = list,
        .parser = parse,
        .children = habits,
        .args_doc = "FILE -o BODY.h5\n--add-sites BODY.h5 --site X,Y,Z",
        .doc =
            "Reduces a body that is given as a mesh of second-order elements to its modes of "
            "vibration and what else an impact needs of it, in a file for the catalogue."
            "\vFILE is Gmsh's .msh, VTK's .vtk, .unv, a deck of Abaqus, CalculiX (.inp) or Nastran "
            "(.bdf); .step, .stl and more where Gmsh is installed. The report goes to "
            "standard output, progress to standard error.",
    };
    struct options options = {.young = NAN, .poisson = NAN, .density = NAN};
    argp_err_exit_status = USAGE;
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    return options;
}
