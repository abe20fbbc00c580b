/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "respond/table_cache.h"

#include <stdarg.h>
#include <stdio.h>

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

bool table_cache_create(struct table_cache *cache, const char *folder,
                        const struct table_listener *listener)
{
    size_t count;
    struct fault fault;
    *cache = (struct table_cache){.loaded = table_store_create(),
                                  .made = table_store_create(),
                                  .folder = folder,
                                  .listener = listener ? listener : &NOBODY};
    if (!cache->loaded || !cache->made)
        return false;
    if (!*cache->folder)
        return true;
    if (table_store_load(cache->loaded, cache->folder, cache->listener->left_out, &count, &fault))
        tell(cache, true, "tables: %s", fault.text);
    else
        tell(cache, false, "tables: %zu from %s%s", count, cache->folder,
             table_store_source(cache->loaded)->family
                 ? " and the family for all other metals"
                 : "; no family there: other metals yield by the closed form");
    table_store_lend_family(cache->made, cache->loaded);
    return true;
}

void table_cache_release(struct table_cache *cache)
{
    table_store_free(cache->loaded);
    table_store_free(cache->made);
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
    if (*cache->folder && table_file_save(cache->folder, table, &origin, path, &reason))
        tell(cache, true, "table of %s on %s: kept until the end only: %s", a, b, reason.text);
    return PERCUSS_OK;
}
