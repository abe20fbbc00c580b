/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The paper's steel sphere on the middle of its aluminium beam by modes: model B with the elliptic
 * contact region solved in every step, model C with the table of that region, and the same with
 * Hertz's elliptic law (H); tests/reference/spatial. A line of CSV each, the first with the names.
 * usage: beam_modal [--speed V]... [--resolution N] [--modes N] [--step S] [--history PREFIX]
 *                   [--no-header] */
#include "beam_case.h"

#include <math.h>

#include "contact/law_table.h"
#include "spatial/beam_modal.h"

/* Above what a blow of the fastest speed exerts: 0.3 m/s has 350 N. */
static const double FORCE_PER_SPEED = 1300.0;

struct choice {
    struct beam_case common;
    size_t resolution, modes;
    double step;
};

static bool read_arguments(int count, char **words, struct choice *choice)
{
    *choice = (struct choice){.resolution = 6, .modes = 80, .step = 0.5e-6};
    const struct beam_case_option own[] = {{.name = "--resolution", .count = &choice->resolution},
                                           {.name = "--modes", .count = &choice->modes},
                                           {.name = "--step", .number = &choice->step},
                                           {0}};
    return beam_case_read(count, words, own, &choice->common);
}

static bool make_modal(size_t modes, struct beam_modal *modal)
{
    struct beam_plane plane = beam_case_plane();
    double sphere = BEAM_CASE_SPHERE.density * 4.0 / 3.0 * M_PI * pow(BEAM_CASE_BALL, 3.0);
    return beam_modal_create(&plane, sphere, modes, modal);
}

/* one model, all speeds; a history of the first */
static enum percuss_status solve_all(const struct choice *choice, const char *model,
                                     const struct beam_modal *modal,
                                     const struct beam_modal_contact *contact, double setup)
{
    const struct beam_case *common = &choice->common;
    struct fault fault;
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; i < common->speed_count && status == PERCUSS_OK; i++) {
        FILE *history = NULL;
        if (common->history && i == 0) {
            char name[512];
            snprintf(name, sizeof name, "%s-%s.csv", common->history, model);
            history = beam_case_history(name);
            if (!history)
                return PERCUSS_BAD_REQUEST;
        }
        struct beam_modal_settings settings = {.approach = common->speeds[i],
                                               .step = choice->step,
                                               .horizon = 0.010,
                                               .record = history ? beam_case_record : NULL,
                                               .context = history};
        struct collision found;
        double begun = beam_case_seconds();
        status = beam_modal_run(modal, contact, &settings, &found, &fault);
        double seconds = beam_case_seconds() - begun;
        if (history)
            fclose(history);
        if (status != PERCUSS_OK) {
            fprintf(stderr, "beam_modal: %s\n", fault.text);
            break;
        }
        printf("%s,%g,%zu,%zu,%g,%.6f,%d,%.6g,%.2e,%.2f,%.3f,", model, common->speeds[i],
               choice->resolution, choice->modes, choice->step, found.restitution, found.over,
               found.time, (found.available - found.rebound - found.vibration) / found.available,
               setup, seconds);
        beam_case_print_sub_impacts(&found);
    }
    return status;
}

/* model C: what is kept is force against indentation alone */
static enum percuss_status solve_by_table(const struct choice *choice,
                                          const struct beam_modal *modal, struct patch *patch,
                                          double force, double setup)
{
    struct patch_table samples;
    struct contact_curves *curves;
    struct fault fault;
    double begun = beam_case_seconds();
    if (!patch_tabulate(patch, force, &samples))
        return PERCUSS_INTERNAL;
    struct contact_table table = {.points = PATCH_SAMPLES + 1,
                                  .indentation = samples.indentation,
                                  .force = samples.force,
                                  .contact_radius = samples.radius,
                                  .yield = samples.indentation[PATCH_SAMPLES],
                                  .error = samples.error};
    enum percuss_status status = contact_curves_create(&table, &curves, &fault);
    if (status != PERCUSS_OK) {
        fprintf(stderr, "beam_modal: %s\n", fault.text);
        return status;
    }
    fprintf(stderr, "table: %zu freedoms, force within %.2e of Hertz's ellipse (%.6g N/m^1.5)\n",
            patch->freedoms, samples.error, patch->hertz.stiffness);
    struct contact_law law = contact_law_table(curves);
    struct beam_modal_contact contact = beam_modal_law(&law);
    status = solve_all(choice, "C", modal, &contact, setup + beam_case_seconds() - begun);
    contact_curves_free(curves);
    return status;
}

int main(int count, char **words)
{
    struct choice choice;
    struct beam_modal modal;
    struct patch patch;
    struct fault fault;
    if (!read_arguments(count, words, &choice))
        return 2;
    if (!choice.common.headless)
        printf("model,speed,resolution,modes,step,restitution,over,end,closure,setup_s,run_s,"
               "sub_impacts:start:end:impulse:peak\n");
    double curve = 0.5 / BEAM_CASE_BALL, force = FORCE_PER_SPEED * choice.common.fastest;
    struct patch_input input = {.materials = {BEAM_CASE_BEAM, BEAM_CASE_SPHERE},
                                .curvature = {curve, curve + 0.5 / BEAM_CASE_RADIUS},
                                .force = force,
                                .resolution = choice.resolution};
    enum percuss_status status = patch_create(&input, &patch, &fault);
    if (status != PERCUSS_OK) {
        fprintf(stderr, "beam_modal: %s\n", fault.text);
        return 1;
    }
    double setup = beam_case_seconds();
    if (!make_modal(choice.modes, &modal))
        return 1;
    /* B, C, and the law that both approach */
    struct beam_modal_contact region = beam_modal_patch(&patch);
    status = solve_all(&choice, "B", &modal, &region, setup);
    if (status == PERCUSS_OK)
        status = solve_by_table(&choice, &modal, &patch, force, setup);
    struct contact_law hertz = contact_law_hertz(patch.hertz.stiffness);
    struct beam_modal_contact by_law = beam_modal_law(&hertz);
    if (status == PERCUSS_OK)
        status = solve_all(&choice, "H", &modal, &by_law, 0.0);
    beam_modal_free(&modal);
    patch_free(&patch);
    return status == PERCUSS_OK ? 0 : 1;
}
