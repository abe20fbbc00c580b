/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/measured/impact.c and table.c, which reads its file. One set of impacts in the
 * shapes in which programs of rigs write it, and all that is wrong with a file at once. */
#include "files.h"
#include "impact.h"

static struct measured_remarks remarks;

/* Reads it with the choices, each behind a bar. */
static bool read_with(const char *path, const char *choices, struct measured_set *set)
{
    struct column_map map = {0};
    struct measured_fault fault;
    char copy[200], *rest = copy;
    snprintf(copy, sizeof copy, "%s", choices);
    for (char *choice; (choice = strtok_r(rest, "|", &rest));)
        if (!column_map_add(&map, choice, &fault))
            fail_msg("%s", fault.text);
    remarks = (struct measured_remarks){0};
    return measured_read(path, &map, set, &remarks);
}

/* Speeds 0.2, 0.25, 0.3; restitutions 0.5, 0.51, 0.52; one sub-impact, one, not known; first
 * impulses 0.025, 0.0315, 0.0378: to the bit. */
static void is_the_set(const char *text, const char *choices)
{
    static const double expected[3][4] = {
        {0.2, 0.5, 1.0, 0.025}, {0.25, 0.51, 1.0, 0.0315}, {0.3, 0.52, NAN, 0.0378}};
    struct measured_set set;
    if (!read_with(files_text("good.csv", text), choices, &set))
        fail_msg("%s\n%s", text, remarks.error[0].text);
    assert_int_equal(set.count, 3);
    for (int i = 0; i < 3; i++) {
        const struct measured_impact *impact = &set.impacts[i];
        assert_true(impact->speed == expected[i][0]);
        assert_true(impact->restitution == expected[i][1]);
        assert_true(i == 2 ? isnan(impact->sub_impacts) : impact->sub_impacts == expected[i][2]);
        assert_true(impact->first_impulse == expected[i][3]);
        assert_true(isnan(impact->second_start));
    }
    measured_set_free(&set);
}

static void reads_the_shapes_of_rigs(void **state)
{
    (void)state;
    is_the_set("# from the rig\nspeed,restitution, sub_impacts,first_impulse\n"
               "0.2,0.5,1,0.025\r\n\n0.25,0.51,1,0.0315\n# touched\n0.3,0.52,nan,0.0378",
               "");
    /* a German spreadsheet: byte order mark, semicolons, decimal commas, a line of units, a
     * column of words, an empty row */
    is_the_set("\xEF\xBB\xBF"
               "Speed;Restitution;Sub-Impacts;First Impulse;Bediener\r\nmm/s;-;-;mNs;\r\n"
               "200;0,5;1;25;M\xC3\xBCller\r\n250;0,51;1;31,5;\r\n;;;;\r\n300;0,52;#NV;37,8;x\r\n",
               "");
    /* a measuring program: lines about the rig, tabs, units in the headings */
    is_the_set("Rig 7\tMay\nOperator\tJ. Doe\n\n"
               "speed [mm/s]\trestitution (%)\tsub impacts\tfirst_impulse / (g m/s)\n"
               "200\t50\t1\t25\n250\t51\t1\t31.5\n300\t52\t\t37.8\n",
               "");
    /* words about the rig that are names of columns as well */
    is_the_set("Speed;200 to 300 mm/s\nHistory;none\nSub-Impacts;Restitution\n1;0,5\n"
               "speed;restitution;sub_impacts;first_impulse\n0,2;0,5;1;0,025\n"
               "0,25;0,51;1;0,0315\n0,3;0,52;;0,0378\n",
               "");
    /* numpy.savetxt with a header */
    is_the_set("# speed restitution sub_impacts first_impulse\n2.0e-01 5.0e-01 1.0e+00 2.5e-02\n"
               "2.5e-01 5.1e-01 1.0e+00 3.15e-02\n3.0e-01 5.2e-01 nan 3.78e-02\n",
               "");
    /* and without, columns by number */
    is_the_set("0.5;200;1;25\n0.51;250;1;31.5\n0.52;300;;37.8\n",
               "restitution=1|speed=2:mm/s|sub_impacts=3|first_impulse=4:mN s");
    is_the_set("e;v\n-;mm/s;-;mNs\n0.5;200;1;25\n0.51;250;1;31.5\n0.52;300;;37.8\n",
               "restitution=1|speed=2|sub_impacts=3|first_impulse=4");
    /* decimal commas within quotes */
    is_the_set("\"speed\",\"restitution\",\"sub_impacts\",\"first_impulse\"\n"
               "\"0,2\",\"0,5\",\"1\",\"0,025\"\n\"0,25\",\"0,51\",\"1\",\"0,0315\"\n"
               "\"0,3\",\"0,52\",\"\",\"0,0378\"\n",
               "");
    /* names of the rig's own, in another order, units said by hand or in the cells */
    is_the_set("n,v,e,J1\n1,200,0.5,25 mN s\n1,250,0.51,31.5 mN s\n,300,0.52,37.8 mN s\n",
               "speed=V:mm/s|restitution=e|sub_impacts=n|first_impulse=J1");
    /* shares with a sign in the cell, of a heading with one and of one without */
    is_the_set("speed,restitution,sub_impacts,first_impulse\n"
               "0.2,50 %,1,0.025\n0.25,51%,1,0.0315\n0.3,0.52,,0.0378\n",
               "");
    is_the_set("speed;restitution (%);sub_impacts;first_impulse\n"
               "0,2;50;1;0,025\n0,25;51,0 %;1;0,0315\n0,3;52;;0,0378\n",
               "");
    /* the speed of separation */
    is_the_set("speed [mm/s],v_out [mm/s],sub_impacts,first_impulse\n"
               "200,100,1,0.025\n250,127.5,1,0.0315\n300,156,,0.0378\n",
               "");
    is_the_set("v;w;sub_impacts;first_impulse\n"
               "0.2;10 cm/s;1;0.025\n0.25;12.75 cm/s;1;0.0315\n0.3;15.6 cm/s;;0.0378\n",
               "speed=v|v_out=w");
    /* Windows-1252 */
    is_the_set("speed;restitution;sub_impacts;first_impulse [\xB5N\xB7s]\n0.2;0.5;1;25000\n"
               "0.25;0.51;1;31500\n0.3;0.52;;37800\n",
               "");
}

static void says_how_it_understood_them(void **state)
{
    (void)state;
    struct measured_set set;
    assert_true(read_with(files_text("notes.csv", "sep=;\nspeed;restitution;colour;mood\n"
                                                  "0.2;0.5;;\n;0.5;;\n0.3;;;\n0.4;0.5;;\n;;x;\n"),
                          "", &set));
    assert_int_equal(set.count, 2);
    assert_int_equal(set.left_count, 3);
    assert_int_equal(set.left[1].line, 5);
    assert_string_equal(set.left[1].reason, "no restitution, v_out, impulse or history");
    assert_int_equal(remarks.notes, 3);
    assert_true(files_say(remarks.note, 3,
                          "notes.csv: 3 of 5 rows left out: no speed in lines 4 "
                          "and 7; no restitution, v_out, impulse or history in line 5"));
    assert_true(files_say(remarks.note, 3, "columns that are not read: 'colour', 'mood'"));
    assert_true(files_say(remarks.note, 3, "above the headings in line 2 is not read"));
    measured_set_free(&set);
    /* a spreadsheet's sign for nothing begins no comment */
    assert_true(read_with(files_text("sign.csv", "speed,restitution\n0.1,0.5\n#N/A,0.5\n#n,0.5\n"),
                          "", &set));
    assert_int_equal(set.left_count, 1);
    assert_int_equal(set.left[0].line, 3);
    measured_set_free(&set);
    /* only the first ten are named */
    char text[400] = "speed,restitution\n0.1,0.5\n";
    for (int i = 0; i < 12; i++)
        strcat(text, "0.1,-\n");
    assert_true(read_with(files_text("many.csv", text), "", &set));
    assert_true(files_say(remarks.note, remarks.notes, "12 and 2 more"));
    measured_set_free(&set);
    /* what is possible but improbable, once a column */
    assert_true(read_with(files_text("fast.csv", "speed,restitution,v_out\n0.1,0.5,\n200,1.02,\n"
                                                 "300,0.5,\n1,,1.5\n"),
                          "", &set));
    assert_int_equal(remarks.notes, 2);
    assert_true(files_say(remarks.note, 2,
                          "fast.csv:3: speed: 200: above 100, as in 1 more rows: is a unit "
                          "missing, such as mm/s? (column 1)"));
    assert_true(files_say(remarks.note, 2,
                          "fast.csv:3: restitution: 1.02: above 1, as in 1 more rows: only a body "
                          "that vibrated before the impact gives so much back (column 2)"));
    assert_true(set.impacts[3].restitution == 1.5);
    measured_set_free(&set);
    /* a plain file needs no words */
    assert_true(read_with(files_text("plain.csv", "speed,restitution\n0.1,0.5\n"), "", &set));
    assert_int_equal(remarks.notes, 0);
    measured_set_free(&set);
}

static void refuse_with(const char *text, const char *choices, size_t errors, const char *words)
{
    struct measured_set set;
    if (read_with(files_text("bad.csv", text), choices, &set))
        fail_msg("accepted: %s", text);
    assert_int_equal(remarks.errors, errors);
    assert_true(files_say(remarks.error, errors, words));
    assert_int_equal(set.count, 0);
}

static void refuse(const char *text, const char *words)
{
    refuse_with(text, "", 1, words);
}

static void refuses_files_without_impacts(void **state)
{
    (void)state;
    refuse("", "bad.csv: empty: a line of column names is needed");
    refuse("# nothing\n;;\n", "empty");
    refuse("place,colour\n1,2\n",
           "bad.csv:1: column 'speed': missing, and all that may be there (speed, "
           "restitution");
    refuse_with("v,e\n1,2\n", "speed=w", 1, "(speed (as 'w'), restitution");
    refuse_with("v,e\n1,2\n", "speed=w|restitution=e", 1,
                "--column speed=w: no such column: there are 'v', 'e'");
    refuse("0.2,0.7\n0.3,0.6\n",
           "there are '0.2', '0.7', which are no headings; --column NAME=NUMBER says which is "
           "which: --column speed=1 --column restitution=2");
    refuse_with("v,e\n1,2\n", "speed=7|restitution=e", 1, "--column speed=7: no such column");
    refuse("e,\x1b[2J\n1,2\n", "'e', '?[2J'");
    refuse("speed,restitution\n", "no impacts");
    refuse("speed,restitution\n0.1,\n", "no impacts");
    refuse("restitution\n0.5\n",
           "column 'speed', 'drop' or 'history': missing; there are 'restitution'");
    refuse("speed\n0.5\n",
           "column 'restitution', 'v_out', 'rebound', 'impulse' or 'history': missing; there are");
    refuse("speed,restitution,Speed\n1,0.5,1\n", "bad.csv:1: columns 1 and 3 are both 'speed'");
    struct measured_set set;
    assert_false(read_with("/nowhere/a.csv", "", &set));
    assert_true(files_say(remarks.error, 1, "/nowhere/a.csv: No such file"));
}

static void refuses_bad_values(void **state)
{
    (void)state;
    refuse("speed,restitution\n0.1,0.5\n0.1\n", "bad.csv:3: 1 values: must be 2, one a column");
    refuse("speed,restitution\n0.1,0.5\n0,1,0,5\n",
           "bad.csv:3: 4 values: must be 2, one a column (decimal commas need another separator");
    refuse("speed,restitution\n0.1,half\n",
           "bad.csv:2: restitution: 'half': must be a finite number, empty or nan (column 2)");
    refuse("speed,restitution\n0.1,inf\n", "bad.csv:2: restitution: 'inf': must be a finite");
    refuse("speed [mm/s],restitution\n-0.1,0.5\n",
           "bad.csv:2: speed: -0.0001: must be m/s > 0 (column 1, 'speed [mm/s]')");
    refuse("speed,restitution\n0.1,2.01\n", "restitution: 2.01: must be a number -1..2 (column 2)");
    refuse("speed,restitution\n0.1,-1.2\n", "restitution: -1.2: must be a number -1..2");
    refuse("speed,restitution,at\n0.1,0.2,1.5\n", "at: 1.5: must be a fraction 0..1 (column 3)");
    refuse("speed,restitution,sub_impacts\n0.1,0.2,1.5\n", "sub_impacts: 1.5: must be a count");
    refuse("speed;restitution\n0,25;0,5\n0.3;0,5\n",
           "bad.csv:3: speed: '0.3': must have one decimal mark, ',' as in line 2 (column 1)");
    refuse("speed;restitution\n1.234,5;0,5\n", "speed: '1.234,5': must be a finite number");
    /* units */
    refuse("speed [kn],restitution\n0.1,0.5\n",
           "bad.csv:1: speed: 'kn': must be a unit of speed, as in 300 mm/s (column 1, 'speed ");
    refuse("speed,restitution\nfurlong,-\n0.1,0.5\n",
           "bad.csv:2: speed: 'furlong': must be a unit");
    refuse("speed [m/s],restitution\nmm/s,-\n0.1,0.5\n",
           "bad.csv:2: speed: 'mm/s' here and 'm/s' elsewhere: must be one unit");
    refuse_with("v [m/s],restitution\n0.1,0.5\n", "speed=v:mm/s", 1,
                "bad.csv:1: speed: 'm/s' here and 'mm/s' elsewhere");
    refuse("speed,restitution [m]\n0.1,0.5\n", "restitution: 'm': must be nothing or %");
    refuse("speed,v_out\n0.1,-0.05\n", "v_out: -0.05: must be m/s >= 0, at which the bodies sep");
    refuse("speed,v_out\n0.1,0.3\n",
           "bad.csv:2: v_out: 0.3: must be at most 2 times the speed (0.1 m/s)");
    refuse_with("speed,v (m/s)\n0.1,0.05\n", "restitution=v", 1,
                "restitution: 'm/s': must be nothing or %");
    refuse_with("speed,v (m/s)\n0.1,0.05\n", "restitution=v (m/s)", 1,
                "restitution: 'm/s': must be nothing or %");
    refuse_with("speed,v (m/s)\n0.1,0.05\n", "restitution=2", 1,
                "restitution: 'm/s': must be nothing or %");
    refuse("speed,restitution,sub_impacts\n0.1,0.5,3 %\n", "sub_impacts: '3 %': must be a finite");
    refuse("speed,restitution\n0.1 s,0.5\n", "speed: '0.1 s': must be a finite number");
}

static void says_all_that_is_wrong_at_once(void **state)
{
    (void)state;
    static const char text[] = "speed,restitution\n-0.1,half\n0.1\n0.1,7\n0.1,0.5\n";
    refuse_with(text, "", 4, "bad.csv:2: speed: -0.1");
    refuse_with(text, "", 4, "bad.csv:2: restitution: 'half'");
    refuse_with(text, "", 4, "bad.csv:3: 1 values");
    refuse_with(text, "", 4, "bad.csv:4: restitution: 7");
    /* more than are kept in words */
    char longest[800] = "speed,restitution\n";
    for (int i = 0; i < 60; i++)
        strcat(longest, "0.1,half\n");
    refuse_with(longest, "", 60, "bad.csv:21: restitution: 'half'");
}

/* A history beside the table: the row's speed stands, the rest is the history's. */
static void reads_histories(void **state)
{
    (void)state;
    struct measured_set set;
    char path[160];
    snprintf(path, sizeof path, "%s/one.csv", files_folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("time,velocity_a\n", file);
    for (int i = 0; i < 400; i++)
        fprintf(file, "%.6f,%.6f\n", 1e-5 * i,
                i < 200   ? -0.3
                : i < 210 ? 0.05 * (i - 200) - 0.3
                          : 0.2);
    fclose(file);
    bool read = read_with(
        files_text("good.csv",
                   "speed,restitution,sub_impacts,history\n0.2,0.7,1,\n0.25,nan,,one.csv\n"),
        "", &set);
    if (!read)
        fail_msg("%s", remarks.error[0].text);
    assert_int_equal(set.count, 2);
    assert_true(set.impacts[1].speed == 0.25);
    assert_true(set.impacts[1].sub_impacts == 1.0);
    measured("momentum", set.impacts[1].momentum, 0.5, 1e-6);
    measured_complete(&set.impacts[0], 0.11, 10.0);
    measured("impulse", set.impacts[0].impulse, 1.7 * 0.2 / 10.0, 1e-15);
    measured("first impulse", set.impacts[0].first_impulse, 1.7 * 0.2 / 10.0, 1e-15);
    measured_set_free(&set);
    /* what is wrong with several of them */
    files_text("short.csv", "time,velocity_a\n0,1\n1,1\n");
    refuse_with("history\nnowhere.csv\nshort.csv\none.csv\n", "", 2, "nowhere.csv: No such file");
    refuse_with("history\nnowhere.csv\nshort.csv\none.csv\n", "", 2,
                "short.csv: 2 readings: must be at least 32");
}

/* A history of bounces is as many impacts, of which the row says no more than the place. */
static void bounces_are_rows(void **state)
{
    (void)state;
    struct measured_set set;
    char path[160];
    snprintf(path, sizeof path, "%s/bounces.csv", files_folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("time,velocity_a\n", file);
    /* down with 0.5 m/s at 0.05 s, up with 0.4, down with 0.4 at 0.05 + 0.8/9.81 s, up with 0.32 */
    for (int i = 0; i < 1600; i++) {
        double t = 1e-4 * i + 3e-5, second = 0.05 + 0.8 / 9.81;
        double v = t < 0.05     ? -0.5 - 9.81 * (t - 0.05)
                   : t < second ? 0.4 - 9.81 * (t - 0.05)
                                : 0.32 - 9.81 * (t - second);
        fprintf(file, "%.6f,%.6f\n", t, v);
    }
    fclose(file);
    if (!read_with(files_text("good.csv", "at,history\n0.25,bounces.csv\n"), "", &set))
        fail_msg("%s", remarks.error[0].text);
    assert_int_equal(set.count, 2);
    for (int k = 0; k < 2; k++) {
        /* the instant is that of a reading, 0.1 ms of 9.81 m/s^2 */
        measured("speed", set.impacts[k].speed, k ? 0.4 : 0.5, 5e-4);
        measured("momentum", set.impacts[k].momentum, k ? 0.72 : 0.9, 1e-5);
        assert_true(set.impacts[k].at == 0.25 && set.impacts[k].sub_impacts == 1.0);
    }
    measured_set_free(&set);
    refuse_with("speed,history\n0.5,bounces.csv\n", "", 1,
                "bad.csv:2: history: holds several impacts: the row may say no more of them than "
                "'at'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_the_shapes_of_rigs),
        cmocka_unit_test(says_how_it_understood_them),
        cmocka_unit_test(refuses_files_without_impacts),
        cmocka_unit_test(refuses_bad_values),
        cmocka_unit_test(says_all_that_is_wrong_at_once),
        cmocka_unit_test(reads_histories),
        cmocka_unit_test(bounces_are_rows),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
