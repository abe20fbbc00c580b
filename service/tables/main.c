/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss-tables: computes contact tables into a folder. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "catalogue/catalogue.h"
#include "store/table_file.h"
#include "store/table_key.h"
#include "tables/bar.h"
#include "tables/family.h"
#include "tables/options.h"
#include "tables/pairs.h"

static double processor_seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

/* Whether that very table lies in the folder, whole. */
static bool is_there(const char *folder, const struct region_input *input)
{
    char key[TABLE_KEY_SIZE], path[TABLE_PATH_SIZE];
    struct indentation_table table;
    table_key(input, key);
    snprintf(path, sizeof path, "%s/%s.json", folder, key);
    if (table_file_load(path, &table, NULL))
        return false;
    indentation_table_free(&table);
    return true;
}

static enum percuss_status make(const struct options *options, const struct table_pair *pair,
                                struct fault *fault)
{
    const struct material *a = &pair->a->material, *b = &pair->b->material;
    struct region_input input = table_input(a, b, options->speed);
    input.resolution = options->resolution;
    char label[2 * PERCUSS_ID_SIZE + 8], path[TABLE_PATH_SIZE];
    snprintf(label, sizeof label, "%s on %s", a->name, b->name);
    /* computed once */
    if (is_there(options->folder, &input)) {
        printf("%s: is there\n", label);
        return PERCUSS_OK;
    }
    /* minutes of work, which a bar shows */
    struct bar bar = bar_begin(label);
    struct watch watch = {bar_show, &bar};
    struct indentation_table table;
    double start = processor_seconds();
    enum percuss_status status = indentation_table_make(&input, &watch, &table, fault);
    bar_clear(&bar);
    if (status)
        return status;
    /* saved with who made it and in how long */
    struct table_origin origin = {"percuss-tables " PERCUSS_VERSION, processor_seconds() - start};
    status = table_file_save(options->folder, &table, &origin, path, fault);
    if (!status)
        printf("%s: up to %.3g of the radius, error of the force %.2g, %.1f s, %s\n", label,
               input.indentation / input.radius, table.force_error, origin.seconds, path);
    fflush(stdout);
    indentation_table_free(&table);
    return status;
}

static enum percuss_status find_body(const struct body_set *set, const char *id,
                                     const struct body **body, struct fault *fault)
{
    *body = body_set_find(set, id);
    if (*body)
        return PERCUSS_OK;
    const struct body_order *order = body_set_order(set, id);
    if (order && order->missing)
        return fault_set(fault, PERCUSS_UNKNOWN_BODY, "%s: %s", id, body_order_news(order).text);
    if (order)
        return fault_set(
            fault, PERCUSS_UNKNOWN_BODY,
            "%s: its mesh is not reduced: --bodies DIR must be a folder where percussd "
            "has reduced it",
            id);
    return fault_set(fault, PERCUSS_UNKNOWN_BODY, "%s: must be the id of a body in the catalogue",
                     id);
}

/* The pair that was asked for. */
static enum percuss_status name_pair(const struct options *options, const struct body_set *set,
                                     struct table_pair *pair, struct fault *fault)
{
    enum percuss_status status = find_body(set, options->a, &pair->a, fault);
    if (!status)
        status = find_body(set, options->b, &pair->b, fault);
    if (status)
        return status;
    if (!table_pair_is_round(pair->a, pair->b))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "%s on %s: one must be a sphere or a rod with tip_radius: tables are of "
                         "circular contacts",
                         options->a, options->b);
    if (!table_pair_yields(pair->a, pair->b))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "%s on %s: neither material has a yield: Hertz's law holds", options->a,
                         options->b);
    return PERCUSS_OK;
}

static enum percuss_status make_all(const struct options *options, const struct body_set *set,
                                    struct fault *fault)
{
    struct table_pair *pairs, named;
    size_t count = 0;
    enum percuss_status status = PERCUSS_OK;
    if (options->a) {
        status = name_pair(options, set, &named, fault);
        return status ? status : make(options, &named, fault);
    }
    for (size_t i = 0; i < set->order_count; i++)
        if (!set->orders[i].made)
            printf("%s: left out, as its %s\n", set->orders[i].id,
                   set->orders[i].missing ? "file is missing" : "mesh is not reduced yet");
    if (!table_pairs_find(set, &pairs, &count))
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    else if (count == 0)
        printf("no two bodies need a table\n");
    for (size_t i = 0; i < count && !status; i++)
        status = make(options, &pairs[i], fault);
    free(pairs);
    return status;
}

int main(int argc, char **argv)
{
    struct options options;
    struct fault fault;
    struct body_set *set = NULL;
    enum percuss_status status;
    options_read(&options, argc, argv);
    if (options.family)
        status = family_compute(options.folder, &fault);
    else
        status = catalogue_load_reducing(options.catalogue, options.bodies, &set, &fault);
    if (!status && !options.family)
        status = make_all(&options, set, &fault);
    body_set_free(set);
    if (!status)
        return EXIT_SUCCESS;
    fprintf(stderr, "percuss-tables: %s\n", fault.text);
    return EXIT_FAILURE;
}
