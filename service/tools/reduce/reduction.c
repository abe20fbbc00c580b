/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/reduction.h"

#include <errno.h>
#include <libgen.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "catalogue/catalogue.h"
#include "mesh/body_file.h"
#include "mesh/matrices_read.h"
#include "mesh/mesh_read.h"
#include "mesh/sites_file.h"
#include "model/limits.h"
#include "model/mesh_surface.h"
#include "reduce/forked.h"
#include "reduce/recipe.h"
#include "reduce/vtk.h"

/* ---- materials of the parts ---- */

static void give_material(struct mesh_part *part, const struct material *material)
{
    part->material = *material;
    part->has_material = true;
}

/* The material of one part that the command line names. */
static enum percuss_status assign_part_material(const struct options *options,
                                                const struct part_option *option,
                                                struct solid_mesh *mesh, struct fault *fault)
{
    struct material material;
    size_t i = 0;
    while (i < mesh->part_count && strcmp(mesh->part[i].name, option->part) != 0)
        i++;
    if (i == mesh->part_count)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "--part: %s: the mesh has %zu part%s, the first is \"%s\"", option->part,
                         mesh->part_count, mesh->part_count == 1 ? "" : "s", mesh->part[0].name);
    enum percuss_status status =
        catalogue_material(options->catalogue, option->material, &material, fault);
    if (!status)
        give_material(&mesh->part[i], &material);
    return status;
}

/* One for all, then those of single parts. */
static enum percuss_status assign_named_materials(const struct options *options,
                                                  struct solid_mesh *mesh, struct fault *fault)
{
    struct material material;
    enum percuss_status status = PERCUSS_OK;
    if (options->material)
        status = catalogue_material(options->catalogue, options->material, &material, fault);
    for (size_t i = 0; options->material && !status && i < mesh->part_count; i++)
        give_material(&mesh->part[i], &material);
    for (size_t k = 0; !status && k < options->part_count; k++)
        status = assign_part_material(options, &options->parts[k], mesh, fault);
    return status;
}

/* A number of the command line for the parts that lack it; *lacking: whether one did. */
static double complete(double stated, double given, bool *lacking)
{
    bool lacks = isnan(stated) && !isnan(given);
    *lacking = *lacking || lacks;
    return lacks ? given : stated;
}

/* Fills what the mesh's file does not state. PERCUSS_BAD_REQUEST: it lacks none of these. */
static enum percuss_status complete_materials(const struct options *options,
                                              struct solid_mesh *mesh, struct fault *fault)
{
    bool young = isnan(options->young), poisson = isnan(options->poisson),
         density = isnan(options->density);
    for (size_t i = 0; i < mesh->part_count; i++) {
        struct material *material = &mesh->part[i].material;
        material->young = complete(material->young, options->young, &young);
        material->poisson = complete(material->poisson, options->poisson, &poisson);
        material->density = complete(material->density, options->density, &density);
        mesh->part[i].has_material =
            !isnan(material->young) && !isnan(material->poisson) && !isnan(material->density);
        if (mesh->part[i].has_material && !material->name[0])
            snprintf(material->name, sizeof material->name, "given");
    }
    if (young && poisson && density)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "--%s: %s states it for every part already: to override that give --young, "
                     "--poisson and --density, all three",
                     !young     ? "young"
                     : !poisson ? "poisson"
                                : "density",
                     options->file);
}

/* It is another mesh than the one that the body was made of. */
static enum percuss_status refuse_mesh(const struct reduction *reduction, struct fault *fault)
{
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "%.300s: is not the mesh that %.300s was made of: it has changed since, or "
                     "Gmsh meshes it otherwise now: reduce it again",
                     reduction->options->file, reduction->options->add_to);
}

/* Materials of the command line override those of the mesh's file. PERCUSS_BAD_REQUEST: a part has
 * no material, or there is no such part or material. */
static enum percuss_status materials_assign(const struct options *options, struct solid_mesh *mesh,
                                            struct fault *fault)
{
    /* one material given by numbers is that of every part */
    struct fault inner = {""};
    enum percuss_status status = PERCUSS_OK;
    if (!isnan(options->young) && !isnan(options->poisson) && !isnan(options->density)) {
        struct material material = {"given",          options->young, options->poisson,
                                    options->density, INFINITY,       0.0};
        for (size_t i = 0; i < mesh->part_count; i++)
            give_material(&mesh->part[i], &material);
    } else {
        status = complete_materials(options, mesh, fault);
    }
    /* names on the command line go before it */
    if (!status)
        status = assign_named_materials(options, mesh, fault);
    /* each part has one that is good */
    for (size_t i = 0; !status && i < mesh->part_count; i++) {
        const struct mesh_part *part = &mesh->part[i];
        if (!part->has_material)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "part \"%s\": has no material%s%s%s: give --material NAME "
                             "--catalogue FILE, or --young, --poisson and --density (those that "
                             "are missing)",
                             part->name, part->lacks[0] ? " (" : "", part->lacks,
                             part->lacks[0] ? ")" : "");
        if (material_check(&part->material, &inner))
            return fault_set(fault, PERCUSS_BAD_REQUEST, "material of part \"%s\": %s", part->name,
                             inner.text);
    }
    return status;
}

/* Those of a body that was made of the mesh. */
static enum percuss_status materials_of_body(struct reduction *reduction, struct fault *fault)
{
    const struct mesh_body *body = reduction->body;
    struct solid_mesh *mesh = &reduction->mesh;
    if (mesh->part_count != body->material_count)
        return refuse_mesh(reduction, fault);
    for (size_t i = 0; i < mesh->part_count; i++)
        give_material(&mesh->part[i], &body->materials[i]);
    return PERCUSS_OK;
}

/* ---- the stages of a reduction ---- */

/* Elements of second order for the shortest wave: frequencies are good to 1e-3 then. */
static const double ELEMENTS_PER_WAVE = 8.0;

/* Of a body that is so compact that no mode lies as far as the mesh is good. */
enum { LEAST_MODES = 10 };

/* Most modes without which flexibility is interpolated (on a bracket 110 are three times as exact
 * as 30; sites_find takes fewer where that is no better), and sites that it is computed at. */
enum { REMOVED = 120, SITES = 1500 };

/* Of an element's size: how far a site may be off the surface. */
static const double OFF_SURFACE = 0.5;

/* Matrices' scale over the mesh's: 1 to 100 by shapes and orders of elements; another unit of
 * length makes 1e6 of mass, exchanged ones 1e20. */
static const double OTHER_SCALE = 1e5;

/* The slowest shear wave that the mesh carries. */
static double frequency_limit(const struct solid_mesh *mesh, double element)
{
    double slowest = INFINITY;
    for (size_t i = 0; i < mesh->part_count; i++) {
        const struct material *material = &mesh->part[i].material;
        slowest = fmin(slowest, sqrt(material_shear_modulus(material) / material->density));
    }
    return slowest / (ELEMENTS_PER_WAVE * element);
}

/* Sites in metres, which must lie on the surface but for the rounding of a file. */
static enum percuss_status place_sites(struct reduction *reduction, struct fault *fault)
{
    const struct options *options = reduction->options;
    for (size_t i = 0; i < options->site_count; i++) {
        double *site = reduction->sites_asked[i];
        for (int k = 0; k < 3; k++)
            site[k] = options->unit * options->sites[i][k];
        struct surface_place place = surface_near(&reduction->mesh, &reduction->surface, site);
        if (place.foot.distance > OFF_SURFACE * reduction->surface.size)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "--site: %g,%g,%g: is %.3g mm off the surface, must be on it within "
                             "%.3g mm",
                             options->sites[i][0], options->sites[i][1], options->sites[i][2],
                             1e3 * place.foot.distance,
                             1e3 * OFF_SURFACE * reduction->surface.size);
    }
    return PERCUSS_OK;
}

static enum percuss_status read_body(struct reduction *reduction, struct fault *fault)
{
    /* the mesh, its materials and its surface, each checked by the next step */
    const struct options *options = reduction->options;
    struct mesh_options how = {.unit = options->unit,
                               .size = options->size * options->unit,
                               .instance = options->instance,
                               .raise = options->raise};
    struct solid_mesh *mesh = &reduction->mesh;
    enum percuss_status status = mesh_read(options->file, &how, mesh, fault);
    for (size_t i = 0; i < mesh->remark_count; i++)
        fprintf(stderr, "percuss-reduce: warning: %s\n", mesh->remarks[i]);
    if (!status)
        status = reduction->body ? materials_of_body(reduction, fault)
                                 : materials_assign(options, mesh, fault);
    if (!status)
        status = surface_make(mesh, &reduction->surface, fault);
    if (!status)
        status = surface_fit(mesh, &reduction->surface, fault);
    if (!status)
        status = mesh_check(mesh, &reduction->surface, &reduction->findings, fault);
    /* on that of a body once it is known to be the same */
    if (!status && !reduction->body)
        status = place_sites(reduction, fault);
    if (status)
        return status;
    /* figures that need no matrix */
    bulk_of(mesh, &reduction->bulk);
    reduction->enclosed = reduced_body_enclosed(mesh, &reduction->surface);
    reduction->good_to = frequency_limit(mesh, reduction->surface.size);
    /* odd, but allowed */
    for (size_t i = 0; i < reduction->findings.remark_count; i++)
        fprintf(stderr, "percuss-reduce: warning: %s\n", reduction->findings.remarks[i]);
    return PERCUSS_OK;
}

/* Holds the named sets; their names go into the file. */
static enum percuss_status hold_sets(struct reduction *reduction, struct fault *fault)
{
    const struct solid_mesh *mesh = &reduction->mesh;
    enum percuss_status status = PERCUSS_OK;
    for (size_t k = 0; k < reduction->options->fixed_count && !status; k++) {
        const char *name = reduction->options->fixed[k];
        size_t i, length = strlen(reduction->supports);
        struct fault inner = {""};
        if (solid_mesh_find_set(mesh, name, &i, &inner))
            return fault_set(fault, PERCUSS_BAD_REQUEST, "--fixed: %s", inner.text);
        status = matrices_hold(&reduction->matrices, &mesh->set[i], fault);
        snprintf(reduction->supports + length, sizeof reduction->supports - length, "%s%s",
                 length ? " " : "", name);
    }
    return status;
}

/* Foreign matrices that are not those of this mesh: their diagonals give the frequency of an
 * element by itself, against a shear wave across it. */
static enum percuss_status check_scale(const struct reduction *reduction, struct fault *fault)
{
    const struct matrices *matrices = &reduction->matrices;
    double stiffness = 0.0, mass = 0.0;
    for (size_t i = 0; i < matrices->stiffness.n; i++) {
        if (matrices->held && matrices->held[i])
            continue;
        stiffness += matrices->stiffness.value[matrices->stiffness.start[i]];
        mass += matrices->mass.value[matrices->mass.start[i]];
    }
    double wave = 2.0 * M_PI * ELEMENTS_PER_WAVE * reduction->good_to;
    double ratio = stiffness / mass / (wave * wave);
    if (ratio > 1.0 / OTHER_SCALE && ratio < OTHER_SCALE)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "--stiffness, --mass: %g 1/s^2 from one to the other on the diagonals, %.1g "
                     "times what the mesh lets expect: are they exchanged, of another mesh, or in "
                     "other units?",
                     stiffness / mass, ratio);
}

static enum percuss_status assemble_matrices(struct reduction *reduction, struct fault *fault)
{
    /* matrices from files, with their own held nodes, or from the mesh */
    const struct options *options = reduction->options;
    struct matrices_files files = {options->stiffness, options->mass, options->freedoms};
    enum percuss_status status =
        files.stiffness ? matrices_read(&files, &reduction->mesh, &reduction->matrices, fault)
                        : matrices_make(&reduction->mesh, &reduction->matrices, fault);
    if (!status && reduction->matrices.held)
        snprintf(reduction->supports, sizeof reduction->supports, "(matrices)");
    if (!status && files.stiffness)
        status = check_scale(reduction, fault);
    /* and the sets that the command line holds */
    if (!status)
        status = hold_sets(reduction, fault);
    if (status)
        return status;
    /* the task of the modes, and the rigid motions left to it */
    struct modes_task *task = &reduction->task;
    task->matrices = &reduction->matrices;
    task->scale = rigid_modes_scale(&reduction->mesh, &reduction->bulk);
    task->rigid.n = reduction->matrices.stiffness.n;
    task->known = SIZE_MAX;
    status = rigid_modes_make(&reduction->mesh, &reduction->matrices, task->scale,
                              &task->rigid.count, &reduction->rigid, fault);
    task->rigid.values = reduction->rigid;
    return status;
}

/* Memory of the machine that nothing uses, bytes; INFINITY where the system does not say. */
static double free_memory(void)
{
    double kilobytes = INFINITY;
    char line[128];
    FILE *file = fopen("/proc/meminfo", "r");
    while (file && fgets(line, sizeof line, file))
        if (sscanf(line, "MemAvailable: %lf", &kilobytes) == 1)
            break;
    if (file)
        fclose(file);
    return 1024.0 * kilobytes;
}

/* As many as there are processors, and memory for the columns that each holds beside the factor. */
static size_t processes_for(const struct reduction *reduction)
{
    enum { COLUMNS = 8 * FLEXIBILITY_BLOCK };
    double each = COLUMNS * sizeof(double) * (double)reduction->matrices.stiffness.n;
    double room = 1.0 + 0.5 * free_memory() / each;
    double processors = factor_forks() ? (double)forked_processors() : 1.0;
    return (size_t)fmin(processors, room);
}

/* the sites that flexibility is solved for at; a watch and modes come later */
static struct sites_task sites_task_of(const struct reduction *reduction)
{
    return (struct sites_task){.body = {.mesh = &reduction->mesh,
                                        .surface = &reduction->surface,
                                        .matrices = &reduction->matrices,
                                        .rigid_count = reduction->task.rigid.count,
                                        .rigid = reduction->rigid},
                               .most = SITES,
                               .exact_count = reduction->options->site_count,
                               .exact = (const double(*)[3])reduction->sites_asked,
                               .between = true,
                               .processes = processes_for(reduction)};
}

/* The order of unknowns, this machine's rates and a sample of the sites' integrals, which all
 * estimates follow from. */
static enum percuss_status take_sample(struct reduction *reduction, struct fault *fault)
{
    enum percuss_status status =
        factor_analyse(&reduction->matrices, FACTOR_POSITIVE, NULL, &reduction->factor, fault);
    if (status)
        return status;
    if (!rates_measure(&reduction->rates))
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    reduction->factor_cost = factor_cost(reduction->factor);
    struct sites_task task = sites_task_of(reduction);
    if (reduction->options->later) {
        reduction->sample.count = reduction->options->site_count;
        return PERCUSS_OK;
    }
    return sites_sample(&task, &reduction->sample, fault);
}

/* Of what the matrices take themselves, bytes. */
static double matrices_memory(const struct reduction *reduction)
{
    size_t n = reduction->task.rigid.n;
    return 12.0 * (double)reduction->matrices.stiffness.start[n] +
           12.0 * (double)reduction->matrices.mass.start[n];
}

/* Of reduction->cost; both in bytes. */
static enum percuss_status check_memory(const struct reduction *reduction, double free,
                                        const char *remedy, struct fault *fault)
{
    if (reduction->cost.memory <= free)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "needs %.2g GB of memory, of which %.2g GB are free: %s",
                     1e-9 * reduction->cost.memory, 1e-9 * free, remedy);
}

/* From here on the time left is told. */
static void foretell(struct reduction *reduction)
{
    reduction->progress.work = rates_clock();
    reduction->progress.expected = reduction->cost.seconds + reduction->statics;
    progress_clear(&reduction->progress);
}

/* Tells time and memory before the first factor, and refuses where the memory does not suffice. */
static enum percuss_status estimate_cost(struct reduction *reduction, size_t count, bool counted,
                                         struct fault *fault)
{
    size_t n = reduction->task.rigid.n, sites = reduction->sample.count;
    reduction->cost =
        modes_cost(&reduction->factor_cost, &reduction->rates, &reduction->matrices, count);
    /* and the matrices themselves */
    double matrices = matrices_memory(reduction);
    double free = free_memory();
    reduction->task.two_factors = reduction->cost.together + matrices < free;
    reduction->task.processes = processes_for(reduction);
    reduction->cost.memory = matrices + (reduction->task.two_factors ? reduction->cost.together
                                                                     : reduction->cost.memory);
    double column =
        flexibility_column_seconds(&reduction->rates, &reduction->factor_cost,
                                   &reduction->matrices.mass, count < REMOVED ? count : REMOVED);
    double each = reduction->sample.seconds + FLEXIBILITY_LOADS * column;
    reduction->statics =
        (double)sites * each / (double)processes_for(reduction) + reduction->sample.faces;
    foretell(reduction);
    fprintf(stderr,
            "percuss-reduce: %zu unknowns, %s%zu modes: about %.2g GB of memory, %.2g s for the "
            "modes and %.2g s for the flexibility at %zu sites\n",
            n, counted ? "" : "up to ", count, 1e-9 * reduction->cost.memory,
            reduction->cost.seconds, reduction->statics, sites);
    return check_memory(reduction, free, "fewer modes (--modes) or a coarser mesh", fault);
}

/* The part of the work that seeking modes is. */
static double modes_share(const struct reduction *reduction)
{
    return reduction->cost.seconds / (reduction->cost.seconds + reduction->statics);
}

/* Which modes: by number, by frequency, or as far as the mesh is good. */
static enum percuss_status choose_modes(struct reduction *reduction, struct fault *fault)
{
    /* the largest number, and its cost */
    const struct options *options = reduction->options;
    struct modes_task *task = &reduction->task;
    bool asked = options->max_frequency > 0.0;
    task->most = options->modes ? options->modes : asked ? LIMIT_MODES : OPTIONS_MODES;
    task->below = INFINITY;
    enum percuss_status status = take_sample(reduction, fault);
    if (!status)
        status =
            estimate_cost(reduction, asked ? OPTIONS_MODES : task->most, options->modes > 0, fault);
    if (status || options->modes)
        return status;
    /* by frequency, asked for or the mesh's own: those below are counted */
    double hertz = asked ? options->max_frequency : reduction->good_to;
    size_t count;
    progress_stage(&reduction->progress, "counting modes", 0.0, 0.0);
    status = modes_count(task, 2.0 * M_PI * hertz, reduction->factor, &count, fault);
    if (status)
        return status;
    /* below one that was asked for there must be some */
    if (asked && (count == 0 || count > LIMIT_MODES))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "--max-frequency: %g Hz: there are %zu modes below, must be 1 to %d",
                         hertz, count, LIMIT_MODES);
    /* as far as the mesh is good there may be none: the first few */
    if (count == 0) {
        task->most = LEAST_MODES;
        return PERCUSS_OK;
    }
    task->below = 2.0 * M_PI * hertz;
    task->known = count;
    return estimate_cost(reduction, count < task->most ? count : task->most, true, fault);
}

static enum percuss_status find_modes(struct reduction *reduction, struct fault *fault)
{
    struct watch watch = {progress_show, &reduction->progress};
    progress_stage(&reduction->progress, "modes", 0.0, modes_share(reduction));
    reduction->task.watch = &watch;
    enum percuss_status status =
        modes_find(&reduction->task, &reduction->modes, &reduction->factor, fault);
    reduction->task.watch = NULL;
    return status;
}

static enum percuss_status make_body(struct reduction *reduction, struct fault *fault)
{
    /* the source: the file without its folder, the version, the date in UTC */
    char source[256], date[32] = "";
    time_t now = time(NULL);
    struct tm utc;
    if (gmtime_r(&now, &utc))
        strftime(date, sizeof date, "%Y-%m-%d", &utc);
    const char *slash = strrchr(reduction->options->file, '/');
    snprintf(source, sizeof source, "%.150s, percuss-reduce %s, %s",
             slash ? slash + 1 : reduction->options->file, PERCUSS_VERSION, date);
    /* what sites are solved for with later */
    const struct options *options = reduction->options;
    char *path = options->later ? realpath(options->file, NULL) : NULL;
    char *recipe = options->later ? recipe_write(options) : NULL;
    if (options->later && (!path || !recipe)) {
        free(path);
        free(recipe);
        return fault_set(fault, PERCUSS_INTERNAL, "%.300s: out of memory, or it is gone",
                         options->file);
    }
    /* all that the file is made of */
    struct reduced_parts parts = {.mesh = &reduction->mesh,
                                  .surface = &reduction->surface,
                                  .bulk = &reduction->bulk,
                                  .modes = &reduction->modes,
                                  .held = reduction->matrices.held,
                                  .foreign =
                                      reduction->options->stiffness ? &reduction->matrices : NULL,
                                  .site_count = options->later ? 0 : options->site_count,
                                  .sites = (const double(*)[3])reduction->sites_asked,
                                  .source = source,
                                  .supports = reduction->supports,
                                  .mesh_path = path,
                                  .mesh_options = recipe};
    enum percuss_status status = reduced_body_make(&parts, &reduction->body, fault);
    free(path);
    free(recipe);
    return status;
}

/* Solves for the flexibility at the sites that were asked for, and adds them to the body's file.
 * The factor is that of K + shift M. */
static enum percuss_status add_sites(struct reduction *reduction, double shift, struct fault *fault)
{
    size_t count = reduction->options->site_count;
    struct mesh_body_site sites[OPTIONS_MOST];
    struct watch watch = {progress_show, &reduction->progress};
    struct sites_task task = sites_task_of(reduction);
    task.body.factor = reduction->factor;
    task.body.shift = shift;
    task.between = false;
    task.watch = &watch;
    enum percuss_status status = sites_solve_alone(&task, reduction->body, reduction->alone, fault);
    if (!status && !mesh_surface_prepare(reduction->body))
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    for (size_t i = 0; i < count; i++)
        sites[i] = reduction->alone[i].site;
    return status ? status
                  : sites_file_add(reduction->body, count, sites, &reduction->added, fault);
}

/* Of one whose flexibility is solved for later: at its sites alone. The body's file is there then,
 * as theirs is read with it. */
static enum percuss_status leave_flexibility(struct reduction *reduction, struct fault *fault)
{
    const struct modes *modes = &reduction->modes;
    const struct options *options = reduction->options;
    struct sites_task task = sites_task_of(reduction);
    sites_leave(&task.body, modes->count < REMOVED ? modes->count : REMOVED, reduction->body);
    enum percuss_status status = body_file_write(options->body, reduction->body, fault);
    reduction->body->path = strdup(options->body);
    if (!status && !reduction->body->path)
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    if (status || options->site_count == 0)
        return status;
    double share = modes_share(reduction);
    progress_stage(&reduction->progress, "flexibility at the sites", share, 1.0 - share);
    return add_sites(reduction, modes->shift, fault);
}

static enum percuss_status find_flexibility(struct reduction *reduction, struct fault *fault)
{
    const struct modes *modes = &reduction->modes;
    size_t removed = modes->count < REMOVED ? modes->count : REMOVED;
    if (reduction->options->later)
        return leave_flexibility(reduction, fault);
    struct watch watch = {progress_show, &reduction->progress};
    /* modes that are kept are taken out, as many as pay */
    struct sites_task task = sites_task_of(reduction);
    task.body.factor = reduction->factor;
    task.body.shift = modes->shift;
    task.body.removed = removed;
    task.body.shapes = modes->shapes;
    task.body.omega = modes->omega;
    task.watch = &watch;
    double share = modes_share(reduction);
    progress_stage(&reduction->progress, "flexibility of the surface", share, 1.0 - share);
    return sites_find(&task, reduction->body, &reduction->sites, fault);
}

/* Before hours of work: whether a file can be written there. */
static enum percuss_status check_output(const char *path, struct fault *fault)
{
    char *copy = strdup(path);
    enum percuss_status status = PERCUSS_OK;
    if (!copy)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    if (access(path, F_OK) == 0 ? access(path, W_OK) : access(dirname(copy), W_OK))
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "%s: cannot be written: %s", path,
                           strerror(errno));
    free(copy);
    return status;
}

enum percuss_status reduction_run(const struct options *options, struct reduction *reduction,
                                  struct fault *fault)
{
    *reduction =
        (struct reduction){.options = options, .progress = progress_begin(options->progress)};
    progress_stage(&reduction->progress, "reading", 0.0, 0.0);
    enum percuss_status status = check_output(options->body, fault);
    if (!status && options->vtk)
        status = check_output(options->vtk, fault);
    if (!status)
        status = read_body(reduction, fault);
    if (!status)
        status = assemble_matrices(reduction, fault);
    if (!status)
        status = choose_modes(reduction, fault);
    double begun = progress_seconds(&reduction->progress);
    if (!status)
        status = find_modes(reduction, fault);
    reduction->modes_seconds = progress_seconds(&reduction->progress) - begun;
    if (!status)
        status = make_body(reduction, fault);
    begun = progress_seconds(&reduction->progress);
    if (!status)
        status = find_flexibility(reduction, fault);
    reduction->sites_seconds = progress_seconds(&reduction->progress) - begun;
    progress_clear(&reduction->progress);
    /* files */
    if (!status && !options->later)
        status = body_file_write(options->body, reduction->body, fault);
    if (!status && options->vtk)
        status = vtk_write(options->vtk, &reduction->mesh, &reduction->modes, fault);
    reduction->seconds = progress_seconds(&reduction->progress);
    return status;
}

/* Of the first elastic mode's square: a step of the solution leaves as much, and of the sixteen
 * digits rigid motions take three (modes.c). */
static const double BELOW_FIRST = 1e-3;

/* The body, and the options that its file has. */
static enum percuss_status read_later_body(struct reduction *reduction, struct options *options,
                                           struct fault *fault)
{
    enum percuss_status status = body_file_read(options->add_to, &reduction->body, fault);
    if (status)
        return status;
    struct mesh_body_origin *origin = &reduction->body->origin;
    char *sites;
    if (!mesh_body_is_later(reduction->body))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "%.300s: was not made with --flexibility later: reduce its mesh again "
                         "with it, or with --site",
                         options->add_to);
    /* its own file is not written */
    if (asprintf(&sites, "%s.sites", options->add_to) < 0)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    status = check_output(sites, fault);
    /* it is replaced by a new file of that name */
    if (!status && access(dirname(sites), W_OK | X_OK))
        status =
            fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s.sites: its folder cannot be written: %s",
                      options->add_to, strerror(errno));
    free(sites);
    if (!status)
        status = recipe_read(origin->options, options, fault);
    if (!status)
        status = options_read_sites(options, fault);
    if (!options->file)
        options->file = origin->mesh;
    return status;
}

/* Tells time and memory before the factor, and refuses where the memory does not suffice. */
static enum percuss_status estimate_adding(struct reduction *reduction, struct fault *fault)
{
    size_t n = reduction->task.rigid.n, count = reduction->options->site_count;
    reduction->cost.seconds = rates_factor(&reduction->rates, &reduction->factor_cost);
    reduction->cost.memory = matrices_memory(reduction) + reduction->factor_cost.memory;
    reduction->statics = (double)(FLEXIBILITY_LOADS * count) *
                         flexibility_column_seconds(&reduction->rates, &reduction->factor_cost,
                                                    &reduction->matrices.mass, 0);
    foretell(reduction);
    fprintf(stderr,
            "percuss-reduce: %zu unknowns: about %.2g GB of memory, %.2g s for their factor and "
            "%.2g s for the flexibility at %zu site%s\n",
            n, 1e-9 * reduction->cost.memory, reduction->cost.seconds, reduction->statics, count,
            count == 1 ? "" : "s");
    return check_memory(reduction, free_memory(), "a coarser mesh", fault);
}

/* K + shift M of the mesh that the body was made of. */
static enum percuss_status factor_again(struct reduction *reduction, double *shift,
                                        struct fault *fault)
{
    const struct mesh_body *body = reduction->body;
    char hash[SHA256_TEXT];
    enum percuss_status status = assemble_matrices(reduction, fault);
    if (status)
        return status;
    reduced_body_hash_mesh(&reduction->mesh, reduction->matrices.held, hash);
    if (strcmp(hash, body->origin.hash) != 0 || reduction->surface.face_count != body->face_count)
        return refuse_mesh(reduction, fault);
    status = place_sites(reduction, fault);
    if (!status)
        status = take_sample(reduction, fault);
    if (!status)
        status = estimate_adding(reduction, fault);
    if (status)
        return status;
    double share = modes_share(reduction);
    progress_stage(&reduction->progress, "factor", 0.0, share);
    *shift = BELOW_FIRST * body->omega[0] * body->omega[0];
    status = factor_compute(reduction->factor, *shift, fault);
    progress_stage(&reduction->progress, "flexibility at the sites", share, 1.0 - share);
    return status;
}

enum percuss_status reduction_add_sites(struct options *options, struct reduction *reduction,
                                        struct fault *fault)
{
    double shift = 0.0;
    *reduction =
        (struct reduction){.options = options, .progress = progress_begin(options->progress)};
    progress_stage(&reduction->progress, "reading", 0.0, 0.0);
    enum percuss_status status = read_later_body(reduction, options, fault);
    if (!status)
        status = read_body(reduction, fault);
    double begun = progress_seconds(&reduction->progress);
    if (!status)
        status = factor_again(reduction, &shift, fault);
    reduction->modes_seconds = progress_seconds(&reduction->progress) - begun;
    begun = progress_seconds(&reduction->progress);
    if (!status)
        status = add_sites(reduction, shift, fault);
    reduction->sites_seconds = progress_seconds(&reduction->progress) - begun;
    progress_clear(&reduction->progress);
    reduction->seconds = progress_seconds(&reduction->progress);
    return status;
}

void reduction_free(struct reduction *reduction)
{
    mesh_body_free(reduction->body);
    factor_free(reduction->factor);
    modes_free(&reduction->modes);
    free(reduction->rigid);
    matrices_free(&reduction->matrices);
    surface_free(&reduction->surface);
    solid_mesh_free(&reduction->mesh);
}
