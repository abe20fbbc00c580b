/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors the orders of service/core/catalogue/mesh_entry.c: bodies whose files are not there, or
 * not yet. */
#include "catalogue/mesh_entry.h"

#include <unistd.h>

#include "unit/catalogue/parse.h"
#include "unit/catalogue/rod_file.h"

static void write_file(const char *name, const char *text)
{
    char path[200];
    snprintf(path, sizeof path, "%s/%s", rod_folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void remove_in_folder(const char *name)
{
    char path[200];
    snprintf(path, sizeof path, "%s/%s", rod_folder, name);
    remove(path);
}

/* The catalogue of one body from a mesh; reduced bodies are in the same folder. */
static struct body_set *ordering(const char *lines)
{
    char text[1000], path[96];
    struct body_set *set;
    struct fault fault = {""};
    snprintf(text, sizeof text,
             "materials:\n  alloy: {young: 75e9, poisson: 0.33, density: 2800, yield: 300e6}\n"
             "bodies:\n  part: {shape: mesh, file: part.inp, %s}\n",
             lines);
    write_file("ordering.yaml", text);
    snprintf(path, sizeof path, "%s/ordering.yaml", rod_folder);
    if (catalogue_load_reducing(path, rod_folder, &set, &fault))
        fail_msg("%s", fault.text);
    return set;
}

/* What these lines order; its texts alone are left. */
static struct body_order order_of(const char *lines)
{
    struct body_set *set = ordering(lines);
    assert_int_equal(set->count, 0);
    assert_int_equal(set->order_count, 1);
    assert_null(body_set_order(set, "other"));
    struct body_order order = *body_set_order(set, "part");
    body_set_free(set);
    return order;
}

/* What who asks for it is told. */
static struct body_news news_of(const char *lines)
{
    struct body_set *set = ordering(lines);
    struct body_news news = body_order_news(body_set_order(set, "part"));
    body_set_free(set);
    return news;
}

static void a_mesh_is_ordered_until_its_body_is_there(void **state)
{
    (void)state;
    char path[200], name[80];
    write_file("part.inp", "*NODE\n");
    /* the same order has the same name, any other another one */
    struct body_order first = order_of("unit: mm, material: alloy");
    struct body_order other = order_of("unit: cm, material: alloy");
    assert_string_equal(order_of("material: alloy, unit: mm, damping: 0.1").name, first.name);
    assert_string_not_equal(other.name, first.name);
    assert_string_not_equal(order_of("unit: mm").name, first.name);
    assert_string_not_equal(order_of("unit: mm, material: alloy, fixed: [low]").name, first.name);
    assert_string_not_equal(order_of("unit: mm, material: alloy, max_frequency: 1e4").name,
                            first.name);
    assert_string_not_equal(order_of("unit: mm, material: alloy, instance: B-1").name, first.name);
    assert_string_not_equal(order_of("unit: mm, material: alloy, raise: true").name, first.name);
    assert_string_equal(order_of("unit: mm, material: alloy, raise: false").name, first.name);
    assert_non_null(strstr(first.material, "yield: 300000000"));
    /* why there is none */
    static const char *const kinds[] = {"failed", "killed"};
    assert_false(first.made);
    for (int i = 0; i < 2; i++) {
        struct body_news news = news_of("unit: mm, material: alloy");
        assert_int_equal(news.status, PERCUSS_BUSY);
        assert_string_equal(news.text, "its mesh waits to be reduced: ask again later");
        snprintf(name, sizeof name, "%s.%s", first.name, kinds[i]);
        write_file(name, "no such set");
        news = news_of("unit: mm, material: alloy");
        assert_int_equal(news.status, PERCUSS_UNKNOWN_BODY);
        assert_string_equal(news.text, "its mesh could not be reduced: no such set");
        remove_in_folder(name);
    }
    /* its body */
    snprintf(path, sizeof path, "%s/%s.h5", rod_folder, first.name);
    assert_int_equal(symlink("rod.h5", path), 0);
    struct body_set *set = ordering("unit: mm, material: alloy");
    assert_true(body_set_order(set, "part")->made);
    near_relative(body_set_find(set, "part")->mass, 2800.0 * M_PI * 1e-4 * 0.3, 1e-14);
    body_set_free(set);
    remove(path);
    /* another mesh in the same place */
    write_file("part.inp", "*NODE\n1, 0, 0, 0\n");
    assert_string_not_equal(order_of("unit: mm, material: alloy").name, first.name);
    remove_in_folder("part.inp");
    remove_in_folder("ordering.yaml");
}

/* Strictly it is refused; a daemon does without the body. */
static void a_file_that_lacks_leaves_its_body_out(void **state)
{
    (void)state;
    char path[96];
    struct body_set *set;
    struct fault fault = {""};
    write_file("lacking.yaml",
               "materials: {steel: {young: 210e9, poisson: 0.3, density: 7800}}\n"
               "bodies:\n"
               "  part: {shape: mesh, file: none.h5, sites: {tip: {point: [0, 0, 0]}}}\n"
               "  ball: {shape: sphere, material: steel, radius: 0.01}\n");
    snprintf(path, sizeof path, "%s/lacking.yaml", rod_folder);
    assert_int_equal(catalogue_load(path, &set, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "lacking.yaml:3: bodies.part.file: "));
    assert_int_equal(catalogue_load_reducing(path, NULL, &set, &fault), PERCUSS_OK);
    assert_true(set->count == 1 && body_set_find(set, "ball") && set->order_count == 1);
    const struct body_order *order = body_set_order(set, "part");
    struct body_news news = body_order_news(order);
    assert_true(order->missing && !order->made && news.status == PERCUSS_UNKNOWN_BODY);
    assert_non_null(strstr(news.text, "its file is missing: "));
    assert_non_null(strstr(news.text, "none.h5: cannot be opened"));
    body_set_free(set);
    /* one that is there and no body is refused all the same */
    write_file("none.h5", "none");
    assert_int_equal(catalogue_load_reducing(path, NULL, &set, &fault), PERCUSS_BAD_REQUEST);
    remove_in_folder("none.h5");
    remove_in_folder("lacking.yaml");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mesh_is_ordered_until_its_body_is_there),
        cmocka_unit_test(a_file_that_lacks_leaves_its_body_out),
    };
    return cmocka_run_group_tests(tests, rod_file_make, rod_file_remove);
}
