/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss compare: measured impacts beside computed ones. */

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "csv.h"
#include "differences.h"
#include "html_page.h"
#include "json_writer.h"
#include "measured_file.h"
#include "plot.h"
#include "twins.h"
#include "waiting.h"

/* Measured impacts beside their twins: as a table, as CSV, as JSON and as a picture. */

struct comparison {
    const struct scene *scene;
    const char *file;
    const char *title; /* the scene in words */
    const struct measured_set *set;
    const struct twin *twins;
    struct differences differences;
    const struct tally *warnings; /* of the twins */
};

/* p-values below this are called small. */
static const double SMALL = 0.05;

/* Of fewer impacts no order of the values has a p-value that is small: the least of n and n is 2
 * n! n! / (2 n)!, 1/10 of three and 1/35 of four. */
enum { LEAST_IMPACTS = 4 };

static void print_distance(const char *name, const struct distance *distance, size_t impacts)
{
    if (impacts < LEAST_IMPACTS)
        printf("  %-20s %.4g; %zu impact%s too few for a p-value: %d or more are needed\n", name,
               distance->value, impacts, impacts == 1 ? " is" : "s are", LEAST_IMPACTS);
    else
        printf("  %-20s %.4g, p = %.3g%s\n", name, distance->value, distance->p,
               distance->p < SMALL ? ": the distributions differ" : "");
}

/* A single impact has no deviation. */
static void print_moments(const char *name, double mean, double deviation)
{
    printf("  %-20s mean %.4f, ", name, mean);
    if (isnan(deviation))
        puts("of a single impact");
    else
        printf("standard deviation %.4f\n", deviation);
}

/* Whether an interval of any measured restitution is known. */
static bool doubts_known(const struct measured_set *set)
{
    bool known = false;
    for (size_t i = 0; i < set->count; i++)
        known = known || !isnan(set->impacts[i].doubt);
    return known;
}

static void compare_print_table(const struct comparison *comparison)
{
    const bool doubts = doubts_known(comparison->set);
    printf("%6s %10s %12s %s%12s %10s %9s %9s\n", "impact", "speed m/s", "measured e",
           doubts ? "  +- 95 % " : "", "simulated e", "residual", "measured", "simulated");
    printf("%*s %19s\n", doubts ? 63 : 54, "", "sub-impacts");
    /* impact by impact */
    for (size_t i = 0; i < comparison->set->count; i++) {
        const struct measured_impact *measured = &comparison->set->impacts[i];
        const struct measured_impact *twin = &comparison->twins[i].impact;
        char count[16] = "-";
        if (!isnan(measured->sub_impacts))
            snprintf(count, sizeof count, "%.0f", measured->sub_impacts);
        printf("%6zu %10.5g %12.4f ", i + 1, measured->speed, measured->restitution);
        if (doubts)
            printf("%8.2g ", measured_half_width(measured));
        printf("%12.4f %10.4f %9s %9.0f\n", twin->restitution,
               twin->restitution - measured->restitution, count, twin->sub_impacts);
    }
    /* over all of them */
    printf("\n%s on %s, %zu impacts\n", comparison->scene->a, comparison->scene->b,
           comparison->set->count);
    const struct differences *differences = &comparison->differences;
    print_moments("measured e", differences->measured_mean, differences->measured_deviation);
    print_moments("simulated e", differences->simulated_mean, differences->simulated_deviation);
    printf("  %-20s mean %.4f", "residual", differences->residual_mean);
    if (!isnan(differences->residual_half_width))
        printf(" +- %.4f (95 %%)", differences->residual_half_width);
    printf(", root mean square %.4f\n", differences->residual_rms);
    print_distance("Kolmogorov-Smirnov", &differences->kolmogorov, comparison->set->count);
    print_distance("energy distance", &differences->energy, comparison->set->count);
    if (differences->counted > 0)
        printf("  %-20s equal in %zu of %zu impacts\n", "sub-impacts", differences->counts_equal,
               differences->counted);
}

static void print_csv_of(const struct measured_impact *impact)
{
    printf(",%.17g,%.17g,%.17g,%.17g,%.17g,%.17g", impact->restitution, impact->impulse,
           impact->sub_impacts, impact->first_impulse, impact->first_duration,
           impact->second_start);
}

static void compare_print_csv(const struct comparison *comparison, bool units)
{
    csv_head(
        stdout,
        "speed,at,restitution,impulse,sub_impacts,first_impulse,first_duration,second_start,"
        "simulated_restitution,simulated_impulse,simulated_sub_impacts,simulated_first_impulse,"
        "simulated_first_duration,simulated_second_start,residual,restitution_half_width",
        units);
    putchar('\n');
    for (size_t i = 0; i < comparison->set->count; i++) {
        const struct measured_impact *measured = &comparison->set->impacts[i];
        const struct measured_impact *twin = &comparison->twins[i].impact;
        printf("%.17g,%.17g", measured->speed, measured->at);
        print_csv_of(measured);
        print_csv_of(twin);
        printf(",%.17g,%.17g\n", twin->restitution - measured->restitution,
               measured_half_width(measured));
    }
}

static json_t *impact_to_json(const struct measured_impact *impact)
{
    json_t *object = json_object();
    json_object_set_new(object, "restitution", json_number(impact->restitution));
    json_object_set_new(object, "impulse", json_number(impact->impulse));
    json_object_set_new(object, "sub_impacts", json_number(impact->sub_impacts));
    json_object_set_new(object, "first_impulse", json_number(impact->first_impulse));
    json_object_set_new(object, "first_duration", json_number(impact->first_duration));
    json_object_set_new(object, "second_start", json_number(impact->second_start));
    return object;
}

static json_t *moments_to_json(double mean, double deviation)
{
    json_t *object = json_object();
    json_object_set_new(object, "mean", json_number(mean));
    json_object_set_new(object, "standard_deviation", json_number(deviation));
    return object;
}

static json_t *distance_to_json(const struct distance *distance)
{
    json_t *object = json_object();
    json_object_set_new(object, "value", json_number(distance->value));
    json_object_set_new(object, "p", json_number(distance->p));
    return object;
}

static json_t *comparison_to_json(const struct comparison *comparison)
{
    json_t *root = json_object(), *array = json_array(), *residual = json_object();
    /* impact by impact */
    for (size_t i = 0; i < comparison->set->count; i++) {
        const struct measured_impact *measured = &comparison->set->impacts[i];
        const struct twin *twin = &comparison->twins[i];
        json_t *object = json_object();
        json_object_set_new(object, "speed", json_number(measured->speed));
        json_object_set_new(object, "at", json_number(measured->at));
        json_object_set_new(object, "measured", impact_to_json(measured));
        json_object_set_new(object, "simulated", impact_to_json(&twin->impact));
        json_object_set_new(object, "restitution_half_width",
                            json_number(measured_half_width(measured)));
        json_object_set_new(object, "status", json_string(percuss_status_name(twin->status)));
        json_object_set_new(object, "residual",
                            json_number(twin->impact.restitution - measured->restitution));
        json_array_append_new(array, object);
    }
    /* over all of them */
    json_object_set_new(residual, "mean", json_number(comparison->differences.residual_mean));
    json_object_set_new(residual, "half_width",
                        json_number(comparison->differences.residual_half_width));
    json_object_set_new(residual, "root_mean_square",
                        json_number(comparison->differences.residual_rms));
    json_object_set_new(root, "measured",
                        moments_to_json(comparison->differences.measured_mean,
                                        comparison->differences.measured_deviation));
    json_object_set_new(root, "simulated",
                        moments_to_json(comparison->differences.simulated_mean,
                                        comparison->differences.simulated_deviation));
    json_object_set_new(root, "residual", residual);
    json_object_set_new(root, "kolmogorov_smirnov",
                        distance_to_json(&comparison->differences.kolmogorov));
    json_object_set_new(root, "energy_distance", distance_to_json(&comparison->differences.energy));
    json_object_set_new(root, "sub_impacts_known",
                        json_integer((json_int_t)comparison->differences.counted));
    json_object_set_new(root, "sub_impacts_equal",
                        json_integer((json_int_t)comparison->differences.counts_equal));
    json_object_set_new(root, "impacts", array);
    json_object_set_new(root, "left_out", measured_file_left_to_json(comparison->set));
    json_object_set_new(root, "warnings", tally_to_json(comparison->warnings));
    return root;
}

/* The same for the page, and what only that needs. Exit code; complains. */
static int compare_write_page(const char *file, const struct comparison *comparison,
                              const struct common *common)
{
    json_t *data = comparison_to_json(comparison), *errors = json_array();
    bool good = data && errors;
    for (size_t i = 0; good && i < comparison->set->count; i++)
        good = json_array_append_new(errors, json_number(comparison->twins[i].error_total)) == 0;
    json_t *rest = json_pack("{sssosissso}", "kind", "compare", "title",
                             json_text_or_null(comparison->title), "least_impacts", LEAST_IMPACTS,
                             "version", PERCUSS_VERSION, "error_total", errors);
    good = good && rest && json_object_update(data, rest) == 0;
    json_decref(rest);
    if (!good) {
        json_decref(data);
        data = NULL;
    }
    return html_page_write(file, data, NULL, NULL, common);
}

/* The picture of a comparison. */

/* The paper's areas A to D: half, one, one and a half and two deviations about the mean. */
enum { AREAS = 4 };
static const char *const colours[AREAS] = {"#c4c4c4", "#d2d2d2", "#e0e0e0", "#ececec"};

/* The part of the axis of speeds that is left free at either end. */
static const double MARGIN = 0.03;

static void write_impacts(struct plot *plot, const struct comparison *comparison)
{
    plot_table(plot, "impacts",
               "speed,restitution,simulated_restitution,share,sub_impacts,simulated_sub_impacts");
    for (size_t i = 0; i < comparison->set->count; i++) {
        const struct measured_impact *measured = &comparison->set->impacts[i];
        const struct measured_impact *twin = &comparison->twins[i].impact;
        fprintf(plot->data, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", measured->speed,
                measured->restitution, twin->restitution, 1.0 / (double)comparison->set->count,
                measured->sub_impacts, twin->sub_impacts);
    }
}

/* The ranges of the axes. */
struct axes {
    struct plot_range speed, restitution, areas, count;
};

static struct axes take_axes(const struct comparison *comparison)
{
    struct axes axes = {PLOT_NOTHING, PLOT_NOTHING, PLOT_NOTHING, {0.0, 1.0}};
    for (size_t i = 0; i < comparison->set->count; i++) {
        const struct measured_impact *measured = &comparison->set->impacts[i];
        const struct measured_impact *twin = &comparison->twins[i].impact;
        plot_range_take(&axes.speed, measured->speed);
        plot_range_take(&axes.restitution, measured->restitution);
        plot_range_take(&axes.restitution, twin->restitution);
        plot_range_take(&axes.count, measured->sub_impacts);
        plot_range_take(&axes.count, twin->sub_impacts);
    }
    /* areas may reach where no restitution is: below 0 */
    double wide = 0.5 * AREAS * comparison->differences.measured_deviation;
    axes.areas = axes.restitution;
    plot_range_take(&axes.areas, comparison->differences.measured_mean - wide);
    plot_range_take(&axes.areas, comparison->differences.measured_mean + wide);
    plot_range_take(&axes.areas, 0.0);
    axes.count.high += 0.5;
    return axes;
}

/* The areas with their letters on their right, at both of their ends, and the mean. */
static void write_areas(const struct plot *plot, const struct comparison *comparison)
{
    double mean = comparison->differences.measured_mean,
           deviation = comparison->differences.measured_deviation;
    if (!(deviation > 0.0))
        return;
    for (int area = AREAS; area-- > 0;) {
        double half = 0.5 * (area + 1) * deviation, letter = half - 0.25 * deviation;
        fprintf(plot->script,
                "set object rectangle from graph 0, first %.9g to graph 1, first %.9g "
                "fc rgb '%s' fs solid noborder behind\n"
                "set label '%c' at graph 1.012, first %.9g tc rgb '#606060'\n"
                "set label '%c' at graph 1.012, first %.9g tc rgb '#606060'\n",
                mean - half, mean + half, colours[area], 'A' + area, mean + letter, 'A' + area,
                mean - letter);
    }
    fprintf(plot->script,
            "set arrow from graph 0, first %.9g to graph 1, first %.9g nohead lc rgb '#808080'\n",
            mean, mean);
}

/* The legend says from which file the measured ones come. */
static void write_name(const struct plot *plot, const struct comparison *comparison)
{
    plot_text(plot, strcmp(comparison->file, "-") ? plot_file_name(comparison->file) : "measured");
}

static void write_restitution(const struct plot *plot, const struct comparison *comparison,
                              const struct axes *axes)
{
    fputs("set origin 0,0.56\nset size 1,0.41\nset xlabel 'speed / (m/s)'\n"
          "set ylabel 'restitution e'\n",
          plot->script);
    plot_range_set(plot, "xrange", &axes->speed, MARGIN);
    plot_range_set(plot, "yrange", &axes->areas, 0.04);
    write_areas(plot, comparison);
    fputs("plot @impacts using 1:2:(0):($3-$2) with vectors nohead lc rgb '#909090' lw 1 notitle, "
          "'' using 1:2 with points lt 2 title ",
          plot->script);
    write_name(plot, comparison);
    fputs(", '' using 1:3 with points lt 1 title 'simulated'", plot->script);
    if (comparison->differences.measured_deviation > 0.0)
        fputs(", keyentry with lines lc rgb '#808080' lw 1 title 'mean of the measured', "
              "keyentry with boxes fs solid noborder lc rgb '#d2d2d2' "
              "title 'A to D: ± 0.5, 1, 1.5, 2 σ'",
              plot->script);
    fputs("\nunset object\nunset label\nunset arrow\n", plot->script);
}

static void write_counts(const struct plot *plot, const struct comparison *comparison,
                         const struct axes *axes)
{
    fputs("set origin 0,0.29\nset size 1,0.27\nset ytics 1\nset ylabel 'sub-impacts'\n",
          plot->script);
    plot_range_set(plot, "yrange", &axes->count, 0.0);
    fputs("plot @impacts using 1:5 with points lt 2 title ", plot->script);
    write_name(plot, comparison);
    fputs(", '' using 1:6 with points lt 1 pt 6 ps 1.4 title 'simulated'\nset ytics autofreq\n",
          plot->script);
}

static void write_distributions(const struct plot *plot, const struct comparison *comparison,
                                const struct axes *axes)
{
    fputs("set origin 0,0.01\nset size 1,0.28\nset xlabel 'restitution e'\n"
          "set ylabel 'share of impacts below'\nset yrange [0:1.02]\n",
          plot->script);
    plot_range_set(plot, "xrange", &axes->restitution, MARGIN);
    fputs("plot @impacts using 2:4 smooth cumulative with steps lt 2 title ", plot->script);
    write_name(plot, comparison);
    fputs(", '' using 3:4 smooth cumulative with steps lt 1 title 'simulated'\n", plot->script);
}

/* The restitution and the number of sub-impacts against the speed, and both empirical
 * distributions. Exit code; complains. */
static int compare_plot(const struct plot_output *output, const struct comparison *comparison)
{
    struct plot plot;
    char title[600];
    int code = plot_begin(&plot, output, 1000, 1200);
    if (code != EXIT_ANSWERED)
        return code;
    write_impacts(&plot, comparison);
    snprintf(title, sizeof title, "%s: %zu impacts", comparison->title, comparison->set->count);
    fputs("set multiplot title ", plot.script);
    plot_text(&plot, title);
    fputs("\nset lmargin 10\nset rmargin 4\n", plot.script);
    /* restitution over speed, joined to its twin, on areas of the measured deviation; how many
     * sub-impacts; both distributions */
    const struct axes axes = take_axes(comparison);
    write_restitution(&plot, comparison, &axes);
    write_counts(&plot, comparison, &axes);
    write_distributions(&plot, comparison, &axes);
    fputs("unset multiplot\n", plot.script);
    return plot_end(&plot);
}

enum { KEY_CSV = OPTION_OWN, KEY_PERMUTATIONS, KEY_SEED, KEY_HTML };
enum { DEFAULT_PERMUTATIONS = 1999, MOST_PERMUTATIONS = 1000000, MOST_SEED = 1u << 31 };

struct compare {
    struct common *common;
    struct scene scene;
    const char *file;
    struct plot_output plot;
    const char *html; /* file of a page; NULL: none */
    struct column_map columns;
    bool csv;
    unsigned permutations, seed;
};

static const struct argp_option options[] = {
    {"csv", KEY_CSV, NULL, 0, "print the impacts as comma-separated values", 90},
    {"html", KEY_HTML, "FILE", 0,
     "write a page for a browser: measured and simulated restitutions with their errors, "
     "residuals, "
     "distributions; - is standard output",
     40},
    {"permutations", KEY_PERMUTATIONS, "N", 0,
     "random permutations behind the p-value of the energy distance (default 1999)", 40},
    {"seed", KEY_SEED, "N", 0, "of the permutations (default 1)", 40},
    {0},
};

static void compare_check(const struct compare *compare, struct argp_state *state)
{
    scene_check_single(&compare->scene, state);
    const struct scene_need file = {"MEASURED.csv", compare->file};
    scene_check_given(&compare->scene, &file, 1, "", state);
    if (compare->csv && compare->common->json)
        argp_error(state, "--csv or --json, not both");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct compare *compare = state->input;
    switch (key) {
    /* options that all commands share */
    case ARGP_KEY_INIT:
        measured_scene_inputs(
            state, (void *[]){&compare->scene, compare->common, &compare->plot, &compare->columns});
        return 0;
    /* the output */
    case KEY_CSV:
        compare->csv = true;
        return 0;
    case KEY_HTML:
        compare->html = html_page_file(text, state);
        return 0;
    /* the test by permutations */
    case KEY_PERMUTATIONS:
        compare->permutations = parse_count("permutations", text, MOST_PERMUTATIONS, state);
        return 0;
    case KEY_SEED:
        compare->seed = parse_count("seed", text, MOST_SEED, state);
        return 0;
    /* the file of measured impacts */
    case ARGP_KEY_ARG:
        if (compare->file)
            argp_error(state, "one file is needed, not '%s' as well", text);
        compare->file = text;
        return 0;
    /* all are read */
    case ARGP_KEY_END:
        compare_check(compare, state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

const struct argp compare_argp = {
    .options = options,
    .parser = parse,
    .args_doc = "MEASURED.csv",
    .doc =
        "Puts measured impacts beside their simulated twins: residuals, and how different the two "
        "distributions of the restitution are.\v"
        "MEASURED.csv, or - for standard input, has a line of column names: speed, restitution "
        "and optionally impulse, sub_impacts, first_impulse, first_duration, second_start, at; or "
        "history, the name of a file with the columns time and velocity_a (or displacement_a), "
        "from which the others follow. Separators are commas, semicolons, tabs or blanks; units "
        "may stand in the names, as in speed [mm/s]. percuss(1) says more.\n"
        "Example: percuss compare measured.csv --a steel-sphere --b al-beam --plot measured.svg",
    .children = measured_scene_children,
};

static int report(const struct compare *compare, const struct comparison *comparison)
{
    if (compare->common->json)
        json_print(comparison_to_json(comparison));
    else if (compare->csv)
        compare_print_csv(comparison, compare->common->units);
    else
        compare_print_table(comparison);
    if (!compare->common->json)
        tally_complain(comparison->warnings);
    int code = EXIT_ANSWERED;
    if (plot_wanted(&compare->plot))
        code = compare_plot(&compare->plot, comparison);
    if (code == EXIT_ANSWERED && compare->html)
        code = compare_write_page(compare->html, comparison, compare->common);
    return code;
}

static int run(const struct compare *compare, struct twins *twins, struct measured_set *set)
{
    struct twin *list = calloc(set->count, sizeof *list);
    const struct scene_text text = scene_describe(&compare->scene, &twins->bodies);
    struct comparison comparison = {.scene = &compare->scene,
                                    .file = compare->file,
                                    .title = text.title,
                                    .set = set,
                                    .twins = list,
                                    .warnings = &twins->warnings};
    int code = list ? twins_ask(twins, set, &(struct twin_changes){.faster = 1.0}, list)
                    : complain_memory();
    waiting_end();
    if (code == EXIT_ANSWERED)
        code = twins_complete(twins, set, list);
    if (code == EXIT_ANSWERED)
        code = differences_find(set, list, compare->permutations, compare->seed,
                                &comparison.differences)
                   ? report(compare, &comparison)
                   : complain_memory();
    free(list);
    return code;
}

int command_compare(int argc, char **argv, struct common *common)
{
    struct compare compare = {.common = common,
                              .scene = scene_straight(),
                              .permutations = DEFAULT_PERMUTATIONS,
                              .seed = 1};
    struct measured_set set;
    struct twins twins;
    argp_parse(&compare_argp, argc, argv, 0, NULL, &compare);
    /* the measured impacts */
    int code = measured_file_read(compare.file, &compare.columns, &set);
    if (code != EXIT_ANSWERED)
        return code;
    /* its twins, and how far they are from it */
    code = twins_open(&twins, common, &compare.scene);
    if (code == EXIT_ANSWERED) {
        code = run(&compare, &twins, &set);
        twins_close(&twins);
    }
    measured_set_free(&set);
    return code;
}
