/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "compare.h"
#include "csv.h"
#include "json_writer.h"
#include "measured_file.h"

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

void compare_print_table(const struct comparison *comparison)
{
    printf("%6s %10s %12s %12s %10s %9s %9s\n", "impact", "speed m/s", "measured e", "simulated e",
           "residual", "measured", "simulated");
    printf("%54s %19s\n", "", "sub-impacts");
    /* impact by impact */
    for (size_t i = 0; i < comparison->set->count; i++) {
        const struct measured_impact *measured = &comparison->set->impacts[i];
        const struct measured_impact *twin = &comparison->twins[i].impact;
        char count[16] = "-";
        if (!isnan(measured->sub_impacts))
            snprintf(count, sizeof count, "%.0f", measured->sub_impacts);
        printf("%6zu %10.5g %12.4f %12.4f %10.4f %9s %9.0f\n", i + 1, measured->speed,
               measured->restitution, twin->restitution, twin->restitution - measured->restitution,
               count, twin->sub_impacts);
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

void compare_print_csv(const struct comparison *comparison, bool units)
{
    csv_head(
        stdout,
        "speed,at,restitution,impulse,sub_impacts,first_impulse,first_duration,second_start,"
        "simulated_restitution,simulated_impulse,simulated_sub_impacts,simulated_first_impulse,"
        "simulated_first_duration,simulated_second_start,residual",
        units);
    putchar('\n');
    for (size_t i = 0; i < comparison->set->count; i++) {
        const struct measured_impact *measured = &comparison->set->impacts[i];
        const struct measured_impact *twin = &comparison->twins[i].impact;
        printf("%.17g,%.17g", measured->speed, measured->at);
        print_csv_of(measured);
        print_csv_of(twin);
        printf(",%.17g\n", twin->restitution - measured->restitution);
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

void compare_print_json(const struct comparison *comparison)
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
    json_print(root);
}
