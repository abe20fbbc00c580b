/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Scenes as files. Every number has 17 digits, which read back as the same bits. */
#include <string.h>

#include "any_scene.h"
#include "percuss/vocabulary.h"

static const char *support_name(const struct body *body, int end)
{
    static const char *const names[] = {"free", "pinned", "clamped"};
    if (body->kind == &rod_kind && body->supports[end] == SUPPORT_CLAMPED)
        return "fixed";
    return names[body->supports[end]];
}

static void write_material(FILE *file, const struct body *body)
{
    const struct material *material = &body->material;
    fprintf(file, "  of-%s: {young: %.17g, poisson: %.17g, density: %.17g", body->id,
            material->young, material->poisson, material->density);
    if (isfinite(material->yield))
        fprintf(file, ", yield: %.17g, tangent: %.17g", material->yield, material->tangent);
    fprintf(file, "}\n");
}

static void write_bar(FILE *file, const struct body *body)
{
    fprintf(file, ", length: %.17g, damping: %.17g, ends: [%s, %s]", body->length, body->damping,
            support_name(body, 0), support_name(body, 1));
    if (body->modes)
        fprintf(file, ", modes: %u", body->modes);
    if (body->kind == &rod_kind && isfinite(body->tip_radius))
        fprintf(file, ", tip_radius: %.17g", body->tip_radius);
    if (body->kind == &rod_kind && body->lateral_inertia)
        fprintf(file, ", lateral_inertia: true");
    if (body->kind == &beam_kind)
        fprintf(file, ", theory: %s",
                body->theory == THEORY_TIMOSHENKO ? "timoshenko" : "euler-bernoulli");
    if (body->kind == &beam_kind && body->shear_rule != SHEAR_ABSENT)
        fprintf(file, ", shear_factor: %s",
                body->shear_rule == SHEAR_COWPER ? "cowper" : "hutchinson");
}

/* A broad beam, which is a block to the solver. */
static bool is_strip(const struct body *body)
{
    return body->kind != &beam_kind && strcmp(body->kind->name, beam_kind.name) == 0;
}

static void write_body(FILE *file, const struct body *body)
{
    fprintf(file, "  %s: {shape: %s, material: of-%s", body->id, body->kind->name, body->id);
    if (body->kind == &block_kind)
        fprintf(file, ", size: [%.17g, %.17g, %.17g]", body->size[0], body->size[1], body->size[2]);
    else if (body->width > 0.0)
        fprintf(file, ", section: {width: %.17g, height: %.17g}", body->width, body->height);
    else if (body->kind != &half_space_kind)
        fprintf(file, ", radius: %.17g", body->radius);
    if (body->kind == &cylinder_kind)
        fprintf(file, ", length: %.17g", body->length);
    if (body_is_flexible(body) || is_strip(body))
        write_bar(file, body);
    fprintf(file, "}\n");
}

static void write_catalogue(FILE *file, const struct lab *lab)
{
    fprintf(file, "materials:\n");
    for (size_t b = 0; b < lab->set.count; b++)
        write_material(file, &lab->bodies[b]);
    fprintf(file, "bodies:\n");
    for (size_t b = 0; b < lab->set.count; b++)
        write_body(file, &lab->bodies[b]);
    fprintf(file, "contact: {compliance: half-space}\n");
}

static void write_numbers(FILE *file, const char *name, size_t count, const double *numbers)
{
    fprintf(file, ", \"%s\": [", name);
    for (size_t i = 0; i < count; i++)
        fprintf(file, "%s%.17g", i ? ", " : "", numbers[i]);
    fprintf(file, "]");
}

static void write_request(FILE *file, const struct solve_request *request)
{
    fprintf(file, "{\"bodies\": [");
    for (size_t b = 0; b < request->body_count; b++) {
        const struct solve_body *body = &request->bodies[b];
        fprintf(file, "%s{\"id\": \"%s\"", b ? ",\n  " : "", body->id);
        write_numbers(file, "position", 3, body->position);
        write_numbers(file, "orientation", 4, body->orientation);
        write_numbers(file, "velocity", 3, body->velocity);
        write_numbers(file, "angular_velocity", 3, body->angular_velocity);
        if (body->elapsed > 0.0)
            fprintf(file, ", \"state\": \"\", \"elapsed\": %.17g", body->elapsed);
        fprintf(file, "}");
    }
    fprintf(file, "],\n \"contacts\": [");
    for (size_t c = 0; c < request->contact_count; c++) {
        const struct solve_contact *contact = &request->contacts[c];
        fprintf(file, "%s{\"a\": %u, \"b\": %u", c ? ",\n  " : "", contact->a, contact->b);
        write_numbers(file, "point", 3, contact->point);
        write_numbers(file, "normal", 3, contact->normal);
        fprintf(file, ", \"gap\": %.17g, \"gap_acceleration\": %.17g", contact->gap,
                contact->gap_acceleration);
        /* builds before there was friction read the others */
        if (contact->friction > 0.0) {
            fprintf(file, ", \"friction\": %.17g", contact->friction);
            write_numbers(file, "tangent", 3, contact->tangent);
        }
        fprintf(file, "}");
    }
    const struct solve_options *options = &request->options;
    fprintf(
        file,
        "],\n \"options\": {\"tolerance\": %.17g, \"horizon\": %.17g, \"contact_model\": \"%s\","
        " \"compliance\": \"%s\", \"dents\": \"%s\", \"conditioning\": %s, \"trace\": %s",
        options->tolerance, options->horizon, contact_model_name(options->contact_model),
        compliance_name(options->compliance),
        options->dents == PERCUSS_DENTS_KEEP ? "keep" : "ignore",
        options->conditioning ? "true" : "false", options->trace ? "true" : "false");
    if (options->friction != PERCUSS_FRICTION_MICRO_SLIP)
        fprintf(file, ", \"friction\": \"%s\"", friction_name(options->friction));
    fprintf(file, "}}\n");
}

bool any_scene_save(const struct lab *lab, const struct any_scene *scene, const char *prefix)
{
    char path[4096];
    bool written = true;
    for (size_t i = 0; i <= scene->blows && written; i++) {
        if (i)
            snprintf(path, sizeof path, "%s-%zu.json", prefix, i);
        else
            snprintf(path, sizeof path, "%s.yaml", prefix);
        FILE *file = fopen(path, "w");
        if (!file)
            return false;
        struct solve_request request = any_scene_request(scene, i ? i - 1 : 0);
        if (i)
            write_request(file, &request);
        else
            write_catalogue(file, lab);
        written = !ferror(file);
        written = fclose(file) == 0 && written;
    }
    return written;
}
