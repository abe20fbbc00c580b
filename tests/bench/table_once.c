/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Warm solves of the paper's sphere on rod 1 by Hertz's law or a table, for counting instructions:
 * table_cost.sh. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "catalogue/catalogue.h"
#include "counting.h"
#include "solve/solve.h"
#include "store/table_store.h"

/* What is counted: everything this function does and calls. */
__attribute__((noinline)) enum percuss_status counted_solve(struct solve_workspace *workspace,
                                                            const struct solve_context *means,
                                                            const struct solve_request *request,
                                                            struct solve_result *result);

enum percuss_status counted_solve(struct solve_workspace *workspace,
                                  const struct solve_context *means,
                                  const struct solve_request *request, struct solve_result *result)
{
    return solve(workspace, means, request, result);
}

static void complain(const struct fault *fault)
{
    fprintf(stderr, "table_once: %s\n", fault->text);
}

static struct solve_request blow(enum percuss_contact_model model, double tolerance)
{
    struct solve_request request = {
        .body_count = 2,
        .contact_count = 1,
        .bodies = {{.id = "steel-sphere",
                    .position = {0.515, 0.0, 0.0},
                    .orientation = {1.0, 0.0, 0.0, 0.0},
                    .velocity = {-0.3, 0.0, 0.0}},
                   {.id = "al-rod-1", .orientation = {1.0, 0.0, 0.0, 0.0}}},
        .contacts = {{.a = 0, .b = 1, .point = {0.5, 0.0, 0.0}, .normal = {1.0, 0.0, 0.0}}},
        .options = {.tolerance = tolerance, .contact_model = model},
    };
    return request;
}

/* table_once CONFIG_FOLDER hertz|table TOLERANCE */
int main(int argc, char **argv)
{
    static struct solve_result result;
    struct body_set *set = NULL;
    struct fault fault;
    char path[4096];
    size_t count;
    if (argc != 4) {
        fprintf(stderr, "usage: table_once CONFIG_FOLDER hertz|table TOLERANCE\n");
        return 2;
    }
    struct table_store *store = table_store_create();
    struct solve_workspace *workspace = solve_workspace_create();
    snprintf(path, sizeof path, "%s/catalogue.yaml", argv[1]);
    enum percuss_status status = catalogue_load(path, &set, &fault);
    snprintf(path, sizeof path, "%s/tables", argv[1]);
    if (!status)
        status = table_store_load(store, path, complain, &count, &fault);
    if (status) {
        complain(&fault);
        return EXIT_FAILURE;
    }
    const struct solve_context means = {set, table_store_source(store), {0}};
    bool table = strcmp(argv[2], "table") == 0;
    struct solve_request request =
        blow(table ? PERCUSS_CONTACT_TABLE : PERCUSS_CONTACT_HERTZ, strtod(argv[3], NULL));
    for (int i = 0; i < 2 && !status; i++)
        status = solve(workspace, &means, &request, &result);
    counting_begins();
    if (!status)
        status = counted_solve(workspace, &means, &request, &result);
    printf("%s %s: e = %.9f\n", argv[2], argv[3], result.contacts[0].restitution);
    solve_workspace_free(workspace);
    table_store_free(store);
    body_set_free(set);
    return status ? EXIT_FAILURE : EXIT_SUCCESS;
}
