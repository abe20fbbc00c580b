/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "layout.h"

#include <stdio.h>
#include <string.h>

void layout_free(struct layout *layout)
{
    cells_free(&layout->titles);
}

struct layout_place layout_place(const struct layout *layout, size_t kind)
{
    struct layout_place place = {""};
    int column = layout->place[kind];
    const char *title = column >= 0 ? layout->titles.list[column] : "";
    if (column >= 0 && layout->line > 0 && strcmp(title, layout->source->kinds[kind].name) != 0)
        snprintf(place.text, sizeof place.text, "(column %d, '%.*s')", column + 1, HEADING_SIZE,
                 title);
    else if (column >= 0)
        snprintf(place.text, sizeof place.text, "(column %d)", column + 1);
    return place;
}

static bool is_read(const struct layout *layout, size_t column)
{
    for (size_t k = 0; k < layout->source->kind_count; k++)
        if (layout->place[k] == (int)column)
            return true;
    return false;
}

size_t layout_list(const struct layout *layout, bool all, char *text, size_t size)
{
    enum { LISTED = 8, LONGEST = 24 };
    size_t count = 0, length = 0;
    *text = '\0';
    for (size_t i = 0; i < layout->titles.all; i++) {
        if (!*layout->titles.list[i] || (!all && is_read(layout, i)))
            continue;
        if (count++ < LISTED && length < size)
            length += (size_t)snprintf(text + length, size - length, "%s'%.*s'",
                                       count > 1 ? ", " : "", LONGEST, layout->titles.list[i]);
    }
    if (count > LISTED && length < size)
        snprintf(text + length, size - length, " and %zu more", count - LISTED);
    return count;
}
