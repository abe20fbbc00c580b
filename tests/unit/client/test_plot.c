/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/cli/plot.c: the tables and the script of a folder, and what may stand in a text. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "plot.h"

/* The whole of FOLDER/name; the file goes. */
static char *taken(const char *folder, const char *name)
{
    static char text[1 << 14];
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    unlink(path);
    return text;
}

/* A folder that is there, or one level of it that is not. */
static void writes_tables_and_script(void **state)
{
    (void)state;
    char above[] = "/tmp/percuss-plot-XXXXXX", folder[64];
    assert_non_null(mkdtemp(above));
    snprintf(folder, sizeof folder, "%s/new", above);
    for (int again = 0; again < 2; again++) {
        struct plot plot;
        const struct plot_output output = {NULL, folder};
        assert_int_equal(plot_begin(&plot, &output, 400, 300), 0);
        plot_table(&plot, "first", "time,force");
        fputs("1,2\n", plot.data);
        fputs("plot @first using 1:2 title ", plot.script);
        plot_text(&plot, "a 'b' @first $first `ls`\n\"c\"");
        fputc('\n', plot.script);
        plot_table(&plot, "second", "time");
        fputs("3\n4\n", plot.data);
        assert_int_equal(plot_end(&plot), 0);
        /* each table has its rows, and the script names both files */
        assert_string_equal(taken(folder, "first.csv"), "time,force\n1,2\n");
        assert_string_equal(taken(folder, "second.csv"), "time\n3\n4\n");
        const char *script = taken(folder, "plot.gp");
        assert_non_null(strstr(script, "set output 'plot.png'\n"));
        assert_non_null(strstr(script, "first = \"'first.csv'\"\nsecond = \"'second.csv'\"\n"));
        assert_non_null(strstr(script, "title 'a ''b'' @first $first `ls`'.\"\\n\".'\"c\"'\n"));
    }
    rmdir(folder);
    rmdir(above);
}

/* PDF as large as the pixels at 96 an inch, beside a folder that calls it by its name alone. */
static void draws_and_keeps_the_script(void **state)
{
    (void)state;
    char folder[] = "/tmp/percuss-plot-XXXXXX", file[64];
    assert_non_null(mkdtemp(folder));
    snprintf(file, sizeof file, "%s/some picture.pdf", folder);
    struct plot plot;
    const struct plot_output output = {file, folder};
    assert_int_equal(plot_begin(&plot, &output, 960, 480), 0);
    plot_table(&plot, "data", "x,y");
    fputs("0,1\n1,2\n", plot.data);
    fputs("plot @data using 1:2 with lines title 'y'\n", plot.script);
    assert_int_equal(plot_end(&plot), 0);
    assert_memory_equal(taken(folder, "some picture.pdf"), "%PDF", 4);
    const char *script = taken(folder, "plot.gp");
    assert_non_null(strstr(script, "pdfcairo noenhanced size 10in,5in"));
    assert_non_null(strstr(script, "set output 'some picture.pdf'\n"));
    taken(folder, "data.csv");
    assert_int_equal(rmdir(folder), 0);
}

/* A folder in which nothing can be written. */
static void tells_of_a_failure(void **state)
{
    (void)state;
    struct plot plot;
    const struct plot_output output = {NULL, "/proc/none"};
    assert_int_equal(plot_begin(&plot, &output, 400, 300), 0);
    plot_table(&plot, "data", "x");
    assert_int_not_equal(plot_end(&plot), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(writes_tables_and_script),
        cmocka_unit_test(draws_and_keeps_the_script),
        cmocka_unit_test(tells_of_a_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
