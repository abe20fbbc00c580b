/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/deck.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "mesh/grow.h"

bool deck_same(const char *a, const char *b)
{
    return strcasecmp(a, b) == 0;
}

size_t deck_file(struct deck *deck, const char *path)
{
    if (!GROW(deck->files, deck->file_count, deck->file_room))
        return DECK_NONE;
    char *copy = strdup(path);
    if (!copy)
        return DECK_NONE;
    deck->files[deck->file_count] = copy;
    return deck->file_count++;
}

size_t deck_name(struct deck *deck, const char *name)
{
    /* the last ones are the likeliest */
    for (size_t i = deck->name_count; i-- > 0;)
        if (strcmp(deck->names[i], name) == 0)
            return i;
    if (!GROW(deck->names, deck->name_count, deck->name_room))
        return DECK_NONE;
    snprintf(deck->names[deck->name_count], MESH_NAME_SIZE, "%s", name);
    return deck->name_count++;
}

size_t deck_add_scope(struct deck *deck, enum deck_scope_kind kind, const char *name)
{
    if (!GROW(deck->scopes, deck->scope_count, deck->scope_room))
        return DECK_NONE;
    struct deck_scope *scope = &deck->scopes[deck->scope_count];
    *scope = (struct deck_scope){.kind = kind};
    snprintf(scope->name, sizeof scope->name, "%s", name);
    return deck->scope_count++;
}

bool deck_add_node(struct deck *deck, size_t scope, size_t label, const double point[3])
{
    if (!GROW(deck->nodes, deck->node_count, deck->node_room))
        return false;
    struct deck_node *node = &deck->nodes[deck->node_count++];
    node->label = label;
    node->scope = scope;
    memcpy(node->point, point, sizeof node->point);
    return true;
}

bool deck_add_element(struct deck *deck, struct deck_element *element, const size_t *nodes)
{
    element->first = deck->connectivity_count;
    if (!GROW(deck->elements, deck->element_count, deck->element_room))
        return false;
    for (size_t i = 0; i < element->count; i++) {
        if (!GROW(deck->connectivity, deck->connectivity_count, deck->connectivity_room))
            return false;
        deck->connectivity[deck->connectivity_count++] = nodes[i];
    }
    deck->elements[deck->element_count++] = *element;
    return true;
}

size_t deck_find_set(const struct deck *deck, enum deck_set_kind kind, size_t scope,
                     const char *name)
{
    for (size_t i = 0; i < deck->set_count; i++)
        if (deck->sets[i].kind == kind && deck->sets[i].scope == scope &&
            deck_same(deck->sets[i].name, name))
            return i;
    return DECK_NONE;
}

size_t deck_set(struct deck *deck, enum deck_set_kind kind, size_t scope, const char *name)
{
    size_t found = deck_find_set(deck, kind, scope, name);
    if (found != DECK_NONE && strcmp(deck->sets[found].name, name) != 0 &&
        !deck_tell(deck, "the sets %s and %s are one: names are the same in any case",
                   deck->sets[found].name, name))
        return DECK_NONE;
    if (found != DECK_NONE || !GROW(deck->sets, deck->set_count, deck->set_room))
        return found;
    struct deck_set *set = &deck->sets[deck->set_count];
    *set = (struct deck_set){.kind = kind, .scope = scope};
    snprintf(set->name, sizeof set->name, "%s", name);
    return deck->set_count++;
}

bool deck_add_item(struct deck *deck, size_t index, const struct deck_item *item)
{
    struct deck_set *set = &deck->sets[index];
    struct deck_item *last = set->item_count ? &set->items[set->item_count - 1] : NULL;
    if (last && item->kind == DECK_RANGE && last->kind == DECK_RANGE && item->step == 1 &&
        last->step == 1 && item->instance == last->instance && item->first == last->last + 1) {
        last->last = item->last;
        return true;
    }
    if (!GROW(set->items, set->item_count, set->item_room))
        return false;
    set->items[set->item_count++] = *item;
    return true;
}

size_t deck_find_material(const struct deck *deck, const char *name)
{
    for (size_t i = 0; i < deck->material_count; i++)
        if (deck_same(deck->materials[i].name, name))
            return i;
    return DECK_NONE;
}

size_t deck_add_material(struct deck *deck, const char *name, struct deck_place place)
{
    if (!GROW(deck->materials, deck->material_count, deck->material_room))
        return DECK_NONE;
    struct deck_material *material = &deck->materials[deck->material_count];
    *material = (struct deck_material){.place = place};
    snprintf(material->name, sizeof material->name, "%s", name);
    return deck->material_count++;
}

bool deck_add_section(struct deck *deck, const struct deck_section *section)
{
    if (!GROW(deck->sections, deck->section_count, deck->section_room))
        return false;
    deck->sections[deck->section_count++] = *section;
    return true;
}

bool deck_add_point(struct deck *deck, const struct deck_point *point)
{
    if (!GROW(deck->points, deck->point_count, deck->point_room))
        return false;
    deck->points[deck->point_count++] = *point;
    return true;
}

bool deck_add_mass(struct deck *deck, const struct deck_mass *mass)
{
    if (!GROW(deck->masses, deck->mass_count, deck->mass_room))
        return false;
    deck->masses[deck->mass_count++] = *mass;
    return true;
}

/* Appends a remark to a list that has not got it yet. */
static bool add_remark(char (**list)[MESH_REMARK_SIZE], size_t *count, size_t *room,
                       const char *format, va_list args)
{
    char text[MESH_REMARK_SIZE];
    vsnprintf(text, sizeof text, format, args);
    for (char *c = text; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7F)
            *c = '?';
    for (size_t i = 0; i < *count; i++)
        if (strcmp((*list)[i], text) == 0)
            return true;
    if (!GROW(*list, *count, *room))
        return false;
    memcpy((*list)[(*count)++], text, sizeof text);
    return true;
}

bool deck_tell(struct deck *deck, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    bool told = add_remark(&deck->remarks, &deck->remark_count, &deck->remark_room, format, args);
    va_end(args);
    return told;
}

bool deck_material_tell(struct deck *deck, size_t index, const char *format, ...)
{
    struct deck_material *material = &deck->materials[index];
    va_list args;
    va_start(args, format);
    bool told =
        add_remark(&material->told, &material->told_count, &material->told_room, format, args);
    va_end(args);
    return told;
}

enum percuss_status deck_refuse(const struct deck *deck, struct deck_place place,
                                struct fault *fault, const char *format, ...)
{
    char text[sizeof fault->text];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%s:%zu: %s", deck->files[place.file], place.line,
                     text);
}

void deck_free(struct deck *deck)
{
    for (size_t i = 0; i < deck->file_count; i++)
        free(deck->files[i]);
    free(deck->files);
    free(deck->names);
    free(deck->scopes);
    free(deck->nodes);
    free(deck->elements);
    free(deck->connectivity);
    for (size_t i = 0; i < deck->set_count; i++)
        free(deck->sets[i].items);
    free(deck->sets);
    for (size_t i = 0; i < deck->material_count; i++)
        free(deck->materials[i].told);
    free(deck->materials);
    free(deck->sections);
    free(deck->points);
    free(deck->masses);
    free(deck->supports);
    free(deck->remarks);
    memset(deck, 0, sizeof *deck);
}
