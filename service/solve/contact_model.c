/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/contact_model.h"

#include <math.h>

#include "contact/law_closed_form.h"
#include "contact/plastic.h"
#include "model/vector.h"
#include "solve/outcome.h"

static const struct contact_law_operations *asked_of(const struct problem *problem)
{
    return contact_law_asked(problem->request->options.contact_model);
}

/* The dent nearest to a site among those whose patch holds it; its index, or the number of dents.
 */
static size_t find_dent(const struct body_state *state, const double point[3])
{
    size_t found = state->dents;
    double nearest = INFINITY;
    for (size_t i = 0; i < state->dents; i++) {
        const struct dent *dent = &body_state_dents(state)[i];
        double arm[3];
        sub3(point, dent->point, arm);
        double distance = norm3(arm);
        if (distance <= dent->size && distance < nearest) {
            nearest = distance;
            found = i;
        }
    }
    return found;
}

/* What earlier impacts left under a contact: both bodies' dents lower the surface, the one of the
 * body that yields is remembered by the law. */
static void find_dents(struct problem *problem, size_t c)
{
    struct contact_model *model = &problem->contact_model;
    struct contact_choice *choice = &model->choices[c];
    for (int which = 0; which < 2 && problem->request->options.dents == PERCUSS_DENTS_KEEP;
         which++) {
        /* the dent there, if the state has one */
        const struct contact_side *side = &problem->sides[c][which];
        const struct body_state *state = problem->request->bodies[side->body].state;
        size_t i = state ? find_dent(state, side->site.point) : 0;
        if (!state || i == state->dents)
            continue;
        /* by which the surface is lower */
        const struct dent *dent = &body_state_dents(state)[i];
        model->depth[c] += dent->history.dent;
        /* and from which the law of the body that yields goes on */
        if (which != choice->side)
            continue;
        choice->dented = true;
        choice->dent = i;
        contact_law_remember(&choice->plastic, &dent->history);
    }
}

/* A table of just these materials. */
static enum percuss_status find_table(struct problem *problem,
                                      const struct contact_table_source *tables, size_t c,
                                      struct fault *fault)
{
    struct contact_choice *choice = &problem->contact_model.choices[c];
    const struct hertz_contact *hertz = &problem->hertz[c];
    const struct body *a = problem_body(problem, c, 0);
    const struct body *b = problem_body(problem, c, 1);
    /* looked up, for the contact's curvature */
    struct contact_pair pair = {problem_material(problem, c, 0),
                                problem_material(problem, c, 1),
                                {hertz->curvature[0], hertz->curvature[1]}};
    const struct contact_curves *curves = tables ? tables->find(tables->context, &pair) : NULL;
    struct contact_law law;
    if (curves)
        law = contact_law_table_at(curves, 0.5 / hertz->curvature[0]);
    /* one that ends before it yields says less than the family */
    if (curves && (!tables->family || contact_law_table_range(&law) > choice->yield)) {
        choice->plastic = law;
        choice->tabulated = true;
    } else if (asked_of(problem)->tables == CONTACT_TABLES_ONLY) {
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.contact_model: table: there is no table for %s on %s "
                         "(contacts[%zu]): %s; auto or closed-form do without",
                         a->id, b->id, c,
                         hertz->axis_ratio < HERTZ_CIRCULAR_RATIO
                             ? "the contact is elliptic, tables are of circular ones"
                             : "percuss-tables computes them");
    }
    return PERCUSS_OK;
}

/* The family's law: in use by auto, to compare with where the closed form is asked for. */
static bool find_family(struct problem *problem, const struct contact_family *family, size_t c,
                        bool used)
{
    struct contact_choice *choice = &problem->contact_model.choices[c];
    /* the curves at the place of these materials */
    const struct material *a = problem_material(problem, c, 0);
    const struct material *b = problem_material(problem, c, 1);
    struct contact_family_place place = contact_family_place(a, b);
    const struct contact_curves *curves = contact_family_curves(family, &place, problem->arena);
    if (!curves)
        return false;
    struct contact_law law = contact_law_family(curves, &problem->hertz[c], a, b);
    /* to compare with */
    if (!used) {
        choice->compared = law;
        return true;
    }
    /* in use, with what makes it less certain */
    choice->plastic = law;
    choice->tabulated = choice->family = true;
    choice->outside = contact_family_outside(family, &place);
    choice->both = contact_family_both_yield(a, b);
    return true;
}

static enum percuss_status find_law(struct problem *problem,
                                    const struct contact_table_source *tables, size_t c,
                                    struct fault *fault)
{
    struct contact_choice *choice = &problem->contact_model.choices[c];
    const struct hertz_contact *hertz = &problem->hertz[c];
    const struct material *a = problem_material(problem, c, 0);
    const struct material *b = problem_material(problem, c, 1);
    const struct contact_law_operations *asked = asked_of(problem);
    /* the law itself, or what stands for it */
    choice->side = closed_form_softer(a, b);
    choice->yield = closed_form_yield(hertz, a, b);
    choice->plastic = asked->make(hertz, a, b);
    /* a table of these materials in its place */
    bool may = asked->tables != CONTACT_TABLES_NONE;
    if (may && choice->side >= 0) {
        enum percuss_status status = find_table(problem, tables, c, fault);
        if (status)
            return status;
    }
    /* or the family: in use, or to compare with */
    if (choice->side >= 0 && !choice->tabulated && tables && tables->family &&
        !find_family(problem, tables->family, c, may))
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    /* from the dents that are there */
    find_dents(problem, c);
    return PERCUSS_OK;
}

/* Hertz indentation if all of the rigid approach's energy went into the contact. */
static double rigid_indentation(const struct problem *problem, size_t c)
{
    double speed = fmin(0.0, problem->gap_rate[c]);
    double w = problem->w[c * (problem->contact_count + 1)];
    return pow(0.5 * speed * speed / w / (HERTZ_WORK * problem->hertz[c].stiffness), 0.4);
}

static void use(struct problem *problem, bool yielding)
{
    struct contact_model *model = &problem->contact_model;
    model->yielding = yielding;
    for (size_t c = 0; c < problem->contact_count; c++)
        model->laws[c] =
            yielding ? model->choices[c].plastic : contact_law_hertz(problem->hertz[c].stiffness);
}

enum percuss_status contact_model_choose(struct problem *problem,
                                         const struct contact_table_source *tables,
                                         struct fault *fault)
{
    size_t n = problem->contact_count;
    struct contact_model *model = &problem->contact_model;
    model->remedy = tables && tables->remedy.command ? &tables->remedy : NULL;
    model->depth = arena_take(problem->arena, n, sizeof *model->depth);
    model->laws = arena_take(problem->arena, n, sizeof *model->laws);
    model->choices = arena_take(problem->arena, n, sizeof *model->choices);
    if (!model->depth || !model->laws || !model->choices)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    /* the laws of every contact, and whether they are likely to be needed */
    bool dented = false;
    bool likely = false;
    for (size_t c = 0; c < n; c++) {
        enum percuss_status status = find_law(problem, tables, c, fault);
        if (status)
            return status;
        dented = dented || model->choices[c].dented;
        likely = likely || rigid_indentation(problem, c) > model->choices[c].yield;
    }
    /* in use from the beginning where asked for, dented or likely */
    model->decided = !asked_of(problem)->yields_if_needed || dented;
    use(problem, model->decided || likely);
    return PERCUSS_OK;
}

bool contact_model_yielded(const struct problem *problem, const struct impact_outcome *outcome,
                           size_t contact)
{
    return outcome->laws[contact].history.max_indentation >
           problem->contact_model.laws[contact].history.max_indentation;
}

double contact_model_beyond_table(const struct impact_outcome *outcome, size_t contact)
{
    const struct contact_law *law = &outcome->laws[contact];
    if (law->operations->tables != CONTACT_TABLES_ONLY)
        return 0.0;
    double range = contact_law_table_range(law);
    double depth = fmax(law->history.max_indentation, outcome_deepest(outcome, contact));
    return fmax(0.0, depth / range - 1.0);
}

bool contact_model_revise(struct problem *problem, const struct impact_outcome *outcome)
{
    struct contact_model *model = &problem->contact_model;
    if (outcome->end_reason == PERCUSS_END_LIMIT)
        return false;
    if (model->decided)
        return false;
    bool yields = false;
    for (size_t c = 0; c < problem->contact_count; c++)
        yields =
            yields || (model->yielding ? contact_model_yielded(problem, outcome, c)
                                       : outcome_deepest(outcome, c) > model->choices[c].yield);
    model->decided = true;
    if (yields == model->yielding)
        return false;
    use(problem, yields);
    return true;
}

const struct contact_law_operations *contact_model_used(const struct problem *problem)
{
    const struct contact_law *laws = problem->contact_model.laws;
    const struct contact_law_operations *used = laws[0].operations;
    for (size_t c = 1; c < problem->contact_count; c++) {
        const struct contact_law_operations *here = laws[c].operations;
        /* a law that yields counts for all, and of those one that approximates tables */
        if (here->curve && (!used->curve || here->tables == CONTACT_TABLES_NONE))
            used = here;
    }
    return used;
}

/* The contact whose indentation is largest against that of its yield. */
static size_t hardest_hit(const struct problem *problem, const struct impact_outcome *outcome)
{
    size_t hardest = 0;
    double most = -1.0;
    for (size_t c = 0; c < problem->contact_count; c++) {
        double share = outcome_deepest(outcome, c) / problem->contact_model.choices[c].yield;
        if (share > most) {
            most = share;
            hardest = c;
        }
    }
    return hardest;
}

static void explain_elastic(const struct problem *problem, const struct impact_outcome *outcome,
                            struct text *text)
{
    double pressure = 0.0;
    size_t hardest = hardest_hit(problem, outcome);
    const struct contact_choice *choice = &problem->contact_model.choices[hardest];
    for (size_t c = 0; c < problem->contact_count; c++)
        pressure =
            fmax(pressure, hertz_peak_pressure(&problem->hertz[c], outcome_peak_force(outcome, c)));
    text_add(text, contact_model_used(problem)->title);
    text_add(text, " (peak pressure ");
    text_add_number(text, pressure / 1e6, 3);
    text_add(text, " MPa) on a half-space");
    double share = outcome_deepest(outcome, hardest) / choice->yield;
    const struct contact_law_operations *asked = asked_of(problem);
    if (choice->side < 0 && asked->curve && asked->tables == CONTACT_TABLES_NONE)
        text_add(text, ", as neither material has a yield stress");
    if (choice->side >= 0 && share <= 1.0)
        text_format(text, ", below yield (%.2g of the indentation at which %s yields)", share,
                    problem_body(problem, hardest, choice->side)->id);
}

static void explain_plastic(const struct problem *problem, const struct impact_outcome *outcome,
                            struct text *text)
{
    size_t c = hardest_hit(problem, outcome);
    const struct contact_choice *choice = &problem->contact_model.choices[c];
    const struct body *body = problem_body(problem, c, choice->side < 0 ? 0 : choice->side);
    const struct contact_history *history = &outcome->laws[c].history;
    const struct contact_law_operations *used = contact_model_used(problem);
    bool tabulated = used->tables == CONTACT_TABLES_ONLY;
    /* which law, and how deep it went */
    text_add(text, "elastic-plastic contact by ");
    text_add(text, tabulated && choice->family ? "the family of tables of the contact region"
                                               : used->title);
    if (history->max_indentation > 0.0)
        text_format(text, ": indented %.3g times as deep as where %s yields, dent %.3g um",
                    history->max_indentation / choice->yield, body->id, 1e6 * history->dent);
    else
        text_add(text, ", below yield");
    /* what it starts from and where it ends */
    if (choice->dented)
        text_add(text, ", in the dent of earlier impacts");
    if (contact_model_beyond_table(outcome, c) > 0.0)
        text_add(text, "; the table ends before that and goes on as a fully plastic contact");
    /* what is approximated */
    if (!tabulated && asked_of(problem)->tables == CONTACT_TABLES_IF_ANY)
        text_add(text, "; no table for these bodies");
    if (problem->hertz[c].axis_ratio < HERTZ_CIRCULAR_RATIO && !used->elliptic)
        text_format(text,
                    "; elliptic: by the sphere of equal stiffness, %.3g m, at the ellipse's peak "
                    "pressure, an approximation",
                    closed_form_radius(&problem->hertz[c]));
    if (!tabulated && body->material.tangent > 0.0)
        text_format(text, "; hardening of %s left out", body->id);
}

void contact_model_explain(const struct problem *problem, const struct impact_outcome *outcome,
                           struct text *text)
{
    if (contact_model_used(problem)->curve)
        explain_plastic(problem, outcome, text);
    else
        explain_elastic(problem, outcome, text);
}
