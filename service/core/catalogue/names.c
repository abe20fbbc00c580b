/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/names.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* C0, DEL, and C1 in UTF-8 (libyaml has checked the encoding). */
static bool has_control(const unsigned char *text, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        bool c1 = text[i] == 0xC2 && i + 1 < length && text[i + 1] < 0xA0;
        if (text[i] < 0x20 || text[i] == 0x7F || c1)
            return true;
    }
    return false;
}

static enum percuss_status check_id(struct reader *reader, const yaml_node_t *key)
{
    if (key->type == YAML_SCALAR_NODE && key->data.scalar.length > 0 &&
        key->data.scalar.length < PERCUSS_ID_SIZE &&
        !has_control(key->data.scalar.value, key->data.scalar.length))
        return PERCUSS_OK;
    return reader_refuse(reader, key,
                         "%s: an id must be a word of 1 to %d bytes without control characters",
                         reader_excerpt(key).text, PERCUSS_ID_SIZE - 1);
}

static int by_text(const void *a, const void *b)
{
    const struct name *x = a, *y = b;
    int order = strcmp(x->text, y->text);
    return order ? order : (x->position > y->position) - (x->position < y->position);
}

static enum percuss_status check_unique(struct reader *reader, const yaml_node_t *mapping,
                                        const struct names *names)
{
    for (size_t i = 1; i < names->count; i++) {
        const struct name *first = &names->sorted[i - 1], *again = &names->sorted[i];
        if (strcmp(first->text, again->text) == 0)
            return reader_refuse(reader, reader_entry(reader, mapping, again->position).key,
                                 "%s: must stand once, but is on line %zu already", again->text,
                                 first->line);
    }
    return PERCUSS_OK;
}

enum percuss_status names_read(struct reader *reader, const yaml_node_t *mapping,
                               struct names *names)
{
    size_t count = reader_count(mapping);
    *names = (struct names){0};
    /* as many as allowed */
    if (count == 0 || count > NAMES_MOST)
        return reader_refuse(reader, mapping, "%zu entries: must be 1 to %d", count, NAMES_MOST);
    names->sorted = malloc(count * sizeof *names->sorted);
    if (!names->sorted)
        return fault_set(reader->fault, PERCUSS_INTERNAL, "%s: out of memory",
                         reader_short_name(reader->name));
    /* every key is an id */
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; !status && i < count; i++) {
        const yaml_node_t *key = reader_entry(reader, mapping, i).key;
        status = check_id(reader, key);
        if (!status)
            names->sorted[names->count++] =
                (struct name){(const char *)key->data.scalar.value, i, key->start_mark.line + 1};
    }
    /* sorted for look-up, which brings equal ones together */
    if (!status) {
        qsort(names->sorted, count, sizeof *names->sorted, by_text);
        status = check_unique(reader, mapping, names);
    }
    if (status)
        names_free(names);
    return status;
}

void names_free(struct names *names)
{
    free(names->sorted);
    *names = (struct names){0};
}

static int text_order(const void *text, const void *name)
{
    return strcmp(text, ((const struct name *)name)->text);
}

size_t names_find(const struct names *names, const char *text)
{
    const struct name *found =
        bsearch(text, names->sorted, names->count, sizeof *names->sorted, text_order);
    return found ? found->position : names->count;
}

struct name_list names_list(const struct names *names)
{
    struct name_list list = {{0}};
    const size_t room = sizeof list.text - 40; /* for the end */
    size_t length = 0;
    for (size_t i = 0; i < names->count; i++) {
        const char *text = names->sorted[i].text;
        if (length + strlen(text) + 2 > room) {
            snprintf(list.text + length, sizeof list.text - length, ", ... (%zu)", names->count);
            break;
        }
        length += (size_t)snprintf(list.text + length, sizeof list.text - length, "%s%s",
                                   i ? ", " : "", text);
    }
    return list;
}
