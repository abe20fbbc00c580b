/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests solve/ and all below it: wherever memory runs out, the status says so, nothing is lost, and
 * what is answered all the same is the whole answer. */
#include <stdio.h>

#include "impact/trace.h"
#include "memory/failing.h"
#include "physics/shipped_tables.h"

static const double RADIUS = 0.015;

/* A request with what it is answered from memory enough. */
struct question {
    struct lab *lab;
    struct solve_request request;
    struct solve_result result;
    char *answer; /* free() */
};

static struct lab *bodies(void)
{
    struct lab *lab = lab_create();
    lab_add(lab, "ball", make_sphere(STEEL, RADIUS));
    lab_add(lab, "small", make_sphere(STEEL, 0.012));
    lab_add(lab, "rod", make_bar(&rod_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "soft-rod", make_bar(&rod_kind, AL_205, 0.010, 1.0));
    lab_add(lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "wall", make_body(&half_space_kind, ALUMINIUM));
    struct body few = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    few.modes = 10;
    lab_add(lab, "few", few);
    return lab;
}

/* Every word and every bit of a result. */
static char *text_of(const struct solve_result *result)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    fprintf(out, "%d %s\n%d %a %s\n", result->status, result->fault.text, result->end_reason,
            result->window, result->reason);
    for (size_t c = 0; c < result->contact_count; c++) {
        const struct solve_contact_result *contact = &result->contacts[c];
        fprintf(out, "%a %a %zu\n", contact->impulse, contact->restitution,
                contact->sub_impact_count);
        for (size_t i = 0; i < contact->sub_impacts_listed; i++)
            fprintf(out, "%a %a\n", contact->sub_impacts[i].start, contact->sub_impacts[i].impulse);
    }
    for (size_t b = 0; b < result->body_count; b++) {
        const struct body_state *after = result->bodies[b].state_after;
        fprintf(out, "%a %a %s\n", result->bodies[b].velocity[2], result->bodies[b].vibration,
                result->bodies[b].theory);
        for (size_t i = 0; after && i < (body_state_size(after) - sizeof *after) / 8; i++)
            fprintf(out, "%a ", after->coordinates[i]);
    }
    fprintf(out, "\n%a %a %a %d\n", result->energy.closure, result->restitution_time,
            result->restitution_modes, result->tolerance_met);
    for (size_t w = 0; w < result->warning_count; w++)
        fprintf(out, "%s\n", result->warnings[w]);
    for (size_t i = 0; result->trace && i < result->trace->count; i++)
        fprintf(out, "%a %a\n", result->trace->time[i], result->trace->contact[0].force[i]);
    fclose(out);
    return text;
}

/* Solves in a workspace of its own, twice: the second time bodies are prepared. */
static bool solves(void *context)
{
    struct question *question = context;
    bool whole = false;
    failing_begin();
    struct solve_workspace *workspace = solve_workspace_create();
    for (int again = 0; workspace && again < 2; again++) {
        failing_begin();
        enum percuss_status status =
            solve(workspace, &question->lab->means, &question->request, &question->result);
        whole = !is_out_of_memory(status, question->result.fault.text);
        if (!whole)
            continue;
        char *answer = text_of(&question->result);
        if (strcmp(answer, question->answer) != 0)
            fail_by_memory("the answer is another one");
        free(answer);
    }
    failing_end();
    solve_workspace_free(workspace);
    return whole;
}

/* The answer from memory enough, then from memory that lacks at every call. */
static void ask(const char *what, struct lab *lab, struct solve_request request, unsigned dense)
{
    static struct question question;
    question = (struct question){.lab = lab, .request = request};
    struct solve_workspace *workspace = solve_workspace_create();
    lab->means.tables = table_store_source(shipped);
    enum percuss_status status = solve(workspace, &lab->means, &request, &question.result);
    if (is_out_of_memory(status, question.result.fault.text))
        fail_msg("%s: %s", what, question.result.fault.text);
    question.answer = text_of(&question.result);
    solve_workspace_free(workspace);
    assert_true(fail_each(what, solves, &question, dense) > 10);
    free(question.answer);
    lab_free(lab);
}

static struct solve_request on_rod(const char *rod)
{
    return strike(sphere_spot("ball", RADIUS), end_spot(rod, 1.0), 0.3);
}

static void hertz_on_a_rod(void **state)
{
    (void)state;
    ask("rod", bodies(), on_rod("rod"), 100);
}

static void hertz_on_a_beam_that_strikes_back(void **state)
{
    (void)state;
    struct solve_request request =
        strike(sphere_spot("ball", RADIUS), side_spot("beam", 0.0, 0.010, 0.3), 0.287);
    request.options.conditioning = true;
    ask("beam", bodies(), request, 100);
}

static void a_history(void **state)
{
    (void)state;
    struct solve_request request = on_rod("rod");
    request.options.trace = true;
    ask("history", bodies(), request, 100);
}

static void closed_form(void **state)
{
    (void)state;
    struct solve_request request = on_rod("soft-rod");
    request.options.contact_model = PERCUSS_CONTACT_CLOSED_FORM;
    ask("closed form", bodies(), request, 100);
}

static void a_table(void **state)
{
    (void)state;
    struct solve_request request = on_rod("soft-rod");
    request.options.contact_model = PERCUSS_CONTACT_TABLE;
    ask("table", bodies(), request, 100);
}

static void matched_compliance(void **state)
{
    (void)state;
    struct solve_request request = on_rod("rod");
    request.options.compliance = PERCUSS_COMPLIANCE_MATCHED;
    ask("matched", bodies(), request, 100);
}

static void a_half_space(void **state)
{
    (void)state;
    ask("half-space", bodies(), strike(sphere_spot("ball", RADIUS), wall_spot("wall"), 0.5), 100);
}

static void by_cvode(void **state)
{
    (void)state;
    struct solve_request request = on_rod("few");
    request = strike(sphere_spot("ball", RADIUS), side_spot("few", 0.1, 0.010, 0.0), 0.2);
    request.options.method = PERCUSS_METHOD_CVODE;
    request.options.tolerance = 1e-2;
    ask("cvode", bodies(), request, 100);
}

static void two_balls_on_a_beam(void **state)
{
    (void)state;
    struct solve_request request =
        strike(sphere_spot("small", 0.012), side_spot("few", 0.0, 0.010, 0.0), 0.2);
    request.body_count = 3;
    request.contact_count = 2;
    request.bodies[2] = request.bodies[1];
    request.bodies[1] = request.bodies[0];
    for (unsigned i = 0; i < 2; i++) {
        request.bodies[i].position[0] = request.contacts[i].point[0] = i ? 0.3 : -0.3;
        request.contacts[i] = (struct solve_contact){
            .a = i, .b = 2, .point = {i ? 0.3 : -0.3}, .normal = {0.0, 0.0, 1.0}};
    }
    ask("group", bodies(), request, 100);
}

/* A rod that rings and has a dent is struck again. */
static void on_states(void **state)
{
    (void)state;
    static struct solve_result first;
    struct lab *lab = bodies();
    struct solve_request request = on_rod("soft-rod");
    request.options.contact_model = PERCUSS_CONTACT_CLOSED_FORM;
    lab_solve(lab, &request, &first);
    const struct body_state *after = first.bodies[1].state_after;
    assert_non_null(after);
    assert_true(after->dents == 1);
    struct body_state *kept = malloc(body_state_size(after));
    memcpy(kept, after, body_state_size(after));
    request.bodies[1].state = kept;
    request.bodies[1].elapsed = 1e-3;
    ask("states", lab, request, 100);
    free(kept);
}

static void concurrent_finite_elements(void **state)
{
    (void)state;
    struct solve_request request = on_rod("rod");
    request.options.contact_model = PERCUSS_CONTACT_CONCURRENT_FE;
    request.options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
    request.options.tolerance = 2e-2;
    ask("concurrent", bodies(), request, 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hertz_on_a_rod),
        cmocka_unit_test(hertz_on_a_beam_that_strikes_back),
        cmocka_unit_test(a_history),
        cmocka_unit_test(closed_form),
        cmocka_unit_test(a_table),
        cmocka_unit_test(matched_compliance),
        cmocka_unit_test(a_half_space),
        cmocka_unit_test(by_cvode),
        cmocka_unit_test(two_balls_on_a_beam),
        cmocka_unit_test(on_states),
        cmocka_unit_test(concurrent_finite_elements),
    };
    return cmocka_run_group_tests(tests, load_shipped, free_shipped);
}
