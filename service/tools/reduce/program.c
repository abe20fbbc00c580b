/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/program.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "reduce/options.h"
#include "reduce/reduction.h"

/* ---- the report on standard output ---- */

enum { SHOWN_FREQUENCIES = 10 };

/* Periods of the last frequency that a contact must last for its restitution to be good to 5e-4,
 * and to 1 %, on a rod. */
static const double PERIODS[2] = {3.0, 2.0};

static double hertz(double omega)
{
    return omega / (2.0 * M_PI);
}

/* How much more the elements hold than the surface encloses, of the volume. */
static double volume_gap(const struct reduction *reduction)
{
    return reduction->bulk.volume / reduction->enclosed - 1.0;
}

static void tell_mass(const struct reduction *reduction)
{
    const struct bulk *bulk = &reduction->bulk;
    const double *j = bulk->inertia;
    if (bulk->nodes_mass > 0.0)
        printf("on nodes        %zu rigid mass%s, %.6g kg\n", reduction->mesh.mass_count,
               reduction->mesh.mass_count == 1 ? "" : "es", bulk->nodes_mass);
    printf("mass            %.6g kg\n", bulk->mass);
    printf("centre          %.6g %.6g %.6g m\n", bulk->centre[0], bulk->centre[1], bulk->centre[2]);
    printf("inertia         xx %.6g yy %.6g zz %.6g xy %.6g yz %.6g zx %.6g kg m^2\n", j[0], j[4],
           j[8], j[1], j[5], j[2]);
    printf("volume          %.6g m^3; the surface encloses the same within %.1e of it\n",
           bulk->volume, fabs(volume_gap(reduction)));
    if (reduction->surface.straight)
        printf("                %zu of %zu edges on curved ground are straight: the volume is that "
               "of the facets\n",
               reduction->surface.straight, reduction->surface.edges);
    printf("smallest det J  %.3g of its element's mean, element %zu\n", bulk->smallest_det,
           reduction->mesh.element_labels[bulk->smallest_at]);
}

/* A line of each part: what it is made of, and how much of it there is. */
static void tell_parts(const struct solid_mesh *mesh)
{
    for (size_t i = 0; i < mesh->part_count; i++) {
        const struct material *material = &mesh->part[i].material;
        struct bulk bulk;
        bulk_of_part(mesh, i, &bulk);
        printf("part            \"%s\" of %s (%.4g GPa, %.4g, %.4g kg/m^3", mesh->part[i].name,
               material->name, 1e-9 * material->young, material->poisson, material->density);
        if (isfinite(material->yield))
            printf(", yields at %.4g MPa", 1e-6 * material->yield);
        printf("): %zu element%s, %.6g m^3, %.6g kg\n", bulk.element_count,
               bulk.element_count == 1 ? "" : "s", bulk.volume, bulk.mass);
    }
}

/* The shortest contacts that modes and mesh serve to 5e-4, and to 1 %, s. */
static double shortest_contact(const struct reduction *reduction, int which)
{
    const struct modes *modes = &reduction->modes;
    return PERIODS[which] / fmin(hertz(modes->omega[modes->count - 1]), reduction->good_to);
}

static void tell_modes(const struct reduction *reduction)
{
    const struct modes *modes = &reduction->modes;
    printf("modes           %zu; by inertia %zu lie below %.6g Hz; largest |x'Mx - I| %.1e\n",
           modes->count, modes->confirmed, hertz(modes->confirmed_below), modes->doubt);
    if (reduction->options->modes && modes->count != reduction->options->modes)
        printf(
            "                %zu were asked for, the last of which has the frequency of the next: "
            "copies stay together\n",
            reduction->options->modes);
    printf("frequencies    ");
    for (size_t i = 0; i < modes->count && i < SHOWN_FREQUENCIES; i++)
        printf(" %.6g", hertz(modes->omega[i]));
    if (modes->count > SHOWN_FREQUENCIES)
        printf(" ... %.6g", hertz(modes->omega[modes->count - 1]));
    printf(" Hz\n");
    printf("mesh            good to %.4g Hz: eight elements, %.3g mm, to a shear wave%s\n",
           reduction->good_to, 1e3 * reduction->surface.size,
           hertz(modes->omega[modes->count - 1]) > 1.001 * reduction->good_to
               ? "; modes above are the mesh's"
               : "");
    printf(
        "serves          contacts of %.3g us and longer to 5e-4 of the restitution, of %.3g us to "
        "1 %%\n",
        1e6 * shortest_contact(reduction, 0), 1e6 * shortest_contact(reduction, 1));
}

static void tell_flexibility(const struct reduction *reduction)
{
    const struct sites_report *sites = &reduction->sites;
    printf("flexibility     %zu sites %.3g mm apart, without %zu modes; error of interpolation "
           "%.1e m/N, "
           "at most %.1e; forces balance to %.1e\n",
           sites->count, 1e3 * sites->spacing, sites->removed, sites->usual_error,
           sites->largest_error, sites->imbalance);
    if (sites->unknown)
        printf("                unknown at %zu of them%s\n", sites->unknown,
               sites->thin ? ": walls too thin for the mesh" : "");
    if (sites->withdrawn)
        printf("                unknown on %zu of %zu faces: a hit there is refused\n",
               sites->withdrawn, reduction->body->face_count);
    if (isfinite(sites->thinnest))
        printf("walls           as thin as %.3g mm: elements of %.3g mm there make flexibility "
               "good to "
               "2 %%\n",
               1e3 * sites->thinnest, 1.5e3 * sites->thinnest);
}

/* A line of each site that was solved for by itself. */
static void tell_alone(const struct reduction *reduction)
{
    for (size_t i = 0; i < reduction->options->site_count; i++) {
        const struct site_alone *alone = &reduction->alone[i];
        if (alone->unknown)
            fprintf(stderr,
                    "percuss-reduce: warning: --site: %s: its flexibility is not known: %s\n",
                    reduction->options->site_texts[i], alone->unknown);
        else
            printf("site            %s: %.6g m/N without %zu modes, solved %.3g mm beside it\n",
                   reduction->options->site_texts[i], alone->site.flexibility,
                   reduction->body->removed, 1e3 * alone->aside);
    }
}

static void report_added(const struct reduction *reduction)
{
    const struct options *options = reduction->options;
    tell_alone(reduction);
    printf("%s: %zu site%s added, %zu in all, %.1f s (%.1f s the factor, %.1f s the sites)\n",
           options->add_to, reduction->added, reduction->added == 1 ? "" : "s",
           reduction->body->added_count, reduction->seconds, reduction->modes_seconds,
           reduction->sites_seconds);
}

static void report_text(const struct reduction *reduction)
{
    const struct options *options = reduction->options;
    printf("%s: %zu nodes, %zu elements, %zu part%s; %.4g x %.4g x %.4g mm\n", options->file,
           reduction->mesh.node_count, reduction->mesh.element_count, reduction->mesh.part_count,
           reduction->mesh.part_count == 1 ? "" : "s", 1e3 * reduction->findings.extent[0],
           1e3 * reduction->findings.extent[1], 1e3 * reduction->findings.extent[2]);
    tell_parts(&reduction->mesh);
    tell_mass(reduction);
    if (reduction->supports[0])
        printf("held            %s; %zu motion%s as a whole left\n", reduction->supports,
               reduction->task.rigid.count, reduction->task.rigid.count == 1 ? "" : "s");
    tell_modes(reduction);
    if (options->later)
        tell_alone(reduction);
    else
        tell_flexibility(reduction);
    printf("%s: %.12s, %.1f s\n", options->body, reduction->body->hash, reduction->seconds);
}

/* A further member of an object behind what separates it: null where there is no number. */
static void put_member(const char *between, const char *name, double value)
{
    if (isfinite(value))
        printf("%s\"%s\": %.17g", between, name, value);
    else
        printf("%s\"%s\": null", between, name);
}

static void put_number(const char *name, double value)
{
    put_member(",\n  ", name, value);
}

static void put_count(const char *name, size_t value)
{
    printf(",\n  \"%s\": %zu", name, value);
}

static void put_text(const char *name, const char *text)
{
    printf("%s\"", name);
    for (; *text; text++)
        if (*text == '"' || *text == '\\')
            printf("\\%c", *text);
        else if ((unsigned char)*text < 0x20)
            printf("\\u%04x", *text);
        else
            putchar(*text);
    putchar('"');
}

static void put_list(const char *name, size_t count, const double *values, double factor)
{
    printf(",\n  \"%s\": [", name);
    for (size_t i = 0; i < count; i++)
        printf("%s%.17g", i ? ", " : "", factor * values[i]);
    putchar(']');
}

/* a line of each */
static void put_parts(const struct solid_mesh *mesh)
{
    printf(",\n  \"part_list\": [");
    for (size_t i = 0; i < mesh->part_count; i++) {
        const struct material *material = &mesh->part[i].material;
        struct bulk bulk;
        bulk_of_part(mesh, i, &bulk);
        put_text(i ? ",\n    {\"name\": " : "\n    {\"name\": ", mesh->part[i].name);
        put_text(", \"material\": ", material->name);
        put_member(", ", "young", material->young);
        put_member(", ", "poisson", material->poisson);
        put_member(", ", "density", material->density);
        put_member(", ", "yield", material->yield);
        printf(", \"elements\": %zu", bulk.element_count);
        put_member(", ", "volume", bulk.volume);
        put_member(", ", "mass", bulk.mass);
        putchar('}');
    }
    putchar(']');
}

/* of the mesh's reader and of its checks */
static void put_warnings(const struct reduction *reduction)
{
    const struct solid_mesh *mesh = &reduction->mesh;
    printf(",\n  \"warnings\": [");
    for (size_t i = 0; i < mesh->remark_count; i++)
        put_text(i ? ", " : "", mesh->remarks[i]);
    for (size_t i = 0; i < reduction->findings.remark_count; i++)
        put_text(i || mesh->remark_count ? ", " : "", reduction->findings.remarks[i]);
    putchar(']');
}

/* a line of each */
static void put_alone(const struct reduction *reduction)
{
    printf(",\n  \"site_list\": [");
    for (size_t i = 0; i < reduction->options->site_count; i++) {
        const struct site_alone *alone = &reduction->alone[i];
        put_text(i ? ",\n    {\"site\": " : "\n    {\"site\": ", reduction->options->site_texts[i]);
        put_member(", ", "flexibility", alone->site.flexibility);
        put_member(", ", "aside", alone->aside);
        put_text(", \"unknown\": ", alone->unknown ? alone->unknown : "");
        putchar('}');
    }
    putchar(']');
}

static void report_added_json(const struct reduction *reduction)
{
    put_text("{\n  \"file\": ", reduction->options->file);
    put_text(",\n  \"body\": ", reduction->options->add_to);
    put_text(",\n  \"hash\": ", reduction->body->hash);
    put_count("sites_added", reduction->added);
    put_count("sites", reduction->body->added_count);
    put_count("modes_removed", reduction->body->removed);
    put_alone(reduction);
    put_number("seconds", reduction->seconds);
    put_number("seconds_factor", reduction->modes_seconds);
    put_number("seconds_sites", reduction->sites_seconds);
    printf("\n}\n");
}

/* One JSON object, numbers with 17 digits. */
static void report_json(const struct reduction *reduction)
{
    const struct modes *modes = &reduction->modes;
    const struct bulk *bulk = &reduction->bulk;
    const struct sites_report *sites = &reduction->sites;
    put_text("{\n  \"file\": ", reduction->options->file);
    put_text(",\n  \"body\": ", reduction->options->body);
    put_text(",\n  \"hash\": ", reduction->body->hash);
    /* the mesh */
    put_count("nodes", reduction->mesh.node_count);
    put_count("elements", reduction->mesh.element_count);
    put_count("parts", reduction->mesh.part_count);
    put_parts(&reduction->mesh);
    put_list("extent", 3, reduction->findings.extent, 1.0);
    put_number("mass", bulk->mass);
    put_number("mass_on_nodes", bulk->nodes_mass);
    put_number("volume", bulk->volume);
    put_number("volume_error", volume_gap(reduction));
    put_count("straight_edges", reduction->surface.straight);
    put_list("centre", 3, bulk->centre, 1.0);
    put_list("inertia", 9, bulk->inertia, 1.0);
    put_number("smallest_det", bulk->smallest_det);
    put_count("smallest_det_element", reduction->mesh.element_labels[bulk->smallest_at]);
    put_number("element_size", reduction->surface.size);
    put_number("good_to", reduction->good_to);
    /* its vibration */
    put_text(",\n  \"held\": ", reduction->supports);
    put_count("rigid_motions", reduction->task.rigid.count);
    put_count("modes", modes->count);
    put_count("confirmed", modes->confirmed);
    put_number("confirmed_below", hertz(modes->confirmed_below));
    put_number("orthonormality_error", modes->doubt);
    put_list("frequencies", modes->count, modes->omega, hertz(1.0));
    put_number("shortest_contact", shortest_contact(reduction, 0));
    put_number("shortest_contact_one_percent", shortest_contact(reduction, 1));
    /* its surface */
    put_count("sites", sites->count);
    put_count("sites_unknown", sites->unknown);
    put_count("sites_on_thin_walls", sites->thin);
    put_number("thinnest_wall", sites->thinnest);
    put_count("faces_unknown", sites->withdrawn);
    put_number("site_spacing", sites->spacing);
    put_count("modes_removed", sites->removed);
    put_number("flexibility_error", sites->usual_error);
    put_number("flexibility_largest_error", sites->largest_error);
    put_number("force_imbalance", sites->imbalance);
    put_number("response_asymmetry", sites->asymmetry);
    if (reduction->options->later)
        put_alone(reduction);
    put_warnings(reduction);
    put_number("memory", reduction->cost.memory);
    put_number("seconds", reduction->seconds);
    put_number("seconds_modes", reduction->modes_seconds);
    put_number("seconds_sites", reduction->sites_seconds);
    put_number("seconds_expected", reduction->cost.seconds + reduction->statics);
    put_number("seconds_site_field", reduction->sample.seconds);
    printf("\n}\n");
}

int program_run(int argc, char **argv)
{
    struct options options = options_read(argc, argv);
    struct reduction reduction;
    struct fault fault = {""};
    enum percuss_status status = options.add_to ? reduction_add_sites(&options, &reduction, &fault)
                                                : reduction_run(&options, &reduction, &fault);
    if (!status && options.add_to)
        (options.json ? report_added_json : report_added)(&reduction);
    else if (!status)
        (options.json ? report_json : report_text)(&reduction);
    reduction_free(&reduction);
    if (!status)
        return EXIT_SUCCESS;
    fprintf(stderr, "percuss-reduce: %s\n", fault.text);
    return EXIT_FAILURE;
}
