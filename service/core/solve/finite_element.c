/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/finite_element.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "contact/law_closed_form.h"
#include "fe/complete_body.h"
#include "fe/complete_converge.h"
#include "impact/concurrent.h"
#include "model/vector.h"
#include "solve/contact_model.h"
#include "solve/error/law.h"
#include "solve/error/models.h"
#include "solve/error/total.h"
#include "solve/outcome.h"
#include "solve/report.h"
#include "solve/validity.h"

/* Elements across the contact radius: of the finest mesh, which costs half a minute. */
enum { COMPLETE_FINEST = 16 };

/* Sideways motion and eccentricity, relative to the approach and the radius: their effect on the
 * impulse is of second order. */
static const double COMPLETE_ALONG = 1e-3;

/* Defect of the energy that is allowed, in tolerances. */
static const double CONCURRENT_CLOSURE = 10.0;

static enum percuss_status complete_check_options(const struct solve_request *request,
                                                  struct fault *fault)
{
    const struct solve_options *options = &request->options;
    const struct solve_contact *contact = &request->contacts[0];
    /* two free bodies with one contact, left alone */
    if (request->contact_count != 1 || request->body_count != 2)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.contact_model: complete-fe: %zu bodies and %zu contacts: it "
                         "answers one contact of two bodies",
                         request->body_count, request->contact_count);
    if (request->delassus)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "delassus: complete-fe: must be left out: the meshed bodies are free");
    if (contact->gap_acceleration != 0.0)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "contacts[0].gap_acceleration: %g: must be 0 for complete-fe",
                         contact->gap_acceleration);
    /* no method or model that it lacks */
    if (options->method != PERCUSS_METHOD_MODAL)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.method: %s: complete-fe has a method of its own: leave it out",
                         method_name(options->method));
    if (options->compliance == PERCUSS_COMPLIANCE_HALF_SPACE)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.compliance: half-space: complete-fe meshes the bodies as they "
                         "are: leave it out, or matched");
    if (options->conditioning)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.conditioning: must be false for complete-fe");
    return PERCUSS_OK;
}

/* The axis that a body turns symmetrically about, body frame; a sphere has all of them. */
static void complete_find_axis(const struct solid *solid, const double direction[3], double axis[3])
{
    memset(axis, 0, 3 * sizeof *axis);
    if (solid->form == SOLID_BALL)
        memcpy(axis, direction, 3 * sizeof *axis);
    else
        axis[solid->axis] = 1.0;
}

/* Whether the impact's line is the body's axis, and the body does not turn about another one. */
static enum percuss_status complete_check_side(const struct problem *problem, int which,
                                               struct fault *fault)
{
    const struct contact_side *side = &problem->sides[0][which];
    const struct body *body = problem->bodies[side->body];
    const struct solve_body *stated = &problem->request->bodies[side->body];
    struct solid solid = body_solid(body);
    double axis[3];
    double off[3];
    /* the impact along the axis */
    complete_find_axis(&solid, side->direction, axis);
    if (!(fabs(dot3(axis, side->direction)) >= 1.0 - 0.5 * COMPLETE_ALONG * COMPLETE_ALONG))
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "contacts[0].normal: complete-fe: must lie along the axis of %s (%c): hit "
                         "in the middle of an end face",
                         body->id, "xyz"[solid.axis]);
    /* and through the centre of mass */
    cross3(side->site.point, side->direction, off);
    if (!(norm3(off) <= COMPLETE_ALONG * solid.across))
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "contacts[0].point: complete-fe: the normal passes %g m beside the centre "
                         "of mass of %s: must be at most %g m",
                         norm3(off), body->id, COMPLETE_ALONG * solid.across);
    /* no turning across it */
    double spin[3];
    rotate_back3(problem->poses[side->body].rotation, stated->angular_velocity, spin);
    cross3(spin, axis, off);
    if (solid.form != SOLID_BALL &&
        !(norm3(off) * body->length <= COMPLETE_ALONG * fabs(problem->gap_rate[0])))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "bodies[%zu].angular_velocity: complete-fe: %g rad/s across the axis of "
                         "%s: must be 0",
                         side->body, norm3(off), body->id);
    /* from rest and without dents */
    if (stated->state)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "bodies[%zu].state: complete-fe starts from bodies at rest and without "
                         "dents: leave it out",
                         side->body);
    return PERCUSS_OK;
}

static enum percuss_status complete_check_sideways(const struct problem *problem,
                                                   struct fault *fault)
{
    const struct solve_contact *contact = &problem->request->contacts[0];
    double relative[3];
    sub3(problem->request->bodies[contact->a].velocity,
         problem->request->bodies[contact->b].velocity, relative);
    add_scaled3(-dot3(relative, contact->normal), contact->normal, relative);
    if (norm3(relative) <= COMPLETE_ALONG * fabs(problem->gap_rate[0]))
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                     "bodies[].velocity: complete-fe: %g m/s across the normal: must be at most "
                     "%g of the approach",
                     norm3(relative), COMPLETE_ALONG);
}

static enum percuss_status complete_make(const struct problem *problem,
                                         struct complete_problem *complete, struct fault *fault)
{
    struct complete_body *targets[2] = {&complete->a, &complete->b};
    enum percuss_status status = complete_check_options(problem->request, fault);
    for (int which = 0; !status && which < 2; which++) {
        status = complete_body_make(problem_body(problem, 0, which), targets[which], fault);
        if (!status)
            status = complete_check_side(problem, which, fault);
    }
    if (!status)
        status = complete_check_sideways(problem, fault);
    complete->speed = -problem->gap_rate[0];
    complete->horizon =
        problem->request->options.horizon > 0.0 ? problem->request->options.horizon : SOLVE_HORIZON;
    return status;
}

static void complete_fill_contact(const struct problem *problem, const struct complete_result *from,
                                  struct solve_result *result)
{
    double w = problem->w[0];
    double touch = problem->request->contacts[0].gap / -problem->gap_rate[0];
    double rate = problem->gap_rate[0];
    size_t listed =
        from->sub_impacts < COMPLETE_SUB_IMPACTS ? from->sub_impacts : COMPLETE_SUB_IMPACTS;
    struct sub_impact *list = arena_take(problem->arena, listed, sizeof *list);
    struct solve_contact_result *contact = &result->contacts[0];
    /* the sub-impacts, from the stated instant on */
    for (size_t i = 0; list && i < listed; i++) {
        const struct complete_sub_impact *one = &from->sub_impact[i];
        list[i] = (struct sub_impact){
            .start = touch + one->start,
            .compression_end = touch + one->compression_end,
            .end = touch + one->end,
            .impulse = one->impulse,
            .compression_impulse = one->compression_impulse,
            .peak_force = one->peak_force,
            .max_indentation = one->max_indentation,
            .gap_rate_before = rate,
            .gap_rate_after = rate + w * one->impulse,
            .negligible = one->impulse < IMPACT_NEGLIGIBLE * from->impulse,
        };
        rate = list[i].gap_rate_after;
    }
    /* and the contact as a whole */
    *contact = (struct solve_contact_result){
        .impulse = from->impulse,
        .impulse_compression = problem->impulse_compression[0],
        .restitution = from->impulse / problem->impulse_compression[0] - 1.0,
        .inverse_effective_mass = w,
        .end_time = listed ? touch + from->sub_impact[listed - 1].end : 0.0,
        .sub_impact_count = from->sub_impacts,
        .sub_impacts_listed = list ? listed : 0,
        .sub_impacts = list,
        .tangential_restitution = NAN,
        .restitution_kinematic = NAN,
        .restitution_energetic = NAN,
    };
    scale3(from->impulse, problem->request->contacts[0].normal, contact->impulse_vector);
    result->contact_count = 1;
    result->time_shift = touch;
    result->window = touch + from->end_time;
}

static void complete_fill_bodies(const struct problem *problem, const struct complete_result *from,
                                 struct solve_result *result)
{
    result->body_count = 2;
    for (int which = 0; which < 2; which++) {
        size_t b = problem->sides[0][which].body;
        struct solve_body_result *out = &result->bodies[b];
        *out = (struct solve_body_result){
            .vibration = from->energy.vibration_of[which],
            .theory = "finite elements",
            .shear_factor = NAN,
        };
        memcpy(out->id, problem->bodies[b]->id, sizeof out->id);
    }
    report_velocities(problem, result);
}

static void complete_fill_model(const struct complete_convergence *convergence,
                                const struct problem *problem, struct solve_result *result)
{
    const struct complete_result *from = &convergence->result;
    const struct swing *finest = &convergence->swing[convergence->meshes - 1];
    const struct body *bodies[2] = {problem->bodies[0], problem->bodies[1]};
    const struct complete_energy *energy = &from->energy;
    /* the models in use */
    result->contact_model = PERCUSS_CONTACT_COMPLETE_FE;
    result->compliance = PERCUSS_COMPLIANCE_MATCHED;
    result->method = PERCUSS_METHOD_MODAL;
    result->delassus_source = PERCUSS_DELASSUS_SERVICE;
    /* how fine, and how far from the limit */
    snprintf(result->reason, sizeof result->reason,
             "complete finite elements, explicit dynamics, no modes: %u elements across the "
             "contact radius, %zu in all, %zu of them plastic, %zu steps; mean of %u places of the "
             "nodes "
             "against the patch's rim; limit of the restitution %.5f, estimated error %.1g%s%s",
             convergence->cells, from->elements, from->plastic_elements, from->steps,
             finest->phases, convergence->restitution, convergence->error,
             body_solid(bodies[0]).approximate || body_solid(bodies[1]).approximate
                 ? "; the block is taken as a cylinder of the same section"
                 : "",
             yield_rate_is_stated(&bodies[0]->yield_rate) ||
                     yield_rate_is_stated(&bodies[1]->yield_rate)
                 ? "; each point yields at the stress of its own rate of strain"
                 : "");
    /* the work of closing nodes (some 1e-7) is the mesh's, and left in the closure */
    result->energy = (struct impact_energy){
        .available = energy->available,
        .rigid_after = energy->rebound,
        .vibration = energy->vibration,
        .plastic = energy->plastic,
        .closure = energy->closure + energy->contact,
    };
}

/* The energy that the steps gain or lose, as if all of it were the rebound's. */
static double complete_step_error(const struct complete_result *from)
{
    double e = from->restitution;
    double missed = fabs(from->energy.closure + from->energy.contact);
    return sqrt(e * e + missed / from->energy.available) - fabs(e);
}

static void complete_fill_end(const struct complete_result *from, double error, double tolerance,
                              struct solve_result *result)
{
    /* how it ended */
    result->end_reason = from->end;
    result->complete = from->end == PERCUSS_END_SEPARATED;
    result->status = result->complete ? PERCUSS_OK : PERCUSS_TRUNCATED;
    if (!result->complete)
        fault_set(&result->fault, result->status,
                  "the horizon was reached before vibration could cause no further contact: the "
                  "restitution is not final");
    /* errors: of the mesh, told as the modes', and of the steps */
    result->restitution_modes = error;
    result->impulse_modes = error * result->contacts[0].impulse_compression;
    result->restitution_time = complete_step_error(from);
    result->impulse_time = result->restitution_time * result->contacts[0].impulse_compression;
    result->tolerance_met = error + result->restitution_time <= tolerance;
    if (!result->tolerance_met)
        report_warn(result,
                    "error.tolerance_met: false: the estimated error of the restitution is %.2g on "
                    "the finest mesh allowed",
                    error + result->restitution_time);
    result->tolerance = tolerance;
    /* omitted from the answer */
    report_warn(result, "states_after: none: complete-fe keeps neither vibration nor dents");
}

enum percuss_status complete_answer(const struct problem *problem, struct pace *pace,
                                    struct solve_result *result)
{
    struct complete_problem complete = {.cells = COMPLETE_FINEST, .pace = pace};
    struct complete_convergence *convergence = arena_take(problem->arena, 1, sizeof *convergence);
    if (!convergence)
        return fault_set(&result->fault, PERCUSS_INTERNAL, "out of memory");
    /* the impact, on finer meshes until they agree */
    enum percuss_status status = complete_make(problem, &complete, &result->fault);
    if (status == PERCUSS_OK)
        status = complete_converge(&complete, problem->tolerance, convergence, &result->fault);
    if (status)
        return status;
    /* the answer of the finest */
    complete_fill_contact(problem, &convergence->result, result);
    complete_fill_bodies(problem, &convergence->result, result);
    complete_fill_model(convergence, problem, result);
    complete_fill_end(&convergence->result, convergence->result_error, problem->tolerance, result);
    struct model_impact blow = {.duration = convergence->result.end_time};
    for (size_t i = 0; i < result->contacts[0].sub_impacts_listed; i++)
        blow.force = fmax(blow.force, result->contacts[0].sub_impacts[i].peak_force);
    double e = result->contacts[0].restitution;
    double range = result->complete ? fmax(e, 1.0 - e) : 2.0;
    const struct unstated_impact whole = {blow.force, .rebound = fabs(e), .range = range};
    double yield = unstated_change(problem, 0, &whole);
    double model =
        models_complete_error(problem, &blow) + loss_of_contact(problem, 0, fabs(e)) + yield;
    total_report_model(problem, model, yield, range, result);
    /* limits of small strains, and losses in the materials */
    struct warnings warnings = {0};
    validity_find_speed(problem, &warnings);
    loss_find(problem, 0, fabs(e), &warnings);
    unstated_find(problem, 0, &whole, &warnings);
    report_warnings(&warnings, result);
    return result->status;
}

/* ---- A contact region of finite elements in every step: its steps and meshes ---- */

/* Elements along the core of the coarsest mesh, and fewest steps of a contact to begin with: an
 * elastic one is wrong by 1e-4 with so many. */
enum { COARSEST = 6, FEWEST_STEPS = 48, PHASES = SWING_PHASES / 2 };

/* Twice as many steps may change e by this part of the tolerance: about as much is left. */
static const double STEPS_SHARE = 0.2;
/* The error of steps differs from mesh to mesh by less than this part of it: 0.05 was found. */
static const double STEPS_BY_MESH = 0.1;
/* Cost of a mesh over that of one half as fine: four times the elements, and some. */
static const double COST = 6.0;
/* Part of the first change of the means that no third one hides: second order leaves a quarter of a
 * quarter. */
static const double FIRST_CHANGE = 1.0 / 16.0;
/* The solution that answers may be off the limit by this part of the limit's error; if none is, so
 * many more are solved where the swing says that e passes through it. */
static const double OFF_LIMIT = 0.25;
enum { AIMS = 2 };

/* Room above the indentation of the closed form: the mesh costs little more for it. */
static const double ROOM = 2.0;
/* Largest indentation of a region over its radius, see region.h. */
static const double INDENTATION_LIMIT = 0.0199;

size_t concurrent_resolution(unsigned mesh)
{
    return (size_t)COARSEST << mesh;
}

static double restitution(const struct concurrent_search *search,
                          const struct impact_outcome *outcome)
{
    return outcome_restitution(search->problem, outcome, 0);
}

/* One solution, with a fresh region of a mesh at a phase. */
static enum percuss_status solve_on(struct concurrent_search *search, unsigned mesh, double phase,
                                    unsigned doublings, struct impact_outcome *outcome)
{
    /* a region that is deep enough for the expected indentation */
    const struct problem *problem = search->problem;
    struct concurrent_settings settings = {
        .horizon = search->horizon, .steps = FEWEST_STEPS << doublings, .pace = search->pace};
    struct region_input input = {
        .materials = {*problem_material(problem, 0, 0), *problem_material(problem, 0, 1)},
        .radius = closed_form_radius(&problem->hertz[0]),
        .resolution = concurrent_resolution(mesh),
        .phase = phase,
    };
    input.indentation =
        fmax(search->expected, fmin(ROOM * search->expected, INDENTATION_LIMIT * input.radius));
    settings.done = pow(COST, (double)mesh + fmin(phase, 0.9) - CONCURRENT_MESHES);
    struct region *region;
    enum percuss_status status = region_create(&input, &region, search->fault);
    if (status != PERCUSS_OK)
        return status;
    /* the impact with it, and its effort */
    status = impact_create(outcome, search->scene, problem->arena)
                 ? impact_concurrent(search->scene, region, &settings, problem->arena, outcome,
                                     search->fault)
                 : fault_set(search->fault, PERCUSS_INTERNAL, "out of memory");
    search->solutions++;
    search->newton_steps += region_effort(region).newton_steps;
    region_destroy(region);
    return status;
}

void concurrent_judge_steps(struct concurrent_steps *steps)
{
    /* the last doubling changed as much as is left where material flows: backward Euler steps are
     * of first order; elastic ones of second leave less */
    double finest = steps->restitution[steps->count - 1];
    double change = finest - steps->restitution[steps->count - 2];
    steps->left = finest + 0.5 * change - steps->restitution[steps->chosen];
    steps->error = 0.5 * fabs(change) + STEPS_BY_MESH * fabs(steps->left);
}

/* Doubles the steps on the coarsest mesh until they matter little. Their error is known from
 * then on, so that all other solutions make do with a quarter of the last. */
static enum percuss_status search_steps(struct concurrent_search *search)
{
    struct concurrent_steps *steps = &search->steps;
    double change = INFINITY;
    while (steps->count < CONCURRENT_DOUBLINGS &&
           fabs(change) > STEPS_SHARE * search->problem->tolerance) {
        struct impact_outcome outcome;
        enum percuss_status status = solve_on(search, 0, 0.0, steps->count, &outcome);
        if (status != PERCUSS_OK)
            return status;
        double e = restitution(search, &outcome);
        if (steps->count > 0)
            change = e - steps->restitution[steps->count - 1];
        steps->restitution[steps->count++] = e;
    }
    steps->chosen = steps->count > 3 ? steps->count - 3 : 0;
    concurrent_judge_steps(steps);
    return PERCUSS_OK;
}

void concurrent_judge_meshes(struct concurrent_search *search)
{
    const struct swing *swing = search->swing;
    const struct swing *finest = &swing[search->meshes - 1];
    search->restitution = finest->mean + search->steps.left;
    search->error = INFINITY;
    if (search->meshes < 2)
        return;
    /* of first order as much is left as has just changed, of higher orders less: its middle */
    double change = finest->mean - finest[-1].mean;
    double bias = 0.5 * fabs(change);
    search->restitution += 0.5 * change;
    /* two means may come close by chance */
    if (search->meshes > 2)
        bias = fmax(bias, FIRST_CHANGE * fabs(swing[1].mean - swing[0].mean));
    bias = fmax(bias, SWING_IN_MEAN * finest->width);
    search->error = bias + finest->jitter + search->steps.error;
}

/* Three phases of the next mesh. */
static enum percuss_status add_mesh(struct concurrent_search *search)
{
    unsigned mesh = search->meshes++;
    struct swing *swing = &search->swing[mesh];
    *swing = (struct swing){.cells = (unsigned)concurrent_resolution(mesh), .phases = PHASES};
    for (unsigned k = 0; k < PHASES; k++) {
        /* the coarsest mesh alone never answers, and its first phase is known by now */
        if (mesh == 0 && k == 0) {
            swing->restitution[0] = search->steps.restitution[search->steps.chosen];
            continue;
        }
        enum percuss_status status =
            solve_on(search, mesh, (double)k / PHASES, search->steps.chosen, &search->latest[k]);
        if (status != PERCUSS_OK)
            return status;
        swing->restitution[k] = restitution(search, &search->latest[k]);
    }
    swing_judge(swing);
    concurrent_judge_meshes(search);
    return PERCUSS_OK;
}

static void answer_with(struct concurrent_search *search, const struct impact_outcome *outcome)
{
    double error = search->error + fabs(restitution(search, outcome) - search->restitution);
    if (!(error < search->answer_error))
        return;
    search->answer = *outcome;
    search->answer_error = error;
}

/* The phase nearest the limit; returns the error of the answer that may be expected of aiming at
 * it, or that of this one. */
static double choose(struct concurrent_search *search, double *phase, struct swing_bracket *bracket)
{
    search->answer_error = INFINITY;
    for (unsigned k = 0; k < PHASES; k++)
        answer_with(search, &search->latest[k]);
    *phase = swing_phase(&search->swing[search->meshes - 1], search->restitution, bracket);
    double aimed = (1.0 + OFF_LIMIT) * search->error;
    return isfinite(*phase) ? fmin(aimed, search->answer_error) : search->answer_error;
}

/* Solves between the two phases around the limit. */
static enum percuss_status aim(struct concurrent_search *search, double phase,
                               struct swing_bracket *bracket, double allowed)
{
    for (int i = 0; i < AIMS && isfinite(phase) && search->answer_error > allowed; i++) {
        struct impact_outcome outcome;
        enum percuss_status status =
            solve_on(search, search->meshes - 1, fmod(phase, 1.0), search->steps.chosen, &outcome);
        if (status != PERCUSS_OK)
            return status;
        answer_with(search, &outcome);
        phase = swing_narrow(bracket, phase, restitution(search, &outcome) - search->restitution);
    }
    return PERCUSS_OK;
}

enum percuss_status concurrent_search(struct concurrent_search *search, double allowed)
{
    struct swing_bracket bracket;
    double phase = NAN;
    double expected = INFINITY;
    /* steps, then meshes until one is expected to answer */
    enum percuss_status status = search_steps(search);
    while (status == PERCUSS_OK && search->meshes < CONCURRENT_MESHES && expected > allowed) {
        status = add_mesh(search);
        if (status == PERCUSS_OK && search->meshes > 1)
            expected = choose(search, &phase, &bracket);
    }
    return status == PERCUSS_OK ? aim(search, phase, &bracket, allowed) : status;
}

static enum percuss_status concurrent_check(const struct problem *problem, struct fault *fault)
{
    const struct solve_options *options = &problem->request->options;
    /* one contact, without a dent */
    if (problem->contact_count != 1)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.contact_model: concurrent-fe: %zu contacts: it answers one",
                         problem->contact_count);
    if (problem->contact_model.choices[0].dented || problem->contact_model.depth[0] > 0.0)
        return fault_set(
            fault, PERCUSS_BAD_REQUEST,
            "bodies[].state: concurrent-fe: there is a dent at contacts[0]: its region "
            "starts without: options.dents must be ignore");
    /* no option that it lacks */
    if (options->method != PERCUSS_METHOD_MODAL)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.method: %s: concurrent-fe is modal: leave it out",
                         method_name(options->method));
    if (options->conditioning)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.conditioning: must be false for concurrent-fe");
    return PERCUSS_OK;
}

/* Takes the search's answer, its error, and the solutions near it. */
static void concurrent_adopt(struct solution *solution, const struct problem *problem,
                             const struct concurrent_search *search)
{
    const struct impact_outcome *answer = &search->answer;
    solution->outcome = *answer;
    solution->log = NULL;
    solution->error.steps = (struct step_error){
        .restitution = search->answer_error,
        .impulse = search->answer_error * problem->impulse_compression[0],
        .energy_defect = outcome_energy_defect(problem, answer),
    };
    solution->error.steps.energy_closes =
        outcome_energy_closes(problem, answer, CONCURRENT_CLOSURE * problem->tolerance);
    solution->tolerance_met =
        solution->error.steps.energy_closes &&
        solution->error.steps.restitution + solution->error.modes.restitution <= problem->tolerance;
    /* the modal solutions had another contact model */
    neighbours_begin(solution->neighbours, problem, answer);
    for (unsigned k = 0; k < SWING_PHASES / 2; k++)
        neighbours_add(solution->neighbours, problem, &search->latest[k]);
}

enum percuss_status concurrent_refine(struct solution *solution, const struct problem *problem,
                                      struct pace *pace, struct concurrent_effort *effort,
                                      struct fault *fault)
{
    enum percuss_status status = concurrent_check(problem, fault);
    if (status != PERCUSS_OK)
        return status;
    *effort = (struct concurrent_effort){.extrapolated = NAN};
    /* nothing to refine where they do not touch */
    if (solution->outcome.tracks[0].count == 0)
        return PERCUSS_OK;
    struct concurrent_search *search = arena_take(problem->arena, 1, sizeof *search);
    if (!search)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    const struct scene *scene = &solution->assembly->scene;
    *search = (struct concurrent_search){
        .problem = problem,
        .scene = scene,
        .pace = pace,
        .fault = fault,
        .horizon = attempt_horizon(problem, scene),
        .expected = outcome_deepest(&solution->outcome, 0),
    };
    /* finer steps and meshes, within the rest of the tolerance */
    status = concurrent_search(search, problem->tolerance - solution->error.modes.restitution);
    if (status != PERCUSS_OK)
        return status;
    concurrent_adopt(solution, problem, search);
    *effort = (struct concurrent_effort){
        .resolution = concurrent_resolution(search->meshes - 1),
        .solutions = search->solutions,
        .newton_steps = search->newton_steps,
        .steps = search->answer.steps,
        .extrapolated = search->restitution,
    };
    return PERCUSS_OK;
}

void concurrent_report(const struct concurrent_effort *effort, const struct problem *problem,
                       const struct solution *solution, struct solve_result *result)
{
    const struct contact_history *history = &solution->outcome.laws[0].history;
    result->contact_model = PERCUSS_CONTACT_CONCURRENT_FE;
    snprintf(result->reason, sizeof result->reason,
             "contact region of finite elements, solved at each of %lu steps: %zu elements along "
             "its core; %zu solutions, %zu Newton steps; dent %.3g um, limit of the restitution "
             "%.5f; %zu modes up to %.4g Hz, residual flexibility for the others%s",
             effort->steps, effort->resolution, effort->solutions, effort->newton_steps,
             1e6 * history->dent, effort->extrapolated, solution->assembly->all_modes,
             solution->assembly->highest / (2.0 * M_PI),
             problem->hertz[0].axis_ratio < HERTZ_CIRCULAR_RATIO
                 ? "; elliptic: by the sphere of equal stiffness, an approximation"
                 : "");
}
