/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss-tables: computes contact tables into a folder. */
#include <argp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/fault.h"
#include "base/units.h"
#include "catalogue/catalogue.h"
#include "contact/law_closed_form.h"
#include "model/body.h"
#include "percuss/habits.h"
#include "store/family_file.h"
#include "store/table_file.h"
#include "store/table_key.h"
#include "tables/family_make.h"

/* A progress bar on standard error, where that is a terminal. */

struct bar {
    const char *label;
    int shown; /* per mille */
    bool wanted;
    double from, share; /* of the whole: before the present part, and of that part */
};

enum { WIDTH = 40 };

static struct bar bar_begin(const char *label)
{
    return (struct bar){label, -1, isatty(STDERR_FILENO), 0.0, 1.0};
}

/* `proceed` of struct watch; always true. */
static bool bar_show(void *context, double done)
{
    struct bar *bar = context;
    int now = (int)(1000.0 * (bar->from + bar->share * done));
    if (!bar->wanted || now == bar->shown)
        return true;
    bar->shown = now;
    char line[WIDTH + 1];
    int full = now * WIDTH / 1000;
    memset(line, '#', (size_t)full);
    memset(line + full, '.', (size_t)(WIDTH - full));
    line[WIDTH] = '\0';
    fprintf(stderr, "\r[%s] %5.1f %%  %s", line, 0.1 * now, bar->label);
    return true;
}

static void bar_clear(const struct bar *bar)
{
    if (bar->wanted)
        fprintf(stderr, "\r\033[K");
}

/* The command line of percuss-tables. */

struct options {
    const char *catalogue, *folder;
    const char *bodies; /* folder of bodies that percussd has reduced; "": none */
    const char *a, *b;  /* NULL: every pair that needs a table */
    double speed;       /* m/s */
    size_t resolution;
    bool family;               /* the family of all metals, and nothing else */
    char own[TABLE_PATH_SIZE]; /* the folder where none is given */
};

enum { USAGE = 2, LEAST_RESOLUTION = 6, MOST_RESOLUTION = 60 };

const char *argp_program_version = "percuss-tables " PERCUSS_VERSION;

static const struct argp_option list[] = {
    {"catalogue", 'C', "FILE", 0, "Bodies and materials, as percussd reads them", 0},
    {"bodies", 'B', "DIR", 0, "Bodies reduced from meshes; `bodies` in percussd's settings", 0},
    {"folder", 'f', "DIR", 0,
     "Where the tables go, made if need be: `tables` in percussd's settings; default: the folder "
     "of "
     "your own, which stands beside the shipped tables by itself: PERCUSS_TABLES, or "
     "~/.local/share/percuss/tables",
     0},
    {"a", 'a', "ID", 0, "Only for the materials of this body ...", 0},
    {"b", 'b', "ID", 0, "... and this one", 0},
    {"speed", 's', "V", 0,
     "Deep enough for compact bodies that meet at V, m/s or such as 300mm/s; default 1", 0},
    {"resolution", 'r', "N", 0, "Elements along the mesh's core, 6 to 60; default 12", 0},
    {"family", 'F', NULL, 0, "The family for all metals instead, DIR/family.json: 18 minutes", 0},
    {0},
};

static double parse_number(struct argp_state *state, const char *name, const char *text,
                           double least, double most)
{
    char *end;
    double number = strtod(text, &end);
    if (end == text || *end || !(number >= least && number <= most))
        argp_error(state, "--%s: %s: must be a number, %g to %g", name, text, least, most);
    return number;
}

static double parse_speed(struct argp_state *state, const char *text)
{
    double speed;
    if (units_read(text, QUANTITY_SPEED, &speed) || !(speed >= 1e-3 && speed <= 1e3))
        argp_error(state,
                   "--speed: %s: must be a speed, 0.001 to 1000 m/s, or with a unit, such as %s",
                   text, units_example(QUANTITY_SPEED));
    return speed;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct options *options = state->input;
    switch (key) {
    /* files and folders */
    case 'C':
        options->catalogue = text;
        return 0;
    case 'B':
        options->bodies = text;
        return 0;
    case 'f':
        options->folder = text;
        return 0;
    /* of which bodies */
    case 'a':
        options->a = text;
        return 0;
    case 'b':
        options->b = text;
        return 0;
    /* depth and mesh */
    case 's':
        options->speed = parse_speed(state, text);
        return 0;
    case 'r':
        options->resolution =
            (size_t)parse_number(state, "resolution", text, LEAST_RESOLUTION, MOST_RESOLUTION);
        return 0;
    case 'F':
        options->family = true;
        return 0;
    /* all are read */
    case ARGP_KEY_END:
        if (options->family && (options->catalogue || options->a || options->b))
            argp_error(state, "--family: has no catalogue and no bodies");
        if (!options->catalogue && !options->family)
            argp_error(state, "--catalogue FILE (or --family) must be given");
        if (!options->folder && !folder_own_tables(options->own, sizeof options->own))
            argp_error(state, "--folder DIR must be given: PERCUSS_TABLES is empty, or neither it "
                              "nor HOME says where");
        if (!options->folder)
            options->folder = options->own;
        if (!options->a != !options->b)
            argp_error(state, "--a ID and --b ID must be given together");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* Ends the program for --help, --version and, with exit code 2, wrong usage. */
static void options_read(struct options *options, int argc, char **argv)
{
    static const struct argp argp = {
        .options = list,
        .parser = parse,
        .children = habits,
        .doc = "Computes tables of elastic-plastic contacts ahead of time, for the contact model "
               "`table`: finite elements of the contact region, some seconds to minutes each. "
               "Without --a and --b: of every two materials in the catalogue whose bodies can meet "
               "in a circular contact and of which one may yield. A body that is given as a mesh "
               "and not reduced yet is left out."
               "\vA table holds for bodies of any size. What is there already is left as it is.",
    };
    *options = (struct options){.bodies = "", .speed = 1.0, .resolution = TABLE_RESOLUTION};
    argp_err_exit_status = USAGE;
    argp_parse(&argp, argc, argv, 0, NULL, options);
}

/* Which materials of a catalogue need contact tables. */

/* Two bodies that stand for all with their materials. */
struct table_pair {
    const struct body *a, *b;
};

/* Whether two bodies can meet in a contact of revolution (one has a sphere's surface, and all have
 * a flat or a round place), and whether one of them may yield. */
static bool table_pair_is_round(const struct body *a, const struct body *b)
{
    return body_has_sphere(a) || body_has_sphere(b);
}

static bool table_pair_yields(const struct body *a, const struct body *b)
{
    return closed_form_softer(&a->material, &b->material) >= 0;
}

/* One body for each material, with a sphere's surface if any of that material has one. */
static size_t find_materials(const struct body_set *set, const struct body **bodies)
{
    size_t count = 0;
    for (size_t i = 0; i < set->count; i++) {
        const struct body *body = &set->bodies[i];
        size_t k = 0;
        while (k < count && !table_same_material(&bodies[k]->material, &body->material))
            k++;
        if (k == count)
            bodies[count++] = body;
        else if (body_has_sphere(body) && !body_has_sphere(bodies[k]))
            bodies[k] = body;
    }
    return count;
}

/* All pairs of a catalogue that need a table, one for each pair of materials; *pairs is for free(),
 * NULL if there are none or (false) no memory. */
static bool table_pairs_find(const struct body_set *set, struct table_pair **pairs, size_t *count)
{
    *count = 0;
    *pairs = NULL;
    const struct body **bodies = malloc((set->count + 1) * sizeof *bodies);
    if (!bodies)
        return false;
    /* one body stands for its material */
    size_t materials = find_materials(set, bodies);
    size_t room = 0;
    bool good = true;
    for (size_t i = 0; i < materials && good; i++) {
        for (size_t k = i; k < materials && good; k++) {
            /* the one with a sphere first */
            const struct body *a = bodies[body_has_sphere(bodies[i]) ? i : k];
            const struct body *b = a == bodies[i] ? bodies[k] : bodies[i];
            if (!table_pair_is_round(a, b) || !table_pair_yields(a, b))
                continue;
            if (*count == room) {
                room = 2 * room + 8;
                void *more = realloc(*pairs, room * sizeof **pairs);
                good = more != NULL;
                *pairs = good ? more : *pairs;
            }
            if (good)
                (*pairs)[(*count)++] = (struct table_pair){a, b};
        }
    }
    free(bodies);
    return good;
}

/* `percuss-tables --family`: computes the family of tables for all metals. */

/* A passage on the fine mesh takes as long as some ten on the coarse one. */
enum { FINE_COST = 10 };

struct work {
    struct indentation_run in_long, in_short;
    struct bar bar;
};

/* Two passages over the same region, the first some third of the time. */
static enum percuss_status compute_point(void *context, const struct contact_family_place *place,
                                         size_t resolution, struct family_point *point,
                                         struct fault *fault)
{
    const double first = 0.35;
    struct work *work = context;
    struct watch watch = {bar_show, &work->bar};
    struct region_input input = family_input(place, resolution);
    /* in long steps, loading alone */
    struct indentation_plan plan = {input, FAMILY_LONG, 0, 0.0, first, &watch};
    size_t all = family_passages() + family_fine_passages() * (FINE_COST - 1);
    work->bar.share = (resolution == FAMILY_FINE ? FINE_COST : 1) / (double)all;
    enum percuss_status status = indentation_run(&plan, &work->in_long, fault);
    /* in steps half as long, with unloadings */
    plan = (struct indentation_plan){input, 2 * FAMILY_LONG, FAMILY_BRANCH_EVERY,
                                     first, 1.0 - first,     &watch};
    if (!status)
        status = indentation_run(&plan, &work->in_short, fault);
    /* both together: the error of the steps is taken out */
    if (!status && !family_point_fill(&work->in_long, &work->in_short, &input, point))
        status = fault_set(fault, PERCUSS_INTERNAL, "family: too few points");
    work->bar.from += work->bar.share;
    return status;
}

/* Into FOLDER/family.json, with a bar on a terminal; some 18 minutes of one core. */
static enum percuss_status family_compute(const char *folder, struct fault *fault)
{
    clock_t start = clock();
    /* all its points, under one bar */
    struct work *work = calloc(1, sizeof *work);
    if (!work)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    work->bar = bar_begin("the family of tables");
    struct family_source source = {compute_point, work};
    struct family_numbers *numbers = family_numbers_make(&source, fault);
    bar_clear(&work->bar);
    free(work);
    if (!numbers)
        return PERCUSS_INTERNAL;
    /* saved with its maker, its time and its meshes */
    struct contact_family_samples samples = family_numbers_samples(numbers);
    struct family_origin origin = {"percuss-tables " PERCUSS_VERSION,
                                   (double)(clock() - start) / CLOCKS_PER_SEC, FAMILY_COARSE,
                                   FAMILY_FINE};
    char path[TABLE_PATH_SIZE];
    enum percuss_status status = family_file_save(folder, &samples, &origin, path, fault);
    if (!status)
        printf("the family: error of the force %.2g, %.0f s, %s\n", samples.error, origin.seconds,
               path);
    family_numbers_free(numbers);
    return status;
}

static double processor_seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

/* Whether this table lies in the folder, complete. */
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
    /* saved with its maker and its time */
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
