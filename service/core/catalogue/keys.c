/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/keys.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/body.h"

_Static_assert(sizeof(enum support) == sizeof(unsigned), "choices are stored as unsigned numbers");

static enum percuss_status keys_refuse(const struct reader *reader, const yaml_node_t *value,
                                       const struct key *key)
{
    return reader_refuse_quantity(
        reader, value, key->limit ? key->limit->quantity : QUANTITY_NUMBER, key_allowed(key).text);
}

static bool read_number(const yaml_node_t *value, const struct key *key, void *field)
{
    double number;
    if (!reader_quantity(value, key->limit->quantity, &number) || !limit_holds(key->limit, number))
        return false;
    memcpy(field, &number, sizeof number);
    return true;
}

static bool read_twice(const yaml_node_t *value, const struct key *key, void *field)
{
    double number;
    if (!read_number(value, key, &number))
        return false;
    number *= 0.5;
    memcpy(field, &number, sizeof number);
    return true;
}

static bool read_whole(const yaml_node_t *value, const struct key *key, void *field)
{
    return reader_whole(value, (unsigned)key->limit->high, field);
}

static bool read_flag(const yaml_node_t *value, bool *field)
{
    *field = reader_is(value, "true");
    return value->type == YAML_SCALAR_NODE && value->data.scalar.style == YAML_PLAIN_SCALAR_STYLE &&
           (*field || reader_is(value, "false"));
}

static bool read_word(const yaml_node_t *value, const struct key *key, void *field)
{
    for (unsigned i = 0; i < key->word_count; i++)
        if (key->words[i] && reader_is(value, key->words[i])) {
            memcpy(field, &i, sizeof i);
            return true;
        }
    return false;
}

static bool read_shear(const yaml_node_t *value, const struct key *key, struct body *body)
{
    if (read_word(value, key, &body->shear_rule))
        return true;
    body->shear_rule = SHEAR_NUMBER;
    return read_number(value, key, &body->shear_number);
}

/* Infinite where it is `none`, and where the key is absent. */
static bool read_yield(const yaml_node_t *value, const struct key *key,
                       struct stated_material *stated)
{
    stated->yield_unstated = false;
    return reader_is(value, "none") || read_number(value, key, &stated->material.yield);
}

static bool read_kind(const yaml_node_t *value, const struct body_kind **field)
{
    size_t number = 0;
    while ((*field = body_kind_at(number)) && !reader_is(value, (*field)->name))
        number++;
    return *field;
}

static bool read_name(const yaml_node_t *value, char *field)
{
    if (value->type != YAML_SCALAR_NODE || value->data.scalar.length >= PERCUSS_ID_SIZE)
        return false;
    memcpy(field, value->data.scalar.value, value->data.scalar.length);
    field[value->data.scalar.length] = '\0';
    return true;
}

/* A list of exactly `count`; the message of a bad element names its index. */
static enum percuss_status read_list(struct reader *reader, const yaml_node_t *list,
                                     const struct key *key, size_t count, char *field)
{
    /* an element is read like a key of its own */
    struct key one = *key;
    one.type = key->type == KEY_ENDS ? KEY_WORD : KEY_NUMBER;
    size_t stride = key->type == KEY_ENDS ? sizeof(unsigned) : sizeof(double);
    if (list->type != YAML_SEQUENCE_NODE || reader_count(list) != count)
        return keys_refuse(reader, list, key);
    for (size_t i = 0; i < count; i++) {
        char index[24];
        snprintf(index, sizeof index, "[%zu]", i);
        size_t mark = reader_enter(reader, index);
        one.offset = i * stride;
        enum percuss_status status =
            keys_read_value(reader, reader_element(reader, list, i), &one, field);
        if (status)
            return status;
        reader_leave(reader, mark);
    }
    return PERCUSS_OK;
}

/* One ratio of all modes, or a list of theirs: kept as shares of the largest. */
static enum percuss_status read_damping(struct reader *reader, const yaml_node_t *value,
                                        const struct key *key, struct body *body)
{
    if (value->type != YAML_SEQUENCE_NODE)
        return read_number(value, key, &body->damping) ? PERCUSS_OK
                                                       : keys_refuse(reader, value, key);
    size_t count = reader_count(value);
    if (count == 0)
        return keys_refuse(reader, value, key);
    body->damping_shares = calloc(count, sizeof *body->damping_shares);
    if (!body->damping_shares)
        return fault_set(reader->fault, PERCUSS_INTERNAL, "%s: out of memory",
                         reader_short_name(reader->name));
    body->damping_count = count;
    enum percuss_status status = read_list(reader, value, key, count, (char *)body->damping_shares);
    if (status)
        return status;
    for (size_t k = 0; k < count; k++)
        body->damping = fmax(body->damping, body->damping_shares[k]);
    for (size_t k = 0; k < count && body->damping > 0.0; k++)
        body->damping_shares[k] /= body->damping;
    return PERCUSS_OK;
}

/* Two words in one, "clamped-free", and a name for the commonest two. */
static bool read_pair(const yaml_node_t *value, const struct key *key, unsigned pair[2])
{
    const unsigned last = (unsigned)key->word_count - 1;
    char both[64];
    if (reader_is(value, "cantilever")) {
        pair[0] = last;
        pair[1] = 0;
        return true;
    }
    for (pair[0] = 0; pair[0] <= last; pair[0]++)
        for (pair[1] = 0; pair[1] <= last; pair[1]++) {
            const char *one = key->words[pair[0]], *other = key->words[pair[1]];
            if (!one || !other)
                continue;
            snprintf(both, sizeof both, "%s-%s", one, other);
            if (reader_is(value, both))
                return true;
        }
    return false;
}

static enum percuss_status read_ends(struct reader *reader, const yaml_node_t *value,
                                     const struct key *key, char *field)
{
    unsigned pair[2];
    if (read_pair(value, key, pair)) {
        memcpy(field, pair, sizeof pair);
        return PERCUSS_OK;
    }
    if (!read_word(value, key, field))
        return read_list(reader, value, key, 2, field);
    memcpy(field + sizeof(unsigned), field, sizeof(unsigned));
    return PERCUSS_OK;
}

enum percuss_status keys_read_value(struct reader *reader, const yaml_node_t *value,
                                    const struct key *key, void *object)
{
    char *field = (char *)object + key->offset;
    bool good = true;
    /* by type; a bad value is refused below */
    switch (key->type) {
    case KEY_NUMBER:
        good = read_number(value, key, field);
        break;
    case KEY_TWICE:
        good = read_twice(value, key, field);
        break;
    case KEY_WHOLE:
        good = read_whole(value, key, field);
        break;
    case KEY_FLAG:
        good = read_flag(value, (bool *)field);
        break;
    case KEY_WORD:
        good = read_word(value, key, field);
        break;
    case KEY_SHEAR:
        good = read_shear(value, key, object);
        break;
    case KEY_DAMPING:
        return read_damping(reader, value, key, object);
    case KEY_YIELD:
        good = read_yield(value, key, object);
        break;
    case KEY_KIND:
        good = read_kind(value, (const struct body_kind **)field);
        break;
    case KEY_NAME:
        good = read_name(value, field);
        break;
    case KEY_NUMBERS:
        return read_list(reader, value, key, 3, field);
    case KEY_ENDS:
        return read_ends(reader, value, key, field);
    case KEY_SECTION:
        return keys_read(reader, (struct entry){value, value}, key->nested, object);
    case KEY_TEXT:
        good = value->type == YAML_SCALAR_NODE && value->data.scalar.length > 0;
        break;
    case KEY_LIST:
        good = value->type == YAML_SEQUENCE_NODE;
        break;
    case KEY_CALLER:
        good = value->type == YAML_MAPPING_NODE;
        break;
    }
    return good ? PERCUSS_OK : keys_refuse(reader, value, key);
}

static enum percuss_status refuse_key(const struct reader *reader, const yaml_node_t *key,
                                      const struct key_table *table)
{
    return reader_refuse(reader, key, "%s: unknown key; the keys of %s are %s",
                         reader_excerpt(key).text, table->owner, key_list(table).text);
}

/* Exactly one of several alternative keys must be there. */
static enum percuss_status check_instead(struct reader *reader, struct entry entry,
                                         const struct key_table *table, const struct key *key)
{
    const char *const names[] = {key->name, key->instead[0], key->instead[1]};
    const size_t count = key->instead[1] ? 3 : 2;
    const char *found = NULL;
    for (size_t i = 0; i < count; i++) {
        struct entry item = reader_find(reader, entry.value, names[i]);
        if (!item.value)
            continue;
        if (found) {
            reader_enter(reader, names[i]);
            return reader_refuse(reader, item.key, "must be absent beside %s", found);
        }
        found = names[i];
    }
    if (found)
        return PERCUSS_OK;
    return reader_refuse(reader, entry.key, "%s%s%s or %s missing: a %s must have one of them",
                         names[0], count > 2 ? ", " : "", count > 2 ? names[1] : "",
                         names[count - 1], table->owner);
}

/* Whether a key may stand beside those that are there. */
static enum percuss_status check_company(struct reader *reader, struct entry entry,
                                         const struct key *key)
{
    const yaml_node_t *value = reader_find(reader, entry.value, key->name).value;
    if (!value)
        return PERCUSS_OK;
    for (size_t i = 0; i < 2 && key->apart[i]; i++) {
        if (!reader_find(reader, entry.value, key->apart[i]).value)
            continue;
        reader_enter(reader, key->name);
        return reader_refuse(reader, value, "must be absent beside %s", key->apart[i]);
    }
    const yaml_node_t *other = NULL;
    double number = NAN;
    if (key->needs)
        other = reader_find(reader, entry.value, key->needs).value;
    if (!key->needs || (other && !reader_is(other, "none")))
        return PERCUSS_OK;
    if (key->type != KEY_NUMBER) {
        reader_enter(reader, key->name);
        return reader_refuse(reader, value, "must be absent without %s", key->needs);
    }
    if (!reader_quantity(value, key->limit->quantity, &number) || number == 0.0)
        return PERCUSS_OK;
    reader_enter(reader, key->name);
    return reader_refuse(reader, value, "%.9g: must be %sabsent without %s", number,
                         limit_holds(key->limit, 0.0) ? "0 or " : "", key->needs);
}

/* Whether the mapping has the keys that the table requires, and none beside another that is apart.
 */
static enum percuss_status check_required(struct reader *reader, struct entry entry,
                                          const struct key_table *table)
{
    const struct key *key;
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; !status && (key = key_at(table, i)); i++)
        status = check_company(reader, entry, key);
    for (size_t i = 0; !status && (key = key_at(table, i)); i++) {
        if (key->instead[0]) {
            status = check_instead(reader, entry, table, key);
        } else if (key->required && !reader_find(reader, entry.value, key->name).value) {
            reader_enter(reader, key->name);
            status = reader_refuse(reader, entry.key, "missing: must be %s", key_allowed(key).text);
        }
    }
    return status;
}

/* One row of the table, or NULL. */
static const struct key *key_of(const yaml_node_t *node, const struct key_table *table)
{
    const struct key *key;
    size_t number = 0;
    while ((key = key_at(table, number)) && !reader_is(node, key->name))
        number++;
    return key;
}

static enum percuss_status read_entry(struct reader *reader, const yaml_node_t *mapping,
                                      struct entry item, const struct key *key, void *object)
{
    size_t mark = reader_enter(reader, key->name);
    struct entry first = reader_find(reader, mapping, key->name);
    if (first.key != item.key)
        return reader_refuse(reader, item.key, "must stand once, but is on line %zu already",
                             first.key->start_mark.line + 1);
    enum percuss_status status = keys_read_value(reader, item.value, key, object);
    if (!status)
        reader_leave(reader, mark);
    return status;
}

enum percuss_status keys_read(struct reader *reader, struct entry entry,
                              const struct key_table *table, void *object)
{
    if (entry.value->type != YAML_MAPPING_NODE) {
        const struct key whole = {.type = KEY_SECTION, .nested = table};
        return keys_refuse(reader, entry.value, &whole);
    }
    for (size_t i = 0; i < reader_count(entry.value); i++) {
        struct entry item = reader_entry(reader, entry.value, i);
        const struct key *key = key_of(item.key, table);
        if (!key)
            return refuse_key(reader, item.key, table);
        enum percuss_status status = read_entry(reader, entry.value, item, key, object);
        if (status)
            return status;
    }
    return check_required(reader, entry, table);
}

/* The tables. */

#define TABLE(array) array, sizeof array / sizeof *array, NULL

static const char *const compliances[] = {
    [PERCUSS_COMPLIANCE_HALF_SPACE] = "half-space",
    [PERCUSS_COMPLIANCE_MATCHED] = "matched",
};
static const struct key top_keys[] = {
    {"materials", KEY_CALLER, .required = true,
     KEY_SAYS(NULL, "the materials by their names, which bodies refer to")},
    {"bodies", KEY_CALLER, .required = true,
     KEY_SAYS(NULL, "the bodies by their ids, which requests name: 1 to 63 bytes")},
    {"contact", KEY_SECTION, .nested = &keys_contact,
     KEY_SAYS("the defaults of its keys", "how contacts are modelled")},
    {"friction", KEY_LIST, .required = false,
     .allowed = "a list of mappings of between, coefficient, deviation",
     KEY_SAYS("none", "friction between materials, of which each pair stands once")},
    {"laws", KEY_CALLER, .required = false,
     KEY_SAYS("none", "force laws by their names, each of the contacts of two materials, in place "
                      "of that of contact_model auto")},
    {"begin", KEY_FLAG, KEY_OF(body_set, begin),
     KEY_SAYS("false",
              "the first line of a file that must end with `end: true`: one that is cut off, or "
              "being written while it is read, is refused")},
    {"end", KEY_FLAG, KEY_OF(body_set, end), KEY_SAYS("false", "the last line of such a file")},
};
const struct key_table keys_top = {"the catalogue", TABLE(top_keys)};

static const struct key contact_keys[] = {
    {"compliance", KEY_WORD, KEY_OF(body_set, compliance), KEY_WORDS(compliances),
     KEY_SAYS("matched",
              "local compliance: Hertz's of a half-space, or corrected for the finite body where "
              "that is known (rods, cylinders, spheres; a beam's side has its own either way)")},
};
const struct key_table keys_contact = {"contact", TABLE(contact_keys)};

static const struct key friction_keys[] = {
    {"between", KEY_LIST, .required = true,
     .allowed = "a list of two names of materials, which may be the same",
     KEY_SAYS(NULL, "the materials of the two surfaces that touch, in either order")},
    {"coefficient", KEY_NUMBER, &limit_friction, true, KEY_OF(friction_pair, coefficient),
     KEY_SAYS(NULL, "coefficient of Coulomb friction between them")},
    {"deviation", KEY_NUMBER, &limit_deviation, false, KEY_OF(friction_pair, deviation),
     KEY_SAYS("a fifth of the coefficient", "standard deviation of the coefficient")},
};
const struct key_table keys_friction = {"a pair of materials", TABLE(friction_keys)};

static const struct key law_keys[] = {
    {"between", KEY_LIST, .required = true,
     .allowed = "a list of two names of materials, which may be the same",
     KEY_SAYS(NULL, "the materials of the two surfaces that touch, in either order; their shapes "
                    "and sizes do not change the law")},
    {"stiffness", KEY_NUMBER, &limit_law_stiffness, false, KEY_OF(own_law, stiffness),
     .instead = {"points"},
     KEY_SAYS("points are stated",
              "force at an indentation of 1 m, F = stiffness d^exponent, a plain "
              "number of N/m^exponent")},
    {"exponent", KEY_NUMBER, &limit_law_exponent, false, KEY_OF(own_law, exponent),
     .apart = {"points"}, KEY_SAYS("1.5, Hertz's", "exponent of the indentation in that force")},
    {"hysteresis", KEY_NUMBER, &limit_hysteresis, false, KEY_OF(own_law, hysteresis),
     .apart = {"points"},
     KEY_SAYS("0", "share of the work of loading that unloading does not give back, at any speed: "
                   "1 - e^2 of two rigid bodies")},
    {"dissipation", KEY_NUMBER, &limit_dissipation, false, KEY_OF(own_law, dissipation),
     .apart = {"points", "hysteresis"},
     KEY_SAYS("0", "Hunt and Crossley's: the force is 1 + dissipation times the rate of the "
                   "indentation as large, and never pulls")},
    {"points", KEY_TEXT, .required = false, .allowed = "a path of a CSV file",
     KEY_SAYS("stiffness is stated",
              "file of two columns, indentation in m and force in N, from 0 to the largest; an "
              "indentation beyond it is answered with a warning. The path is from the "
              "catalogue's own folder")},
    {"unloading", KEY_TEXT, .required = false, .allowed = "a path of a CSV file",
     .apart = {"stiffness"},
     KEY_SAYS("the way of loading",
              "file like that of the way back, from the same largest indentation to force 0; from "
              "other ones it is in proportion")},
    {"deviation", KEY_NUMBER, &limit_law_deviation, false, KEY_OF(own_law, deviation),
     KEY_SAYS("0.05",
              "standard deviation of the force, over the force, and of the work that is lost")},
};
const struct key_table keys_law = {"law", TABLE(law_keys)};
static const struct key rate_keys[] = {
    {"reference", KEY_NUMBER, &limit_rate, true, KEY_OF(stated_material, yield_rate.reference),
     KEY_SAYS(NULL, "rate of strain to which the exponent or the coefficient belongs")},
    {"exponent", KEY_NUMBER, &limit_rate_exponent, KEY_OF(stated_material, yield_rate.exponent),
     .instead = {"coefficient"},
     KEY_SAYS("coefficient stands instead",
              "of the law of Cowper and Symonds: q, by which the stress is 1 + "
              "(rate/reference)^(1/q) times that of a slow test")},
    {"coefficient", KEY_NUMBER, &limit_rate_coefficient,
     KEY_OF(stated_material, yield_rate.coefficient), .instead = {"exponent"},
     KEY_SAYS("exponent stands instead",
              "of the law of Johnson and Cook: C, by which the stress is 1 + C ln(rate/reference) "
              "times that of a slow test, from the reference on")},
};
static const struct key_table keys_rate = {"rate", TABLE(rate_keys)};

static const struct key material_keys[] = {
    {"young", KEY_NUMBER, &limit_young, true, KEY_OF(stated_material, material.young),
     KEY_SAYS(
         NULL,
         "Young's modulus: beside relaxation the instantaneous one, else that of the frequency "
         "of the impact")},
    {"poisson", KEY_NUMBER, &limit_poisson, true, KEY_OF(stated_material, material.poisson),
     KEY_SAYS(NULL, "Poisson's ratio")},
    {"density", KEY_NUMBER, &limit_density, true, KEY_OF(stated_material, material.density),
     KEY_SAYS(NULL, "mass of a volume")},
    {"yield", KEY_YIELD, &limit_yield,
     KEY_SAYS(
         "elastic, which answers warn of where a metal would yield",
         "yield stress in tension, beyond which a contact leaves a dent; none: a material that "
         "is meant to stay elastic")},
    {"tangent", KEY_NUMBER, &limit_tangent, false, KEY_OF(stated_material, material.tangent),
     .needs = "yield",
     KEY_SAYS("0", "slope of the stress-strain curve beyond yield; 0: ideally plastic")},
    {"rate", KEY_SECTION, .nested = &keys_rate, .needs = "yield",
     KEY_SAYS("yield is that of any rate", "how the yield stress grows with the rate of strain")},
    {"loss_factor", KEY_NUMBER, &limit_loss_factor, false, KEY_OF(stated_material, loss_factor),
     KEY_SAYS("not stated",
              "energy that a cycle of strain loses over 2 pi of what it stores, tan delta: 0.02 to "
              "0.1 of hard plastics, 0.05 to 1 of rubber; 0: a soft material that is meant to lose "
              "nothing")},
    {"loss_frequency", KEY_NUMBER, &limit_loss_frequency, false,
     KEY_OF(stated_material, loss_frequency), .needs = "loss_factor",
     KEY_SAYS("that of the impact",
              "at which the loss_factor was measured: an answer's error grows with the distance of "
              "its contact's from it")},
    {"relaxation", KEY_LIST, .allowed = "a list of 1 to 8 mappings of share, time",
     .apart = {"loss_factor"},
     KEY_SAYS(
         "none",
         "Prony series of a viscoelastic material, in place of a loss_factor: beside it `young` "
         "is the instantaneous modulus, which falls to young (1 - sum share (1 - exp(-t/time))) "
         "after a sudden strain; the shares add up to less than 1")},
};
const struct key_table keys_material = {"a material", TABLE(material_keys)};

static const struct key relaxation_keys[] = {
    {"share", KEY_NUMBER, &limit_share, true, KEY_OF(stated_term, share),
     KEY_SAYS(NULL, "of the instantaneous modulus that is lost")},
    {"time", KEY_NUMBER, &limit_time, true, KEY_OF(stated_term, time),
     KEY_SAYS(NULL, "in which it falls to 1/e of that")},
};
const struct key_table keys_relaxation = {"a term of a relaxation", TABLE(relaxation_keys)};

static const struct key body_keys[] = {
    {"shape", KEY_KIND, .required = true, KEY_OF(body, kind),
     KEY_SAYS(NULL, "what kind of body it is, on which its other keys depend")},
    {"material", KEY_NAME, .required = true, KEY_OF(body, material.name),
     KEY_SAYS(NULL, "what it is made of")},
};
const struct key_table keys_body = {NULL, TABLE(body_keys)};

static const struct key own_keys[] = {
    {"shape", KEY_KIND, .required = true, KEY_OF(body, kind),
     KEY_SAYS(NULL, "what kind of body it is, on which its other keys depend")},
    {"material", KEY_NAME, .required = false, KEY_OF(body, material.name),
     KEY_SAYS("the file's own",
              "what it is made of; beside a reduced body only where its file holds a single "
              "material, with the same Poisson's ratio")},
};
const struct key_table keys_own = {NULL, TABLE(own_keys)};
