/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/deck_support.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "mesh/grow.h"

enum { HELD_WHOLE = 7, DISPLACEMENTS = 3 };

unsigned deck_support_directions(const char *first, const char *last)
{
    /* Abaqus Analysis User's Guide, 34.3.1 */
    static const struct {
        const char *name;
        unsigned directions;
    } NAMED[] = {{"ENCASTRE", 7}, {"PINNED", 7}, {"XSYMM", 1},  {"YSYMM", 2},
                 {"ZSYMM", 4},    {"XASYMM", 6}, {"YASYMM", 5}, {"ZASYMM", 3}};
    if (!first)
        return HELD_WHOLE;
    for (size_t i = 0; i < sizeof NAMED / sizeof *NAMED; i++)
        if (strcasecmp(first, NAMED[i].name) == 0)
            return NAMED[i].directions;
    if (!isdigit((unsigned char)*first))
        return HELD_WHOLE;
    unsigned long from = strtoul(first, NULL, 10);
    unsigned long to = last && *last ? strtoul(last, NULL, 10) : from;
    unsigned held = 0;
    for (unsigned long k = 1; k <= DISPLACEMENTS; k++)
        if (k >= from && k <= to)
            held |= 1U << (k - 1);
    return held;
}

bool deck_support_add(struct deck *deck, const char *set, unsigned directions)
{
    if (directions == 0)
        return true;
    for (size_t i = 0; i < deck->support_count; i++)
        if (deck_same(deck->supports[i].set, set)) {
            deck->supports[i].directions |= directions;
            return true;
        }
    if (!GROW(deck->supports, deck->support_count, deck->support_room))
        return false;
    struct deck_support *support = &deck->supports[deck->support_count++];
    snprintf(support->set, sizeof support->set, "%s", set);
    support->directions = directions;
    return true;
}

bool deck_support_tell(struct deck *deck)
{
    static const char *const DIRECTIONS[HELD_WHOLE] = {"",  "1",       "2",      "1 and 2",
                                                       "3", "1 and 3", "2 and 3"};
    bool told = true;
    for (size_t i = 0; told && i < deck->support_count; i++) {
        const struct deck_support *support = &deck->supports[i];
        if (support->set[0] == '\0')
            told = deck_tell(deck, "*BOUNDARY: single nodes are not held here: name them in a "
                                   "*NSET for --fixed, which holds them whole");
        else if (support->directions == HELD_WHOLE)
            told = deck_tell(deck, "*BOUNDARY: %s is not held here: --fixed %s holds it",
                             support->set, support->set);
        else
            told = deck_tell(deck,
                             "*BOUNDARY: %s is not held here: in direction %s alone it cannot be, "
                             "as --fixed holds all three",
                             support->set, DIRECTIONS[support->directions]);
    }
    return told;
}
