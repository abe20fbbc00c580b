/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/inp_material.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "mesh/inp_keywords.h"

static struct deck_material *present(const struct inp_material *material)
{
    return &material->deck->materials[material->at];
}

/* PERCUSS_OK, if what was to be told is told */
static enum percuss_status told(const struct scan *scan, bool fine)
{
    return fine ? PERCUSS_OK
                : fault_set(scan->fault, PERCUSS_INTERNAL, "%s: out of memory", scan->file);
}

/* ---- keywords ---- */

/* Tells of what a table has besides temperatures. */
static enum percuss_status tell_fields(const struct inp_material *material, const struct scan *scan,
                                       const struct card *card)
{
    const char *fields = card_value(card, "DEPENDENCIES");
    if (!fields || strcmp(fields, "0") == 0)
        return PERCUSS_OK;
    return told(scan, deck_material_tell(material->deck, material->at,
                                         "*MATERIAL, NAME=%s: *%.20s is a table over %.20s field "
                                         "variables: its first rows are taken",
                                         present(material)->name, card->name, fields));
}

/* Why a property's rows are not the solid's; NULL: they are. */
static const char *other_meaning(const struct card *card)
{
    const char *hardening = card_value(card, "HARDENING"), *data = card_value(card, "DATATYPE");
    if (card_value(card, "POREFLUID"))
        return "*DENSITY is of the fluid in the pores: left out";
    if ((hardening &&
         (strncasecmp(hardening, "JOHNSON", 7) == 0 || strncasecmp(hardening, "USER", 4) == 0)) ||
        (data && strncasecmp(data, "PARAMETERS", 10) == 0))
        return "*PLASTIC is no table of stresses: left out, the body does not yield by it";
    return NULL;
}

static bool tell_plastic(const struct inp_material *material, const struct card *card)
{
    const char *scale = card_value(card, "SCALESTRESS");
    return !scale || deck_material_tell(material->deck, material->at,
                                        "*MATERIAL, NAME=%s: *PLASTIC: SCALESTRESS=%.20s is left "
                                        "out: its stresses are taken as they stand there",
                                        present(material)->name, scale);
}

enum percuss_status inp_material_property(struct inp_material *material, const struct scan *scan,
                                          const struct card *card, bool *rows)
{
    const char *type = card_value(card, "TYPE");
    *rows = false;
    if (material->at == DECK_NONE)
        return scan_refuse(scan, "*%.20s: must come after a *MATERIAL", card->name);
    struct deck_material *to = present(material);
    const char *other = other_meaning(card);
    if (other)
        return told(scan, deck_material_tell(material->deck, material->at, "*MATERIAL, NAME=%s: %s",
                                             to->name, other));
    material->property = card->name[0] == 'E'   ? DECK_ELASTIC
                         : card->name[0] == 'D' ? DECK_DENSITY
                                                : DECK_PLASTIC;
    size_t *stated = &to->stated[material->property];
    if (*stated && material->property == DECK_PLASTIC && card_value(card, "RATE"))
        return told(scan,
                    deck_material_tell(material->deck, material->at,
                                       "*MATERIAL, NAME=%s: *PLASTIC at further rates is left out",
                                       to->name));
    if (*stated && !to->refused[0])
        snprintf(to->refused, sizeof to->refused,
                 "%.90s:%zu: *%.20s: is in line %zu before: must be in a material once", scan->file,
                 scan->line, card->name, *stated);
    else if (material->property == DECK_ELASTIC && type && strncasecmp(type, "ISO", 3) != 0)
        snprintf(to->refused, sizeof to->refused,
                 "%.90s:%zu: *ELASTIC: TYPE=%.40s: must be ISOTROPIC", scan->file, scan->line,
                 type);
    else
        *rows = !*stated;
    *stated = scan->line;
    material->row = material->taken = 0;
    return tell_plastic(material, card) ? tell_fields(material, scan, card) : told(scan, false);
}

enum percuss_status inp_material_law(struct inp_material *material, const struct scan *scan,
                                     const struct card *card)
{
    if (material->at == DECK_NONE)
        return PERCUSS_OK;
    struct deck_material *to = present(material);
    if (keyword_replaces_elastic(card->name) && !to->refused[0]) {
        snprintf(to->refused, sizeof to->refused,
                 "%.90s:%zu: *%.30s: is not read: must be *ELASTIC", scan->file, scan->line,
                 card->name);
        return PERCUSS_OK;
    }
    return told(scan, deck_material_tell(material->deck, material->at,
                                         "*MATERIAL, NAME=%s: *%.30s is left out: the body is "
                                         "elastic (and yields by *PLASTIC)",
                                         to->name, card->name));
}

/* ---- rows ---- */

/* How many values a row has, and how many rows are taken: of a table over the temperature those at
 * its first one. */
static const struct {
    const char *name;
    int values, most;
} TABLES[DECK_PROPERTIES] = {[DECK_ELASTIC] = {"*ELASTIC", 2, 1},
                             [DECK_DENSITY] = {"*DENSITY", 1, 1},
                             [DECK_PLASTIC] = {"*PLASTIC", 2, 2}};

/* Whether to take this row; tells of the others. `line`: behind the row's values. */
static enum percuss_status choose_row(struct inp_material *material, const struct scan *scan,
                                      char *line, bool *taken)
{
    const char *name = TABLES[material->property].name;
    int most = TABLES[material->property].most;
    char *field = card_field(&line), *end;
    double temperature = field && *field ? strtod(field, &end) : 0.0;
    bool fine = true;
    if (material->row++ == 0)
        material->temperature = temperature;
    *taken = temperature == material->temperature && material->taken < most;
    material->taken += *taken;
    if (temperature != material->temperature)
        fine = deck_material_tell(material->deck, material->at,
                                  "*MATERIAL, NAME=%s: %s is a table over the temperature: its "
                                  "rows at %g are taken",
                                  present(material)->name, name, material->temperature);
    else if (!*taken)
        fine = deck_material_tell(material->deck, material->at,
                                  "*MATERIAL, NAME=%s: %s: of its rows the first %d are taken",
                                  present(material)->name, name, most);
    return told(scan, fine);
}

/* The values of a row; keeps the message of what are none. */
static bool read_values(struct inp_material *material, struct scan *scan, char **line,
                        double *values)
{
    struct deck_material *to = present(material);
    struct fault inner = {""}, *fault = scan->fault;
    bool good = true;
    scan->fault = &inner;
    for (int i = 0; i < TABLES[material->property].values && good; i++)
        good = card_real(scan, TABLES[material->property].name, card_field(line), &values[i]);
    scan->fault = fault;
    if (!good && !to->refused[0])
        snprintf(to->refused, sizeof to->refused, "%.*s", (int)sizeof to->refused - 1, inner.text);
    return good;
}

enum percuss_status inp_material_row(struct inp_material *material, struct scan *scan, char *line)
{
    struct deck_material *to = present(material);
    double values[2] = {0.0, 0.0};
    bool taken;
    if (!read_values(material, scan, &line, values))
        return PERCUSS_OK;
    enum percuss_status status = choose_row(material, scan, line, &taken);
    if (status || !taken)
        return status;
    switch (material->property) {
    case DECK_ELASTIC:
        to->young = values[0];
        to->poisson = values[1];
        to->elastic = true;
        break;
    case DECK_DENSITY:
        to->density = values[0];
        to->dense = true;
        break;
    default:
        to->stress[to->stress_count] = values[0];
        to->strain[to->stress_count++] = values[1];
    }
    return PERCUSS_OK;
}
