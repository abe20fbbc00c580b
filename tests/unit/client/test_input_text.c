/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors client/cli/input_text.c: distributions and columns of numbers as people write them. */
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "input_text.h"

static void distributions(void **state)
{
    (void)state;
    struct percuss_input input = {.name = "speed"};
    struct input_fault fault;
    assert_true(input_text_distribution("0.3", &input, &fault));
    assert_int_equal(input.distribution, PERCUSS_DISTRIBUTION_CONSTANT);
    assert_true(input.first == 0.3 && isnan(input.lower));
    assert_true(input_text_distribution("uniform:0.1:0.4", &input, &fault));
    assert_int_equal(input.distribution, PERCUSS_DISTRIBUTION_UNIFORM);
    assert_true(input.first == 0.1 && input.second == 0.4);
    assert_true(input_text_middle(&input) == 0.25);
    strcpy(input.name, "young");
    assert_true(input_text_distribution("normal:70e9:1e9", &input, &fault));
    assert_true(input.second == 1e9 && isnan(input.upper));
    strcpy(input.name, "site");
    assert_true(input_text_distribution("log-normal:2:1:0.5:9", &input, &fault));
    assert_int_equal(input.distribution, PERCUSS_DISTRIBUTION_LOG_NORMAL);
    assert_true(input.lower == 0.5 && input.upper == 9.0);
}

static void wrong_distributions(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        "",          "uniform", "uniform:1",        "normal:1:2:3", "uniform:1:2x", "normal:nan:1",
        "gamma:1:2", "0.3:0.4", "uniform:1:2:3:4:5"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct percuss_input input = {.name = "speed"};
        struct input_fault fault = {""};
        assert_false(input_text_distribution(wrong[i], &input, &fault));
        assert_true(strlen(fault.text) > 10);
    }
}

/* In units of what the name says, to the bit what SI units give. */
static void units(void **state)
{
    (void)state;
    struct percuss_input input;
    struct input_fault fault;
    assert_true(
        input_text_read("young@al-beam=normal:70 GPa:0.7GPa:68e9:72 kN/mm^2", &input, &fault));
    assert_true(input.first == 70e9 && input.second == 0.7e9);
    assert_true(input.lower == 68e9 && input.upper == 72e9);
    assert_true(input_text_read("radius@steel-sphere=9mm", &input, &fault));
    assert_true(input.distribution == PERCUSS_DISTRIBUTION_CONSTANT && input.first == 0.009);
    assert_true(
        input_text_read("density@steel-sphere=uniform:7.7 g/cm^3:7.8 g/cm^3", &input, &fault));
    assert_true(input.first == 7700.0 && input.second == 7800.0);
    /* of another quantity, or of none */
    assert_false(input_text_read("young@al-beam=70 mm", &input, &fault));
    assert_non_null(strstr(fault.text, "a stress is needed, in Pa or with a unit, such as 70 GPa"));
    assert_non_null(strstr(fault.text, "mm is no stress"));
    assert_false(input_text_read("radius@steel-sphere=uniform:8 mm:9 mn", &input, &fault));
    assert_non_null(strstr(fault.text, "mn is no unit that is known"));
    assert_false(input_text_read("poisson@al-beam=0.3 m/m", &input, &fault));
    assert_non_null(strstr(fault.text, "without a unit"));
}

static void names(void **state)
{
    (void)state;
    struct percuss_input input;
    struct input_fault fault;
    assert_true(input_text_read("young@al-beam=normal:70e9:1e9", &input, &fault));
    assert_string_equal(input.name, "young");
    assert_string_equal(input.body, "al-beam");
    assert_true(input_text_read("direction=0.1", &input, &fault));
    assert_string_equal(input.name, "direction");
    assert_string_equal(input.body, "");
    /* as --fit writes it; an id may have either sign */
    assert_true(input_text_read("young:al-beam=uniform:69e9:71e9", &input, &fault));
    assert_string_equal(input.name, "young");
    assert_string_equal(input.body, "al-beam");
    assert_true(input_text_read("young@al:beam=70e9", &input, &fault));
    assert_string_equal(input.body, "al:beam");
    assert_true(input_text_read("young:al@beam=70e9", &input, &fault));
    assert_string_equal(input.body, "al@beam");
    assert_true(input_text_read("at@al-beam=0.3", &input, &fault));
    assert_string_equal(input.name, "site");
    /* a name that is none is what is wrong, whatever stands behind it */
    assert_false(input_text_read("youngs@al-beam=normal:70GPa:1GPa", &input, &fault));
    assert_non_null(strstr(fault.text, "'youngs' is none of speed, direction, "));
    assert_non_null(strstr(fault.text, ": did you mean 'young'?"));
    assert_false(input_text_read("mass@al-beam=1 kg", &input, &fault));
    assert_non_null(strstr(fault.text, "'mass' is none of"));
    assert_null(strstr(fault.text, "did you mean"));
    /* one of a server that knows more */
    assert_true(input_text_read("colour@al-beam=1", &input, &fault));
    assert_string_equal(input.name, "colour");
    assert_false(input_text_read("young", &input, &fault));
    char longer[200] = "";
    memset(longer, 'x', 100);
    strcpy(longer + 100, "=1");
    assert_false(input_text_read(longer, &input, &fault));
}

/* The column of a file with that content. */
static double *column(const char *content, const char *name, size_t *count,
                      struct input_fault *fault)
{
    char file[] = "/tmp/percuss-column-XXXXXX";
    int handle = mkstemp(file);
    assert_true(handle >= 0 && write(handle, content, strlen(content)) >= 0);
    close(handle);
    double *values = input_text_column(file, name, count, fault);
    unlink(file);
    return values;
}

static void columns(void **state)
{
    (void)state;
    static const char table[] = "# a comment\n\"speed\",e\n0.1, 0.7\r\n\n0.2,0.6\n";
    struct input_fault fault;
    size_t count;
    double *values = column(table, "speed", &count, &fault);
    assert_int_equal(count, 2);
    assert_true(values[0] == 0.1 && values[1] == 0.2);
    free(values);
    values = column(table, "2", &count, &fault);
    assert_int_equal(count, 2);
    assert_true(values[0] == 0.7 && values[1] == 0.6);
    free(values);
    values = column("3\n1\n2", NULL, &count, &fault);
    assert_int_equal(count, 3);
    assert_true(values[2] == 2.0);
    free(values);
}

static void wrong_columns(void **state)
{
    (void)state;
    struct input_fault fault;
    size_t count;
    assert_null(column("speed,e\n0.1,0.7\n", "v", &count, &fault));
    assert_non_null(strstr(fault.text, "no column 'v' in line 1"));
    assert_null(column("0.1\nx\n", NULL, &count, &fault));
    assert_non_null(strstr(fault.text, "line 2: 'x' is not a number"));
    assert_null(column("0.1,2\n0.3\n", "2", &count, &fault));
    assert_non_null(strstr(fault.text, "line 2"));
    assert_null(column("speed\n", NULL, &count, &fault));
    assert_non_null(strstr(fault.text, "no numbers"));
    assert_null(input_text_column("/nowhere/at/all", NULL, &count, &fault));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distributions), cmocka_unit_test(wrong_distributions),
        cmocka_unit_test(units),         cmocka_unit_test(names),
        cmocka_unit_test(columns),       cmocka_unit_test(wrong_columns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
