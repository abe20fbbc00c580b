/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The paper's steel sphere on the middle of its aluminium beam as complete finite elements in three
 * dimensions (tests/reference/spatial): restitution, sub-impacts, energy balance and time; a line
 * of CSV each, the first with the names. usage: beam_3d [--speed V]... [--levels N] [--across N]
 * [--bricks N] [--contact-step S]
 *                [--flight-step S] [--horizon S] [--history FILE] [--no-header] */
#include "beam_case.h"

struct choice {
    struct beam_case common;
    struct pair_input input;
    double contact_step, flight_step, horizon;
};

static bool read_arguments(int count, char **words, struct choice *choice)
{
    size_t levels = 6;
    *choice = (struct choice){
        .input = {.materials = {BEAM_CASE_BEAM, BEAM_CASE_SPHERE},
                  .beam_radius = BEAM_CASE_RADIUS,
                  .beam_length = BEAM_CASE_LENGTH,
                  .sphere_radius = BEAM_CASE_BALL,
                  .bricks = 60,
                  .across = 2},
        .contact_step = 2e-6,
        .flight_step = 8e-6,
        .horizon = 0.010,
    };
    const struct beam_case_option own[] = {
        {.name = "--levels", .count = &levels},
        {.name = "--across", .count = &choice->input.across},
        {.name = "--bricks", .count = &choice->input.bricks},
        {.name = "--contact-step", .number = &choice->contact_step},
        {.name = "--flight-step", .number = &choice->flight_step},
        {.name = "--horizon", .number = &choice->horizon},
        {0}};
    if (!beam_case_read(count, words, own, &choice->common))
        return false;
    choice->input.levels = (unsigned)levels;
    choice->input.velocity = choice->common.fastest;
    return true;
}

/* of the beam's middle, to bound what vibration can do */
static double middle_compliance(void)
{
    struct beam_plane plane = beam_case_plane();
    struct beam_load load = {.x = 0.0, .force = 1.0};
    return beam_compliance(&plane, &load, &load);
}

static void print_header(void)
{
    printf(
        "model,speed,bricks,across,levels,contact_step,flight_step,freedoms,contact_nodes,"
        "restitution,over,end,closure,setup_s,run_s_of_all,sub_impacts:start:end:impulse:peak\n");
}

static void print_found(const struct choice *choice, const struct pair *pair, double speed,
                        const struct collision *found, const double seconds[2])
{
    const struct pair_input *input = &choice->input;
    printf("A,%g,%zu,%zu,%u,%g,%g,%zu,%zu,%.6f,%d,%.6g,%.2e,%.1f,%.1f,", speed, input->bricks,
           input->across, input->levels, choice->contact_step, choice->flight_step,
           pair->systems[0].freedoms + pair->systems[1].freedoms, pair->pressed[0].count,
           found->restitution, found->over, found->time,
           (found->available - found->rebound - found->vibration) / found->available, seconds[0],
           seconds[1]);
    beam_case_print_sub_impacts(found);
}

static enum percuss_status solve_all(const struct choice *choice, const struct collider *collider,
                                     double setup, struct fault *fault)
{
    const struct beam_case *common = &choice->common;
    FILE *history = common->history ? beam_case_history(common->history) : NULL;
    if (common->history && !history)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: cannot be written", common->history);
    struct collision found[BEAM_CASE_SPEEDS];
    struct collision_settings settings = {
        .horizon = choice->horizon,
        .compliance = middle_compliance(),
        .record = history ? beam_case_record : NULL,
        .context = history,
    };
    double begun = beam_case_seconds();
    enum percuss_status status =
        collider_run(collider, &settings, common->speed_count, common->speeds, found, fault);
    for (size_t i = 0; i < common->speed_count && status == PERCUSS_OK; i++)
        print_found(choice, collider->pair, common->speeds[i], &found[i],
                    (const double[2]){setup, beam_case_seconds() - begun});
    if (history)
        fclose(history);
    return status;
}

int main(int count, char **words)
{
    struct choice choice;
    struct fault fault;
    struct pair pair;
    struct collider collider;
    if (!read_arguments(count, words, &choice))
        return 2;
    if (!choice.common.headless)
        print_header();
    enum percuss_status status = pair_create(&choice.input, &pair, &fault);
    if (status == PERCUSS_OK) {
        status = collider_create(&pair, choice.contact_step, choice.flight_step, &collider, &fault);
        if (status == PERCUSS_OK) {
            status = solve_all(&choice, &collider, beam_case_seconds(), &fault);
            collider_free(&collider);
        }
        pair_free(&pair);
    }
    if (status != PERCUSS_OK)
        fprintf(stderr, "beam_3d: %s\n", fault.text);
    return status == PERCUSS_OK ? 0 : 1;
}
