/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss bodies: the server's catalogue. */

#include <stdio.h>

#include "cli.h"
#include "json_writer.h"

static json_t *numbers(const double *values, size_t count)
{
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(array, json_number(values[i]));
    return array;
}

static json_t *supports(const struct percuss_body *body)
{
    static const char *const names[] = {"free", "pinned", "clamped"};
    json_t *array = json_array();
    for (int i = 0; i < 2; i++) {
        unsigned support = body->supports[i];
        json_array_append_new(array, json_string(support < 3 ? names[support] : "?"));
    }
    return array;
}

static json_t *sites(const struct percuss_body *body)
{
    json_t *array = json_array();
    for (size_t i = 0; i < body->site_count; i++) {
        json_t *object = json_object();
        json_object_set_new(object, "name", json_string(body->sites[i].name));
        json_object_set_new(object, "point", numbers(body->sites[i].point, 3));
        json_object_set_new(object, "normal", numbers(body->sites[i].normal, 3));
        json_array_append_new(array, object);
    }
    return array;
}

static void print_json(const struct percuss_body_list *list)
{
    json_t *root = json_object(), *array = json_array();
    json_object_set_new(root, "bodies", array);
    for (size_t i = 0; i < list->count; i++) {
        const struct percuss_body *body = &list->bodies[i];
        json_t *object = json_object();
        json_object_set_new(object, "id", json_string(body->id));
        json_object_set_new(object, "shape", json_string(body->shape));
        json_object_set_new(object, "material", json_string(body->material));
        json_object_set_new(object, "mass", json_number(body->mass));
        json_object_set_new(object, "description", json_string(body->description));
        json_object_set_new(object, "half_extents", numbers(body->half_extents, 3));
        json_object_set_new(object, "radius", json_number(body->radius));
        json_object_set_new(object, "tip_radius", json_number(body->tip_radius));
        json_object_set_new(object, "supports", supports(body));
        /* the others under the names that inputs have */
        for (unsigned p = 0; p < PERCUSS_PARAMETER_COUNT; p++)
            if (p != PERCUSS_PARAMETER_RADIUS)
                json_object_set_new(object, percuss_parameter_name(p),
                                    json_number(body->parameters[p]));
        json_object_set_new(object, "inertia", numbers(body->inertia, 3));
        json_object_set_new(object, "products", numbers(body->products, 3));
        json_object_set_new(object, "sites", sites(body));
        json_array_append_new(array, object);
    }
    json_print(root);
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
}

int command_bodies(int argc, char **argv, struct common *common)
{
    struct percuss_client *client;
    struct percuss_body_list list;
    parse_only_common(argc, argv, "Lists the bodies that the server knows.", common);
    int code = open_client(common, NULL, &client);
    if (code != EXIT_ANSWERED)
        return code;
    enum percuss_result result = percuss_bodies(client, common_timeout(common), &list);
    if (result != PERCUSS_RESULT_OK)
        code = complain_result(result);
    else if (common->json)
        print_json(&list);
    else
        print_table(&list);
    percuss_body_list_free(&list);
    percuss_client_free(client);
    return code;
}
