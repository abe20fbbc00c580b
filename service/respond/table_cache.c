/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "respond/table_cache.h"

#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "catalogue/shipped.h"
#include "contact/law_closed_form.h"
#include "store/table_file.h"

static void left_out(const struct fault *fault)
{
    (void)fault;
}

static void told(bool warning, const char *text)
{
    (void)warning, (void)text;
}

static const struct table_listener NOBODY = {left_out, told};

static void __attribute__((format(printf, 3, 4)))
tell(const struct table_cache *cache, bool warning, const char *format, ...)
{
    char text[sizeof(struct fault) + 128];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    cache->listener->told(warning, text);
}

static void add_folder(struct table_folders *folders, const char *folder)
{
    for (size_t i = 0; i < folders->count; i++) {
        char before[PATH_MAX], now[PATH_MAX];
        if (realpath(folders->each[i], before) && realpath(folder, now) && !strcmp(before, now))
            return;
    }
    snprintf(folders->each[folders->count++], SETTINGS_PATH_SIZE, "%s", folder);
}

void table_folders_find(struct table_folders *folders, const struct settings *settings)
{
    char own[SETTINGS_PATH_SIZE];
    folders->count = 0;
    for (size_t i = 0; i < SETTINGS_FOLDERS_MOST && settings->tables[i][0]; i++)
        add_folder(folders, settings->tables[i]);
    if (folders->count == 0 || settings->tables_alone)
        return;
    /* the folders beside them */
    if (folder_own_tables(own, sizeof own) && access(own, F_OK) == 0)
        add_folder(folders, own);
    char *shipped = shipped_find("tables");
    if (shipped)
        add_folder(folders, shipped);
    free(shipped);
}

/* Every family before any table: tables go on by it. */
static void load_all(struct table_cache *cache, const struct table_folders *folders)
{
    struct table_store *store = cache->loaded;
    size_t family = folders->count;
    for (size_t i = 0; i < folders->count; i++)
        if (table_store_load_family(store, folders->each[i], cache->listener->left_out))
            family = i;
    /* then the tables, folder by folder */
    for (size_t i = 0; i < folders->count; i++) {
        size_t count;
        struct fault fault;
        const char *folder = folders->each[i];
        bool none = family == folders->count && i + 1 == folders->count;
        if (table_store_load(store, folder, cache->listener->left_out, &count, &fault))
            tell(cache, true, "tables: %s", fault.text);
        else
            tell(cache, false, "tables: %zu from %s%s", count, folder,
                 i == family ? " and the family for all other metals"
                 : none      ? "; no family there: other metals yield by the closed form"
                             : "");
    }
    if (folders->count == 0)
        tell(cache, false, "tables: none in the settings: metals yield by the closed form");
}

/* The folder for tables that are computed on request: the first one of given settings, if it can be
 * written, or that of the user's own tables. */
static void choose_keep(struct table_cache *cache, const struct settings *settings)
{
    const char *first = settings->tables[0];
    char own[SETTINGS_PATH_SIZE] = "";
    bool may = *first && !settings->tables_alone && folder_own_tables(own, sizeof own);
    bool is_first = !may || (!settings->shipped && (access(first, W_OK) == 0 || errno == ENOENT));
    snprintf(cache->keep, sizeof cache->keep, "%s", is_first ? first : own);
}

/* A path as a word of the shell. */
static char *quote(const char *path)
{
    static const char PLAIN[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "/._-+,:@%";
    if (path[strspn(path, PLAIN)] == '\0')
        return strdup(path);
    char *word = malloc(4 * strlen(path) + 3), *end = word;
    if (!word)
        return NULL;
    *end++ = '\'';
    for (; *path; path++)
        end = *path == '\'' ? stpcpy(end, "'\\''") : (*end = *path, end + 1);
    strcpy(end, "'");
    return word;
}

/* The command that makes tables for the next start: in the folder of the user's own tables where
 * that counts, or the first one of the settings. With whole paths: the reader may be in another
 * folder. */
static void advise(struct table_cache *cache, const struct settings *settings)
{
    const char *first = settings->tables[0];
    char own[SETTINGS_PATH_SIZE] = "";
    bool found = folder_own_tables(own, sizeof own);
    const char *given = settings->shipped ? "" : first;
    const char *to = *given && (settings->tables_alone || !found) ? given : own;
    char *catalogue = realpath(settings->catalogue, NULL), *place = realpath(to, NULL);
    char *found_program = shipped_program("percuss-tables");
    char *program = quote(found_program ? found_program : "percuss-tables");
    char *file = quote(catalogue ? catalogue : settings->catalogue);
    char *folder = quote(place ? place : to);
    free(found_program);
    free(catalogue);
    free(place);
    if (!*to || !*settings->catalogue || !program || !file || !folder ||
        asprintf(&cache->command, "%s --catalogue %s --folder %s", program, file, folder) < 0)
        cache->command = NULL;
    else if (!*first &&
             asprintf(&cache->then, "which the next start uses with `tables: %s` in its settings",
                      folder) < 0)
        cache->then = NULL;
    free(program);
    free(file);
    free(folder);
    table_store_advise(
        cache->loaded,
        &(struct contact_table_remedy){
            cache->command, cache->then ? cache->then : "which counts from the next start on"});
}

bool table_cache_create(struct table_cache *cache, const struct settings *settings,
                        const struct table_listener *listener)
{
    struct table_folders *folders = malloc(sizeof *folders);
    *cache = (struct table_cache){.loaded = table_store_create(),
                                  .made = table_store_create(),
                                  .listener = listener ? listener : &NOBODY};
    if (!folders || !cache->loaded || !cache->made) {
        free(folders);
        return false;
    }
    table_folders_find(folders, settings);
    load_all(cache, folders);
    free(folders);
    choose_keep(cache, settings);
    advise(cache, settings);
    table_store_lend_family(cache->made, cache->loaded);
    return true;
}

void table_cache_release(struct table_cache *cache)
{
    table_store_free(cache->loaded);
    table_store_free(cache->made);
    free(cache->command);
    free(cache->then);
}

const struct contact_curves *table_cache_find(const struct table_cache *cache,
                                              const struct material *a, const struct material *b)
{
    const struct contact_curves *curves = table_store_find(cache->loaded, a, b);
    return curves ? curves : table_store_find(cache->made, a, b);
}

bool table_cache_lacks(const struct table_cache *cache, const struct body_set *set,
                       const percuss_v1_Request *request)
{
    size_t bodies = request->bodies._length;
    if (contact_law_asked(request->options.contact_model)->tables != CONTACT_TABLES_ONLY)
        return false;
    for (size_t i = 0; i < request->contacts._length; i++) {
        const percuss_v1_Contact *contact = &request->contacts._buffer[i];
        if (contact->a >= bodies || contact->b >= bodies)
            continue;
        const struct body *a = body_set_find(set, request->bodies._buffer[contact->a].id);
        const struct body *b = body_set_find(set, request->bodies._buffer[contact->b].id);
        if (a && b && closed_form_softer(&a->material, &b->material) >= 0 &&
            !table_cache_find(cache, &a->material, &b->material))
            return true;
    }
    return false;
}

enum percuss_status table_cache_add(struct table_cache *cache,
                                    const struct indentation_table *table, double seconds,
                                    struct fault *fault)
{
    char path[TABLE_PATH_SIZE];
    struct fault reason;
    struct table_origin origin = {"percussd " PERCUSS_VERSION, seconds};
    const char *a = table->input.materials[0].name, *b = table->input.materials[1].name;
    enum percuss_status status = table_store_add(cache->made, table, fault);
    if (status)
        return status;
    tell(cache, false, "table of %s on %s: computed in %.1f s", a, b, seconds);
    if (*cache->keep && table_file_save(cache->keep, table, &origin, path, &reason))
        tell(cache, true, "table of %s on %s: kept until the end only: %s", a, b, reason.text);
    return PERCUSS_OK;
}
