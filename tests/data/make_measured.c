/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Makes the synthetic measurements in client/examples/measured: 53 impacts of a steel sphere on a
 * beam with 1 % noise, whose speeds are drawn (the paper states mean and deviation of its 53, not
 * the speeds), three more as velocity histories, at the speeds of its Figure 5, and for its Figure
 * 1 impacts on two rods that yield. The truth is in tests/physics/synthetic.h. usage: make_measured
 * FOLDER */
#include "physics/synthetic.h"

#include "impact/trace.h"

enum { IMPACTS = 53, HISTORIES = 3, ROD_IMPACTS = 23 };
static const double NOISE = 0.01, RATE = 250e3, VELOCITY_NOISE = 2e-4, LEAD = 1e-3;

static FILE *open_file(const char *folder, const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    if (!file) {
        perror(path);
        exit(1);
    }
    return file;
}

/* An empty field for what is unknown. */
static void put_field(FILE *file, double value, const char *format, char end)
{
    if (!isnan(value))
        fprintf(file, format, value);
    fputc(end, file);
}

static void write_impacts(struct lab *lab, const char *folder)
{
    struct measured_set set;
    FILE *file = open_file(folder, "synthetic-beam.csv");
    synthetic_measure(lab, "true-beam", IMPACTS, NOISE, 20260101, &set);
    fputs(
        "# synthetic: sphere of steel (R 15 mm) on the middle of a beam of aluminium (1 m, r 10 mm)"
        ";\n# Young's modulus of the beam 72.5 GPa, damping 3e-4, 48 modes; 1 % noise on every "
        "number\n# speeds drawn: normal, mean 0.25, deviation 0.0929 m/s as the paper states of "
        "its 53, none "
        "below 0.05\nspeed,restitution,sub_impacts,first_impulse,first_duration,second_start\n",
        file);
    for (size_t i = 0; i < set.count; i++) {
        const struct measured_impact *impact = &set.impacts[i];
        put_field(file, impact->speed, "%.5f", ',');
        put_field(file, impact->restitution, "%.4f", ',');
        put_field(file, impact->sub_impacts, "%.0f", ',');
        put_field(file, impact->first_impulse, "%.5e", ',');
        put_field(file, impact->first_duration, "%.4e", ',');
        put_field(file, impact->second_start, "%.5e", '\n');
    }
    fclose(file);
    measured_set_free(&set);
}

/* The sphere's velocity at t: before the trace that of approach, after it the last. */
static double velocity_at(const struct trace *trace, double t)
{
    const double *time = trace->time, *v = trace->contact[0].velocity[0];
    if (t <= time[0])
        return v[0];
    for (size_t i = 1; i < trace->count; i++)
        if (t < time[i])
            return v[i - 1] + (v[i] - v[i - 1]) * (t - time[i - 1]) / (time[i] - time[i - 1]);
    return v[trace->count - 1];
}

static void write_history(struct lab *lab, const char *folder, int index, double speed)
{
    static struct solve_result result;
    char name[64];
    struct random random = {(uint64_t)index + 77};
    struct solve_request request = synthetic_strike("sphere", "true-beam", speed);
    request.options.trace = true;
    lab_solve(lab, &request, &result);
    snprintf(name, sizeof name, "synthetic-history-%d.csv", index);
    FILE *file = open_file(folder, name);
    fputs("time,velocity_a\n", file);
    double end = result.window + LEAD;
    for (int i = 0; i / RATE - LEAD < end; i++) {
        double t = i / RATE - LEAD;
        fprintf(file, "%.6f,%.5f\n", t,
                velocity_at(result.trace, t) + VELOCITY_NOISE * random_normal(&random));
    }
    fclose(file);
}

/* Impacts on the end of a rod that yields, by the closed form, which the service takes last. */
static void write_rod(struct lab *lab, const char *folder, int index, double yield)
{
    static struct solve_result result;
    char body[16], name[32];
    struct random random = {(uint64_t)index + 1205};
    struct material material = ALUMINIUM;
    material.young = SYNTHETIC_YOUNG;
    material.yield = yield;
    snprintf(body, sizeof body, "true-rod-%d", index);
    snprintf(name, sizeof name, "synthetic-rod-%d.csv", index);
    lab_add(lab, body, make_bar(&rod_kind, material, 0.010, 1.0));
    FILE *file = open_file(folder, name);
    fprintf(file,
            "# synthetic: sphere of steel (R 15 mm) on the end of a rod of aluminium (1 m, r 10 mm)"
            ";\n# Young's modulus 72.5 GPa, yield %.0f MPa, closed form; 1 %% noise on every number"
            "\nspeed,restitution,sub_impacts\n",
            yield / 1e6);
    for (int i = 0; i < ROD_IMPACTS; i++) {
        double speed = 0.06 + 0.44 * i / (ROD_IMPACTS - 1);
        struct solve_request request =
            strike(sphere_spot("sphere", 0.015), end_spot(body, 1.0), speed);
        request.options.contact_model = PERCUSS_CONTACT_CLOSED_FORM;
        lab_solve(lab, &request, &result);
        struct measured_impact impact = synthetic_impact(&result, speed);
        synthetic_read(&impact, NOISE, &random);
        fprintf(file, "%.5f,%.4f,%.0f\n", impact.speed, impact.restitution, impact.sub_impacts);
    }
    fclose(file);
}

int main(int argc, char **argv)
{
    static const double speeds[HISTORIES] = {0.276, 0.287, 0.303};
    if (argc != 2) {
        fprintf(stderr, "usage: make_measured FOLDER\n");
        return 2;
    }
    struct lab *lab = lab_create();
    lab_add(lab, "sphere", make_sphere(STEEL, 0.015));
    lab_add(lab, "true-beam", synthetic_beam());
    /* as the service's own catalogue has it; the rods' files are of half-spaces */
    lab->set.compliance = PERCUSS_COMPLIANCE_MATCHED;
    write_impacts(lab, argv[1]);
    FILE *list = open_file(argv[1], "synthetic-histories.csv");
    fputs("# synthetic: velocity of the sphere, as by a vibrometer; the same rig as "
          "synthetic-beam.csv; 0.276, "
          "0.287, 0.303 m/s\nhistory\n",
          list);
    for (int i = 0; i < HISTORIES; i++) {
        write_history(lab, argv[1], i + 1, speeds[i]);
        fprintf(list, "synthetic-history-%d.csv\n", i + 1);
    }
    fclose(list);
    lab->set.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
    write_rod(lab, argv[1], 1, 205e6);
    write_rod(lab, argv[1], 2, 575e6);
    lab_free(lab);
    return 0;
}
