/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tabulates the paper's sphere on a rod of a yield stress and prints the curves as CSV:
 * branch,indentation,force (branch 0: loading, from there on: unloading), and on stderr what it
 * took. usage: indentation [YIELD [INDENTATION [RESOLUTION]]] > curves.csv */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "fe/indentation.h"

int main(int count, char **arguments)
{
    double yield = count > 1 ? atof(arguments[1]) : 205e6;
    double largest = count > 2 ? atof(arguments[2]) : 3e-5;
    size_t resolution = count > 3 ? (size_t)atoi(arguments[3]) : 12;
    struct region_input input = {{{"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0},
                                  {"aluminium", 70e9, 0.33, 2700.0, yield, 0.0}},
                                 0.015,
                                 largest,
                                 resolution,
                                 0.0};
    struct indentation_table table;
    struct fault fault;
    clock_t start = clock();
    if (indentation_table_make(&input, NULL, &table, &fault) != PERCUSS_OK) {
        fprintf(stderr, "%s\n", fault.text);
        return 1;
    }
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    printf("branch,indentation,force\n");
    for (size_t i = 0; i < table.points; i++)
        printf("0,%.9g,%.9g\n", table.indentation[i], table.force[i]);
    for (size_t k = 1; k < table.branches; k++)
        for (size_t j = 0; j < INDENTATION_SAMPLES; j++)
            printf("%zu,%.9g,%.9g\n", k,
                   table.residual[k] + table.recovery[k * INDENTATION_SAMPLES + j] *
                                           (table.largest[k] - table.residual[k]),
                   indentation_fraction(j) * table.largest_force[k]);
    fprintf(
        stderr,
        "%zu points, %zu branches, errors: force %.2g, residual %.2g, recovery %.2g; %zu nodes, "
        "%.1f s\n",
        table.points, table.branches, table.force_error, table.residual_error, table.recovery_error,
        table.nodes, seconds);
    indentation_table_free(&table);
    return 0;
}
