/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/table_file.h"

#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/atomic_file.h"
#include "store/json_numbers.h"
#include "store/table_key.h"

/* ---- the text of a table ---- */

static const char FORMAT_NAME[] = "percuss contact table 1";

static json_t *material_object(const struct material *material)
{
    json_t *yield = isfinite(material->yield) ? json_real(material->yield) : json_null();
    return json_pack("{s:s, s:f, s:f, s:f, s:o, s:f}", "name", material->name, "young",
                     material->young, "poisson", material->poisson, "density", material->density,
                     "yield", yield, "tangent", material->tangent);
}

static json_t *table_object(const struct indentation_table *table,
                            const struct table_origin *origin)
{
    const struct region_input *input = &table->input;
    /* hashes of inputs and of all numbers */
    char key[TABLE_KEY_SIZE], content[TABLE_KEY_SIZE];
    table_key(input, key);
    table_content_key(table, content);
    /* inputs, errors, effort */
    json_t *inputs =
        json_pack("{s:[o, o], s:f, s:f, s:I}", "materials", material_object(&input->materials[0]),
                  material_object(&input->materials[1]), "radius", input->radius, "indentation",
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
                     FORMAT_NAME, "made_by", origin->program, "key", key, "content", content,
                     "indentation_version", (json_int_t)table->version, "input", inputs, "errors",
                     errors, "effort", effort, "hertz", table->hertz, "loading", loading,
                     "unloading", unloading);
}

char *table_json_write(const struct indentation_table *table, const struct table_origin *origin)
{
    json_t *object = table_object(table, origin);
    char *text =
        object ? json_numbers_text(object, JSON_REAL_PRECISION(17) | JSON_INDENT(1)) : NULL;
    json_decref(object);
    return text;
}

static const json_t *table_member(const json_t *object, const char *section, const char *name)
{
    const json_t *inside = section ? json_object_get(object, section) : object;
    return json_object_get(inside, name);
}

static enum percuss_status table_read_material(const json_t *object, struct material *material,
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

static enum percuss_status table_read_input(const json_t *root, struct region_input *input,
                                            struct fault *fault)
{
    const json_t *materials = table_member(root, "input", "materials");
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; i < 2 && !status; i++)
        status = table_read_material(json_array_get(materials, i), &input->materials[i], fault);
    if (!status)
        status = json_numbers_take(table_member(root, "input", "radius"), "radius", &input->radius,
                                   fault);
    if (!status)
        status = json_numbers_take(table_member(root, "input", "indentation"), "indentation",
                                   &input->indentation, fault);
    if (!status)
        status = json_numbers_take_whole(table_member(root, "input", "resolution"), "resolution",
                                         &input->resolution, fault);
    return status;
}

static enum percuss_status table_read_arrays(const json_t *root, struct indentation_table *table,
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
        status = json_numbers_take_array(table_member(root, list[i].section, list[i].name),
                                         list[i].name, list[i].count, list[i].values, fault);
        if (status)
            return status;
    }
    /* each branch has a fixed number of samples */
    if (samples != table->branches * INDENTATION_SAMPLES)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "recovery: %zu values: must be %zu", samples,
                         table->branches * INDENTATION_SAMPLES);
    return PERCUSS_OK;
}

static enum percuss_status table_read_numbers(const json_t *root, struct indentation_table *table,
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
        status = json_numbers_take(table_member(root, list[i].section, list[i].name), list[i].name,
                                   list[i].value, fault);
    /* the effort of the computation */
    if (!status)
        status = json_numbers_take_whole(table_member(root, "effort", "nodes"), "nodes",
                                         &table->nodes, fault);
    if (!status)
        status = json_numbers_take_whole(table_member(root, "effort", "newton_steps"),
                                         "newton_steps", &table->newton_steps, fault);
    return status;
}

static enum percuss_status read_table(const json_t *root, struct indentation_table *table,
                                      struct fault *fault)
{
    const char *format = json_string_value(json_object_get(root, "format"));
    size_t version;
    char key[TABLE_KEY_SIZE];
    /* format and version */
    if (!format || strcmp(format, FORMAT_NAME) != 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "format: %.60s: must be %s",
                         format ? format : "missing", FORMAT_NAME);
    enum percuss_status status = json_numbers_take_whole(
        json_object_get(root, "indentation_version"), "indentation_version", &version, fault);
    if (status)
        return status;
    if (version != INDENTATION_VERSION)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "indentation_version: %zu: must be %d: compute the table anew", version,
                         INDENTATION_VERSION);
    table->version = INDENTATION_VERSION;
    /* inputs, curves and numbers */
    status = table_read_input(root, &table->input, fault);
    if (!status)
        status = table_read_arrays(root, table, fault);
    if (!status)
        status = table_read_numbers(root, table, fault);
    if (status)
        return status;
    /* a changed file has other hashes */
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

/* ---- folders ---- */

/* Makes a folder and its parents as far as they are missing. False: errno has the reason. */
static bool folder_make(const char *path)
{
    char part[PATH_MAX];
    if (snprintf(part, sizeof part, "%s", path) >= (int)sizeof part) {
        errno = ENAMETOOLONG;
        return false;
    }
    /* each folder above it, then itself */
    for (char *slash = strchr(part + 1, '/'); *part && slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        if (mkdir(part, 0755) != 0 && errno != EEXIST && access(part, F_OK) != 0)
            return false;
        *slash = '/';
    }
    return mkdir(path, 0755) == 0 || errno == EEXIST;
}

/* `rest` in the folder that a variable names, up to the first of `ends`, if it is an absolute path.
 */
static bool find_folder_in(char *path, size_t size, const char *variable, const char *ends,
                           const char *rest)
{
    const char *folder = getenv(variable);
    if (!folder || *folder != '/')
        return false;
    int length = snprintf(path, size, "%.*s%s", (int)strcspn(folder, ends), folder, rest);
    return length > 0 && (size_t)length < size;
}

bool folder_own_tables(char *path, size_t size)
{
    const char *named = getenv("PERCUSS_TABLES");
    char here[PATH_MAX];
    if (!named)
        /* systemd may name several folders */
        return find_folder_in(path, size, "STATE_DIRECTORY", ":", "/tables") ||
               find_folder_in(path, size, "XDG_DATA_HOME", "", "/percuss/tables") ||
               find_folder_in(path, size, "HOME", "", "/.local/share/percuss/tables");
    if (*named == '/' || !*named)
        return find_folder_in(path, size, "PERCUSS_TABLES", "", "");
    /* absolute, as messages name it to readers with another working folder */
    if (!getcwd(here, sizeof here))
        return false;
    int length = snprintf(path, size, "%s/%s", here, named);
    return length > 0 && (size_t)length < size;
}

/* ---- files ---- */

static enum percuss_status table_file_refuse(struct fault *fault, const char *path,
                                             const char *problem)
{
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: %s: %s", path, problem, strerror(errno));
}

/* Writes the text and syncs it, before its file gets the final name. */
static bool write_synced(int file, const char *text)
{
    size_t left = strlen(text);
    while (left > 0) {
        ssize_t done = write(file, text, left);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            return false;
        text += done;
        left -= (size_t)done;
    }
    return fsync(file) == 0;
}

enum percuss_status table_file_write(const char *folder, const char *text, const char *path,
                                     struct fault *fault)
{
    char temporary[TABLE_PATH_SIZE];
    if (!folder_make(folder))
        return table_file_refuse(fault, folder, "cannot be made");
    /* without .json at its end it is not loaded as a table */
    if (snprintf(temporary, sizeof temporary, "%s/.table-XXXXXX", folder) >=
        (int)sizeof temporary) {
        errno = ENAMETOOLONG;
        return table_file_refuse(fault, folder, "cannot be written to");
    }
    int file = mkstemp(temporary);
    if (file < 0)
        return table_file_refuse(fault, folder, "cannot be written to");
    /* rename it once it is whole */
    bool good = write_synced(file, text) && fchmod(file, 0644) == 0;
    good = close(file) == 0 && good;
    if (good && rename(temporary, path) == 0)
        return atomic_file_sync_folder(path, fault);
    enum percuss_status status = table_file_refuse(fault, path, "cannot be written");
    unlink(temporary);
    return status;
}

enum percuss_status table_file_save(const char *folder, const struct indentation_table *table,
                                    const struct table_origin *origin, char path[TABLE_PATH_SIZE],
                                    struct fault *fault)
{
    char key[TABLE_KEY_SIZE];
    table_key(&table->input, key);
    if (snprintf(path, TABLE_PATH_SIZE, "%s/%s.json", folder, key) >= TABLE_PATH_SIZE) {
        errno = ENAMETOOLONG;
        return table_file_refuse(fault, folder, "cannot be used");
    }
    char *text = table_json_write(table, origin);
    if (!text)
        return fault_set(fault, PERCUSS_INTERNAL, "contact table: out of memory");
    enum percuss_status status = table_file_write(folder, text, path, fault);
    free(text);
    return status;
}

enum percuss_status table_file_read(const char *path, char **text, size_t *size,
                                    struct fault *fault)
{
    FILE *file = fopen(path, "rbe");
    struct stat about;
    enum percuss_status status = PERCUSS_OK;
    *text = NULL;
    if (!file || fstat(fileno(file), &about) != 0) {
        status = table_file_refuse(fault, path, "cannot be read");
    } else if (!S_ISREG(about.st_mode) || about.st_size > TABLE_FILE_MAX_BYTES) {
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: must be a file of at most %d bytes",
                           path, TABLE_FILE_MAX_BYTES);
    } else if (!(*text = malloc((size_t)about.st_size + 1))) {
        status = fault_set(fault, PERCUSS_INTERNAL, "%.300s: out of memory", path);
    } else {
        *size = fread(*text, 1, (size_t)about.st_size, file);
    }
    if (file)
        fclose(file);
    return status;
}

enum percuss_status table_file_load(const char *path, struct indentation_table *table,
                                    struct fault *fault)
{
    size_t size = 0;
    *table = (struct indentation_table){0};
    struct fault reason = {""};
    char *text;
    enum percuss_status status = table_file_read(path, &text, &size, fault);
    if (status)
        return status;
    status = table_json_read(text, size, table, &reason);
    free(text);
    if (status)
        fault_set(fault, status, "%.300s: %.300s", path, reason.text);
    return status;
}
