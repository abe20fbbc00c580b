/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss bodies: the server's catalogue, and its improbable numbers. */

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "body_json.h"
#include "cli.h"
#include "csv.h"
#include "json_writer.h"
#include "percuss/plausible.h"

JSON_TABLE(contact_law, PERCUSS_CONTACT_LAW_FIELDS)
JSON_TABLE(material_pair, PERCUSS_MATERIAL_PAIR_FIELDS)

enum { OPTION_CHECK = OPTION_OWN, OPTION_CSV, OPTION_PAIRS };

static void print_json(const struct percuss_body_list *list)
{
    json_t *bodies = json_array(), *pairs = json_array();
    for (size_t i = 0; i < list->count; i++)
        json_array_append_new(bodies, body_to_json(&list->bodies[i]));
    for (size_t i = 0; i < list->pair_count; i++)
        json_array_append_new(pairs, json_object_of(material_pair_members(), &list->pairs[i]));
    json_print(json_pack("{soso}", "bodies", bodies, "pairs", pairs));
}

/* "0.2 20e-6; 0.1 5e-4": shares and times. */
static void print_relaxation(const struct percuss_body *body)
{
    for (size_t i = 0; i < body->relaxation_count; i++)
        printf("%s%.17g %.17g", i ? "; " : "", body->relaxation[i].share, body->relaxation[i].time);
}

static void print_csv(const struct percuss_body_list *list, bool units)
{
    /* the others under the names that inputs have */
    csv_head(stdout, "id,shape,material,mass,half_extent_x,half_extent_y,half_extent_z,tip_radius",
             units);
    for (unsigned p = 0; p < PERCUSS_PARAMETER_COUNT; p++) {
        putchar(',');
        csv_head(stdout, percuss_parameter_name(p), units);
    }
    fputs(",description,", stdout);
    csv_head(stdout,
             "loss_factor,loss_frequency,relaxation,rate_reference,rate_exponent,"
             "rate_coefficient",
             units);
    putchar('\n');
    for (size_t i = 0; i < list->count; i++) {
        const struct percuss_body *body = &list->bodies[i];
        const char *names[] = {body->id, body->shape, body->material};
        const double *half = body->half_extents;
        for (size_t k = 0; k < 3; k++) {
            csv_text(stdout, names[k]);
            putchar(',');
        }
        printf("%.17g,%.17g,%.17g,%.17g,%.17g", body->mass, half[0], half[1], half[2],
               body->tip_radius);
        for (unsigned p = 0; p < PERCUSS_PARAMETER_COUNT; p++)
            printf(",%.17g", p == PERCUSS_PARAMETER_RADIUS ? body->radius : body->parameters[p]);
        putchar(',');
        csv_text(stdout, body->description);
        printf(",%.17g,%.17g,", body->loss_factor, body->loss_frequency);
        print_relaxation(body);
        printf(",%.17g,%.17g,%.17g\n", body->rate_reference, body->rate_exponent,
               body->rate_coefficient);
    }
}

static void print_pairs_csv(const struct percuss_body_list *list, bool units)
{
    csv_head(stdout,
             "material_a,material_b,friction,friction_deviation,law,kind,stiffness,exponent,"
             "hysteresis,dissipation,deviation,points,point_count,max_indentation,max_force,"
             "unloading,residual_indentation",
             units);
    putchar('\n');
    for (size_t i = 0; i < list->pair_count; i++) {
        const struct percuss_material_pair *pair = &list->pairs[i];
        const struct percuss_contact_law *law = &pair->law;
        csv_text(stdout, pair->material_a);
        putchar(',');
        csv_text(stdout, pair->material_b);
        printf(",%.17g,%.17g,", pair->friction, pair->friction_deviation);
        csv_text(stdout, law->name);
        printf(",%s,%.17g,%.17g,%.17g,%.17g,%.17g,", law->kind, law->stiffness, law->exponent,
               law->hysteresis, law->dissipation, law->deviation);
        csv_text(stdout, law->points);
        printf(",%u,%.17g,%.17g,", law->point_count, law->max_indentation, law->max_force);
        csv_text(stdout, law->unloading);
        printf(",%.17g\n", law->residual_indentation);
    }
}

/* A law in words; nothing where there is none. */
static void print_law(const struct percuss_contact_law *law)
{
    if (!law->name[0])
        return;
    printf("%s: ", law->name);
    if (law->points[0])
        printf("%u points of %s to %g m and %g N", law->point_count, law->points,
               law->max_indentation, law->max_force);
    else
        printf("%g N/m^%g", law->stiffness, law->exponent);
    if (law->unloading[0])
        printf(", unloading by %s to %g m", law->unloading, law->residual_indentation);
    if (law->hysteresis > 0.0)
        printf(", hysteresis %g", law->hysteresis);
    if (law->dissipation > 0.0)
        printf(", dissipation %g s/m", law->dissipation);
    printf(", deviation %g", law->deviation);
}

static void print_pairs(const struct percuss_body_list *list)
{
    printf("%-20s %-20s %-18s %s\n", "material", "on material", "friction", "law");
    for (size_t i = 0; i < list->pair_count; i++) {
        const struct percuss_material_pair *pair = &list->pairs[i];
        char friction[64] = "";
        if (!isnan(pair->friction))
            snprintf(friction, sizeof friction, "%g +- %.3g", pair->friction,
                     pair->friction_deviation);
        printf("%-20s %-20s ", pair->material_a, pair->material_b);
        printf(pair->law.name[0] ? "%-18s " : "%s", friction);
        print_law(&pair->law);
        putchar('\n');
    }
}

static void print_table(const struct percuss_body_list *list)
{
    printf("%-20s %-10s %-12s %12s  %s\n", "id", "shape", "material", "mass kg", "description");
    for (size_t i = 0; i < list->count; i++) {
        const struct percuss_body *body = &list->bodies[i];
        printf("%-20s %-10s %-12s %12.6g  %s\n", body->id, body->shape, body->material, body->mass,
               body->description);
        for (size_t s = 0; s < body->site_count; s++)
            printf("%-20s %s %s\n", "", s ? "     " : "sites", body->sites[s].name);
    }
    if (list->pair_count > 0) {
        putchar('\n');
        print_pairs(list);
    }
}

/* One remark, as a line or into an array. */
static void tell(json_t *array, const char *group, const char *name,
                 const struct plausible_remark *remark)
{
    if (array)
        json_array_append_new(array, json_pack("{ssssssss}", "of", group, "name", name, "key",
                                               remark->key, "text", remark->text));
    else
        printf("%s.%s.%s: %s\n", group, name, remark->key, remark->text);
}

/* Prints the improbable numbers of each material, once, and of each body; their count. */
static size_t check_bodies(const struct percuss_body_list *list, json_t *array)
{
    struct plausible_remark remarks[PLAUSIBLE_MOST];
    size_t total = 0;
    for (size_t b = 0; b < list->count; b++) {
        const struct percuss_body *body = &list->bodies[b];
        const struct plausible_body numbers = {
            body->shape, body->parameters[PERCUSS_PARAMETER_YOUNG],
            body->parameters[PERCUSS_PARAMETER_DENSITY], body->parameters[PERCUSS_PARAMETER_YIELD],
            body->half_extents};
        size_t first = 0;
        while (strcmp(list->bodies[first].material, body->material) != 0)
            first++;
        /* what is not stated is not improbable, and not counted */
        bool none = strstr(body->description, PLAUSIBLE_ELASTIC);
        if (first == b && plausible_unstated(&numbers, none, remarks))
            tell(array, "materials", body->material, remarks);
        bool stated = !isnan(body->loss_factor) || body->relaxation_count > 0;
        if (first == b && plausible_lossless(&numbers, stated, remarks))
            tell(array, "materials", body->material, remarks);
        size_t count = first == b ? plausible_material(&numbers, remarks) : 0;
        for (size_t i = 0; i < count; i++)
            tell(array, "materials", body->material, &remarks[i]);
        total += count;
        count = plausible_size(&numbers, remarks);
        for (size_t i = 0; i < count; i++)
            tell(array, "bodies", body->id, &remarks[i]);
        total += count;
    }
    return total;
}

static int print_check(const struct percuss_body_list *list, bool json)
{
    json_t *array = json ? json_array() : NULL;
    if (json && !array)
        json_print(NULL); /* ends the program */
    size_t total = check_bodies(list, array);
    if (json)
        json_print(json_pack("{siso}", "bodies", (int)list->count, "remarks", array));
    else if (total == 0)
        printf("%zu bodies: nothing improbable\n", list->count);
    return total ? EXIT_ANSWERED_WITH_WARNING : EXIT_ANSWERED;
}

struct bodies_options {
    struct common *common;
    bool check, csv, pairs;
};

static const struct argp_option options[] = {
    {"check", OPTION_CHECK, NULL, 0,
     "Say instead what is possible but improbable of them: mostly a number in another unit than "
     "was meant",
     0},
    {"pairs", OPTION_PAIRS, NULL, 0,
     "Print only the pairs of materials of which the catalogue states friction or a law", 0},
    {"csv", OPTION_CSV, NULL, 0, "print comma-separated values, a line for each body or pair", 90},
    {0}};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct bodies_options *chosen = state->input;
    (void)text;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = chosen->common;
        return 0;
    case OPTION_CHECK:
        chosen->check = true;
        return 0;
    case OPTION_CSV:
        chosen->csv = true;
        return 0;
    case OPTION_PAIRS:
        chosen->pairs = true;
        return 0;
    case ARGP_KEY_END:
        if (chosen->pairs && (chosen->check || chosen->common->json))
            argp_error(state, "--pairs or %s, not both%s", chosen->check ? "--check" : "--json",
                       chosen->check ? "" : ": JSON has the pairs, too");
        if (chosen->csv && (chosen->check || chosen->common->json))
            argp_error(state, "--csv or %s, not both", chosen->check ? "--check" : "--json");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&common_argp, 0, NULL, 0}, {0}};
const struct argp bodies_argp = {.options = options,
                                 .parser = parse,
                                 .doc = "Lists the bodies that the server knows, and the pairs of "
                                        "their materials that have friction or a law.",
                                 .children = children};

int command_bodies(int argc, char **argv, struct common *common)
{
    struct percuss_client *client;
    struct percuss_body_list list;
    struct bodies_options chosen = {.common = common};
    argp_parse(&bodies_argp, argc, argv, 0, NULL, &chosen);
    int code = open_onlooker(common, &client);
    if (code != EXIT_ANSWERED)
        return code;
    enum percuss_result result = percuss_bodies(client, common_timeout(common), &list);
    if (result != PERCUSS_RESULT_OK)
        code = complain_result(result);
    else if (chosen.check)
        code = print_check(&list, common->json);
    else if (common->json)
        print_json(&list);
    else if (chosen.csv && chosen.pairs)
        print_pairs_csv(&list, common->units);
    else if (chosen.csv)
        print_csv(&list, common->units);
    else if (chosen.pairs)
        print_pairs(&list);
    else
        print_table(&list);
    percuss_body_list_free(&list);
    percuss_client_free(client);
    return code;
}
