/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Prints the JSON Schema of a catalogue or of settings, from the tables that check them, for
 * editors that know YAML. reference.sh puts it beside the shipped files. What the tables leave to a
 * caller is here: which lists and mappings hold which others. usage: print_schema
 * catalogue|settings */
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "catalogue/keys.h"
#include "model/body_kind.h"
#include "respond/settings.h"

#define NUMBER "([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?"
#define POWER  "(\\^?-?[0-9]|\xC2\xB2|\xC2\xB3)"

enum { PATTERN_SIZE = 2000 };

/* A pattern that grows; too long a one ends the program. */
struct pattern {
    char text[PATTERN_SIZE];
};

static void add(struct pattern *pattern, const char *text)
{
    if (strlen(pattern->text) + strlen(text) >= sizeof pattern->text)
        abort();
    strcat(pattern->text, text);
}

/* Units with their prefixes: all of them, or those that are by themselves of a quantity. */
static void add_units(struct pattern *pattern, bool all, enum quantity quantity)
{
    const char *name, *before = "";
    int prefixed;
    for (int round = 0; round < 2; round++) {
        bool any = false;
        for (size_t i = 0; (name = units_known(i, &prefixed)); i++) {
            char one[32];
            double value;
            snprintf(one, sizeof one, "1 %s", name);
            if (prefixed != round || (!all && units_read(one, quantity, &value) != UNITS_GOOD))
                continue;
            add(pattern, any ? "|" : before);
            if (!any && prefixed) {
                add(pattern, "(");
                for (size_t p = 0; units_prefix(p); p++) {
                    add(pattern, p ? "|" : "");
                    add(pattern, units_prefix(p));
                }
                add(pattern, ")?(");
            }
            add(pattern, name);
            any = true;
        }
        if (any && round == 1)
            add(pattern, ")");
        before = any ? "|" : before;
    }
}

/* UNIT or a product of units: "mm^2", "g/cm^3", "1/mm". */
static void add_products(struct pattern *pattern)
{
    struct pattern unit = {"("};
    add_units(&unit, true, QUANTITY_NUMBER);
    add(&unit, ")");
    /* a power or another factor must be there: units alone are listed by quantity */
    add(pattern, "1/");
    add(pattern, unit.text);
    add(pattern, POWER "?( *[*/ ] *");
    add(pattern, unit.text);
    add(pattern, POWER "?)*|");
    add(pattern, unit.text);
    add(pattern, "(" POWER "|" POWER "?( *[*/ ] *");
    add(pattern, unit.text);
    add(pattern, POWER "?)+)");
}

/* A number with a unit or without. A product's quantity is not looked at: no pattern could. */
static json_t *written(enum quantity quantity, bool negative)
{
    struct pattern pattern = {""};
    add(&pattern, negative ? "^[-+]?" NUMBER : "^\\+?" NUMBER);
    if (quantity != QUANTITY_NUMBER) {
        add(&pattern, "( *(");
        const size_t before = strlen(pattern.text);
        add_units(&pattern, false, quantity);
        add(&pattern, strlen(pattern.text) > before ? "|" : "");
        add_products(&pattern);
        add(&pattern, "))?");
    }
    add(&pattern, " *$");
    return json_pack("{ssss}", "type", "string", "pattern", pattern.text);
}

/* The written numbers of each quantity, once for all keys. */
static json_t *definitions;

static json_t *reference(const struct limit *limit)
{
    char name[40];
    snprintf(name, sizeof name, "%s%s", units_name(limit->quantity),
             limit->low < 0.0 ? "_of_either_sign" : "");
    if (!json_object_get(definitions, name))
        json_object_set_new(definitions, name, written(limit->quantity, limit->low < 0.0));
    return json_pack("{so}", "$ref", json_sprintf("#/$defs/%s", name));
}

static json_t *ranged(const struct limit *limit)
{
    return json_pack("{sssfsf}", "type", "number", limit->low_open ? "exclusiveMinimum" : "minimum",
                     limit->low, limit->high_open ? "exclusiveMaximum" : "maximum", limit->high);
}

/* Readers of YAML take 210e9 for a text or for a number, by their version. */
static json_t *quantity(const struct limit *limit)
{
    return json_pack("{s[oo]}", "anyOf", ranged(limit), reference(limit));
}

static json_t *any_of(json_t *one, json_t *other)
{
    return json_pack("{s[oo]}", "anyOf", one, other);
}

static json_t *list_of(json_t *items, int least, int most)
{
    json_t *list = json_pack("{ssso}", "type", "array", "items", items);
    if (least > 0)
        json_object_set_new(list, "minItems", json_integer(least));
    if (most > 0)
        json_object_set_new(list, "maxItems", json_integer(most));
    return list;
}

/* 6061 is a name, too. */
static json_t *name(void)
{
    return json_pack("{s[sss]sisi}", "type", "string", "number", "boolean", "minLength", 1,
                     "maxLength", PERCUSS_ID_SIZE - 1);
}

static json_t *text(void)
{
    return json_pack("{s[ss]si}", "type", "string", "number", "minLength", 1);
}

static json_t *words(const struct key *key)
{
    json_t *list = json_array();
    for (size_t i = 0; i < key->word_count; i++)
        if (key->words[i])
            json_array_append_new(list, json_string(key->words[i]));
    return json_pack("{so}", "enum", list);
}

/* Those of one word, of two, and of a list. */
static json_t *ends(const struct key *key)
{
    json_t *one = words(key), *both = json_deep_copy(one), *list = json_object_get(both, "enum");
    for (size_t i = 0; i < key->word_count; i++)
        for (size_t k = 0; k < key->word_count; k++)
            if (key->words[i] && key->words[k])
                json_array_append_new(list, json_sprintf("%s-%s", key->words[i], key->words[k]));
    json_array_append_new(list, json_string("cantilever"));
    return any_of(both, list_of(one, 2, 2));
}

static json_t *kinds(void)
{
    json_t *list = json_array();
    const struct body_kind *kind;
    for (size_t i = 0; (kind = body_kind_at(i)); i++)
        json_array_append_new(list, json_string(kind->name));
    return json_pack("{so}", "enum", list);
}

static json_t *mapping(const struct key_table *table);

/* Mappings by names that the file chooses. */
static json_t *named(json_t *each)
{
    return json_pack("{sssos{si}}", "type", "object", "additionalProperties", each, "propertyNames",
                     "maxLength", PERCUSS_ID_SIZE - 1);
}

static json_t *body(void);

/* A list or a mapping that a caller reads. */
static json_t *by_caller(const struct key *key)
{
    if (!strcmp(key->name, "materials"))
        return named(mapping(&keys_material));
    if (!strcmp(key->name, "bodies"))
        return named(body());
    if (!strcmp(key->name, "sites"))
        return named(mapping(&keys_site));
    if (!strcmp(key->name, "friction"))
        return list_of(mapping(&keys_friction), 0, 0);
    if (!strcmp(key->name, "relaxation"))
        return list_of(mapping(&keys_relaxation), 1, RELAXATION_TERMS);
    if (!strcmp(key->name, "laws"))
        return named(mapping(&keys_law));
    if (!strcmp(key->name, "between"))
        return list_of(name(), 2, 2);
    if (!strcmp(key->name, "fixed"))
        return list_of(text(), 1, 0);
    return json_pack("{ss}", "type", key->type == KEY_LIST ? "array" : "object");
}

static json_t *value(const struct key *key)
{
    switch (key->type) {
    case KEY_NUMBER:
    case KEY_TWICE:
        return quantity(key->limit);
    case KEY_NUMBERS:
        return list_of(quantity(key->limit), 3, 3);
    case KEY_WHOLE:
        return json_pack("{sssisi}", "type", "integer", "minimum", 1, "maximum",
                         (int)key->limit->high);
    case KEY_FLAG:
        return json_pack("{ss}", "type", "boolean");
    case KEY_WORD:
        return words(key);
    case KEY_ENDS:
        return ends(key);
    case KEY_SHEAR:
        return any_of(words(key), quantity(key->limit));
    case KEY_DAMPING:
        return any_of(quantity(key->limit), list_of(quantity(key->limit), 1, 0));
    case KEY_YIELD:
        return any_of(json_pack("{ss}", "const", "none"), quantity(key->limit));
    case KEY_KIND:
        return kinds();
    case KEY_NAME:
        return name();
    case KEY_SECTION:
        return mapping(key->nested);
    case KEY_TEXT:
        return text();
    case KEY_LIST:
    case KEY_CALLER:
        return by_caller(key);
    }
    abort();
}

static json_t *described(json_t *schema, const char *meaning, const char *allowed,
                         const char *otherwise)
{
    json_object_set_new(
        schema, "description",
        otherwise ? json_sprintf("%s. Must be %s. Default: %s", meaning, allowed, otherwise)
                  : json_sprintf("%s. Must be %s", meaning, allowed));
    return schema;
}

/* One of several keys must be there, and only one. */
static json_t *alternatives(const struct key *key)
{
    json_t *list = json_pack("[{s[s]}]", "required", key->name);
    for (size_t i = 0; i < 2 && key->instead[i]; i++)
        json_array_append_new(list, json_pack("{s[s]}", "required", key->instead[i]));
    return list;
}

/* Nothing, with a unit or without. */
static json_t *zero(void)
{
    return any_of(json_pack("{si}", "const", 0),
                  json_pack("{ssss}", "type", "string", "pattern",
                            "^[-+]?(0+\\.?0*|\\.0+)([eE][-+]?[0-9]+)?( *[^-+.0-9eExX].*)? *$"));
}

/* Adds which keys it must not stand beside, and which one it must. */
static void add_company(json_t *list, const struct key *key)
{
    for (size_t i = 0; i < 2 && key->apart[i]; i++)
        json_array_append_new(list,
                              json_pack("{s{s[ss]}}", "not", "required", key->name, key->apart[i]));
    if (!key->needs)
        return;
    json_t *stated = key->type == KEY_NUMBER ? json_pack("{so}", "not", zero()) : json_object();
    json_array_append_new(list,
                          json_pack("{s{s[s]s{so}}s{s[s]s{s{s{ss}}}}}", "if", "required", key->name,
                                    "properties", key->name, stated, "then", "required", key->needs,
                                    "properties", key->needs, "not", "const", "none"));
}

/* The keys of a table, and no others. */
static json_t *mapping(const struct key_table *table)
{
    json_t *properties = json_object(), *required = json_array(), *company = json_array();
    json_t *schema = json_pack("{sssosb}", "type", "object", "properties", properties,
                               "additionalProperties", false);
    const struct key *key;
    for (size_t i = 0; (key = key_at(table, i)); i++) {
        json_object_set_new(
            properties, key->name,
            described(value(key), key->meaning, key_allowed(key).text, key->otherwise));
        if (key->instead[0])
            json_object_set_new(schema, "oneOf", alternatives(key));
        else if (key->required)
            json_array_append_new(required, json_string(key->name));
        add_company(company, key);
    }
    json_object_set_new(schema, "required", required);
    if (json_array_size(company) > 0)
        json_object_set(schema, "allOf", company);
    json_decref(company);
    return schema;
}

/* Its shape says which other keys it has. */
static json_t *body(void)
{
    json_t *branches = json_array();
    const struct body_kind *kind;
    for (size_t i = 0; (kind = body_kind_at(i)); i++) {
        const struct key_table table = {kind->name, kind->keys, kind->key_count,
                                        kind->own_material ? &keys_own : &keys_body};
        json_array_append_new(branches,
                              json_pack("{s{s{s{ss}}s[s]}so}", "if", "properties", "shape", "const",
                                        kind->name, "required", "shape", "then", mapping(&table)));
    }
    return json_pack("{sss{so}s[s]so}", "type", "object", "properties", "shape", kinds(),
                     "required", "shape", "allOf", branches);
}

static json_t *levels(void)
{
    json_t *list = json_array();
    for (enum log_level level = 0; level < LEVEL_COUNT; level++)
        json_array_append_new(list, json_string(log_level_name(level)));
    return json_pack("{so}", "enum", list);
}

static json_t *formats(void)
{
    json_t *list = json_array();
    for (enum log_format format = 0; format < LOG_FORMAT_COUNT; format++)
        json_array_append_new(list, json_string(log_format_name(format)));
    return json_pack("{so}", "enum", list);
}

static json_t *setting(const struct settings_row *row)
{
    const struct limit limit = {row->low, row->high, false, false, "", QUANTITY_NUMBER};
    switch (row->kind) {
    case SETTINGS_WHOLE:
        return json_pack("{sssIsI}", "type", "integer", "minimum", (json_int_t)row->low, "maximum",
                         (json_int_t)row->high);
    case SETTINGS_NUMBER:
        return quantity(&limit);
    case SETTINGS_SWITCH:
        return json_pack("{ss}", "type", "boolean");
    case SETTINGS_PATH:
    case SETTINGS_PARTITION:
        return text();
    case SETTINGS_FOLDERS:
        return any_of(text(), list_of(text(), 1, SETTINGS_FOLDERS_MOST));
    case SETTINGS_LEVEL:
        return levels();
    case SETTINGS_FORMAT:
        return formats();
    }
    abort();
}

/* The section of a path, made if need be; *name: what is left of the path. */
static json_t *section_of(json_t *root, const char *path, const char **key)
{
    json_t *properties = json_object_get(root, "properties");
    const char *dot = strchr(path, '.');
    *key = dot ? dot + 1 : path;
    if (!dot)
        return properties;
    char section[64];
    snprintf(section, sizeof section, "%.*s", (int)(dot - path), path);
    if (!json_object_get(properties, section))
        json_object_set_new(
            properties, section,
            json_pack("{sss{}sb}", "type", "object", "properties", "additionalProperties", false));
    return json_object_get(json_object_get(properties, section), "properties");
}

static json_t *settings(void)
{
    /* a file of comments leaves the defaults */
    json_t *root = json_pack("{s[ss]s{}sb}", "type", "object", "null", "properties",
                             "additionalProperties", false);
    struct settings_row row;
    for (size_t i = 0; settings_describe(i, &row); i++) {
        const char *key;
        json_t *properties = section_of(root, row.path, &key);
        json_object_set_new(properties, key,
                            described(setting(&row), row.meaning, row.allowed, row.otherwise));
    }
    return root;
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    definitions = json_object();
    json_t *schema = strcmp(argv[1], "catalogue") == 0 ? mapping(&keys_top) : settings();
    json_t *root = json_pack("{ssss}", "$schema", "https://json-schema.org/draft/2020-12/schema",
                             "title", argv[1]);
    json_object_update(root, schema);
    json_object_set_new(root, "$defs", definitions);
    json_decref(schema);
    bool good = json_dumpf(root, stdout, JSON_INDENT(1) | JSON_REAL_PRECISION(12)) == 0;
    json_decref(root);
    putchar('\n');
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
