/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/table_json.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "store/json_numbers.h"
#include "store/table_key.h"

static const char format_name[] = "percuss contact table 1";

static json_t *material_of(const struct material *material)
{
    json_t *yield = isfinite(material->yield) ? json_real(material->yield) : json_null();
    return json_pack("{s:s, s:f, s:f, s:f, s:o, s:f}", "name", material->name, "young",
                     material->young, "poisson", material->poisson, "density", material->density,
                     "yield", yield, "tangent", material->tangent);
}

static json_t *object_of(const struct indentation_table *table, const struct table_origin *origin)
{
    const struct region_input *input = &table->input;
    /* hashes of inputs and of all numbers */
    char key[TABLE_KEY_SIZE], content[TABLE_KEY_SIZE];
    table_key(input, key);
    table_content_key(table, content);
    /* inputs, errors, effort */
    json_t *inputs =
        json_pack("{s:[o, o], s:f, s:f, s:I}", "materials", material_of(&input->materials[0]),
                  material_of(&input->materials[1]), "radius", input->radius, "indentation",
                  input->indentation, "resolution", (json_int_t)input->resolution);
    json_t *errors = json_pack("{s:f, s:f, s:f}", "force", table->force_error, "residual",
                               table->residual_error, "recovery", table->recovery_error);
    json_t *effort = json_pack("{s:I, s:I, s:f}", "nodes", (json_int_t)table->nodes, "newton_steps",
                               (json_int_t)table->newton_steps, "seconds", origin->seconds);
    /* curves */
    json_t *loading =
        json_pack("{s:o, s:o, s:o}", "indentation", json_numbers(table->points, table->indentation),
                  "force", json_numbers(table->points, table->force), "radius",
                  json_numbers(table->points, table->radius));
    json_t *unloading =
        json_pack("{s:o, s:o, s:o, s:o}", "largest", json_numbers(table->branches, table->largest),
                  "largest_force", json_numbers(table->branches, table->largest_force), "residual",
                  json_numbers(table->branches, table->residual), "recovery",
                  json_numbers(table->branches * INDENTATION_SAMPLES, table->recovery));
    return json_pack("{s:s, s:s, s:s, s:s, s:I, s:o, s:o, s:o, s:f, s:o, s:o}", "format",
                     format_name, "made_by", origin->program, "key", key, "content", content,
                     "indentation_version", (json_int_t)table->version, "input", inputs, "errors",
                     errors, "effort", effort, "hertz", table->hertz, "loading", loading,
                     "unloading", unloading);
}

char *table_json_write(const struct indentation_table *table, const struct table_origin *origin)
{
    json_t *object = object_of(table, origin);
    char *text =
        object ? json_numbers_text(object, JSON_REAL_PRECISION(17) | JSON_INDENT(1)) : NULL;
    json_decref(object);
    return text;
}

static const json_t *member(const json_t *object, const char *section, const char *name)
{
    const json_t *inside = section ? json_object_get(object, section) : object;
    return json_object_get(inside, name);
}

static enum percuss_status read_material(const json_t *object, struct material *material,
                                         struct fault *fault)
{
    const char *name = json_string_value(json_object_get(object, "name"));
    const json_t *yield = json_object_get(object, "yield");
    snprintf(material->name, sizeof material->name, "%s", name ? name : "");
    const struct {
        const char *name;
        double *value;
    } list[] = {{"young", &material->young},
                {"poisson", &material->poisson},
                {"density", &material->density},
                {"tangent", &material->tangent}};
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; i < sizeof list / sizeof *list && !status; i++)
        status = json_numbers_take(json_object_get(object, list[i].name), list[i].name,
                                   list[i].value, fault);
    /* null: it never yields */
    material->yield = INFINITY;
    if (!status && !json_is_null(yield))
        status = json_numbers_take(yield, "yield", &material->yield, fault);
    return status;
}

static enum percuss_status read_input(const json_t *root, struct region_input *input,
                                      struct fault *fault)
{
    const json_t *materials = member(root, "input", "materials");
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; i < 2 && !status; i++)
        status = read_material(json_array_get(materials, i), &input->materials[i], fault);
    if (!status)
        status =
            json_numbers_take(member(root, "input", "radius"), "radius", &input->radius, fault);
    if (!status)
        status = json_numbers_take(member(root, "input", "indentation"), "indentation",
                                   &input->indentation, fault);
    if (!status)
        status = json_numbers_take_whole(member(root, "input", "resolution"), "resolution",
                                         &input->resolution, fault);
    return status;
}

static enum percuss_status read_arrays(const json_t *root, struct indentation_table *table,
                                       struct fault *fault)
{
    size_t samples = 0;
    enum percuss_status status;
    /* those of a curve have one count */
    const struct {
        const char *section, *name;
        size_t *count;
        double **values;
    } list[] = {
        {"loading", "indentation", &table->points, &table->indentation},
        {"loading", "force", &table->points, &table->force},
        {"loading", "radius", &table->points, &table->radius},
        {"unloading", "largest", &table->branches, &table->largest},
        {"unloading", "largest_force", &table->branches, &table->largest_force},
        {"unloading", "residual", &table->branches, &table->residual},
        {"unloading", "recovery", &samples, &table->recovery},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        status = json_numbers_take_array(member(root, list[i].section, list[i].name), list[i].name,
                                         list[i].count, list[i].values, fault);
        if (status)
            return status;
    }
    /* each branch has a fixed number of samples */
    if (samples != table->branches * INDENTATION_SAMPLES)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "recovery: %zu values: must be %zu", samples,
                         table->branches * INDENTATION_SAMPLES);
    return PERCUSS_OK;
}

static enum percuss_status read_numbers(const json_t *root, struct indentation_table *table,
                                        struct fault *fault)
{
    const struct {
        const char *section, *name;
        double *value;
    } list[] = {{NULL, "hertz", &table->hertz},
                {"errors", "force", &table->force_error},
                {"errors", "residual", &table->residual_error},
                {"errors", "recovery", &table->recovery_error}};
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; i < sizeof list / sizeof *list && !status; i++)
        status = json_numbers_take(member(root, list[i].section, list[i].name), list[i].name,
                                   list[i].value, fault);
    /* how large the computation was */
    if (!status)
        status =
            json_numbers_take_whole(member(root, "effort", "nodes"), "nodes", &table->nodes, fault);
    if (!status)
        status = json_numbers_take_whole(member(root, "effort", "newton_steps"), "newton_steps",
                                         &table->newton_steps, fault);
    return status;
}

static enum percuss_status read_table(const json_t *root, struct indentation_table *table,
                                      struct fault *fault)
{
    const char *format = json_string_value(json_object_get(root, "format"));
    size_t version;
    char key[TABLE_KEY_SIZE];
    /* a file of this kind and version */
    if (!format || strcmp(format, format_name) != 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "format: %.60s: must be %s",
                         format ? format : "missing", format_name);
    enum percuss_status status = json_numbers_take_whole(
        json_object_get(root, "indentation_version"), "indentation_version", &version, fault);
    if (status)
        return status;
    if (version != INDENTATION_VERSION)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "indentation_version: %zu: must be %d: compute the table anew", version,
                         INDENTATION_VERSION);
    table->version = INDENTATION_VERSION;
    /* what it holds */
    status = read_input(root, &table->input, fault);
    if (!status)
        status = read_arrays(root, table, fault);
    if (!status)
        status = read_numbers(root, table, fault);
    if (status)
        return status;
    /* hashes tell a file that was changed */
    table_key(&table->input, key);
    status = json_numbers_check_hash(root, "key", key, fault);
    table_content_key(table, key);
    return status ? status : json_numbers_check_hash(root, "content", key, fault);
}

enum percuss_status table_json_read(const char *text, size_t size, struct indentation_table *table,
                                    struct fault *fault)
{
    json_t *root;
    *table = (struct indentation_table){0};
    enum percuss_status status = json_numbers_parse(text, size, &root, fault);
    if (status)
        return status;
    status = read_table(root, table, fault);
    json_decref(root);
    if (status)
        indentation_table_free(table);
    return status;
}
